"""
Points that survive every lock
==============================

Artificial joint limits that hold *until* a failure leave fewer angles to lock at. The
failure-tolerant workspace is what the healthy arm reaches within them, and what the arm still
reaches with any one joint locked anywhere within them.
"""

import holdfast as hf

arm = hf.arms.load("planar-3r")
found = hf.tolerant_workspace(arm, "planar", optimise=True, seed=1)
for line in found.describe():
    print(line)

# %%
# Three planar links that turn all the way have a closed form; other arms are sampled, with an
# interval.

found.plot()
