"""
The cost of failure tolerance for the healthy arm
=================================================

The failure-tolerant inverse accepts an error of the healthy arm to reduce the error after a lock.
This script computes the trade-off for 1000 random configurations and directions of a Panda with a
position task.
"""

import holdfast as hf

arm = hf.arms.load("panda")
curve = hf.control.trade_off(arm, "position", samples=1000, seed=1)
for line in curve.describe()[:4]:
    print(line)

# %%
# The horizontal axis is the allowed velocity error of the healthy arm, as a fraction of the
# command. The vertical axis is the remaining error after the worst lock.

curve.plot()
