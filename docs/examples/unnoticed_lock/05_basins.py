"""
Basins: which solution does it reach?
=====================================

With joint 2 locked at 45 degrees the target can be reached in two configurations. From 900 starts
on a grid the closed loop is simulated, and the cell has the colour of the solution where it
ended.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
found = hf.basins(law, [1.5, 1.5], locked={"joint2": np.deg2rad(45)}, grid=30)
for name, share in found.shares:
    print(f"{name}: {share}")

# %%
# The lines run into the saddles and are the borders between the basins. They are integrated
# backwards in time, not read off the cells.

found.plot()
