"""Statistical power of the tests, and the numbers of subjects that suffice for it.

Power is the probability that a test of an effect as large as the observed one gives p below a limit. An observed effect is
uncertain, and if the result was significant it is more often too large than too small. Therefore, plan with the lower end of
its interval.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.teleop.analysis.variance import degrees_of_freedom, sums_of_squares

MAX_SUBJECTS = 10_000
_MAX_BLOCK_VALUES = 2_000_000  # values that are resampled at once


def t_test_power(dz: float, subjects: int, limit: float = 0.05) -> float:
    """Return the power of a two-sided paired t-test.

    Args:
        dz: Mean difference over the standard deviation of the differences.
        subjects: Number of pairs, 2 or more.
        limit: p-value below which an effect is called significant.
    """
    from scipy import stats

    df = subjects - 1
    critical_t = stats.t.isf(limit / 2, df)
    noncentrality = abs(dz) * np.sqrt(subjects)
    lower_tail = stats.nct.cdf(-critical_t, df, noncentrality)  # NaN where it is too small to be computed
    return float(1 - stats.nct.cdf(critical_t, df, noncentrality) + np.nan_to_num(lower_tail))


def f_test_power(effect: float, df: float, subjects: int, limit: float = 0.05, epsilon: float = 1.0) -> float:
    """Return the power of a within-subjects F test with noncentrality ``effect * subjects``.

    Args:
        effect: Noncentrality per subject: for an observed F, ``F df / subjects`` of that experiment.
        df: Degrees of freedom of the effect.
        subjects: Number of subjects, 2 or more.
        limit: p-value below which an effect is called significant.
        epsilon: Epsilon of Greenhouse and Geisser, which multiplies both degrees of freedom and the noncentrality.

    Source: Muller and Barton 1989, for the epsilon.
    """
    from scipy import stats

    df_effect, df_error = epsilon * df, epsilon * df * (subjects - 1)
    return float(stats.ncf.sf(stats.f.isf(limit, df_effect, df_error), df_effect, df_error, epsilon * effect * subjects))


def subjects_for_t(dz: float, power: float = 0.8, limit: float = 0.05) -> int | None:
    """Return the smallest number of subjects with which a paired t-test has the required power; None above 10,000.

    Args:
        dz: Mean difference over the standard deviation of the differences.
        power: Required power, between ``limit`` and 1.
        limit: p-value below which an effect is called significant.
    """
    _check_power(power, limit)
    return None if not np.isfinite(dz) else _find_smallest_sample(lambda n: t_test_power(dz, n, limit), power)


def subjects_for_f(effect: float, df: float, power: float = 0.8, *, limit: float = 0.05, epsilon: float = 1.0) -> int | None:
    """Return the smallest number of subjects with which a within-subjects F test has the required power; None above 10,000.

    Args:
        effect: Noncentrality per subject: for an observed F, ``F df / subjects`` of that experiment.
        df: Degrees of freedom of the effect.
        power: Required power, between ``limit`` and 1.
        limit: p-value below which an effect is called significant.
        epsilon: Epsilon of Greenhouse and Geisser, at most 1.
    """
    _check_power(power, limit)
    return _find_smallest_sample(lambda n: f_test_power(effect, df, n, limit, epsilon), power)


def estimate_power(values: FloatArray, subjects: int, limit: float = 0.05, draws: int = 2000, seed: int = 0) -> FloatArray:
    """Return the fraction (3,) of random samples of ``subjects`` subjects that would have shown each effect of the ANOVA.

    Samples are without replacement, so the result holds for this experiment only and assumes no distribution. Samples with
    nearly all subjects hardly differ.

    Args:
        values: (n, A, B) values, as for :func:`holdfast.teleop.analysis.anova`.
        subjects: Size of each sample, 2 to n.
        limit: p-value below which an effect is called significant; sphericity is assumed.
        draws: Number of samples.
        seed: Seed of the samples.
    """
    from scipy import stats

    n, a, b = values.shape
    df, df_error = degrees_of_freedom(subjects, a, b)
    critical_f = stats.f.isf(limit, df, df_error)
    generator = np.random.default_rng([seed, subjects])
    hits, sampled = np.zeros(3), 0
    while sampled < draws:
        block_draws = min(draws - sampled, max(1, _MAX_BLOCK_VALUES // (subjects * a * b)))
        samples = generator.permuted(np.tile(np.arange(n), (block_draws, 1)), axis=1)[:, :subjects]
        sums = sums_of_squares(values[samples])
        hits += (sums.effects / df > critical_f * sums.errors / df_error).sum(axis=0)
        sampled += block_draws
    return hits / draws


def _check_power(power: float, limit: float) -> None:
    if not (0 < limit < power < 1):
        raise InputError(
            f"power is {power:g} and the limit of p {limit:g}; give 0 < limit < power < 1, for example 0.05 and 0.8"
        )


def _find_smallest_sample(power_of: Callable[[int], float], power: float) -> int | None:
    """Return the smallest number of subjects with the power by bisection, because power grows with the number of subjects."""
    lower, upper = 1, 2
    while power_of(upper) < power:
        lower, upper = upper, 2 * upper
        if lower >= MAX_SUBJECTS:
            return None
    while upper - lower > 1:
        midpoint = (lower + upper) // 2
        lower, upper = (midpoint, upper) if power_of(midpoint) < power else (lower, midpoint)
    return upper if upper <= MAX_SUBJECTS else None


def lower_noncentrality_limit(f: float, df: float, df_error: float, confidence: float = 0.95) -> float:
    """Return the lower end of the confidence interval of the noncentrality of an observed F; 0 if it may be zero.

    Source: Steiger 2004.
    """
    from scipy import optimize, stats

    level = 0.5 + confidence / 2
    if stats.f.cdf(f, df, df_error) <= level:
        return 0.0
    return float(
        optimize.brentq(lambda noncentrality: stats.ncf.cdf(f, df, df_error, noncentrality) - level, 0.0, f * df, xtol=1e-8)
    )
