"""
A map of starts of a planar arm
===============================

The maps show from which starts the arm still reaches its target if a joint locks on the way.
Every start on a grid has many configurations, and each of them begins another motion. The maps
show the fraction of these motions on which the target stays within reach.
"""

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
found = hf.workspace(law, [1.5, 1.5], "grid:14", configurations=8, points=2, method="procedure")
for line in found.describe():
    print(line)

# %%
# R100 is the fraction of the configurations of a start from which the target always stays within
# reach. Ravg is the mean fraction of the motion on which it does. Rsens states how much the
# choice of the configuration matters.

found.plot("reach")
