"""Convex programme for each class of pseudoline arrangements that bounds the least minor, with its certificate (theorem R4).

Once the signs of the minors are known each relation reads ``x + y = z`` of three positive products. With ``x + y <= z`` instead
and ``t`` the log of each minor over the least one, ``log(exp(a.t) + exp(b.t)) <= 0`` is convex, and the least minor is at most
``exp(-f/2)`` with ``f = min log sum exp(2 t)`` over ``t >= 0``: the squares of all minors sum to 1 by Cauchy and Binet. A
certificate is a dual point: it proves its bound whatever found it. Derived here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from measurements.upper_bounds.pseudolines import Signs, arrangement_classes, minor_relations

_MAX_NEWTON_STEPS = 60
_DUALITY_GAP = 1e-11
_NEGLIGIBLE_WEIGHT = 1e-13  # weights below it are left out of a certificate
_WEIGHT_MARGIN = 1e-12  # by which weights are enlarged, so that rounding cannot refute a certificate
_PRECISION_BITS = 128


@dataclass(frozen=True, eq=False)
class MinorCertificate:
    """Dual point of the programme of one class.

    Attributes:
        n: Lines.
        signs: (C(n, 3),) of the minors.
        relation: (R,) weights of the relations, not negative; numbers as :func:`minor_relations` has them.
        split: (R,) share of the first of the two smaller products.
        weights: (C(n, 3),) of the minors, not negative.
    """

    n: int
    signs: Signs
    relation: FloatArray
    split: FloatArray
    weights: FloatArray

    def approximate_bound(self) -> float:
        """Return the upper bound of the least minor of this class in floating point; infinite if the point proves nothing."""
        first, second = _exponents(self.n, self.signs)
        exponents = (self.relation * self.split) @ first + (self.relation * (1 - self.split)) @ second
        total = self.weights.sum()
        if (2 * self.weights + exponents < -1e-9 * total).any() or (self.relation < 0).any():
            return np.inf
        is_interior = (self.split > 0) & (self.split < 1)
        entropy = np.zeros(len(self.split))
        v = self.split[is_interior]
        entropy[is_interior] = -v * np.log(v) - (1 - v) * np.log(1 - v)
        w = self.weights[self.weights > 0]
        return float(np.exp(-(np.log(total) + (self.relation @ entropy - w @ np.log(w)) / total) / 2))

    def proved_bound(self) -> float:
        """Return the bound in ball arithmetic, a number that is certainly not less than the least minor of this class.

        Raises:
            ImportError: python-flint is not installed (``pip install "holdfast-arms[certify]"``).
            ValueError: The signs are of no oriented matroid, or the point proves nothing.
        """
        import flint

        pairs, side = minor_relations(self.n)
        # With integers alone, apart from the programme: two products of one sign, and the third, alone, of the other.
        signs = [int(x) for x in self.signs]
        arb, before = flint.arb, flint.ctx.prec
        flint.ctx.prec = _PRECISION_BITS
        try:
            exponents: list[Any] = [arb(0)] * len(signs)
            proof = arb(0)
            for i in np.flatnonzero(self.relation).tolist():
                lam, v = arb(float(self.relation[i])), arb(float(self.split[i]))
                if not (lam >= 0 and v > 0 and v < 1):
                    raise ValueError("a weight of a relation is negative, or its split is no fraction")
                products = [int(s) * signs[a] * signs[b] for s, (a, b) in zip(side[i], pairs[i].tolist(), strict=True)]
                if abs(sum(products)) != 1 or not set(products) <= {-1, 1}:
                    raise ValueError("the signs are of no oriented matroid")
                alone = products.index(-sum(products))
                for k, weight in (((alone + 1) % 3, lam * v), ((alone + 2) % 3, lam * (1 - v)), (alone, -lam)):
                    for triple in pairs[i, k].tolist():
                        exponents[triple] = exponents[triple] + weight
                proof -= lam * (v * v.log() + (1 - v) * (1 - v).log())
            total = arb(0)
            for w, pulled in zip(map(float, self.weights), exponents, strict=True):
                if not 2 * arb(w) + pulled >= 0:
                    raise ValueError("the weights of the minors do not hold against those of the relations")
                total += arb(w)
                if w > 0:
                    proof -= arb(w) * arb(w).log()
            return float((-(total.log() + proof / total) / 2).exp().upper())
        finally:
            flint.ctx.prec = before


def _exponents(n: int, signs: Signs) -> tuple[FloatArray, FloatArray]:
    """Return for each relation the exponents of both smaller products over the largest, each (R, C(n, 3))."""
    pairs, side = minor_relations(n)
    products = side * signs[pairs[:, :, 0]] * signs[pairs[:, :, 1]]
    total = products.sum(axis=1)
    if (abs(total) != 1).any():
        raise ValueError("the signs are of no oriented matroid")
    largest = np.argmax(products == -total[:, None], axis=1)
    rows, found = np.arange(len(pairs)), []
    for shift in (1, 2):
        a = np.zeros((len(pairs), len(signs)))
        for triple, amount in ((pairs[rows, (largest + shift) % 3], 1.0), (pairs[rows, largest], -1.0)):
            np.add.at(a, (rows[:, None], triple), amount)
        found.append(a)
    return found[0], found[1]


def find_certificate(n: int, signs: Signs, enough: float = 0.0) -> MinorCertificate:
    """Solve the programme of one class by an interior point method, and stop at the first dual point that proves enough.

    Args:
        n: Lines.
        signs: (C(n, 3),) of an oriented matroid.
        enough: A bound at or below this will do; 0: the best one.

    Raises:
        ValueError: The signs are of no oriented matroid.
    """
    first, second = _exponents(n, signs)
    size, count = first.shape[1], len(first)
    difference = first - second
    t, lam = np.ones(size), np.full(count + size, 0.1)
    slack = np.ones(count + size)
    best_point: MinorCertificate | None = None
    smallest_bound = np.inf
    for _ in range(_MAX_NEWTON_STEPS):
        x, y = first @ t, second @ t
        top = np.maximum(x, y)
        value = top + np.log(np.exp(x - top) + np.exp(y - top))
        v = np.exp(x - value)
        soft = np.exp(2 * t - (2 * t).max())
        soft /= soft.sum()
        found = _certificate_from_dual(n, signs, lam[:count], v, soft, first, second)
        bound = found.approximate_bound()
        if bound < smallest_bound:
            best_point, smallest_bound = found, bound
        gap = slack @ lam / len(lam)
        if smallest_bound <= enough or gap < _DUALITY_GAP:
            break
        slope = v[:, None] * first + (1 - v)[:, None] * second
        residual = np.concatenate([value, -t]) + slack
        target = (0.1 if gap > 1e-4 else 0.02) * gap
        strength = lam / slack
        hessian = 4 * (np.diag(soft) - np.outer(soft, soft)) + np.diag(strength[count:])
        hessian += slope.T @ (strength[:count, None] * slope)
        hessian += difference.T @ ((lam[:count] * v * (1 - v))[:, None] * difference)
        aim = target / slack + strength * residual
        right = -2 * soft - slope.T @ aim[:count] + aim[count:]
        step = np.linalg.solve(hessian + 1e-13 * np.eye(size), right)
        along = np.concatenate([slope @ step, -step])
        dual = aim - lam + strength * along
        change = -residual - along
        part = min(1.0, 0.97 * _max_step(lam, dual), 0.97 * _max_step(slack, change))
        t, lam, slack = t + part * step, lam + part * dual, slack + part * change
    assert best_point is not None
    return best_point


def _max_step(values: FloatArray, change: FloatArray) -> float:
    """Return the largest step along a change that keeps all numbers positive."""
    falling = change < 0
    return float((values[falling] / -change[falling]).min()) if falling.any() else 2.0


def _certificate_from_dual(
    n: int, signs: Signs, lam: FloatArray, v: FloatArray, soft: FloatArray, first: FloatArray, second: FloatArray
) -> MinorCertificate:
    lam = np.where((lam > _NEGLIGIBLE_WEIGHT) & (v > 1e-15) & (v < 1 - 1e-15), lam, 0.0)
    exponents = (lam * v) @ first + (lam * (1 - v)) @ second
    weights = np.maximum(soft, -exponents / 2) * (1 + _WEIGHT_MARGIN) + _WEIGHT_MARGIN * 1e-3
    return MinorCertificate(n, signs, lam, v, weights)


def bounds_by_arrangement(n: int, enough: float = 0.0) -> list[float]:
    """Return the proved upper bound of the least minor of n lines in space for each class of their arrangements.

    The largest bounds relative manipulability after three failures of an arm with three degrees of redundancy.

    Args:
        n: Lines, 4 to 9; 9 takes minutes.
        enough: A class whose bound is at or below this is not bounded more tightly; 0 bounds each as tightly as can be.

    Raises:
        ImportError: python-flint is not installed (``pip install "holdfast-arms[certify]"``).

    Source: derived here.
    """
    return [find_certificate(n, signs, enough).proved_bound() for signs in arrangement_classes(n)]
