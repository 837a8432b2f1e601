"""The value that a share of the poses is guaranteed to have: the quantile itself, and a smooth estimate with slopes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def guaranteed(value: Array, level: float, weights: Array | None = None) -> Array:
    """What at least a share ``level`` of the poses has: the ``1 - level`` quantile of each design.

    Args:
        value: (D, P) index; 0 where a pose is not reached.
        level: Share of the poses, such as 0.95.
        weights: (P,) of the poses; all alike if not given.

    Returns:
        (D,) as :meth:`holdfast.probability.Distribution.quantile`: the smallest v with ``share(value <= v) >= 1 - level``.
    """
    count = value.shape[1]
    if weights is None:
        weights = np.ones(count)
    order = np.argsort(value, axis=1, kind="stable")
    share = np.cumsum(weights[order], axis=1) / weights.sum()
    # Sums of weights are rounded.
    place = (share < (1 - level) * (1 - 1e-12) - 1e-15).sum(axis=1)
    return np.asarray(np.take_along_axis(value, order, axis=1)[np.arange(len(value)), np.minimum(place, count - 1)])


def shares(value: Array, level: float, weights: Array | None = None) -> Array:
    """Weights (D, P), which sum to 1, of the values in a smooth estimate of that quantile.

    Each is the derivative of the estimate by its value. Where the sample quantile is one value, and jumps from pose to pose as
    a design changes, this is the mean of the values near it, about as many as the sample leaves in doubt.

    Source: Harrell and Davis 1982; with weights by their cumulative shares and the effective sample size of Kish 1965.
    """
    from scipy.special import betainc

    count = value.shape[1]
    w = np.ones(count) if weights is None else weights
    size = float(w.sum()) ** 2 / float(w @ w)
    order = np.argsort(value, axis=1, kind="stable")
    steps = np.concatenate([np.zeros((len(value), 1)), np.cumsum(w[order], axis=1) / w.sum()], axis=1)
    cumulative = betainc((size + 1) * (1 - level), (size + 1) * level, np.minimum(steps, 1.0))
    out = np.empty_like(value)
    np.put_along_axis(out, order, np.diff(cumulative, axis=1), axis=1)
    return out
