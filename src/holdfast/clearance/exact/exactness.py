"""What is asked exactly of an arm and its cell: whether anything touches, and how far the nearest thing is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.cell.meshes import Mesh
from holdfast.cell.solids import Solid
from holdfast.clearance.capsules import Capsules, link_name
from holdfast.clearance.chains import spheres_of
from holdfast.clearance.exact.bodies import box_about, of_solid, solids_within
from holdfast.clearance.exact.engines import CONTACT, Engine, for_distances, for_signs
from holdfast.clearance.exact.meetings import NEAR, Meetings, Part, parts_of, spheres_within
from holdfast.clearance.object_kernels import NOWHERE, FormulaObjects
from holdfast.clearance.obstacles import Obstacles

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]
Pair = tuple[int, int]
Group = tuple[int, bool]  # a link, and whether what it holds or itself

_FEW = 500  # faces of a hull, all of which are looked at before a library is asked


class Exactness:
    """The exact side of a clearance.

    Args:
        arm: The arm.
        capsules: What covers it.
        alone: The bound without the cell: its smallest distance (N,) and that of every pair (N, P), m.
        pairs: Positions of the capsules that are checked against each other, the one nearer to the base first.
        ignored: Positions of those that are not.
        obstacles: The objects of its cell, or None.
        held: What moves with the tool, with poses in its frame.
    """

    def __init__(
        self,
        arm: Arm,
        capsules: Capsules,
        alone: tuple[Callable[[Array], Array], Callable[[Array], Array]],
        pairs: Sequence[Pair],
        ignored: Sequence[Pair],
        obstacles: Obstacles | None,
        held: Sequence[Solid],
    ) -> None:
        self.arm, self.capsules, self.obstacles = arm, capsules, obstacles
        self._alone, self._pairs, self._ignored = alone, pairs, ignored
        self.parts = parts_of(arm, capsules, held)

    # ---- what is asked -------------------------------------------------------------------------------------------

    def clear(self, q: Array) -> Truths:
        """(N,) whether nothing touches; False for rows that are not finite.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts = self._signs
        bound = np.minimum(self._alone[0](q), self._around.least(q))
        found = np.asarray(bound >= CONTACT)
        (left,) = np.nonzero(bound < CONTACT)
        if self.obstacles is not None:
            left = left[self._within.least(q[left]) >= -CONTACT]
        if left.size:
            found[left] = ~contacts.any(q[left], self._bounds(q[left], near=False))
        return found

    def touches(self, q: Array, pair: int) -> Truths:
        """(N,) whether the bodies that one pair of the clearance is about touch.

        Args:
            q: (N, n) finite.
            pair: Position in ``pair_names`` of the clearance.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts, own = self._signs, len(self._pairs)
        at = len(self._columns) + pair - own if pair >= own else list(self._columns).index(self._groups(self._pairs[pair]))
        bounds = np.full((len(q), len(self._columns) + (0 if self.obstacles is None else len(self.obstacles.pairs))), np.inf)
        bounds[:, at] = -np.inf
        return contacts.any(q, bounds)

    def known_contacts(self, q: Array, margin: float) -> list[str]:
        """Two things of which the bodies are known and closer than they may be, by name, for each row; empty where none is.

        Meshes count as they are, not as the hulls that stand for them where they are nearly convex.

        Args:
            q: (N, n) finite.
            margin: m, beyond what objects keep.

        Raises:
            HoldfastError: No library for it is installed.
        """
        seen = self.obstacles
        allowed = np.full(len(self._columns), margin)
        if seen is not None:
            allowed = np.concatenate([allowed, seen.margins + margin])
        meetings = self._known_distances if allowed.any() else self._known_signs
        pairs = meetings.closer(q, self._bounds(q, near=True), allowed)
        names = [" & ".join(link_name(self.arm, link) for link, _ in links) for links in self._columns]
        names += [] if seen is None else seen.names
        return [names[pair] if pair >= 0 else "" for pair in pairs.tolist()]

    @property
    def parts_known(self) -> bool:
        """Whether each body is a part of the arm, none a cover or an assumption."""
        return all(part.known for part in self.parts)

    def distances(self, q: Array) -> Array:
        """(N,) the smallest distance, m; 0 where anything touches, NaN for rows that are not finite.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts = self._distances
        out = np.full(len(q), np.nan)
        (known,) = np.nonzero(np.isfinite(q).all(axis=1))
        if known.size:
            out[known] = contacts.distances(q[known], self._bounds(q[known], near=True))
        return out

    @property
    def library(self) -> str:
        """What the distances are by, and how right they are.

        Raises:
            HoldfastError: No library for it is installed.
        """
        engine = self._distances.engine
        return f"{engine.name}, to {1e3 * engine.within:g} mm"

    @property
    def within(self) -> float:
        """How right the distances are, m."""
        return self._distances.engine.within

    @cached_property
    def _signs(self) -> Meetings:
        return self._contacts(for_signs())

    @cached_property
    def _distances(self) -> Meetings:
        return self._contacts(for_distances())

    @cached_property
    def _known_signs(self) -> Meetings:
        return self._known_meetings(for_signs())

    @cached_property
    def _known_distances(self) -> Meetings:
        return self._known_meetings(for_distances())

    def _known_meetings(self, engine: Engine) -> Meetings:
        parts = [replace(part, body=part.body.filled or part.body) for part in self.parts if part.known]
        between = [_find_checked_pairs(parts, *links, self._unchecked_links) for links in self._columns]
        return Meetings(self.arm, parts, between, self.obstacles, engine)

    def _contacts(self, engine: Engine) -> Meetings:
        return Meetings(
            self.arm,
            self.parts,
            [_find_checked_pairs(self.parts, *links, self._unchecked_links) for links in self._columns],
            self.obstacles,
            engine,
        )

    # ---- pairs of links ------------------------------------------------------------------------------------------

    @property
    def _unchecked_links(self) -> frozenset[tuple[str, str]]:
        """Pairs of links of the file that are not checked."""
        return frozenset() if self.capsules.shape is None else self.capsules.shape.unchecked

    def _groups(self, pair: Pair) -> tuple[Group, Group]:
        own = len(self.capsules) - self.capsules.held
        a, b = ((self.capsules.parts[k].link, k >= own) for k in pair)
        return a, b

    @cached_property
    def _columns(self) -> dict[tuple[Group, Group], list[int]]:
        """Pairs of links that are checked, and where the pairs of their capsules are; nowhere if one that counts is left out.

        What the last link holds is apart from it. Pairs of capsules about bodies that are not checked against each other,
        ``capsules.apart``, do not count.
        """
        found: dict[tuple[Group, Group], list[int]] = {}
        for k, pair in enumerate(self._pairs):
            found.setdefault(self._groups(pair), []).append(k)
        lacking = {self._groups((a, b)) for a, b in self._ignored if (min(a, b), max(a, b)) not in self.capsules.apart}
        return {links: [] if links in lacking else columns for links, columns in found.items()}

    @property
    def own_bodies(self) -> list[tuple[list[int], list[tuple[int, int]]]]:
        """Of each two links: their pairs of the clearance, and bodies that are checked, by their positions in ``parts``."""
        return [
            (columns, _find_checked_pairs(self.parts, *links, self._unchecked_links))
            for links, columns in self._columns.items()
        ]

    # ---- bounds --------------------------------------------------------------------------------------------------

    def _bounds(self, q: Array, *, near: bool) -> Array:
        """(N, P) as :class:`Meetings` takes them; better of hulls that may touch, or with ``near`` be nearest."""
        every = self._alone[1](q)
        own = [every[:, columns].min(axis=1) if columns else np.full(len(q), -np.inf) for columns in self._columns.values()]
        around = self._around.distances(q)
        limit = around.min(axis=(1, 2), initial=np.inf) + NEAR if near else np.full(len(q), CONTACT)
        seen, frames = self.obstacles, self.arm.frames(q)
        for k, (normals, offsets) in self._hulls.items():
            assert seen is not None
            for at, link in enumerate(seen.links):
                (rows,) = np.nonzero(around[:, at, k] < limit)
                some = seen.balls.link == link
                pose = frames[rows, link + 1]
                centres = np.einsum("nij,sj->nsi", pose[:, :3, :3], seen.balls.centre[some]) + pose[:, None, :3, 3]
                beyond = (centres @ normals.T - offsets).max(axis=2) - seen.balls.radius[some]
                around[rows, at, k] = np.maximum(around[rows, at, k], beyond.min(axis=1))
        apart = np.where(around > NOWHERE / 2, np.inf, around)
        return np.concatenate([np.array(own).reshape(-1, len(q)).T, apart.reshape(len(q), -1)], axis=1)

    @cached_property
    def _hulls(self) -> dict[int, tuple[Array, Array]]:
        """Of objects that are hulls of few faces: normals (F, 3) and offsets (F,), m, in the world."""
        found, seen = {}, self.obstacles
        for k, solid in enumerate(() if seen is None else seen.cell):
            body = of_solid(solid) if isinstance(solid, Mesh) else None
            if body is not None and body.kind == "convex" and len(body.faces) <= _FEW:
                normals, offsets = body.planes
                normals = normals @ body.pose[:3, :3].T
                found[k] = normals, offsets + normals @ body.pose[:3, 3]
        return found

    @cached_property
    def _around(self) -> FormulaObjects:
        """The objects, and boxes about those without a formula, seen from the cover of the arm: below the true distances."""
        seen = self.obstacles
        if seen is None:
            return FormulaObjects(self.arm, spheres_of(self.capsules), [], np.zeros((0, 0)))
        return FormulaObjects(
            self.arm, seen.balls, [box_about(x) for x in seen.cell], seen.added(seen.links, np.arange(len(seen.cell)))
        )

    @cached_property
    def inner(self) -> tuple[FormulaObjects, list[Solid]]:
        """Balls within the arm among what lies within the objects, and of which object each of that is."""
        seen = self.obstacles
        return self._within, [] if seen is None else [solid for solid in seen.cell for _ in solids_within(solid)]

    @cached_property
    def _within(self) -> FormulaObjects:
        """What lies within the objects, seen from spheres within the arm: above the true distances, where below 0."""
        balls, seen = spheres_within(self.parts), self.obstacles
        pairs = [] if seen is None else [(k, inner) for k, solid in enumerate(seen.cell) for inner in solids_within(solid)]
        if seen is None:
            return FormulaObjects(self.arm, balls, [], np.zeros((0, 0)))
        added = seen.added(np.unique(balls.link), np.array([k for k, _ in pairs], dtype=np.int64))
        return FormulaObjects(self.arm, balls, [inner for _, inner in pairs], added)


def _find_checked_pairs(
    parts: Sequence[Part], low: Group, high: Group, unchecked: frozenset[tuple[str, str]]
) -> list[tuple[int, int]]:
    """Find the bodies of two links that are checked against each other, by their positions in ``parts``."""
    found = []
    for a, b in product(range(len(parts)), repeat=2):
        one, other = parts[a], parts[b]
        names = (min(one.owner, other.owner), max(one.owner, other.owner))
        if ((one.link, one.held), (other.link, other.held)) == (low, high) and names not in unchecked:
            found.append((a, b))
    return found
