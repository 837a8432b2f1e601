"""How often each kind of interval holds the truth: 2,000 simulated studies of each case, at a nominal 0.95.

``python benchmarks/interval_coverage.py > benchmarks/INTERVALS.md`` writes the table of the page on intervals (some minutes).
``tests/test_interval_coverage.py`` computes the cases that are most likely to fail.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from holdfast.core.probability import Difference, Distribution, Interval
from holdfast.studies.designs import HeldOutResult

NOMINAL = 0.95
STUDIES = 2000
SEED = 2023

Study = Callable[[np.random.Generator, int], tuple[bool, float]]  # whether the truth is inside, and how wide the interval is


@dataclass(frozen=True)
class Case:
    """One kind of interval on one kind of data.

    Attributes:
        kind: Of interval.
        of: What is simulated.
        sizes: Numbers of independent starts, poses or motions.
        study: One study of a size.
        always: The interval is meant to cover at least as often as it says; else its limit is said where it is used.
    """

    kind: str
    of: str
    sizes: tuple[int, ...]
    study: Study
    always: bool = True

    def coverage(self, size: int, studies: int = STUDIES) -> tuple[float, float]:
        """Share of the studies whose interval holds the truth, and the mean width."""
        rng = np.random.default_rng([SEED, size])
        found = [self.study(rng, size) for _ in range(studies)]
        return float(np.mean([f[0] for f in found])), float(np.mean([f[1] for f in found]))


def _inside(found: Interval | Difference, truth: float) -> tuple[bool, float]:
    return found.low <= truth <= found.high, found.high - found.low


# ---- fractions: shares of the motions of a start, or of a path, between 0 and 1 ------------------------------------------

Draw = Callable[[np.random.Generator, int], np.ndarray]


def _mostly_one(rng: np.random.Generator, size: int) -> np.ndarray:
    return np.where(rng.random(size) < 0.95, 1.0, rng.random(size))


FRACTIONS: dict[str, tuple[Draw, float]] = {
    "symmetric, Beta(2, 2)": (lambda rng, n: rng.beta(2, 2, n), 0.5),
    "skewed, Beta(0.05, 1)": (lambda rng, n: rng.beta(0.05, 1, n), 0.05 / 1.05),
    "concentrated, Beta(90, 10)": (lambda rng, n: rng.beta(90, 10, n), 0.9),
    "0 or 1, mean 0.7": (lambda rng, n: (rng.random(n) < 0.7).astype(float), 0.7),
    "1 at 95 % of the starts": (_mostly_one, 0.975),
}


def _means(draw: Draw, truth: float) -> Study:
    return lambda rng, n: _inside(Interval.of_fractions(draw(rng, n)), truth)


def _paired_means(draw: Draw, truth: float) -> Study:
    """Of a first law, and of a second that fails at a tenth of the starts of the first."""

    def study(rng: np.random.Generator, n: int) -> tuple[bool, float]:
        first = draw(rng, n)
        second = np.where(rng.random(n) < 0.1, 0.0, first)
        return _inside(Difference.of_fractions(second - first), -0.1 * truth)

    return study


def _student(draw: Draw, truth: float) -> Study:
    return lambda rng, n: _inside(Difference.of_means(draw(rng, n)), truth)


# ---- shares and pairs of shares ------------------------------------------------------------------------------------------


def _share(truth: float) -> Study:
    return lambda rng, n: _inside(Interval.from_counts(int(rng.binomial(n, truth)), n), truth)


def _pairs(both: float, lost: float, won: float) -> Study:
    kinds = np.array([both, lost, won, 1 - both - lost - won])

    def study(rng: np.random.Generator, n: int) -> tuple[bool, float]:
        kind = rng.choice(4, n, p=kinds)
        return _inside(Difference.of_pairs(kind < 2, (kind == 0) | (kind == 2)), won - lost)

    return study


# ---- weighted samples: values uniform in (0, 1), weight w(x) -------------------------------------------------------------


@dataclass(frozen=True)
class Weight:
    """A weight of values in (0, 1), and the share of all weight below a value."""

    of: Callable[[np.ndarray], np.ndarray]
    below: Callable[[np.ndarray], np.ndarray]
    heaviest: float


def _heavy(share: float, weight: float) -> Weight:
    """The lowest values, a share of all, weigh so much; the others 1."""
    total = share * weight + 1 - share
    return Weight(
        lambda x: np.where(x < share, weight, 1.0),
        lambda x: np.where(x < share, weight * x, weight * share + x - share) / total,
        weight,
    )


WEIGHTS = {
    "weight 1 + 2x": Weight(lambda x: 1 + 2 * x, lambda x: (x + x**2) / 2, 3.0),
    "weight 50 for the lowest 2 %": _heavy(0.02, 50.0),
    "weight 20 for the lowest 10 %": _heavy(0.1, 20.0),
}


def _weighted(rng: np.random.Generator, n: int, w: Weight, known: bool) -> tuple[np.ndarray, Distribution]:
    x = np.sort(rng.random(n))
    return x, Distribution.from_values(x, "larger", weights=w.of(x), heaviest=w.heaviest if known else 0.0)


def _band(w: Weight, known: bool = True) -> Study:
    def study(rng: np.random.Generator, n: int) -> tuple[bool, float]:
        x, d = _weighted(rng, n, w, known)
        truth = w.below(x)
        off = max(np.abs(d.cdf(x) - truth).max(), np.abs(d.cdf(np.nextafter(x, 2)) - truth).max())
        return bool(off <= d.band()), 2 * min(d.band(), 1.0)

    return study


def _weighted_share(w: Weight, at: float) -> Study:
    def study(rng: np.random.Generator, n: int) -> tuple[bool, float]:
        _, d = _weighted(rng, n, w, known=True)
        return _inside(d.interval(at_least=at), 1 - float(w.below(np.array(at))))

    return study


def _quantile(level: float) -> Study:
    def study(rng: np.random.Generator, n: int) -> tuple[bool, float]:
        found = HeldOutResult.from_values(rng.random(n), np.ones(n), np.zeros(0), level=level)
        return _inside(found.guaranteed, 1 - level)

    return study


FEW, MANY = (5, 10, 30, 100), (5, 10, 30, 100, 300)
PAIRS = {
    "correlated, equal fractions": (0.55, 0.1, 0.1),
    "second fraction larger": (0.5, 0.05, 0.25),
    "never equal": (0.0, 0.5, 0.5),
    "independent": (0.25, 0.25, 0.25),
}
EVEN = Weight(np.ones_like, lambda x: x, 1.0)
CASES = [
    *(Case("fraction of starts (Clopper-Pearson)", f"fraction {p:g}", MANY, _share(p)) for p in (0.5, 0.1, 0.99)),
    *(Case("mean of fractions (betting)", name, MANY, _means(*f)) for name, f in FRACTIONS.items()),
    *(Case("difference of fractions (betting)", name, FEW, _paired_means(*f)) for name, f in FRACTIONS.items()),
    *(Case("difference of paired fractions (Newcombe)", name, FEW, _pairs(*p)) for name, p in PAIRS.items()),
    *(
        Case("mean of unbounded values (Student)", name, FEW, _student(*f), always)
        for name, f, always in (
            ("normal", (lambda rng, n: rng.normal(size=n), 0.0), True),
            ("skewed, lognormal", (lambda rng, n: rng.lognormal(sigma=1.5, size=n), float(np.exp(1.125))), False),
            ("skewed, Beta(0.05, 1)", FRACTIONS["skewed, Beta(0.05, 1)"], False),
        )
    ),
    Case("band of a distribution curve (Dvoretzky-Kiefer-Wolfowitz)", "equal weights", FEW, _band(EVEN)),
    *(Case("band of a weighted distribution curve", name, (5, 30, 300, 3000), _band(w)) for name, w in WEIGHTS.items()),
    Case(
        "band of a weighted distribution curve",
        "weight 50 for the lowest 2 %, unknown",
        (30, 100, 300, 3000),
        _band(WEIGHTS["weight 50 for the lowest 2 %"], known=False),
        always=False,
    ),
    *(
        Case("weighted fraction", f"{name}, at least {at:g}", (5, 30, 300), _weighted_share(w, at))
        for (name, w), at in zip(WEIGHTS.items(), (0.5, 0.01, 0.05), strict=True)
    ),
    *(
        Case("value that a fraction of the poses reaches (order statistics)", f"{v:.0%}", FEW, _quantile(v))
        for v in (0.5, 0.95)
    ),
]


def main() -> None:
    """The table, in Markdown."""
    print("<!-- Written by `python benchmarks/interval_coverage.py`. -->")
    for kind, group in groupby(CASES, lambda c: c.kind):
        cases = list(group)
        sizes = sorted({n for c in cases for n in c.sizes})
        print(f"\n**{kind[0].upper()}{kind[1:]}**\n\n| simulated data | {' | '.join(map(str, sizes))} |")
        print("|---" * (1 + len(sizes)) + "|")
        for c in cases:
            cells = ["{:.3f} ({:.2g})".format(*c.coverage(n)) if n in c.sizes else "" for n in sizes]
            print(f"| {c.of} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
