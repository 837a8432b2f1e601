"""
A region before and after choosing configurations
=================================================

This script evaluates 300 random poses in the configurations that inverse kinematics finds, and
again in the best configurations found. The curves show the gain over the whole region.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box([0.968, 0.0, 0.041], 0.5, np.deg2rad([0.0, 174.0, 0.0]), np.pi / 2)
run = hf.assess(arm, region, poses=300, seed=1, optimise=True)
for name, chosen in (("as found", False), ("chosen", True)):
    print(f"{name:9} at least 0.2: {run.interval(at_least=0.2, optimised=chosen)}")

# %%
# A pose that is not reached counts as failed in both curves.

h = np.linspace(0, 0.6, 301)
found, chosen = (1 - run.cdf(h, optimised=chosen) for chosen in (False, True))
figure, axes = plt.subplots(figsize=(7, 4))
axes.fill_between(h, found, chosen, color="#e3edf5")
axes.plot(h, chosen, lw=2.5, label="best configuration of each pose")
axes.plot(h, found, ls="--", lw=2, label="as inverse kinematics finds it")
axes.axvline(run.index.bound, c="0.4", lw=1, label=f"largest possible, {run.index.bound:.3f}")
axes.set(xlabel="worst-case relative manipulability h (no unit)", xlim=(0, 0.6))
axes.set(ylabel="probability of at least h", title=f"PA10, 9 joints: {run.poses} random poses")
axes.legend(loc="lower left")
