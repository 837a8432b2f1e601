"""Status of one row of a batch, used by the whole library.

A batch cannot raise an error for one row, so solvers and indices return one byte per row. ``require_ok`` of a result turns the
first failed row into an error.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Self

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import HoldfastError


class SentenceEnum(IntEnum):
    """Enumeration whose members carry a sentence for people: ``STUCK = 1, "stops elsewhere"``."""

    sentence: str

    def __new__(cls, code: int, sentence: str = "") -> Self:
        """Create a member from its number and its sentence."""
        member = int.__new__(cls, code)
        member._value_, member.sentence = code, sentence
        return member


class Status(SentenceEnum):
    """Status of one row, or of one joint of it; ``Status(code).sentence`` gives advice. Files store the numbers."""

    OK = 0, "solved"
    NOT_FOUND = (
        1,
        "no solution was found within the budget: give more restarts or widen the joint limits; this does not prove that there "
        "is none",
    )
    BAD_INPUT = 2, "the input held NaN or infinity: look at where it came from"
    SINGULAR = 3, "the task Jacobian is singular here, so the index is 0 by convention: move off the singularity"
    INFEASIBLE = 4, "no choice meets the constraint: relax it"
    NO_INERTIA = (
        5,
        "all the mass that a joint carries lies on its axis, so its acceleration is 0/0: give the links their inertia or the "
        "joint its armature",
    )
    UNDEFINED = (
        6,
        "the formula gives no number at this configuration, which is finite: look at where it divides by zero or takes a root "
        "or logarithm",
    )
    SLOWED = 7, "the joint limits allow only a part of the commanded velocity: command less, or move away from the limits"
    DEGENERATE = (
        8,
        "what the joint carries is balanced about its axis, or gravity runs along the axis: it would not swing, so the angle "
        "and its gradient are 0 by convention, and near here both change abruptly",
    )
    NOT_DEFINED = 9, "a prismatic joint does not swing, it slides to its stop: its swing angle is 0 by convention"
    INACCURATE = (
        10,
        "the requested accuracy was not reached, because small differences grow too fast in this motion: shorten its duration "
        "or accept a larger error",
    )
    NOT_COMPUTED = 255, "not computed yet: resume the run"


def require_ok(status: NDArray[np.uint8], what: str) -> None:
    """Raise :class:`HoldfastError` if any row is not ``OK``; the message names the first one."""
    bad = np.flatnonzero(np.atleast_1d(status) != Status.OK)
    if bad.size:
        first = Status(int(np.atleast_1d(status)[bad[0]]))
        raise HoldfastError(
            f"{what}: {bad.size} of {np.size(status)} rows failed; first: row {bad[0]}, {first.name.lower()}: {first.sentence}"
        )
