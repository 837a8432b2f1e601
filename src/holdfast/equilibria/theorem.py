"""When only locked joints are commanded: the condition of erroneous convergence, for any number of locked joints.

The controller commands ``W^-1 J' y`` with ``y = (J W^-1 J')^-1 xc``. Only locked joints are commanded if and only if y is
orthogonal to every healthy column of ``J W^-1`` (Theorem 1'). The paper's own two conditions (rank, and a command in the
span of the locked columns) are this for one locked joint; for several they are not sufficient.

Source: Goel, Maciejewski, Balakrishnan 2005, Theorem 1, eq. (10) to (12), corrected; eq. (18) to (21).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]

RANK = 1e-9  # of the largest singular value: a smaller one counts as 0


def stuck_subspace(j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int]) -> Array:
    """Commands that move no healthy joint: ``(J W^-1 J') null(S(J W^-1)')``, S() with the columns of locked joints zeroed.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: (n, n) symmetric positive definite or (n,) above 0; None: the pseudoinverse.
        locked: Joints, from 0.

    Returns:
        (m, d) orthonormal basis, d = m - rank; d = 0 where no command is stuck.

    Raises:
        InputError: Wrong shapes, joints or weights.

    Source: Goel et al. 2005, eq. (11), (12), as corrected in Theorem 1'.
    """
    jacobian, inverse, healthy = _read(j, weights, locked)
    spread = jacobian @ inverse
    left, size, _ = np.linalg.svd(spread[:, healthy])
    rank = int((size > RANK * np.linalg.norm(spread, 2)).sum())
    stuck = spread @ jacobian.T @ left[:, rank:]
    return np.asarray(np.linalg.qr(stuck)[0])


def is_stuck(
    j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int], *, command: ArrayLike, tolerance: float = 1e-9
) -> bool:
    """Whether a command moves no healthy joint: its share of the joint rates is at most the tolerance.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: As for :func:`stuck_subspace`.
        locked: Joints, from 0.
        command: (m,) task velocity. A command of zero is not stuck: the target is reached.
        tolerance: Of the healthy rates, as a share of all rates.

    Raises:
        InputError: Wrong shapes, joints or weights.

    Source: Goel et al. 2005, eq. (10), (11), as corrected in Theorem 1'.
    """
    jacobian, inverse, healthy = _read(j, weights, locked)
    velocity = np.asarray(command, dtype=np.float64)
    if velocity.shape != (len(jacobian),):
        raise InputError(
            f"the command has shape {velocity.shape}; the Jacobian has {len(jacobian)} rows, so it must be ({len(jacobian)},)"
        )
    spread = jacobian @ inverse
    rates = spread.T @ np.linalg.solve(spread @ jacobian.T, velocity)
    size = float(np.linalg.norm(rates))
    return size > 0 and float(np.linalg.norm(rates[healthy])) <= tolerance * size


def column_residual(arm: Arm, q: ArrayLike, joint: int | str, *, command: ArrayLike) -> Array:
    """What of a command is not along the column of a joint, (6,): zero where the joint alone would do all of it.

    For a revolute joint with axis z and lever ``z x p``: ``x_v - (z'x_w)(z x p)`` and ``x_w - (z'x_w) z``, with one common
    factor; for a sliding one ``x_v - (z'x_v) z`` and ``x_w``.

    Args:
        arm: The arm.
        q: (n,) rad and m.
        joint: By name or index from 0.
        command: (6,) twist in the world, m/s and rad/s.

    Raises:
        InputError: Wrong shapes or joint.

    Source: Goel et al. 2005, eq. (18) to (20).
    """
    twist = np.asarray(command, dtype=np.float64)
    if twist.shape != (6,):
        raise InputError(f"the command has shape {twist.shape}; give a twist (6,), linear part first")
    k = arm.joint_index(joint)
    column = arm.jacobian(arm.check_configurations(q))[:, k]
    factor = column[:3] @ twist[:3] if arm.joints[k].prismatic else column[3:] @ twist[3:]
    return np.asarray(twist - factor * column)


def null_components(j: ArrayLike, weights: ArrayLike | None, joint: int) -> Array:
    """``N' w_i``, (n - m,): zero where a command along the column of joint i is stuck. N spans the null space of J.

    For the pseudoinverse these are the joint's components of the null vectors.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: As for :func:`stuck_subspace`.
        joint: From 0.

    Raises:
        InputError: Wrong shapes, joint or weights.

    Source: Goel et al. 2005, eq. (21), with ``w_i`` for other weights than 1.
    """
    jacobian, inverse, _ = _read(j, weights, [joint])
    null = np.linalg.svd(jacobian)[2][len(jacobian) :]
    return np.asarray(null @ np.linalg.solve(inverse, np.eye(jacobian.shape[1])[:, joint]))


def _read(j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int]) -> tuple[Array, Array, NDArray[np.bool_]]:
    """J, the inverse of the weights, and which joints are healthy."""
    jacobian = np.asarray(j, dtype=np.float64)
    if jacobian.ndim != 2 or not np.isfinite(jacobian).all() or jacobian.shape[0] > jacobian.shape[1]:
        raise InputError(f"the Jacobian has shape {jacobian.shape}; it must be (m, n) finite numbers with m at most n")
    n = jacobian.shape[1]
    w = np.eye(n) if weights is None else np.asarray(weights, dtype=np.float64)
    w = np.diag(w) if w.ndim == 1 else w
    if w.shape != (n, n) or not np.allclose(w, w.T) or np.linalg.eigvalsh(w)[0] <= 0:
        raise InputError(f"weights must be ({n},) numbers above 0 or a symmetric positive definite ({n}, {n}) matrix")
    wrong = [i for i in locked if not 0 <= i < n]
    if wrong:
        raise InputError(f"locked names joint {wrong[0]}; the Jacobian has joints 0 to {n - 1}")
    healthy = np.ones(n, dtype=bool)
    healthy[list(locked)] = False
    return jacobian, np.asarray(np.linalg.inv(w), dtype=np.float64), healthy
