"""Capsules as chains of spheres that cover them: what a compiled bound looks at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.capsules import Capsules

Array = NDArray[np.float64]

WIDER = 0.06  # of the radius of a capsule: what the spheres of its chain may reach beyond it
_MOST = 64  # spheres of one capsule


@dataclass(frozen=True, eq=False)
class Balls:
    """Spheres that move with the links of an arm.

    Attributes:
        link: (S,) the joint that moves each, from 0; -1 for the base. Ascending.
        centre: (S, 3) m, in the frame that moves with that joint.
        radius: (S,) m.
        part: (S,) position in ``capsules.parts`` of the capsule that it helps to cover.
    """

    link: NDArray[np.int64]
    centre: Array
    radius: Array
    part: NDArray[np.int64]


def spheres_of(capsules: Capsules, wider: float = WIDER) -> Balls:
    """Spheres that together contain every capsule.

    A capsule from a to b of radius r lies in the k + 1 spheres about ``a + (b - a) i / k``, both ends included, of radius
    ``hypot(r, |b - a| / (2 k))``; k is the least with which that is at most ``(1 + wider) r``.
    """
    rows: list[tuple[int, Array, float, int]] = []
    for number, part in sorted(enumerate(capsules.parts), key=lambda item: item[1].link):
        start, span = np.array(part.start), np.subtract(part.end, part.start)
        half = part.length / 2
        room = part.radius * np.sqrt((1 + wider) ** 2 - 1)
        k = 0 if half == 0 else int(min(np.ceil(half / room), _MOST))
        radius = float(np.hypot(part.radius, half / k)) if k else part.radius
        rows += [(part.link, start + span * (i / k if k else 0.0), radius, number) for i in range(k + 1)]
    return Balls(
        np.array([row[0] for row in rows], dtype=np.int64),
        np.array([row[1] for row in rows]).reshape(-1, 3),
        np.array([row[2] for row in rows]),
        np.array([row[3] for row in rows], dtype=np.int64),
    )
