"""Largest speed of the end effector in one direction after a failure."""

from __future__ import annotations

from typing import Annotated, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.registry import Parameter, constructor
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.kernels.linalg import Vector, dot_product
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.formula import FormulaIndex
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, TaskSpec, as_task
from holdfast.model.failure_modes import FailureSpec

_DEPENDENT_SINE_SQUARED = 1e-24  # square of the sine of an angle that is rounding noise


@check_constructor
class DirectionalVelocity(FormulaIndex):
    r"""Largest speed along u for joint rates of norm 1, :math:`1/\sqrt{u^\top({}^SJ{}^SJ^\top)^{-1}u}`.

    All other rows of the task are at rest, and components that the task leaves free may move. The characteristic length does
    not matter. The value is the distance of the row of J along u from the span of the other rows, and therefore 0 if the failed
    arm cannot move along u alone.

    Args:
        arm: Arm model.
        direction: (3,) vector in the axes of the task's frame, of any length.
        task, failures, length: Task, failure sets, and characteristic length, m, as for :class:`Index`.

    Raises:
        InputError: The direction does not consist of three finite numbers, or is 0.
        TaskError: The task does not prescribe the direction.

    Source: Chiu 1988, the velocity transmission ratio, applied to the reduced Jacobian.
    """

    slug, unit, source = "directional-velocity", "m/rad", "Chiu 1988"

    def __init__(
        self,
        arm: Arm,
        direction: ArrayLike,
        task: TaskSpec = "pose",
        *,
        failures: FailureSpec = "single",
        length: float | None = None,
    ) -> None:
        u = require_real_numbers(direction, "the direction", "three numbers")
        if u.shape != (3,) or not np.isfinite(u).all() or not u.any():
            raise InputError(
                f"the direction is {np.array2string(u, separator=', ')}; it must be three finite numbers, not all 0"
            )
        numbers_text = ", ".join(f"{x:g}" for x in u)
        super().__init__(f"directional velocity along {numbers_text}", arm, task, failures=failures, length=length)
        self.direction = u
        if not _is_prescribed(self.task, u):
            raise TaskError(
                f"task '{self.task.name}' does not prescribe the direction {numbers_text}; give one in which its "
                "rows point, or a task with more rows"
            )
        self._along = self.task.scale(self.task.length) @ self.task.rows[:, :3] @ (u / np.linalg.norm(u))

    @property
    def settings(self) -> dict[str, Any]:
        """Settings with the direction; see :attr:`Index.settings`."""
        return {"direction": self.direction}

    def formula(self, j: SX) -> SX:
        """Return the speed for a reduced Jacobian ``j``; see :meth:`FormulaIndex.formula`."""
        size = float(np.linalg.norm(self._along))
        first = self._along / size
        k = int(np.abs(first).argmax())
        mirror = first + np.copysign(1.0, first[k]) * np.eye(len(first))[k]
        others = np.delete(np.eye(len(first)) - 2 * np.outer(mirror, mirror) / (mirror @ mirror), k, axis=0)
        basis: list[Vector] = []
        for row in (ca.DM(others) @ j, ca.DM(first[None]) @ j):
            for i in range(row.shape[0]):
                component, square = _orthogonal_part(ca.vertsplit(ca.densify(row[i, :].T)), basis)
                length = ca.sqrt(ca.if_else(square > 0, square, 1.0))
                basis.append([ca.if_else(square > 0, x / length, 0.0) for x in component])
        return ca.if_else(square > 0, length, 0.0) / size


def _orthogonal_part(row: Vector, basis: list[Vector]) -> tuple[Vector, SX]:
    """Return a row without its parts along orthonormal vectors, and its square; 0 if the rest is rounding noise."""
    squared_length = dot_product(row, row)
    for unit in [*basis, *basis]:  # twice is enough: Giraud et al. 2005
        part = dot_product(row, unit)
        row = [x - part * e for x, e in zip(row, unit, strict=True)]
    square = dot_product(row, row)
    return row, ca.if_else(square > _DEPENDENT_SINE_SQUARED * squared_length, square, 0.0)


def _is_prescribed(task: Task, direction: FloatArray) -> bool:
    """Return whether the rows of a task determine a velocity along a direction without rotation."""
    twist = np.concatenate([direction, np.zeros(3)])
    return bool(np.linalg.norm(np.linalg.pinv(task.rows) @ task.rows @ twist - twist) < 1e-9 * np.linalg.norm(direction))


def _prescribed(arm: Arm, task: TaskSpec) -> FloatArray:
    """Return a direction that a task prescribes: an axis if one is prescribed."""
    task_object = as_task(arm, task)
    # The combination of rows with the least rotation.
    translations = task_object.rows.T @ np.linalg.svd(task_object.rows[:, 3:].T)[2][-1]
    candidates: list[FloatArray] = [*np.eye(3), *task_object.rows[:, :3], translations[:3]]
    return next((u for u in candidates if u.any() and _is_prescribed(task_object, u)), candidates[0])


@constructor(formula="1 / √( uᵀ (<sup>S</sup>J <sup>S</sup>Jᵀ)<sup>−1</sup> u ) for the unit vector u of a direction")
def directional_velocity(
    arm: Arm,
    direction: Annotated[ArrayLike, Parameter("1", "x,y,z in the axes of the task's frame", example="_prescribed")],
    task: TaskSpec = "pose",
    *,
    failures: FailureSpec = "single",
    length: float | None = None,
) -> DirectionalVelocity:
    """Worst-case largest speed along a direction for joint rates of norm 1, the other rows of the task at rest; Chiu 1988.

    ``direction`` is (3,) in the task's frame; ``arm``, ``task``, ``failures`` and ``length`` (m) are as for
    :class:`holdfast.kinematics.indices.Index`.
    """
    return DirectionalVelocity(arm, direction, task, failures=failures, length=length)
