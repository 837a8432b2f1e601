"""Relative manipulability as a fraction of the best attainable value, so that failures of several sizes can be compared."""

from __future__ import annotations

from math import comb

from holdfast.core.registry import constructor
from holdfast.kernels.linalg import HouseholderQR
from holdfast.kernels.program import SX
from holdfast.kinematics.index_bounds.manipulability_bounds import upper_bound
from holdfast.kinematics.indices.determinants import RelativeManipulability
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import TaskSpec
from holdfast.model.failure_modes import FailureSpec

_ATTAINED_TOLERANCE = 1e-9  # relative


class CeilingFraction(RelativeManipulability):
    r"""Smallest relative manipulability after any failure, divided by the best known value for that number of locked joints.

    :math:`\min_S \rho_S / c(n, m, |S|)` with the best known :math:`c` (:func:`holdfast.kinematics.index_bounds.upper_bound`),
    or the least proved bound if none is known. One number combines failures of one, two and three joints at once.

    Source: derived here.
    """

    source = "derived here"
    _formula_name = "ceiling fraction"

    def _set_scale_and_bound(self) -> None:
        ceilings = {count: upper_bound(n=self.arm.n, m=self.task.m, k=count) for count in {len(s) for s in self.failures}}
        self._attainable = {count: bound.best_known or bound.bound for count, bound in ceilings.items()}
        complete = [count for count in ceilings if sum(len(s) == count for s in self.failures) == comb(self.arm.n, count)]
        if complete:
            self.bound = min(ceilings[count].bound / self._attainable[count] for count in complete)
            self.bound_note = "" if self.bound <= 1 + _ATTAINED_TOLERANCE else "an upper bound; the best known is 1"

    def _squared_ratios(self, qr: HouseholderQR) -> list[SX]:
        squares = super()._squared_ratios(qr)
        return [square / self._attainable[len(s)] ** 2 for square, s in zip(squares, self.failures, strict=True)]

    def _combine_derivative(self, qr: HouseholderQR, rho: SX, a: list[SX], p: list[SX]) -> SX:
        return super()._combine_derivative(qr, rho, a, p) / self._attainable[1]

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return squared fractions and their derivatives; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Index.scores`."""
        values, derivatives = super().scores(q, j, qr, directions)
        if any(len(s) != 1 for s in self.failures):
            return values, derivatives  # of _squares
        factor = self._attainable[1] ** -2
        return [factor * x for x in values], [[factor * x for x in row] for row in derivatives]


@constructor(formula="min<sub>S</sub> ρ<sub>S</sub> / c(n, m, |S|)", properties=("base-free",))
def ceiling_fraction(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> CeilingFraction:
    """Relative manipulability over the best known for the number of locked joints, the least over all failures; derived here.

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return CeilingFraction(arm, task, failures, length=length)
