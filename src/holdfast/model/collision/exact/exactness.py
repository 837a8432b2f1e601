"""Exact collision queries of an arm and its cell: contacts, and the smallest distance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.cell.meshes import Mesh
from holdfast.model.cell.solids import Solid
from holdfast.model.collision.capsules import Capsules, link_name
from holdfast.model.collision.exact.bodies import body_from_solid, bounding_primitive, inner_primitives
from holdfast.model.collision.exact.engines import CONTACT_DISTANCE_M, CollisionLibrary, contact_library, distance_library
from holdfast.model.collision.exact.narrow_phase import SEARCH_DISTANCE_M, ArmBody, NarrowPhase, make_inner_spheres
from holdfast.model.collision.object_kernels import FAR_AWAY_M, FormulaObjects
from holdfast.model.collision.obstacles import Obstacles
from holdfast.model.collision.sphere_cover import make_sphere_cover

Pair = tuple[int, int]
Group = tuple[int, bool]  # a link, and whether its held objects or the link itself

_MAX_HULL_FACES = 500  # faces of a hull that are all checked before the library is called


class ExactQueries:
    """Exact collision queries of a clearance.

    Args:
        arm: Arm model.
        capsules: Capsules that cover the arm.
        parts: Bodies of the arm and of held objects; see :func:`holdfast.model.collision.exact.narrow_phase.arm_bodies`.
        self_bounds: Bound without the cell: functions for its smallest distance (N,) and that of every pair (N, P), m.
        pairs: Positions of the capsules that are checked against each other, the one nearer to the base first.
        ignored: Positions of the pairs that are not checked.
        obstacles: Objects of the cell, or None.
    """

    def __init__(
        self,
        arm: Arm,
        capsules: Capsules,
        parts: tuple[ArmBody, ...],
        self_bounds: tuple[Callable[[FloatArray], FloatArray], Callable[[FloatArray], FloatArray]],
        pairs: Sequence[Pair],
        ignored: Sequence[Pair],
        obstacles: Obstacles | None,
    ) -> None:
        self.arm, self.capsules, self.parts, self.obstacles = arm, capsules, parts, obstacles
        self._self_bounds, self._pairs, self._ignored = self_bounds, pairs, ignored

    # ---- evaluation ----------------------------------------------------------------------------------------------

    def check_collision_free(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where nothing touches; False for rows that are not finite.

        Raises:
            HoldfastError: No collision library is installed.
        """
        contact_library()  # an error, although the bounds might decide
        bound = np.minimum(self._self_bounds[0](q), self._outer_objects.smallest_distance(q))
        is_free = np.asarray(bound >= CONTACT_DISTANCE_M)
        (undecided,) = np.nonzero(bound < CONTACT_DISTANCE_M)
        if self.obstacles is not None:
            undecided = undecided[self._inner_distances.smallest_distance(q[undecided]) >= -CONTACT_DISTANCE_M]
        if undecided.size:
            is_free[undecided] = ~self._contact_queries.check_contacts(
                q[undecided], self._distance_bounds(q[undecided], near=False)
            )
        return is_free

    def check_pair_contact(self, q: FloatArray, pair: int) -> BoolArray:
        """Return (N,) True where the bodies of one pair of the clearance touch.

        Args:
            q: (N, n) finite configurations, rad and m.
            pair: Position in ``pair_names`` of the clearance.

        Raises:
            HoldfastError: No collision library is installed.
        """
        queries, own_count = self._contact_queries, len(self._pairs)
        column = (
            len(self._columns_by_link_pair) + pair - own_count
            if pair >= own_count
            else list(self._columns_by_link_pair).index(self._links_of_pair(self._pairs[pair]))
        )
        bounds = np.full(
            (len(q), len(self._columns_by_link_pair) + (0 if self.obstacles is None else len(self.obstacles.pairs))), np.inf
        )
        bounds[:, column] = -np.inf
        return queries.check_contacts(q, bounds)

    def name_known_contacts(self, q: FloatArray, margin: float) -> list[str]:
        """Name for each row two bodies of known shape that are closer than allowed; empty if there are none.

        Meshes count as they are, not as the hulls that replace them if they are nearly convex.

        Args:
            q: (N, n) finite configurations, rad and m.
            margin: Required distance, m, in addition to the margins of objects.

        Raises:
            HoldfastError: No collision library is installed.
        """
        obstacles = self.obstacles
        allowed = np.full(len(self._columns_by_link_pair), margin)
        if obstacles is not None:
            allowed = np.concatenate([allowed, obstacles.margins + margin])
        queries = self._known_distance_queries if allowed.any() else self._known_contact_queries
        pairs = queries.find_too_close_pair(q, self._distance_bounds(q, near=True), allowed)
        names = [" & ".join(link_name(self.arm, link) for link, _ in links) for links in self._columns_by_link_pair]
        names += [] if obstacles is None else obstacles.names
        return [names[pair] if pair >= 0 else "" for pair in pairs.tolist()]

    @property
    def are_all_shapes_known(self) -> bool:
        """True if every body is a part of the arm, and none is a cover or an assumption."""
        return all(part.known for part in self.parts)

    def smallest_distances(self, q: FloatArray) -> FloatArray:
        """Return the smallest distance (N,), m; 0 in contact, NaN for rows that are not finite.

        Raises:
            HoldfastError: No collision library is installed.
        """
        queries = self._distance_queries
        distances = np.full(len(q), np.nan)
        (finite_rows,) = np.nonzero(np.isfinite(q).all(axis=1))
        if finite_rows.size:
            distances[finite_rows] = queries.smallest_distances(
                q[finite_rows], self._distance_bounds(q[finite_rows], near=True)
            )
        return distances

    @property
    def library_description(self) -> str:
        """Library of the distances, and its accuracy.

        Raises:
            HoldfastError: No collision library is installed.
        """
        engine = self._distance_queries.engine
        return f"{engine.name}, to {1e3 * engine.accuracy:g} mm"

    @property
    def accuracy(self) -> float:
        """Accuracy of the distances, m."""
        return self._distance_queries.engine.accuracy

    @cached_property
    def _contact_queries(self) -> NarrowPhase:
        return self._build_queries(contact_library())

    @cached_property
    def _distance_queries(self) -> NarrowPhase:
        return self._build_queries(distance_library())

    @cached_property
    def _known_contact_queries(self) -> NarrowPhase:
        return self._build_known_queries(contact_library())

    @cached_property
    def _known_distance_queries(self) -> NarrowPhase:
        return self._build_known_queries(distance_library())

    def _build_known_queries(self, engine: CollisionLibrary) -> NarrowPhase:
        parts = [replace(part, body=part.body.filled or part.body) for part in self.parts if part.known]
        body_pairs = [_find_checked_pairs(parts, *links, self._unchecked_links) for links in self._columns_by_link_pair]
        return NarrowPhase(self.arm, parts, body_pairs, self.obstacles, engine)

    def _build_queries(self, engine: CollisionLibrary) -> NarrowPhase:
        return NarrowPhase(
            self.arm,
            self.parts,
            [_find_checked_pairs(self.parts, *links, self._unchecked_links) for links in self._columns_by_link_pair],
            self.obstacles,
            engine,
        )

    # ---- pairs of links ------------------------------------------------------------------------------------------

    @property
    def _unchecked_links(self) -> frozenset[tuple[str, str]]:
        """Pairs of links of the file that are not checked."""
        return frozenset() if self.capsules.shape is None else self.capsules.shape.unchecked

    def _links_of_pair(self, pair: Pair) -> tuple[Group, Group]:
        own_count = len(self.capsules) - self.capsules.held
        first, second = ((self.capsules.parts[part].link, part >= own_count) for part in pair)
        return first, second

    @cached_property
    def _columns_by_link_pair(self) -> dict[tuple[Group, Group], list[int]]:
        """Checked pairs of links, with the columns of their capsule pairs; no columns if a relevant capsule pair is ignored.

        Held objects of the last link are separate from it. Pairs of capsules around bodies that are not checked against each
        other, ``capsules.apart``, do not count.
        """
        columns_by_links: dict[tuple[Group, Group], list[int]] = {}
        for column, pair in enumerate(self._pairs):
            columns_by_links.setdefault(self._links_of_pair(pair), []).append(column)
        lacking = {
            self._links_of_pair((first, second))
            for first, second in self._ignored
            if (min(first, second), max(first, second)) not in self.capsules.apart
        }
        return {links: [] if links in lacking else columns for links, columns in columns_by_links.items()}

    @property
    def self_collision_pairs(self) -> list[tuple[list[int], list[tuple[int, int]]]]:
        """Return for each two links the pairs of the clearance, and the checked bodies, by their positions in ``parts``."""
        return [
            (columns, _find_checked_pairs(self.parts, *links, self._unchecked_links))
            for links, columns in self._columns_by_link_pair.items()
        ]

    # ---- bounds --------------------------------------------------------------------------------------------------

    def _distance_bounds(self, q: FloatArray, *, near: bool) -> FloatArray:
        """Return bounds (N, P) for :class:`NarrowPhase`; tighter for hulls that may touch or, if ``near``, be nearest."""
        capsule_distances = self._self_bounds[1](q)
        own_bounds = [
            capsule_distances[:, columns].min(axis=1) if columns else np.full(len(q), -np.inf)
            for columns in self._columns_by_link_pair.values()
        ]
        object_distances = self._outer_objects.link_distances(q)
        object_limit = object_distances.min(axis=(1, 2), initial=np.inf) + SEARCH_DISTANCE_M
        limit = object_limit if near else np.full(len(q), CONTACT_DISTANCE_M)
        obstacles, frames = self.obstacles, self.arm.frames(q)
        for object_index, (normals, offsets) in self._hull_planes.items():
            assert obstacles is not None
            for link_position, link in enumerate(obstacles.links):
                (rows,) = np.nonzero(object_distances[:, link_position, object_index] < limit)
                on_link = obstacles.spheres.link == link
                pose = frames[rows, link + 1]
                centers = np.einsum("nij,sj->nsi", pose[:, :3, :3], obstacles.spheres.center[on_link]) + pose[:, None, :3, 3]
                hull_distances = (centers @ normals.T - offsets).max(axis=2) - obstacles.spheres.radius[on_link]
                object_distances[rows, link_position, object_index] = np.maximum(
                    object_distances[rows, link_position, object_index], hull_distances.min(axis=1)
                )
        object_bounds = np.where(object_distances > FAR_AWAY_M / 2, np.inf, object_distances)
        return np.concatenate([np.array(own_bounds).reshape(-1, len(q)).T, object_bounds.reshape(len(q), -1)], axis=1)

    @cached_property
    def _hull_planes(self) -> dict[int, tuple[FloatArray, FloatArray]]:
        """Normals (F, 3) and offsets (F,), m, in the world, of objects that are hulls with few faces."""
        planes, obstacles = {}, self.obstacles
        for index, solid in enumerate(() if obstacles is None else obstacles.cell):
            body = body_from_solid(solid) if isinstance(solid, Mesh) else None
            if body is not None and body.kind == "convex" and len(body.faces) <= _MAX_HULL_FACES:
                normals, offsets = body.face_planes
                normals = normals @ body.pose[:3, :3].T
                planes[index] = normals, offsets + normals @ body.pose[:3, 3]
        return planes

    @cached_property
    def _outer_objects(self) -> FormulaObjects:
        """Objects, and boxes around those without a formula, against the cover of the arm: below the true distances."""
        obstacles = self.obstacles
        if obstacles is None:
            return FormulaObjects(self.arm, make_sphere_cover(self.capsules), [], np.zeros((0, 0)))
        return FormulaObjects(
            self.arm,
            obstacles.spheres,
            [bounding_primitive(solid) for solid in obstacles.cell],
            obstacles.distance_offsets(obstacles.links, np.arange(len(obstacles.cell))),
        )

    @cached_property
    def inner_objects_and_sources(self) -> tuple[FormulaObjects, list[Solid]]:
        """Return balls inside the arm against solids inside the objects, and the object of each such solid."""
        obstacles = self.obstacles
        return self._inner_distances, [] if obstacles is None else [
            solid for solid in obstacles.cell for _ in inner_primitives(solid)
        ]

    @cached_property
    def _inner_distances(self) -> FormulaObjects:
        """Solids inside the objects against spheres inside the arm: above the true distances, where these are below 0."""
        spheres, obstacles = make_inner_spheres(self.parts), self.obstacles
        pairs = (
            []
            if obstacles is None
            else [(index, inner_solid) for index, solid in enumerate(obstacles.cell) for inner_solid in inner_primitives(solid)]
        )
        if obstacles is None:
            return FormulaObjects(self.arm, spheres, [], np.zeros((0, 0)))
        offsets = obstacles.distance_offsets(np.unique(spheres.link), np.array([index for index, _ in pairs], dtype=np.int64))
        return FormulaObjects(self.arm, spheres, [inner_solid for _, inner_solid in pairs], offsets)


def _find_checked_pairs(
    parts: Sequence[ArmBody], low: Group, high: Group, unchecked: frozenset[tuple[str, str]]
) -> list[tuple[int, int]]:
    """Find the bodies of two links that are checked against each other, by their positions in ``parts``."""
    by_group = [[index for index, part in enumerate(parts) if (part.link, part.held) == group] for group in (low, high)]
    return [
        (first, second)
        for first, second in product(*by_group)
        if (min(parts[first].owner, parts[second].owner), max(parts[first].owner, parts[second].owner)) not in unchecked
    ]
