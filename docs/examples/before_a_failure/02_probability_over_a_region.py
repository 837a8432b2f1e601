"""
Probability over a region, with its confidence band
===================================================

A task with many poses needs more than one configuration. This script samples 2000 poses in the
region of [Abdi2012]_, a cube of 0.5 m and of 90 degrees, and solves them by inverse kinematics
within the joint limits.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box([0.968, 0.0, 0.041], 0.5, np.deg2rad([0.0, 174.0, 0.0]), np.pi / 2)
run = hf.assess(arm, region, poses=2000, seed=1)
print(f"probability of at least 0.2, whichever joint locks: {run.interval(at_least=0.2)}")

# %%
# The band contains the *whole* true curve with 95 % confidence (Dvoretzky, Kiefer, Wolfowitz). A
# pose that was not reached counts as failed.

h = np.linspace(0, 0.5, 501)
kept, band = 1 - run.cdf(h), run.distribution.band()
figure, axes = plt.subplots(figsize=(7, 4))
axes.fill_between(h, np.clip(kept - band, 0, 1), np.clip(kept + band, 0, 1), color="C5")
axes.plot(h, kept, lw=2, label=f"{run.poses} poses, with 95 % band (±{band:.3f})")
axes.plot(h, 1 - run.cdf(h, reachable_only=True), ls="--", label="only those reached")
axes.set(xlabel="worst-case relative manipulability h (no unit)", xlim=(0, 0.5))
axes.set(ylabel="probability of at least h", title="PA10, 9 joints, any one joint locked")
axes.legend()

# %%
# The joints that are worst, and how often:

for name, count in zip(run.index.failure_names, run.worst_counts, strict=True):
    print(f"{name}: worst at {count / run.distribution.reached:6.1%} of the reached poses")
