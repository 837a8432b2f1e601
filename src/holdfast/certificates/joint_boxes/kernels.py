"""Lower bounds of relative manipulability: for each box of configurations, a motion of the joints that keeps the tool in place.

For any x with J x = 0, the relative manipulability after a lock of joint k is at least |x_k| / |x|. In each box x follows the
joints, x = nu + N (q - q_c) + P s, with nu and N from the middle such that J x is of second order, and with the pseudo-inverse
P at the middle. By Brouwer's theorem, J x = 0 for some small s. J consists of screws.
The numbers here have no error bounds; the verifier decides.
"""

from __future__ import annotations

import numpy as np

from holdfast.certificates.joint_boxes.halving import OPEN_TOKEN
from holdfast.certificates.joint_boxes.screws import ScrewModel, Screws
from holdfast.certificates.taylor import CertificateChain
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

_BOUND_MARGIN = 1e-9
_SECTION_ROUNDS = 12


class ManipulabilityFloorTest:
    """Test whether relative manipulability is at least a threshold after each of some locks, in boxes of configurations.

    Args:
        chain: Kinematic chain of the arm.
        screw_rows: Rows of axes, then of moments, that describe its whole motion.
        locks: Indices of the joints that may lock.
        threshold: Lower bound, above 0 and below 1.
    """

    def __init__(self, chain: CertificateChain, screw_rows: list[int], locks: tuple[int, ...], threshold: float) -> None:
        self.screws, self.screw_rows, self.locks, self.threshold = ScrewModel(chain), screw_rows, locks, threshold

    def __call__(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the tokens of boxes, 0 where the bound holds after all locks, and the gain of halving each joint."""
        count, n = half.shape
        screws = self.screws(middle)
        jacobian = screws.axes.transpose(0, 2, 1)[:, self.screw_rows]
        with np.errstate(all="ignore"):
            inverse = np.linalg.pinv(np.nan_to_num(jacobian))  # (N, n, m)
        null_projector = np.eye(n) - inverse @ jacobian
        margins, gain = np.full(count, np.inf), np.zeros(half.shape)
        redundancy = n - len(self.screw_rows)
        for first, locks in [(0, self.locks)] if redundancy == 1 else [(lock, (lock,)) for lock in self.locks]:
            nu = np.linalg.svd(np.nan_to_num(jacobian))[2][:, -1] if redundancy == 1 else null_projector[:, :, first]
            nu = nu / np.maximum(np.linalg.norm(nu, axis=1), 1e-12)[:, None]
            joint_travel, shift, response, residual_costs, is_closed = self._enclose_null_motion(
                nu, screws, jacobian, inverse, half
            )
            alignment = np.abs(np.einsum("nl,nlj->nj", nu, response))
            norm_bound = np.sqrt(1 + 2 * (alignment * half).sum(axis=1) + (joint_travel**2).sum(axis=1))
            norm_bound = norm_bound + np.linalg.norm(shift, axis=1)
            for lock in locks:
                margin = np.abs(nu[:, lock]) - joint_travel[:, lock] - shift[:, lock] - self.threshold * norm_bound
                lower = np.where(is_closed, margin, -1.0)
                joint_costs = np.abs(response[:, lock]) * half
                joint_costs += np.einsum("nb,njb->nj", np.abs(inverse[:, lock]), residual_costs)
                joint_costs += self.threshold * np.einsum("nlj,nl->nj", np.abs(response), joint_travel) * half
                worse = np.flatnonzero(lower < margins)
                margins[worse], gain[worse] = lower[worse], joint_costs[worse]
        gain = np.where(np.asarray(np.isfinite(gain).all(axis=1))[:, None], gain, half * self.screws.sign.any(axis=0))
        return np.where(margins > _BOUND_MARGIN, 0, OPEN_TOKEN), gain

    def _enclose_null_motion(
        self, nu: FloatArray, screws: Screws, jacobian: FloatArray, inverse: FloatArray, half: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, BoolArray]:
        """Return the changes of x with the joints and by P s, (N, n) each, its response (N, n, n), costs, and flags for s."""
        rows, side = self.screw_rows, self.screws.side
        moving_brackets = screws.brackets * np.abs(self.screws.sign).T[None, :, :, None]  # (N, j, l, 6), j moves l
        by_joint = np.einsum("njlb,nl->njb", moving_brackets, nu)
        gradient = (side[:, None] * by_joint)[:, :, rows]
        response = -np.einsum("nlb,njb->nlj", inverse, gradient)
        gradient = gradient + np.einsum("nbl,nlj->njb", jacobian, response)
        (z, v), (u, w) = (np.split(values, 2, axis=3) for values in (screws.axes[:, :, None], by_joint[:, None]))
        second_brackets = np.concatenate([np.cross(z, u), np.cross(z, w) + np.cross(v, u)], axis=3)  # (N, i, j, 6), i nearer
        second_brackets = second_brackets * (self.screws.nearer * (side[:, None] == side))[:, :, None]
        cross_terms = np.einsum("njlb,nli->njib", moving_brackets, response) * side[:, None, None]
        curvature = second_brackets + cross_terms + cross_terms.transpose(0, 2, 1, 3)
        curvature = np.where(self.screws.nearer[:, :, None] > 0, curvature, curvature.transpose(0, 2, 1, 3))
        pair_costs = np.abs(curvature[..., rows]) * (half[:, :, None] * half[:, None])[..., None]
        pair_costs = pair_costs * np.triu(np.ones((len(side), len(side))), 1)[:, :, None]
        own_curvature = np.einsum("njjb->njb", second_brackets) / 2 + np.einsum("njjb->njb", cross_terms)
        own_costs = np.abs(own_curvature[..., rows]) * half[:, :, None] ** 2
        joint_costs = np.abs(gradient) * half[:, :, None] + own_costs + (pair_costs.sum(axis=1) + pair_costs.sum(axis=2)) / 2
        z2, v2, z3, v3 = self.screws.bound_screw_remainders(screws, half)
        second, third = (np.stack([a] * 3 + [b] * 3, axis=2)[..., rows] for a, b in ((z2, v2), (z3, v3)))
        joint_travel = np.einsum("nlj,nj->nl", np.abs(response), half)
        residual = np.abs(np.einsum("nbl,nl->nb", jacobian, nu)) + joint_costs.sum(axis=1)
        residual = residual + np.einsum("nl,nlb->nb", np.abs(nu), third) + np.einsum("nl,nlb->nb", joint_travel, second)
        first_order = np.abs(np.einsum("njlb,nlc->njbc", moving_brackets, inverse)[:, :, rows])
        contraction = np.einsum("njbc,nj->nbc", first_order, half) + np.einsum("nlb,nlc->nbc", second, np.abs(inverse))
        s = residual
        for _ in range(_SECTION_ROUNDS):
            s = 1.02 * (residual + np.einsum("nbc,nc->nb", contraction, s)) + 1e-15
        is_closed = (residual + np.einsum("nbc,nc->nb", contraction, s) < s * (1 - 1e-9)).all(axis=1) & (s < 1e3).all(axis=1)
        return joint_travel, np.einsum("nlb,nb->nl", np.abs(inverse), s), response, joint_costs, is_closed
