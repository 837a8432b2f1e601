"""What is asked about the locks of a motion along a path: read once, for every way to ask."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, task_of_path
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.locks import Lock
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError, TaskError
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.self_motions import SelfMotion, tracer

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

    def judge(self, found: list[SelfMotion] | None) -> Callable[[Array], Flags]:
        """What says which locks of motions (T, n) are survived, (T, n)."""
        if self.mode == "on-path":
            return lambda q: tables.along(self.lock, q)
        assert found is not None
        ranges = tables.common_ranges(found)
        return lambda q: np.array([tables.within(self.arm, x[None], at)[0] for x, at in zip(q, ranges, strict=True)])


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
    )
