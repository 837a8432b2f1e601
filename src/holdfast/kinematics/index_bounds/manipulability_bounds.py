"""Upper bounds of relative manipulability after k failures, and the best values known to be attainable."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from math import comb
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_percent
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.frames import known_null_space, orthogonal_complement
from holdfast.kinematics.index_bounds.minors import measure_orthonormality_error, worst_relative_manipulability
from holdfast.kinematics.index_bounds.theorems import ProvedBound, best_proved_bound

_ATTAINED_TOLERANCE = 1e-9  # relative: the bounds of the programs are rounded up in the last digits
_ORTHONORMAL_TOLERANCE = 1e-12
_MAX_JOINTS = 200  # joints


class TaskSize(Protocol):
    """Task with a number of rows, such as an index's task."""

    @property
    def m(self) -> int:
        """Number of rows."""


class ArmSize(Protocol):
    """Arm with a number of joints, such as an index's arm."""

    @property
    def n(self) -> int:
        """Number of joints."""


class FailureProblem(Protocol):
    """Arm, task, and failures for which an upper bound is requested, such as an index."""

    @property
    def arm(self) -> ArmSize:
        """Arm of the problem."""

    @property
    def task(self) -> TaskSize:
        """Task of the problem."""

    @property
    def failures(self) -> tuple[tuple[int, ...], ...]:
        """Sets of joints that fail together."""


@dataclass(frozen=True, kw_only=True, eq=False)
class UpperBound(Result):
    """Upper bound of relative manipulability after the worst k failures of n joints under a task of m rows.

    Attributes:
        n, m, k: Number of joints, of rows of the task, and of joints that fail at once.
        bound: Largest value of any configuration of any arm, 0 to 1.
        bound_by: Theorems that prove the bound, by their names in ``docs/theory/upper-bounds-proofs.md``.
    """

    n: int
    m: int
    k: int
    bound: float
    bound_by: str

    @cached_property
    def null_space(self) -> FloatArray | None:
        """Best known null space, (n, n - m) orthonormal columns; None if none is stored and no theorem gives one."""
        return _best_null_space(self.n, self.m, self.k)

    @cached_property
    def best_known(self) -> float | None:
        """Largest value that a known Jacobian attains, the worst case of :attr:`null_space`; None if none is known."""
        if self.null_space is None:
            return None
        return min(worst_relative_manipulability(self.null_space, self.k), self.bound)  # rounding may exceed an attained bound

    @property
    def is_attained(self) -> bool:
        """True if some Jacobian attains the bound (relative 1e-9), so that the bound cannot be lowered."""
        return self.best_known is not None and self.best_known >= self.bound * (1 - _ATTAINED_TOLERANCE)

    @property
    def closed_form(self) -> str:
        """Closed form of the best known value, if recognised by its 15 digits; only a theorem T proves it."""
        own, complementary = ((self.n, *pair) for pair in ((self.m, self.k), (self.k, self.m)))
        forms = read_closed_forms()
        return forms.get(own) or (forms.get(complementary, "") if self.k == self.n - self.m else "")

    @property
    def gap(self) -> float | None:
        """Fraction by which the bound exceeds the best known value; 0 if it is attained."""
        return None if self.best_known is None else 0.0 if self.is_attained else self.bound / self.best_known - 1

    @property
    def gap_phrase(self) -> str:
        """Phrase with the distance between the best known value and the bound; empty if the bound is attained."""
        if self.is_attained:
            return ""
        if self.best_known is None:
            return "an upper bound; whether it is attained is not known"
        return f"an upper bound; the best known is {self.best_known:.4f}"

    def compare_value(self, value: float) -> str:
        """Compare ``value``, 0 to 1, with the bound, as ``69 % of the best known 0.2474; no arm can exceed 0.2582``."""
        if self.is_attained or self.best_known is None:
            return f"{format_percent(value / self.bound)} of {self.bound:.4g}, which no arm can exceed"
        return (
            f"{format_percent(value / self.best_known)} of the best known {self.best_known:.4g}; no arm can exceed "
            f"{self.bound:.4g}"
        )

    def verify(self) -> UpperBound:
        """Recompute the value of the stored null space by singular values, compare it with the bound, and return the object.

        ``python -m measurements.upper_bounds.proofs`` in the repository replays the proof of the bound.

        Raises:
            InputError: The null space is not orthonormal to 1e-12, or its value exceeds the bound, so that one of the two is
                wrong.
        """
        if self.null_space is None:
            return self
        orthonormality_error, value = (
            measure_orthonormality_error(self.null_space),
            worst_relative_manipulability(self.null_space, self.k),
        )
        if orthonormality_error > _ORTHONORMAL_TOLERANCE:
            raise InputError(
                f"the null space of {self.n},{self.m},{self.k} is not orthonormal: N'N - I is {orthonormality_error:.1e}"
            )
        if value > self.bound * (1 + 1e-12):
            raise InputError(f"{value:.12g} exceeds the proved bound {self.bound:.12g}: one of the two is wrong")
        return self


