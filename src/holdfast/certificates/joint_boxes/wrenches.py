"""Upper bounds of relative manipulability by a wrench for each box of configurations.

Let a_l be the moment of a wrench y about the axis of joint l. For every y, the relative manipulability after a lock of joint k
is at most sqrt(A / (A + a_k^2)), where A is the sum of the other a_l^2; the best y attains it. In each box y moves with the
joints, y = y_0 + Y (q - q_c), where Y keeps the a_l as constant as possible. Screws are those of axes in the frame of a middle
link, so the first and the last joint do not matter. Their first and second derivatives are brackets, exact at the centre. The
numbers here have no error bounds; the verifier decides.
"""

from __future__ import annotations

import numpy as np

from holdfast.certificates.joint_boxes.halving import OPEN_TOKEN
from holdfast.certificates.joint_boxes.screws import ScrewModel, Screws
from holdfast.certificates.taylor import CertificateChain
from holdfast.core.typing import FloatArray, IndexArray

FIRST_LOCK_TOKEN = 128  # token of a box in which a lock of joint 0 reduces enough
_BOUND_MARGIN = 1e-9
_DAMPING_FACTOR = 0.01  # factor of the square of the largest relevant half width, added to the squares of the screws


class ManipulabilityCeilingTest:
    """Test whether relative manipulability is at most a threshold after one of some locks, in boxes of configurations.

    Args:
        chain: Kinematic chain of the arm.
        locks: Indices of the joints, one of which suffices.
        threshold: Upper bound, above 0 and below 1.
    """

    def __init__(self, chain: CertificateChain, locks: tuple[int, ...], threshold: float) -> None:
        self.screws, self.locks = ScrewModel(chain), locks
        self.max_ratio = threshold / np.sqrt(1 - threshold**2)

    def __call__(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the tokens of boxes and the gain of halving each joint."""
        expansion = self.screws(middle)
        screws = expansion.axes
        gram, count = np.einsum("nla,nlb->nab", screws, screws), len(middle)
        moving = self.screws.sign.any(axis=0)
        damping = _DAMPING_FACTOR * (half * moving).max(axis=1) ** 2
        damped_gram = gram + damping[:, None, None] * np.eye(6)
        solved = np.linalg.solve(damped_gram, screws.transpose(0, 2, 1)).transpose(0, 2, 1)
        remaining = 1 - np.einsum("nla,nla->nl", screws, solved)
        tokens, best_ratios, gain = np.full(count, OPEN_TOKEN, dtype=np.int64), np.full(count, np.inf), half * moving
        lock_values = remaining[:, list(self.locks)]
        for rank in range(min(2, len(self.locks))):
            locks = np.array(self.locks)[np.argsort(lock_values, axis=1)[:, rank]]
            ratios, joint_costs = self._bound_moment_ratio(locks, expansion, gram, half, damping)
            improved = (ratios < best_ratios) & np.isfinite(joint_costs).all(axis=1)
            best_ratios[improved], gain[improved] = ratios[improved], joint_costs[improved]
            is_proved = improved & (ratios < self.max_ratio * (1 - _BOUND_MARGIN))
            tokens[is_proved] = FIRST_LOCK_TOKEN + locks[is_proved]
        return tokens, gain

    def _bound_moment_ratio(
        self, locked_joints: IndexArray, expansion: Screws, gram: FloatArray, half: FloatArray, damping: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return an upper bound of sqrt(A) / |a_k| (N,), and its cost by each joint's half width (N, n)."""
        sign, nearer, screws, brackets = self.screws.sign, self.screws.nearer, expansion.axes, expansion.brackets
        moving_brackets = brackets.transpose(0, 2, 1, 3) * sign[:, :, None]  # (N, l, j, 6)
        rows = np.arange(len(locked_joints))
        own_screw = screws[rows, locked_joints]
        other_gram = gram - own_screw[:, :, None] * own_screw[:, None] + damping[:, None, None] * np.eye(6)
        y = np.linalg.solve(other_gram, own_screw[:, :, None])[:, :, 0]
        y = y / np.einsum("na,na->n", y, own_screw)[:, None]  # its moment about axis k is 1
        b = np.einsum("nljb,nb->nlj", moving_brackets, y)
        pull = np.einsum("nla,nlj->naj", screws, b) - own_screw[:, :, None] * b[rows, locked_joints][:, None]
        wrench_rate = -np.linalg.solve(other_gram, pull)  # (N, 6, j)
        wrench_rate -= y[:, :, None] * (np.einsum("na,naj->nj", own_screw, wrench_rate) + b[rows, locked_joints])[:, None]
        gradient = b + np.einsum("nla,naj->nlj", screws, wrench_rate)
        m, f, z, v = y[:, None, :3], y[:, None, 3:], screws[:, :, :3], screws[:, :, 3:]
        w = np.concatenate([np.cross(m, z) + np.cross(f, v), np.cross(f, z)], axis=2)
        second_brackets = np.einsum("nia,njla->nlij", w, brackets) * np.abs(sign[:, :, None] * sign[:, None])
        cross_terms = np.einsum("nai,nlja->nlij", wrench_rate, moving_brackets)
        pair_terms = second_brackets * nearer + cross_terms + cross_terms.transpose(0, 1, 3, 2)
        pair_terms = np.triu(np.abs(np.where(nearer > 0, pair_terms, pair_terms.transpose(0, 1, 3, 2))), 1)
        diagonal = np.abs(np.einsum("nljj->nlj", second_brackets) / 2 + np.einsum("nljj->nlj", cross_terms))
        pair_costs = pair_terms * half[:, None, :, None] * half[:, None, None]
        by_axis = np.abs(gradient) * half[:, None] + diagonal * half[:, None] ** 2
        by_axis = by_axis + (pair_costs.sum(axis=2) + pair_costs.sum(axis=3)) / 2
        z2, v2, z3, v3 = self.screws.bound_screw_remainders(expansion, half)
        moment, force = (np.linalg.norm(vector, axis=1)[:, None] for vector in (y[:, :3], y[:, 3:]))
        rates = (wrench_rate[:, :3], wrench_rate[:, 3:])
        rate_sums = [np.einsum("nj,nj->n", np.linalg.norm(rate, axis=1), half)[:, None] for rate in rates]
        third = moment * z3 + force * v3 + rate_sums[0] * z2 + rate_sums[1] * v2
        moment_bounds = np.abs(np.einsum("nla,na->nl", screws, y)) + by_axis.sum(axis=2) + third
        own_lower = 2 - moment_bounds[rows, locked_joints]  # its moment is 1
        moment_bounds[rows, locked_joints] = 0
        norms = np.sqrt((moment_bounds**2).sum(axis=1))
        joint_costs = np.einsum("nl,nlj->nj", moment_bounds, by_axis + third[:, :, None] * np.abs(sign) / 2)
        return np.where(own_lower > 0, norms / np.maximum(own_lower, 1e-9), np.inf), joint_costs
