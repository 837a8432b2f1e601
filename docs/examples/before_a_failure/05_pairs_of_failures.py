"""
Pairs of failures
=================

After a first failure, the arm may have to keep working for some time. This script shows the
effect of a *second* failure. The nine-joint PA10 has three degrees of redundancy for a pose, so
the number of joints suffices for any two locks. The geometry often does not.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box([0.968, 0.0, 0.041], 0.5, np.deg2rad([0.0, 174.0, 0.0]), np.pi / 2)
table = np.full((arm.n, arm.n), np.nan)
for failures in ("single", "pairs"):  # the same seed: the same poses and configurations
    index = hf.indices.relative_manipulability(arm, failures=failures)
    run = hf.assess(arm, region, index, poses=600, seed=2)
    for failed, values in zip(index.failures, run.dataset["by_failure"].values.T, strict=True):
        table[failed[-1], failed[0]] = np.nanmedian(values)

# %%
# Median over the reached poses: one locked joint on the diagonal, two locked joints off it.

figure, axes = plt.subplots(figsize=(6.4, 5))
image = axes.imshow(table, cmap="cividis", vmin=0, vmax=1)
for row, column in zip(*np.tril_indices(arm.n), strict=True):
    value = table[row, column]
    axes.text(
        column, row, f"{value:.2f}", c="w" if value < 0.5 else "k", ha="center", va="center"
    )
joints = range(1, arm.n + 1)
axes.set_xticks(range(arm.n), joints)
axes.set_yticks(range(arm.n), joints)
axes.set(xlabel="joint that locks", ylabel="other joint that locks (diagonal: none)")
axes.set_title(f"PA10, 9 joints, pose task: median of {run.distribution.reached} poses")
figure.colorbar(image, label="relative manipulability (no unit)", shrink=0.85)
