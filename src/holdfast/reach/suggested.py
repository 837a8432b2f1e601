"""A box of which a sample suggests that all of it is inside: what a certificate may be asked to prove."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SEEDS, _ROUNDS = 8, 3
_KEPT = 0.9  # of each edge: between points nobody looked


def box_inside(points: Array, inside: NDArray[np.bool_]) -> Array | None:
    """A large box of points inside with none outside.

    Args:
        points: (N, d) m.
        inside: (N,).

    Returns:
        (d, 2) m, a little smaller than what no point contradicts; None where too few points are inside.

    Source: derived here. From the points that are farthest from those outside, one face after the other is moved out.
    """
    from scipy.spatial import KDTree

    good, bad = points[inside], points[~inside]
    if len(good) < 2:
        return None
    away = KDTree(bad).query(good, p=np.inf)[0] if len(bad) else np.zeros(len(good))
    room = float(np.median(np.asarray(KDTree(points).query(points, k=2, p=np.inf)[0])[:, 1])) / 2
    best, most = None, 0.0
    for seed in np.argsort(-away)[:_SEEDS]:
        box = np.column_stack([good[seed], good[seed]])
        for _ in range(_ROUNDS):
            for axis in range(points.shape[1]):
                _stretch(box, axis, good, bad, room)
        size = float(np.prod(box[:, 1] - box[:, 0]))
        if size > most:
            best, most = box, size
    if best is None:
        return None
    middle, half = best.mean(axis=1), _KEPT / 2 * (best[:, 1] - best[:, 0])
    return np.column_stack([middle - half, middle + half])


def _stretch(box: Array, axis: int, good: Array, bad: Array, room: float) -> None:
    """In place: along an axis as far as there are points inside before one outside, which counts with so much around it."""
    others = np.arange(len(box)) != axis
    low, high = box[others].T

    def beside(points: Array, wide: float) -> Array:
        near = ((points[:, others] >= low - wide) & (points[:, others] <= high + wide)).all(axis=1)
        return np.asarray(points[near, axis])

    stops, ends = beside(bad, room), beside(good, 2 * room)
    least = stops[stops < box[axis, 0]].max(initial=-np.inf) + room
    most = stops[stops > box[axis, 1]].min(initial=np.inf) - room
    ends = ends[(ends > least) & (ends < most)]
    box[axis] = min(ends.min(initial=box[axis, 0]), box[axis, 0]), max(ends.max(initial=box[axis, 1]), box[axis, 1])
