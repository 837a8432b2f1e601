"""A clearance that asks for exact distances where its bound does not do: what the bound calls blocked may be clear."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.configurations import as_configurations
from holdfast.caching import cached_property
from holdfast.cell.cell import Cell
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.engines import installed

if TYPE_CHECKING:
    from holdfast.clearance.exact.exactness import Exactness

Array = NDArray[np.float64]

_NEAR = 0.02  # m of room: nearer than this the distance is asked for; about what the bound lacks


def sharpened(clearance: Clearance | None, margin: float = 0.0) -> Sharper | None:
    """The same clearance with exact distances; None without a library, and where the distances are exact already.

    Without a cell those of capsules that cover no known shape are.

    Args:
        clearance: Whose bound is asked first.
        margin: m, the room that will be asked for.
    """
    if clearance is None or isinstance(clearance, Sharper) or (clearance.cell is None and clearance.capsules.shape is None):
        return None
    return Sharper(clearance, margin) if installed() else None


class Sharper(Clearance):
    """A clearance whose bound is raised to the exact distance, less what the library may err, wherever little room is left.

    What is nearest has that distance, so that everything else has at least as much: it bounds every pair, of bodies instead of
    the capsules and spheres that cover them, and proofs about whole motions hold as they do for the bound.

    Args:
        bound: The clearance.
        margin: m, the room that will be asked for.
    """

    def __init__(self, bound: Clearance, margin: float) -> None:
        vars(self).update({name: value for name, value in vars(bound).items() if name not in ("alone", "exactness")})
        self._bound, self._near = bound, margin + _NEAR

    @property
    def alone(self) -> Clearance:
        """The bound without the cell."""
        return self._bound.alone

    @property
    def exactness(self) -> Exactness:
        """What is asked exactly, by a library."""
        return self._bound.exactness

    @cached_property
    def _within(self) -> float:
        return self.exactness.within

    def with_cell(self, cell: Cell | None) -> Clearance:
        """See :meth:`holdfast.Clearance.with_cell`."""
        other = self._bound.with_cell(cell)
        return sharpened(other, self._near - _NEAR) or other

    def __call__(self, q: ArrayLike) -> Array:
        """See :meth:`holdfast.Clearance.__call__`."""
        return self._least_of(q, np.zeros(len(self.margins)), self._bound(q))

    def room(self, q: ArrayLike) -> Array:
        """See :meth:`holdfast.Clearance.room`."""
        return self._least_of(q, self.margins, self._bound.room(q))

    def _least_of(self, q: ArrayLike, margins: Array, bound: Array) -> Array:
        rows, single = as_configurations(self.arm, q)
        least = np.atleast_1d(bound).copy()
        near = least < self._near
        if near.any():
            least[near] = (self.by_pair(rows[near]) - margins).min(axis=1)
        return least[0] if single else least

    def by_pair(self, q: ArrayLike) -> Array:
        """See :meth:`holdfast.Clearance.by_pair`."""
        rows, single = as_configurations(self.arm, q)
        values = self._bound.by_pair(rows)
        near = (values - self.margins).min(axis=1, initial=np.inf) < self._near
        if near.any():
            exact = self._bound.exact(rows[near]) - self._within
            values[near] = np.maximum(values[near], exact[:, None])
        return values[0] if single else values

    def closest_pair(self, q: ArrayLike) -> NDArray[np.int64]:
        """See :meth:`holdfast.Clearance.closest_pair`; by the bound."""
        return self._bound.closest_pair(q)
