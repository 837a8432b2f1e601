"""Loss of end-effector speed by a failure at one configuration, computed from the Jacobian in plain NumPy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import SINGULAR_RATIO


@dataclass(frozen=True)
class Ellipsoid:
    """Ellipsoid of the tool-point velocities for joint rates of norm 1; Yoshikawa 1985.

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


def manipulability_ellipsoid(j: FloatArray, failed: Sequence[int] = ()) -> Ellipsoid:
    """Return the manipulability ellipsoid of the tool point.

    Args:
        j: (3, n) linear rows of the Jacobian, world frame.
        failed: Indices from 0 of the joints that do not move.
    """
    directions, sigma, _ = np.linalg.svd(zero_failed_columns(j, failed), full_matrices=True)
    radii = np.zeros(3)
    radii[: sigma.size] = sigma
    if np.linalg.det(directions) < 0:
        directions = directions * np.array([1.0, 1.0, -1.0])
    return Ellipsoid(directions, radii)


def find_speed_losses(j: FloatArray, failed: Sequence[int]) -> list[DirectionLoss]:
    """Return the directions in which locking joints reduces the speed most, worst first; as many as joints fail, at most m.

    With ``J = U S V'`` and W the failed joints' rows of V, the reduced Gram matrix is ``U S (I - W'W) S U'``: along
    ``u = U S^-1 w`` with w a right singular vector of W, speeds shrink to ``sqrt(1 - sigma(W)^2)``, and across these
    directions nothing changes. For one joint k this fraction is its relative manipulability rho_k (Abdi et al. 2012, eq. (3)).
    Directions that the healthy arm lacks are left out.

    Args:
        j: (m, n) task Jacobian.
        failed: Indices from 0 of the joints that do not move.
    """
    if not len(failed):
        return []
    u, sigma, vt = np.linalg.svd(j, full_matrices=False)
    rank = int((sigma > SINGULAR_RATIO * sigma[0]).sum()) if sigma.size and sigma[0] > 0 else 0
    if rank == 0:
        return []
    w = vt[:rank, list(failed)].T  # (failed, rank)
    _, fractions, right = np.linalg.svd(w, full_matrices=False)
    # cos(asin(x)) loses digits near 1; the null space avoids this by 1 - s^2 = (1 - s)(1 + s).
    remaining = np.sqrt(np.clip((1 - fractions) * (1 + fractions), 0.0, 1.0))
    found_losses = []
    for k, direction in zip(remaining, right, strict=True):
        along_direction = u[:, :rank] @ (direction / sigma[:rank])
        found_losses.append(DirectionLoss(float(k), along_direction / np.linalg.norm(along_direction)))
    return sorted(found_losses, key=lambda loss: loss.kept)


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
