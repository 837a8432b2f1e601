"""
A map of starts, of a planar arm
================================

From where does the arm still reach its target, if a joint locks on the way? Every start on a
lattice has many configurations, and each begins another motion. The maps show on how much of them
the target stays within reach.
"""

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
found = hf.workspace(law, [1.5, 1.5], "grid:14", configurations=8, points=2, method="procedure")
for line in found.describe():
    print(line)

# %%
# R100: the fraction of the configurations of a start from which the target is never lost. Ravg:
# the mean fraction of the motion on which it is not. Rsens: how much the choice of the
# configuration matters.

found.plot("reach")
