"""
What failure tolerance costs while nothing has failed
=====================================================

The failure-tolerant inverse gives up some accuracy of the healthy arm for a smaller error after a
lock. How much is gained for how much? 1000 random configurations and directions of a Panda that
moves its tool point.
"""

import holdfast as hf

arm = hf.arms.load("panda")
curve = hf.control.trade_off(arm, "position", samples=1000, seed=1)
for line in curve.describe()[:4]:
    print(line)

# %%
# Along the axis: the velocity error that the healthy arm may have, as a fraction of the command.
# Upward: what remains of the error after the worst lock.

curve.plot()
