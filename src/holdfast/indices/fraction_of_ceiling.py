"""Relative manipulability beside what is known to be attainable, so that failures of several sizes can be compared."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.ceilings.ceiling import look_up
from holdfast.failures import FailureSpec
from holdfast.indices.determinants import RelativeManipulability
from holdfast.kernels.program import SX
from holdfast.linalg import HouseholderQR
from holdfast.registry import constructor

_SAME = 1e-9  # relative


class CeilingFraction(RelativeManipulability):
    r"""Relative manipulability after each failure, of the best value known for so many joints that lock; the least of all.

    :math:`\min_S \rho_S / c(n, m, |S|)` with the best known :math:`c` (:func:`holdfast.ceilings.look_up`), or the least proven
    bound where nothing is known. One number for failures of one, two and three joints at once.

    Source: derived here.
    """

    source = "derived here"

    def __init__(
        self,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        failures: FailureSpec = "single",
        *,
        length: float | None = None,
    ) -> None:
        super().__init__(arm, task, failures, length=length)
        self.name = "ceiling fraction"
        self.ceiling, self.bound, self.bound_note = None, None, ""
        ceilings = {k: look_up(n=arm.n, m=self.task.m, k=k) for k in {len(s) for s in self.failures}}
        self._attainable = {k: c.best_known or c.bound for k, c in ceilings.items()}
        complete = [k for k in ceilings if sum(len(s) == k for s in self.failures) == comb(arm.n, k)]
        if complete:
            self.bound = min(ceilings[k].bound / self._attainable[k] for k in complete)
            self.bound_note = "" if self.bound <= 1 + _SAME else "an upper bound; the best known is 1"

    def _squares(self, qr: HouseholderQR) -> list[SX]:
        squares = super()._squares(qr)
        return [square / self._attainable[len(s)] ** 2 for square, s in zip(squares, self.failures, strict=True)]

    def _assemble(self, qr: HouseholderQR, rho: SX, a: list[SX], p: list[SX]) -> SX:
        return super()._assemble(qr, rho, a, p) / self._attainable[1]

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Squares of the fractions and their derivatives; see :meth:`Index.scores`."""
        values, slopes = super().scores(q, j, qr, directions)
        if any(len(s) != 1 for s in self.failures):
            return values, slopes  # of _squares
        factor = self._attainable[1] ** -2
        return [factor * x for x in values], [[factor * x for x in row] for row in slopes]


@constructor(formula="min<sub>S</sub> ρ<sub>S</sub> / c(n, m, |S|)", properties=("base-free",))
def ceiling_fraction(
    arm: Arm, task: str | Task | Sequence[str] = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> CeilingFraction:
    """Relative manipulability of the best known for so many joints that lock, the least over all failures; derived here."""
    return CeilingFraction(arm, task, failures, length=length)
