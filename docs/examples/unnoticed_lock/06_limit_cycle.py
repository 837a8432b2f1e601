"""
An arm that never stops
=======================

The target is within reach, nothing but its two solutions attracts, and still the end effector does not get there: it goes
round for ever, a limit cycle.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast.equilibria import orbit

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
target = [0.9, 0.0]  # m
runs = hf.simulate(law, np.deg2rad([-130.0, 168.30, -84.0]), target, locked=["joint2"], time_limit=4000)
cycle = orbit(runs)
print(runs.outcome, "|", *cycle.describe(), "| stable:", cycle.stable)

# %%
# The first 200 s (gain 1/s) of one motion.

path = runs.path(until=200.0, samples=4000)
figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
axes.plot(*path.x[:, :2].T, color="#0a5c9e", linewidth=1.2, label="end effector")
axes.plot(*arm.frames(path.q[-1])[:, :2, 3].T, "o-", color="0.3", linewidth=3, markerfacecolor="white", label="arm after 200 s")
axes.plot(*target, "o", fillstyle="none", color="#c8500a", markersize=16, markeredgewidth=2.5, label="target")
axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="Joint 2 locked at 168.3°, pseudoinverse")
axes.legend(frameon=False, loc="upper left")
axes.spines[["top", "right"]].set_visible(False)
