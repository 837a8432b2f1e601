"""Task rows over boxes of joints and targets: if some combination of rows is never 0, the tool misses the target pose.

In doubles, for batches; it may be wrong: the verifier decides.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.joint_boxes.segments import curvature_costs
from holdfast.certificates.taylor import ReachSolver
from holdfast.core.typing import FloatArray


class TaskErrorBound:
    """Lower bound of the task error of a claim.

    Args:
        claim: Of which nothing is reached.
        joints: (n, 2) rad and m, where they may be.
    """

    def __init__(self, claim: OutOfReachClaim, joints: FloatArray) -> None:
        self._arguments = claim, joints
        self.reach = ReachSolver(claim.arm, claim.task, claim.locked, joints, claim.rotation, claim.angle)
        self._linear = self.reach.linear

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return TaskErrorBound, self._arguments

    def lower_error_bound(
        self, q: FloatArray, half: FloatArray, targets: FloatArray, target_half: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound a combination of rows away from 0 over q +- half (N, n) and targets +- target_half (N, a).

        Returns:
            The bound (N,), what it is in the middles (N,), and what of it each joint and axis of the target costs (N, n + a).
        """
        reach, linear = self.reach, self._linear
        count, n, extra_rows = len(q), q.shape[1], int(reach.uses_rotation)
        m, variables = reach.m + extra_rows, q.shape[1] + reach.axes - linear
        outputs = reach.expansion.error_derivative_kernel.rows(q, reach.append_target_rotation(targets))
        error, gradients, second = np.split(outputs, np.cumsum([m, m * variables]), axis=1)
        gradients, second = gradients.reshape(count, m, variables), second.reshape(count, m, variables, variables)
        half_widths = np.concatenate([half, target_half[:, linear:]], axis=1)
        position_remainder, angle = self._position_remainder_and_rotation(q, half, target_half)
        spans = gradients * half_widths[:, None]
        spread = spans @ spans.transpose(0, 2, 1) + (1e-6 * (error**2).sum(axis=1) + 1e-30)[:, None, None] * np.eye(m)
        spread[:, range(linear), range(linear)] += target_half[:, :linear] ** 2
        whitened = np.linalg.solve(spread, error[:, :, None])[:, :, 0]
        is_position = np.arange(m) < linear
        best = np.full(count, -np.inf), np.zeros(count), np.zeros((count, n + reach.axes))
        for direction in (error, whitened, *([error * is_position, error * ~is_position] if extra_rows else [])):
            unit = direction / np.maximum(np.linalg.norm(direction, axis=1), 1e-300)[:, None]
            own_costs, pair_costs = curvature_costs(
                np.abs(np.einsum("na,nak->nk", unit, gradients)), np.einsum("na,najk->njk", unit, second), half_widths
            )
            remainder = (
                np.linalg.norm(unit[:, :linear], axis=1) * position_remainder
                + np.linalg.norm(unit[:, linear:], axis=1) * angle**3 / 6
            )
            target_costs, center_value = np.abs(unit[:, :linear]) * target_half[:, :linear], np.einsum("na,na->n", unit, error)
            bound = center_value - own_costs.sum(axis=1) - pair_costs.sum(axis=1) / 2 - remainder - target_costs.sum(axis=1)
            joint_costs = (
                own_costs + pair_costs + (3 * remainder / np.maximum(half_widths.sum(axis=1), 1e-300))[:, None] * half_widths
            )
            all_costs = np.concatenate([joint_costs[:, :n], target_costs, joint_costs[:, n:]], axis=1)
            # What a combination tells is how much of its value is lost, not how large it is: rows are m and rad.
            improved = bound / np.maximum(center_value, 1e-12) > best[0] / np.maximum(best[1], 1e-12)
            best = tuple(  # type: ignore[assignment]
                np.where(improved if new.ndim == 1 else improved[:, None], new, old)
                for new, old in zip((bound, center_value, all_costs), best, strict=True)
            )
        return best

    def _position_remainder_and_rotation(
        self, q: FloatArray, half: FloatArray, target_half: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the third-order remainder of the point, m, and the angle by which it rotates, rad."""
        slides, lengths = self.reach.slides, self.reach.expansion.lengths
        c, slide_range = np.cumsum(half * ~slides, axis=1), half * slides
        position_remainder = (c**3 * (lengths + np.abs(q) * slides + slide_range) + 3 * c**2 * slide_range).sum(axis=1) / 6
        return position_remainder, c[:, -1] + target_half[:, self._linear :].sum(axis=1)
