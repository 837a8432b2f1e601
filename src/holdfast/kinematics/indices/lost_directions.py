"""Loss of end-effector speed by a failure at one configuration, computed from the Jacobian in plain NumPy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import SINGULAR_RATIO

MIN_ANGULAR_SINGULAR_VALUE = 1e-9  # smaller ones are rounding errors, because the columns contain unit axes


@dataclass(frozen=True)
class Ellipsoid:
    """Ellipsoid of the velocities of the tool point at joint rates of norm 1.

    Attributes:
        axes: (3, 3) principal axes as the columns of a rotation, world frame.
        radii: (3,) speeds, m/s, for rates of norm 1, in the order of the axes, largest first.
    """

    axes: FloatArray
    radii: FloatArray


@dataclass(frozen=True)
class DirectionLoss:
    """Direction of the task in which a failure reduces the speed.

    Attributes:
        kept: Fraction of the healthy arm's speed that remains in this direction, 0 (lost) to 1, at rates of norm 1.
        direction: (m,) unit vector in the task's rows, a combination of the Jacobian's left singular vectors.
    """

    kept: float
    direction: FloatArray

    @property
    def lost(self) -> bool:
        """True if no motion with a component in this direction is possible any more."""
        return self.kept <= 1e-6


def find_tool_ellipsoid(linear: FloatArray, angular: FloatArray, failed: Sequence[int] = ()) -> Ellipsoid:
    """Return the ellipsoid of a tool that does not rotate about the axes that the task prescribes.

    With ``J_l`` and ``J_a`` the reduced linear and angular rows, its matrix is ``J_l J_l' - J_l J_a' (J_a J_a')^-1 J_a J_l'``,
    the inverse of the linear block of ``(J J')^-1``. It is flat along the linear part of a lost direction. Without angular
    rows it is the manipulability ellipsoid of Yoshikawa 1985.

    Args:
        linear: (3, n) linear rows of the Jacobian, world frame.
        angular: (a, n) angular rows of the Jacobian that the task prescribes, in any frame; they may be dependent or zero.
        failed: Indices from 0 of the joints that do not move.
    """
    _, sigma, vt = np.linalg.svd(zero_failed_columns(angular, failed), full_matrices=False)
    rotating = vt[sigma > MIN_ANGULAR_SINGULAR_VALUE]
    velocities = zero_failed_columns(linear, failed)
    directions, sigma, _ = np.linalg.svd(velocities - velocities @ rotating.T @ rotating)
    radii = np.zeros(3)
    radii[: sigma.size] = sigma
    if np.linalg.det(directions) < 0:
        directions = directions * np.array([1.0, 1.0, -1.0])
    return Ellipsoid(directions, radii)


def find_speed_losses(j: FloatArray, failed: Sequence[int]) -> list[DirectionLoss]:
    """Return the directions in which locking joints reduces the speed most, worst first; as many as joints fail, at most m.

    With ``J_F`` the failed joints' columns of J, and c a left singular vector of their rows of an orthonormal null-space basis
    of J, the singular value is the fraction of the speed that remains along ``(J J')^-1 J_F c``; across these directions
    nothing changes. For one joint k this fraction is its relative manipulability rho_k (Abdi et al. 2012, eq. (3)).
    Directions that the healthy arm lacks are left out.

    Args:
        j: (m, n) task Jacobian.
        failed: Indices from 0 of the joints that do not move.
    """
    if not len(failed):
        return []
    u, sigma, vt = np.linalg.svd(j)
    rank = int((sigma > SINGULAR_RATIO * sigma[0]).sum()) if sigma.size and sigma[0] > 0 else 0
    if rank == 0:
        return []
    combinations, fractions, _ = np.linalg.svd(vt[rank:, list(failed)].T)  # (failed, failed), at most r fractions
    remaining = np.r_[np.minimum(fractions, 1.0), np.zeros(len(failed) - len(fractions))][::-1]
    # The columns are orthogonal already; QR gives a unit vector also for a joint that does not move the tool.
    row_space_vectors = np.linalg.qr(vt[:rank, list(failed)] @ combinations[:, ::-1]).Q
    directions = u[:, :rank] @ (row_space_vectors / sigma[:rank, None])
    directions /= np.linalg.norm(directions, axis=0)
    return [DirectionLoss(float(kept), direction) for kept, direction in zip(remaining, directions.T, strict=False)]


def remaining_manipulability(losses_found: Sequence[DirectionLoss]) -> float:
    """Return ``sqrt(det(Jf Jf') / det(J J'))`` of a failed set: the product of its fractions; Abdi et al. 2012, eq. (3)."""
    return float(np.prod([loss.kept for loss in losses_found]))


def null_space_joint_rates(j: FloatArray, failed: Sequence[int]) -> FloatArray:
    """Return orthonormal joint rates (r, n) that keep the task velocity at 0 with failed joints locked.

    Args:
        j: (m, n) task Jacobian.
        failed: Indices from 0 of the joints that do not move.
    """
    n = j.shape[1]
    moving = [k for k in range(n) if k not in set(failed)]
    if not moving:
        return np.zeros((0, n))
    _, sigma, vt = np.linalg.svd(j[:, moving], full_matrices=True)
    rank = int((sigma > 1e-9 * max(float(sigma.max(initial=0.0)), 1e-300)).sum())
    basis = np.zeros((len(moving) - rank, n))
    basis[:, moving] = vt[rank:]
    return basis


def zero_failed_columns(j: FloatArray, failed: Sequence[int]) -> FloatArray:
    """Return the reduced Jacobian with the columns of failed joints set to 0, so that its shape is unchanged."""
    reduced = np.array(j)
    reduced[:, list(failed)] = 0.0
    return reduced
