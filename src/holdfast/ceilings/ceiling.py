"""What no arm can beat after k failures, and what is known to be attainable."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from math import comb
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.ceilings.closed_forms import CLOSED_FORMS
from holdfast.ceilings.frames import complement, known
from holdfast.ceilings.minor_programmes import bounds_by_arrangement
from holdfast.ceilings.minors import lack_of_orthonormality, worst_case
from holdfast.ceilings.pair_kernels import certificates
from holdfast.ceilings.theorems import ARRANGEMENTS, PAIRS, THEOREMS, Bound, proven
from holdfast.errors import InputError
from holdfast.result import Result
from holdfast.words import percent

Array = NDArray[np.float64]

_ATTAINED = 1e-9  # relative: the bounds by programmes are rounded up in the last digits
_ORTHONORMAL = 1e-12
_MOST = 200  # joints


class OfTask(Protocol):
    """What has rows of a task: an index's task."""

    @property
    def m(self) -> int:
        """Rows."""


class OfArm(Protocol):
    """What has joints: an index's arm."""

    @property
    def n(self) -> int:
        """Joints."""


class OfFailures(Protocol):
    """What a ceiling is asked for: an index with its arm, its task and its failures."""

    @property
    def arm(self) -> OfArm:
        """Its arm."""

    @property
    def task(self) -> OfTask:
        """Its task."""

    @property
    def failures(self) -> tuple[tuple[int, ...], ...]:
        """Sets of joints that fail together."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Ceiling(Result):
    """The ceiling of relative manipulability after the worst k failures of n joints under a task of m rows.

    Attributes:
        n, m, k: Joints, rows of the task, joints that fail at once.
        bound: No configuration of any arm has more.
        bound_by: The theorems that prove it, names of ``docs/ceilings.md``.
    """

    n: int
    m: int
    k: int
    bound: float
    bound_by: str

    @cached_property
    def null_space(self) -> Array | None:
        """(n, n - m) orthonormal columns, the best null space known; None where nothing is stored and no theorem gives one."""
        return _best_null_space(self.n, self.m, self.k)

    @cached_property
    def best_known(self) -> float | None:
        """What some Jacobian attains, the worst case of :attr:`null_space`; None where nothing is known."""
        if self.null_space is None:
            return None
        return min(worst_case(self.null_space, self.k), self.bound)  # which it passes by rounding where it attains it

    @property
    def attained(self) -> bool:
        """True where some Jacobian reaches the bound (relative 1e-9): then it is the ceiling itself."""
        return self.best_known is not None and self.best_known >= self.bound * (1 - _ATTAINED)

    @property
    def closed_form(self) -> str:
        """What the best known value is in roots, where that was recognised; identified by its digits unless a T proves it."""
        own, complementary = ((self.n, *pair) for pair in ((self.m, self.k), (self.k, self.m)))
        return CLOSED_FORMS.get(own) or (CLOSED_FORMS.get(complementary, "") if self.k == self.n - self.m else "")

    @property
    def gap(self) -> float | None:
        """Fraction by which the bound is above the best known value; 0 where it is attained."""
        return None if self.best_known is None else 0.0 if self.attained else self.bound / self.best_known - 1

    @property
    def note(self) -> str:
        """How near to the bound some Jacobian is, a phrase; empty where it is attained."""
        if self.attained:
            return ""
        if self.best_known is None:
            return "an upper bound; whether it is attained is not known"
        return f"an upper bound; the best known is {self.best_known:.4f}"

    def compared(self, value: float) -> str:
        """What a value is of the ceiling, as ``69 % of the best known 0.2474; no arm can beat 0.2582``."""
        if self.attained or self.best_known is None:
            return f"{percent(value / self.bound)} of {self.bound:.4g}, which no arm can beat"
        return f"{percent(value / self.best_known)} of the best known {self.best_known:.4g}; no arm can beat {self.bound:.4g}"

    def describe(self) -> list[str]:
        """What is proven and what is known."""
        head = f"{self.n} joints, a task of {rows_of(self.m)}: when {when(self.k)}"
        proof = " and ".join(f"{name}, {THEOREMS[name]}" for name in self.bound_by.replace(" with ", " and ").split(" and "))
        if self.attained:
            return [f"{head}, the ceiling is {self.bound:.10g}: proven, and attained ({proof})"]
        lines = [f"{head}, no arm keeps more than {self.bound:.6g} of its manipulability ({proof})"]
        if self.best_known is None:
            lines.append("what can be attained is not stored for this size: search for it")
        else:
            form = f" = {self.closed_form}" if self.closed_form else ""
            above = percent(self.gap or 0.0)
            lines.append(f"the best that is known is {self.best_known:.10g}{form}; the bound is {above} above it")
        return lines

    def verify(self, *, proof: bool = False) -> Ceiling:
        """Itself, after the stored null space was measured anew by singular values of its rows, and held against the bound.

        Args:
            proof: Also replay the certificates that the bound rests on, of R3 in integers and of R4 in ball arithmetic:
                seconds, minutes for nine joints by R4.

        Raises:
            InputError: The null space is not orthonormal to 1e-12, or its value beats the bound: one of both is wrong; or the
                certificates prove less than what is said.
            ValueError: A certificate proves nothing.
            ImportError: The proof by R4 needs python-flint (``pip install "holdfast[certify]"``).
        """
        for theorem, n, p in proven(self.n, self.m, self.k).replayed if proof else ():
            said = ARRANGEMENTS[n] if theorem == "R4" else PAIRS[n, n - p]
            least = max(bounds_by_arrangement(n)) if theorem == "R4" else certificates()[n, n - p].proven()
            if least > said:
                raise InputError(f"the certificates of {theorem} for {n} joints prove {least:.12g} and not {said:.12g}")
        if self.null_space is None:
            return self
        lack, value = lack_of_orthonormality(self.null_space), worst_case(self.null_space, self.k)
        if lack > _ORTHONORMAL:
            raise InputError(f"the null space of {self.n},{self.m},{self.k} is not orthonormal: N'N - I is {lack:.1e}")
        if value > self.bound * (1 + 1e-12):
            raise InputError(f"{value:.12g} beats the proven bound {self.bound:.12g}: one of both is wrong")
        return self


def look_up(*, n: int, m: int, k: int = 1) -> Ceiling:
    """The ceiling for n joints, a task of m rows and k joints that fail at once.

    Args:
        n: Joints, revolute or prismatic.
        m: Rows of the task.
        k: Every set of k joints may lock.

    Raises:
        InputError: Not whole numbers, no redundancy, or fewer joints left than the task has rows.
    """
    for name, value in (("n", n), ("m", m), ("k", k)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            raise InputError(f"{name} is {value!r}; it must be a whole number")
    if m < 1:
        raise InputError(f"m is {m}; a task has at least 1 row")
    if n > _MOST:
        raise InputError(f"{n} joints are more than the {_MOST} that ceilings are computed for")
    if n <= m:
        raise InputError(f"{n} joints for {rows_of(m)} of the task: there is no redundancy, nothing can be lost")
    if k < 1:
        raise InputError(f"k is {k}; at least one joint must fail")
    if k > n - m:
        raise InputError(
            f"after {k} failures the task has {n - k} joints for {rows_of(m)}: the ceiling is 0; give k of at most {n - m}"
        )
    bound: Bound = proven(int(n), int(m), int(k))
    return Ceiling(n=int(n), m=int(m), k=int(k), bound=bound.value, bound_by=bound.by)


def of_index(index: OfFailures) -> Ceiling | None:
    """The ceiling for the arm, the task and the failures of an index of relative manipulability.

    Of failures of several sizes the largest counts: what locks besides only takes more.

    Returns:
        Ceiling, or None: Not every set of that many joints is among the failures, and no ceiling of all arms holds for them.
    """
    k = at_once(index)
    return None if k is None else look_up(n=index.arm.n, m=index.task.m, k=k)


def at_once(index: OfFailures) -> int | None:
    """The largest number of joints of which every set is among the failures; None if the largest sets are not all there."""
    k = max(map(len, index.failures))
    return None if sum(len(s) == k for s in index.failures) < comb(index.arm.n, k) or index.arm.n > _MOST else k


@dataclass(frozen=True, kw_only=True, eq=False)
class CeilingTable(Result):
    """The stored ceilings.

    Attributes:
        ceilings: By rows, failures and joints.
    """

    ceilings: list[Ceiling]

    def describe(self) -> list[str]:
        """How many are known."""
        reached = sum(c.attained for c in self.ceilings)
        return [
            f"{len(self.ceilings)} sizes; of {reached} the ceiling is known, of the others the best known is below the bound"
        ]


def table(m: int | None = None) -> CeilingTable:
    """The stored ceilings of two and three failures: up to ten joints, tasks of two to six rows.

    Args:
        m: Those of tasks of m rows alone.

    Raises:
        InputError: Nothing is stored for tasks of m rows.
    """
    found = [look_up(n=n, m=rows, k=k) for n, rows, k in _stored() if m in (None, rows)]
    if not found:
        raise InputError(f"nothing is stored for tasks of {m} rows; stored are those of 2 to 6")
    return CeilingTable(ceilings=found)


@cache
def _stored() -> dict[tuple[int, int, int], list[list[float]]]:
    text = (Path(__file__).parent / "null_spaces.json").read_text(encoding="utf-8")
    found: dict[tuple[int, int, int], list[list[float]]] = {}
    for key, rows in json.loads(text).items():
        n, m, k = map(int, key.split(","))
        found[n, m, k] = rows
    return dict(sorted(found.items(), key=lambda item: (item[0][1], item[0][2], item[0][0])))


def _best_null_space(n: int, m: int, k: int) -> Array | None:
    """Find the best null space known, by theorem T3 also the complement of the one for n - m rows and m failures."""
    candidates = [_own_null_space(n, m, k)]
    if k == n - m:
        other = _own_null_space(n, k, m)
        candidates.append(None if other is None else complement(other))
    return max((x for x in candidates if x is not None), key=lambda x: worst_case(x, k), default=None)


def _own_null_space(n: int, m: int, k: int) -> Array | None:
    given = known(n, m, k)
    if given is not None:
        return given
    rows = _stored().get((n, m, k))
    return None if rows is None else np.array(rows)


def when(k: int) -> str:
    """Any one joint locks, or several."""
    return "any one joint locks" if k == 1 else f"any {k} joints lock at once"


def rows_of(m: int) -> str:
    """How many, in words."""
    return "1 row" if m == 1 else f"{m} rows"
