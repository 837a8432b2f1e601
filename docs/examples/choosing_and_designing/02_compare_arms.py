"""
Compare two arms for one cell
=============================

This script evaluates two arms at the same 300 random poses of one region, in the configurations
that inverse kinematics finds. It shows which arm keeps more, whichever joint locks.
"""

import holdfast as hf

panda, xarm = hf.arms.load("panda"), hf.arms.load("xarm7")
region = hf.Region.around_tool(panda, hf.arms.about("panda").home)
runs = [hf.assess(arm, region, poses=300, seed=1) for arm in (panda, xarm)]
compared = hf.compare_assessments(runs, threshold=0.05)
for row in compared.table:
    name, value, worst = row["name"], row["probability"], row["worst_joint"]
    print(f"{name:6} keeps at least 0.05 at {value:.1%} of the poses, worst joint {worst}")

# %%
# The region is around the home position of one arm, which favours that arm. Use the region of
# your work instead.

compared.plot()
