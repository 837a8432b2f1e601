"""The capsule about a set of points that is farthest from none of them in the mean, by nonlinear optimisation.

A capsule is convex, so it contains a convex hull if and only if it contains its corners.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SLACK = 1e-6  # m that the radius has beyond the farthest corner
_LOOKED_AT = 48  # directions in which the first points are the farthest
_MORE = 12  # points that one round adds
_ROUNDS = 6
_OPTIONS: Any = {"maxiter": 40, "ftol": 1e-6}
_TURN = np.pi * (3 - np.sqrt(5))  # the golden angle


def directions(count: int) -> Array:
    """(count, 3) unit vectors spread evenly over the sphere: the spherical Fibonacci lattice (Swinbank & Purser 2006)."""
    k = np.arange(count)
    z = (2 * k + 1) / count - 1
    ring = np.sqrt(1 - z * z)
    return np.column_stack([ring * np.cos(k * _TURN), ring * np.sin(k * _TURN), z])


def main_axes(points: Array) -> Array:
    """(3, 3) unit vectors in rows along which points (V, 3) vary most, then less, then least."""
    own = points - points.mean(axis=0)
    return np.asarray(np.linalg.eigh(own.T @ own)[1].T[::-1])


def capsule_about(points: Array) -> tuple[Array, Array, float]:
    """Start (3,), end (3,) and radius, m, of a capsule that contains points (V, 3), the radius by 1e-6 m.

    Minimised is ``radius + length / 4``: the mean over all directions of how far the capsule reaches, up to a constant. Started
    from the two main axes along which the points reach farthest; the points that count are found on the way.
    """
    axes, centre = main_axes(points), points.mean(axis=0)
    own = (points - centre) @ axes.T
    middle, spans = (own.max(axis=0) + own.min(axis=0)) / 2, np.ptp(own, axis=0)
    outermost = set(np.argmax((points - centre) @ directions(_LOOKED_AT).T, axis=0).tolist())
    best: tuple[float, Array] | None = None
    for k in np.argsort(-spans)[:2]:
        beside = np.delete(own - middle, k, axis=1)
        radius, height = float(np.linalg.norm(beside, axis=1).max()), own[:, k] - middle[k]
        cap = np.sqrt(np.maximum(radius**2 - (beside**2).sum(axis=1), 0))
        low, high = min((height + cap).min(), 0.0), max((height - cap).max(), 0.0)
        ends = [(middle + np.eye(3)[k] * at) @ axes + centre for at in (low, high)]
        x, kept = np.concatenate([*ends, [radius]]), set(outermost)
        for _ in range(_ROUNDS):
            x = _improved(points[sorted(kept)], x)
            away = _away(points, x)[0]
            x[6] = away.max() + _SLACK
            value = float(x[6] + np.linalg.norm(x[3:6] - x[:3]) / 4)
            if best is None or value < best[0]:
                best = (value, x.copy())
            outside = [i for i in np.argsort(-away)[:_MORE].tolist() if i not in kept]
            if not outside:
                break
            kept.update(outside)
    assert best is not None
    return best[1][:3], best[1][3:6], float(best[1][6])


def _away(points: Array, x: Array) -> tuple[Array, Array, Array]:
    """Distance (V,) from the segment, share (V,) of the way along it of the foot, and the vector (V, 3) from there."""
    span = x[3:6] - x[:3]
    square = float(span @ span)
    share = np.clip((points - x[:3]) @ span / square, 0, 1) if square > 0 else np.zeros(len(points))
    vector = points - x[:3] - share[:, None] * span
    return np.linalg.norm(vector, axis=1), share, vector


def _improved(points: Array, x: Array) -> Array:
    def room(x: Array) -> Array:
        return np.asarray(x[6] - _away(points, x)[0])

    def slopes(x: Array) -> Array:
        distance, share, vector = _away(points, x)
        unit = vector / np.maximum(distance, 1e-12)[:, None]
        return np.column_stack([(1 - share)[:, None] * unit, share[:, None] * unit, np.ones(len(points))])

    def size(x: Array) -> float:
        return float(x[6] + np.sqrt(((x[3:6] - x[:3]) ** 2).sum() + 1e-12) / 4)

    def change(x: Array) -> Array:
        span = x[3:6] - x[:3]
        pull = span / np.sqrt(span @ span + 1e-12) / 4
        return np.concatenate([-pull, pull, [1.0]])

    from scipy.optimize import minimize  # takes long to import

    limits: Any = {"type": "ineq", "fun": room, "jac": slopes}
    found = minimize(size, x, jac=change, constraints=[limits], method="SLSQP", options=_OPTIONS)
    return np.array(found.x if np.isfinite(found.x).all() else x)
