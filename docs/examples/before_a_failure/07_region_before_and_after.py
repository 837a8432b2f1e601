"""
A region, before and after choosing configurations
==================================================

Each of 300 random poses is taken as inverse kinematics finds it, and once more in the best configuration that was found.
What does choosing gain over the whole region?
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
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
curves = [1 - run.cdf(h, optimised=chosen) for chosen in (False, True)]
axes.fill_between(h, *curves, color="#e3edf5")
axes.plot(h, curves[0], color="#c8500a", linestyle="--", linewidth=2, label="as inverse kinematics finds it")
axes.plot(h, curves[1], color="#0a5c9e", linewidth=2.5, label="best configuration of each pose")
axes.axvline(run.index.bound, color="0.4", linewidth=1, label=f"bound of any configuration, {run.index.bound:.3f}")
axes.set(xlabel="worst-case relative manipulability h (no unit)", ylabel="probability of at least h")
axes.set(xlim=(0, 0.6), ylim=(0, 1.02), title=f"PA10, 9 joints, any one joint locked, {run.poses} random poses, seed 1")
axes.legend(frameon=False, loc="lower left")
axes.spines[["top", "right"]].set_visible(False)
