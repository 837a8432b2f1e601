"""
An arm with a single point of failure, and one without
======================================================

The seven-joint PA10 and the Panda have the same number of joints. Lock the elbow of the PA10 and its end effector cannot do all
six motions any more, in *no* configuration: the self-motion of this arm never moves the elbow. The Panda
is built differently (its last axis is offset from the wrist, for one) and has no such joint.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast.assessment import explain, structure, structures

for name in ("pa10-7dof", "panda"):
    arm = hf.arms.load(name)
    print(explain(arm, structure(arm), structures(arm)))
    print()

# %%
# ``structure`` looks at random configurations. Here is what it sees: relative manipulability for each joint that can
# lock, over 4096 configurations drawn within the limits.

samples = 4096
figure, both = plt.subplots(1, 2, figsize=(8, 3.8), sharey=True, layout="constrained")
blue, orange = "#0072B2", "#D55E00"
for axes, name in zip(both, ("pa10-7dof", "panda"), strict=True):
    arm = hf.arms.load(name)
    q = np.random.default_rng(4).uniform(arm.lower, arm.upper, (samples, arm.n))
    rho = hf.indices.relative_manipulability(arm).by_joint(q)
    fatal = structure(arm).fatal
    low, middle, high = np.quantile(rho, [0.05, 0.5, 0.95], axis=0)
    for k in range(arm.n):
        colour = orange if k in fatal else blue
        axes.vlines(k + 1, low[k], high[k], color=colour, linewidth=5, alpha=0.45)
        axes.plot(k + 1, middle[k], "D" if k in fatal else "o", color=colour, markersize=7)
        if k in fatal:
            axes.annotate(
                "0 in every\nconfiguration",
                (k + 1, 0.02),
                (k + 1, 0.2),
                ha="center",
                color=colour,
                fontsize=9,
                arrowprops={"arrowstyle": "-", "color": colour},
            )
    axes.set(xlabel="joint that locks", xticks=range(1, arm.n + 1), ylim=(-0.03, 1.03))
    axes.set_title(f"{name}, pose task", fontsize=11)
    axes.grid(axis="y", color="0.9")
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
both[0].set_ylabel("relative manipulability (no unit)\nmedian, and 5 % to 95 %")
figure.suptitle(f"{samples} random configurations within the limits of each arm", fontsize=11)

# %%
# A structural zero depends on the task. With three rows instead of six, no joint of the PA10 is indispensable.

print(structure(hf.arms.load("pa10-7dof"), "position"))
