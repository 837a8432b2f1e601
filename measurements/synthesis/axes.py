"""Find the lines of revolute joints whose Jacobian is given, or has a given null space."""

from __future__ import annotations

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.frames import orthogonal_complement

_LINE_TOLERANCE = 1e-6  # v.w or |w| - 1 of a column beyond which it is the velocity of no revolute joint
_SOLVED_RESIDUAL = 1e-12
_MAX_NEWTON_STEPS = 80
_LENGTH_SCALES = np.logspace(-2, 2, 81)
_MAX_CONDITION_NUMBER = 50.0  # a condition number beyond which a start is not worth keeping


def find_joint_axes(jacobian: FloatArray, angles: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
    """Return directions and points of the joint axes of a Jacobian, in the frame of its rows; the tool point is the origin.

    A planar column v belongs to the joint at a quarter turn from it; a column v of a position to any axis across v at the
    distance ``|v|``, of which ``angles`` chooses one; a column (v, w) of a pose to the line along w through ``w x v``.

    Args:
        jacobian: (2, n) planar, (3, n) position, m per rad, or (6, n) pose, v above w.
        angles: (n,) rad, for positions; 0 if not given.

    Returns:
        (n, 3) unit directions and (n, 3) points, m, nearest the tool point.

    Raises:
        InputError: Another number of rows, numbers that are not finite, a column of zeros, dependent rows, a column of a pose
            that is not a line: ``v.w`` or ``|w| - 1`` beyond 1e-6.

    Source: derived here.
    """
    row_count, n = jacobian.shape
    if row_count not in (2, 3, 6):
        raise InputError(
            f"a Jacobian of {row_count} rows is of no task that arms are made for; give 2 (planar), 3 (position) or 6 (pose)"
        )
    if not np.isfinite(jacobian).all():
        raise InputError("the Jacobian holds numbers that are not finite")
    zero_columns = np.flatnonzero(~jacobian.any(axis=0))
    if zero_columns.size:
        raise InputError(
            f"column {zero_columns[0] + 1} of the Jacobian is 0: that joint does nothing, and its lock takes nothing"
        )
    if np.linalg.matrix_rank(jacobian) < row_count:
        raise InputError(
            f"the rows of the Jacobian are dependent: its rank is {np.linalg.matrix_rank(jacobian)}, not {row_count}"
        )
    if row_count == 2:
        w = np.tile([0.0, 0.0, 1.0], (n, 1))
        v = np.column_stack([jacobian.T, np.zeros(n)])
    elif row_count == 3:
        v = jacobian.T
        w = np.array(
            [
                _find_perpendicular_axis(column, angle)
                for column, angle in zip(v, np.zeros(n) if angles is None else angles, strict=True)
            ]
        )
    else:
        v, w = jacobian[:3].T, jacobian[3:].T
        line_errors = np.maximum(abs((v * w).sum(axis=1)), abs(np.linalg.norm(w, axis=1) - 1))
        worst_column = int(line_errors.argmax())
        if line_errors[worst_column] > _LINE_TOLERANCE:
            raise InputError(
                f"column {worst_column + 1} of the Jacobian is the velocity of no revolute joint: v.w or |w| - 1 is "
                f"{line_errors[worst_column]:.1e}; "
                "both must be 0"
            )
        w = w / np.linalg.norm(w, axis=1, keepdims=True)
    return w, np.cross(w, v)


def _find_perpendicular_axis(v: FloatArray, angle: float) -> FloatArray:
    other_axis = np.eye(3)[int(abs(v).argmin())]
    first = np.cross(v, other_axis)
    first /= np.linalg.norm(first)
    second = np.cross(v / np.linalg.norm(v), first)
    return np.asarray(np.cos(angle) * first + np.sin(angle) * second)


def find_pose_jacobians(null_space: FloatArray, *, starts: int, seed: int) -> tuple[list[FloatArray], float]:
    """Find pose Jacobians with a given null space all of whose columns are lines, by Newton's method from random starts.

    ``J = A B`` with B across the null space; A (6, 6) is sought so that ``v.w = 0`` and ``|w| = 1`` in every column, 2 n
    equations for 36 numbers.

    Returns:
        Those found, best condition number first (lengths scaled so that it is least), and the least residual of all starts.

    Source: derived here.
    """
    complement_rows, rng, jacobians, least_residual = (
        orthogonal_complement(null_space).T,
        np.random.default_rng(seed),
        [],
        np.inf,
    )
    n = len(null_space)
    for _ in range(starts):
        a = rng.normal(size=(6, 6))
        for _ in range(_MAX_NEWTON_STEPS):
            columns = a @ complement_rows
            v, w = columns[:3], columns[3:]
            residuals = np.concatenate([(v * w).sum(axis=0), ((w * w).sum(axis=0) - 1) / 2])
            residual = float(abs(residuals).max())
            if residual < _SOLVED_RESIDUAL:
                break
            derivatives = np.zeros((2 * n, 6, 6))
            derivatives[:n, :3], derivatives[:n, 3:] = (
                w.T[:, :, None] * complement_rows.T[:, None, :],
                v.T[:, :, None] * complement_rows.T[:, None, :],
            )
            derivatives[n:, 3:] = w.T[:, :, None] * complement_rows.T[:, None, :]
            step = np.linalg.lstsq(derivatives.reshape(2 * n, 36), -residuals, rcond=1e-12)[0].reshape(6, 6)
            a = a + step / max(1.0, float(np.linalg.norm(step)))
        least_residual = min(least_residual, residual)
        if residual < _SOLVED_RESIDUAL:
            jacobians.append(_scale_lengths(a @ complement_rows))
    jacobians.sort(key=lambda candidate: float(np.linalg.cond(candidate)))
    return [candidate for candidate in jacobians if np.linalg.cond(candidate) < _MAX_CONDITION_NUMBER] or jacobians[
        :1
    ], least_residual


def _scale_lengths(jacobian: FloatArray) -> FloatArray:
    """Return the Jacobian with lengths in the unit that minimises the condition number."""
    candidates = jacobian[None] * np.where(np.arange(6) < 3, _LENGTH_SCALES[:, None], 1.0)[:, :, None]
    return np.asarray(candidates[np.linalg.cond(candidates).argmin()])
