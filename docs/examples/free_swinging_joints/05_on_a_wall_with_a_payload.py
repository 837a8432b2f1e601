"""
An arm on a wall, with a payload
================================

The mounting of an arm and its payload decide which joint would fall hardest. This script compares
the same configuration of a Panda on the floor, on a slope and on a wall, with 0 to 3 kg at the
tool.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
most = [joint.effort for joint in arm.joints]  # N m
masses = np.linspace(0, 3, 7)  # kg
figure, axes = plt.subplots(figsize=(7, 3.8))
for name, turn, style in (("floor", 0, "-"), ("slope of 45°", 45, "--"), ("wall", 90, ":")):
    base = np.eye(4)
    base[:3, :3] = Rotation.from_euler("y", turn, degrees=True).as_matrix()
    share = []
    for mass in masses:
        block = hf.Link(mass=mass, com=[0, 0, 0], inertia=np.zeros((3, 3)))
        held = arm.with_base(base).with_payload(block).gravity_torque(q)
        share.append(np.abs(held) / most)
    label = f"{name}: joint {np.argmax(share[-1]) + 1} at 3 kg"
    axes.plot(masses, 100 * np.max(share, axis=1), style, lw=2.4, label=label)
axes.set(xlabel="payload, kg", ylabel="largest torque held, % of the motor's")
axes.set(ylim=(0, None), title="Panda, 1 configuration, 3 mounts")
axes.legend()
