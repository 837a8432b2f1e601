"""Control laws: what a controller that knows of no failure commands its joints, given where the hand should go.

Every law is one straight-line program of the task Jacobian and a task velocity, so that the same law runs in the batch
kernel, in C on a robot's controller and in the browser. The velocity itself is ``Ke`` times the error, slowed down as a
whole where its linear part would pass the speed limit.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (5), (6); Goel, Maciejewski, Balakrishnan 2005, eq. (5), (6), (10).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import InputError, TaskError
from holdfast.kernels import SX, Kernel

Array = NDArray[np.float64]


class Law(ABC):
    """A law ``rates = G(q) v`` for a task velocity v, with ``v = Ke error`` for a target.

    Args:
        arm: The arm.
        task: Rows of the hand's velocity that are prescribed.
        gain: ``Ke``, 1/s, or 1/cycle where time counts in cycles.
        speed_limit: Largest norm of the linear part of v, m/s or m/cycle; v is slowed as a whole. None: no limit.

    Attributes:
        name: For people.
        slug: On the command line and in files.
        source: Paper and equation.

    Raises:
        TaskError: The task has more rows than the arm has joints.
        InputError: A gain or speed limit that is not above 0.
    """

    name = ""
    slug = ""
    source = ""

    def __init__(
        self, arm: Arm, task: str | Task | Sequence[str] = "pose", gain: float = 1.0, speed_limit: float | None = None
    ) -> None:
        self.arm, self.task = arm, as_task(arm, task)
        if self.task.m > arm.n:
            raise TaskError(
                f"task '{self.task.name}' prescribes {self.task.m} rows, but '{arm.name}' has {arm.n} joints; prescribe fewer"
            )
        for what, value in (("gain", gain), ("speed_limit", speed_limit)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"{what} is {value:g}; it must be above 0")
        self.gain, self.speed_limit = float(gain), speed_limit

    # ---- symbols -----------------------------------------------------------------------------------------------

    @abstractmethod
    def inverse(self, j: SX, v: SX) -> SX:
        """Joint rates (n,) for a task velocity v (m,) and the task Jacobian J (m, n), both with scaled linear rows."""

    def jacobian(self, q: SX) -> SX:
        """The task Jacobian (m, n) that the law sees: linear rows divided by the task's characteristic length."""
        return self.task.jacobian(self.arm, q)

    def scaled(self, v: SX) -> SX:
        """A task velocity (m,) in m/s and rad/s, its linear rows divided by the task's characteristic length."""
        return ca.SX(ca.DM(_scale(self.task))) @ v

    def command(self, error: SX) -> SX:
        """Task velocity (m,) for an error of the task's rows (m,), m and rad: eq. (6), within the speed limit.

        A smaller gain far away only takes more time; it does not change the path.
        """
        if self.speed_limit is None:
            return self.gain * error
        linear = ca.SX(ca.DM(_linear(self.task))) @ error
        speed = self.gain * ca.sqrt(ca.sumsqr(linear))
        slower = ca.if_else(speed > self.speed_limit, self.speed_limit / ca.if_else(speed > 0, speed, 1.0), 1.0)
        return slower * self.gain * error

    def rates(self, q: SX, v: SX) -> SX:
        """Joint rates (n,) of q (n,) and a task velocity v (m,), m/s and rad/s."""
        return self.inverse(self.jacobian(q), self.scaled(v))

    # ---- numbers -----------------------------------------------------------------------------------------------

    @cached_property
    def _velocity_kernel(self) -> Kernel:
        q, v = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m)
        return Kernel(self.name, [q, v], [self.rates(q, v)])

    def velocity(self, q: ArrayLike, v: ArrayLike) -> Array:
        """Commanded joint rates.

        Args:
            q: (n,) or (N, n), rad and m.
            v: (m,) or (N, m) velocity of the task's rows, m/s and rad/s.

        Returns:
            (n,) or (N, n), rad/s and m/s; NaN in a row where q or v is, or where the law has no answer.

        Raises:
            InputError: A wrong shape.
        """
        rows, velocities, single = self._rows(q, v)
        out = self._velocity_kernel.rows(rows, velocities)
        return out[0] if single else out

    def _rows(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array, bool]:
        a, b = self.arm.check_configurations(q), np.asarray(v, dtype=np.float64)
        m = self.task.m
        if b.ndim not in (1, 2) or b.shape[-1] != m or (a.ndim == 2 and b.ndim == 2 and len(a) != len(b)):
            raise InputError(
                f"the velocity has shape {b.shape}; task '{self.task.name}' has {m} rows, so it must be ({m},), or (N, {m}), "
                "a row for each configuration"
            )
        count = max(len(np.atleast_2d(a)), len(np.atleast_2d(b)))
        return np.broadcast_to(a, (count, self.arm.n)), np.broadcast_to(b, (count, m)), a.ndim == b.ndim == 1

    def describe(self) -> str:
        """One phrase for people."""
        limit = "" if self.speed_limit is None else f", at most {self.speed_limit:g} m/s"
        return f"{self.name}, task {self.task.describe()}, gain {self.gain:g}/s{limit}"

    def __repr__(self) -> str:
        return f"<{self.describe()}, arm {self.arm.name!r}>"


def _scale(task: Task) -> Array:
    """(m, m): what dividing the linear rows of a twist by the characteristic length does to the task's rows."""
    return np.asarray(task.rows @ np.diag([1 / task.length] * 3 + [1.0] * 3) @ task.rows.T)


def _linear(task: Task) -> Array:
    """(3, m): the linear velocity that a task velocity stands for."""
    return np.asarray(task.rows[:, :3].T)
