"""What a part of an arm can touch, asked exactly: bodies and surfaces by a library, planes and clouds of points by formulas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from holdfast.cell.meshes import Points
from holdfast.cell.solids import HalfSpace, Solid
from holdfast.clearance.exact.bodies import Body, of_solid
from holdfast.clearance.exact.engines import CONTACT, Engine

Array = NDArray[np.float64]


@dataclass(eq=False)
class Placed:
    """A body where it is.

    Attributes:
        body: What it is.
        made: The library's own.
        rotation: (3, 3) of its frame in the world.
        position: (3,) m.
    """

    body: Body
    made: Any
    rotation: Array
    position: Array

    def own(self, points: Array) -> Array:
        """Points (..., 3) of the world in its frame."""
        return np.asarray((points - self.position) @ self.rotation)

    @property
    def point(self) -> Array:
        """(3,) any point of it, in the world."""
        return np.asarray(self.position + self.rotation @ self.body.point)


class Opponent(Protocol):
    """What does not move with the part that is asked about."""

    def hits(self, part: Placed) -> bool:
        """Whether the part touches it."""

    def distance(self, part: Placed) -> float:
        """How far the part is away, m; 0 where it touches."""


class Another:
    """A body, on another link or in the cell.

    Args:
        engine: The library.
        placed: The body.
    """

    def __init__(self, engine: Engine, placed: Placed) -> None:
        self._engine, self.placed = engine, placed

    def hits(self, part: Placed) -> bool:
        """See :class:`Opponent`."""
        return self._engine.hits(part.made, self.placed.made) or self._within(part)

    def distance(self, part: Placed) -> float:
        """See :class:`Opponent`."""
        # Within a mesh and far from its surface a library sees no contact.
        found = self._engine.distance(part.made, self.placed.made)
        return 0.0 if found < CONTACT or self._within(part) else found

    def _within(self, part: Placed) -> bool:
        """Whether one of the two is a mesh that has the other within, so that their surfaces need not meet."""
        if part.body.kind != "mesh" != self.placed.body.kind:
            return False
        both = (self.placed, part), (part, self.placed)
        return any(a.body.kind == "mesh" and a.body.encloses(a.own(b.point)) for a, b in both)


class Plane:
    """Everything below a plane.

    Args:
        solid: The half space.
    """

    def __init__(self, solid: HalfSpace) -> None:
        self._normal, self._origin = solid.pose[:3, 2], solid.pose[:3, 3]

    def hits(self, part: Placed) -> bool:
        """See :class:`Opponent`."""
        return self.distance(part) == 0

    def distance(self, part: Placed) -> float:
        """See :class:`Opponent`."""
        gap = float(self._normal @ (part.position - self._origin)) - part.body.support(-self._normal @ part.rotation)
        return gap if gap >= CONTACT else 0.0


class Cloud:
    """Balls of one radius about many points.

    Args:
        engine: The library, for the distance of points from hulls and meshes.
        solid: The points.
    """

    def __init__(self, engine: Engine, solid: Points) -> None:
        self._engine, self._radius = engine, solid.radius
        self._points = solid.centres @ solid.pose[:3, :3].T + solid.pose[:3, 3]
        self._tree = cKDTree(self._points)
        self._ball = engine.make(Body(kind="sphere", size=(solid.radius,)))

    def hits(self, part: Placed) -> bool:
        """See :class:`Opponent`."""
        return self._nearest(part, CONTACT, signs=True) < CONTACT

    def distance(self, part: Placed) -> float:
        """See :class:`Opponent`."""
        # No ball is nearer than the one about the point that is nearest to the middle, and that one is no farther than this.
        middle, size = part.body.ball
        away = float(self._tree.query(part.position + part.rotation @ middle)[0])
        found = self._nearest(part, away + size)
        return found if found >= CONTACT else 0.0

    def _nearest(self, part: Placed, within: float, *, signs: bool = False) -> float:
        """Distance of the nearest ball, m, if that is less than ``within``; with ``signs`` only whether it is 0 or more."""
        middle, size = part.body.ball
        near = self._tree.query_ball_point(part.position + part.rotation @ middle, size + self._radius + within)
        points = self._points[near]
        bound = self._bounds(part, points)
        if part.body.formula is not None:
            return float(bound.min(initial=np.inf))
        best = within
        for k in np.argsort(bound):
            if bound[k] >= best:
                break
            if part.body.kind == "mesh" and part.body.encloses(part.own(points[k])):
                return 0.0
            self._engine.place(self._ball, np.eye(3), points[k])
            if signs:
                if self._engine.hits(part.made, self._ball):
                    return 0.0
            else:
                best = min(best, self._engine.distance(part.made, self._ball))
                if best < CONTACT:
                    return 0.0
        return best

    def _bounds(self, part: Placed, points: Array) -> Array:
        """(N,) lower bounds of the distances of balls about points (N, 3), m; exact where there is a formula."""
        own = part.own(points)
        if part.body.formula is not None:
            return np.asarray(part.body.formula.signed_distance(own) - self._radius)
        if part.body.kind == "convex":
            normals, offsets = part.body.planes
            return np.asarray((own @ normals.T - offsets).max(axis=1) - self._radius)
        middle, size = part.body.ball
        return np.asarray(np.linalg.norm(own - middle, axis=1) - size - self._radius)


def of_object(engine: Engine, solid: Solid) -> Opponent:
    """An object of a cell as an opponent."""
    if isinstance(solid, HalfSpace):
        return Plane(solid)
    if isinstance(solid, Points):
        return Cloud(engine, solid)
    return Another(engine, stood(engine, of_solid(solid)))


def stood(engine: Engine, body: Body) -> Placed:
    """A body of the world, placed once and for all."""
    placed = Placed(body, engine.make(body), body.pose[:3, :3], body.pose[:3, 3])
    engine.place(placed.made, placed.rotation, placed.position)
    return placed
