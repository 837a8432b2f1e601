"""
Severity of a free swing
========================

Three numbers describe each joint of a Panda that might lose its torque: the holding torque, the
initial acceleration, and the swing angle. Smaller is better for all three, and each of them is
smallest in a different configuration.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
measures = {
    "torque that holds it, N m": hf.susceptibility.torque(arm).by_joint(q),
    "acceleration if it is free, rad/s²": hf.susceptibility.acceleration(arm).by_joint(q),
    "angle to where it would hang, deg": np.rad2deg(
        hf.susceptibility.swing_angle(arm).by_joint(q)
    ),
}
figure, panels = plt.subplots(1, 3, figsize=(9, 3.4), sharey=True)
for axes, (label, values) in zip(panels, measures.items(), strict=True):
    size = np.abs(values)
    colours = ["C1" if value == size.max() else "C0" for value in size]
    axes.barh(range(1, arm.n + 1), size, color=colours)
    axes.set(xlabel=label, yticks=range(1, arm.n + 1))
panels[0].set_ylabel("joint that swings free")
panels[0].invert_yaxis()
figure.suptitle("Panda, 1 configuration: three measures, three different worst joints")
