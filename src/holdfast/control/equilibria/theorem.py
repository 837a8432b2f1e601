"""Condition under which only locked joints are commanded (erroneous convergence), for any number of locked joints.

The controller commands ``W^-1 J' y`` with ``y = (J W^-1 J')^-1 xc``. Only locked joints are commanded if and only if y is
orthogonal to every healthy column of ``J W^-1`` (Theorem 1'). The paper's two conditions (rank, and a command in the span of
the locked columns) are equivalent for one locked joint, but not sufficient for several.

Source: Goel, Maciejewski, Balakrishnan 2005, Theorem 1, eq. (10) to (12), corrected; eq. (18) to (21).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.model import Arm

RANK_TOLERANCE = 1e-9  # fraction of the largest singular value; smaller ones count as 0


def stuck_subspace(j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int]) -> FloatArray:
    """Return the space of the commands that move no healthy joint: ``(J W^-1 J') null(S(J W^-1)')``.

    S() sets the columns of locked joints to 0.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: (n, n) symmetric positive definite matrix, or (n,) weights above 0; None: those of the pseudoinverse.
        locked: Indices from 0 of the locked joints.

    Returns:
        (m, d) orthonormal basis with d = m - rank; d = 0 if no command is stuck.

    Raises:
        InputError: Wrong shapes, joints or weights.

    Source: Goel et al. 2005, eq. (11), (12), as corrected in Theorem 1'.
    """
    jacobian, inverse_weights, healthy = _check_inputs(j, weights, locked)
    weighted_jacobian = jacobian @ inverse_weights
    left_vectors, singular_values, _ = np.linalg.svd(weighted_jacobian[:, healthy])
    rank = int((singular_values > RANK_TOLERANCE * np.linalg.norm(weighted_jacobian, 2)).sum())
    stuck_commands = weighted_jacobian @ jacobian.T @ left_vectors[:, rank:]
    return np.asarray(np.linalg.qr(stuck_commands)[0])


def is_stuck(
    j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int], *, command: ArrayLike, tolerance: float = 1e-9
) -> bool:
    """Return True if a command moves no healthy joint, within a tolerance.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: (n, n) or (n,) weights of the joints; see :func:`stuck_subspace`.
        locked: Indices from 0 of the locked joints.
        command: (m,) task velocity. A command of zero is not stuck, because the target is reached.
        tolerance: Largest fraction of the healthy rates in all joint rates.

    Raises:
        InputError: Wrong shapes, joints or weights.

    Source: Goel et al. 2005, eq. (10), (11), as corrected in Theorem 1'.
    """
    jacobian, inverse_weights, healthy = _check_inputs(j, weights, locked)
    velocity = np.asarray(command, dtype=np.float64)
    if velocity.shape != (len(jacobian),):
        raise InputError(
            f"the command has shape {velocity.shape}; the Jacobian has {len(jacobian)} rows, so it must be ({len(jacobian)},)"
        )
    weighted_jacobian = jacobian @ inverse_weights
    joint_rates = weighted_jacobian.T @ np.linalg.solve(weighted_jacobian @ jacobian.T, velocity)
    rate_norm = float(np.linalg.norm(joint_rates))
    return rate_norm > 0 and float(np.linalg.norm(joint_rates[healthy])) <= tolerance * rate_norm


def column_residual(arm: Arm, q: ArrayLike, joint: int | str, *, command: ArrayLike) -> FloatArray:
    """Return the part (6,) of a command that is not along the column of a joint, m/s and rad/s.

    It is zero if the joint alone would execute the whole command. For a revolute joint with axis z and lever ``z x p`` it is
    ``x_v - (z'x_w)(z x p)`` and ``x_w - (z'x_w) z``, with one common factor; for a prismatic joint ``x_v - (z'x_v) z`` and
    ``x_w``.

    Args:
        arm: The arm.
        q: (n,) configuration, rad and m.
        joint: Name, or index from 0, of the joint.
        command: (6,) twist in the world, m/s and rad/s.

    Raises:
        InputError: Wrong shapes or joint.

    Source: Goel et al. 2005, eq. (18) to (20).
    """
    twist = np.asarray(command, dtype=np.float64)
    if twist.shape != (6,):
        raise InputError(f"the command has shape {twist.shape}; give a twist (6,), linear part first")
    index = arm.joint_index(joint)
    column = arm.jacobian(arm.check_configurations(q))[:, index]
    factor = column[:3] @ twist[:3] if arm.joints[index].prismatic else column[3:] @ twist[3:]
    return np.asarray(twist - factor * column)


def null_components(j: ArrayLike, weights: ArrayLike | None, joint: int) -> FloatArray:
    """Return ``N' w_i`` (n - m,), which is zero if a command along the column of joint i is stuck.

    N spans the null space of J. For the pseudoinverse the result contains the joint's components of the null vectors.

    Args:
        j: (m, n) Jacobian of full rank.
        weights: (n, n) or (n,) weights of the joints; see :func:`stuck_subspace`.
        joint: Index from 0 of joint i.

    Raises:
        InputError: Wrong shapes, joint or weights.

    Source: Goel et al. 2005, eq. (21), with ``w_i`` for other weights than 1.
    """
    jacobian, inverse_weights, _ = _check_inputs(j, weights, [joint])
    null_space = np.linalg.svd(jacobian)[2][len(jacobian) :]
    return np.asarray(null_space @ np.linalg.solve(inverse_weights, np.eye(jacobian.shape[1])[:, joint]))


def _check_inputs(j: ArrayLike, weights: ArrayLike | None, locked: Sequence[int]) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return J, the inverse of the weights, and the mask of healthy joints."""
    jacobian = np.asarray(j, dtype=np.float64)
    if jacobian.ndim != 2 or not np.isfinite(jacobian).all() or jacobian.shape[0] > jacobian.shape[1]:
        raise InputError(f"the Jacobian has shape {jacobian.shape}; it must be (m, n) finite numbers with m at most n")
    n = jacobian.shape[1]
    weight_matrix = np.eye(n) if weights is None else np.asarray(weights, dtype=np.float64)
    weight_matrix = np.diag(weight_matrix) if weight_matrix.ndim == 1 else weight_matrix
    if (
        weight_matrix.shape != (n, n)
        or not np.allclose(weight_matrix, weight_matrix.T)
        or np.linalg.eigvalsh(weight_matrix)[0] <= 0
    ):
        raise InputError(f"weights must be ({n},) numbers above 0 or a symmetric positive definite ({n}, {n}) matrix")
    invalid = [joint for joint in locked if not 0 <= joint < n]
    if invalid:
        raise InputError(f"locked names joint {invalid[0]}; the Jacobian has joints 0 to {n - 1}")
    healthy = np.ones(n, dtype=bool)
    healthy[list(locked)] = False
    return jacobian, np.asarray(np.linalg.inv(weight_matrix), dtype=np.float64), healthy
