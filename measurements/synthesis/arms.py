"""Make arms from a Jacobian or a null space, as Denavit-Hartenberg tables with rounded numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.output import open_replacement
from holdfast.core.formatting import capitalise_first
from holdfast.core.labels import TASK_SIZES
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.index_bounds.frames import orthogonal_complement
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound, upper_bound
from holdfast.kinematics.index_bounds.minors import measure_orthonormality_error, worst_relative_manipulability
from holdfast.model.arm.machine import Joint
from holdfast.model.arm.model import Arm
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.model.arms.dh_rows import DHTable, dh_table
from measurements.synthesis.axes import find_joint_axes, find_pose_jacobians

_ORTHONORMALITY_TOLERANCE = 1e-9
_TOTAL_LENGTH_M = 2.0  # m, sum of |a| and |d|
_SYNTHESIS_TASKS = ("planar", "position", "pose")


@dataclass(frozen=True, kw_only=True, eq=False)
class Synthesis:
    """Arms whose configuration of zeros has a given null space.

    Attributes:
        task: ``planar``, ``position`` or ``pose``.
        failures: Joints that lock at once.
        value: Worst case of the null space: relative manipulability of each arm at zero before its numbers were rounded.
        arms: The rounded arms, best condition number first.
        jacobians: Of each arm, (m, n), before its numbers were rounded; of a pose in its own unit of length.
        losses: What rounding took from the value of each arm.
        residual: Of the starts that came nearest, where lines were sought: 0 where they are given.
        bound: What no arm can beat.
    """

    task: str
    failures: int
    value: float
    arms: list[Arm]
    jacobians: list[FloatArray]
    losses: list[float]
    residual: float
    bound: float

    def describe(self) -> list[str]:
        """Return the number of arms, their value, and the loss by rounding."""
        n = self.arms[0].n
        return [
            f"{capitalise_first(self.task)}, {n} joints: {len(self.arms)} arms with {self.value:.6g} at the "
            f"configuration of zeros, "
            f"after the worst lock of {self.failures} at once (no arm can beat {self.bound:.6g}); rounding takes "
            f"at most {max(self.losses):.1e}"
        ]


@check_arguments
def synthesise(
    ceiling: UpperBound | None = None,
    *,
    jacobian: ArrayLike | None = None,
    null_space: ArrayLike | None = None,
    task: str = "pose",
    failures: int = 1,
    starts: int = 12,
    seed: int = 0,
    decimals: int = 5,
) -> Synthesis:
    """Make arms of revolute joints that have a null space, or a Jacobian, at the configuration of zeros.

    Args:
        ceiling: Takes its best null space and its failures; or give one of the next two.
        jacobian: (m, n) in the frame of the tool, m and rad.
        null_space: (n, n - m) orthonormal columns.
        task: ``planar``, ``position`` or ``pose``, with 2, 3 or 6 rows.
        failures: Joints that lock at once, where no ceiling says so.
        starts: Of the search for the lines of a pose; of a position for the free angles of the axes.
        seed: Of the starts.
        decimals: Of lengths, m, in the tables; angles have two fewer in degrees.

    Raises:
        InputError: Not exactly one of the three; a task of another number of rows; a null space that is not orthonormal to
            1e-9; a column of a pose that is not a line; no lines found after all starts.

    Source: derived here.
    """
    if sum(source is not None for source in (ceiling, jacobian, null_space)) != 1:
        raise InputError("give one of a ceiling, a Jacobian and a null space")
    if task not in _SYNTHESIS_TASKS:
        raise InputError(f"arms are made for {', '.join(_SYNTHESIS_TASKS)}, not for '{task}'")
    row_count, residual = TASK_SIZES[task], 0.0
    rng = np.random.default_rng(seed)
    if jacobian is not None:
        given_jacobian = np.atleast_2d(require_real_numbers(jacobian, "the Jacobian"))
        if len(given_jacobian) != row_count:
            raise InputError(f"the Jacobian has {len(given_jacobian)} rows; task '{task}' has {row_count}")
        basis, candidates = _compute_null_space(given_jacobian), [given_jacobian]
    else:
        basis, failures = _check_null_space(ceiling, null_space, row_count, task, failures)
        if task == "pose":
            candidates, residual = find_pose_jacobians(basis, starts=starts, seed=seed)
            if not candidates:
                raise InputError(
                    f"no revolute axes with this null space were found from {starts} starts; the least residual was "
                    f"{residual:.1e}, which proves nothing: give more starts"
                )
        else:
            candidates = [orthogonal_complement(basis).T]
    arms, jacobians, losses = list[Arm](), list[FloatArray](), list[float]()
    value = worst_relative_manipulability(basis, failures)
    for candidate in candidates:
        angle_sets = (
            [rng.uniform(-np.pi, np.pi, len(basis)) for _ in range(starts)]
            if task == "position" and jacobian is None
            else [None]
        )
        for angles in angle_sets:
            table = _make_table(*find_joint_axes(candidate, angles), 1.0 if jacobian is not None else None, task)
            arm = _round_table(table, decimals, jacobian is not None).arm(name=f"{task}-{len(basis)}R")
            arms.append(arm)
            jacobians.append(candidate)
            losses.append(
                value - worst_relative_manipulability(_compute_null_space(compute_task_jacobian(arm, task)), failures)
            )
    bound = (ceiling or upper_bound(n=len(basis), m=row_count, k=failures)).bound
    return Synthesis(
        task=task,
        failures=failures,
        value=value,
        arms=arms,
        jacobians=jacobians,
        losses=losses,
        residual=residual,
        bound=bound,
    )


def write_dh_table(arm: Arm, path: Path) -> Path:
    """Write an arm's Denavit-Hartenberg table as a YAML file, which all commands read.

    Raises:
        StoreError: It cannot be written.
    """
    with open_replacement(path) as file:
        file.write(format_dh_file(dh_table(arm), arm.name))
    return path


def compute_task_jacobian(arm: Arm, task: str) -> FloatArray:
    """Return the task's rows of the Jacobian at the configuration of zeros, (m, n)."""
    return np.asarray(arm.jacobian(np.zeros(arm.n))[: TASK_SIZES[task]])


