"""How many subjects would have sufficed.

Power is the probability that a test of an effect as large as the one observed gives p below a limit. An observed effect is
itself uncertain, and where the result was significant it is more often too large than too small: plan with the lower end of
its interval.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.teleop.analysis.variance import freedom, squares

Array = NDArray[np.float64]

MOST = 10_000
_BLOCK = 2_000_000  # values resampled at once


def t_power(dz: float, subjects: int, limit: float = 0.05) -> float:
    """Power of a two-sided paired t-test.

    Args:
        dz: Mean difference over the standard deviation of the differences.
        subjects: Number of pairs, 2 or more.
        limit: p below which an effect is called significant.
    """
    from scipy import stats

    df = subjects - 1
    edge = stats.t.isf(limit / 2, df)
    size = abs(dz) * np.sqrt(subjects)
    other_way = stats.nct.cdf(-edge, df, size)  # NaN where it is too small to be computed
    return float(1 - stats.nct.cdf(edge, df, size) + np.nan_to_num(other_way))


def f_power(effect: float, df: float, subjects: int, limit: float = 0.05, epsilon: float = 1.0) -> float:
    """Power of a within-subjects F test with noncentrality ``effect * subjects``.

    Args:
        effect: Noncentrality for each subject: of an observed F, ``F df / subjects`` of that experiment.
        df: Degrees of freedom of the effect.
        subjects: 2 or more.
        limit: p below which an effect is called significant.
        epsilon: Of Greenhouse and Geisser; it multiplies both degrees of freedom and the noncentrality.

    Source: Muller and Barton 1989, for the epsilon.
    """
    from scipy import stats

    one, two = epsilon * df, epsilon * df * (subjects - 1)
    return float(stats.ncf.sf(stats.f.isf(limit, one, two), one, two, epsilon * effect * subjects))


def subjects_for_t(dz: float, power: float = 0.8, limit: float = 0.05) -> int | None:
    """The smallest number of subjects with which a paired t-test has the power; None above 10,000."""
    _check(power, limit)
    return None if not np.isfinite(dz) else _smallest(lambda n: t_power(dz, n, limit), power)


def subjects_for_f(effect: float, df: float, power: float = 0.8, *, limit: float = 0.05, epsilon: float = 1.0) -> int | None:
    """The smallest number of subjects with which a within-subjects F test has the power; None above 10,000."""
    _check(power, limit)
    return _smallest(lambda n: f_power(effect, df, n, limit, epsilon), power)


def resampled(values: Array, subjects: int, limit: float = 0.05, draws: int = 2000, seed: int = 0) -> Array:
    """(3,) how often so many of the subjects, drawn at random, would have shown each effect of the ANOVA.

    They are drawn without replacement, so this holds for this experiment only and assumes no distribution; close to the number
    of all subjects the draws hardly differ.

    Args:
        values: (n, A, B) as :func:`holdfast.teleop.analysis.anova`.
        subjects: Drawn each time, 2 to n.
        limit: p below which an effect is called significant; sphericity assumed.
        draws: Number of draws.
        seed: Of the draws.
    """
    from scipy import stats

    n, a, b = values.shape
    df, df_error = freedom(subjects, a, b)
    edge = stats.f.isf(limit, df, df_error)
    generator = np.random.default_rng([seed, subjects])
    hits, done = np.zeros(3), 0
    while done < draws:
        block = min(draws - done, max(1, _BLOCK // (subjects * a * b)))
        rows = generator.permuted(np.tile(np.arange(n), (block, 1)), axis=1)[:, :subjects]
        sums = squares(values[rows])
        hits += (sums.effects / df > edge * sums.errors / df_error).sum(axis=0)
        done += block
    return hits / draws


def _check(power: float, limit: float) -> None:
    if not (0 < limit < power < 1):
        raise InputError(
            f"power is {power:g} and the limit of p {limit:g}; give 0 < limit < power < 1, for example 0.05 and 0.8"
        )


def _smallest(power_of: Callable[[int], float], power: float) -> int | None:
    """Bisection: power grows with the number of subjects."""
    low, high = 1, 2
    while power_of(high) < power:
        low, high = high, 2 * high
        if low >= MOST:
            return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if power_of(middle) < power else (low, middle)
    return high if high <= MOST else None


def least_noncentrality(f: float, df: float, df_error: float, confidence: float = 0.95) -> float:
    """The lower end of the confidence interval of an observed F's noncentrality; 0 where it may be none at all.

    Source: Steiger 2004.
    """
    from scipy import optimize, stats

    wanted = 0.5 + confidence / 2
    if stats.f.cdf(f, df, df_error) <= wanted:
        return 0.0
    return float(optimize.brentq(lambda z: stats.ncf.cdf(f, df, df_error, z) - wanted, 0.0, f * df, xtol=1e-8))
