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

from holdfast.core.errors import ArmError, InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_json
from holdfast.model.arm.model import Arm
from holdfast.model.arms.builtin import DATA_FOLDER
from holdfast.model.cell import solids
from holdfast.model.cell.cell import Cell
from holdfast.model.cell.solids import Solid
from holdfast.model.collision.capsules import COVER_PREFIX, Capsules, LinkCapsule, assumed_radius, capsule_along_link, link_name
from holdfast.model.collision.enclosing import enclosing_capsule, main_axes, sphere_directions
from holdfast.model.collision.shape import CollisionModel, corner_points, make_hull
from holdfast.model.shapes.pieces import Kind, Piece

Triangles = NDArray[np.int64]

MAX_MEAN_EXCESS_M = 0.01  # m
_COMPARED_DIRECTIONS = 600  # in which two bodies are compared
_MAX_CUTS = 3  # one after the other: at most 8 parts of a body
_CUT_GAIN_FRACTION = 0.85  # of what a body had: a cut that leaves more is not made
_SURFACE_POINTS = 2000  # points of a surface
_MAX_MERGED_BODIES = 12  # bodies of one link, at most, that are tried in pairs


@check_arguments
def make_cover(shape: CollisionModel, arm: Arm, spheres_to: float = MAX_MEAN_EXCESS_M) -> Capsules:
    """Make capsules that contain every piece of a shape, and assumed capsules along links with a piece that could not be read.

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
    built_in = _load_built_in_covers() if spheres_to == MAX_MEAN_EXCESS_M else {}
    rows, mean_excess, max_excess = built_in.get(shape.digest) or fit_capsules(shape, spheres_to)
    capsules = [(LinkCapsule(link, start, end, radius=radius), owners) for link, start, end, radius, owners in rows]
    for link in sorted({item.link for item in shape.missing}):
        capsules += [(part, []) for part in capsule_along_link(arm, link, assumed_radius(arm))]
    capsules.sort(key=lambda item: item[0].link)
    unchecked_pairs = [
        (first, second)
        for (first, (first_capsule, first_owners)), (second, (second_capsule, second_owners)) in combinations(
            enumerate(capsules), 2
        )
        if first_capsule.link != second_capsule.link and _are_links_unchecked(shape, first_owners, second_owners)
    ]
    source = _describe_cover(shape, arm, len(rows), mean_excess, max_excess)
    return Capsules(tuple(part for part, _ in capsules), apart=tuple(unchecked_pairs), source=source, shape=shape)


@cache
def _load_built_in_covers() -> dict[str, Any]:
    """Return the results of :func:`fit_capsules` for built-in arms, by digest; ``python -m tools.covers`` writes them."""
    return dict(json.loads((DATA_FOLDER / "covers.json").read_text()))


def _are_links_unchecked(shape: CollisionModel, owners: list[str], others: list[str]) -> bool:
    """Return True if no link that one capsule covers is to be checked against one that the other covers."""
    pairs = [(min(first, second), max(first, second)) for first in owners for second in others]
    return bool(pairs) and shape.unchecked.issuperset(pairs)


def _describe_cover(shape: CollisionModel, arm: Arm, count: int, mean_excess: float, max_excess: float) -> str:
    capsules = f"{count} capsule{'' if count == 1 else 's'}"
    text = (
        f"{COVER_PREFIX}{shape.source}: {capsules}, {1e3 * mean_excess:.0f} mm beyond their hulls on average, "
        f"{1e3 * max_excess:.0f} mm at most"
    )
    if shape.missing:
        links = ", ".join(link_name(arm, link) for link in sorted({item.link for item in shape.missing}))
        missing_name = shape.missing[0].what
        text += f"; {len(shape.missing)} not read, such as {missing_name}: assumed capsules along {links} instead"
    return text


@dataclass(frozen=True, eq=False)
class _CoveredBody:
    """Triangles of a body, and the capsule around them.

    Attributes:
        points: (V, 3) m.
        faces: (F, 3) indices.
        owners: Links of the file that it is of.
        cuts: Unit normals (3,) and offsets, m, of the planes that cut it from a larger one.
        excess: How far the capsule reaches beyond, m in the mean.
        max_excess: And at most beyond the hull.
    """

    points: FloatArray
    faces: Triangles
    owners: tuple[str, ...]
    cuts: tuple[tuple[FloatArray, float], ...]
    capsule: tuple[FloatArray, FloatArray, float]
    excess: float
    max_excess: float


@cached_json
def fit_capsules(shape: CollisionModel, max_mean_excess: float) -> Any:
    """Return link, start, end and radius of each capsule, and the file links that it covers; mean and largest excess, m."""
    rows: list[Any] = []
    mean_excesses, max_excesses = [0.0], [0.0]
    for link, link_pieces in groupby(shape.pieces, key=lambda item: item.link):
        bodies: list[_CoveredBody] = []
        for owner, owned in groupby(sorted(link_pieces, key=lambda item: item.owner), key=lambda item: item.owner):
            pieces = list(owned)
            rows += [_capsule_row_of_piece(piece) for piece in pieces if piece.kind in ("capsule", "sphere")]
            bodies += _cover_triangles(
                [_piece_triangles(item) for item in pieces if item.kind not in ("capsule", "sphere")], owner, max_mean_excess
            )
        for body in _merge_bodies(bodies, max_mean_excess):
            start, end, radius = body.capsule
            rows.append([link, start.tolist(), end.tolist(), radius, list(body.owners)])
            mean_excesses.append(body.excess)
            max_excesses.append(body.max_excess)
    return rows, float(np.mean(mean_excesses[1:] or mean_excesses)), max(max_excesses)


def _capsule_row_of_piece(piece: Piece) -> list[Any]:
    radius, *length = piece.size
    ends = [(piece.pose[:3, 3] + piece.pose[:3, 2] * offset / 2).tolist() for offset in (-sum(length), sum(length))]
    return [piece.link, *ends, radius, [piece.owner]]


def _piece_triangles(piece: Piece) -> tuple[FloatArray, Triangles]:
    """Return the triangles of a piece in the frame of its link."""
    if piece.kind == "mesh":
        return corner_points(piece), piece.faces
    hull = make_hull(piece)
    return hull.vertices, hull.faces


def _cover_triangles(soups: list[tuple[FloatArray, Triangles]], owner: str, target: float) -> list[_CoveredBody]:
    """Return bodies with tight enough capsules that together contain all triangles, one for all if that is tight enough."""
    if not soups:
        return []
    merged = _make_body(*_merge_triangles(soups), (owner,))
    if merged.excess <= target:
        return [merged]
    bodies = [merged] if len(soups) == 1 else [_make_body(*soup, (owner,)) for soup in soups]
    return [part for body in bodies for part in _split_body(body, target, _MAX_CUTS)]


def _merge_triangles(soups: list[tuple[FloatArray, Triangles]]) -> tuple[FloatArray, Triangles]:
    offsets = np.cumsum([0, *(len(points) for points, _ in soups)])
    faces = [faces + offset for (_, faces), offset in zip(soups, offsets, strict=False)]
    return np.concatenate([points for points, _ in soups]), np.concatenate(faces)


def _merge_bodies(bodies: list[_CoveredBody], target: float) -> list[_CoveredBody]:
    """Merge bodies of one link in pairs, the best first, as long as the merged capsule is tight enough."""
    remaining = dict(enumerate(bodies))
    merged: dict[tuple[int, int], _CoveredBody] = {}
    while 1 < len(remaining) <= _MAX_MERGED_BODIES:
        for pair in combinations(remaining, 2):
            if pair not in merged:
                # Where the cut between them is gone, its plane must not hide that their hull is hollow: none is kept.
                merged_pair = [remaining[key] for key in pair]
                owners = sorted({owner for body in merged_pair for owner in body.owners})
                merged[pair] = _make_body(*_merge_triangles([(body.points, body.faces) for body in merged_pair]), tuple(owners))
        pair = min(combinations(remaining, 2), key=lambda pair: merged[pair].excess)
        if merged[pair].excess > target:
            break
        remaining = {key: body for key, body in remaining.items() if key not in pair} | {max(remaining) + 1: merged[pair]}
    return list(remaining.values())


def _split_body(body: _CoveredBody, target: float, splits_left: int) -> list[_CoveredBody]:
    """Split the body in halves recursively while that tightens the capsules."""
    if body.excess <= target or not splits_left:
        return [body]
    splits: list[tuple[float, list[_CoveredBody]]] = []
    for normal in main_axes(body.points):
        heights = body.points @ normal
        offset = float(heights.max() + heights.min()) / 2
        sides = [_clip_triangles(body, sign * normal, sign * offset) for sign in (1, -1)]
        halves = [_make_body(*side, body.owners, (*body.cuts, (normal, offset))) for side in sides if len(side[1])]
        splits.append((float(np.mean([half.excess for half in halves])), halves))
    smallest, halves = min(splits, key=lambda item: item[0])
    if smallest > _CUT_GAIN_FRACTION * body.excess:
        return [body]
    return [part for half in halves for part in _split_body(half, target, splits_left - 1)]


def _clip_triangles(body: _CoveredBody, normal: FloatArray, offset: float) -> tuple[FloatArray, Triangles]:
    """Return the triangles on the side opposite to the normal, cut at the plane."""
    points, corner_count = [], 0
    faces: list[list[int]] = []
    heights = body.points @ normal - offset
    for triangle in body.faces:
        polygon = []
        for index in range(3):
            first, second = triangle[index], triangle[(index + 1) % 3]
            if heights[first] <= 0:
                polygon.append(body.points[first])
            if (heights[first] <= 0) != (heights[second] <= 0):
                polygon.append(
                    body.points[first]
                    + heights[first] / (heights[first] - heights[second]) * (body.points[second] - body.points[first])
                )
        if len(polygon) >= 3:
            faces += [[corner_count, corner_count + index, corner_count + index + 1] for index in range(1, len(polygon) - 1)]
            corner_count += len(polygon)
            points += polygon
    return np.array(points).reshape(-1, 3), np.array(faces, dtype=np.int64).reshape(-1, 3)


def _make_body(
    points: FloatArray, faces: Triangles, owners: tuple[str, ...], cuts: tuple[tuple[FloatArray, float], ...] = ()
) -> _CoveredBody:
    start, end, radius = enclosing_capsule(points)
    sampled_directions = sphere_directions(_COMPARED_DIRECTIONS)
    excesses = (
        np.maximum(sampled_directions @ start, sampled_directions @ end) + radius - (sampled_directions @ points.T).max(axis=1)
    )
    excess = float(excesses.mean()) + _mean_hull_gap(points, faces, cuts)
    return _CoveredBody(points, faces, owners, cuts, (start, end, radius), excess, float(excesses.max()))


def _mean_hull_gap(points: FloatArray, faces: Triangles, cuts: tuple[tuple[FloatArray, float], ...]) -> float:
    """Return the mean distance, m, of the hull's surface from the triangles; the planes of cuts do not count."""
    from scipy import spatial  # takes long to import, and is needed once for each shape

    try:
        hull = spatial.ConvexHull(points)
    except (spatial.QhullError, ValueError):  # flat
        return 0.0
    hull_points = _spread_points(points, hull.simplices.astype(np.int64))
    for normal, offset in cuts:
        hull_points = hull_points[np.abs(hull_points @ normal - offset) > 1e-6]
    if not len(hull_points):
        return 0.0
    body_points = np.concatenate([_spread_points(points, faces), points])
    # Points of one surface are about this far from each other, so from those of the other as well.
    point_spacing = np.sqrt(hull.area / _SURFACE_POINTS)
    return float(np.maximum(spatial.cKDTree(body_points).query(hull_points)[0] - point_spacing, 0).mean())


