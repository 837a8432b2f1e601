"""
Basins of attraction of two solutions
=====================================

With joint 2 locked at 45 degrees, the arm can reach the target in two configurations. The script
simulates the closed loop from 900 starts on a grid. The colour of each cell shows the solution at
which its run ended.
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
# backwards in time and do not depend on the grid.

found.plot()
