"""
Leave a pipe gallery with a locked elbow
========================================

In the pipe gallery of a reactor, the elbow locks while the arm works between the pipes. The
script searches for a collision-free motion to the home position. Five pipes come from a simulated
scan of 60,000 points, each of which is a ball of 6 mm. The other objects are primitives. Every
piece of the route is proved collision-free.
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)

import numpy as np

import holdfast as hf
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Points, Sphere

pipe, along, around = np.random.default_rng(1).uniform(0, [[5], [1.6], [2 * np.pi]], (3, 60_000))
axes = np.array([[0.8, 0.1], [0.8, 0.4], [0.8, 0.7], [0.7, 0.95], [0.4, 1.1]])[pipe.astype(int)]
x, z = axes.T + 0.05 * np.array([np.cos(around), np.sin(around)])
drawn = [
    HalfSpace("floor", pose=[0, 0, -0.05]),
    Box("wall", [0.1, 2, 2], pose=[1, 0, 0.95]),
    Cylinder("vessel", 0.2, 1.2, pose=[-0.3, 0.7, 0.6]),
    Cylinder("flange", 0.09, 0.04, pose=[0.5, -0.5, 0.2]),
    Capsule("rod", 0.03, 0.8, pose=[0.4, -0.55, 0.6]),
    Sphere("valve", 0.08, pose=[0.65, 0.55, 0.15]),
    Box("tray", [0.3, 0.4, 0.06], pose=[0, -0.8, 0.02]),
]
scan = Points("pipes", np.stack([x, along - 0.8, z], axis=1), radius=0.006)
cell = hf.Cell([scan, *drawn], may_touch=[("floor", "base")], margin=0.01)
arm, locked = hf.arms.load("panda"), ["panda_joint4"]
at = np.array([-1.5, 0.3, 0.0, -1.9, 0.0, 2.3, 0.8])  # rad
answer = hf.recover(arm, locked, at, goal="home", task="position", cell=cell, samples=0)
print(*answer.describe(), sep="\n")

ends = [answer.q[0], answer.q[-1]]
arm.show(ends, labels=["start", "end"], locked=locked, cell=cell)
