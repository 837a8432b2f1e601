"""Tasks, which select components of the end effector's twist, and their targets: poses or coordinates of the tool point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.labels import TASK_ROW_NAMES, TASK_SIZES
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.machine import ArmData
from holdfast.model.arm.poses import check_poses


@check_constructor
@dataclass(frozen=True, eq=False)
class Task(Presentable):
    """Rows of the end effector's twist (linear; angular) that the task prescribes.

    Attributes:
        name: ``pose`` (6 rows), ``pointing`` (5: position, and direction of the tool's z axis; rotation about it is free, as
            for a drill, a torch or a camera), ``position`` (3), ``planar`` (2: position in the arm's plane), ``planar-pose``
            (3: with its angle), or a custom name.
        rows: (m, 6) orthonormal rows; the task velocity is ``rows @ twist``.
        frame: Frame of the twist: ``base`` (the world axes) or ``tool``.
        length: Characteristic length, m. Linear rows are divided by it, so that indices which mix metres and radians have a
            meaning; it is printed with every result. Default: 1 m.
        angular: True if a row has angular components; set by the class.
    """

    name: str
    rows: FloatArray
    frame: Literal["base", "tool"] = "base"
    _: KW_ONLY
    length: float = 1.0
    angular: bool = field(init=False)

    def __post_init__(self) -> None:
        rows = np.array(self.rows, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != 6 or not 1 <= rows.shape[0] <= 6 or not np.isfinite(rows).all():
            raise TaskError(f"task '{self.name}': rows must be an array (m, 6) with m from 1 to 6, got shape {rows.shape}")
        if abs(rows).max() > 2 or not np.allclose(rows @ rows.T, np.eye(len(rows)), atol=1e-9):
            raise TaskError(f"task '{self.name}': its rows must be orthonormal, each a direction of (vx, vy, vz, wx, wy, wz)")
        if not (np.isfinite(self.length) and self.length > 0):
            raise TaskError(f"task '{self.name}': the characteristic length is {self.length:g} m; it must be above 0")
        if self.frame not in ("base", "tool"):
            raise TaskError(f"task '{self.name}': frame '{self.frame}' is not known; use 'base' or 'tool'")
        rows.setflags(write=False)
        object.__setattr__(self, "rows", rows)
        object.__setattr__(self, "angular", bool(np.abs(rows[:, 3:]).max() > 0))

    def to_dict(self) -> dict[str, Any]:
        """Return the task as JSON data."""
        return {"name": self.name, "rows": self.rows.tolist(), "frame": self.frame, "length": self.length}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Task:
        """Return the task from ``data``, the JSON data of :meth:`to_dict`; raise KeyError or TypeError if it is incomplete."""
        return cls(data["name"], np.array(data["rows"]), data["frame"], length=data["length"])

    @property
    def m(self) -> int:
        """Number of rows."""
        return len(self.rows)

    @property
    def invariant(self) -> bool:
        """True if the task has all six rows, so that any frame and reference point give the same subspace."""
        return self.m == 6

    def world_rows(self, tool_rotation: FloatArray) -> FloatArray:
        """Return the rows (m, 6) of a twist in the world for the rotation (3, 3) of the tool."""
        return np.asarray(self.rows @ np.kron(np.eye(2), tool_rotation.T)) if self.frame == "tool" else self.rows

    def error(self, twist: SX, tool_rotation: SX) -> SX:
        """Return the task rows (m,) of a world-frame error or ``twist`` (6,), m and rad, for ``tool_rotation`` (3, 3)."""
        if self.frame == "tool":
            twist = ca.vertcat(tool_rotation.T @ twist[:3], tool_rotation.T @ twist[3:])
        return ca.sparsify(ca.SX(ca.DM(self.rows))) @ twist

    def scale(self, length: float) -> FloatArray:
        """Return the matrix (m, m) that divides the linear rows of a twist by ``length``, m, in terms of the task's rows."""
        return np.asarray(self.rows @ np.diag([1 / length] * 3 + [1.0] * 3) @ self.rows.T)

    def jacobian(self, arm: ArmData, q: SX) -> SX:
        """Return the task Jacobian (m, n) of ``arm`` for symbols ``q`` (n,), linear rows divided by ``length``."""
        full_jacobian = kinematics.tool_jacobian(arm, q) if self.frame == "tool" else kinematics.world_jacobian(arm, q)
        return self.select(full_jacobian)

    def select(self, full_jacobian: SX) -> SX:
        """Return the task rows of ``full_jacobian`` (6, n) in the task's frame, linear rows divided by the length."""
        scale = np.diag([1 / self.length] * 3 + [1.0] * 3)
        return ca.sparsify(ca.SX(ca.DM(self.rows @ scale))) @ full_jacobian

    def same_rows(self, other: Task) -> bool:
        """Return True if the task ``other`` prescribes the same rows in the same frame; names and lengths may differ."""
        return self.frame == other.frame and self.rows.shape == other.rows.shape and np.allclose(self.rows, other.rows)

    def describe(self) -> str:
        """Return a phrase with the name, the number of rows and, if it matters, the characteristic length."""
        text = f"{self.name} ({self.m} rows)"
        has_length = self.angular and float(np.abs(self.rows[:, :3]).max()) > 0
        return text + (f", characteristic length {self.length:g} m" if has_length else "")

    def __repr__(self) -> str:
        return f"Task({self.name!r}, m={self.m}, frame={self.frame!r}, length={self.length:g})"


TaskSpec = str | Task | Sequence[str]


def task_from_rows(
    rows: Sequence[str], frame: Literal["base", "tool"] = "base", length: float = 1.0, name: str | None = None
) -> Task:
    """Return a task with selected rows, for example ``task_from_rows(["vx", "vy", "wz"], frame="tool")``.

    Raises:
        TaskError: A row is not one of vx, vy, vz, wx, wy, wz, or appears twice.
    """
    unknown = [row_name for row_name in rows if row_name not in TASK_ROW_NAMES]
    if unknown:
        raise TaskError(f"task row '{unknown[0]}' is not known; rows are {', '.join(TASK_ROW_NAMES)}")
    if len(set(rows)) != len(rows) or not rows:
        raise TaskError("a task needs at least one row, and each row once")
    selection = np.zeros((len(rows), 6))
    for row, row_name in enumerate(rows):
        selection[row, TASK_ROW_NAMES.index(row_name)] = 1.0
    return Task(name or "+".join(rows), selection, frame, length=length)


def plane_normal(arm: ArmData) -> FloatArray | None:
    """Return the unit normal (3,), world frame, of the plane in which the arm moves; None for a spatial arm.

    All revolute axes must be parallel to the normal and all prismatic axes perpendicular to it.
    """
    # Earlier joints rotate about the normal, which keeps parallel axes parallel, so q = 0 decides for every q.
    revolute_axes, prismatic_axes = arm.axes_at_zero[~arm.prismatic], arm.axes_at_zero[arm.prismatic]
    if not len(revolute_axes):
        return None
    normal = revolute_axes[0]
    if any(np.linalg.norm(np.cross(normal, axis)) > 1e-9 for axis in revolute_axes) or any(
        abs(normal @ prismatic_axis) > 1e-9 for prismatic_axis in prismatic_axes
    ):
        return None
    return np.asarray(normal * (1.0 if normal[np.argmax(np.abs(normal))] > 0 else -1.0))


def default_path_task(arm: ArmData, oriented: bool) -> str:
    """Return the default task name of a path: for a planar arm the rows in its plane, else all rows."""
    is_planar = plane_normal(arm) is not None
    if oriented:
        return "planar-pose" if is_planar else "pose"
    return "planar" if is_planar else "position"


def as_task(arm: ArmData, task: str | Task | Sequence[str], length: float | None = None) -> Task:
    """Return the ``task`` of ``arm`` from its name, a list of row names, or a Task; ``length`` replaces the length, m.

    Raises:
        TaskError: The name is unknown, or the task is planar but the arm does not move in a plane.
    """
    if isinstance(task, Task):
        return task if length is None else Task(task.name, task.rows, task.frame, length=length)
    unit_length = 1.0 if length is None else length
    if not isinstance(task, str):
        return task_from_rows(list(task), length=unit_length)
    identity = np.eye(6)
    if task == "pose":
        return Task(task, identity, "base", length=unit_length)
    if task == "position":
        return Task(task, identity[:3], "base", length=unit_length)
    if task == "pointing":
        return Task(task, identity[:5], "tool", length=unit_length)
    if task in ("planar", "planar-pose"):
        normal = plane_normal(arm)
        if normal is None:
            raise TaskError(
                f"'{arm.name}' does not move in a plane, so it has no task '{task}'; use pose, pointing or position"
            )
        helper = np.eye(3)[int(np.argmin(np.abs(normal)))]
        tangent = helper - normal * (normal @ helper)
        tangent /= np.linalg.norm(tangent)
        rows: list[Any] = [np.r_[tangent, 0, 0, 0], np.r_[np.cross(normal, tangent), 0, 0, 0]]
        if task == "planar-pose":
            rows.append(np.r_[0, 0, 0, normal])
        return Task(task, np.array(rows), "base", length=unit_length)
    raise TaskError(f"task '{task}' is not known; use one of {', '.join(TASK_SIZES)} or a list of rows such as vx, vy, wz")


# ---- targets -----------------------------------------------------------------------------------------------------


def target_poses(task: Task, target: ArrayLike) -> tuple[FloatArray, FloatArray | None]:
    """Return targets as poses (M, 4, 4), and as task rows (M, m) if they were given as rows.

    Args:
        task: Task to be met.
        target: (m,) or (M, m) rows, m, for tasks without angular rows; for any task (4, 4) or (M, 4, 4) poses in the world.

    Raises:
        InputError: The shape is wrong, a pose is invalid, or rows are given for a task with angular rows.
    """
    array = np.asarray(target, dtype=np.float64)
    if array.ndim in (2, 3) and array.shape[-2:] == (4, 4):
        return check_poses(array), None
    if task.angular or task.frame != "base":
        raise InputError(f"the target has shape {array.shape}; task '{task.name}' needs tool poses, (4, 4) or (N, 4, 4) arrays")
    if array.ndim not in (1, 2) or array.shape[-1] != task.m:
        raise InputError(
            f"the target has shape {array.shape}; task '{task.name}' takes ({task.m},) or (N, {task.m}), the wanted tool "
            "point in m, or tool poses (4, 4)"
        )
    rows = np.atleast_2d(array)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, 3] = rows @ task.rows[:, :3]
    return poses, rows


def target_pose(task: Task, target: ArrayLike) -> FloatArray:
    """Return one target, (m,) or (4, 4), as a pose (4, 4); see :func:`target_poses`.

    Raises:
        InputError: There are several targets, a number is not finite, or :func:`target_poses` raises an error.
    """
    poses, rows = target_poses(task, target)
    if np.ndim(target) != (2 if rows is None else 1):
        raise InputError(f"the target has shape {np.shape(target)}; give one target, ({task.m},) or (4, 4)")
    if not np.isfinite(poses).all():
        raise InputError("the target holds NaN or infinity; give finite numbers")
    return np.asarray(poses[0])
