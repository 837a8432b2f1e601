"""Proved upper bounds of relative manipulability after k failures, for every arm of n joints and task of m rows.

A bound is the smallest value that the theorems imply, and it carries the names of these theorems.
``docs/theory/upper-bounds-proofs.md`` contains the proofs.
"""

from __future__ import annotations

from functools import cache
from math import comb, pi, sin, sqrt
from typing import NamedTuple

THEOREM_TEXTS = {
    "T1": "equal entries of the null space, attained (Schur and Horn)",
    "T2": "least of n neighbouring minors of n lines in a plane",
    "T3": "the minors of a null space are those of the row space, by T2",
    "T4": "equiangular lines that form a tight frame, and tasks of one row",
    "T5": "T2 after one more lock, attained",
    "CB": "the mean over all sets of joints (Cauchy and Binet)",
    "R1": "one lock after the other",
    "R2": "a positive definite kernel of degree four",
    "R3": "a kernel over pairs of joints, its certificate replayed in integers",
    "R4": "a geometric program for each class of pseudoline arrangements, certificates replayed in ball arithmetic",
}

# Upper bounds by ``measurements/upper_bounds/minor_programmes.py``, verified in ball arithmetic, rounded up: n -> c(n, 3, 3).
ARRANGEMENT_BOUNDS = {7: 0.08677541905, 8: 0.06087465665, 9: 0.04671897819}

# Bounds that the certificates of ``measurements/upper_bounds/pair_certificates.json`` prove: (n, m) -> c(n, n - m, 2).
PAIR_BOUNDS = {
    (5, 2): 0.515989,
    (6, 2): 0.610416,
    (7, 2): 0.673477,
    (8, 2): 0.718915,
    (9, 2): 0.753264,
    (10, 2): 0.780166,
    (7, 3): 0.521591,
    (8, 3): 0.583259,
    (9, 3): 0.632588,
    (10, 3): 0.671999,
}


class ProvedBound(NamedTuple):
    """Value that no arm can exceed.

    Attributes:
        value: Upper bound of the relative manipulability.
        by: Theorems that prove it, such as ``"R1 with R2"``.
        replayed: Certificates that it needs, each by theorem, joints and redundancy.
    """

    value: float
    by: str
    replayed: tuple[tuple[str, int, int], ...] = ()


@cache
def best_proved_bound(n: int, m: int, k: int) -> ProvedBound:
    """Return the least proved upper bound after the worst k failures.

    Args:
        n: Number of joints.
        m: Number of rows of the task, 1 to n - 1.
        k: Number of joints that fail at once, 1 to n - m.

    Source: derived here; Cauchy and Binet for ``CB``.
    """
    p = n - m
    bounds = [*_bounds_of_theorems(n, p, k), *_bounds_by_successive_failures(n, p, k)]
    if k == p:
        # T3: the minors of all p rows of N are those of the other m rows of the orthonormal rows of J.
        bounds += [
            b._replace(by=_name_rules("T3", b.by))
            for b in [*_bounds_of_theorems(n, m, m), *_bounds_by_successive_failures(n, m, m)]
        ]
    smallest = min(bound.value for bound in bounds)
    return next(bound for bound in bounds if bound.value <= smallest * (1 + 1e-12))  # the first of equal bounds is the simplest


def _bounds_of_theorems(n: int, p: int, k: int) -> list[ProvedBound]:
    m = n - p
    bounds = [ProvedBound(sqrt(comb(p, k) / comb(n, k)), "CB")]
    if k == 1:
        return [ProvedBound(sqrt(p / n), "T1")]
    if m == 1 or (n, p, k) in ((6, 3, 2), (10, 5, 2)):
        return [ProvedBound(bounds[0].value, "T4")]
    if p == k == 2:
        bounds.append(ProvedBound(2 / n * sin(pi / n), "T2"))
    elif k == 2:
        bounds.append(ProvedBound(sqrt(p * p * (p - 1) / ((p + 2) * n * m)), "R2"))
    if k == 2 and (n, m) in PAIR_BOUNDS:
        bounds.append(ProvedBound(PAIR_BOUNDS[n, m], "R3", (("R3", n, p),)))
    if p == k == 3:
        if n == 6:
            bounds.append(ProvedBound(sqrt((5 - sqrt(5)) / 100), "T5"))
        elif n in ARRANGEMENT_BOUNDS:
            bounds.append(ProvedBound(ARRANGEMENT_BOUNDS[n], "R4", (("R4", n, 3),)))
    return bounds


def _bounds_by_successive_failures(n: int, p: int, k: int) -> list[ProvedBound]:
    """Return the bounds of R1: ``c(n, p, k) <= c(n, p, j) c(n - j, p - j, k - j)``."""
    m, bounds = n - p, []
    for j in range(1, k):
        first, then = best_proved_bound(n, m, j), best_proved_bound(n - j, m, k - j)
        bounds.append(
            ProvedBound(first.value * then.value, _name_rules("R1", first.by, then.by), first.replayed + then.replayed)
        )
    return bounds


def _name_rules(rule: str, *others: str) -> str:
    """Return the name of a rule with the other rules that it uses and that need a mention."""
    words = [w for by in others for w in by.replace(" with ", " and ").split(" and ")]
    used_rules = [w for w in dict.fromkeys(words) if w not in (rule, "T1", "R1", "CB")]
    if rule == "T3" and used_rules in ([], ["T2"]):
        return "T3"
    return f"{rule} with {' and '.join(used_rules)}" if used_rules else rule