def _spread_points(points: FloatArray, faces: Triangles) -> FloatArray:
    """Spread (_SAMPLES, 3) points over triangles evenly by area; the points are the same each time."""
    a, b, c = (points[faces[:, index]] for index in range(3))
    cumulative_area = np.cumsum(np.linalg.norm(np.cross(b - a, c - a), axis=1))
    index = np.arange(_SURFACE_POINTS)
    areas = (index + 0.5) / _SURFACE_POINTS * cumulative_area[-1]
    triangle = np.minimum(np.searchsorted(cumulative_area, areas), len(faces) - 1)
    # The R2 sequence (Roberts 2018).
    u, v = (0.5 + index * 0.7548776662466927) % 1, (0.5 + index * 0.5698402909980532) % 1
    u, v = np.where(u + v > 1, 1 - u, u)[:, None], np.where(u + v > 1, 1 - v, v)[:, None]
    return np.asarray(a[triangle] + u * (b - a)[triangle] + v * (c - a)[triangle])


@check_arguments
def choose_capsules(arm: Arm, cell: Cell | None = None) -> Capsules:
    """Choose the capsules of an arm where none are given: the cover of its collision shapes, else
    :meth:`holdfast.Capsules.along_links`.

    Args:
        arm: The arm.
        cell: May say which of the two it is to be, or name a capsule file; how far the cover may reach beyond the shape; and
            where joints beside the chain are held.

    Raises:
        InputError: The cell asks for the shape of the arm's file, which gives none that can be read.
        ArmError: The cell names a capsule file that is wrong or a joint that the arm's file lacks.
    """
    requested = "" if cell is None else cell.shape
    if requested == "assumed":
        return Capsules.along_links(arm)
    if requested not in ("", "meshes"):
        return Capsules.load(requested, arm)
    reason = ""
    try:
        shape = CollisionModel.from_arm(arm, hold={} if cell is None else cell.hold)
        if len(shape):
            target = None if cell is None else cell.spheres_to
            return make_cover(shape, arm, MAX_MEAN_EXCESS_M if target is None else target)
        reason = f"{shape.missing[0].what} was not read" if shape.missing else ""
    except ArmError as error:
        if requested or (cell is not None and cell.hold):
            raise
        reason = str(error)
    if requested:
        raise InputError(
            f"the cell asks for the meshes of '{arm.name}', and {reason or 'no file gives it collision shapes'}; "
            "give their folder by --meshes (meshes= in Python), or say shape: assumed"
        )
    assumed = Capsules.along_links(arm)
    return replace(assumed, source=f"{assumed.describe(arm)} ({reason})") if reason else assumed


