"""Intervals of differences between things tried on the same cases."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from holdfast.interval import Difference, Interval


def pairs(both, lost, won, neither):
    """Outcomes of a first and a second thing from the four counts."""
    first = np.repeat([True, True, False, False], [both, lost, won, neither])
    second = np.repeat([True, False, True, False], [both, lost, won, neither])
    return first, second


@pytest.mark.parametrize(
    ("counts", "low", "high"),
    [((36, 12, 2, 0), 0.0569, 0.3404), ((1, 1, 7, 12), -0.507, -0.026), ((0, 0, 0, 10), -0.2775, 0.2775)],
)
def test_the_published_interval_of_paired_shares(counts, low, high):
    """The first share minus the second: Newcombe 1998 for method 10, and Fagerland, Lydersen, Laake for data of Bentur et al.,
    both as remembered; nothing in ten cases: plus or minus the end of Wilson's interval.
    """
    second, first = pairs(*counts)
    found = Difference.of_pairs(first, second)
    np.testing.assert_allclose((found.low, found.high), (low, high), atol=6e-4)
    assert found.value == pytest.approx((counts[1] - counts[2]) / sum(counts))


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


def test_the_interval_covers_the_truth_about_as_often_as_it_says(rng):
    share = np.array([0.55, 0.12, 0.05, 0.28])
    truth = share[2] - share[1]
    inside = 0
    for counts in rng.multinomial(60, share, size=400):
        found = Difference.of_pairs(*pairs(*counts))
        inside += found.low <= truth <= found.high
    assert stats.binomtest(inside, 400, 0.95).pvalue > 1e-4


def test_mean_differences_are_students(rng):
    first, second = rng.normal(size=(2, 30))
    found = Difference.of_means(second - first)
    oracle = stats.ttest_rel(second, first)
    ends = oracle.confidence_interval(0.95)
    np.testing.assert_allclose((found.low, found.high, found.p_value), (ends.low, ends.high, oracle.pvalue), rtol=1e-9)
    assert Difference.of_means(np.zeros(5)) == Difference(0.0, 0.0, 0.0, 0.95, 1.0)
    assert Difference.of_means(np.ones(5)).p_value == 0


def test_a_share_is_wilsons():
    found = Interval.of(3, 10)
    np.testing.assert_allclose((found.low, found.high), (0.10779, 0.60322), atol=1e-5)
