"""Rigid bodies on the links of an arm and in its cell, as the exact collision queries use them."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_json
from holdfast.model.cell import solids
from holdfast.model.cell.meshes import Mesh, Points
from holdfast.model.collision.capsules import LinkCapsule
from holdfast.model.collision.shape import corner_points, make_hull
from holdfast.model.shapes.pieces import Piece

Triangles = NDArray[np.int64]
Kind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid", "convex", "mesh"]

_CONVEX_TOLERANCE = 1e-9  # relative to its hull's volume: a closed mesh may lack this volume and still count as its hull
_GRID_POINTS = 14  # points along the longest edge of a hull, among which centres of inner spheres are searched
_MAX_INNER_SPHERES = 4  # maximum number of spheres inside a hull
_MAX_OBJECT_SPHERES = 2  # maximum number of spheres inside an object
_MIN_EDGE_M = 1e-9  # m: shortest edge of a box


def _empty_points() -> FloatArray:
    return np.zeros((0, 3))


@dataclass(frozen=True, eq=False, kw_only=True)
class CollisionBody:
    """Rigid body.

    Attributes:
        kind: Kind of the body; ``convex`` is the hull of its vertices, ``mesh`` the volume that its triangles enclose.
        size: Size, m. A box: (3,) full sizes. A cylinder or capsule along z: radius and length, for a capsule between the
            centres of its ends. A sphere: its radius. An ellipsoid: (3,) half axes. Empty for other kinds.
        pose: (4, 4) pose of its own frame in that of its link, or in the world, m.
        vertices: (V, 3) vertices of a hull or mesh in its own frame, m.
        faces: (F, 3) row numbers of the corners, counterclockwise seen from outside.
        filled: Original mesh in the same frame if this body is its hull and fills a little of it; else None.
    """

    kind: Kind
    size: tuple[float, ...] = ()
    pose: FloatArray = field(default_factory=lambda: np.eye(4))
    vertices: FloatArray = field(default_factory=_empty_points)
    faces: Triangles = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    filled: CollisionBody | None = None

    def support_distance(self, direction: FloatArray) -> float:
        """Return the extent of the body along a direction (3,), m; both in the body's own frame, as in all other methods."""
        if self.kind in ("convex", "mesh"):
            return float((self.vertices @ direction).max())
        if self.kind == "box":
            return float(np.abs(direction) @ np.array(self.size) / 2)
        if self.kind == "ellipsoid":
            return float(np.linalg.norm(direction * np.array(self.size)))
        radius, length = (*self.size, 0.0)[:2]
        radial_scale = np.hypot(direction[0], direction[1]) if self.kind == "cylinder" else np.linalg.norm(direction)
        return float(radius * radial_scale + abs(direction[2]) * length / 2)

    @property
    def exact_primitive(self) -> solids.PrimitiveSolid | None:
        """Primitive with the same signed distance, if there is a formula."""
        if self.kind == "box":
            return solids.Box("", np.array(self.size))
        if self.kind == "sphere":
            return solids.Sphere("", *self.size)
        kinds = {"cylinder": solids.Cylinder, "capsule": solids.Capsule}
        return kinds[self.kind]("", *self.size) if self.kind in kinds else None

    @cached_property
    def face_planes(self) -> tuple[FloatArray, FloatArray]:
        """Outward unit normals (F, 3) and offsets (F,), m, of the faces of a box or hull."""
        if self.kind == "box":
            half_size = np.array(self.size) / 2
            return np.concatenate([np.eye(3), -np.eye(3)]), np.concatenate([half_size, half_size])
        first, second, third = (self.vertices[self.faces[:, corner]] for corner in range(3))
        normal = np.cross(second - first, third - first)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return normal, np.asarray((normal @ self.vertices.T).max(axis=1))

    @cached_property
    def inner_spheres(self) -> tuple[FloatArray, FloatArray]:
        """Centers (S, 3) and radii (S,), m, of spheres inside the body; none for a mesh."""
        if self.kind == "mesh":
            return _empty_points(), np.zeros(0)
        if self.kind in ("box", "convex"):
            corners = np.array(list(product((-0.5, 0.5), repeat=3))) * self.size if self.kind == "box" else self.vertices
            spheres = np.array(_fit_inner_spheres(*self.face_planes, corners)).reshape(-1, 4)
            return (spheres[:, :3], spheres[:, 3]) if self.filled is None else self.filled.shrink_spheres(spheres)
        if self.kind == "ellipsoid":
            return np.zeros((1, 3)), np.array([min(self.size)])
        radius, length = (*self.size, 0.0)[:2]
        if self.kind == "cylinder":
            radius = min(radius, length / 2)
            length -= 2 * radius
        heights = np.linspace(-length / 2, length / 2, min(int(np.ceil(length / radius)) + 1, _MAX_INNER_SPHERES))
        return np.column_stack([np.zeros((len(heights), 2)), heights]), np.full(len(heights), radius)

    def shrink_spheres(self, spheres: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return centers (S, 3) and radii (S,), m, of balls (N, 4) centered in a mesh, each shrunk until it lies inside."""
        enclosed = spheres[[self.contains_point(sphere[:3]) for sphere in spheres]]
        first, second, third = (self.vertices[self.faces[:, corner]] for corner in range(3))
        distances = np.array([_distance_to_triangles(sphere[:3], first, second, third) for sphere in enclosed])
        return enclosed[:, :3], np.minimum(enclosed[:, 3], distances)

    @cached_property
    def bounding_sphere(self) -> tuple[FloatArray, float]:
        """Center (3,) and radius, m, of a ball that contains the body."""
        if self.kind in ("convex", "mesh"):
            center = (self.vertices.max(axis=0) + self.vertices.min(axis=0)) / 2
            return center, float(np.linalg.norm(self.vertices - center, axis=1).max())
        return np.zeros(3), float(np.linalg.norm([self.support_distance(axis) for axis in np.eye(3)]))

    @property
    def any_point(self) -> FloatArray:
        """Any point (3,) of the body."""
        return np.asarray(self.vertices[0]) if self.kind in ("convex", "mesh") else np.zeros(3)

    def contains_point(self, point: FloatArray) -> bool:
        """Return True if a point (3,) lies inside a mesh.

        The solid angle of all its triangles is 4 pi from inside and 0 from outside (van Oosterom & Strackee 1983).
        """
        if (point < self.vertices.min(axis=0)).any() or (point > self.vertices.max(axis=0)).any():
            return False
        first, second, third = (self.vertices[self.faces[:, corner]] - point for corner in range(3))
        first_length, second_length, third_length = (np.linalg.norm(left_edge, axis=1) for left_edge in (first, second, third))
        numerator = np.einsum("ij,ij->i", first, np.cross(second, third))
        denominator = first_length * second_length * third_length
        for left_edge, right_edge, opposite_length in (
            (first, second, third_length),
            (second, third, first_length),
            (third, first, second_length),
        ):
            denominator += np.einsum("ij,ij->i", left_edge, right_edge) * opposite_length
        return bool(2 * np.arctan2(numerator, denominator).sum() > 2 * np.pi)


def body_from_capsule(part: LinkCapsule) -> CollisionBody:
    """Make the body of a link's capsule; a sphere if it has length 0."""
    start, span = np.array(part.start), np.subtract(part.end, part.start)
    pose = np.eye(4)
    pose[:3, 3] = start + span / 2
    if part.length == 0:
        return CollisionBody(kind="sphere", size=(part.radius,), pose=pose)
    axis = span / part.length
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.linalg.norm(across)
    pose[:3, :3] = np.column_stack([across, np.cross(axis, across), axis])
    return CollisionBody(kind="capsule", size=(part.radius, part.length), pose=pose)


def body_from_solid(solid: solids.Solid) -> CollisionBody:
    """Make the body of a bounded object of a cell."""
    if isinstance(solid, solids.Box):
        return CollisionBody(kind="box", size=tuple(solid.size.tolist()), pose=solid.pose)
    if isinstance(solid, solids.Cylinder):
        return CollisionBody(kind="cylinder", size=(solid.radius, solid.length), pose=solid.pose)
    if isinstance(solid, solids.Capsule):
        return CollisionBody(kind="capsule", size=(solid.radius, solid.length), pose=solid.pose)
    if isinstance(solid, solids.Sphere):
        return CollisionBody(kind="sphere", size=(solid.radius,), pose=solid.pose)
    assert isinstance(solid, Mesh)
    vertices, faces = solid.surface.vertices, solid.surface.faces
    convex = solid.solid == "hull" or abs(solid.surface.volume / ConvexHull(vertices).volume - 1) <= _CONVEX_TOLERANCE
    return CollisionBody(kind="convex" if convex else "mesh", pose=solid.pose, vertices=vertices, faces=faces)


def bounding_primitive(solid: solids.Solid) -> solids.PrimitiveSolid:
    """Return an object with a formula that contains a given object: itself if it has a formula, else a box in its frame."""
    if isinstance(solid, solids.PrimitiveSolid):
        return solid
    assert isinstance(solid, Mesh | Points)
    corners = solid.surface.vertices if isinstance(solid, Mesh) else solid.centres
    point_radius = 0.0 if isinstance(solid, Mesh) else solid.radius
    lower, upper = corners.min(axis=0) - point_radius, corners.max(axis=0) + point_radius
    pose = solid.pose.copy()
    pose[:3, 3] += pose[:3, :3] @ ((lower + upper) / 2)
    return solids.Box(solid.name, np.maximum(upper - lower, _MIN_EDGE_M), pose=pose)


def inner_primitives(solid: solids.Solid) -> list[solids.PrimitiveSolid]:
    """Return solids with a formula inside an object: itself if it has a formula, spheres for a hull, else nothing."""
    if isinstance(solid, solids.PrimitiveSolid):
        return [solid]
    body = body_from_solid(solid) if isinstance(solid, Mesh) else None
    if body is None or body.kind != "convex":
        return []
    centers, radii = (values[:_MAX_OBJECT_SPHERES] for values in body.inner_spheres)
    pose = np.tile(body.pose, (len(radii), 1, 1))
    pose[:, :3, 3] += centers @ body.pose[:3, :3].T
    return [solids.Sphere("", radius, pose=sphere_pose) for radius, sphere_pose in zip(radii.tolist(), pose, strict=True)]


def body_from_piece(piece: Piece) -> CollisionBody:
    """Make the body of a piece of a link.

    Raises:
        ArmError: A mesh is flat.
    """
    assert piece.kind != "half space"  # no link of an arm is one
    if piece.kind != "mesh":
        return CollisionBody(kind=piece.kind, size=piece.size, pose=piece.pose)
    hull = make_hull(piece)
    if hull.is_convex:
        mesh = CollisionBody(kind="mesh", vertices=corner_points(piece), faces=piece.faces)
        filled_mesh = None if hull.volume_error <= _CONVEX_TOLERANCE else mesh
        return CollisionBody(kind="convex", vertices=hull.vertices, faces=hull.faces, filled=filled_mesh)
    return CollisionBody(kind="mesh", pose=piece.pose, vertices=piece.vertices, faces=piece.faces)


def _distance_to_triangles(point: FloatArray, a: FloatArray, b: FloatArray, c: FloatArray) -> float:
    """Return the distance, m, of a point (3,) from the nearest of triangles with corners (F, 3)."""
    nearest = np.inf
    normal = np.cross(b - a, c - a)
    inside = np.ones(len(a), dtype=np.bool_)
    for start, end in ((a, b), (b, c), (c, a)):
        edge, offset = end - start, point - start
        fraction = np.einsum("ij,ij->i", edge, offset) / np.maximum(np.einsum("ij,ij->i", edge, edge), 1e-300)
        gap = offset - np.clip(fraction, 0.0, 1.0)[:, None] * edge
        nearest = min(nearest, float(np.linalg.norm(gap, axis=1).min()))
        inside &= np.einsum("ij,ij->i", np.cross(edge, offset), normal) >= 0
    normal_length = np.linalg.norm(normal, axis=1)
    inside &= normal_length > 0
    heights = np.abs(np.einsum("ij,ij->i", point - a, normal)[inside]) / normal_length[inside]
    return min(nearest, float(heights.min(initial=np.inf)))


@cached_json
def _fit_inner_spheres(normals: FloatArray, offsets: FloatArray, corners: FloatArray) -> list[list[float]]:
    """Fit spheres inside a hull, centers and radii in m; each one covers most of the volume that the others leave.

    They take 0.1 s per hull and are cached.
    """
    lower, size = corners.min(axis=0), np.ptp(corners, axis=0)
    counts = np.maximum(np.ceil(_GRID_POINTS * size / size.max()).astype(int), 3)
    axes = [lower[axis] + size[axis] * (np.arange(counts[axis]) + 0.5) / counts[axis] for axis in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    radii = (offsets - points @ normals.T).min(axis=1)
    points, radii = points[radii > 0], radii[radii > 0]
    if not len(points):
        return []
    covers = ((points[:, None] - points) ** 2).sum(axis=2) <= radii[:, None] ** 2
    uncovered, chosen = np.ones(len(points), dtype=np.bool_), list[int]()
    while len(chosen) < _MAX_INNER_SPHERES:
        best_point = int(np.argmax((covers & uncovered).sum(axis=1) + 1e-3 * radii / radii.max()))
        if not (covers[best_point] & uncovered).any():
            break
        chosen.append(best_point)
        uncovered &= ~covers[best_point]
    spheres: list[list[float]] = np.column_stack([points[chosen], radii[chosen]]).tolist()
    return spheres
