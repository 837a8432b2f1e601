"""The task bank: random point-to-point tasks, each run under computer control in every scenario."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.solvers.inverse_kinematics import InverseKinematics, solver
from holdfast.teleop.trials.driving import Computer, Operator, Rules, drive
from holdfast.teleop.trials.performance import RECORDED, cpm, measures
from holdfast.teleop.trials.plant import Plant, check_rows
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import SCENARIOS, PointTasks, Scenario
from holdfast.teleop.trials.stick import Stick

Array = NDArray[np.float64]

DISTANCE = 2.0  # m
_DRAWS = 200  # targets tried from one start configuration
_RESTARTS, _TOLERANCE = 24, 1e-6
_STARTS = 20  # start configurations tried for one task
_TOGETHER = 400


def random_tasks(
    arm: Arm,
    per_joint: int = 400,
    joints: Sequence[int | str] | None = None,
    *,
    distance: float = DISTANCE,
    task: str | Task | Sequence[str] = "planar",
    seed: int = 0,
) -> PointTasks:
    """Random tasks: for each joint so many starts and targets that the arm can still reach once that joint is locked there.

    The start configuration is uniform within the joint limits (a full turn where there are none), the direction to the
    target uniform; a target is kept if a configuration of the arm with the joint locked at its start angle reaches it.

    Args:
        arm: The arm.
        per_joint: Tasks for each joint.
        joints: Names, or indices from 0; all if not given.
        distance: From start to target, m.
        task: Rows that the stick moves: 2 or 3 linear ones.
        seed: Of the random numbers.

    Returns:
        The tasks, joint by joint.

    Raises:
        InputError: No tasks asked for, a distance that is not above 0, or one that the arm can hardly ever cover.
        TaskError: Rows that a stick cannot command.

    Source: Goel et al. 2003, section 5: 1200 tasks, 2 m from start to target. The distribution is reconstructed.
    """
    rows = as_task(arm, task)
    check_rows(rows)
    chosen = list(range(arm.n)) if joints is None else [arm.joint_index(j) for j in joints]
    if per_joint < 1 or not chosen:
        raise InputError(f"per_joint is {per_joint} for {len(chosen)} joints; it must be 1 or more, for at least one joint")
    if not (np.isfinite(distance) and distance > 0):
        raise InputError(f"distance is {distance:g} m; it must be above 0")
    engine = solver(arm, rows)
    sequences = np.random.SeedSequence(seed).spawn(len(chosen))
    parts = [_tasks_of(engine, k, per_joint, distance, s) for k, s in zip(chosen, sequences, strict=True)]
    return PointTasks(*(np.concatenate(a) for a in zip(*parts, strict=True)))


def _tasks_of(
    engine: InverseKinematics, joint: int, count: int, distance: float, seed: np.random.SeedSequence
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Start configurations (count, n), targets (count, m) and the joint (count,) of tasks for one joint."""
    arm, rows = engine.arm, engine.task
    draw_seed, search_seed = seed.spawn(2)
    generator = np.random.default_rng(draw_seed)
    low, high = finite_limits(arm)
    q0, target = np.empty((count, arm.n)), np.empty((count, rows.m))
    x0 = np.empty((count, rows.m))
    open_, tried, starts = np.arange(count), np.full(count, _DRAWS), np.zeros(count, dtype=np.int64)
    while open_.size:
        fresh = open_[tried[open_] >= _DRAWS]
        if (starts[fresh] >= _STARTS).any():
            raise InputError(
                f"no target {distance:g} m away could be found that '{arm.name}' reaches with joint '{arm.joint_names[joint]}' "
                "locked; give a smaller distance"
            )
        if fresh.size:
            q0[fresh] = generator.uniform(low, high, (fresh.size, arm.n))
            x0[fresh] = arm.forward_kinematics(q0[fresh])[:, :3, 3] @ rows.rows[:, :3].T
        tried[fresh], starts[fresh] = 0, starts[fresh] + 1
        # Of few open tasks many directions are tried side by side; the first that works counts.
        beside = max(1, _TOGETHER // open_.size)
        direction = generator.normal(size=(open_.size, beside, rows.m))
        direction /= np.linalg.norm(direction, axis=2, keepdims=True)
        there = (x0[open_, None] + distance * direction).reshape(-1, rows.m)
        poses = np.tile(np.eye(4), (len(there), 1, 1))
        poses[:, :3, 3] = there @ rows.rows[:, :3]
        angles = np.repeat(q0[open_, joint], beside)
        ok = engine.reaches_locked(poses, np.full(len(there), joint), angles, search_seed, _RESTARTS, _TOLERANCE)
        ok = ok.reshape(-1, beside)
        found = ok.any(axis=1)
        target[open_[found]] = there.reshape(-1, beside, rows.m)[found, ok[found].argmax(axis=1)]
        tried[open_] += beside
        open_ = open_[~found]
    return q0, target, np.full(count, joint, dtype=np.int64)


def run(
    arm: Arm,
    tasks: PointTasks,
    operator: Operator | None = None,
    *,
    scenarios: Sequence[Scenario] = SCENARIOS,
    stick: Stick | None = None,
    rules: Rules | None = None,
    task: str | Task | Sequence[str] = "planar",
) -> Trials:
    """Run every task in every scenario: S x N trials, scenario by scenario.

    Args:
        arm: The arm.
        tasks: N tasks.
        operator: Who holds the stick; the computer if not given.
        scenarios: The S conditions.
        stick: As :class:`holdfast.teleop.Stick`; the paper's if not given.
        rules: When a trial is over.
        task: Rows that the stick moves.

    Raises:
        InputError, TaskError: As the laws and :func:`holdfast.teleop.drive`.
    """
    plants = [Plant(s.make_law(arm, task)) for s in scenarios]
    stick = Stick() if stick is None else stick
    return in_every_scenario(plants, scenarios, tasks, Computer() if operator is None else operator, stick, rules)


def in_every_scenario(
    plants: Sequence[Plant],
    scenarios: Sequence[Scenario],
    tasks: PointTasks,
    operator: Operator,
    stick: Stick,
    rules: Rules | None,
) -> Trials:
    """Every task in every scenario, scenario by scenario; a plant for each scenario."""
    count = len(tasks)
    scenario = np.repeat(np.arange(len(scenarios)), count)
    every = tasks.take(np.tile(np.arange(count), len(scenarios)))
    return drive_tasks(plants, scenarios, scenario, every, operator, stick, rules)


def drive_tasks(
    plants: Sequence[Plant],
    scenarios: Sequence[Scenario],
    scenario: NDArray[np.int64],
    tasks: PointTasks,
    operator: Operator,
    stick: Stick | None,
    rules: Rules | None,
) -> Trials:
    """As :func:`holdfast.teleop.drive`, for N tasks under scenarios (N,), indices from 0; a plant for each scenario."""
    failed = np.array([s.failed for s in scenarios], dtype=bool)[scenario]
    return drive(
        plants,
        scenario,
        tasks.q0,
        target=tasks.target,
        healthy=tasks.healthy(failed),
        operator=operator,
        stick=stick,
        rules=rules,
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskBank:
    """N tasks and how the computer did them in S scenarios.

    Attributes:
        tasks: The tasks.
        scenarios: The conditions.
        measures: (S, N, 11) M1 to M11; NaN where the end effector did not reach it.
        end: (S, N) :class:`holdfast.teleop.End`.
        cpm: (S, N) combined performance measures; NaN where the end effector did not reach it.
        normalisers: (11,) of the CPM: the largest measures of all these trials.
    """

    tasks: PointTasks
    scenarios: tuple[Scenario, ...]
    measures: Array
    end: NDArray[np.uint8]
    cpm: Array
    normalisers: Array

    @classmethod
    def of(cls, tasks: PointTasks, trials: Trials, scenarios: Sequence[Scenario] = SCENARIOS) -> TaskBank:
        """From the trials of :func:`run`."""
        shape = (len(scenarios), len(tasks))
        values = measures(trials).reshape(*shape, RECORDED)
        combined = cpm(values)
        return cls(
            tasks=tasks,
            scenarios=tuple(scenarios),
            measures=values,
            end=trials.end.reshape(shape),
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def __len__(self) -> int:
        return len(self.tasks)

    def scenario(self, law: str, failed: bool) -> int:
        """Index of the scenario with this law and failure.

        Raises:
            InputError: There is none.
        """
        for k, s in enumerate(self.scenarios):
            if s.law == law and s.failed == failed:
                return k
        raise InputError(f"the bank has no scenario with {law} and {'a' if failed else 'no'} failure; run the tasks with one")

    @property
    def difficulty(self) -> Array:
        """(N,) CPM3: of the failed arm under the pseudoinverse, the anticipated difficulty."""
        return np.asarray(self.cpm[self.scenario("pseudoinverse", failed=True)])

    @property
    def ratio(self) -> Array:
        """(N,) CPM4 / CPM3: below 1, the failure-tolerant inverse does better."""
        return np.asarray(self.cpm[self.scenario("failure-tolerant", failed=True)] / self.difficulty)

    def completed(self) -> NDArray[np.bool_]:
        """(N,) True where the end effector reached the target in every scenario."""
        return np.asarray((self.end == End.ARRIVED).all(axis=0))


@says("running the tasks")
def task_bank(
    arm: Arm,
    per_joint: int = 400,
    joints: Sequence[int | str] | None = None,
    *,
    distance: float = DISTANCE,
    task: str | Task | Sequence[str] = "planar",
    seed: int = 0,
    scenarios: Sequence[Scenario] = SCENARIOS,
    stick: Stick | None = None,
    rules: Rules | None = None,
) -> TaskBank:
    """Random tasks, each run under computer control in every scenario; see :func:`random_tasks` and :func:`run`.

    Source: Goel et al. 2003, section 5.
    """
    tasks = random_tasks(arm, per_joint, joints, distance=distance, task=task, seed=seed)
    return TaskBank.of(tasks, run(arm, tasks, scenarios=scenarios, stick=stick, rules=rules, task=task), scenarios)
