"""Clearance with exact distances where its bound is not sufficient, so that falsely blocked configurations become free."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.engines import is_library_installed

if TYPE_CHECKING:
    from holdfast.model.collision.exact.exactness import ExactQueries


_EXACT_BELOW_M = 0.02  # m of margin: below it the exact distance is computed; about the underestimate of the bound


def with_exact_distances(clearance: Clearance | None, margin: float = 0.0) -> ExactClearance | None:
    """Return the clearance with exact distances; None without a library, and if the distances are exact already.

    Without a cell the distances of capsules that cover no known shape are exact.

    Args:
        clearance: Clearance with the bound, which is computed first.
        margin: Margin that will be required, m.
    """
    if (
        clearance is None
        or isinstance(clearance, ExactClearance)
        or (clearance.cell is None and clearance.capsules.shape is None)
    ):
        return None
    return ExactClearance(clearance, margin) if is_library_installed() else None


class ExactClearance(Clearance):
    """Clearance whose bound is raised to the exact distance, minus the library's error, wherever the margin is small.

    The nearest pair has that distance, and every other pair at least the same. So it bounds every pair of bodies, instead of
    the capsules and spheres that cover them, and proofs about whole motions hold as they do for the bound.

    Args:
        bound: Clearance with the bound.
        margin: Margin that will be required, m.

    Attributes:
        bound: First argument of the constructor.
    """

    def __init__(self, bound: Clearance, margin: float) -> None:
        vars(self).update(
            {attribute: value for attribute, value in vars(bound).items() if attribute not in ("self_only", "exactness")}
        )
        self.bound, self._near = bound, margin + _EXACT_BELOW_M

    @property
    def self_only(self) -> Clearance:
        """Bound without the cell."""
        return self.bound.self_only

    @property
    def exactness(self) -> ExactQueries:
        """Exact collision queries, computed by a library."""
        return self.bound.exactness

    @cached_property
    def _accuracy(self) -> float:
        return self.exactness.accuracy

    def with_cell(self, cell: Cell | None) -> Clearance:
        """Return the clearance in another cell; see :meth:`holdfast.Clearance.with_cell`."""
        other_bound = self.bound.with_cell(cell)
        return with_exact_distances(other_bound, self._near - _EXACT_BELOW_M) or other_bound

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the smallest distance, m; see :meth:`holdfast.Clearance.__call__`."""
        return self._sharpen_margins(q, np.zeros(len(self.margins)), self.bound(q))

    def margin_left(self, q: ArrayLike) -> FloatArray:
        """Return the smallest distance beyond its margin, m; see :meth:`holdfast.Clearance.margin_left`."""
        return self._sharpen_margins(q, self.margins, self.bound.margin_left(q))

    def _sharpen_margins(self, q: ArrayLike, margins: FloatArray, bound: FloatArray) -> FloatArray:
        rows, single = as_configurations(self.arm, q)
        raised = np.atleast_1d(bound).copy()
        is_near = raised < self._near
        if is_near.any():
            raised[is_near] = (self.by_pair(rows[is_near]) - margins).min(axis=1)
        return raised[0] if single else raised

    def by_pair(self, q: ArrayLike) -> FloatArray:
        """Return the distance of every pair, m; see :meth:`holdfast.Clearance.by_pair`."""
        rows, single = as_configurations(self.arm, q)
        values = self.bound.by_pair(rows)
        is_near = (values - self.margins).min(axis=1, initial=np.inf) < self._near
        if is_near.any():
            exact_distance = self.bound.exact(rows[is_near]) - self._accuracy
            values[is_near] = np.maximum(values[is_near], exact_distance[:, None])
        return values[0] if single else values

    def closest_pair(self, q: ArrayLike) -> IndexArray:
        """Return the pair with the smallest margin by the bound; see :meth:`holdfast.Clearance.closest_pair`."""
        return self.bound.closest_pair(q)
