"""
The worst joint of one configuration
====================================

Each joint of the nine-joint PA10 is at the middle of its range when one joint locks. How much of
its manipulability remains, and which joint matters most? Arm and configuration are those of
Table I of [Abdi2012]_.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
q = np.deg2rad([0, 30, 0, 90, 0, 18, 0, 36, 0])
index = hf.indices.relative_manipulability(arm)
result = index.evaluate(q)
worst = int(result.worst)
print(f"worst case {result.value:.4f}, when {index.failure_names[worst]} locks")

# %%
# The squares of the nine values add up to n - m = 3, the degree of redundancy. Therefore no
# configuration of this arm keeps more than the dashed line for *every* joint.

figure, axes = plt.subplots(figsize=(7, 3.8))
colours = ["C1" if k == worst else "C0" for k in range(arm.n)]
bars = axes.bar(range(1, arm.n + 1), result.by_failure, color=colours)
axes.bar_label(bars, fmt="%.2f", padding=2)
axes.axhline(index.bound, c="0.3", ls="--", label=f"largest worst case, {index.bound:.3f}")
axes.set(xlabel="joint that locks", ylabel="relative manipulability (no unit)", ylim=(0, 1))
axes.set(xticks=range(1, arm.n + 1), title="PA10, 9 joints, pose task: 1 configuration")
axes.legend()

# %%
# The exact gradient shows the direction in which each joint must move to improve the worst case.

for name, slope in zip(arm.joint_names, index.gradient(q), strict=True):
    print(f"{name}: {slope:+.3f} per rad")
