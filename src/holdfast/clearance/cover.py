"""Capsules that contain the shape of an arm: a guarantee, not a fit.

Every body of a link starts with one capsule about its convex hull; where that reaches too far beyond, a plane through the
middle cuts it in two. Then capsules of one link are joined where one about both is good enough. How far a capsule reaches
beyond a body is the mean over all directions of how much farther it reaches, plus, where the body is not convex, the mean
depth of what its hull fills in.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations, groupby
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arms.builtin import DATA
from holdfast.cell import solids
from holdfast.cell.cell import Cell
from holdfast.cell.solids import Solid
from holdfast.clearance.capsules import COVER, Capsule, Capsules, along_link, assumed_radius, link_name
from holdfast.clearance.enclosing import capsule_about, directions, main_axes
from holdfast.clearance.shape import Shape, corners, hull_of
from holdfast.errors import ArmError, InputError
from holdfast.kernels.recall import recalled_data
from holdfast.shapes.pieces import Kind, Piece

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]

SPHERES_TO = 0.01  # m
_DIRECTIONS = 600  # in which two bodies are compared
_CUTS = 3  # one after the other: at most 8 parts of a body
_WORTH = 0.85  # of what a body had: a cut that leaves more is not made
_SAMPLES = 2000  # points of a surface
_JOINED = 12  # bodies of one link, at most, that are tried in pairs


@checked
def cover_of(shape: Shape, arm: Arm, spheres_to: float = SPHERES_TO) -> Capsules:
    """Capsules that contain every piece of a shape; where a piece could not be read, those assumed along that link besides.

    Args:
        shape: What collides of the arm.
        arm: The arm.
        spheres_to: How far, m, they may reach beyond a body in the mean over all directions, as far as that can be had with
            at most 8 of them.

    Returns:
        The capsules, and in ``source`` where they come from.

    Raises:
        InputError: ``spheres_to`` is not above 0.
    """
    if not (np.isfinite(spheres_to) and spheres_to > 0):
        raise InputError(f"spheres_to is {spheres_to:g} m; it must be finite and above 0")
    ready = _ready() if spheres_to == SPHERES_TO else {}
    rows, mean, most = ready.get(shape.digest) or fitted(shape, spheres_to)
    made = [(Capsule(link, start, end, radius=radius), owners) for link, start, end, radius, owners in rows]
    for link in sorted({item.link for item in shape.missing}):
        made += [(part, []) for part in along_link(arm, link, assumed_radius(arm))]
    made.sort(key=lambda item: item[0].link)
    apart = [
        (a, b)
        for (a, (one, of)), (b, (other, of_other)) in combinations(enumerate(made), 2)
        if one.link != other.link and _unchecked(shape, of, of_other)
    ]
    told = _told(shape, arm, len(rows), mean, most)
    return Capsules(tuple(part for part, _ in made), apart=tuple(apart), source=told, shape=shape)


@cache
def _ready() -> dict[str, Any]:
    """What :func:`fitted` gave for the shapes of built-in arms, by their digests: ``python -m tools.covers`` writes it."""
    return dict(json.loads((DATA / "covers.json").read_text()))


def _unchecked(shape: Shape, owners: list[str], others: list[str]) -> bool:
    """Whether no link that one capsule is about is to be checked against one that the other is about."""
    pairs = [(min(a, b), max(a, b)) for a in owners for b in others]
    return bool(pairs) and shape.unchecked.issuperset(pairs)


def _told(shape: Shape, arm: Arm, count: int, mean: float, most: float) -> str:
    capsules = f"{count} capsule{'' if count == 1 else 's'}"
    text = f"{COVER}{shape.source}: {capsules}, {1e3 * mean:.0f} mm beyond their hulls in the mean, {1e3 * most:.0f} mm at most"
    if shape.missing:
        links = ", ".join(link_name(arm, link) for link in sorted({item.link for item in shape.missing}))
        what = shape.missing[0].what
        text += f"; {len(shape.missing)} not read, such as {what}: assumed capsules along {links} instead"
    return text


@dataclass(frozen=True, eq=False)
class _Body:
    """Triangles of a body, and the capsule about them.

    Attributes:
        points: (V, 3) m.
        faces: (F, 3) indices.
        owners: Links of the file that it is of.
        cuts: Unit normals (3,) and offsets, m, of the planes that cut it from a larger one.
        excess: How far the capsule reaches beyond, m in the mean.
        most: And at most beyond the hull.
    """

    points: Array
    faces: Triangles
    owners: tuple[str, ...]
    cuts: tuple[tuple[Array, float], ...]
    capsule: tuple[Array, Array, float]
    excess: float
    most: float


@recalled_data
def fitted(shape: Shape, spheres_to: float) -> Any:
    """Link, start, end and radius of each capsule, and the links of the file that it is about; mean and largest excess, m."""
    rows: list[Any] = []
    mean, most = [0.0], [0.0]
    for link, those in groupby(shape.pieces, key=lambda p: p.link):
        bodies: list[_Body] = []
        for owner, owned in groupby(sorted(those, key=lambda p: p.owner), key=lambda p: p.owner):
            pieces = list(owned)
            rows += [_exact(piece) for piece in pieces if piece.kind in ("capsule", "sphere")]
            bodies += _enough([_soup(p) for p in pieces if p.kind not in ("capsule", "sphere")], owner, spheres_to)
        for body in _joined(bodies, spheres_to):
            start, end, radius = body.capsule
            rows.append([link, start.tolist(), end.tolist(), radius, list(body.owners)])
            mean.append(body.excess)
            most.append(body.most)
    return rows, float(np.mean(mean[1:] or mean)), max(most)


def _exact(piece: Piece) -> list[Any]:
    radius, *length = piece.size
    ends = [(piece.pose[:3, 3] + piece.pose[:3, 2] * at / 2).tolist() for at in (-sum(length), sum(length))]
    return [piece.link, *ends, radius, [piece.owner]]


def _soup(piece: Piece) -> tuple[Array, Triangles]:
    """Triangles of a piece in the frame of its link."""
    if piece.kind == "mesh":
        return corners(piece), piece.faces
    hull = hull_of(piece)
    return hull.vertices, hull.faces


def _enough(soups: list[tuple[Array, Triangles]], owner: str, target: float) -> list[_Body]:
    """Bodies with good enough capsules that together contain all triangles: one about all if that will do."""
    if not soups:
        return []
    whole = _body(*_together(soups), (owner,))
    if whole.excess <= target:
        return [whole]
    bodies = [whole] if len(soups) == 1 else [_body(*soup, (owner,)) for soup in soups]
    return [part for body in bodies for part in _cut(body, target, _CUTS)]


def _together(soups: list[tuple[Array, Triangles]]) -> tuple[Array, Triangles]:
    offsets = np.cumsum([0, *(len(points) for points, _ in soups)])
    faces = [faces + offset for (_, faces), offset in zip(soups, offsets, strict=False)]
    return np.concatenate([points for points, _ in soups]), np.concatenate(faces)


def _joined(bodies: list[_Body], target: float) -> list[_Body]:
    """Fewer bodies of one link: two become one as long as its capsule is good enough, the best first."""
    there = dict(enumerate(bodies))
    made: dict[tuple[int, int], _Body] = {}
    while 1 < len(there) <= _JOINED:
        for pair in combinations(there, 2):
            if pair not in made:
                # Where the cut between them is gone, its plane must not hide that their hull is hollow: none is kept.
                both = [there[k] for k in pair]
                owners = sorted({owner for body in both for owner in body.owners})
                made[pair] = _body(*_together([(body.points, body.faces) for body in both]), tuple(owners))
        pair = min(combinations(there, 2), key=lambda pair: made[pair].excess)
        if made[pair].excess > target:
            break
        there = {k: body for k, body in there.items() if k not in pair} | {max(there) + 1: made[pair]}
    return list(there.values())


def _cut(body: _Body, target: float, times: int) -> list[_Body]:
    """The body, or its parts in two halves as long as that helps."""
    if body.excess <= target or not times:
        return [body]
    found: list[tuple[float, list[_Body]]] = []
    for normal in main_axes(body.points):
        heights = body.points @ normal
        offset = float(heights.max() + heights.min()) / 2
        sides = [_clipped(body, sign * normal, sign * offset) for sign in (1, -1)]
        halves = [_body(*side, body.owners, (*body.cuts, (normal, offset))) for side in sides if len(side[1])]
        found.append((float(np.mean([half.excess for half in halves])), halves))
    least, halves = min(found, key=lambda item: item[0])
    if least > _WORTH * body.excess:
        return [body]
    return [part for half in halves for part in _cut(half, target, times - 1)]


def _clipped(body: _Body, normal: Array, offset: float) -> tuple[Array, Triangles]:
    """The triangles on the side to which the normal does not point, cut at the plane."""
    points, corners_out = [], 0
    faces: list[list[int]] = []
    above = body.points @ normal - offset
    for triangle in body.faces:
        ring = []
        for k in range(3):
            a, b = triangle[k], triangle[(k + 1) % 3]
            if above[a] <= 0:
                ring.append(body.points[a])
            if (above[a] <= 0) != (above[b] <= 0):
                ring.append(body.points[a] + above[a] / (above[a] - above[b]) * (body.points[b] - body.points[a]))
        if len(ring) >= 3:
            faces += [[corners_out, corners_out + k, corners_out + k + 1] for k in range(1, len(ring) - 1)]
            corners_out += len(ring)
            points += ring
    return np.array(points).reshape(-1, 3), np.array(faces, dtype=np.int64).reshape(-1, 3)


def _body(points: Array, faces: Triangles, owners: tuple[str, ...], cuts: tuple[tuple[Array, float], ...] = ()) -> _Body:
    start, end, radius = capsule_about(points)
    towards = directions(_DIRECTIONS)
    reach = np.maximum(towards @ start, towards @ end) + radius - (towards @ points.T).max(axis=1)
    excess = float(reach.mean()) + _hollow(points, faces, cuts)
    return _Body(points, faces, owners, cuts, (start, end, radius), excess, float(reach.max()))


def _hollow(points: Array, faces: Triangles, cuts: tuple[tuple[Array, float], ...]) -> float:
    """Mean distance, m, of the surface of the hull from the triangles; what lies in a plane of a cut does not count."""
    from scipy import spatial  # takes long to import, and is needed once for each shape

    try:
        hull = spatial.ConvexHull(points)
    except (spatial.QhullError, ValueError):  # flat
        return 0.0
    there = _spread(points, hull.simplices.astype(np.int64))
    for normal, offset in cuts:
        there = there[np.abs(there @ normal - offset) > 1e-6]
    if not len(there):
        return 0.0
    have = np.concatenate([_spread(points, faces), points])
    # Points of one surface are about this far from each other, so from those of the other as well.
    grain = np.sqrt(hull.area / _SAMPLES)
    return float(np.maximum(spatial.cKDTree(have).query(there)[0] - grain, 0).mean())


def _spread(points: Array, faces: Triangles) -> Array:
    """(_SAMPLES, 3) points on triangles, evenly by area; the same each time."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    area = np.cumsum(np.linalg.norm(np.cross(b - a, c - a), axis=1))
    k = np.arange(_SAMPLES)
    at = np.minimum(np.searchsorted(area, (k + 0.5) / _SAMPLES * area[-1]), len(faces) - 1)
    # The R2 sequence (Roberts 2018).
    u, v = (0.5 + k * 0.7548776662466927) % 1, (0.5 + k * 0.5698402909980532) % 1
    u, v = np.where(u + v > 1, 1 - u, u)[:, None], np.where(u + v > 1, 1 - v, v)[:, None]
    return np.asarray(a[at] + u * (b - a)[at] + v * (c - a)[at])


