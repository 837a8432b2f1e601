"""Tables of an arm and its obstacles for the compiled checks of edges."""

from __future__ import annotations

from ctypes import Structure, addressof, c_int64, c_void_p
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.configurations import align_joint_frames
from holdfast.model.arm.model import Arm
from holdfast.model.cell.solids import PrimitiveSolid
from holdfast.model.collision.capsules import Capsules
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.compiled.library import list_fields
from holdfast.model.collision.object_kernels import FAR_AWAY_M
from holdfast.model.collision.sphere_cover import make_sphere_cover

# As in route_search.cpp.
MAX_JOINTS = 16
MAX_PARTS = 192
_EMPTY_RADIUS_M = -1.0  # of the sphere around the spheres of a link without any


class SceneTables(NamedTuple):
    """Tables of an arm and its obstacles; links count from 0, the base, which does not move.

    Attributes:
        joints: (n, 13) rotation (9) by rows and position (3) from the previous link, in frames whose z is the joint's axis, and
            1 for a prismatic joint.
        first_sphere: (n + 2,) first sphere of each link, and the number of spheres.
        spheres: (S, 4) center in the frame of the link, and radius, m.
        enclosing: (n + 1, 4) sphere around the spheres of each link; a radius below 0 without spheres.
        objects: (K, 18) numbers of each object; see :meth:`PrimitiveSolid.numbers`.
        allowances: (n + 1, K) required distance of each link from each object, m.
        parts: (C, 8) center (3) and span (3) of the axis of each capsule in the frame of its link, its radius, and the radius
            of the sphere around it, m; by link.
        first_part: (n + 2,) first capsule of each link, and the number of capsules.
        part_enclosing: (n + 1, 4) sphere around the capsules of each link.
        link_pairs: (P, 4) two links, and the first and the end of their pairs of capsules.
        pairs: (Q, 2) capsules that are checked against each other.
        link_bounds: (n + 1, n) largest motion of a link per unit of each joint.
        pair_bounds: (P, n) largest change of the distance of two links per unit of each joint.
        pair_allowances: (P,) required distance of the links, m.
    """

    joints: FloatArray
    first_sphere: IndexArray
    spheres: FloatArray
    enclosing: FloatArray
    objects: FloatArray
    allowances: FloatArray
    parts: FloatArray
    first_part: IndexArray
    part_enclosing: FloatArray
    link_pairs: IndexArray
    pairs: IndexArray
    link_bounds: FloatArray
    pair_bounds: FloatArray
    pair_allowances: FloatArray

    @classmethod
    def from_clearance(
        cls, clearance: Clearance, margin: float, lipschitz_bounds: FloatArray, overlaps: FloatArray
    ) -> SceneTables:
        """Collect the tables of a clearance whose objects all have a distance formula.

        Args:
            clearance: Collision model.
            margin: Required distance in addition to the margins of objects, m.
            lipschitz_bounds: (P, n) bounds of the change of each pair's distance; see :meth:`Clearance.lipschitz_bounds`.
            overlaps: (P,) length by which each pair may be closer than required, m.
        """
        arm, obstacles = clearance.arm, clearance.obstacles
        bodies = _collect_bodies(arm, clearance.capsules, obstacles is not None)
        checked_pairs = bodies.positions[np.array(clearance.pairs, dtype=np.int64).reshape(-1, 2)]
        own_values = np.column_stack([lipschitz_bounds, overlaps])[: len(clearance.pairs)]
        link_pairs, pairs, pair_values = _group_pairs(checked_pairs, bodies.links, own_values)
        objects, allowances, link_bounds = np.zeros((0, 18)), np.zeros((arm.n + 1, 0)), np.zeros((arm.n + 1, arm.n))
        if obstacles is not None:
            objects = np.array([solid.numbers() for solid in obstacles.cell if isinstance(solid, PrimitiveSolid)])
            own_margins = np.array([obstacles.cell.margin_of(solid) for solid in obstacles.cell])
            required = np.tile(own_margins + margin, (arm.n + 1, 1))
            required[obstacles.links + 1] -= overlaps[len(clearance.pairs) :].reshape(len(obstacles.links), -1)
            allowances = np.where(obstacles.may_touch, -FAR_AWAY_M, required)
            link_bounds[obstacles.links + 1] = lipschitz_bounds[len(clearance.pairs) :: len(obstacles.cell)]
        return cls(
            **bodies.tables,
            objects=objects.reshape(-1, 18),
            allowances=allowances,
            link_pairs=link_pairs,
            pairs=pairs,
            link_bounds=link_bounds,
            pair_bounds=pair_values[:, :-1],
            pair_allowances=margin - pair_values[:, -1],
        )


class _Bodies(NamedTuple):
    """Links of an arm, the same for all its cells.

    Attributes:
        tables: Fields of :class:`SceneTables`.
        positions: (C,) position of each capsule of the collision model in ``parts``.
        links: (C,) link of each of ``parts``.
    """

    tables: dict[str, Any]
    positions: IndexArray
    links: IndexArray