def capsules_in_cell(arm: Arm, cell: Cell | None, capsules: Capsules | None = None) -> Capsules:
    """Return the capsules of an arm and of held objects in a cell: given capsules, else those of :func:`choose_capsules`."""
    arm_capsules = choose_capsules(arm, cell) if capsules is None else capsules
    return arm_capsules.without_held if cell is None else with_held_objects(arm_capsules, arm, cell.held, cell.spheres_to)


def with_held_objects(capsules: Capsules, arm: Arm, held: Sequence[Solid], spheres_to: float | None = None) -> Capsules:
    """Return the capsules of an arm with those of the given held objects in place of previous held objects.

    Args:
        capsules: The arm's.
        arm: The arm.
        held: Boxes, cylinders, capsules and spheres with their poses in the tool's frame; they move with the last link.
        spheres_to: As :func:`make_cover` has it.
    """
    arm_capsules = capsules.without_held
    if not held:
        return arm_capsules
    empty_mesh = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    pieces = tuple(
        Piece(
            link=arm.n - 1,
            owner="held",
            kind=cast(Kind, type(solid).__name__.lower()),
            name=solid.name,
            size=_piece_size(solid),
            pose=arm.tool @ solid.pose,
            vertices=empty_mesh[0],
            faces=empty_mesh[1],
        )
        for solid in held
    )
    rows, _, _ = fit_capsules(
        CollisionModel(pieces=pieces, missing=(), source="held"), MAX_MEAN_EXCESS_M if spheres_to is None else spheres_to
    )
    parts = [LinkCapsule(link, start, end, radius=radius) for link, start, end, radius, _ in rows]
    return replace(arm_capsules, parts=(*arm_capsules.parts, *parts), held=len(parts))


def _piece_size(solid: Solid) -> tuple[float, ...]:
    """Return the size of a held object as pieces have it.

    Raises:
        InputError: The solid is none that can be held.
    """
    if isinstance(solid, solids.Box):
        return tuple(float(edge) for edge in solid.size)
    if isinstance(solid, solids.Cylinder | solids.Capsule):
        return (solid.radius, solid.length)
    if isinstance(solid, solids.Sphere):
        return (solid.radius,)
    raise InputError(f"'{solid.name}' cannot be held; hold a box, cylinder, capsule or sphere")
