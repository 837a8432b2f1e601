"""Rigid bodies as they are: what exact questions are asked about, on the links of an arm and in its cell."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from holdfast.caching import cached_property
from holdfast.cell import solids
from holdfast.cell.meshes import Mesh, Points
from holdfast.clearance.capsules import Capsule
from holdfast.clearance.shape import corners, hull_of
from holdfast.kernels.recall import recalled_data
from holdfast.shapes.pieces import Piece

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]
Kind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid", "convex", "mesh"]

_CONVEX = 1e-9  # of its hull's volume: what a closed mesh may lack of it and still be its hull
_GRID = 14  # points along the longest edge of a hull, among which centres of spheres within it are looked for
_WITHIN = 4  # spheres within a hull, at most
_IN_OBJECTS = 2  # of those, of an object
_THINNEST = 1e-9  # m: a box has edges


def _nothing() -> Array:
    return np.zeros((0, 3))


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """A rigid body.

    Attributes:
        kind: What it is; ``convex`` is the hull of its vertices, ``mesh`` all that its triangles enclose.
        size: m. A box: (3,) full sizes. A cylinder or capsule along z: radius and length, that of a capsule between the
            centres of its ends. A sphere: its radius. An ellipsoid: (3,) half axes. Nothing of the others.
        pose: (4, 4) of its own frame in that of its link, or in the world.
        vertices: (V, 3) m, in its own frame, of a hull or mesh.
        faces: (F, 3) positions in them, counterclockwise seen from outside.
        filled: The mesh itself, in the same frame, where this is its hull and fills a little of it; else None.
    """

    kind: Kind
    size: tuple[float, ...] = ()
    pose: Array = field(default_factory=lambda: np.eye(4))
    vertices: Array = field(default_factory=_nothing)
    faces: Triangles = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    filled: Body | None = None

    def support(self, direction: Array) -> float:
        """How far it reaches along a direction (3,), m; both in its own frame, as everything below."""
        if self.kind in ("convex", "mesh"):
            return float((self.vertices @ direction).max())
        if self.kind == "box":
            return float(np.abs(direction) @ np.array(self.size) / 2)
        if self.kind == "ellipsoid":
            return float(np.linalg.norm(direction * np.array(self.size)))
        radius, length = (*self.size, 0.0)[:2]
        wide = np.hypot(direction[0], direction[1]) if self.kind == "cylinder" else np.linalg.norm(direction)
        return float(radius * wide + abs(direction[2]) * length / 2)

    @property
    def formula(self) -> solids.Primitive | None:
        """What has the same signed distance, if there is a formula."""
        if self.kind == "box":
            return solids.Box("", np.array(self.size))
        if self.kind == "sphere":
            return solids.Sphere("", *self.size)
        kinds = {"cylinder": solids.Cylinder, "capsule": solids.Capsule}
        return kinds[self.kind]("", *self.size) if self.kind in kinds else None

    @cached_property
    def planes(self) -> tuple[Array, Array]:
        """Outward unit normals (F, 3) and offsets (F,), m, of the faces of a box or hull."""
        if self.kind == "box":
            half = np.array(self.size) / 2
            return np.concatenate([np.eye(3), -np.eye(3)]), np.concatenate([half, half])
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return normal, np.asarray((normal @ self.vertices.T).max(axis=1))

    @cached_property
    def inside(self) -> tuple[Array, Array]:
        """Centres (S, 3) and radii (S,), m, of spheres that lie within it; none of a mesh."""
        if self.kind == "mesh":
            return _nothing(), np.zeros(0)
        if self.kind in ("box", "convex"):
            balls = np.array(_spheres_within(*self.planes, self._corners())).reshape(-1, 4)
            return (balls[:, :3], balls[:, 3]) if self.filled is None else self.filled.spheres_within(balls)
        if self.kind == "ellipsoid":
            return np.zeros((1, 3)), np.array([min(self.size)])
        radius, length = (*self.size, 0.0)[:2]
        if self.kind == "cylinder":
            radius = min(radius, length / 2)
            length -= 2 * radius
        heights = np.linspace(-length / 2, length / 2, min(int(np.ceil(length / radius)) + 1, _WITHIN))
        return np.column_stack([np.zeros((len(heights), 2)), heights]), np.full(len(heights), radius)

    def spheres_within(self, balls: Array) -> tuple[Array, Array]:
        """Centres (S, 3) and radii (S,), m, of balls (N, 4) that are inside a mesh, each shrunk until it lies within."""
        enclosed = balls[[self.encloses(ball[:3]) for ball in balls]]
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        room = np.array([_distance_to_triangles(ball[:3], a, b, c) for ball in enclosed])
        return enclosed[:, :3], np.minimum(enclosed[:, 3], room)

    def _corners(self) -> Array:
        if self.kind == "box":
            return np.array(list(product((-0.5, 0.5), repeat=3))) * self.size
        return self.vertices

    @cached_property
    def ball(self) -> tuple[Array, float]:
        """Centre (3,) and radius, m, of a ball that contains it."""
        if self.kind in ("convex", "mesh"):
            centre = (self.vertices.max(axis=0) + self.vertices.min(axis=0)) / 2
            return centre, float(np.linalg.norm(self.vertices - centre, axis=1).max())
        return np.zeros(3), float(np.linalg.norm([self.support(axis) for axis in np.eye(3)]))

    @property
    def point(self) -> Array:
        """(3,) any point of it."""
        return np.asarray(self.vertices[0]) if self.kind in ("convex", "mesh") else np.zeros(3)

    def encloses(self, point: Array) -> bool:
        """Whether a point (3,) lies within a mesh.

        The solid angle of all its triangles is 4 pi from within and 0 from outside (van Oosterom & Strackee 1983).
        """
        if (point < self.vertices.min(axis=0)).any() or (point > self.vertices.max(axis=0)).any():
            return False
        a, b, c = (self.vertices[self.faces[:, k]] - point for k in range(3))
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        above, below = np.einsum("ij,ij->i", a, np.cross(b, c)), la * lb * lc
        for x, y, far in ((a, b, lc), (b, c, la), (c, a, lb)):
            below += np.einsum("ij,ij->i", x, y) * far
        return bool(2 * np.arctan2(above, below).sum() > 2 * np.pi)


def of_capsule(part: Capsule) -> Body:
    """A capsule of a link; a sphere where it has no length."""
    start, span = np.array(part.start), np.subtract(part.end, part.start)
    pose = np.eye(4)
    pose[:3, 3] = start + span / 2
    if part.length == 0:
        return Body(kind="sphere", size=(part.radius,), pose=pose)
    z = span / part.length
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    pose[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return Body(kind="capsule", size=(part.radius, part.length), pose=pose)


def of_solid(solid: solids.Solid) -> Body:
    """A bounded object of a cell."""
    if isinstance(solid, solids.Box):
        return Body(kind="box", size=tuple(solid.size.tolist()), pose=solid.pose)
    if isinstance(solid, solids.Cylinder):
        return Body(kind="cylinder", size=(solid.radius, solid.length), pose=solid.pose)
    if isinstance(solid, solids.Capsule):
        return Body(kind="capsule", size=(solid.radius, solid.length), pose=solid.pose)
    if isinstance(solid, solids.Sphere):
        return Body(kind="sphere", size=(solid.radius,), pose=solid.pose)
    assert isinstance(solid, Mesh)
    vertices, faces = solid.surface.vertices, solid.surface.faces
    convex = solid.solid == "hull" or abs(solid.surface.volume / ConvexHull(vertices).volume - 1) <= _CONVEX
    return Body(kind="convex" if convex else "mesh", pose=solid.pose, vertices=vertices, faces=faces)


def box_about(solid: solids.Solid) -> solids.Primitive:
    """An object that contains a given one and has a formula: itself if it has one, else a box in its own frame."""
    if isinstance(solid, solids.Primitive):
        return solid
    assert isinstance(solid, Mesh | Points)
    corners = solid.surface.vertices if isinstance(solid, Mesh) else solid.centres
    more = 0.0 if isinstance(solid, Mesh) else solid.radius
    low, high = corners.min(axis=0) - more, corners.max(axis=0) + more
    pose = solid.pose.copy()
    pose[:3, 3] += pose[:3, :3] @ ((low + high) / 2)
    return solids.Box(solid.name, np.maximum(high - low, _THINNEST), pose=pose)


def solids_within(solid: solids.Solid) -> list[solids.Primitive]:
    """Solids with a formula that lie within an object: itself if it has one, spheres within a hull, nothing else."""
    if isinstance(solid, solids.Primitive):
        return [solid]
    body = of_solid(solid) if isinstance(solid, Mesh) else None
    if body is None or body.kind != "convex":
        return []
    centres, radii = (x[:_IN_OBJECTS] for x in body.inside)
    pose = np.tile(body.pose, (len(radii), 1, 1))
    pose[:, :3, 3] += centres @ body.pose[:3, :3].T
    return [solids.Sphere("", radius, pose=at) for radius, at in zip(radii.tolist(), pose, strict=True)]


def of_piece(piece: Piece) -> Body:
    """A piece of a link.

    Raises:
        ArmError: A mesh is flat.
    """
    assert piece.kind != "half space"  # no link of an arm is one
    if piece.kind != "mesh":
        return Body(kind=piece.kind, size=piece.size, pose=piece.pose)
    hull = hull_of(piece)
    if hull.convex:
        mesh = Body(kind="mesh", vertices=corners(piece), faces=piece.faces)
        filled = None if hull.fills <= _CONVEX else mesh
        return Body(kind="convex", vertices=hull.vertices, faces=hull.faces, filled=filled)
    return Body(kind="mesh", pose=piece.pose, vertices=piece.vertices, faces=piece.faces)


def _distance_to_triangles(point: Array, a: Array, b: Array, c: Array) -> float:
    """The distance, m, of a point (3,) from the nearest of triangles with corners (F, 3)."""
    nearest = np.inf
    normal = np.cross(b - a, c - a)
    inside = np.ones(len(a), dtype=np.bool_)
    for start, end in ((a, b), (b, c), (c, a)):
        edge, away = end - start, point - start
        along = np.einsum("ij,ij->i", edge, away) / np.maximum(np.einsum("ij,ij->i", edge, edge), 1e-300)
        gap = away - np.clip(along, 0.0, 1.0)[:, None] * edge
        nearest = min(nearest, float(np.linalg.norm(gap, axis=1).min()))
        inside &= np.einsum("ij,ij->i", np.cross(edge, away), normal) >= 0
    size = np.linalg.norm(normal, axis=1)
    inside &= size > 0
    heights = np.abs(np.einsum("ij,ij->i", point - a, normal)[inside]) / size[inside]
    return min(nearest, float(heights.min(initial=np.inf)))


@recalled_data
def _spheres_within(normals: Array, offsets: Array, corners: Array) -> list[list[float]]:
    """Centres and radii, m, of spheres within a hull: each the one that covers most of what the others leave.

    They take 0.1 s a hull, and are remembered.
    """
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    counts = np.maximum(np.ceil(_GRID * size / size.max()).astype(int), 3)
    axes = [low[k] + size[k] * (np.arange(counts[k]) + 0.5) / counts[k] for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    room = (offsets - points @ normals.T).min(axis=1)
    points, room = points[room > 0], room[room > 0]
    if not len(points):
        return []
    covers = ((points[:, None] - points) ** 2).sum(axis=2) <= room[:, None] ** 2
    left, chosen = np.ones(len(points), dtype=np.bool_), list[int]()
    while len(chosen) < _WITHIN:
        best = int(np.argmax((covers & left).sum(axis=1) + 1e-3 * room / room.max()))
        if not (covers[best] & left).any():
            break
        chosen.append(best)
        left &= ~covers[best]
    found: list[list[float]] = np.column_stack([points[chosen], room[chosen]]).tolist()
    return found
