"""Chains of spheres that cover capsules, the geometry of the compiled distance bound."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.collision.capsules import Capsules

SPHERE_EXCESS_FRACTION = 0.06  # of the radius of a capsule: excess of the spheres of its chain
_MAX_SPHERES = 64  # maximum number of spheres for one capsule


@dataclass(frozen=True, eq=False)
class SphereCover:
    """Spheres that move with the links of an arm.

    Attributes:
        link: (S,) index from 0 of the joint that moves each sphere; -1 for the base. Ascending.
        center: (S, 3) centres in the frame that moves with that joint, m.
        radius: (S,) radii, m.
        part: (S,) position in ``capsules.parts`` of the capsule that the sphere helps to cover.
    """

    link: IndexArray
    center: FloatArray
    radius: FloatArray
    part: IndexArray


@lru_cache(maxsize=16)
def make_sphere_cover(capsules: Capsules, excess_fraction: float = SPHERE_EXCESS_FRACTION) -> SphereCover:
    """Make spheres that together contain every capsule.

    A capsule from a to b of radius r lies in the k + 1 spheres about ``a + (b - a) i / k``, both ends included, of radius
    ``hypot(r, |b - a| / (2 k))``; k is the smallest number for which that is at most ``(1 + excess_fraction) r``.
    """
    rows: list[tuple[int, FloatArray, float, int]] = []
    for number, part in sorted(enumerate(capsules.parts), key=lambda item: item[1].link):
        start, span = np.array(part.start), np.subtract(part.end, part.start)
        half_length = part.length / 2
        half_spacing = part.radius * np.sqrt((1 + excess_fraction) ** 2 - 1)
        interval_count = 0 if half_length == 0 else int(min(np.ceil(half_length / half_spacing), _MAX_SPHERES))
        radius = float(np.hypot(part.radius, half_length / interval_count)) if interval_count else part.radius
        rows += [
            (part.link, start + span * (index / interval_count if interval_count else 0.0), radius, number)
            for index in range(interval_count + 1)
        ]
    return SphereCover(
        np.array([row[0] for row in rows], dtype=np.int64),
        np.array([row[1] for row in rows]).reshape(-1, 3),
        np.array([row[2] for row in rows]),
        np.array([row[3] for row in rows], dtype=np.int64),
    )