def _compute_null_space(jacobian: FloatArray) -> FloatArray:
    return orthogonal_complement(np.linalg.qr(jacobian.T)[0])


def _check_null_space(
    ceiling: UpperBound | None, null_space: ArrayLike | None, row_count: int, task: str, failures: int
) -> tuple[FloatArray, int]:
    """Check the requested null space, and return it with the number of failures."""
    if ceiling is not None:
        if ceiling.null_space is None:
            raise InputError(f"no null space is stored for {ceiling.n},{ceiling.m},{ceiling.k}: search for one and give it")
        basis, failures = ceiling.null_space, ceiling.k
    else:
        basis = require_real_numbers(null_space, "the null space")
    if basis.ndim != 2 or basis.shape[0] - basis.shape[1] != row_count:
        raise InputError(
            f"the null space has shape {basis.shape}; that of task '{task}' with {row_count} rows is (n, n - {row_count})"
        )
    if not measure_orthonormality_error(basis) <= _ORTHONORMALITY_TOLERANCE:
        raise InputError(
            f"the columns of the null space are not orthonormal: N'N - I is {measure_orthonormality_error(basis):.1e}"
        )
    return basis, failures


def _make_table(directions: FloatArray, origins: FloatArray, scale: float | None, task: str) -> DHTable:
    """Return the table of the arm with these axes at zero and the tool at the origin; without ``scale`` the lengths
    sum to 2 m.
    """
    joints, last_frame = list[Joint](), np.eye(4)
    for index, (axis, point) in enumerate(zip(directions, origins, strict=True)):
        frame = np.eye(4)
        frame[:3, :3] = np.linalg.qr(np.column_stack([axis, np.eye(3)]), mode="complete")[0][:, [1, 2, 0]]
        frame[:3, 2] = axis
        frame[:3, 1] = np.cross(axis, frame[:3, 0])
        frame[:3, 3] = point
        joints.append(
            Joint(f"joint{index + 1}", "continuous", np.linalg.inv(last_frame) @ frame, axis=np.array([0.0, 0.0, 1.0]))
        )
        last_frame = frame
    table = dh_table(Arm(name="lines", joints=tuple(joints), tool=np.asarray(np.linalg.inv(last_frame), np.float64)))
    total_length = sum(abs(row.a) + abs(row.d) for row in table.rows[:-1])
    if scale is None and total_length > 0:
        return _make_table(directions, origins * (_TOTAL_LENGTH_M / total_length), 1.0, task)
    return table


def _round_table(table: DHTable, decimals: int, keep_frames: bool) -> DHTable:
    """Return the table with its numbers rounded to ``decimals``; ``keep_frames`` keeps its base and tool unchanged.

    Elsewhere the base is the world and the tool is turned as the last row is: relative manipulability knows neither.
    """

    def round_angle(x: float) -> float:
        return float(np.radians(round(float(np.degrees(x)), decimals - 2)))

    rows = tuple(
        replace(
            row, a=round(row.a, decimals), d=round(row.d, decimals), alpha=round_angle(row.alpha), theta=round_angle(row.theta)
        )
        for row in table.rows
    )
    if keep_frames:
        return DHTable(rows, table.base, table.tool)
    tool = np.eye(4)
    tool[:3, 3] = np.round(table.tool[:3, 3], decimals)
    return DHTable(rows, np.eye(4), tool)
