"""
The remaining workspace after a lock
====================================

The elbow of a Panda is locked at 60, 100 and 150 degrees. The script finds the points in the
plane through the base that the tool can still reach within the limits of the other joints. It
uses inverse kinematics from random starts on a grid of 900 points.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
x, z = np.meshgrid(np.linspace(-0.9, 0.9, 30), np.linspace(-0.4, 1.2, 30))
points = np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)
figure, panels = plt.subplots(1, 3, figsize=(9, 3.2), sharey=True)
for axes, bend in zip(panels, (60, 100, 150), strict=True):
    locked = {"panda_joint4": -np.deg2rad(bend)}
    there = hf.reachable_when_locked(arm, points, locked=locked, task="position").success
    axes.pcolormesh(x, z, there.reshape(x.shape), cmap="Blues", vmax=1.5)
    axes.plot(0, 0, "ks")
    axes.set(title=f"elbow bent by {bend}°: {there.mean():.0%}", xlabel="x, m", aspect="equal")
panels[0].set_ylabel("z, m")

# %%
# White points were not found to be reachable, which proves nothing. ``hf.joint_bounds`` examines
# one target exactly.
