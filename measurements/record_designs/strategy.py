"""Evolution strategy with covariance matrix adaptation (CMA-ES)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from holdfast.core.typing import FloatArray

_SMALLEST_STEP = 1e-12  # of a step: then nothing moves any more


def minimise_by_evolution(
    cost: Callable[[FloatArray], FloatArray],
    start: FloatArray,
    deviations: FloatArray,
    *,
    population: int,
    generations: int,
    rng: np.random.Generator,
    on_generation: Callable[[float], bool],
) -> tuple[FloatArray, float]:
    """Return the point of least cost that was evaluated.

    Args:
        cost: (P,) of points (P, k), all of a generation at once.
        start: (k,) where the first generation is centred.
        deviations: (k,) its standard deviations, in the units of each number.
        population: Points of a generation.
        generations: At most.
        rng: Draws the steps.
        on_generation: Called with the least cost after each generation; True ends the search.

    Returns:
        The point (k,) and its cost.

    Source: Hansen, The CMA Evolution Strategy: A Tutorial (2016), with its default weights.
    """
    dimension, parents = len(start), population // 2
    weights = np.log(parents + 0.5) - np.log(np.arange(1, parents + 1))
    weights /= weights.sum()
    effective_parents = 1 / (weights**2).sum()
    step_rate, damping = (
        (effective_parents + 2) / (dimension + effective_parents + 5),
        1 + 2 * max(0.0, np.sqrt((effective_parents - 1) / (dimension + 1)) - 1),
    )
    damping += step_rate
    path_rate = (4 + effective_parents / dimension) / (dimension + 4 + 2 * effective_parents / dimension)
    rank_one_rate = 2 / ((dimension + 1.3) ** 2 + effective_parents)
    rank_mu_rate = min(
        1 - rank_one_rate, 2 * (effective_parents - 2 + 1 / effective_parents) / ((dimension + 2) ** 2 + effective_parents)
    )
    expected_norm = np.sqrt(dimension) * (
        1 - 1 / (4 * dimension) + 1 / (21 * dimension * dimension)
    )  # mean length of a normal vector
    mean, step_size, covariance = np.zeros(dimension), 1.0, np.eye(dimension)
    step_path, covariance_path = np.zeros(dimension), np.zeros(dimension)
    best_point, least_cost = start.copy(), np.inf
    for generation in range(1, generations + 1):
        scales, axes = np.linalg.eigh(covariance)
        scales = np.sqrt(np.maximum(scales, _SMALLEST_STEP))
        steps = (rng.normal(size=(population, dimension)) * scales) @ axes.T
        points = start + deviations * (mean + step_size * steps)
        costs = cost(points)
        order = np.argsort(costs, kind="stable")
        if costs[order[0]] < least_cost:
            best_point, least_cost = points[order[0]].copy(), float(costs[order[0]])
        selected = steps[order[:parents]]
        mean_step = weights @ selected
        mean = mean + step_size * mean_step
        step_path = (1 - step_rate) * step_path + np.sqrt(step_rate * (2 - step_rate) * effective_parents) * (
            axes @ ((axes.T @ mean_step) / scales)
        )
        path_norm = np.linalg.norm(step_path)
        path_is_short = (
            path_norm / np.sqrt(1 - (1 - step_rate) ** (2 * generation)) < (1.4 + 2 / (dimension + 1)) * expected_norm
        )
        covariance_path = (1 - path_rate) * covariance_path + path_is_short * np.sqrt(
            path_rate * (2 - path_rate) * effective_parents
        ) * mean_step
        covariance = (1 - rank_one_rate - rank_mu_rate) * covariance + rank_one_rate * np.outer(
            covariance_path, covariance_path
        )
        covariance += rank_mu_rate * (selected.T * weights) @ selected
        step_size *= float(np.exp(step_rate / damping * (path_norm / expected_norm - 1)))
        if on_generation(least_cost) or step_size * scales.max() < _SMALLEST_STEP:
            break
    return best_point, least_cost
