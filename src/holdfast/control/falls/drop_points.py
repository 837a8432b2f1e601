"""Points of an arm whose displacement along gravity is the drop of a fall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Self

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.collision.capsules import BASE_LINK, Capsules, Point

DropOf = Literal["tool", "any point"]


@dataclass(frozen=True)
class DropPoints:
    """Points that move with the links of an arm.

    Attributes:
        links: (P,) index from 0 of the joint that moves each point. Ascending.
        positions: (P,) points in the frame that moves with that joint, m.
    """

    links: tuple[int, ...]
    positions: tuple[Point, ...]

    @classmethod
    def choose(cls, arm: Arm, of: DropOf = "tool", capsules: Capsules | None = None) -> Self:
        """Return the tool point, or the points of ``"any point"``: the tool point and the ends of the axes of all capsules.

        On a straight axis, the largest displacement along a direction is that of an end. So no sphere of the cover of the
        capsules drops further than these points, because its center is on an axis.

        Raises:
            InputError: ``of`` is another text.
        """
        if of not in ("tool", "any point"):
            raise InputError(f"of is '{of}'; use 'tool' or 'any point'")
        x, y, z = map(float, arm.tool[:3, 3])
        points = {(arm.n - 1, (x, y, z))}
        if of == "any point":
            from holdfast.model.collision.cover import choose_capsules  # slow to import

            parts = choose_capsules(arm) if capsules is None else capsules
            points |= {(part.link, end) for part in parts if part.link != BASE_LINK for end in (part.start, part.end)}
        return cls(*zip(*sorted(points), strict=True))

    def depths(self, arm: Arm, q: FloatArray) -> FloatArray:
        """Return the coordinates (..., P) of the points along gravity, m, in configurations (..., n)."""
        frames = arm.frames(q.reshape(-1, arm.n))[:, np.add(self.links, 1)]
        points = np.einsum("nkij,kj->nki", frames[..., :3, :3], np.array(self.positions)) + frames[..., :3, 3]
        return np.asarray(points @ arm.down).reshape(*q.shape[:-1], len(self.links))

    def drops(self, arm: Arm, start: FloatArray, q: FloatArray) -> FloatArray:
        """Return the displacements (...) along gravity, m, of the points that drop most from ``start`` (..., n) to ``q``."""
        return np.asarray((self.depths(arm, q) - self.depths(arm, start)).max(axis=-1))
