"""Capsule around a set of points with the smallest mean excess, by nonlinear optimisation.

A capsule is convex, so it contains a convex hull if and only if it contains its corners.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray

_RADIUS_SLACK_M = 1e-6  # m by which the radius exceeds the farthest corner
_INITIAL_DIRECTIONS = 48  # directions in which the first points are the farthest
_ADDED_POINTS = 12  # points that one round adds
_MAX_ROUNDS = 6
_SLSQP_OPTIONS: Any = {"maxiter": 40, "ftol": 1e-6}
_GOLDEN_ANGLE_RAD = np.pi * (3 - np.sqrt(5))  # the golden angle


def sphere_directions(count: int) -> FloatArray:
    """Return (count, 3) unit vectors spread evenly over the sphere: its Fibonacci lattice (Swinbank & Purser 2006)."""
    index = np.arange(count)
    z = (2 * index + 1) / count - 1
    ring_radius = np.sqrt(1 - z * z)
    return np.column_stack(
        [ring_radius * np.cos(index * _GOLDEN_ANGLE_RAD), ring_radius * np.sin(index * _GOLDEN_ANGLE_RAD), z]
    )


def main_axes(points: FloatArray) -> FloatArray:
    """Return (3, 3) unit vectors in rows, along which points (V, 3) vary most, then less, then least."""
    centered = points - points.mean(axis=0)
    return np.asarray(np.linalg.eigh(centered.T @ centered)[1].T[::-1])


def enclosing_capsule(points: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return start (3,), end (3,) and radius, m, of a capsule that contains points (V, 3), the radius to 1e-6 m.

    It minimises ``radius + length / 4``, which is up to a constant the mean extent of the capsule over all directions. It
    starts from the two main axes along which the points extend farthest, and adds the relevant points step by step.
    """
    axes, center = main_axes(points), points.mean(axis=0)
    coordinates = (points - center) @ axes.T
    middle, spans = (coordinates.max(axis=0) + coordinates.min(axis=0)) / 2, np.ptp(coordinates, axis=0)
    outermost = set(np.argmax((points - center) @ sphere_directions(_INITIAL_DIRECTIONS).T, axis=0).tolist())
    best_capsule: tuple[float, FloatArray] | None = None
    for axis_index in np.argsort(-spans)[:2]:
        across_axis = np.delete(coordinates - middle, axis_index, axis=1)
        radius, height = float(np.linalg.norm(across_axis, axis=1).max()), coordinates[:, axis_index] - middle[axis_index]
        cap_height = np.sqrt(np.maximum(radius**2 - (across_axis**2).sum(axis=1), 0))
        lower, upper = min((height + cap_height).min(), 0.0), max((height - cap_height).max(), 0.0)
        ends = [(middle + np.eye(3)[axis_index] * end_height) @ axes + center for end_height in (lower, upper)]
        parameters, active_points = np.concatenate([*ends, [radius]]), set(outermost)
        for _ in range(_MAX_ROUNDS):
            parameters = _improve_capsule(points[sorted(active_points)], parameters)
            distances = _segment_distances(points, parameters)[0]
            parameters[6] = distances.max() + _RADIUS_SLACK_M
            cost = float(parameters[6] + np.linalg.norm(parameters[3:6] - parameters[:3]) / 4)
            if best_capsule is None or cost < best_capsule[0]:
                best_capsule = (cost, parameters.copy())
            outside = [point for point in np.argsort(-distances)[:_ADDED_POINTS].tolist() if point not in active_points]
            if not outside:
                break
            active_points.update(outside)
    assert best_capsule is not None
    return best_capsule[1][:3], best_capsule[1][3:6], float(best_capsule[1][6])


def _segment_distances(points: FloatArray, parameters: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the distance (V,) from the segment, the fraction (V,) of its nearest point, and the vector (V, 3) from it."""
    span = parameters[3:6] - parameters[:3]
    square = float(span @ span)
    fraction = np.clip((points - parameters[:3]) @ span / square, 0, 1) if square > 0 else np.zeros(len(points))
    vector = points - parameters[:3] - fraction[:, None] * span
    return np.linalg.norm(vector, axis=1), fraction, vector


def _improve_capsule(points: FloatArray, x: FloatArray) -> FloatArray:
    def constraint_values(x: FloatArray) -> FloatArray:
        return np.asarray(x[6] - _segment_distances(points, x)[0])

    def constraint_gradients(x: FloatArray) -> FloatArray:
        distance, fraction, vector = _segment_distances(points, x)
        unit_vectors = vector / np.maximum(distance, 1e-12)[:, None]
        return np.column_stack([(1 - fraction)[:, None] * unit_vectors, fraction[:, None] * unit_vectors, np.ones(len(points))])

    def capsule_size(x: FloatArray) -> float:
        return float(x[6] + np.sqrt(((x[3:6] - x[:3]) ** 2).sum() + 1e-12) / 4)

    def size_gradient(x: FloatArray) -> FloatArray:
        span = x[3:6] - x[:3]
        end_gradient = span / np.sqrt(span @ span + 1e-12) / 4
        return np.concatenate([-end_gradient, end_gradient, [1.0]])

    from scipy.optimize import minimize  # slow to import

    constraint: Any = {"type": "ineq", "fun": constraint_values, "jac": constraint_gradients}
    result = minimize(capsule_size, x, jac=size_gradient, constraints=[constraint], method="SLSQP", options=_SLSQP_OPTIONS)
    return np.array(result.x if np.isfinite(result.x).all() else x)
