"""Matrices and matrix invariants for user-defined formulas, as functions of CasADi symbols."""

from __future__ import annotations

import casadi as ca

from holdfast.core.errors import InputError
from holdfast.kernels.linalg import dot_product, jacobi_sweep
from holdfast.kernels.program import SX
from holdfast.model.arm import statics
from holdfast.model.arm.machine import ArmData

_JACOBI_SWEEPS = 6
_MAX_ROWS = 6


def compute_inertia_matrix(arm: ArmData, q: SX) -> SX:
    """Compute the joint-space inertia matrix, payload and armature included.

    Args:
        arm: Arm model with inertial data.
        q: (n,) symbols of the configuration, rad and m.

    Returns:
        (n, n) matrix, kg m^2 for revolute joints and kg for prismatic joints.

    Raises:
        ArmError: Inertial data are missing or impossible.
    """
    return statics.inertia_matrix(arm, q)


def compute_singular_values(matrix: SX) -> SX:
    """Compute the singular values of a matrix by Jacobi rotations of its rows; the result can be differentiated.

    The eigenvalues of ``matrix @ matrix.T`` are their squares.

    Args:
        matrix: (m, c) matrix with at most six rows and at least as many columns.

    Returns:
        (m,) singular values in no particular order.

    Raises:
        InputError: The matrix has more than six rows, or fewer columns than rows.
    """
    m, columns = matrix.shape
    if not 1 <= m <= min(columns, _MAX_ROWS):
        raise InputError(f"the matrix has shape {m}x{columns}; it must have 1 to {_MAX_ROWS} rows and at least as many columns")
    rows = [ca.horzsplit(row) for row in ca.vertsplit(ca.densify(matrix))]
    for _ in range(_JACOBI_SWEEPS):
        rows, _change = jacobi_sweep(rows)
    return ca.vertcat(*[ca.sqrt(dot_product(row, row)) for row in rows])


def compute_symmetric_eigenvalues(matrix: SX) -> SX:
    """Compute the eigenvalues of a symmetric matrix; each can be differentiated where no other equals it.

    They are the singular values of the matrix plus twice its Frobenius norm on the diagonal, which is positive definite.

    Args:
        matrix: (m, m) symmetric matrix with at most six rows, not all entries 0.

    Returns:
        (m,) eigenvalues in no particular order, accurate to about 1e-15 of the Frobenius norm.

    Raises:
        InputError: The matrix is not square, or has more than six rows.
    """
    m, columns = matrix.shape
    if m != columns:
        raise InputError(f"the matrix has shape {m}x{columns}; it must be square")
    shift = 2 * ca.norm_fro(matrix)
    return compute_singular_values(matrix + shift * ca.SX.eye(m)) - shift
