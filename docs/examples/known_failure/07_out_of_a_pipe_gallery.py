"""
Out of a pipe gallery
=====================

In a reactor's pipe gallery a joint locks while the arm works between the pipes. Is there a way
home that touches nothing? Five pipes were scanned: 60,000 points, each a ball of 6 mm (a
simulated scan); the rest is drawn. Every piece of the route is proved clear.
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)

import numpy as np

import holdfast as hf
from holdfast.cell import Box, Capsule, Cylinder, HalfSpace, Points, Sphere

rng = np.random.default_rng(1)
pipe, along, around = (rng.uniform(0, top, 60_000) for top in (5, 1.6, 2 * np.pi))
ring = 0.05 * np.stack([np.cos(around), np.sin(around)]) + rng.normal(0, 0.001, (2, 60_000))
axes = np.array([[0.8, 0.1], [0.8, 0.4], [0.8, 0.7], [0.7, 0.95], [0.4, 1.1]])[pipe.astype(int)]
scan = np.stack([axes[:, 0] + ring[0], along - 0.8, axes[:, 1] + ring[1]], axis=1)
cell = hf.Cell(
    [
        Points("pipes", scan, radius=0.006),
        HalfSpace("floor", pose=[0, 0, -0.05]),
        Box("wall", [0.1, 2, 2], pose=[1, 0, 0.95]),
        Cylinder("vessel", 0.2, 1.2, pose=[-0.3, 0.7, 0.6]),
        Cylinder("flange", 0.09, 0.04, pose=[0.5, -0.5, 0.2]),
        Capsule("rod", 0.03, 0.8, pose=[0.4, -0.55, 0.6]),
        Sphere("valve", 0.08, pose=[0.65, 0.55, 0.15]),
        Box("tray", [0.3, 0.4, 0.06], pose=[0, -0.8, 0.02]),
    ],
    may_touch=[("floor", "base")],
    margin=0.01,
)

# %%
# The elbow locks where it is. Home is a pose of the tool here: the elbow cannot go back.

arm = hf.arms.load("panda")
at = np.array([-1.5, 0.3, 0.0, -1.9, 0.0, 2.3, 0.8])  # rad
answer = hf.recover(arm, ["panda_joint4"], at, goal="home", task="position", cell=cell, samples=0)
for line in answer.describe():
    print(line)

# %%
# Start and end of the route between the pipes.

arm.show([answer.q[0], answer.q[-1]], labels=["start", "end"], locked=["panda_joint4"], cell=cell)
