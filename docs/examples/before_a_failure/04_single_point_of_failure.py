"""
A structural single point of failure
====================================

The PA10 and the Panda both have seven joints. If the elbow of the PA10 locks, its end effector
loses one of the six directions of motion in *every* configuration, because the self-motion of
this arm never moves the elbow. The Panda has no such joint.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast.studies.assessment import structure

figure, both = plt.subplots(1, 2, figsize=(8, 3.8), sharey=True)
for axes, name in zip(both, ("pa10-7dof", "panda"), strict=True):
    arm = hf.arms.load(name)
    fatal = structure(arm).fatal
    q = np.random.default_rng(4).uniform(arm.lower, arm.upper, (4096, arm.n))
    rho = hf.indices.relative_manipulability(arm).by_joint(q)
    low, middle, high = np.quantile(rho, [0.05, 0.5, 0.95], axis=0)
    for k in range(arm.n):
        colour = "C1" if k in fatal else "C0"
        axes.vlines(k + 1, low[k], high[k], color=colour, linewidth=6, alpha=0.4)
        axes.plot(k + 1, middle[k], "D" if k in fatal else "o", color=colour, markersize=8)
    axes.set(xlabel="joint that locks", xticks=range(1, arm.n + 1), title=f"{name}, pose task")
    print(structure(arm))
both[0].set_ylabel("relative manipulability (no unit)\nmedian, and 5 % to 95 %")
figure.suptitle("4096 random configurations; diamond: 0 in every one")

# %%
# A structural zero depends on the task. With three task components instead of six, no joint of
# the PA10 is indispensable.

print(structure(hf.arms.load("pa10-7dof"), "position"))
