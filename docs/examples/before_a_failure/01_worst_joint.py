"""
The worst joint of one configuration
====================================

The nine-joint PA10 stands in the middle of its limits; one joint locks. How much of its manipulability is left, and
which joint hurts most? Arm and configuration are those of Table I of [Abdi2012]_.
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
# The squares of the nine values add up to n - m = 3, the degree of redundancy. So no configuration of this arm keeps
# more than the dashed line for *every* joint.

figure, axes = plt.subplots(figsize=(7, 3.8), layout="constrained")
colours = ["#c8500a" if k == worst else "#0a5c9e" for k in range(arm.n)]
bars = axes.bar(range(1, arm.n + 1), result.by_failure, color=colours, width=0.7)
axes.bar_label(bars, fmt="%.2f", padding=2)
axes.axhline(index.bound, color="0.25", linestyle="--", linewidth=1, label=f"largest worst case possible, {index.bound:.3f}")
axes.set(xticks=range(1, arm.n + 1), xlabel="joint that locks", ylabel="relative manipulability (no unit)", ylim=(0, 1))
axes.set_title("PA10, 9 joints, pose task: 1 configuration")
axes.legend(frameon=False)
axes.spines[["top", "right"]].set_visible(False)

# %%
# The gradient is exact: which way to turn each joint to make the worst case better.

for name, slope in zip(arm.joint_names, index.gradient(q), strict=True):
    print(f"{name}: {slope:+.3f} per rad")
