"""The shape of an arm as its file gives it: what collides of each link, as primitives, meshes and convex hulls."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.errors import ArmError
from holdfast.shapes.pieces import Missing, Piece
from holdfast.shapes.reading import read_pieces, unchecked_pairs

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]

_SIDES = 32  # of the prism that stands for a cylinder
_CONVEX = 1e-3  # of its hull's volume: what a mesh may lack of it and still count as convex


@dataclass(frozen=True, eq=False, kw_only=True)
class Hull:
    """A convex body that contains one piece of a link.

    Attributes:
        link: The joint that moves it, from 0; -1 for the base.
        owner: Name of the link in the file.
        name: Of the piece: of its mesh in the file, or its kind.
        vertices: (V, 3) m, in the frame that moves with the joint; all of them corners.
        faces: (F, 3) indices, counterclockwise seen from outside.
        fills: Part of its volume that the piece lacks; 0 unless the piece is a mesh.
    """

    link: int
    owner: str
    name: str
    vertices: Array
    faces: Triangles
    fills: float

    @property
    def convex(self) -> bool:
        """Whether the hull is the piece itself, to 0.1 % of its volume; a mesh that is not convex lies within."""
        return self.fills <= _CONVEX


@dataclass(frozen=True, eq=False, kw_only=True)
class Shape:
    """What collides of an arm.

    Attributes:
        pieces: As the file has them, the base's first.
        missing: What of it could not be read.
        unchecked: Pairs of links of the file, each in alphabetical order, that its SRDF file leaves unchecked.
        source: The file, for people.
    """

    pieces: tuple[Piece, ...]
    missing: tuple[Missing, ...]
    unchecked: frozenset[tuple[str, str]] = frozenset()
    source: str

    @classmethod
    @checked
    def of(cls, arm: Arm, meshes: str | Path | None = None, *, hold: Mapping[str, float] | None = None) -> Shape:
        """The collision shapes of the arm's file; none if it is from no file, or from one without them.

        Bodies that hang on the chain belong to the link they hang on, their own joints held.

        Args:
            arm: The arm.
            meshes: Folder with the files of meshes.
            hold: Where joints beside the chain are held, rad or m; as the arm was read if not given.

        Raises:
            ArmError: The file is no longer the one the arm was read from, or ``hold`` does not fit it.
        """
        pieces, missing = read_pieces(arm, "collision", hold=hold, meshes=meshes)
        source = "" if arm.chain is None else Path(arm.chain.file).name
        ordered = tuple(sorted(pieces, key=lambda p: p.link))
        return cls(pieces=ordered, missing=tuple(missing), unchecked=unchecked_pairs(arm), source=source)

    def __len__(self) -> int:
        return len(self.pieces)

    @cached_property
    def hulls(self) -> tuple[Hull, ...]:
        """A convex hull around every piece, in order; round ones have a polyhedron about them.

        Raises:
            ArmError: A mesh is flat.
        """
        return tuple(hull_of(piece) for piece in self.pieces)

    @cached_property
    def digest(self) -> str:
        """SHA-256 of every piece, the corners of meshes included."""
        h = hashlib.sha256()
        for p in self.pieces:
            h.update(repr((p.link, p.owner, p.kind, p.size)).encode())
            for numbers in (p.pose, p.vertices, p.faces):
                h.update(np.ascontiguousarray(numbers).tobytes())
        for shape in self.missing:
            h.update(repr((shape.link, shape.what)).encode())
        return h.hexdigest()


def hull_of(piece: Piece) -> Hull:
    """The convex hull of a piece, or of a polyhedron about it.

    Raises:
        ArmError: It is flat.
    """
    from scipy import spatial  # takes long to import, and is needed once for each shape

    vertices, faces = corners(piece), piece.faces
    try:
        found = spatial.ConvexHull(vertices)
    except (spatial.QhullError, ValueError) as error:
        raise ArmError(f"'{piece.name}' of link '{piece.owner}' is flat or has no volume; it cannot collide") from error
    order = np.full(len(vertices), -1)
    order[found.vertices] = np.arange(len(found.vertices))
    simplices = found.simplices.astype(np.int64)
    a, b, c = (vertices[simplices[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * found.equations[:, :3]).sum(axis=1) < 0
    triangles = np.where(inward[:, None], simplices[:, ::-1], simplices)
    fills = abs(_volume(vertices, faces) / found.volume - 1) if piece.kind == "mesh" else 0.0
    return Hull(
        link=piece.link,
        owner=piece.owner,
        name=piece.name,
        vertices=vertices[found.vertices],
        faces=order[triangles].astype(np.int64),
        fills=float(fills),
    )


def corners(piece: Piece, inside: bool = False) -> Array:
    """(V, 3) points in the frame of the link whose hull contains the piece; with ``inside``, is contained in it.

    The hull is the piece itself for a box and a convex mesh.
    """
    points = piece.vertices if piece.kind == "mesh" else _corners(piece, inside)
    return np.asarray(points @ piece.pose[:3, :3].T + piece.pose[:3, 3])


def _corners(piece: Piece, inside: bool) -> Array:
    if piece.kind == "box":
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        return np.asarray(signs * np.array(piece.size) / 2)
    turns = 2 * np.pi * np.arange(_SIDES) / _SIDES
    if piece.kind == "cylinder":
        radius, length = piece.size
        wide = radius if inside else radius / np.cos(np.pi / _SIDES)
        ring = np.column_stack([wide * np.cos(turns), wide * np.sin(turns), np.full(_SIDES, length / 2)])
        return np.concatenate([ring, ring * [1, 1, -1]])
    # The inscribed sphere of this polyhedron of a unit ball has radius cos(pi / _SIDES)^2.
    rows = np.pi * (np.arange(_SIDES // 2) + 0.5) / (_SIDES // 2)
    out = np.array([[np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)] for v in rows for u in turns])
    out = out if inside else out * ((1 + 1e-9) / np.cos(np.pi / _SIDES) ** 2)
    if piece.kind == "capsule":
        radius, length = piece.size
        return np.concatenate([out * radius + np.array([0, 0, z]) for z in (-length / 2, length / 2)])
    return np.asarray(out * np.array(piece.size))


def _volume(vertices: Array, faces: Triangles) -> float:
    """Of a closed mesh (Gauss); the sign is that of its orientation, and a mirrored one counts the same."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return abs(float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6))
