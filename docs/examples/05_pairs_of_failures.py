"""
Pairs of failures
=================

After the first failure the arm may have to go on working for a while. What does a *second* one do? The nine-joint PA10 has
three degrees of redundancy for a pose, so any two may lock and the count of joints still suffices. The geometry often does not.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box([0.968, 0.0, 0.041], 0.5, np.deg2rad([0.0, 174.0, 0.0]), np.pi / 2)
one = hf.indices.relative_manipulability(arm)
two = hf.indices.relative_manipulability(arm, failures="pairs")
single = hf.assess(arm, region, one, poses=1000, seed=2)
pairs = hf.assess(arm, region, two, poses=1000, seed=2)
print(f"poses reached: {single.distribution.reached} of {single.distribution.samples}")
for name, run in (("any one joint", single), ("any two joints", pairs)):
    middle = float(run.distribution.quantile(0.5))
    print(f"{name}: median worst case over the reached poses {middle:.4f}")

# %%
# The same seed draws the same poses and finds the same configurations, so the two runs can be put side by side. The
# table shows the median over the reached poses: off the diagonal for two locked joints, on it for one.

table = np.full((arm.n, arm.n), np.nan)
for run in (single, pairs):
    data = run.dataset
    median = np.nanmedian(data["by_failure"].values, axis=0)
    for failed, value in zip(run.index.failures, median, strict=True):
        table[failed[-1], failed[0]] = value

figure, axes = plt.subplots(figsize=(6.6, 5.2), layout="constrained")
image = axes.imshow(table, cmap="cividis", vmin=0, vmax=1)
for row in range(arm.n):
    for column in range(row + 1):
        value = table[row, column]
        colour = "white" if value < 0.5 else "black"
        axes.text(column, row, f"{value:.2f}", ha="center", va="center", fontsize=9, color=colour)
joints = range(1, arm.n + 1)
axes.set(
    xticks=range(arm.n),
    yticks=range(arm.n),
    xticklabels=joints,
    yticklabels=joints,
    xlabel="joint that locks (on the diagonal: the only one)",
    ylabel="other joint that locks",
    title=f"PA10, 9 joints, pose task: median over {pairs.distribution.reached} reached poses",
)
axes.title.set_size(11)
axes.spines[["top", "right", "left", "bottom"]].set_visible(False)
figure.colorbar(image, ax=axes, label="relative manipulability (no unit)", shrink=0.85)

# %%
# The pairs that hurt most:

order = np.argsort(np.nanmedian(pairs.dataset["by_failure"].values, axis=0))
for k in order[:4]:
    median = float(np.nanmedian(pairs.dataset["by_failure"].values[:, k]))
    print(f"{pairs.index.failure_names[k]}: {median:.4f}")
