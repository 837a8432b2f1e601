"""What is asked about the locks of a motion along a path: read once, for every way to ask."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, task_of_path
from holdfast.caching import cached_property
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.conditions import Conditions, task_jacobian, with_axis
from holdfast.endurance.locks import Lock
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError, TaskError
from holdfast.keep.kept import Kept
from holdfast.keep.labels import KeepLike, as_kept
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.self_motions import SelfMotion, traced, tracer

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

Mode = Literal["on-path", "detour"]
Kind = Literal["exact", "upper bound", "lower bound"]

ON = 1e-3  # m and rad that a configuration given may be off the path
_IMMOBILE = 1e-9  # rad and m between the limits of a joint that does not move, or in a motion
_SETS = 24  # of joints that a failed arm may hold
CHANGED = 8  # of these, between which it may change on its way
_FIRST, _STARTS = 3, 64  # configurations of the first pose that are tried, of so many starts
_RESTARTS, _FOUND = 30, 1e-6  # of inverse kinematics with a joint locked; rad, and lengths in units of the arm's own
_RANK = 1e-6  # of the largest singular value
_COARSE, _FEWEST = 0.15, 11  # rad between nodes, and poses, of what is only tried


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem:
    """What is asked.

    Attributes:
        spare: Degrees of redundancy, less the joints that cannot move.
        kind: What a verdict on a lock is: exact, up to the grid; an upper bound, of detours among obstacles or with something
            kept, which are not looked for; or a lower bound, where more than one degree of redundancy leaves a failed arm more
            ways than are looked at.
    """

    arm: Arm
    path: TimedPath
    task: Task
    mode: Mode
    rates: FailureRates
    time: Array
    lock: Lock
    conditions: Conditions
    spacing: float
    seed: int
    starts: int

    @property
    def kind(self) -> Kind:
        """What a verdict is."""
        if self.spare > 1:
            return "lower bound"
        return "upper bound" if self.mode == "detour" and self.conditions.any else "exact"

    @property
    def spare(self) -> int:
        """Degrees of redundancy of the joints that can move."""
        return self.arm.n - self.task.m - len(self.immobile)

    @cached_property
    def immobile(self) -> dict[int, float]:
        """Joints that cannot move, and where they are."""
        joints = np.flatnonzero(self.arm.upper - self.arm.lower <= _IMMOBILE)
        return {int(k): float(self.arm.lower[k]) for k in joints}

    def holding(self, others: Mapping[int, float]) -> Problem:
        """The same for motions along which other joints stay at values too, rad and m, beside those that cannot move."""
        return replace(self, lock=replace(self.lock, tracer=tracer(self.arm, self.task, {**self.immobile, **others})))

    @cached_property
    def sets(self) -> list[tuple[int, ...]]:
        """Joints that can be held so that one degree of redundancy is left; of many some, drawn."""
        mobile = [k for k in range(self.arm.n) if k not in self.immobile]
        every = list(combinations(mobile, self.spare - 1))
        order = np.random.default_rng(np.random.SeedSequence(self.seed)).permutation(len(every))
        return [every[k] for k in order[:_SETS]]

    def leaves_one(self, q: Array, others: Sequence[int]) -> bool:
        """Whether one degree of redundancy is left at q (n,) if other joints stay there.

        More are left where one of them could not move anyway, such as a roll joint that the tool's axis sets.
        """
        mobile = [k for k in range(self.arm.n) if k not in self.immobile and k not in others]
        size = np.linalg.svd(task_jacobian(self.arm, self.task, q[None])[0][:, mobile], compute_uv=False)
        return bool(size[-1] > _RANK * size[0])

    def narrower(self, axis: Array) -> Problem | None:
        """The same with the axis of the tool that a cone leaves free held along ``axis`` (3,), a unit vector in the world.

        Two rows more, so that less is looked at and what is found does more; every motion and every way on is one of this
        problem too. None where there is no such cone, the path prescribes turns, or no redundancy is left.
        """
        cone = next(iter(self.conditions.left), None)
        held = None if cone is None or self.spare < 3 else with_axis(self.task, self.path, cone.axis, axis)
        if held is None:
            return None
        task, path = held
        conditions = Conditions.of(self.arm, task, self.conditions.room, self.conditions.keep)
        lock = Lock.along(self.arm, tracer(self.arm, task, self.immobile), path, self.time, conditions.holds)
        return replace(self, path=path, task=task, conditions=conditions, lock=lock)

    def narrower_at(self, q: Array) -> Problem | None:
        """As :meth:`narrower`, with the axis held along where it is at q (n,)."""
        if not self.conditions.left:
            return None
        axis = self.arm.forward_kinematics(q)[:3, :3] @ self.conditions.left[0].axis
        return self.narrower(axis)

    def coarser(self) -> Problem:
        """The same on fewer poses and nodes, for trying."""
        time = np.linspace(0.0, self.path.duration, max(len(self.time) // 4, _FEWEST))
        lock = Lock.along(self.arm, self.lock.tracer, self.path, time, self.conditions.holds)
        return replace(self, time=time, lock=lock, spacing=max(self.spacing, _COARSE))

    def first(self) -> Array:
        """(K, n) a few configurations of the first pose, far apart."""
        q = self.lock.tracer.seeds(self.lock.poses[:1], np.zeros(1, dtype=np.intp), self.seed, _STARTS)[1]
        q = self.conditions.brought(q, np.broadcast_to(self.lock.poses[0], (len(q), 4, 4)))
        q = q[~self._off(q, self.lock.poses[:1]) & self.conditions.holds(q)]
        chosen = [0] * bool(len(q))
        while 0 < len(chosen) < min(_FIRST, len(q)):
            away = np.min([np.linalg.norm(joint_space.difference(self.arm, q, q[k]), axis=1) for k in chosen], axis=0)
            chosen.append(int(away.argmax()))
        return np.asarray(q[chosen])

    def judge(self, q: Array) -> Flags:
        """(T, n) which locks of a motion (T, n) are survived; none where it is NaN."""
        if self.mode == "on-path":
            return self.followed(q)
        if self.spare > 1:
            survives = np.isfinite(q).all(axis=1, keepdims=True).repeat(self.arm.n, axis=1)
            row, joint = np.nonzero(survives)
            survives[row, joint] = self.regained(q[row], row + 1, joint)
            return survives
        return np.array([tables.within(self.arm, x[None], at)[0] for x, at in zip(q, self._ranges, strict=True)])

    def regained(self, q: Array, first: Index, joint: Index) -> Flags:
        """(N,) True where inverse kinematics finds configurations with joint (N,) where it is at q (N, n), of all poses from
        number ``first`` (N,) on.
        """
        count = len(self.time) - first
        owner = np.repeat(np.arange(len(q)), count)
        pose = np.concatenate([np.arange(k, len(self.time)) for k in first])
        accept = self.conditions.holds if self.conditions.any else None
        value, seed = q[owner, joint[owner]], np.random.SeedSequence(self.seed)
        found = solver(self.arm, self.task).reaches_locked(
            self.lock.poses[pose], joint[owner], value, seed, _RESTARTS, _FOUND, accept
        )
        survived = np.ones(len(q), dtype=bool)
        survived[owner[~found]] = False
        return survived

    def followed(self, q: Array) -> Flags:
        """(T, n) as :meth:`judge`, without leaving the path.

        With more than one degree of redundancy the failed arm goes on with further joints held, the same all the way or others
        from pose to pose, or with the tool's axis held that a cone leaves free; a lock is survived if one such way leads to the
        end, or if the motion itself does not move the joint any more.
        """
        if self.spare == 1:
            return tables.along(self.lock, q)
        survives = self.stays(q)
        for held in self.sets:
            asked = ~survives
            asked[:, list(held)] = False
            if asked.any():
                survives |= tables.along(self.holding(dict.fromkeys(held, 0.0)).lock, q, asked)
        narrower = self.narrower_at(q[0]) if np.isfinite(q[0]).all() else None
        if narrower is not None:
            survives |= narrower.followed(np.where(narrower.off(q)[:, None], np.nan, q))
        asked = ~survives & np.isfinite(q).all(axis=1, keepdims=True)
        if asked.any():
            locks = [self.holding(dict.fromkeys(held, 0.0)).lock for held in self.sets[:CHANGED]]
            survives |= tables.changing(locks, q, asked)
        return survives

    def stays(self, q: Array) -> Flags:
        """(T, n) where a motion (T, n) is there to its end and moves the joint no more: with redundancy left, it goes on."""
        there = np.isfinite(q).all(axis=1, keepdims=True)
        moves = np.abs(q - q[-1]) > _IMMOBILE
        lost = (~there | moves | (self.spare == 1))[::-1]
        return np.asarray(~np.logical_or.accumulate(lost)[::-1])

    @cached_property
    def fibres(self) -> list[SelfMotion]:
        """The self-motion curves of every pose."""
        kept, margin = self.conditions.room or (None, 0.0)
        options = {"spacing": self.spacing, "seed": self.seed, "starts": self.starts, "clearance": kept, "margin": margin}
        found = traced(self.lock.tracer, self.task, self.lock.poses, follow=True, **options)  # type: ignore[arg-type]
        return [self.conditions.cut(self.lock.tracer, each_pose) for each_pose in found]

    @cached_property
    def _ranges(self) -> list[list[tables.Spans]]:
        return tables.common_ranges(self.fibres)

    def off(self, q: Array, time: Array | None = None) -> Flags:
        """(T,) where a motion (T, n) is off the path by more than 1 mm or 1 mrad, or not there at all; or q (N, n) at times."""
        return self._off(q, self.lock.poses if time is None else self.path.pose(time))

    def _off(self, q: Array, poses: Array) -> Flags:
        position, rotation = solver(self.arm, self.task).errors(q, np.broadcast_to(poses, (len(q), 4, 4)))
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
    keep: KeepLike | None,
    spacing: float,
    seed: int,
    starts: int,
) -> Problem:
    """The problem, if it can be posed.

    Raises:
        InputError: Options that do not fit, or a row that is kept exactly and that the path leaves free.
        TaskError: No redundancy, or more than one degree of it and detours among obstacles or with something kept.
    """
    if mode not in ("on-path", "detour"):
        raise InputError(f"mode is '{mode}'; use 'on-path' or 'detour'")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    rows = as_task(arm, task_of_path(arm, path.path.oriented) if task is None else task)
    clear = chosen_clearance(arm, clearance, cell, looks=False)
    if clear is None and margin:
        raise InputError("margin has nothing to keep: no clearance is looked at; give a cell, or a clearance")
    kept = None if clear is None else (clear, margin)
    time = np.linspace(0.0, path.duration, samples)
    every = _anchored(keep, path)
    for one in every:
        if one.direction is not None and not one.angle:  # kept exactly: rows of the task, where they can be
            rows, path = with_axis(rows, path, one.axis, one.direction) or (rows, path)
    conditions = Conditions.of(arm, rows, kept, every)
    problem = Problem(
        arm=arm,
        path=path,
        task=rows,
        mode=mode,
        rates=FailureRates.of(arm, rates, per_second=per_second),
        time=time,
        lock=Lock.along(arm, tracer(arm, rows), path, time, conditions.holds),
        conditions=conditions,
        spacing=spacing,
        seed=seed,
        starts=starts,
    )
    if problem.spare < 1:
        fixed = f", {len(problem.immobile)} of which cannot move," if problem.immobile else ""
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints{fixed} and the task '{rows.name}' {rows.m} rows: without redundancy almost every "
            "lock loses the path; choose a task with fewer rows"
        )
    if problem.spare == 1:
        return problem.holding({}) if problem.immobile else problem
    if mode == "detour" and conditions.any:
        raise TaskError(
            f"'{arm.name}' has {problem.spare} degrees of redundancy for the task '{rows.name}'; detours among obstacles or "
            "with something kept are looked at with one: use the mode on-path, or choose a task with more rows"
        )
    return problem


def _anchored(keep: KeepLike | None, path: TimedPath) -> tuple[Kept, ...]:
    """What is kept, through the first pose of the path."""
    every = as_kept(keep)
    for one in every:
        if one.frame == "tool" and not path.path.oriented:
            raise InputError(f"keep '{one}' goes by the tool's axes at the start, and the path has positions only")
    return tuple(one.anchored(path.pose(0.0)) for one in every)