@checked
def shape_of(arm: Arm, cell: Cell | None = None) -> Capsules:
    """The shape of an arm where none is given: the cover of its file's collision shapes, else :meth:`holdfast.Capsules.along`.

    Args:
        arm: The arm.
        cell: May say which of the two it is to be, or name a capsule file; how far the cover may reach beyond the shape; and
            where joints beside the chain are held.

    Raises:
        InputError: The cell asks for the shape of the arm's file, which gives none that can be read.
        ArmError: The cell names a capsule file that is wrong or a joint that the arm's file lacks.
    """
    wanted = "" if cell is None else cell.shape
    if wanted == "assumed":
        return Capsules.along(arm)
    if wanted not in ("", "meshes"):
        return Capsules.load(wanted, arm)
    why = ""
    try:
        shape = Shape.of(arm, hold={} if cell is None else cell.hold)
        if len(shape):
            target = None if cell is None else cell.spheres_to
            return cover_of(shape, arm, SPHERES_TO if target is None else target)
        why = f"{shape.missing[0].what} was not read" if shape.missing else ""
    except ArmError as error:
        if wanted or (cell is not None and cell.hold):
            raise
        why = str(error)
    if wanted:
        raise InputError(
            f"the cell asks for the meshes of '{arm.name}', and {why or 'no file gives it collision shapes'}; "
            "give their folder by --meshes (meshes= in Python), or say shape: assumed"
        )
    assumed = Capsules.along(arm)
    return replace(assumed, source=f"{assumed.describe(arm)} ({why})") if why else assumed


