"""Quantiles of the beta distribution, against scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import betaincinv
from scipy.stats import beta

from holdfast.core.probability.beta import beta_quantile
from holdfast.core.probability.intervals import Interval


@pytest.mark.parametrize("largest", [10, 1e3, 1e6, 1e8])
def test_it_is_scipys(largest, rng):
    for _ in range(300):
        size = np.exp(rng.uniform(0, np.log(largest)))
        size = size if rng.random() < 0.5 else np.ceil(size)
        hits = rng.choice([rng.uniform(0, size), np.floor(rng.uniform(0, size)), min(1.0, size), max(size - 1, 0.0)])
        rest = rng.choice([0.005, 0.025, 0.05, 0.95, 0.975, 0.995])
        for a, b in ((hits, size - hits + 1), (hits + 1, size - hits)):
            if a > 0.05 and b > 0.05:
                assert beta_quantile(a, b, rest) == pytest.approx(betaincinv(a, b, rest), rel=1e-10), (a, b, rest)


def test_extremes_stay_inside(rng):
    for _ in range(300):
        a, b = np.exp(rng.uniform(np.log(1e-3), np.log(1e4), 2))
        x = beta_quantile(a, b, rng.uniform(1e-6, 1 - 1e-6))
        assert 0 <= x <= 1
    assert beta_quantile(1.0, 1.0, 0.25) == pytest.approx(0.25, rel=1e-15)


def test_limits_of_a_share_are_those_of_clopper_and_pearson():
    found = Interval.from_counts(np.int64(3), np.int64(40), 0.9)
    assert found.low == pytest.approx(beta.ppf(0.05, 3, 38), rel=1e-12)
    assert found.high == pytest.approx(beta.ppf(0.95, 4, 37), rel=1e-12)
    assert isinstance(found.low, float)
