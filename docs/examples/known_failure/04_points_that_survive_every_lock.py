"""
The failure-tolerant workspace
==============================

Artificial joint limits that apply *until* a failure restrict the angles at which a joint can
lock. The failure-tolerant workspace contains the points that the healthy arm reaches within these
limits, and that it still reaches with any one joint locked anywhere within them.
"""

import holdfast as hf

arm = hf.arms.load("planar-3r")
found = hf.tolerant_workspace(arm, "planar", optimise=True, seed=1)
for line in found.describe():
    print(line)

# %%
# Three planar links with unlimited joints have a closed form. Other arms are sampled, and the
# result has an interval.

found.plot()
