"""What is asked about the locks of a motion along a path: read once, for every way to ask."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, task_of_path
from holdfast.caching import cached_property
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.locks import Lock
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError, TaskError
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.self_motions import SelfMotion, fibres, tracer

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

Mode = Literal["on-path", "detour"]

ON = 1e-3  # m and rad that a configuration given may be off the path


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem:
    """What is asked."""

    arm: Arm
    path: TimedPath
    task: Task
    mode: Mode
    rates: FailureRates
    time: Array
    lock: Lock
    kept: tuple[Clearance, float] | None
    spacing: float
    seed: int
    starts: int

    def judge(self, q: Array) -> Flags:
        """(T, n) which locks of a motion (T, n) are survived; none where it is NaN."""
        if self.mode == "on-path":
            return tables.along(self.lock, q)
        return np.array([tables.within(self.arm, x[None], at)[0] for x, at in zip(q, self._ranges, strict=True)])

    @cached_property
    def fibres(self) -> list[SelfMotion]:
        """The self-motion curves of every pose."""
        kept, margin = self.kept or (None, 0.0)
        return fibres(
            self.arm,
            self.lock.poses,
            self.task,
            spacing=self.spacing,
            seed=self.seed,
            starts=self.starts,
            follow=True,
            clearance=kept,
            margin=margin,
        )

    @cached_property
    def _ranges(self) -> list[list[tables.Spans]]:
        return tables.common_ranges(self.fibres)

    def off(self, q: Array) -> Flags:
        """(T,) where a motion (T, n) is off the path by more than 1 mm or 1 mrad, or not there at all."""
        position, rotation = solver(self.arm, self.task).errors(q, self.lock.poses)
        return ~(np.maximum(position, rotation) <= ON)


def posed(
    arm: Arm,
    path: TimedPath,
    rates: RatesLike | FailureRates | None,
    per_second: bool,
    mode: Mode,
    task: str | Task | Sequence[str] | None,
    samples: int,
    clearance: Clearance | bool | None,
    cell: CellLike | None,
    margin: float,
    *,
    spacing: float,
    seed: int,
    starts: int,
) -> Problem:
    """The problem, if it can be posed.

    Raises:
        InputError: Options that do not fit.
        TaskError: No redundancy, or more than one degree of it.
    """
    if mode not in ("on-path", "detour"):
        raise InputError(f"mode is '{mode}'; use 'on-path' or 'detour'")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    rows = as_task(arm, task_of_path(arm, path.path.oriented) if task is None else task)
    if arm.n - rows.m != 1:
        advice = (
            "without redundancy almost every lock loses the path; choose a task with fewer rows"
            if arm.n <= rows.m
            else "more than one degree of redundancy is not done yet; choose a task with more rows, or lock a joint"
        )
        raise TaskError(f"'{arm.name}' has {arm.n} joints and the task '{rows.name}' {rows.m} rows: {advice}")
    clear = chosen_clearance(arm, clearance, cell, looks=False)
    if clear is None and margin:
        raise InputError("margin has nothing to keep: no clearance is looked at; give a cell, or a clearance")
    kept = None if clear is None else (clear, margin)
    time = np.linspace(0.0, path.duration, samples)
    return Problem(
        arm=arm,
        path=path,
        task=rows,
        mode=mode,
        rates=FailureRates.of(arm, rates, per_second=per_second),
        time=time,
        lock=Lock.along(arm, tracer(arm, rows), path, time, kept),
        kept=kept,
        spacing=spacing,
        seed=seed,
        starts=starts,
    )
