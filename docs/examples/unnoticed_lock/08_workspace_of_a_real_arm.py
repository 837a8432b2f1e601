"""
A map of starts, of a seven-joint arm
=====================================

The same question for a Panda that moves its tool point: 40 random starts of 4 configurations, each joint locked in turn
on the way. The intervals count *starts*, because the configurations of one start are alike.
"""

import holdfast as hf

arm = hf.arms.load("panda")
law = hf.control.pseudoinverse(arm, "position")
found = hf.workspace(law, [0.5, 0.2, 0.4], 40, configurations=4, points=1, seed=1)
for name, mean, sure in zip(found.columns, found.means()["Ravg"], found.intervals()["Ravg"], strict=True):
    print(f"{name:13} the target stays within reach on {mean:5.1f} % of a motion ({sure[0]:.0f} to {sure[1]:.0f}, 95 %)")

# %%
# Seen from above, means over the starts in each cell, in percent.

found.plot("reach-top")
