"""What is asked exactly of an arm and its cell: whether anything touches, and how far the nearest thing is."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.cell.meshes import Mesh
from holdfast.clearance.bodies import box_about, of_solid, solids_within
from holdfast.clearance.chains import spheres_of
from holdfast.clearance.contacts import Contacts, parts_of, spheres_within
from holdfast.clearance.engines import CONTACT, Engine, for_distances, for_signs
from holdfast.clearance.formulas import NOWHERE, FormulaObjects

if TYPE_CHECKING:
    from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]

_FEW = 500  # faces of a hull, all of which are looked at before a library is asked


class Exactness:
    """The exact side of a clearance.

    Args:
        clearance: The bound, and what is checked.
    """

    def __init__(self, clearance: Clearance) -> None:
        self._clearance = clearance
        self.parts = parts_of(clearance.capsules)

    # ---- what is asked -------------------------------------------------------------------------------------------

    def clear(self, q: Array) -> Truths:
        """(N,) whether nothing touches; False for rows that are not finite.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts = self._signs
        bound = np.minimum(self._clearance.alone(q), self._around.least(q))
        found = np.asarray(bound >= CONTACT)
        (left,) = np.nonzero(bound < CONTACT)
        left = left[self._within.least(q[left]) >= -CONTACT]
        if left.size:
            found[left] = ~contacts.any(q[left], self._bounds(q[left], CONTACT))
        return found

    def distances(self, q: Array) -> Array:
        """(N,) the smallest distance, m; 0 where anything touches, NaN for rows that are not finite.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts = self._distances
        out = np.full(len(q), np.nan)
        (known,) = np.nonzero(np.isfinite(q).all(axis=1))
        if known.size:
            out[known] = contacts.distances(q[known], self._bounds(q[known], np.inf))
        return out

    @property
    def library(self) -> str:
        """What the distances are by, and how right they are.

        Raises:
            HoldfastError: No library for it is installed.
        """
        engine = self._distances.engine
        return f"{engine.name}, to {1e3 * engine.within:g} mm"

    @cached_property
    def _signs(self) -> Contacts:
        return self._contacts(for_signs())

    @cached_property
    def _distances(self) -> Contacts:
        return self._contacts(for_distances())

    def _contacts(self, engine: Engine) -> Contacts:
        c = self._clearance
        return Contacts(c.arm, self.parts, [self._between(*links) for links in self._columns], c.obstacles, engine)

    # ---- pairs of links ------------------------------------------------------------------------------------------

    def _between(self, low: int, high: int) -> list[tuple[int, int]]:
        """Bodies of two links that are checked against each other, by their positions in ``parts``."""
        shape = self._clearance.capsules.shape
        unchecked = frozenset() if shape is None else shape.unchecked
        found = []
        for a, b in product(range(len(self.parts)), repeat=2):
            one, other = self.parts[a], self.parts[b]
            names = (min(one.owner, other.owner), max(one.owner, other.owner))
            if (one.link, other.link) == (low, high) and names not in unchecked:
                found.append((a, b))
        return found

    @cached_property
    def _columns(self) -> dict[tuple[int, int], list[int]]:
        """Pairs of links that are checked, and where the pairs of their capsules are; nowhere if one that counts is left out.

        Pairs of capsules about bodies that are not checked against each other, ``capsules.apart``, do not count.
        """
        c = self._clearance
        found: dict[tuple[int, int], list[int]] = {}
        for k, (a, b) in enumerate(c.pairs):
            found.setdefault((c.capsules.parts[a].link, c.capsules.parts[b].link), []).append(k)
        lacking = {
            (c.capsules.parts[a].link, c.capsules.parts[b].link)
            for a, b in (ignored.pair for ignored in c.ignored)
            if (min(a, b), max(a, b)) not in c.capsules.apart
        }
        return {links: [] if links in lacking else columns for links, columns in found.items()}

    # ---- bounds --------------------------------------------------------------------------------------------------

    def _bounds(self, q: Array, limit: float) -> Array:
        """(N, P) as :class:`Contacts` takes them; better ones of hulls only below a limit, m."""
        every = self._clearance.alone.by_pair(q)
        own = [every[:, columns].min(axis=1) if columns else np.full(len(q), -np.inf) for columns in self._columns.values()]
        around = self._around.distances(q)
        seen, frames = self._clearance.obstacles, self._clearance.arm.frames(q)
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
        found, seen = {}, self._clearance.obstacles
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
        c, seen = self._clearance, self._clearance.obstacles
        if seen is None:
            return FormulaObjects(c.arm, spheres_of(c.capsules), [], np.zeros((0, 0)))
        return FormulaObjects(
            c.arm, seen.balls, [box_about(x) for x in seen.cell], seen.added(seen.links, np.arange(len(seen.cell)))
        )

    @cached_property
    def _within(self) -> FormulaObjects:
        """What lies within the objects, seen from spheres within the arm: above the true distances, where below 0."""
        c, balls, seen = self._clearance, spheres_within(self.parts), self._clearance.obstacles
        pairs = [] if seen is None else [(k, inner) for k, solid in enumerate(seen.cell) for inner in solids_within(solid)]
        if seen is None:
            return FormulaObjects(c.arm, balls, [], np.zeros((0, 0)))
        added = seen.added(np.unique(balls.link), np.array([k for k, _ in pairs], dtype=np.int64))
        return FormulaObjects(c.arm, balls, [inner for _, inner in pairs], added)
