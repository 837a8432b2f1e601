"""Collision shapes of an arm from its file, as primitives, meshes and convex hulls of each link."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.shapes.pieces import Missing, Piece
from holdfast.model.shapes.reading import read_pieces, unchecked_pairs

Triangles = NDArray[np.int64]

_CYLINDER_SIDES = 32  # of the prism that replaces a cylinder
_CONVEX_TOLERANCE = 1e-3  # relative to its hull's volume: a mesh may lack this volume and still count as convex


@dataclass(frozen=True, eq=False, kw_only=True)
class PieceHull:
    """Convex body that contains one piece of a link.

    Attributes:
        link: Index from 0 of the joint that moves it; -1 for the base.
        owner: Name of the link in the file.
        name: Name of the piece: that of its mesh in the file, or its kind.
        vertices: (V, 3) corners, m, in the frame that moves with the joint.
        faces: (F, 3) row numbers of the corners, counterclockwise seen from outside.
        volume_error: Fraction of its volume that the piece lacks; 0 unless the piece is a mesh.
    """

    link: int
    owner: str
    name: str
    vertices: FloatArray
    faces: Triangles
    volume_error: float

    @property
    def is_convex(self) -> bool:
        """True if the hull is the piece itself, to 0.1 % of its volume; a mesh that is not convex lies inside its hull."""
        return self.volume_error <= _CONVEX_TOLERANCE


@dataclass(frozen=True, eq=False, kw_only=True)
class CollisionModel:
    """Collision shapes of an arm.

    Attributes:
        pieces: Shapes in the order of the file, those of the base first.
        missing: Shapes that could not be read.
        unchecked: Pairs of links of the file, each in alphabetical order, that its SRDF file excludes from checks.
        source: File, for people.
    """

    pieces: tuple[Piece, ...]
    missing: tuple[Missing, ...]
    unchecked: frozenset[tuple[str, str]] = frozenset()
    source: str

    @classmethod
    @check_arguments
    def from_arm(cls, arm: Arm, meshes: str | Path | None = None, *, hold: Mapping[str, float] | None = None) -> CollisionModel:
        """Read the collision shapes in the arm's file; none if there is no file, or it has no shapes.

        Bodies attached to the chain belong to the link to which they are attached, with their own joints held.

        Args:
            arm: Arm model.
            meshes: Folder with the mesh files.
            hold: Values of joints next to the chain, rad or m; default: those with which the arm was read.

        Raises:
            ArmError: The file has changed since the arm was read, or ``hold`` does not fit it.
        """
        pieces, missing = read_pieces(arm, "collision", hold=hold, meshes=meshes)
        source = "" if arm.chain is None else Path(arm.chain.file).name
        ordered = tuple(sorted(pieces, key=lambda piece: piece.link))
        return cls(pieces=ordered, missing=tuple(missing), unchecked=unchecked_pairs(arm), source=source)

    def __len__(self) -> int:
        return len(self.pieces)

    @cached_property
    def hulls(self) -> tuple[PieceHull, ...]:
        """Convex hull around every piece, in order; round pieces have a polyhedron around them.

        Raises:
            ArmError: A mesh is flat.
        """
        return tuple(make_hull(piece) for piece in self.pieces)

    @cached_property
    def digest(self) -> str:
        """SHA-256 of every piece, with the corners of meshes."""
        hasher = hashlib.sha256()
        for piece in self.pieces:
            hasher.update(repr((piece.link, piece.owner, piece.kind, piece.size)).encode())
            for numbers in (piece.pose, piece.vertices, piece.faces):
                hasher.update(np.ascontiguousarray(numbers).tobytes())
        for shape in self.missing:
            hasher.update(repr((shape.link, shape.what)).encode())
        return hasher.hexdigest()


def make_hull(piece: Piece) -> PieceHull:
    """Make the convex hull of a piece, or of a polyhedron around it.

    Raises:
        ArmError: The piece is flat.
    """
    from scipy import spatial  # slow to import, and needed once for each shape

    vertices, faces = corner_points(piece), piece.faces
    try:
        qhull = spatial.ConvexHull(vertices)
    except (spatial.QhullError, ValueError) as error:
        raise ArmError(f"'{piece.name}' of link '{piece.owner}' is flat or has no volume; it cannot collide") from error
    order = np.full(len(vertices), -1)
    order[qhull.vertices] = np.arange(len(qhull.vertices))
    simplices = qhull.simplices.astype(np.int64)
    first, second, third = (vertices[simplices[:, corner]] for corner in range(3))
    inward = (np.cross(second - first, third - first) * qhull.equations[:, :3]).sum(axis=1) < 0
    triangles = np.where(inward[:, None], simplices[:, ::-1], simplices)
    volume_error = abs(_mesh_volume(vertices, faces) / qhull.volume - 1) if piece.kind == "mesh" else 0.0
    return PieceHull(
        link=piece.link,
        owner=piece.owner,
        name=piece.name,
        vertices=vertices[qhull.vertices],
        faces=order[triangles].astype(np.int64),
        volume_error=float(volume_error),
    )


def corner_points(piece: Piece) -> FloatArray:
    """Return points (V, 3) in the frame of the link whose hull contains the piece.

    The hull is the piece itself for a box and a convex mesh.
    """
    points = piece.vertices if piece.kind == "mesh" else _primitive_corners(piece)
    return np.asarray(points @ piece.pose[:3, :3].T + piece.pose[:3, 3])


def _primitive_corners(piece: Piece) -> FloatArray:
    if piece.kind == "box":
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        return np.asarray(signs * np.array(piece.size) / 2)
    angles = 2 * np.pi * np.arange(_CYLINDER_SIDES) / _CYLINDER_SIDES
    if piece.kind == "cylinder":
        radius, length = piece.size
        ring_radius = radius / np.cos(np.pi / _CYLINDER_SIDES)
        ring = np.column_stack(
            [ring_radius * np.cos(angles), ring_radius * np.sin(angles), np.full(_CYLINDER_SIDES, length / 2)]
        )
        return np.concatenate([ring, ring * [1, 1, -1]])
    # The inscribed sphere of this polyhedron of a unit ball has radius cos(pi / _SIDES)^2.
    polar_angles = np.pi * (np.arange(_CYLINDER_SIDES // 2) + 0.5) / (_CYLINDER_SIDES // 2)
    sphere_points = np.array(
        [
            [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)]
            for polar in polar_angles
            for azimuth in angles
        ]
    )
    sphere_points *= (1 + 1e-9) / np.cos(np.pi / _CYLINDER_SIDES) ** 2
    if piece.kind == "capsule":
        radius, length = piece.size
        return np.concatenate([sphere_points * radius + np.array([0, 0, z]) for z in (-length / 2, length / 2)])
    return np.asarray(sphere_points * np.array(piece.size))


def _mesh_volume(vertices: FloatArray, faces: Triangles) -> float:
    """Return the volume of a closed mesh (Gauss) for any orientation of it, also for a mirrored mesh."""
    first, second, third = (vertices[faces[:, corner]] for corner in range(3))
    return abs(float(np.einsum("ij,ij->i", first, np.cross(second, third)).sum() / 6))
