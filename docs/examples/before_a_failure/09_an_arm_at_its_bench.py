"""
An arm at its bench
===================

Nobody's arm stands in empty space. A cell is a file with objects around it: here a table, a vise
and a tray from meshes, a portal with a camera, a post, a hose and a lamp. How likely does a Panda
keep its dexterity when a joint locks, where it can be without touching any of them?
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)

from pathlib import Path

import numpy as np

import holdfast as hf

cell = hf.Cell.load(Path("../../../examples/cells/bench.yaml"))
print(cell)
arm = hf.arms.load("panda")
region = hf.Region.box([0.5, 0, 0.3], [0.3, 0.6, 0.4])
result = hf.assess(arm, region, poses=200, seed=1, optimise=True, cell=cell)
for line in result.describe():
    print(line)

# %%
# The pose whose best clear configuration keeps the most, as the arm would stand there.

rows = result.rows
best = int(np.nanargmax(rows["optimised"]))
arm.show(rows["optimised_q"][best], cell=cell)
