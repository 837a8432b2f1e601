"""From a Jacobian or a null space to arms, as Denavit-Hartenberg tables in numbers that can be built."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.machine import Joint
from holdfast.arm.model import Arm
from holdfast.arms.dh_file import text
from holdfast.arms.dh_rows import DHTable, dh_table
from holdfast.ceilings.ceiling import Ceiling, look_up
from holdfast.ceilings.frames import complement
from holdfast.ceilings.minors import lack_of_orthonormality, worst_case
from holdfast.designs.synthesis.axes import axes_of, poses_of
from holdfast.errors import InputError
from holdfast.files.output import writing
from holdfast.grammar import TASKS
from holdfast.result import Result
from holdfast.words import capitalised

Array = NDArray[np.float64]

_ORTHONORMAL = 1e-9
_LENGTH = 2.0  # m, sum of |a| and |d|
_TASKS = ("planar", "position", "pose")


@dataclass(frozen=True, kw_only=True, eq=False)
class Synthesis(Result):
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
    jacobians: list[Array]
    losses: list[float]
    residual: float
    bound: float

    def describe(self) -> list[str]:
        """How many arms, how good, and what rounding took."""
        n = self.arms[0].n
        return [
            f"{capitalised(self.task)}, {n} joints: {len(self.arms)} arms with {self.value:.6g} at the configuration of zeros, "
            f"after the worst lock of {self.failures} at once (no arm can beat {self.bound:.6g}); rounding takes "
            f"at most {max(self.losses):.1e}"
        ]


@checked
def synthesise(
    ceiling: Ceiling | None = None,
    *,
    jacobian: ArrayLike | None = None,
    null_space: ArrayLike | None = None,
    task: str = "pose",
    failures: int = 1,
    starts: int = 12,
    seed: int = 0,
    decimals: int = 5,
) -> Synthesis:
    """Arms of revolute joints that have a null space, or a Jacobian, at the configuration of zeros.

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
    if sum(x is not None for x in (ceiling, jacobian, null_space)) != 1:
        raise InputError("give one of a ceiling, a Jacobian and a null space")
    if task not in _TASKS:
        raise InputError(f"arms are made for {', '.join(_TASKS)}, not for '{task}'")
    rows, residual = TASKS[task], 0.0
    rng = np.random.default_rng(seed)
    if jacobian is not None:
        given = np.atleast_2d(real_numbers(jacobian, "the Jacobian"))
        if len(given) != rows:
            raise InputError(f"the Jacobian has {len(given)} rows; task '{task}' has {rows}")
        null, found = _null_of(given), [given]
    else:
        null, failures = _given(ceiling, null_space, rows, task, failures)
        if task == "pose":
            found, residual = poses_of(null, starts=starts, seed=seed)
            if not found:
                raise InputError(
                    f"no revolute axes with this null space were found from {starts} starts; the least residual was "
                    f"{residual:.1e}, which proves nothing: give more starts"
                )
        else:
            found = [complement(null).T]
    arms, jacobians, losses = list[Arm](), list[Array](), list[float]()
    value = worst_case(null, failures)
    for j in found:
        turns = (
            [rng.uniform(-np.pi, np.pi, len(null)) for _ in range(starts)]
            if task == "position" and jacobian is None
            else [None]
        )
        for angles in turns:
            table = _table(*axes_of(j, angles), 1.0 if jacobian is not None else None, task)
            arm = _rounded(table, decimals, jacobian is not None).arm(name=f"{task}-{len(null)}R")
            arms.append(arm)
            jacobians.append(j)
            losses.append(value - worst_case(_null_of(task_rows(arm, task)), failures))
    bound = (ceiling or look_up(n=len(null), m=rows, k=failures)).bound
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


def written(arm: Arm, path: Path) -> Path:
    """Write an arm's Denavit-Hartenberg table as a YAML file, which all commands read.

    Raises:
        StoreError: It cannot be written.
    """
    with writing(path) as file:
        file.write(text(dh_table(arm), arm.name))
    return path


def task_rows(arm: Arm, task: str) -> Array:
    """The task's rows of the Jacobian at the configuration of zeros, (m, n)."""
    return np.asarray(arm.jacobian(np.zeros(arm.n))[: TASKS[task]])


def _null_of(jacobian: Array) -> Array:
    return complement(np.linalg.qr(jacobian.T)[0])


def _given(ceiling: Ceiling | None, null_space: ArrayLike | None, rows: int, task: str, failures: int) -> tuple[Array, int]:
    """The null space asked for, checked, and the failures."""
    if ceiling is not None:
        if ceiling.null_space is None:
            raise InputError(f"no null space is stored for {ceiling.n},{ceiling.m},{ceiling.k}: search for one and give it")
        null, failures = ceiling.null_space, ceiling.k
    else:
        null = real_numbers(null_space, "the null space")
    if null.ndim != 2 or null.shape[0] - null.shape[1] != rows:
        raise InputError(f"the null space has shape {null.shape}; that of task '{task}' with {rows} rows is (n, n - {rows})")
    if not lack_of_orthonormality(null) <= _ORTHONORMAL:
        raise InputError(f"the columns of the null space are not orthonormal: N'N - I is {lack_of_orthonormality(null):.1e}")
    return null, failures


def _table(w: Array, o: Array, scale: float | None, task: str) -> DHTable:
    """The table of the arm whose axes these are at zero, the tool at the origin; lengths scaled to 2 m in all if not given."""
    joints, last = list[Joint](), np.eye(4)
    for i, (axis, point) in enumerate(zip(w, o, strict=True)):
        frame = np.eye(4)
        frame[:3, :3] = np.linalg.qr(np.column_stack([axis, np.eye(3)]), mode="complete")[0][:, [1, 2, 0]]
        frame[:3, 2] = axis
        frame[:3, 1] = np.cross(axis, frame[:3, 0])
        frame[:3, 3] = point
        joints.append(Joint(f"joint{i + 1}", "continuous", np.linalg.inv(last) @ frame, axis=np.array([0.0, 0.0, 1.0])))
        last = frame
    table = dh_table(Arm(name="lines", joints=tuple(joints), tool=np.asarray(np.linalg.inv(last), np.float64)))
    length = sum(abs(r.a) + abs(r.d) for r in table.rows[:-1])
    if scale is None and length > 0:
        return _table(w, o * (_LENGTH / length), 1.0, task)
    return table


def _rounded(table: DHTable, decimals: int, placed: bool) -> DHTable:
    """With its numbers in so many decimals; where the arm is placed its base and tool as they are.

    Elsewhere the base is the world and the tool is turned as the last row is: relative manipulability knows neither.
    """

    def angle(x: float) -> float:
        return float(np.radians(round(float(np.degrees(x)), decimals - 2)))

    rows = tuple(
        replace(r, a=round(r.a, decimals), d=round(r.d, decimals), alpha=angle(r.alpha), theta=angle(r.theta))
        for r in table.rows
    )
    if placed:
        return DHTable(rows, table.base, table.tool)
    tool = np.eye(4)
    tool[:3, 3] = np.round(table.tool[:3, 3], decimals)
    return DHTable(rows, np.eye(4), tool)
