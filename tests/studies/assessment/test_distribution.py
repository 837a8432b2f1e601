"""The distribution against counting by hand, intervals against textbook formulas and simulated coverage."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from holdfast.core.errors import InputError
from holdfast.core.probability import Distribution, Interval
from holdfast.core.probability.collector import DistributionCollector

BETTER = ["larger", "smaller"]


class Counting:
    """Every sample in one list: what is not reached is the worst there can be."""

    def __init__(self, values, better, unreached, reachable_only):
        lost = [] if reachable_only else [0.0 if better == "larger" else np.inf] * unreached
        self.all = np.sort(np.r_[np.asarray(values, float), lost])

    def cdf(self, h):
        return (self.all < h).sum() / self.all.size

    def at_least(self, h):
        return (self.all >= h).sum() / self.all.size

    def at_most(self, h):
        return (self.all <= h).sum() / self.all.size

    def quantile(self, p):
        """Smallest value v with share(value <= v) >= p."""
        return next(v for v in self.all if (self.all <= v).sum() / self.all.size >= p)


def sample(rng, better, size=300):
    values = rng.choice([0.0, 0.1, 0.25, 0.5], size)
    values[: size // 3] = rng.random(size // 3) * 0.6
    if better == "smaller":
        values[size // 2 : size // 2 + 20] = np.inf
    return rng.permutation(values)


@pytest.mark.parametrize("reachable_only", [False, True])
@pytest.mark.parametrize("better", BETTER)
def test_against_counting(better, reachable_only, rng):
    values = sample(rng, better)
    d = Distribution.from_values(values, better, unreached=41, singular=5)
    oracle = Counting(values, better, 41, reachable_only)
    thresholds = np.r_[-1, 0, 1e-300, values[np.isfinite(values)], 0.3, 0.7, 1e9]
    np.testing.assert_array_equal(d.cdf(thresholds, reachable_only), [oracle.cdf(h) for h in thresholds])
    for h in thresholds[::7]:
        assert d.probability(at_least=h, reachable_only=reachable_only) == pytest.approx(oracle.at_least(h), abs=1e-15)
        assert d.probability(at_most=h, reachable_only=reachable_only) == pytest.approx(oracle.at_most(h), abs=1e-15)
    shares = np.r_[0, 1, rng.random(200)]
    np.testing.assert_array_equal(d.quantile(shares, reachable_only), [oracle.quantile(p) for p in shares])
    assert (d.reached, d.unreached, d.samples, d.singular) == (300, 41, 341, 5)
    finite = values[np.isfinite(values)]
    assert d.mean == pytest.approx(finite.mean())
    assert (d.lowest, d.highest) == (finite.min(), finite.max())


def test_strictly_below_at_zero():
    """Specification, section 4: F(0) = 0 and the probability of at least 0 is 1, zeros and unreached poses or not."""
    d = Distribution.from_values([0, 0, 0.1, 0.2], "larger", unreached=6)
    assert d.cdf(0) == 0
    assert d.probability(at_least=0) == 1
    assert d.cdf(5e-324) == 0.8
    assert d.probability(at_most=0) == 0.8
    assert d.cdf(0.2) == 0.9


def test_infinity_is_a_value_like_any_other():
    d = Distribution.from_values([1, 2, np.inf], "smaller", unreached=1)
    assert d.probability(at_most=2) == 0.5
    assert d.probability(at_least=np.inf) == 0.5
    assert d.probability(at_most=1e308) == 0.5
    assert d.cdf(np.inf) == 0.5
    assert d.probability(at_most=np.inf) == 1


def test_a_quantile_at_a_whole_number_of_samples():
    """0.07 * 100 is a little above 7 in floating point; the seventh of a hundred has a share of 0.07."""
    values = np.arange(1, 101) / 100
    shares = np.arange(1, 101) / 100
    np.testing.assert_array_equal(Distribution.from_values(values, "larger").quantile(shares), values)


def test_scalars_and_arrays_keep_their_shape():
    d = Distribution.from_values([0.1, 0.2, 0.3], "larger")
    assert d.cdf(0.2).shape == ()
    assert d.cdf(np.zeros((2, 3))).shape == (2, 3)
    assert d.quantile(0.5).shape == ()
    assert d.quantile([[0.1], [0.9]]).shape == (2, 1)


# ---- properties ----------------------------------------------------------------------------------------------------

numbers = st.one_of(st.sampled_from([0.0, 0.1, 0.2, 0.5]), st.floats(0, 1, allow_subnormal=False))
cases = st.tuples(st.lists(numbers, min_size=1, max_size=40), st.integers(0, 12), st.sampled_from(BETTER), st.booleans())


@settings(max_examples=150)
@given(cases, st.lists(numbers, min_size=2, max_size=8))
def test_cdf_is_monotone_and_complements_the_probability(case, thresholds):
    values, unreached, better, only = case
    d, oracle = Distribution.from_values(values, better, unreached), Counting(values, better, unreached, only)
    h = np.sort(thresholds)
    f = d.cdf(h, only)
    assert (np.diff(f) >= 0).all()
    assert ((f >= 0) & (f <= 1)).all()
    for x, share in zip(h, f, strict=True):
        assert d.probability(at_least=x, reachable_only=only) + share == pytest.approx(1, abs=1e-15)
        assert share == oracle.cdf(x)
        assert d.probability(at_most=x, reachable_only=only) == pytest.approx(oracle.at_most(x), abs=1e-15)


@settings(max_examples=150)
@given(
    cases, st.one_of(st.floats(0, 1), st.tuples(st.integers(0, 52), st.integers(1, 52)).map(lambda t: min(t[0] / t[1], 1.0)))
)
def test_quantile_inverts_the_cdf(case, p):
    values, unreached, better, only = case
    d, oracle = Distribution.from_values(values, better, unreached), Counting(values, better, unreached, only)
    v = float(d.quantile(p, only))
    assert v == oracle.quantile(p)
    assert d.cdf(v, only) <= p  # everything below the quantile is less than its share ...
    if np.isfinite(v):
        assert d.probability(at_most=v, reachable_only=only) >= p  # ... and up to it, at least


# ---- error bars ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("hits", "n", "confidence"), [(12, 40, 0.95), (0, 25, 0.99), (25, 25, 0.9)])
def test_an_interval_is_the_exact_one(hits, n, confidence):
    """Clopper and Pearson 1934: at either end the count, or one more extreme, has half of what is left of the probability."""
    d = Distribution.from_values(np.r_[np.ones(hits), np.zeros(n - hits)], "larger")
    found = d.interval(at_least=0.5, confidence=confidence)
    assert found.value == hits / n
    if hits:
        assert stats.binom.sf(hits - 1, n, found.low) == pytest.approx((1 - confidence) / 2)
    if hits < n:
        assert stats.binom.cdf(hits, n, found.high) == pytest.approx((1 - confidence) / 2)
    assert (found.low == 0, found.high == 1) == (hits == 0, hits == n)
    assert found.confidence == confidence


def test_an_interval_reads_as_a_sentence():
    assert str(Interval(value=0.5, low=0.25, high=0.75, confidence=0.95)) == "0.5000 (0.2500 to 0.7500, 95%)"


@pytest.mark.parametrize(("n", "expected"), [(500, 0.061), (2000, 0.030)])
def test_band_is_that_of_the_specification(n, expected):
    d = Distribution.from_values(np.zeros(n // 2), "larger", unreached=n - n // 2)
    assert d.band() == pytest.approx(expected, abs=5e-4)
    assert d.band() == pytest.approx(np.sqrt(np.log(40) / (2 * n)))
    assert d.band(0.99) == pytest.approx(np.sqrt(np.log(200) / (2 * n)))
    assert d.band(reachable_only=True) == pytest.approx(d.band() * np.sqrt(2))


@pytest.mark.parametrize(("confidence", "at_most"), [(0.95, 0.985), (0.5, 0.65)])
def test_band_covers_the_true_cdf_as_often_as_it_says(confidence, at_most):
    """400 samples of 200 from U(0, 1): the whole true CDF is inside at least as often as promised, and not always."""
    generator, inside = np.random.default_rng(2012), 0
    for _ in range(400):
        x = np.sort(generator.random(200))
        d = Distribution.from_values(x, "larger")
        off = max(np.abs(d.cdf(x) - x).max(), np.abs(d.cdf(np.nextafter(x, 2)) - x).max())
        inside += off <= d.band(confidence)
    noise = 3 * np.sqrt(confidence * (1 - confidence) / 400)
    assert confidence - noise <= inside / 400 <= at_most


def test_an_interval_covers_the_true_probability():
    generator, inside = np.random.default_rng(1927), 0
    for _ in range(400):
        found = Distribution.from_values(generator.random(200), "larger").interval(at_least=0.8)
        inside += found.low <= 0.2 <= found.high
    assert 0.917 <= inside / 400 <= 0.985


# ---- density -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("better", BETTER)
def test_density_integrates_to_the_finite_share(better, rng):
    values = sample(rng, better)
    d = Distribution.from_values(values, better, unreached=100)
    edges, density = d.density(23)
    assert (len(edges), len(density)) == (24, 23)
    finite = values[np.isfinite(values)]
    assert (density * np.diff(edges)).sum() == pytest.approx(finite.size / values.size)
    assert (edges[0], edges[-1]) == (finite.min(), finite.max())
    counts = [((finite >= a) & (finite < b)).sum() for a, b in itertools.pairwise(edges)]
    counts[-1] += (finite == edges[-1]).sum()
    np.testing.assert_allclose(density * np.diff(edges) * values.size, counts, atol=1e-9)


@pytest.mark.parametrize(
    "values",
    [[0.3], [0.3] * 5, [0.0] * 5, [0.127, np.nextafter(0.127, 1)], [1e12, np.nextafter(1e12, 2e12)], [0.0, 2.3e-308]],
    ids=["one", "equal", "zeros", "rounding noise", "rounding noise, large", "the least numbers there are"],
)
def test_density_of_values_that_hardly_differ(values):
    """An index that does not depend on the joints that move: equal but for rounding."""
    edges, density = Distribution.from_values(values, "larger").density()
    assert np.isfinite(density).all()
    assert (np.diff(edges) > 0).all()
    assert (density * np.diff(edges)).sum() == pytest.approx(1)


def test_density_when_all_is_infinite():
    edges, density = Distribution.from_values([np.inf] * 3, "smaller").density()
    assert (np.diff(edges) > 0).all()
    assert (density == 0).all()


# ---- nothing there -------------------------------------------------------------------------------------------------


def test_no_sample_at_all_is_said():
    d = Distribution.from_values([], "larger")
    for ask in (lambda: d.cdf(0.1), lambda: d.probability(at_least=0.1), lambda: d.quantile(0.5), d.band, d.density):
        with pytest.raises(InputError, match=r"no samples"):
            ask()
    assert np.isnan(d.mean)


@pytest.mark.parametrize("binned", [False, True])
@pytest.mark.parametrize("better", BETTER)
def test_all_unreached(better, binned):
    d = Distribution.from_values([], better, unreached=50)
    if binned:
        collector = DistributionCollector(better, None, most=-1)
        collector.add(np.zeros(0), 50, 0)
        d = collector.make_distribution()
    worst = 0.0 if better == "larger" else np.inf
    assert d.quantile(0.5, reachable_only=False) == worst
    assert d.cdf(0) == 0
    if better == "larger":
        assert d.cdf(0.1) == 1
        assert d.probability(at_least=0.1) == 0
    else:
        assert d.cdf(1e300) == 0
        assert d.probability(at_most=1e300) == 0
    assert d.interval(at_least=0.1).high < 1 or better == "smaller"
    for ask in (lambda: d.cdf(0.1, True), lambda: d.quantile(0.5), lambda: d.band(reachable_only=True), d.density):
        with pytest.raises(InputError, match="no pose was reached"):
            ask()


def test_wrong_questions_are_refused():
    d = Distribution.from_values([0.1, 0.2], "larger")
    with pytest.raises(InputError, match="exactly one"):
        d.probability()
    with pytest.raises(InputError, match="exactly one"):
        d.probability(at_least=0.1, at_most=0.2)
    for confidence in (0, 1, 95, -1, np.nan):
        with pytest.raises(InputError, match="confidence"):
            d.interval(at_least=0.1, confidence=confidence)
        with pytest.raises(InputError, match="confidence"):
            d.band(confidence)
    for p in (-0.1, 1.1, np.nan):
        with pytest.raises(InputError, match="quantile"):
            d.quantile(p)


@pytest.mark.parametrize("which", ["at_least", "at_most"])
def test_a_threshold_of_nan_is_refused(which):
    with pytest.raises(InputError, match=r"(?i)nan|number"):
        Distribution.from_values([0.1, 0.2], "larger").probability(**{which: np.nan})


# ---- chunk by chunk ------------------------------------------------------------------------------------------------


def collect(values, better, bound, most, parts=13, unreached=0, singular=0):
    collector = DistributionCollector(better, bound, most)
    for part in np.array_split(values, parts):
        collector.add(part, unreached, singular)
    return collector.make_distribution()


def test_collector_is_exact_while_it_can_be(rng):
    values = rng.permutation(sample(rng, "larger"))
    d = collect(values, "larger", 0.6, most=300, unreached=2, singular=1)
    exact = Distribution.from_values(values, "larger", 26, singular=13)
    np.testing.assert_array_equal(d.values, exact.values)
    assert (d.samples, d.unreached, d.singular, d.infinite) == (326, 26, 13, 0)


def test_binned_distribution_agrees_to_its_resolution(rng):
    """3e5 values in 65,535 bins up to the bound: everything is right to one bin."""
    bound = 0.5773502691896257
    values = rng.permutation(np.r_[bound * rng.beta(2, 3, 300_000), np.zeros(500)])
    d, exact = collect(values, "larger", bound, 20_000, unreached=7), Distribution.from_values(values, "larger", 91)
    assert d.values is None
    width = bound / 65_535
    h = np.r_[0, rng.uniform(0, bound, 400), bound, 1]
    for only in (False, True):
        f = d.cdf(h, only)
        assert (np.diff(d.cdf(np.sort(h), only)) >= 0).all()
        assert (f >= exact.cdf(np.maximum(h - 1.01 * width, 0), only) - 1e-12).all()
        assert (f <= exact.cdf(h + 1.01 * width, only) + 1e-12).all()
        p = np.r_[0.001, rng.random(200), 0.999]
        np.testing.assert_allclose(d.quantile(p, only), exact.quantile(p, only), atol=1.01 * width)
    assert d.probability(at_least=0.2) == pytest.approx(exact.probability(at_least=0.2), abs=1e-4)
    assert d.interval(at_least=0.2).low == pytest.approx(exact.interval(at_least=0.2).low, abs=1e-4)
    assert d.cdf(0) == 0
    assert d.probability(at_least=0) == 1
    assert (d.reached, d.samples, d.band()) == (exact.reached, exact.samples, exact.band())
    assert d.mean == pytest.approx(exact.mean, rel=1e-12)
    assert (d.lowest, d.highest) == (exact.lowest, exact.highest)
    edges, density = d.density(30)
    reference = np.histogram(values, edges)[0] / values.size
    np.testing.assert_allclose(density * np.diff(edges), reference, atol=1e-4)
    assert (density * np.diff(edges)).sum() == pytest.approx(1)


def test_values_beyond_what_the_first_ones_showed(rng):
    first, later = rng.uniform(0.4, 0.5, 2000), np.r_[rng.uniform(0.4, 0.5, 6000), np.full(1000, 3.0), np.full(1000, 1e6)]
    collector = DistributionCollector("larger", None, most=1000)
    collector.add(first, 0, 0)
    collector.add(later, 0, 0)
    d = collector.make_distribution()
    assert d.probability(at_least=0.6) == pytest.approx(0.2)
    assert d.cdf(0.45) == pytest.approx((np.r_[first, later] < 0.45).mean(), abs=1e-3)
    assert d.highest == 1e6
    assert d.mean == pytest.approx(np.r_[first, later].mean())
    assert d.counts.sum() == 10_000


def test_binned_negative_values(rng):
    """An index of one's own may be negative everywhere."""
    values = rng.uniform(-3, -1, 30_000)
    d = collect(values, "larger", None, 1000)
    np.testing.assert_allclose(d.quantile([0.05, 0.5, 0.95]), np.quantile(values, [0.05, 0.5, 0.95]), atol=0.01)
    assert d.cdf(-2) == pytest.approx((values < -2).mean(), abs=1e-3)


