"""
Optimise link lengths
=====================

The three link lengths of a planar arm are free. ``hf.design`` searches for the arm with the
largest 5 % quantile of the index over a region, whichever joint locks, and for the trade-off with
reach. The best arm is checked on 200 held-out poses.
"""

import holdfast as hf

found = hf.design(
    hf.arms.load("planar-3r"),
    {"a1": (0.5, 1.5), "a2": (0.5, 1.5), "a3": (0.5, 1.5)},  # m
    region=hf.Region.box([1.2, 0.4, 0], [1.6, 1.6, 0]),
    task="planar",
    poses=32,
    designs=24,
    local_searches=2,
    check_poses=200,
    seed=1,
)
for line in found.describe():
    print(line)

# %%
# Each dot is a design. No design exceeds those on the line in both reach and index quantile.

found.plot("front")
