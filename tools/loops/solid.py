"""Arms and cells as shaded triangles, farthest first: what the loops of bodies in MuJoCo are drawn with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.presentation.arm.visuals import make_part
from holdfast.interface.presentation.cell.bodies import mesh_solid
from holdfast.interface.report.views import View
from holdfast.model.cell.nodes import split_triangles
from holdfast.model.shapes.reading import read_pieces

Array = NDArray[np.float64]
Triangles = Array  # (F, 3, 3) m

_LIGHT = np.array([0.35, -0.45, 0.82])
_DARKEST = 0.55  # of a colour, on a face away from the light
_SPLIT = 0.12  # m: larger triangles are halved, so that their middles tell what is behind what


def arm_bodies(arm: hf.Arm) -> list[tuple[int, Triangles]]:
    """The collision shapes of an arm: the frame that each moves with (0 is the base), and its triangles there."""
    pieces, _ = read_pieces(arm, "collision")
    return [(part.frame, part.vertices[part.faces]) for part in map(make_part, pieces)]


def box(size: Sequence[float], middle: Sequence[float]) -> Triangles:
    """A box of full sizes about a point, m."""
    corners, faces = mesh_solid(hf.cell.Box("box", list(size)), 1.0)
    return (corners + np.asarray(middle))[faces]


def rod(radius: float, begin: Sequence[float], length: float) -> Triangles:
    """A cylinder along z from a point, m."""
    corners, faces = mesh_solid(hf.cell.Cylinder("rod", radius, length), 1.0)
    return (corners + np.asarray(begin) + [0, 0, length / 2])[faces]


def cell_bodies(cell: hf.Cell) -> list[Triangles]:
    """The objects of a cell, in the world."""
    found = []
    for solid in cell:
        corners, faces = mesh_solid(solid, 1.0)
        found.append((corners @ solid.pose[:3, :3].T + solid.pose[:3, 3])[faces])
    return found


def moved(triangles: Triangles, frame: Array) -> Triangles:
    """The same where a frame (4, 4) is."""
    return triangles @ frame[:3, :3].T + frame[:3, 3]


def draw(axes: Axes, view: View, bodies: Sequence[tuple[Triangles, str]]) -> None:
    """Draw bodies (triangles in the world, a colour each) as they are seen."""
    toward = np.cross(view.right, view.up)
    triangles, colors = [], []
    for given, color in bodies:
        pieces = split_triangles(given, _SPLIT)
        normal = np.cross(pieces[:, 1] - pieces[:, 0], pieces[:, 2] - pieces[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        near = normal @ toward > 0  # triangles wind outward, so the others are at the back
        pieces, normal = pieces[near], normal[near]
        light = _DARKEST + (1 - _DARKEST) * np.clip(normal @ _LIGHT / np.linalg.norm(_LIGHT), 0, 1)
        triangles.append(pieces)
        colors.append(np.array(to_rgb(color)) * light[:, None])
    every, shades = np.concatenate(triangles), np.concatenate(colors)
    order = np.argsort(every.mean(axis=1) @ toward)
    axes.add_collection(
        PolyCollection(view.project(every[order]), facecolors=shades[order], edgecolors=shades[order], linewidths=0.6)
    )
