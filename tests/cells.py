"""Cells for tests, and what coal and plane geometry say of arms within them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere


def placed(x: float, y: float, z: float) -> np.ndarray:
    """A pose (4, 4) without a turn."""
    return oracles.pose(position=(x, y, z))


def bench() -> hf.Cell:
    """A table with things on it around the base of a Panda, none of which touches its base."""
    return hf.Cell(
        [
            Box("table", [0.8, 1.2, 0.04], pose=placed(0.6, 0, 0.0)),
            Cylinder("post", 0.05, 1.0, pose=placed(0.2, 0.55, 0.5)),
            Sphere("ball", 0.12, pose=placed(0.45, 0.35, 0.8), margin=0.02),
            Capsule("pipe", 0.04, 0.6, pose=placed(0.35, -0.45, 0.5)),
            HalfSpace("ground", pose=placed(0, 0, -0.5)),
            Box("wall", [0.04, 2.0, 2.0], pose=placed(-0.65, 0, 0.5)),
        ],
        name="bench",
        margin=0.005,
    )


def finely(q: np.ndarray, step: float = 2e-3) -> np.ndarray:
    """Configurations on the way through q (K, n), at most a step apart in each joint."""
    parts = [q[:1]]
    for a, b in pairwise(q):
        count = int(np.ceil(np.abs(b - a).max() / step)) + 1
        parts.append(a + (np.arange(1, count + 1) / count)[:, None] * (b - a))
    return np.concatenate(parts)


def _shape(coal, solid: Solid):
    if isinstance(solid, Box):
        return coal.Box(*(float(x) for x in solid.size))
    if isinstance(solid, Cylinder | Capsule):
        return getattr(coal, type(solid).__name__)(solid.radius, solid.length)
    return coal.Sphere(solid.radius) if isinstance(solid, Sphere) else coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)


def touches(arm: hf.Arm, capsules: hf.Capsules, cell: hf.Cell, q: np.ndarray) -> np.ndarray:
    """(N, K) whether coal sees the capsules of the moving links, not their spheres, in collision with each object."""
    coal = pytest.importorskip("coal")
    parts = [p for p in capsules if p.link >= 0]
    shapes = [coal.Capsule(p.radius, p.length) if p.length else coal.Sphere(p.radius) for p in parts]
    things = [(_shape(coal, s), coal.Transform3s(s.pose[:3, :3], s.pose[:3, 3])) for s in cell]
    own = []
    for p in parts:
        span = np.subtract(p.end, p.start)
        z = span / p.length if p.length else np.array([0.0, 0.0, 1.0])
        x = np.cross(np.eye(3)[np.abs(z).argmin()], z)
        x /= np.linalg.norm(x)
        own.append(oracles.pose(np.column_stack([x, np.cross(z, x), z]), np.array(p.start) + span / 2))
    frames = oracles.frames(arm, q)
    out = np.zeros((len(q), len(things)), dtype=bool)
    ask, told = coal.CollisionRequest(), coal.CollisionResult()
    for part, shape, mine in zip(parts, shapes, own, strict=True):
        moved = frames[part.link + 1] @ mine
        for i, pose in enumerate(moved):
            place = coal.Transform3s(pose[:3, :3], pose[:3, 3])
            for k, (thing, where) in enumerate(things):
                if not out[i, k]:
                    told.clear()
                    out[i, k] = coal.collide(shape, place, thing, where, ask, told) > 0
    return out


def from_disc(lengths, radius: float, q: np.ndarray, centre, disc: float) -> np.ndarray:
    """(N,) distance of the links of a planar arm, ``radius`` thick, from a disc in its plane."""
    angles = np.cumsum(q, axis=1)
    start, least = np.zeros((len(q), 2)), np.full(len(q), np.inf)
    for length, angle in zip(lengths, angles.T, strict=True):
        span = length * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        share = np.clip(((centre - start) * span).sum(axis=1) / length**2, 0, 1)
        np.minimum(least, np.linalg.norm(start + share[:, None] * span - centre, axis=1), out=least)
        start = start + span
    return least - radius - disc
