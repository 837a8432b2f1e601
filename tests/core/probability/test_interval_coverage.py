"""Intervals hold the truth as often as they say: 2,000 simulated studies for each kind, in the cases likeliest to fail.

The whole table, with widths, is written by benchmarks/interval_coverage.py.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from holdfast.core.probability import Distribution
from holdfast.core.probability.intervals import BETTING_ORDERS, Difference, Interval, _BettingCapital

LEAST = 0.94  # of a nominal 0.95

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))
try:
    import interval_coverage as table
finally:
    sys.path.pop(0)

HARD = {
    "fraction of starts (Clopper-Pearson)": ("fraction 0.1", (5, 30)),
    "mean of fractions (betting)": ("skewed, Beta(0.05, 1)", (5, 30)),
    "difference of fractions (betting)": ("0 or 1, mean 0.7", (5,)),
    "difference of paired fractions (Newcombe)": ("never equal", (5, 30)),
    "mean of unbounded values (Student)": ("normal", (5,)),
    "band of a distribution curve (Dvoretzky-Kiefer-Wolfowitz)": ("equal weights", (5, 100)),
    "band of a weighted distribution curve": ("weight 50 for the lowest 2 %", (5, 300)),
    "weighted fraction": ("weight 20 for the lowest 10 %, at least 0.05", (5, 300)),
    "value that a fraction of the poses reaches (order statistics)": ("95%", (5, 100)),
}


def case(kind: str, of: str):
    return next(c for c in table.CASES if (c.kind, c.of) == (kind, of))


def test_every_kind_of_interval_is_in_the_table():
    assert set(HARD) == {c.kind for c in table.CASES}


@pytest.mark.parametrize("kind", HARD)
def test_intervals_cover_from_five_starts_on(kind):
    of, sizes = HARD[kind]
    for size in sizes:
        share, _ = case(kind, of).coverage(size)
        assert share >= LEAST, f"{kind}, {of}, {size} starts"


def test_the_table_can_tell_an_interval_that_does_not_cover():
    """Student's t of 30 skewed fractions covers 0.81, which is why fractions have another interval."""
    share, _ = case("mean of unbounded values (Student)", "skewed, Beta(0.05, 1)").coverage(30, 500)
    assert share < 0.88


# ---- the betting interval by other routes --------------------------------------------------------------------------------


def test_the_gamblers_capital_is_a_fair_game():
    """Over all sequences of three values 0, 1/2, 1, weighted by their probability, the capital is 1 at the true mean."""
    chance = np.array([0.2, 0.3, 0.5])
    mean, grid = float(chance @ [0, 0.5, 1]), np.array([0.0, 0.5, 1.0])
    expected = 0.0
    for row in np.ndindex(3, 3, 3):
        capital = float(np.exp(_BettingCapital(grid[list(row)], 0.95).log_capital(mean)))
        expected += float(np.prod(chance[list(row)])) * capital
    assert expected == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("chance", [0.02, 0.2, 0.5, 0.9])
def test_betting_on_a_coin_covers_by_enumeration(chance):
    """All 2^8 sequences of 8 throws, weighted by their probability: no random numbers."""
    covered = 0.0
    for number in range(256):
        throws = np.array([number >> k & 1 for k in range(8)], dtype=float)
        found = Interval.of_fractions(throws)
        covered += chance ** throws.sum() * (1 - chance) ** (8 - throws.sum()) * (found.low <= chance <= found.high)
    assert covered >= 0.95


def test_a_betting_interval_by_scanning_the_means(rng):
    """The capital written out from the definition, one bet after the other, on a grid of means."""
    values = rng.beta(0.5, 2, 12)
    found = Interval.of_fractions(values, 0.9)
    shuffle = np.random.default_rng(0)
    orders = [values] + [shuffle.permutation(values) for _ in range(BETTING_ORDERS - 1)]

    def refused(m: float, orders: list[np.ndarray]) -> bool:
        total = 0.0
        for order in orders:
            capital, seen, squares = 1.0, 0.5, 0.25
            for i, x in enumerate(order):
                stake = min(np.sqrt(2 * np.log(2 / 0.1) / (12 * squares / (i + 1))), 0.75 / m)
                capital *= 1 + stake * (x - m)
                seen += x
                squares += (x - seen / (i + 2)) ** 2
            total += capital / BETTING_ORDERS
        return total >= 2 / 0.1

    grid = np.linspace(0.001, 0.999, 999)
    kept = [m for m in grid if not refused(m, orders) and not refused(1 - m, [1 - o for o in orders])]
    assert min(kept) - 0.001 <= found.low <= min(kept)
    assert max(kept) <= found.high <= max(kept) + 0.001
    assert found.value == pytest.approx(values.mean())


