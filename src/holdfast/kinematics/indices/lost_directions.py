"""Loss of end-effector speed by a failure at one configuration, computed from the Jacobian in plain NumPy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import SINGULAR_RATIO


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
