"""An evolution strategy whose steps learn their shape: covariance matrix adaptation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SMALLEST = 1e-12  # of a step: then nothing moves any more


def evolved(
    cost: Callable[[Array], Array],
    start: Array,
    width: Array,
    *,
    population: int,
    generations: int,
    rng: np.random.Generator,
    tell: Callable[[float], bool],
) -> tuple[Array, float]:
    """The point of least cost that was looked at.

    Args:
        cost: (P,) of points (P, k), all of a generation at once.
        start: (k,) where the first generation is centred.
        width: (k,) its standard deviations, in the units of each number.
        population: Points of a generation.
        generations: At most.
        rng: Draws the steps.
        tell: Called with the least cost after each generation; True ends the search.

    Returns:
        The point (k,) and its cost.

    Source: Hansen, The CMA Evolution Strategy: A Tutorial (2016), with its default weights.
    """
    k, parents = len(start), population // 2
    weights = np.log(parents + 0.5) - np.log(np.arange(1, parents + 1))
    weights /= weights.sum()
    mass = 1 / (weights**2).sum()
    along, damping = (mass + 2) / (k + mass + 5), 1 + 2 * max(0.0, np.sqrt((mass - 1) / (k + 1)) - 1)
    damping += along
    path_rate = (4 + mass / k) / (k + 4 + 2 * mass / k)
    one_rate = 2 / ((k + 1.3) ** 2 + mass)
    many_rate = min(1 - one_rate, 2 * (mass - 2 + 1 / mass) / ((k + 2) ** 2 + mass))
    length = np.sqrt(k) * (1 - 1 / (4 * k) + 1 / (21 * k * k))  # mean length of a normal vector
    mean, size, shape = np.zeros(k), 1.0, np.eye(k)
    size_path, shape_path = np.zeros(k), np.zeros(k)
    best, least = start.copy(), np.inf
    for generation in range(1, generations + 1):
        values, axes = np.linalg.eigh(shape)
        values = np.sqrt(np.maximum(values, _SMALLEST))
        steps = (rng.normal(size=(population, k)) * values) @ axes.T
        points = start + width * (mean + size * steps)
        found = cost(points)
        order = np.argsort(found, kind="stable")
        if found[order[0]] < least:
            best, least = points[order[0]].copy(), float(found[order[0]])
        chosen = steps[order[:parents]]
        step = weights @ chosen
        mean = mean + size * step
        size_path = (1 - along) * size_path + np.sqrt(along * (2 - along) * mass) * (axes @ ((axes.T @ step) / values))
        norm = np.linalg.norm(size_path)
        going = norm / np.sqrt(1 - (1 - along) ** (2 * generation)) < (1.4 + 2 / (k + 1)) * length
        shape_path = (1 - path_rate) * shape_path + going * np.sqrt(path_rate * (2 - path_rate) * mass) * step
        shape = (1 - one_rate - many_rate) * shape + one_rate * np.outer(shape_path, shape_path)
        shape += many_rate * (chosen.T * weights) @ chosen
        size *= float(np.exp(along / damping * (norm / length - 1)))
        if tell(least) or size * values.max() < _SMALLEST:
            break
    return best, least