def test_the_order_of_the_starts_hardly_matters(rng):
    values = np.sort(rng.beta(0.3, 1, 40))
    ends = np.array(
        [[f.low, f.high] for f in (Interval.of_fractions(v) for v in (values, values[::-1], rng.permutation(values)))]
    )
    assert np.ptp(ends, axis=0).max() < 0.1 * np.diff(ends, axis=1).min()


@pytest.mark.parametrize("values", [[0.0], [1.0], [1.0] * 7, [0.0] * 2000, [0.5], [0.3] * 50, [0.0] * 999 + [1.0]])
def test_betting_at_the_edges(values):
    found = Interval.of_fractions(np.array(values))
    mirrored = Interval.of_fractions(1 - np.array(values))
    assert 0 <= found.low <= found.value <= found.high <= 1
    np.testing.assert_allclose((found.low, found.high), (1 - mirrored.high, 1 - mirrored.low), atol=1e-8)
    if len(set(values)) == 1 and values[0] in (0.0, 1.0):
        exact = Interval.from_counts(sum(values), len(values))
        assert found.high - found.low >= exact.high - exact.low - 1e-9  # nothing that always covers is narrower


def test_differences_of_fractions_mirror_means_and_test(rng):
    apart = rng.uniform(-0.2, 0.9, 60)
    found, back = Difference.of_fractions(apart), Difference.of_fractions(-apart)
    np.testing.assert_allclose((found.value, found.low, found.high), (-back.value, -back.high, -back.low), atol=1e-8)
    assert found.p_value == pytest.approx(back.p_value)
    assert found.low > 0
    assert found.p_value < 0.05
    assert Difference.of_fractions(np.zeros(9)).p_value == 1
    rejected = np.mean([Difference.of_fractions(rng.uniform(-1, 1, 20)).p_value < 0.05 for _ in range(400)])
    assert rejected <= 0.05


# ---- weights ---------------------------------------------------------------------------------------------------------------


def test_a_weighted_share_scatters_no_more_than_the_effective_samples_say(rng):
    """The variance of the weighted share, by simulation, against ``p (1 - p) / effective``; Kish's size fails here."""
    weight, at, size = table.WEIGHTS["weight 50 for the lowest 2 %"], 0.01, 2000
    truth = 1 - float(weight.below(np.array(at)))
    shares, sizes, kish = [], [], []
    for _ in range(600):
        x = rng.random(size)
        w = weight.of(x)
        d = Distribution.from_values(x, "larger", weights=w)
        shares.append(d.probability(at_least=at))
        sizes.append(d.effective())
        kish.append(w.sum() ** 2 / (w @ w))
    scatter = np.mean((np.array(shares) - truth) ** 2)
    assert scatter <= truth * (1 - truth) / np.mean(sizes)
    assert scatter > 1.2 * truth * (1 - truth) / np.mean(kish)


def test_a_density_knows_its_heaviest_weight():
    import holdfast as hf

    box = hf.Region.box([1, 0, 0], [1, 1, 1], weight={"x": [(0.5, 1), (1.5, 4)], "z": [(0, 2), (0.5, 1)]})
    assert box.heaviest == 8.0
    poses = np.tile(np.eye(4), (3, 1, 1))
    assert hf.Region.from_poses(poses, [1, 7, 2]).heaviest == 7
    seen = Distribution.from_values([0.1, 0.2], "larger", weights=[1, 1], heaviest=10)
    assert seen.effective() == pytest.approx(0.2)
    assert seen.band() == 1.0
