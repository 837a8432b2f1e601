"""
Out of a pipe gallery
=====================

In a reactor's pipe gallery a joint locks while the arm works between the pipes. Is there a way
out that touches nothing? The gallery is partly drawn and partly scanned: 60,000 points, each a
ball of 6 mm (a simulated scan of five pipes). Every piece of the route is proved clear.
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)

import numpy as np

import holdfast as hf
from holdfast.cell import Box, Capsule, Cylinder, HalfSpace, Points, Sphere


def at(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


rng = np.random.default_rng(1)
pipe, along, around = (rng.uniform(0, top, 60_000) for top in (5, 1.6, 2 * np.pi))
ring = 0.05 * np.stack([np.cos(around), np.sin(around)]) + rng.normal(0, 0.001, (2, 60_000))
rows = np.array([[0.75, 0.2], [0.75, 0.45], [0.75, 0.7], [0.6, 0.95], [0.35, 1.05]])[pipe.astype(int)]
scan = np.stack([rows[:, 0] + ring[0], along - 0.8, rows[:, 1] + ring[1]], axis=1)
cell = hf.Cell(
    [
        Points("pipes", scan, radius=0.006),
        HalfSpace("floor", pose=at(0, 0, -0.05)),
        Box("wall", [0.1, 2.0, 2.0], pose=at(1.0, 0, 0.95)),
        Cylinder("vessel", 0.25, 1.2, pose=at(-0.3, 0.65, 0.6)),
        Cylinder("flange", 0.09, 0.04, pose=at(0.5, -0.45, 0.3)),
        Capsule("rod", 0.03, 0.8, pose=at(0.45, -0.5, 0.6)),
        Sphere("valve", 0.08, pose=at(0.55, 0.4, 0.3)),
        Box("tray", [0.3, 0.5, 0.06], pose=at(0.1, -0.65, 0.2)),
    ],
    may_touch=[("floor", "base")],
    margin=0.01,
)