def upper_bound(*, n: int, m: int, k: int = 1) -> UpperBound:
    """Return the upper bound for n joints, a task of m rows and k joints that fail at once.

    Args:
        n: Number of joints, revolute or prismatic.
        m: Number of rows of the task.
        k: Number of joints that fail; every set of k joints may lock.

    Raises:
        InputError: An argument is not a whole number, there is no redundancy, or too few joints remain for the task.
    """
    for name, value in (("n", n), ("m", m), ("k", k)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            raise InputError(f"{name} is {value!r}; it must be a whole number")
    if m < 1:
        raise InputError(f"m is {m}; a task has at least 1 row")
    if n > _MAX_JOINTS:
        raise InputError(f"{n} joints are more than the {_MAX_JOINTS} for which upper bounds are computed")
    if n <= m:
        raise InputError(f"{n} joints for {count_rows(m)} of the task: there is no redundancy, so no joint may fail")
    if k < 1:
        raise InputError(f"k is {k}; at least one joint must fail")
    if k > n - m:
        raise InputError(
            f"after {k} failures the task has {n - k} joints for {count_rows(m)}: the bound is 0; give k of at most {n - m}"
        )
    bound: ProvedBound = best_proved_bound(int(n), int(m), int(k))
    return UpperBound(n=int(n), m=int(m), k=int(k), bound=bound.value, bound_by=bound.by)


def bound_of_index(index: FailureProblem) -> UpperBound | None:
    """Return the upper bound for the arm, task, and failures of ``index``, an index of relative manipulability.

    The largest failure sets decide, because a lock of further joints cannot raise the index.

    Returns:
        UpperBound, or None if a set of that number of joints is not among the failures, so that no bound of all arms holds.
    """
    k = max_simultaneous_failures(index)
    return None if k is None else upper_bound(n=index.arm.n, m=index.task.m, k=k)


def max_simultaneous_failures(index: FailureProblem) -> int | None:
    """Return the largest number of joints for which every set is among the failures; None if those sets are incomplete."""
    k = max(map(len, index.failures))
    return None if sum(len(s) == k for s in index.failures) < comb(index.arm.n, k) or index.arm.n > _MAX_JOINTS else k


@dataclass(frozen=True, kw_only=True, eq=False)
class UpperBoundTable(Result):
    """Stored upper bounds.

    Attributes:
        ceilings: Upper bounds, sorted by rows, failures and joints.
    """

    ceilings: list[UpperBound]


def bound_table(m: int | None = None) -> UpperBoundTable:
    """Return the stored upper bounds of two and three failures: up to ten joints, tasks of two to six rows.

    Args:
        m: Number of rows of the task, 2 to 6; default: all.

    Raises:
        InputError: Nothing is stored for tasks of m rows.
    """
    bounds = [upper_bound(n=n, m=rows, k=k) for n, rows, k in _read_null_spaces() if m in (None, rows)]
    if not bounds:
        raise InputError(f"nothing is stored for tasks of {m} rows; stored are those of 2 to 6")
    return UpperBoundTable(ceilings=bounds)


@cache
def _read_null_spaces() -> dict[tuple[int, int, int], list[list[float]]]:
    return dict(sorted(_read_table("null_spaces.json").items(), key=lambda item: (item[0][1], item[0][2], item[0][0])))


@cache
def read_closed_forms() -> dict[tuple[int, int, int], str]:
    """Return closed forms of best known values by (n, m, k), recognised from 15 digits; only a theorem proves such a form."""
    return _read_table("closed_forms.json")


def _read_table(file: str) -> dict[tuple[int, int, int], Any]:
    """Return the values of a JSON file of this folder by (n, m, k)."""
    table: dict[tuple[int, int, int], Any] = {}
    for key, value in json.loads(Path(__file__).with_name(file).read_text(encoding="utf-8")).items():
        n, m, k = map(int, key.split(","))
        table[n, m, k] = value
    return table


def _best_null_space(n: int, m: int, k: int) -> FloatArray | None:
    """Find the best null space known, by theorem T3 also the complement of the one for n - m rows and m failures."""
    candidates = [_look_up_null_space(n, m, k)]
    if k == n - m:
        complement_space = _look_up_null_space(n, k, m)
        candidates.append(None if complement_space is None else orthogonal_complement(complement_space))
    return max((x for x in candidates if x is not None), key=lambda x: worst_relative_manipulability(x, k), default=None)


def _look_up_null_space(n: int, m: int, k: int) -> FloatArray | None:
    known_space = known_null_space(n, m, k)
    if known_space is not None:
        return known_space
    rows = _read_null_spaces().get((n, m, k))
    return None if rows is None else np.array(rows)


def failure_phrase(k: int) -> str:
    """Return ``any one joint locks``, or the phrase for several joints."""
    return "any one joint locks" if k == 1 else f"any {k} joints lock at once"


def count_rows(m: int) -> str:
    """Return the number of rows of a task in words."""
    return "1 row" if m == 1 else f"{m} rows"