def tabulate_joints(arm: Arm) -> FloatArray:
    """Return the table of joints (n, 13) of :class:`SceneTables`."""
    frames, _ = align_joint_frames(arm)
    return np.column_stack([frames[:, :3, :3].reshape(-1, 9), frames[:, :3, 3], arm.prismatic])


@lru_cache(maxsize=16)
def _collect_bodies(arm: Arm, capsules: Capsules, has_objects: bool) -> _Bodies:
    """Collect the joints, capsules, and, if there are objects, the spheres of an arm."""
    _, maps = align_joint_frames(arm)
    by_link = sorted(range(len(capsules)), key=lambda index: capsules.parts[index].link)
    parts = [capsules.parts[index] for index in by_link]
    part_links = np.array([part.link + 1 for part in parts], dtype=np.int64)
    ends = _to_axis_frames(np.array([[part.start, part.end] for part in parts]).reshape(-1, 2, 3), part_links, maps)
    radii, spans = np.array([part.radius for part in parts]), ends[:, 1] - ends[:, 0]
    end_spheres = np.concatenate([ends.reshape(-1, 3), np.repeat(radii, 2)[:, None]], axis=1)
    spheres, links = np.zeros((0, 4)), np.zeros(0, dtype=np.int64)
    if has_objects:
        cover = make_sphere_cover(capsules)
        moving = cover.link >= 0
        links = cover.link[moving] + 1
        centers = _to_axis_frames(cover.center[moving][:, None], links, maps)[:, 0]
        spheres = np.column_stack([centers, cover.radius[moving]])
    tables = {
        "joints": tabulate_joints(arm),
        "first_sphere": np.searchsorted(links, np.arange(arm.n + 2)),
        "spheres": spheres,
        "enclosing": _enclose_by_link(spheres, links, arm.n),
        "parts": np.column_stack([ends.mean(axis=1), spans, radii, radii + np.linalg.norm(spans, axis=1) / 2]).reshape(-1, 8),
        "first_part": np.searchsorted(part_links, np.arange(arm.n + 2)),
        "part_enclosing": _enclose_by_link(end_spheres, np.repeat(part_links, 2), arm.n),
    }
    return _Bodies(tables, np.argsort(np.array(by_link, dtype=np.int64)), part_links)


class _SceneAddresses(Structure):
    """Structure ``Scene`` of route_search.cpp: counts, and the addresses of the tables in their order."""

    _fields_ = (
        *list_fields(c_int64, "joint_count object_count link_pair_count"),
        *list_fields(c_void_p, " ".join(SceneTables._fields)),
    )


class CompiledScene:
    """Tables in one precision, at addresses for compiled code."""

    def __init__(self, tables: SceneTables, precision: DTypeLike) -> None:
        self._arrays = [
            np.ascontiguousarray(table, dtype=np.int64 if table.dtype.kind == "i" else precision) for table in tables
        ]
        counts = len(tables.joints), len(tables.objects), len(tables.link_pairs)
        self._addresses = _SceneAddresses(*counts, *(array.ctypes.data for array in self._arrays))
        self.address = addressof(self._addresses)


def _to_axis_frames(points: FloatArray, links: IndexArray, maps: FloatArray) -> FloatArray:
    """Return points (N, k, 3) of links (N,), given in the links' frames, in the frames of the tables."""
    return np.asarray(np.einsum("nij,nkj->nki", maps[links, :3, :3], points) + maps[links, None, :3, 3])


def _enclose_by_link(spheres: FloatArray, links: IndexArray, n: int) -> FloatArray:
    """Return a sphere (n + 1, 4) around the spheres (N, 4) of each link: its center is the middle of their bounding box."""
    enclosing = np.tile([0.0, 0.0, 0.0, _EMPTY_RADIUS_M], (n + 1, 1))
    for link in np.unique(links):
        centers, radii = spheres[links == link, :3], spheres[links == link, 3]
        middle = ((centers - radii[:, None]).min(axis=0) + (centers + radii[:, None]).max(axis=0)) / 2
        enclosing[link] = np.append(middle, (np.linalg.norm(centers - middle, axis=1) + radii).max())
    return enclosing


def _group_pairs(pairs: IndexArray, links: IndexArray, values: FloatArray) -> tuple[IndexArray, IndexArray, FloatArray]:
    """Group pairs (Q, 2) by their links; return link pairs and pairs of :class:`SceneTables`, and the largest values (P, k)."""
    keys = np.column_stack([links[pairs], pairs])
    order = np.lexsort(keys.T[::-1])
    is_first = np.ones(len(pairs), dtype=np.bool_)
    is_first[1:] = (np.diff(keys[order, :2], axis=0) != 0).any(axis=1)
    starts = np.flatnonzero(is_first)
    link_pairs = np.column_stack([keys[order][starts, :2], starts, np.append(starts[1:], len(pairs))[: len(starts)]])
    largest_values = np.maximum.reduceat(values[order], starts) if len(pairs) else values
    return link_pairs.astype(np.int64), pairs[order], largest_values
