"""Lower quantile of the index over the poses, and a smooth estimate of it with gradients."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray


def compute_lower_quantile(value: FloatArray, level: float, weights: FloatArray | None = None) -> FloatArray:
    """Return the value that at least a fraction ``level`` of the poses has, the ``1 - level`` quantile of each design.

    Args:
        value: (D, P) index; 0 for poses that are not reached.
        level: Fraction of the poses, such as 0.95.
        weights: (P,) weights of the poses. Default: equal weights.

    Returns:
        (D,) quantiles as of :meth:`holdfast.core.probability.Distribution.quantile`: the smallest v such that the fraction of
        values up to v is at least ``1 - level``.
    """
    pose_count = value.shape[1]
    if weights is None:
        weights = np.ones(pose_count)
    order = np.argsort(value, axis=1, kind="stable")
    fractions = np.cumsum(weights[order], axis=1) / weights.sum()
    # Sums of weights are rounded.
    ranks = (fractions < (1 - level) * (1 - 1e-12) - 1e-15).sum(axis=1)
    return np.asarray(np.take_along_axis(value, order, axis=1)[np.arange(len(value)), np.minimum(ranks, pose_count - 1)])


def compute_quantile_weights(value: FloatArray, level: float, weights: FloatArray | None = None) -> FloatArray:
    """Return the weights (D, P), which sum to 1, of the values in a smooth estimate of the lower quantile.

    Each weight is the derivative of the estimate by its value. The sample quantile is a single value, which jumps from pose to
    pose as a design changes. The estimate is a mean of the values near it, about as many as its uncertainty includes.

    Source: Harrell and Davis 1982; with weights by their cumulative fractions and the effective sample size of Kish 1965.
    """
    from scipy.special import betainc

    pose_count = value.shape[1]
    pose_weights = np.ones(pose_count) if weights is None else weights
    effective_size = float(pose_weights.sum()) ** 2 / float(pose_weights @ pose_weights)
    order = np.argsort(value, axis=1, kind="stable")
    cumulative_weights = np.concatenate(
        [np.zeros((len(value), 1)), np.cumsum(pose_weights[order], axis=1) / pose_weights.sum()], axis=1
    )
    cumulative_shares = betainc(
        (effective_size + 1) * (1 - level), (effective_size + 1) * level, np.minimum(cumulative_weights, 1.0)
    )
    value_weights = np.empty_like(value)
    np.put_along_axis(value_weights, order, np.diff(cumulative_shares, axis=1), axis=1)
    return value_weights