def shape_in(arm: Arm, cell: Cell | None, capsules: Capsules | None = None) -> Capsules:
    """What is looked at of an arm and of what it holds in a cell: given capsules, else those of :func:`shape_of`."""
    own = shape_of(arm, cell) if capsules is None else capsules
    return own.own if cell is None else holding(own, arm, cell.held, cell.spheres_to)


def holding(capsules: Capsules, arm: Arm, held: Sequence[Solid], spheres_to: float | None = None) -> Capsules:
    """The capsules of an arm, and those about what it holds instead of what they held before.

    Args:
        capsules: The arm's.
        arm: The arm.
        held: Boxes, cylinders, capsules and spheres with their poses in the tool's frame; they move with the last link.
        spheres_to: As :func:`cover_of` has it.
    """
    own = capsules.own
    if not held:
        return own
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    pieces = tuple(
        Piece(
            link=arm.n - 1,
            owner="held",
            kind=cast(Kind, type(solid).__name__.lower()),
            name=solid.name,
            size=_size(solid),
            pose=arm.tool @ solid.pose,
            vertices=nothing[0],
            faces=nothing[1],
        )
        for solid in held
    )
    rows, _, _ = fitted(Shape(pieces=pieces, missing=(), source="held"), SPHERES_TO if spheres_to is None else spheres_to)
    parts = [Capsule(link, start, end, radius=radius) for link, start, end, radius, _ in rows]
    return replace(own, parts=(*own.parts, *parts), held=len(parts))


def _size(solid: Solid) -> tuple[float, ...]:
    """As pieces have it.

    Raises:
        InputError: The solid is none that can be held.
    """
    if isinstance(solid, solids.Box):
        return tuple(float(x) for x in solid.size)
    if isinstance(solid, solids.Cylinder | solids.Capsule):
        return (solid.radius, solid.length)
    if isinstance(solid, solids.Sphere):
        return (solid.radius,)
    raise InputError(f"'{solid.name}' cannot be held; hold a box, cylinder, capsule or sphere")
