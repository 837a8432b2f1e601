"""
A map of starts, of a seven-joint arm
=====================================

The same question for a Panda that moves its tool point: 30 random starts of 4 configurations,
each joint locked in turn on the way. The intervals count *starts*, because the configurations of
one start are alike.
"""

import holdfast as hf

arm = hf.arms.load("panda")
law = hf.control.pseudoinverse(arm, "position")
found = hf.workspace(law, [0.5, 0.2, 0.4], 30, configurations=4, points=1, seed=1)
mean, sure = found.means()["Ravg"], found.intervals()["Ravg"]
for name, fraction, (low, high) in zip(found.columns, mean, sure, strict=True):
    print(f"{name:13} within reach on {fraction:5.1f} % of a motion ({low:.0f} to {high:.0f})")

# %%
# Seen from above, means over the starts in each cell, in percent.

found.plot("reach-top")