@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize(("better", "bound"), [("larger", 0.5), ("smaller", None)])
def test_binned_quantiles_at_the_bound_and_among_infinite_values(better, bound, weighted, rng):
    """Most values sit at the bound, in the last bin, which has no upper end; infinite values are in it too."""
    values = rng.permutation(np.r_[np.full(6000, 0.5), rng.uniform(0, 0.5, 3000), np.full(0 if bound else 1000, np.inf)])
    collector = DistributionCollector(better, bound, most=1000)
    for part in np.array_split(values, 7):
        weights = (np.ones(len(part)), np.ones(2)) if weighted else ()
        collector.add(part, 2, 0, *weights)
    d, exact = collector.make_distribution(), Distribution.from_values(values, better, 14)
    p = np.r_[0.0, 0.1, 0.3, 0.5, 0.89, 0.899, 0.9, 0.95, 1.0]
    for only in (True, False):
        np.testing.assert_allclose(d.quantile(p, only), exact.quantile(p, only), atol=2e-4)
        np.testing.assert_allclose(
            d.cdf([0.4, 0.5, 0.50001, 3.0, np.inf], only), exact.cdf([0.4, 0.5, 0.6, 3.0, np.inf], only), atol=1e-3
        )
    assert d.quantile(0.5) == 0.5
    assert d.probability(at_most=0.6) == pytest.approx(exact.probability(at_most=0.6))
    assert d.probability(at_least=0.6) == pytest.approx(exact.probability(at_least=0.6))


