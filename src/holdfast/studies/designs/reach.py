"""Reach of designs, the largest distance of the tool point from the arm's base within the joint limits, with its gradient."""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import dot_product
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.studies.designs.family import Family

_START_COUNT = 16
_MAX_SWEEPS = 400
_CONVERGED_CHANGE = 1e-22  # squared change of the joints, rad or m, at which a row has converged


class ReachEvaluator:
    """Evaluator of the reach of all designs of a family, compiled once.

    As a function of one joint, the squared distance is a cosine (revolute) or a parabola (prismatic), so the best value of a
    joint with fixed other joints has a closed form, also within limits. Sweeps over the joints never decrease the distance.

    Args:
        family: Family of the designs.
        seed: Seed of the random starts.
    """

    def __init__(self, family: Family, seed: int = 0) -> None:
        self._family = family
        self._pool = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(5,))).random((_START_COUNT, family.arm.n))

    def __call__(self, values: FloatArray, limits: tuple[FloatArray, FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Return the reach (D,), m, and its gradient (D, k) by the designs.

        Args:
            values: (D, k) designs, rad and m.
            limits: Finite limits (D, n) of the starts, from :meth:`holdfast.studies.designs.Evaluator.finite_limits`.
        """
        design_count, n = len(values), self._family.arm.n
        lower, upper = limits
        q = (lower[:, None] + self._pool * (upper - lower)[:, None]).reshape(-1, n)
        designs = np.repeat(values, _START_COUNT, axis=0)
        q = self._joint_sweep_loop.run(q, designs, _CONVERGED_CHANGE, _MAX_SWEEPS).state
        outputs = self._distance_kernel.rows(q, designs)
        best = outputs[:, 0].reshape(design_count, _START_COUNT).argmax(axis=1) + np.arange(design_count) * _START_COUNT
        return outputs[best, 0], outputs[best, 1 : 1 + len(self._family.space.parameters)] + self._compute_limit_gradient(
            values, q[best], outputs[best, 1 + len(self._family.space.parameters) :]
        )

    def _compute_limit_gradient(self, values: FloatArray, q: FloatArray, gradient: FloatArray) -> FloatArray:
        """Return the contribution of varied limits: a joint that is pushed against its limit follows the limit."""
        lower, upper = self._family.limits(values)
        contribution = np.zeros_like(values)
        for index, parameter in enumerate(self._family.space.parameters):
            if parameter.row is not None and parameter.kind == "lower":
                contribution[:, index] = np.where(
                    (q[:, parameter.row] <= lower[:, parameter.row]) & (gradient[:, parameter.row] < 0),
                    gradient[:, parameter.row],
                    0.0,
                )
            elif parameter.row is not None and parameter.kind == "upper":
                contribution[:, index] = np.where(
                    (q[:, parameter.row] >= upper[:, parameter.row]) & (gradient[:, parameter.row] > 0),
                    gradient[:, parameter.row],
                    0.0,
                )
        return contribution

    @cached_property
    @cached_kernel
    def _distance_kernel(self) -> Kernel:
        """Kernel from (q, x) to the distance, its gradient by the design, and its gradient by the joints."""
        q = kinematics.joint_symbols(self._family.arm)
        distance = ca.norm_2(self._trace_from_base(q)[0])
        gradients = [ca.gradient(distance, self._family.x), ca.gradient(distance, q)]
        return Kernel("reach of designs", [q, self._family.x], [ca.vertcat(distance, *gradients)])

    def _trace_from_base(self, q: SX) -> tuple[SX, list[SX], list[SX]]:
        """Return the tool point, the axes, and the points on the axes relative to the base."""
        chain = kinematics.kinematic_chain(self._family.arm, q)
        base = kinematics.constant_matrix(self._family.arm.base[:3, 3])
        return chain.position - base, chain.axes, [x - base for x in chain.points]

    @cached_property
    @cached_kernel
    def _joint_sweep_loop(self) -> Loop:
        arm = self._family.arm
        start_q = kinematics.joint_symbols(arm)
        q = ca.vertsplit(start_q)
        for index, joint in enumerate(arm.joints):
            tool, axes, points = self._trace_from_base(ca.vertcat(*q))
            lower, upper = arm.lower[index], arm.upper[index]
            axis, point = axes[index], points[index]
            if joint.prismatic:
                # The parabola opens upwards, so the farther end is best; without limits there is no farthest point.
                end_steps = [(x - q[index]) for x in (lower, upper)]
                gains = [2 * change * ca.dot(axis, tool) + change * change for change in end_steps]
                q[index] = ca.if_else(gains[0] > gains[1], lower, upper)
                continue
            arm_from_axis = tool - point
            perpendicular = arm_from_axis - axis * ca.dot(axis, arm_from_axis)
            cosine_part, sine_part = (
                ca.dot(point, perpendicular),
                ca.dot(point, ca.cross(axis, perpendicular)),
            )  # |tool|^2 = const + 2 (c cos + s sin)(turn)
            is_defined = cosine_part * cosine_part + sine_part * sine_part > 1e-24
            rotation = ca.if_else(
                is_defined, ca.atan2(ca.if_else(is_defined, sine_part, 0.0), ca.if_else(is_defined, cosine_part, 1.0)), 0.0
            )
            q[index] = self._choose_angle(q[index], rotation, cosine_part, sine_part, lower, upper)
        change = [x - y for x, y in zip(q, ca.vertsplit(start_q), strict=True)]
        return Loop(
            "sweep of reach", start_q, [self._family.x], next_state=ca.vertcat(*q), residual=dot_product(change, change)
        )

    @staticmethod
    def _choose_angle(current: SX, rotation: SX, cosine_part: SX, sine_part: SX, lower: SX, upper: SX) -> SX:
        """Return the best angle of a joint within its limits, if ``rotation`` is the best rotation from here without limits."""
        if not kinematics.is_limit_given(lower) and not kinematics.is_limit_given(upper):
            return current + rotation

        def compute_gain(angle: SX) -> SX:
            return cosine_part * ca.cos(angle - current) + sine_part * ca.sin(angle - current)

        best, best_gain = current, compute_gain(current)
        full_turn = 2 * np.pi
        for angle in (lower, upper, current + rotation, current + rotation + full_turn, current + rotation - full_turn):
            if not kinematics.is_limit_given(angle):
                continue
            inside = ca.SX(1)
            if kinematics.is_limit_given(lower):
                inside = ca.logic_and(inside, angle >= lower)
            if kinematics.is_limit_given(upper):
                inside = ca.logic_and(inside, angle <= upper)
            better = ca.logic_and(inside, compute_gain(angle) > best_gain)
            best, best_gain = ca.if_else(better, angle, best), ca.if_else(better, compute_gain(angle), best_gain)
        return best
