"""The lines of revolute joints whose Jacobian is given, or has a given null space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.ceilings.frames import complement
from holdfast.errors import InputError

Array = NDArray[np.float64]

_NO_LINE = 1e-6  # v.w or |w| - 1 of a column beyond which it is the velocity of no revolute joint
_SOLVED = 1e-12
_STEPS = 80
_SCALES = np.logspace(-2, 2, 81)
_WIDE = 50.0  # a condition number beyond which a start is not worth keeping


def axes_of(jacobian: Array, angles: Array | None = None) -> tuple[Array, Array]:
    """Directions and points of the joint axes of a Jacobian, in the frame of its rows; the tool point is the origin.

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
    rows, n = jacobian.shape
    if rows not in (2, 3, 6):
        raise InputError(
            f"a Jacobian of {rows} rows is of no task that arms are made for; give 2 (planar), 3 (position) or 6 (pose)"
        )
    if not np.isfinite(jacobian).all():
        raise InputError("the Jacobian holds numbers that are not finite")
    empty = np.flatnonzero(~jacobian.any(axis=0))
    if empty.size:
        raise InputError(f"column {empty[0] + 1} of the Jacobian is 0: that joint does nothing, and its lock takes nothing")
    if np.linalg.matrix_rank(jacobian) < rows:
        raise InputError(f"the rows of the Jacobian are dependent: its rank is {np.linalg.matrix_rank(jacobian)}, not {rows}")
    if rows == 2:
        w = np.tile([0.0, 0.0, 1.0], (n, 1))
        v = np.column_stack([jacobian.T, np.zeros(n)])
    elif rows == 3:
        v = jacobian.T
        w = np.array([_across(x, b) for x, b in zip(v, np.zeros(n) if angles is None else angles, strict=True)])
    else:
        v, w = jacobian[:3].T, jacobian[3:].T
        off = np.maximum(abs((v * w).sum(axis=1)), abs(np.linalg.norm(w, axis=1) - 1))
        worst = int(off.argmax())
        if off[worst] > _NO_LINE:
            raise InputError(
                f"column {worst + 1} of the Jacobian is the velocity of no revolute joint: v.w or |w| - 1 is {off[worst]:.1e}; "
                "both must be 0"
            )
        w = w / np.linalg.norm(w, axis=1, keepdims=True)
    return w, np.cross(w, v)


def _across(v: Array, angle: float) -> Array:
    side = np.eye(3)[int(abs(v).argmin())]
    first = np.cross(v, side)
    first /= np.linalg.norm(first)
    second = np.cross(v / np.linalg.norm(v), first)
    return np.asarray(np.cos(angle) * first + np.sin(angle) * second)


def poses_of(null_space: Array, *, starts: int, seed: int) -> tuple[list[Array], float]:
    """Jacobians of poses, all of whose columns are lines, with a given null space: Newton's method from random starts.

    ``J = A B`` with B across the null space; A (6, 6) is sought so that ``v.w = 0`` and ``|w| = 1`` in every column, 2 n
    equations for 36 numbers.

    Returns:
        Those found, best condition number first (lengths scaled so that it is least), and the least residual of all starts.

    Source: derived here.
    """
    across, rng, found, least = complement(null_space).T, np.random.default_rng(seed), [], np.inf
    n = len(null_space)
    for _ in range(starts):
        a = rng.normal(size=(6, 6))
        for _ in range(_STEPS):
            columns = a @ across
            v, w = columns[:3], columns[3:]
            off = np.concatenate([(v * w).sum(axis=0), ((w * w).sum(axis=0) - 1) / 2])
            size = float(abs(off).max())
            if size < _SOLVED:
                break
            slope = np.zeros((2 * n, 6, 6))
            slope[:n, :3], slope[:n, 3:] = w.T[:, :, None] * across.T[:, None, :], v.T[:, :, None] * across.T[:, None, :]
            slope[n:, 3:] = w.T[:, :, None] * across.T[:, None, :]
            step = np.linalg.lstsq(slope.reshape(2 * n, 36), -off, rcond=1e-12)[0].reshape(6, 6)
            a = a + step / max(1.0, float(np.linalg.norm(step)))
        least = min(least, size)
        if size < _SOLVED:
            found.append(_scaled(a @ across))
    found.sort(key=lambda j: float(np.linalg.cond(j)))
    return [j for j in found if np.linalg.cond(j) < _WIDE] or found[:1], least


def _scaled(jacobian: Array) -> Array:
    """With the lengths in the unit that makes the condition number least."""
    many = jacobian[None] * np.where(np.arange(6) < 3, _SCALES[:, None], 1.0)[:, :, None]
    return np.asarray(many[np.linalg.cond(many).argmin()])
