"""
Worst joint of the PA10 at its nominal configuration
====================================================

The nine-joint PA10 stands in the middle of its limits. One joint locks. How much of its manipulability is left, and
which joint hurts most? The arm and the configuration are those of Table I of [Abdi2012]_.
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
# The squares of the nine values add up to n - m = 3, its degree of redundancy. So no configuration of this
# arm can keep more than the dashed line for *every* joint.

print(f"sum of squares: {np.sum(result.by_failure**2):.12f}")

blue, orange = "#0072B2", "#D55E00"
figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
colours = [orange if k == worst else blue for k in range(arm.n)]
bars = axes.bar(range(1, arm.n + 1), result.by_failure, color=colours, width=0.7)
bars[worst].set_hatch("//")
bars[worst].set_edgecolor("white")
axes.bar_label(bars, fmt="%.2f", padding=2, fontsize=9)
axes.axhline(index.bound, color="0.25", linestyle="--", linewidth=1)
axes.text(arm.n + 0.62, index.bound, f"largest worst case\npossible: {index.bound:.3f}", va="center", fontsize=9)
axes.set(
    xticks=range(1, arm.n + 1),
    xlabel="joint that locks (numbered from the base)",
    ylabel="relative manipulability (no unit)",
    ylim=(0, 1),
    title="PA10, 9 joints, pose task: what one locked joint leaves (1 configuration)",
)
axes.title.set_size(11)
axes.spines[["top", "right"]].set_visible(False)

# %%
# The gradient says which way to turn the joints to make the worst case better. Only joints 4 and 6 matter here, and
# joint 6 by far the most.

for name, slope in zip(arm.joint_names, index.gradient(q), strict=True):
    print(f"{name}: {round(slope, 4) + 0.0:+.4f} per rad")
