"""Finds the certificates of theorem R3: ``python -m measurements.upper_bounds.pair_certificates``
(``--cases 6,2``), minutes a case.

Writes ``pair_certificates.json``. Needs ``cvxpy`` and ``clarabel``, which holdfast does
not: a certificate is replayed in integers by ``pair_kernels``, whatever found it, and none is stored that
is not.
"""

from __future__ import annotations

import argparse
import json
from fractions import Fraction
from math import comb, sqrt
from pathlib import Path
from typing import Any

import cvxpy as cp
import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_chebyt, eval_gegenbauer

import holdfast as hf
from measurements.upper_bounds.pair_kernels import stored_certificates

Array = NDArray[np.float64]
FILE = Path(__file__).parent / "pair_certificates.json"
CASES = [(5, 2), (6, 2), (7, 2), (8, 2), (9, 2), (10, 2), (7, 3), (8, 3), (9, 3), (10, 3)]
ROW, NULL, POWERS, FREE = 4, 3, 3, 5  # degrees of the two sides, powers of the weights and of the free functions
BACK = 0.01  # of the way from the least bound with a kernel to the mean over all pairs, so that it can be proven
HALVINGS, ROUNDS, TRIED = 9, 15, 60_000
LEAST = 1e-6  # margin below which a kernel is not taken for one


