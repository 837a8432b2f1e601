"""
An arm at its bench
===================

A real arm is surrounded by objects. A cell file describes them. This cell contains a table, a
vise, a tray and a portal from meshes, a camera, a post, a hose and a lamp. How much dexterity
does a Panda keep when a joint locks, in configurations that touch none of these objects?
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)

from pathlib import Path

import numpy as np

import holdfast as hf

cell = hf.Cell.load(Path("../../../examples/cells/bench.yaml"))
print(cell)
arm = hf.arms.load("panda")
region = hf.Region.box([0.5, 0, 0.3], [0.3, 0.6, 0.4], rpy_center=[np.pi, 0, 0])
index = hf.indices.relative_manipulability(arm, "position")
result = hf.assess(arm, region, index, poses=100, seed=1, optimise=True, cell=cell)
for line in result.describe():
    print(line)

# %%
# The best collision-free configuration of the pose that keeps the most dexterity.

columns = result.columns
best = int(np.nanargmax(columns["optimised_index"]))
arm.show(columns["optimised_q"][best], cell=cell)
