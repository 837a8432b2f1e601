"""Derivatives of tool positions and tool axes by the joints, for many configurations in parallel."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray


def tangents_and_pseudo_inverses(matrices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return unit null vectors (N, m + 1), with positive last entry, and pseudo-inverses of matrices (N, m, m + 1)."""
    u, sizes, v = np.linalg.svd(matrices)
    tangent, pseudo_inverse = v[:, -1], v[:, :-1].transpose(0, 2, 1) / np.maximum(sizes, 1e-14)[:, None] @ u.transpose(0, 2, 1)
    return np.asarray(tangent * np.where(tangent[:, -1:] < 0, -1.0, 1.0)), np.asarray(pseudo_inverse)


def directional_second_derivatives(axes: FloatArray, columns: FloatArray, moves: FloatArray) -> FloatArray:
    """Return the second derivatives (N, 3, c, c) of a position along the columns of moves (N, n, c)."""
    steps = axes[:, :, None] * moves[..., None]
    midpoints = np.cumsum(steps, axis=1) - steps / 2
    half_terms = np.cross(midpoints[:, :, :, None], (columns[:, :, None] * moves[..., None])[:, :, None]).sum(axis=1)
    return np.asarray((half_terms + half_terms.transpose(0, 2, 1, 3)).transpose(0, 3, 1, 2))


def transverse_axes(target: tuple[FloatArray, ...]) -> FloatArray:
    """Return unit vectors (N, 2, 3) perpendicular to the target axis."""
    return np.asarray(target[1][:, :, :2].transpose(0, 2, 1))


def axis_jacobian(tool_state: tuple[FloatArray, ...]) -> FloatArray:
    """Return the Jacobian (N, 3, n) of the tool's axis by the joints."""
    return np.asarray(np.cross(tool_state[2], tool_state[1][:, None, :, 2]).transpose(0, 2, 1))


def axial_vector(rotation: FloatArray) -> FloatArray:
    """Return the axial vectors (N, 3) of rotations."""
    doubled = np.stack(
        [rotation[:, 2, 1] - rotation[:, 1, 2], rotation[:, 0, 2] - rotation[:, 2, 0], rotation[:, 1, 0] - rotation[:, 0, 1]],
        axis=1,
    )
    return np.asarray(doubled / 2)


def axial_vector_jacobian(rotation: FloatArray) -> FloatArray:
    """Return the maps (N, 3, 3) from a to the axial vector of [a] R."""
    return np.asarray((np.trace(rotation, axis1=1, axis2=2)[:, None, None] * np.eye(3) - rotation) / 2)


def solve_regularized(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve linear systems with a small regularization; a nearly singular matrix gives a large result."""
    return np.asarray(np.linalg.solve(matrix + 1e-14 * np.eye(matrix.shape[-1]), right))
