"""What is asked exactly of an arm and its cell: whether anything touches, and how far the nearest thing is."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.cell.meshes import Mesh
from holdfast.cell.solids import Primitive, Sphere
from holdfast.clearance.bodies import of_solid
from holdfast.clearance.chains import Balls
from holdfast.clearance.contacts import Contacts, parts_of, spheres_within
from holdfast.clearance.engines import CONTACT, Engine, for_distances, for_signs
from holdfast.clearance.object_kernels import BLOCK, NOWHERE, distance_kernel, in_blocks
from holdfast.kernels.kernel import Kernel

if TYPE_CHECKING:
    from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]


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
        bound = self._clearance(q)
        found = np.asarray(bound >= CONTACT)
        (left,) = np.nonzero(bound < CONTACT)
        if left.size:
            left = left[~self._surely_hit(q[left])]
        if left.size:
            found[left] = ~contacts.any(q[left], self._bounds(q[left]))
        return found

    def distances(self, q: Array) -> Array:
        """(N,) the smallest distance, m; 0 where anything touches, NaN for rows that are not finite.

        Raises:
            HoldfastError: No library for it is installed.
        """
        contacts = self._distances
        out = np.full(len(q), np.nan)
        known = np.isfinite(q).all(axis=1)
        out[known] = contacts.distances(q[known], self._bounds(q[known]))
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

    def _bounds(self, q: Array) -> Array:
        """(N, P) as :class:`Contacts` takes them."""
        every = self._clearance.by_pair(q)
        own = [every[:, columns].min(axis=1, initial=np.inf) if columns else None for columns in self._columns.values()]
        rows = [np.full(len(q), -np.inf) if column is None else column for column in own]
        return np.concatenate([np.array(rows).reshape(-1, len(q)).T, every[:, len(self._clearance.pairs) :]], axis=1)

    # ---- certain collisions --------------------------------------------------------------------------------------

    @cached_property
    def _within(self) -> Balls:
        return spheres_within(self.parts)

    @cached_property
    def _kernel(self) -> Kernel:
        return distance_kernel(self._clearance.arm, self._within)

    @cached_property
    def _blocks(self) -> Array:
        """What lies within the objects of the cell, for the kernel; (0, ...) if nothing is known to."""
        obstacles = self._clearance.obstacles
        links = np.unique(self._within.link)
        if obstacles is None or not len(links):
            return np.zeros((0, BLOCK, 0))
        rows, off = [], []
        for k, solid in enumerate(obstacles.cell):
            for inner in _inner(solid):
                rows.append(inner.numbers())
                off.append(np.where(obstacles.apart[links + 1, k], NOWHERE, 0.0))
        return in_blocks(rows, off, len(links))

    def _surely_hit(self, q: Array) -> Truths:
        """(N,) whether a sphere within the arm is within an object: the library need not be asked."""
        least = [self._kernel.rows(q, block, first=1)[:, 0] for block in self._blocks]
        return np.asarray(np.min(least, axis=0, initial=np.inf) < -CONTACT)


def _inner(solid: object) -> list[Primitive]:
    """Solids with a formula that lie within an object."""
    if isinstance(solid, Primitive):
        return [solid]
    if not isinstance(solid, Mesh):
        return []
    body = of_solid(solid)
    pose = np.tile(np.eye(4), (len(body.inside[1]), 1, 1))
    pose[:, :3, 3] = body.inside[0] @ body.pose[:3, :3].T + body.pose[:3, 3]
    return [Sphere("", radius, pose=at) for radius, at in zip(body.inside[1].tolist(), pose, strict=True)]
