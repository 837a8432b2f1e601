"""
Which link lengths?
===================

The three lengths of a planar arm are open. ``hf.design`` searches for the arm that *guarantees*
most at 95 % of the poses of a region, whichever joint locks, against reach; the best is checked
on 200 fresh poses.
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
# Each dot is a design; those on the line are beaten by none in both reach and guaranteed index.

found.plot("front")
