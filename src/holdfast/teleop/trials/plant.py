"""The arm as the stick moves it: one law, some joints locked, one control cycle at a time."""

from __future__ import annotations

from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.errors import InputError, TaskError
from holdfast.kernels.kernel import Kernel, Single
from holdfast.kernels.recall import recalled, recalled_data

Array = NDArray[np.float64]

SUBSTEPS = 10
_UNROLLED = 40_000  # operations in one call, about


class Plant:
    """An arm under a control law that knows of no failure, driven cycle by cycle.

    A commanded velocity is held for a cycle; the law is evaluated anew in each of the explicit Euler sub-steps of the cycle,
    and joints that are locked do not follow. Where the law has no answer, at a singular configuration, the arm is still.

    The same row gives the same bits whatever the batch, so that a recorded trial can be replayed exactly.

    Args:
        law: Its task must have linear rows in the base frame only; the law's own gain and speed limit play no part.
        substeps: In one cycle.

    Attributes:
        law: The law.
        substeps: In one cycle.
        n: Number of joints.
        m: Number of task rows: of the stick's axes.

    Raises:
        TaskError: A task with angular rows, or in the tool's frame.
        InputError: Fewer than one sub-step.

    Source: Goel et al. 2003, eq. (2) to (5) and section 4; the sub-steps are ours.
    """

    def __init__(self, law: Law, substeps: int = SUBSTEPS) -> None:
        check_rows(law.task)
        if substeps < 1:
            raise InputError(f"substeps is {substeps}; it must be 1 or more")
        self.law, self.substeps = law, substeps
        self.n, self.m = law.arm.n, law.task.m
        self._calls = _calls(law, substeps)
        self._kernel = _part_of_a_cycle(law, substeps, substeps // self._calls)
        self._buffer = np.zeros(2 * self.n + self.m)

    @cached_property
    def _single(self) -> Single:
        return self._kernel.single()

    def cycle(self, q: Array, velocity: Array, healthy: Array) -> tuple[Array, Array]:
        """One cycle of one arm, without checks: for a control loop, and not for several threads at once.

        The first call compiles, which takes up to a second the first time and milliseconds later.

        Args:
            q: (n,) configuration, rad and m.
            velocity: (m,) command, m/cycle.
            healthy: (n,) 1, or 0 for a locked joint.

        Returns:
            (n,) configuration at the end of the cycle, and (m,) the tool point's velocity at its beginning, m/cycle.
        """
        n, row = self.n, self._buffer
        row[:n], row[n : n + self.m], row[n + self.m :] = q, velocity, healthy
        out = self._single(row)
        actual = out[n:].copy()
        for _ in range(1, self._calls):
            row[:n] = out[:n]
            out = self._single(row)
        return out[:n].copy(), actual

    def cycles(self, q: Array, velocity: Array, healthy: Array) -> tuple[Array, Array]:
        """One cycle of N arms: as :meth:`cycle`, with (N, n), (N, m) and (N, n), to (N, n) and (N, m)."""
        n = self.n
        out = self._kernel.rows(q, velocity, healthy)
        actual = np.ascontiguousarray(out[:, n:])
        for _ in range(1, self._calls):
            out = self._kernel.rows(out[:, :n], velocity, healthy)
        return np.ascontiguousarray(out[:, :n]), actual

    def position(self, q: Array) -> Array:
        """(N, m) the task's rows of the tool point, m, of configurations (N, n)."""
        points = self.law.arm.forward_kinematics(np.atleast_2d(q))[:, :3, 3]
        return np.asarray(points @ self.law.task.rows[:, :3].T)


def check_rows(task: Task) -> None:
    """Refuse a task of which a stick cannot command the rows.

    Raises:
        TaskError: Angular rows, or rows in the tool's frame.
    """
    if task.angular or task.frame != "base":
        raise TaskError(
            f"a stick commands the tool point's velocity in the base frame; task '{task.name}' has other rows, "
            "use planar or position"
        )


@lru_cache(maxsize=16)
def substep(law: Law, substeps: int = SUBSTEPS) -> ca.Function:
    """One explicit Euler step of a control cycle, as symbols: what :class:`Plant` compiles and what the page runs.

    Takes q (n,), the velocity (m,), m/cycle, and healthy (n,), 1 or 0; gives the next q and the tool point's velocity (m,) now.
    """
    arm, n = law.arm, law.arm.n
    q, v, healthy = kinematics.joint_symbols(arm), ca.SX.sym("v", law.task.m), ca.SX.sym("healthy", n)
    rates = healthy * law.rates(q, v)
    moved = q + rates / substeps
    # A singular configuration makes the rates NaN, and the comparison false: the arm is still.
    moving = ca.sumsqr(moved) < 1e30
    actual = ca.DM(law.task.rows) @ kinematics.jacobian(arm, q) @ rates
    return ca.Function(
        "substep",
        [q, v, healthy],
        [ca.if_else(moving, moved, q), ca.if_else(moving, actual, ca.SX(law.task.m, 1))],
        {"cse": True},
    )


@recalled_data
def _calls(law: Law, substeps: int) -> int:
    """How often the kernel is called in a cycle: its sub-steps are written one after the other, up to a size."""
    most = max(1, _UNROLLED // int(substep(law, substeps).n_instructions()))
    return substeps // max(k for k in range(1, substeps + 1) if substeps % k == 0 and k <= most)


@lru_cache(maxsize=16)
@recalled
def _part_of_a_cycle(law: Law, substeps: int, times: int) -> Kernel:
    """So many sub-steps of a cycle."""
    once = substep(law, substeps)
    q, v, healthy = once.sx_in()
    after, first = once(q, v, healthy)
    for _ in range(1, times):
        after, _ = once(after, v, healthy)
    return Kernel(f"control cycle, {law.name}", [q, v, healthy], [after, first])
