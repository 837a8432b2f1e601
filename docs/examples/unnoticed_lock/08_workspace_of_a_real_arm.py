"""
A map of starts of a seven-joint arm
====================================

This script computes the same measures for a Panda with a position task, from 30 random starts
with 4 configurations each. Each joint locks in turn on the way. The intervals count *starts*,
because the configurations of one start are not independent.
"""

import holdfast as hf

arm = hf.arms.load("panda")
law = hf.control.pseudoinverse(arm, "position")
found = hf.workspace(law, [0.5, 0.2, 0.4], 30, configurations=4, points=1, seed=1)
mean, sure = found.means()["Ravg"], found.intervals()["Ravg"]
for name, fraction, (low, high) in zip(found.columns, mean, sure, strict=True):
    print(f"{name:13} within reach on {fraction:5.1f} % of a motion ({low:.0f} to {high:.0f})")

# %%
# The map from above, with means over the starts in each cell, in percent.

found.plot("reach-top")
