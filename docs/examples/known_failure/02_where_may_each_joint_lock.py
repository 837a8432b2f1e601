"""
Tolerable lock angles of each joint
===================================

If a joint locks, the pose stays within reach if and only if the joint has a value that it has in
some configuration of that pose. Therefore each joint has an exact set of tolerable values, which
is one or more arcs of its range.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
pose = arm.forward_kinematics(np.deg2rad([0, -45, 0, -135, 0, 90, 45]))
bounds = hf.joint_bounds(arm, pose)

# %%
# Grey is the range of the joint, and blue are the values at which it may lock. For the elbow,
# joint 4, there is almost only one such value.

figure, axes = plt.subplots(figsize=(7, 3.8))
for k, arcs in enumerate(bounds):
    low, high = np.rad2deg([arm.lower[k], arm.upper[k]])
    axes.barh(k + 1, high - low, left=low, height=0.5, color="#e3e6e9")
    for first, last in np.rad2deg(arcs):
        axes.barh(k + 1, max(last - first, 2), left=first, height=0.5, color="C0")
    fraction = sum(last - first for first, last in np.rad2deg(arcs)) / (high - low)
    print(f"joint {k + 1}: {fraction:.0%} of its range")
axes.set(yticks=range(1, arm.n + 1), ylabel="joint that locks", xlabel="where it locks, deg")
axes.set_title("Panda: the pose stays within reach (blue)")
axes.invert_yaxis()
