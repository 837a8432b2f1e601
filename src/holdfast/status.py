"""What became of one row of a batch: one table for the whole library.

A batch cannot raise for row 17, so solvers and indices return one byte per row; ``require_ok`` of a result
turns the first bad row into an error at the edge.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError


class Status(IntEnum):
    """Status of one row; ``Status(code).advice`` says what to try."""

    OK = 0
    NOT_FOUND = 1
    BAD_INPUT = 2
    SINGULAR = 3
    INFEASIBLE = 4
    NO_INERTIA = 5
    UNDEFINED = 6
    NOT_COMPUTED = 255

    @property
    def advice(self) -> str:
        """One sentence: what this status means and what to try."""
        return _ADVICE[self]


_ADVICE = {
    Status.OK: "solved",
    Status.NOT_FOUND: "no solution was found within the budget: give more restarts or widen the joint limits; "
    "this does not prove that there is none",
    Status.BAD_INPUT: "the input held NaN or infinity: look at where it came from",
    Status.SINGULAR: "the task Jacobian is singular here, so the index is 0 by convention: move off the singularity",
    Status.INFEASIBLE: "no choice meets the constraint: relax it",
    Status.NO_INERTIA: "the arm has no inertial data for this: add masses and inertias to its description",
    Status.UNDEFINED: "the formula gives no number at this configuration, which is finite: look at where it divides by zero "
    "or takes a root or logarithm",
    Status.NOT_COMPUTED: "not computed yet: resume the run",
}


def require_ok(status: NDArray[np.uint8], what: str) -> None:
    """Raise :class:`HoldfastError` if any row is not ``OK``; the message names the first one."""
    bad = np.flatnonzero(np.atleast_1d(status) != Status.OK)
    if bad.size:
        first = Status(int(np.atleast_1d(status)[bad[0]]))
        raise HoldfastError(
            f"{what}: {bad.size} of {np.size(status)} rows failed; first: row {bad[0]}, {first.name.lower()}: {first.advice}"
        )
