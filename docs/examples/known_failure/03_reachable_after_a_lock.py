"""
What is left of the workspace
=============================

The elbow of a Panda is locked at 60, 100 and 150 degrees of bend. Which points in the plane through its base can the tool
still reach, within the other joints' limits? 900 points of a grid, by inverse kinematics from random starts.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
x, z = np.meshgrid(np.linspace(-0.9, 0.9, 30), np.linspace(-0.4, 1.2, 30))
points = np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)
figure, panels = plt.subplots(1, 3, figsize=(9, 3.2), sharey=True, layout="constrained")
for axes, bend in zip(panels, (60, 100, 150), strict=True):
    found = hf.reachable_when_locked(arm, points, locked={"panda_joint4": -np.deg2rad(bend)}, task="position")
    axes.imshow(found.success.reshape(x.shape), origin="lower", extent=(-0.9, 0.9, -0.4, 1.2), cmap="Blues", vmax=1.6)
    axes.plot(0, 0, "s", color="0.2")
    axes.set(title=f"elbow bent by {bend}°: {found.success.mean():.0%}", xlabel="x, m")
panels[0].set_ylabel("z, m")

# %%
# White was not found to be reachable, which is no proof; :func:`holdfast.joint_bounds` looks at one target more closely.
