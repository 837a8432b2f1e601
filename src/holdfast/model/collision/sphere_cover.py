"""Capsules as chains of spheres that cover them, the geometry of the compiled distance bound."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.collision.capsules import Capsules

SPHERE_EXCESS_FRACTION = 0.06  # of the radius of a capsule: what the spheres of its chain may reach beyond it
_MAX_SPHERES = 64  # spheres of one capsule


@dataclass(frozen=True, eq=False)
class SphereCover:
    """Spheres that move with the links of an arm.

    Attributes:
        link: (S,) the joint that moves each, from 0; -1 for the base. Ascending.
        center: (S, 3) m, in the frame that moves with that joint.
        radius: (S,) m.
        part: (S,) position in ``capsules.parts`` of the capsule that it helps to cover.
    """

    link: IndexArray
    center: FloatArray
    radius: FloatArray
    part: IndexArray


def make_sphere_cover(capsules: Capsules, excess_fraction: float = SPHERE_EXCESS_FRACTION) -> SphereCover:
    """Make spheres that together contain every capsule.

    A capsule from a to b of radius r lies in the k + 1 spheres about ``a + (b - a) i / k``, both ends included, of radius
    ``hypot(r, |b - a| / (2 k))``; k is the least with which that is at most ``(1 + wider) r``.
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
