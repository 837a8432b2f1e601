"""Measure how far the joints of many designs sweep on the self-motion through a configuration, all designs side by side."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm, factor_householder
from holdfast.kinematics.solvers.inverse_kinematics import task_error_and_jacobian
from holdfast.model.arm import kinematics
from holdfast.studies.designs.family import Family

_MAX_CURVE_LENGTH_RAD = 120.0  # rad: longer curves are cut
_NEWTON_ERROR_BOUND = 1e-3  # error after one Newton step with which the next one is enough
_MIN_TANGENT_COSINE = 0.9  # least cosine between the null vectors at the two ends of a step
_MAX_STEP_HALVINGS = 6  # of a step before the curve ends there
_CLOSING_STEP_FRACTION = 0.15  # of a step: how near the curve must come to its first point


@dataclass(frozen=True, kw_only=True)
class SelfMotionRanges:
    """Joint ranges of P self-motion curves.

    Attributes:
        ranges: (P, n) length of the interval of values of each joint, rad; 2 pi of one that winds, and at most that.
        is_closed: (P,) the curve came back to its first point.
        winding: (P, n) whole turns on the way round a closed curve.
    """

    ranges: FloatArray
    is_closed: NDArray[np.bool_]
    winding: NDArray[np.int64]


class SelfMotionTracer:
    """Compiled predictor and corrector of all designs of a family, with one degree of redundancy and revolute joints."""

    def __init__(self, family: Family) -> None:
        self.family = family

    @cached_property
    @cached_kernel
    def _pose_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.family.arm)
        chain = kinematics.kinematic_chain(self.family.arm, q)
        return Kernel("poses of designs", [q, self.family.x], [ca.vertcat(chain.position, ca.vec(chain.rotation.T))])

    @cached_property
    @cached_kernel
    def _step_kernel(self) -> Kernel:
        arm, q = self.family.arm, kinematics.joint_symbols(self.family.arm)
        position, rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        error, jacobian = task_error_and_jacobian(arm, self.family.task, q, position, rotation)
        scale = ca.sparsify(ca.SX(ca.DM(self.family.task.scale(self.family.space.arm.length_unit))))
        error, jacobian = scale @ error, scale @ jacobian
        null_vectors = factor_householder(jacobian).null_space_basis()
        outputs = ca.vertcat(
            q + damped_least_norm(jacobian, error, 1e-14), ca.norm_2(error), *[null_vectors[k][0] for k in range(arm.n)]
        )
        return Kernel("self-motion of designs", [q, position, rotation, self.family.x], [outputs])

    def __call__(self, values: FloatArray, q: FloatArray, spacing: float) -> SelfMotionRanges:
        """Trace the curves of designs (P, k) through configurations (P, n), rad, in steps of ``spacing``, rad."""
        pose_rows = self._pose_kernel.rows(q, values)
        position, rotation = np.ascontiguousarray(pose_rows[:, :3]), np.ascontiguousarray(pose_rows[:, 3:].reshape(-1, 3, 3))
        lower, upper = self.family.limits(values)
        least_q, greatest_q = q.copy(), q.copy()
        is_closed, winding = np.zeros(len(q), dtype=bool), np.zeros(q.shape, dtype=np.int64)
        for direction in (1.0, -1.0):
            active = np.flatnonzero(~is_closed & (q >= lower).all(axis=1) & (q <= upper).all(axis=1))
            current_q, step_sizes, travelled = q.copy(), np.full(len(q), spacing), np.zeros(len(q))
            tangents = self._step_kernel.rows(q, position, rotation, values)[:, q.shape[1] + 1 :] * direction
            first_tangents = tangents.copy()
            while active.size:
                targets = position[active], rotation[active], values[active]
                start_q, tangent, sizes = current_q[active], tangents[active], step_sizes[active]
                predicted = self._step_kernel.rows(start_q + sizes[:, None] * tangent, *targets)
                corrected = self._step_kernel.rows(predicted[:, : q.shape[1]], *targets)
                next_q, next_tangents = corrected[:, : q.shape[1]], corrected[:, q.shape[1] + 1 :]
                cosines = np.einsum("ij,ij->i", next_tangents, tangent)
                distances = np.linalg.norm(next_q - start_q, axis=1)
                accepted = (
                    (corrected[:, q.shape[1]] <= _NEWTON_ERROR_BOUND)
                    & (abs(cosines) >= _MIN_TANGENT_COSINE)
                    & (distances <= 1.5 * sizes)
                )
                inside = accepted & ((next_q >= lower[active]) & (next_q <= upper[active])).all(axis=1)
                rows = active[inside]
                start_offsets, end_offsets = start_q[inside] - q[rows], next_q[inside] - q[rows]
                current_q[rows], tangents[rows] = next_q[inside], next_tangents[inside] * np.sign(cosines[inside])[:, None]
                travelled[rows] += distances[inside]
                returned = _passes_start(start_offsets, end_offsets, first_tangents[rows], distances[inside])
                winding[rows[returned]] = np.rint(end_offsets[returned] / (2 * np.pi)).astype(np.int64)
                is_closed[rows[returned]] = True
                np.minimum.at(least_q, rows[~returned], next_q[inside][~returned])
                np.maximum.at(greatest_q, rows[~returned], next_q[inside][~returned])
                step_sizes[rows] = np.minimum(2 * step_sizes[rows], spacing)
                step_sizes[active[~inside]] *= 0.5
                active = active[
                    ~is_closed[active]
                    & (step_sizes[active] >= spacing / 2**_MAX_STEP_HALVINGS)
                    & (travelled[active] <= _MAX_CURVE_LENGTH_RAD)
                ]
        spans = np.minimum(greatest_q - least_q, 2 * np.pi)
        return SelfMotionRanges(ranges=np.where(winding != 0, 2 * np.pi, spans), is_closed=is_closed, winding=winding)


def _passes_start(
    start_offset: FloatArray, end_offset: FloatArray, first_tangents: FloatArray, step_sizes: FloatArray
) -> NDArray[np.bool_]:
    """Return True where a step passes the first point (modulo full revolutions, seen from both ends) in the direction of
    departure.
    """
    revolutions = 2 * np.pi * np.rint(end_offset / (2 * np.pi))
    start_offset, end_offset = start_offset - revolutions, end_offset - revolutions
    crosses = (np.einsum("ij,ij->i", start_offset, first_tangents) < 0) & (
        np.einsum("ij,ij->i", end_offset, first_tangents) >= 0
    )
    step = end_offset - start_offset
    fraction = np.clip(-np.einsum("ij,ij->i", start_offset, step) / np.maximum(np.einsum("ij,ij->i", step, step), 1e-300), 0, 1)
    distance = np.linalg.norm(start_offset + fraction[:, None] * step, axis=1)
    return np.asarray(
        crosses & (distance <= _CLOSING_STEP_FRACTION * step_sizes) & (np.linalg.norm(start_offset, axis=1) <= 2 * step_sizes)
    )