def test_binned_values_at_the_bound_reach_it(rng):
    """The width of a bin is rounded: of one bound in six the values at it fell into the bin below."""
    for bound in [*(1 / np.sqrt(np.arange(1, 30))), *rng.uniform(0.1, 2, 100)]:
        values = rng.permutation(np.r_[np.full(700, bound), bound * rng.beta(2, 3, 300)])
        d = collect(values, "larger", float(bound), 10)
        assert d.probability(at_least=float(bound)) == 0.7
        assert d.quantile(0.5) == bound
        assert d.quantile(0.31) == bound


@pytest.mark.parametrize("value", [0.0, 0.3, np.inf])
def test_binned_values_that_are_all_equal(value):
    d = collect(np.full(3000, value), "smaller" if value else "larger", None, 1000)
    assert d.probability(at_least=value * 0.99) == 1
    assert d.cdf(value * 0.99) == 0
    assert d.infinite == (3000 if np.isinf(value) else 0)
    if np.isfinite(value):
        assert d.cdf(value + 0.01) == 1
        assert d.quantile(0.5) == pytest.approx(value, abs=1e-3)


def test_binned_condition_numbers_keep_their_digits(rng):
    """Condition numbers have a heavy tail: a few near-singular configurations must not blur all the others."""
    values = 1 / rng.random(100_000) ** 2
    values[::1000] = np.inf
    d = collect(values, "smaller", None, 50_000, unreached=100)
    exact = Distribution.from_values(values, "smaller", 1300)
    p = [0.05, 0.25, 0.5, 0.75, 0.95]
    np.testing.assert_allclose(d.quantile(p), exact.quantile(p), rtol=0.02)
    for h in (2, 10, 100):
        assert d.probability(at_most=h) == pytest.approx(exact.probability(at_most=h), abs=0.003)
    assert d.infinite == exact.infinite
