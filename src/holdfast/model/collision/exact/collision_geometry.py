"""Collision geometry that a part of an arm can touch: bodies and surfaces by a library, planes and point clouds by formulas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy.spatial import cKDTree

from holdfast.core.typing import FloatArray
from holdfast.model.cell.meshes import Points
from holdfast.model.cell.solids import HalfSpace, Solid
from holdfast.model.collision.exact.bodies import CollisionBody, body_from_solid
from holdfast.model.collision.exact.engines import CONTACT_DISTANCE_M, CollisionLibrary


@dataclass(eq=False)
class PlacedBody:
    """Body at a pose.

    Attributes:
        body: Body.
        library_body: Body of the library.
        rotation: (3, 3) rotation of its frame in the world.
        position: (3,) position of its frame, m.
    """

    body: CollisionBody
    library_body: Any
    rotation: FloatArray
    position: FloatArray

    def to_body_frame(self, points: FloatArray) -> FloatArray:
        """Return points (..., 3) of the world in the frame of the body."""
        return np.asarray((points - self.position) @ self.rotation)

    @property
    def any_point(self) -> FloatArray:
        """Any point (3,) of the body, in the world."""
        return np.asarray(self.position + self.rotation @ self.body.any_point)


class CollisionGeometry(Protocol):
    """Geometry that does not move with the queried part."""

    def bodies_touch(self, part: PlacedBody) -> bool:
        """Return True if the part touches the geometry."""

    def body_distance(self, part: PlacedBody) -> float:
        """Return the distance of the part, m; 0 in contact."""


class BodyGeometry:
    """Body on another link or in the cell.

    Args:
        engine: Collision library.
        placed: Body at its pose.
    """

    def __init__(self, engine: CollisionLibrary, placed: PlacedBody) -> None:
        self._engine, self.placed = engine, placed

    def bodies_touch(self, part: PlacedBody) -> bool:
        """Return True if the part touches the body; see :class:`CollisionGeometry`."""
        return self._engine.bodies_touch(part.library_body, self.placed.library_body) or self._is_one_inside_other(part)

    def body_distance(self, part: PlacedBody) -> float:
        """Return the distance of the part from the body, m; see :class:`CollisionGeometry`."""
        # Inside a mesh and far from its surface a library finds no contact.
        distance = self._engine.body_distance(part.library_body, self.placed.library_body)
        return 0.0 if distance < CONTACT_DISTANCE_M or self._is_one_inside_other(part) else distance

    def _is_one_inside_other(self, part: PlacedBody) -> bool:
        """Return True if one of the two is a mesh that contains the other, so that their surfaces need not meet."""
        if part.body.kind != "mesh" != self.placed.body.kind:
            return False
        body_pairs = (self.placed, part), (part, self.placed)
        return any(
            outer.body.kind == "mesh" and outer.body.contains_point(outer.to_body_frame(inner.any_point))
            for outer, inner in body_pairs
        )


class HalfSpaceGeometry:
    """Half space below a plane.

    Args:
        solid: Half space.
    """

    def __init__(self, solid: HalfSpace) -> None:
        self._normal, self._origin = solid.pose[:3, 2], solid.pose[:3, 3]

    def bodies_touch(self, part: PlacedBody) -> bool:
        """Return True if the part touches the half space; see :class:`CollisionGeometry`."""
        return self.body_distance(part) == 0

    def body_distance(self, part: PlacedBody) -> float:
        """Return the distance of the part from the half space, m; see :class:`CollisionGeometry`."""
        gap = float(self._normal @ (part.position - self._origin)) - part.body.support_distance(-self._normal @ part.rotation)
        return gap if gap >= CONTACT_DISTANCE_M else 0.0


class PointCloudGeometry:
    """Balls of one radius around many points.

    Args:
        engine: Library for the distance of points from hulls and meshes.
        solid: Cloud of points.
    """

    def __init__(self, engine: CollisionLibrary, solid: Points) -> None:
        self._engine, self._radius = engine, solid.radius
        self._points = solid.centres @ solid.pose[:3, :3].T + solid.pose[:3, 3]
        self._tree = cKDTree(self._points)
        self._ball = engine.make_body(CollisionBody(kind="sphere", size=(solid.radius,)))

    def bodies_touch(self, part: PlacedBody) -> bool:
        """Return True if the part touches a ball; see :class:`CollisionGeometry`."""
        return self._nearest_ball_distance(part, CONTACT_DISTANCE_M, sign_only=True) < CONTACT_DISTANCE_M

    def body_distance(self, part: PlacedBody) -> float:
        """Return the distance of the part from the nearest ball, m; see :class:`CollisionGeometry`."""
        # No ball is nearer than the ball about the point that is nearest to the middle, and that ball is no farther than this.
        middle, part_radius = part.body.bounding_sphere
        center_distance = float(self._tree.query(part.position + part.rotation @ middle)[0])
        distance = self._nearest_ball_distance(part, center_distance + part_radius)
        return distance if distance >= CONTACT_DISTANCE_M else 0.0

    def _nearest_ball_distance(self, part: PlacedBody, max_distance: float, *, sign_only: bool = False) -> float:
        """Return the distance of the nearest ball, m, below ``max_distance``; with ``sign_only`` only whether it is >= 0."""
        middle, part_radius = part.body.bounding_sphere
        candidates = self._tree.query_ball_point(
            part.position + part.rotation @ middle, part_radius + self._radius + max_distance
        )
        points = self._points[candidates]
        lower_bounds = self._lower_bounds(part, points)
        if part.body.exact_primitive is not None:
            return float(lower_bounds.min(initial=np.inf))
        smallest = max_distance
        for index in np.argsort(lower_bounds):
            if lower_bounds[index] >= smallest:
                break
            if part.body.kind == "mesh" and part.body.contains_point(part.to_body_frame(points[index])):
                return 0.0
            self._engine.place_body(self._ball, np.eye(3), points[index])
            if sign_only:
                if self._engine.bodies_touch(part.library_body, self._ball):
                    return 0.0
            else:
                smallest = min(smallest, self._engine.body_distance(part.library_body, self._ball))
                if smallest < CONTACT_DISTANCE_M:
                    return 0.0
        return smallest

    def _lower_bounds(self, part: PlacedBody, points: FloatArray) -> FloatArray:
        """Return lower bounds (N,) of the distances of balls around points (N, 3), m; exact if there is a formula."""
        local_points = part.to_body_frame(points)
        if part.body.exact_primitive is not None:
            return np.asarray(part.body.exact_primitive.signed_distance(local_points) - self._radius)
        if part.body.kind == "convex":
            normals, offsets = part.body.face_planes
            return np.asarray((local_points @ normals.T - offsets).max(axis=1) - self._radius)
        middle, part_radius = part.body.bounding_sphere
        return np.asarray(np.linalg.norm(local_points - middle, axis=1) - part_radius - self._radius)


def geometry_of_object(engine: CollisionLibrary, solid: Solid) -> CollisionGeometry:
    """Return the collision geometry of an object of a cell."""
    if isinstance(solid, HalfSpace):
        return HalfSpaceGeometry(solid)
    if isinstance(solid, Points):
        return PointCloudGeometry(engine, solid)
    return BodyGeometry(engine, place_fixed_body(engine, body_from_solid(solid)))


def place_fixed_body(engine: CollisionLibrary, body: CollisionBody) -> PlacedBody:
    """Place a body permanently in the world."""
    placed = PlacedBody(body, engine.make_body(body), body.pose[:3, :3], body.pose[:3, 3])
    engine.place_body(placed.library_body, placed.rotation, placed.position)
    return placed
