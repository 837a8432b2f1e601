"""Intervals of differences between things tried on the same cases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from holdfast.core.formatting import format_half_width
from holdfast.core.probability.intervals import Difference, Interval


def pairs(both, lost, won, neither):
    """Outcomes of a first and a second thing from the four counts."""
    first = np.repeat([True, True, False, False], [both, lost, won, neither])
    second = np.repeat([True, False, True, False], [both, lost, won, neither])
    return first, second


def square_and_add(counts, method):
    """Second share minus the first by Newcombe's method 10, with limits of the shares of another kind."""
    both, lost, won, neither = counts
    size = sum(counts)
    one, two = (stats.binomtest(k, size).proportion_ci(method=method) for k in (both + lost, both + won))
    p, q = (both + lost) / size, (both + won) / size
    table = np.array([[both, lost], [won, neither]])
    across = float(np.prod([*table.sum(axis=0), *table.sum(axis=1)]))
    excess = both * neither - lost * won
    phi = (max(excess - size / 2, 0) if excess > 0 else excess) / np.sqrt(across) if across else 0.0
    down = np.array([q - two.low, -(one.high - p)])
    up = np.array([two.high - q, -(p - one.low)])
    mix = np.array([[1, phi], [phi, 1]])
    return q - p - np.sqrt(down @ mix @ down), q - p + np.sqrt(up @ mix @ up)


@pytest.mark.parametrize(
    ("counts", "low", "high"),
    [((36, 12, 2, 0), 0.0569, 0.3404), ((1, 1, 7, 12), -0.507, -0.026), ((0, 0, 0, 10), -0.2775, 0.2775)],
)
def test_the_interval_of_paired_shares_is_the_published_one_with_exact_limits(counts, low, high):
    """The formula gives the published values (the first share minus the second: Newcombe 1998 for method 10, and Fagerland,
    Lydersen, Laake for data of Bentur et al., both as remembered) with Wilson's limits; ours are the exact ones.
    """
    turned = (counts[0], counts[2], counts[1], counts[3])
    np.testing.assert_allclose(square_and_add(turned, "wilson"), (low, high), atol=6e-4)
    second, first = pairs(*counts)
    found = Difference.of_pairs(first, second)
    np.testing.assert_allclose((found.low, found.high), square_and_add(turned, "exact"), rtol=1e-9)
    assert found.value == pytest.approx((counts[1] - counts[2]) / sum(counts))


@pytest.mark.parametrize(("hits", "size"), [(1, 2), (3, 40), (17, 18), (250, 1000), (0, 5), (5, 5)])
def test_the_limits_of_a_share_are_those_of_clopper_and_pearson(hits, size):
    """At the lower limit as many hits or more, and at the upper limit as few or fewer, have the probability of one tail."""
    interval = Interval.from_counts(np.int64(hits), np.int64(size), 0.9)
    assert isinstance(interval.low, float)

    def chances(p):
        return [math.comb(size, k) * p**k * (1 - p) ** (size - k) for k in range(size + 1)]

    assert interval.low == 0 if hits == 0 else sum(chances(interval.low)[hits:]) == pytest.approx(0.05, rel=1e-9)
    assert interval.high == 1 if hits == size else sum(chances(interval.high)[: hits + 1]) == pytest.approx(0.05, rel=1e-9)


@given(st.floats(0, 1), st.floats(1, 1e8), st.sampled_from([0.9, 0.95, 0.99]))
def test_the_limits_of_a_share_enclose_it_for_numbers_of_cases_that_are_not_whole(share, size, confidence):
    interval = Interval.from_counts(share * size, size, confidence)
    assert 0 <= interval.low <= interval.value <= interval.high <= 1


def test_an_interval_of_pairs_holds_nought_where_the_test_does_not_refuse_it():
    """Five pairs that all differ the same way: p = 1/16, and square-and-add alone would leave 0 out."""
    found = Difference.of_pairs(*pairs(0, 5, 0, 0))
    assert square_and_add((0, 5, 0, 0), "exact")[1] < 0
    assert found.p_value == pytest.approx(1 / 16)
    assert found.high == 0


@given(st.tuples(*[st.integers(0, 40)] * 4).filter(lambda c: sum(c) > 0))
def test_an_interval_turns_round_with_its_things(counts):
    there = Difference.of_pairs(*pairs(*counts))
    back = Difference.of_pairs(*reversed(pairs(*counts)))
    np.testing.assert_allclose((back.value, back.low, back.high), (-there.value, -there.high, -there.low), atol=1e-12)
    assert -1 <= there.low <= there.value <= there.high <= 1
    assert there.p_value == pytest.approx(back.p_value)
    lost, won = counts[1], counts[2]
    tail = stats.binom.cdf(min(lost, won), lost + won, 0.5)
    assert there.p_value == pytest.approx(min(1.0, 2 * tail))


@pytest.mark.parametrize("share", [(0.55, 0.12, 0.05, 0.28), (0.25, 0.25, 0.25, 0.25), (0.0, 0.5, 0.5, 0.0)])
def test_pairs_cover_by_enumeration(share):
    """Every outcome of ten pairs with its probability: no random numbers."""
    inside = 0.0
    for both in range(11):
        for lost in range(11 - both):
            for won in range(11 - both - lost):
                counts = both, lost, won, 10 - both - lost - won
                found = Difference.of_pairs(*pairs(*counts))
                truth = share[2] - share[1]
                inside += float(stats.multinomial.pmf(counts, 10, share)) * (found.low <= truth <= found.high)
    assert inside >= 0.95


def test_mean_differences_are_students(rng):
    first, second = rng.normal(size=(2, 30))
    found = Difference.of_means(second - first)
    oracle = stats.ttest_rel(second, first)
    ends = oracle.confidence_interval(0.95)
    np.testing.assert_allclose((found.low, found.high, found.p_value), (ends.low, ends.high, oracle.pvalue), rtol=1e-9)
    assert Difference.of_means(np.zeros(5)) == Difference(value=0.0, low=0.0, high=0.0, confidence=0.95, p_value=1.0)
    assert Difference.of_means(np.ones(5)).p_value == 0


@given(st.integers(1, 400).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))), st.sampled_from([0.8, 0.95, 0.999]))
def test_a_share_is_that_of_clopper_and_pearson(count, confidence):
    hits, size = count
    found = Interval.from_counts(hits, size, confidence)
    exact = stats.binomtest(hits, size).proportion_ci(confidence, "exact")
    np.testing.assert_allclose((found.low, found.high), (exact.low, exact.high), atol=1e-11)
    assert found.value == hits / size


@pytest.mark.parametrize(
    ("half", "text"),
    [(0.0312, "±0.031"), (0.136, "±0.136"), (0.00043, "±0.00043"), (0.0000429, "±0.000043")],
)
def test_a_band_has_two_digits_that_are_not_zero(half, text):
    assert format_half_width(half) == text