class Programme:
    """The kernels of one size that a target might be refuted with."""

    def __init__(self, n: int, m: int, bound: float) -> None:
        self.n, self.m, self.target = n, m, bound**2
        self.largest = 1 - self.target * (n - 1) / (n - m - 1)
        self.least = max(0.0, m - (n - 1) * self.largest)
        self.rng = np.random.default_rng(0)

    def powers(self, y: Array, count: int) -> Array:
        """(B, count) powers of the length."""
        return np.stack([(4 * (y - self.m / self.n)) ** a for a in range(count)], axis=1)

    def pairs(self, y: Array, z: Array, s: Array) -> tuple[list[Array], list[Array]]:
        """What each number of a kernel adds for pairs: of the semidefinite ones and of the free ones."""
        outer = self.powers(y, POWERS)[:, :, None] * self.powers(z, POWERS)[:, None, :]
        both = ((outer + outer.transpose(0, 2, 1)) / 2).reshape(len(y), -1)
        w = (1 - y) * (1 - z)
        definite = [both * gegenbauer(i, self.m, s)[:, None] for i in range(ROW + 1)]
        definite += [both * (w**i * gegenbauer(i, self.n - self.m, y * z * s / w))[:, None] for i in range(1, NULL + 1)]
        h, k = self.powers(y, FREE), self.powers(z, FREE)
        free = [(h * (z * s)[:, None] + k * (y * s)[:, None]) / 2, (h * z[:, None] + k * y[:, None]) / 2, (h + k) / 2]
        return definite, free

    def joints(self, y: Array) -> tuple[list[Array], list[Array]]:
        """The same for each joint."""
        b, h = self.powers(y, POWERS), self.powers(y, FREE)
        both = (b[:, :, None] * b[:, None, :]).reshape(len(y), -1)
        definite = [both] * (ROW + 1) + [both * ((1 - y) ** (2 * i))[:, None] for i in range(1, NULL + 1)]
        return definite, [h * (y - 1)[:, None], h * (y - self.m)[:, None], -(self.n - 1) * h]

    def placed(self, unit: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
        """Pairs from (3, B) numbers of 0 to 1, and which of them may be: those that leave the target or more."""
        y, z = self.least + (self.largest - self.least) * unit[:2]
        top = ((1 - y) * (1 - z) - self.target) / np.maximum(y * z, 1e-12)
        return y, z, unit[2] * np.clip(top, 0, 1), top >= 0

    def solve(self) -> tuple[list[Array], list[Array], float] | None:
        """A kernel that is negative for all pairs and joints, as far as samples tell; None if there is none."""
        spaced = (1 - np.cos(np.linspace(0, np.pi, 13))) / 2
        unit = np.stack(np.meshgrid(spaced, spaced, np.linspace(0, 1, 8), indexing="ij")).reshape(3, -1)
        unit = unit[:, self.placed(unit)[3] & (unit[0] <= unit[1])]
        ends = self.least + (self.largest - self.least) * (1 - np.cos(np.linspace(0, np.pi, 400))) / 2
        for _ in range(ROUNDS):
            weights = [cp.Variable((POWERS, POWERS), PSD=True) for _ in range(ROW + 1 + NULL)]
            free = [cp.Variable(FREE) for _ in range(3)]
            margin = cp.Variable()

            def total(features: tuple[list[Array], list[Array]], weights: Any = weights, free: Any = free) -> Any:
                definite = (a @ cp.vec(m, order="C") for a, m in zip(features[0], weights, strict=True))
                return sum(definite) + sum(a @ h for a, h in zip(features[1], free, strict=True))

            held = [
                total(self.pairs(*self.placed(unit)[:3])) <= -margin / (self.n - 1),
                total(self.joints(ends)) <= -margin,
                sum(cp.trace(m) for m in weights) == 1,
            ]
            try:
                cp.Problem(cp.Maximize(margin), held).solve(solver=cp.CLARABEL)
            except cp.SolverError:
                return None
            if margin.value is None or margin.value < LEAST:
                return None
            found = [m.value for m in weights], [h.value for h in free]
            tried, worst = self.highest(*found)
            share = float(margin.value) / (self.n - 1)
            if worst.max() < -0.3 * share:
                found[1][2][0] -= 0.8 * share  # margin that the joints do not need
                return *found, float(margin.value)
            unit = np.hstack([unit, tried[:, worst > -0.9 * share]])
        return None

    def highest(self, weights: list[Array], free: list[Array]) -> tuple[Array, Array]:
        """Where a kernel is largest: (3, B), and its values; random pairs, the best of them moved uphill at random."""

        def value(unit: Array) -> Array:
            y, z, s, may = self.placed(unit)
            definite, others = self.pairs(y, z, s)
            found = sum(a @ m.ravel() for a, m in zip(definite, weights, strict=True))
            return np.where(may, found + sum(a @ h for a, h in zip(others, free, strict=True)), -np.inf)

        unit, edge = self.rng.random((2, 3, TRIED))
        unit[edge < 0.1], unit[edge > 0.85] = 0, 1
        values = value(unit)
        best = np.argsort(-values)[:300]
        unit, values = unit[:, best], values[best]
        for step in np.repeat([0.03, 0.01, 0.003, 0.001, 0.0003], 12):
            moved = np.clip(unit + step * self.rng.normal(size=unit.shape) * (self.rng.random(unit.shape) < 0.6), 0, 1)
            new = value(moved)
            unit[:, new > values], values = moved[:, new > values], np.maximum(new, values)
        return unit, values


def gegenbauer(degree: int, dimension: int, s: Array) -> Array:
    """Of degree ``2 degree`` in the cosine, 1 at 1; s is its square."""
    x = np.sqrt(s)
    if dimension == 2:
        return np.asarray(eval_chebyt(2 * degree, x))
    a = (dimension - 2) / 2
    return np.asarray(eval_gegenbauer(2 * degree, a, x) / eval_gegenbauer(2 * degree, a, 1.0))


def found(n: int, m: int) -> dict[str, Any]:
    """A certificate near the least bound that has one."""
    low = float(hf.index_bounds.upper_bound(n=n, m=m, k=2).best_known or 0)
    high = mean = sqrt(comb(n - m, 2) / comb(n, 2))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if Programme(n, m, middle).solve() is None:
            low = middle
        else:
            high = middle
    bound = round(high + BACK * (mean - high), 6)
    kernel = Programme(n, m, bound).solve()
    if kernel is None:
        raise ValueError(f"no kernel for {n} joints and {m} rows at {bound}; give more room")
    weights, free, margin = kernel
    print(f"{n},{m}: least {high:.6f}, taken {bound:.6f}, margin {margin:.1e}", flush=True)
    sides = [[[round(float(x), 11) for x in row] for row in factor(w)] for w in weights]
    linear = [[float(f"{x:.11g}") for x in h] for h in free]
    return {"joints": n, "rows": m, "bound": bound, "row": sides[: ROW + 1], "null": sides[ROW + 1 :], "linear": linear}


def factor(weights: Array) -> Array:
    """R, lower triangular, with ``R R'`` the weights but for what is negative by rounding."""
    values, vectors = np.linalg.eigh((weights + weights.T) / 2)
    return np.asarray(np.linalg.qr((vectors * np.sqrt(np.maximum(values, 0))).T)[1].T)


def main() -> None:
    """Find, store, replay; a certificate that does not hold is taken out again."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--cases", nargs="*", default=[",".join(map(str, c)) for c in CASES], help="such as 6,2; all if not given"
    )
    stored = {(c["joints"], c["rows"]): c for c in json.loads(FILE.read_text(encoding="utf-8"))} if FILE.exists() else {}
    for name in parser.parse_args().cases:
        n, m = map(int, name.split(","))
        before, stored[n, m] = stored.get((n, m)), found(n, m)
        written(stored)
        stored_certificates.cache_clear()
        try:
            assert Fraction(stored_certificates()[n, m].proved_bound()) >= stored_certificates()[n, m].bound
        except ValueError as error:
            print(f"{name}: {error}", flush=True)
            if before is None:
                del stored[n, m]
            else:
                stored[n, m] = before
            written(stored)


def written(stored: dict[tuple[int, int], dict[str, Any]]) -> None:
    """A line a certificate."""
    FILE.write_text("[\n" + ",\n".join(json.dumps(stored[key]) for key in sorted(stored)) + "\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
