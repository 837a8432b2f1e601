"""Arm moved by the joystick: one law, some joints locked, one control cycle at a time."""

from __future__ import annotations

from functools import lru_cache

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, TaskError
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_json, cached_kernel
from holdfast.kernels.kernel import Kernel, SingleRowKernel
from holdfast.model.arm import kinematics
from holdfast.model.arm.task import Task

SUBSTEPS_PER_CYCLE = 10
_MAX_UNROLLED_OPERATIONS = 40_000  # operations in one call, about


class JoystickPlant:
    """Arm under a failure-unaware control law, driven cycle by cycle.

    A commanded velocity is held for a cycle. The law is evaluated in each of the explicit Euler sub-steps of the cycle, and
    locked joints do not follow. Where the law has no solution, at a singular configuration, the arm is still.

    The same row gives the same bits in every batch, so that a recorded trial can be replayed exactly.

    Args:
        law: Control law, whose task must have only linear rows in the base frame; its gain and speed limit are not used.
        substeps: Number of sub-steps in a cycle.

    Attributes:
        law: Control law.
        substeps: Number of sub-steps in a cycle.
        n: Number of joints.
        m: Number of task rows, which are the axes of the joystick.

    Raises:
        TaskError: The task has angular rows, or rows in the tool's frame.
        InputError: There is no sub-step.

    Source: Goel et al. 2003, eq. (2) to (5) and section 4; the sub-steps are ours.
    """

    def __init__(self, law: Law, substeps: int = SUBSTEPS_PER_CYCLE) -> None:
        check_joystick_task(law.task)
        if substeps < 1:
            raise InputError(f"substeps is {substeps}; it must be 1 or more")
        self.law, self.substeps = law, substeps
        self.n, self.m = law.arm.n, law.task.m
        self._calls_per_cycle = _count_kernel_calls(law, substeps)
        self._kernel = _build_cycle_kernel(law, substeps, substeps // self._calls_per_cycle)
        self._buffer = np.zeros(2 * self.n + self.m)

    @cached_property
    def _single_kernel(self) -> SingleRowKernel:
        return self._kernel.single_row()

    def step_one(self, q: FloatArray, velocity: FloatArray, healthy: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute one cycle of one arm, without checks, for a control loop; it must not be called by several threads at once.

        The first call compiles, which takes up to a second the first time and milliseconds later.

        Args:
            q: (n,) configuration, rad and m.
            velocity: (m,) command, m/cycle.
            healthy: (n,) mask: 1, or 0 for a locked joint.

        Returns:
            (n,) configuration at the end of the cycle, rad and m, and (m,) tool point velocity at its beginning, m/cycle.
        """
        n, arguments = self.n, self._buffer
        arguments[:n], arguments[n : n + self.m], arguments[n + self.m :] = q, velocity, healthy
        result = self._single_kernel(arguments)
        actual = result[n:].copy()
        for _ in range(1, self._calls_per_cycle):
            arguments[:n] = result[:n]
            result = self._single_kernel(arguments)
        return result[:n].copy(), actual

    def step_batch(self, q: FloatArray, velocity: FloatArray, healthy: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute one cycle of N arms.

        Args:
            q: (N, n) configurations, rad and m.
            velocity: (N, m) commands, m/cycle.
            healthy: (N, n) mask: 1, or 0 for a locked joint.

        Returns:
            Configurations (N, n) and velocities (N, m), as :meth:`step_one`.
        """
        n = self.n
        result = self._kernel.rows(q, velocity, healthy)
        actual = np.ascontiguousarray(result[:, n:])
        for _ in range(1, self._calls_per_cycle):
            result = self._kernel.rows(result[:, :n], velocity, healthy)
        return np.ascontiguousarray(result[:, :n]), actual

    def position(self, q: FloatArray) -> FloatArray:
        """Return the task components (N, m) of the tool point, m, at configurations ``q`` (N, n), rad and m."""
        points = self.law.arm.forward_kinematics(np.atleast_2d(q))[:, :3, 3]
        return np.asarray(points @ self.law.task.rows[:, :3].T)


def check_joystick_task(task: Task) -> None:
    """Check that a joystick can command the components of a task.

    Raises:
        TaskError: The task has angular rows, or rows in the tool's frame.
    """
    if task.angular or task.frame != "base":
        raise TaskError(
            f"a joystick commands the tool point's velocity in the base frame; task '{task.name}' has other rows, "
            "use planar or position"
        )


@lru_cache(maxsize=16)
def make_euler_substep(law: Law, substeps: int = SUBSTEPS_PER_CYCLE) -> ca.Function:
    """Return one explicit Euler step of a control cycle as a symbolic function, for :class:`JoystickPlant` and the page.

    The function takes q (n,), the velocity (m,), m/cycle, and the mask (n,), 1 or 0, and returns the next q and the present
    velocity (m,) of the tool point.
    """
    arm, n = law.arm, law.arm.n
    q, v, healthy = kinematics.joint_symbols(arm), ca.SX.sym("v", law.task.m), ca.SX.sym("healthy", n)
    rates = healthy * law.rates(q, v)
    q_next = q + rates / substeps
    # At a singular configuration the rates are NaN and the comparison is false, so that the arm is still.
    is_finite = ca.sumsqr(q_next) < 1e30
    actual = ca.DM(law.task.rows) @ kinematics.world_jacobian(arm, q) @ rates
    return ca.Function(
        "substep",
        [q, v, healthy],
        [ca.if_else(is_finite, q_next, q), ca.if_else(is_finite, actual, ca.SX(law.task.m, 1))],
        {"cse": True},
    )


@cached_json
def _count_kernel_calls(law: Law, substeps: int) -> int:
    """Return the number of kernel calls in a cycle; sub-steps are unrolled into one call up to a size."""
    max_substeps = max(1, _MAX_UNROLLED_OPERATIONS // int(make_euler_substep(law, substeps).n_instructions()))
    return substeps // max(count for count in range(1, substeps + 1) if substeps % count == 0 and count <= max_substeps)


@lru_cache(maxsize=16)
@cached_kernel
def _build_cycle_kernel(law: Law, substeps: int, times: int) -> Kernel:
    """Build the kernel of ``times`` sub-steps of a cycle."""
    step = make_euler_substep(law, substeps)
    q, v, healthy = step.sx_in()
    q_next, first_velocity = step(q, v, healthy)
    for _ in range(1, times):
        q_next, _ = step(q_next, v, healthy)
    return Kernel(f"control cycle, {law.name}", [q, v, healthy], [q_next, first_velocity])
