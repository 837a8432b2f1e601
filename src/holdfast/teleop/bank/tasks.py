"""Task bank: random point-to-point tasks, each run under computer control in every scenario."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.kinematics.solvers.inverse_kinematics import InverseKinematics, solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.teleop.trials.driving import ComputerOperator, EndRules, Operator, drive_trials
from holdfast.teleop.trials.performance import RECORDED_MEASURES, compute_cpm, compute_measures
from holdfast.teleop.trials.plant import JoystickPlant, check_joystick_task
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import SCENARIO_NAMES, PointTasks, Scenario
from holdfast.teleop.trials.stick import Joystick

TASK_DISTANCE_M = 2.0  # distance from start to target, m
_MAX_TARGETS_PER_START = 200  # targets tried from one start configuration
_IK_RESTARTS = 24
_IK_TOLERANCE = 1e-6
_MAX_STARTS_PER_TASK = 20  # start configurations tried for one task
_BATCH_TARGETS = 400


def sample_tasks(
    arm: Arm,
    per_joint: int = 400,
    joints: Sequence[int | str] | None = None,
    *,
    distance: float = TASK_DISTANCE_M,
    task: str | Task | Sequence[str] = "planar",
    seed: int = 0,
) -> PointTasks:
    """Sample tasks for each joint, with targets that the arm can still reach once the joint is locked at its start angle.

    The start configuration is uniform within the joint limits (a full revolution without limits), and the direction to the
    target is uniform. A target is kept if a configuration of the arm with the joint locked at its start angle reaches it.

    Args:
        arm: The arm.
        per_joint: Number of tasks for each joint.
        joints: Names or indices of the joints, from 0. Default: all joints.
        distance: Distance from start to target, m.
        task: Task rows that the joystick moves: 2 or 3 linear ones.
        seed: Seed of the random numbers.

    Returns:
        The tasks, joint by joint.

    Raises:
        InputError: No tasks are requested, the distance is not above 0, or the arm can hardly ever cover it.
        TaskError: The task has rows that a joystick cannot command.

    Source: Goel et al. 2003, section 5: 1200 tasks, 2 m from start to target. The distribution is reconstructed.
    """
    task_rows = as_task(arm, task)
    check_joystick_task(task_rows)
    joint_indices = list(range(arm.n)) if joints is None else [arm.joint_index(name) for name in joints]
    if per_joint < 1 or not joint_indices:
        raise InputError(
            f"per_joint is {per_joint} for {len(joint_indices)} joints; it must be 1 or more, for at least one joint"
        )
    if not (np.isfinite(distance) and distance > 0):
        raise InputError(f"distance is {distance:g} m; it must be above 0")
    inverse_kinematics = solver(arm, task_rows)
    sequences = np.random.SeedSequence(seed).spawn(len(joint_indices))
    tasks_by_joint = [
        _sample_joint_tasks(inverse_kinematics, joint, per_joint, distance, sequence)
        for joint, sequence in zip(joint_indices, sequences, strict=True)
    ]
    return PointTasks(*(np.concatenate(arrays) for arrays in zip(*tasks_by_joint, strict=True)))


def _sample_joint_tasks(
    inverse_kinematics: InverseKinematics, joint: int, count: int, distance: float, seed: np.random.SeedSequence
) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Sample start configurations (count, n), targets (count, m) and the joint (count,) of tasks for one joint."""
    arm, task = inverse_kinematics.arm, inverse_kinematics.task
    draw_seed, search_seed = seed.spawn(2)
    generator = np.random.default_rng(draw_seed)
    lower, upper = sampling_limits(arm)
    q0, target = np.empty((count, arm.n)), np.empty((count, task.m))
    x0 = np.empty((count, task.m))
    pending, tries, start_counts = np.arange(count), np.full(count, _MAX_TARGETS_PER_START), np.zeros(count, dtype=np.int64)
    while pending.size:
        restarted = pending[tries[pending] >= _MAX_TARGETS_PER_START]
        if (start_counts[restarted] >= _MAX_STARTS_PER_TASK).any():
            raise InputError(
                f"no target {distance:g} m away could be found that '{arm.name}' reaches with joint '{arm.joint_names[joint]}' "
                "locked; give a smaller distance"
            )
        if restarted.size:
            q0[restarted] = generator.uniform(lower, upper, (restarted.size, arm.n))
            x0[restarted] = arm.forward_kinematics(q0[restarted])[:, :3, 3] @ task.rows[:, :3].T
        tries[restarted], start_counts[restarted] = 0, start_counts[restarted] + 1
        # If only a few tasks remain, many directions are tried at once, and the first that works counts.
        direction_count = max(1, _BATCH_TARGETS // pending.size)
        directions = generator.normal(size=(pending.size, direction_count, task.m))
        directions /= np.linalg.norm(directions, axis=2, keepdims=True)
        candidates = (x0[pending, None] + distance * directions).reshape(-1, task.m)
        poses = np.tile(np.eye(4), (len(candidates), 1, 1))
        poses[:, :3, 3] = candidates @ task.rows[:, :3]
        angles = np.repeat(q0[pending, joint], direction_count)
        reachable = inverse_kinematics.is_reachable_with_lock(
            poses, np.full(len(candidates), joint), angles, search_seed, _IK_RESTARTS, _IK_TOLERANCE
        )
        reachable = reachable.reshape(-1, direction_count)
        solved = reachable.any(axis=1)
        target[pending[solved]] = candidates.reshape(-1, direction_count, task.m)[solved, reachable[solved].argmax(axis=1)]
        tries[pending] += direction_count
        pending = pending[~solved]
    return q0, target, np.full(count, joint, dtype=np.int64)


def run_tasks(
    arm: Arm,
    tasks: PointTasks,
    operator: Operator | None = None,
    *,
    scenarios: Sequence[Scenario] = SCENARIO_NAMES,
    stick: Joystick | None = None,
    rules: EndRules | None = None,
    task: str | Task | Sequence[str] = "planar",
) -> Trials:
    """Run every task in every scenario: S x N trials, scenario by scenario.

    Args:
        arm: The arm.
        tasks: N tasks.
        operator: Operator of the joystick. Default: the computer.
        scenarios: S scenarios.
        stick: Joystick. Default: that of the paper.
        rules: Rules that end a trial. Default: ``EndRules()``.
        task: Task rows that the joystick moves.

    Raises:
        InputError, TaskError: As for the laws and :func:`holdfast.teleop.drive_trials`.
    """
    plants = [JoystickPlant(scenario.make_law(arm, task)) for scenario in scenarios]
    stick = Joystick() if stick is None else stick
    return drive_in_every_scenario(plants, scenarios, tasks, ComputerOperator() if operator is None else operator, stick, rules)


def drive_in_every_scenario(
    plants: Sequence[JoystickPlant],
    scenarios: Sequence[Scenario],
    tasks: PointTasks,
    operator: Operator,
    stick: Joystick,
    rules: EndRules | None,
) -> Trials:
    """Drive every task in every scenario, scenario by scenario, with a plant for each scenario."""
    count = len(tasks)
    scenario = np.repeat(np.arange(len(scenarios)), count)
    repeated_tasks = tasks.take(np.tile(np.arange(count), len(scenarios)))
    return drive_tasks(plants, scenarios, scenario, repeated_tasks, operator, stick, rules)


def drive_tasks(
    plants: Sequence[JoystickPlant],
    scenarios: Sequence[Scenario],
    scenario: NDArray[np.int64],
    tasks: PointTasks,
    operator: Operator,
    stick: Joystick | None,
    rules: EndRules | None,
) -> Trials:
    """Drive N tasks like :func:`holdfast.teleop.drive_trials`, in scenarios (N,) given by index, with a plant for each one."""
    failed = np.array([condition.failed for condition in scenarios], dtype=bool)[scenario]
    return drive_trials(
        plants,
        scenario,
        tasks.q0,
        target=tasks.target,
        healthy=tasks.healthy_mask(failed),
        operator=operator,
        stick=stick,
        rules=rules,
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskBank:
    """N tasks and the computer's trials of them in S scenarios.

    Attributes:
        tasks: N tasks.
        scenarios: S scenarios.
        measures: (S, N, 11) M1 to M11; NaN where the end effector did not reach the target.
        end: (S, N) :class:`holdfast.teleop.End`.
        cpm: (S, N) combined performance measures; NaN where the end effector did not reach the target.
        normalisers: (11,) normalisers of the CPM: the largest measures of all these trials.
    """

    tasks: PointTasks
    scenarios: tuple[Scenario, ...]
    measures: FloatArray
    end: NDArray[np.uint8]
    cpm: FloatArray
    normalisers: FloatArray

    @classmethod
    def from_trials(cls, tasks: PointTasks, trials: Trials, scenarios: Sequence[Scenario] = SCENARIO_NAMES) -> TaskBank:
        """Return the bank of N ``tasks`` with their S x N ``trials`` from :func:`run_tasks` in S ``scenarios``."""
        shape = (len(scenarios), len(tasks))
        values = compute_measures(trials).reshape(*shape, RECORDED_MEASURES)
        combined = compute_cpm(values)
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

    def scenario_index(self, law: str, failed: bool) -> int:
        """Return the index of the scenario with control law ``law`` in which the joint has, or has not, ``failed``.

        Raises:
            InputError: There is no such scenario.
        """
        for index, condition in enumerate(self.scenarios):
            if condition.law == law and condition.failed == failed:
                return index
        raise InputError(f"the bank has no scenario with {law} and {'a' if failed else 'no'} failure; run the tasks with one")

    @property
    def difficulty(self) -> FloatArray:
        """Anticipated difficulty (N,): CPM3, the CPM of the failed arm under the pseudoinverse."""
        return np.asarray(self.cpm[self.scenario_index("pseudoinverse", failed=True)])

    @property
    def ratio(self) -> FloatArray:
        """Ratio (N,) CPM4 / CPM3; below 1, the failure-tolerant inverse performs better."""
        return np.asarray(self.cpm[self.scenario_index("failure-tolerant", failed=True)] / self.difficulty)

    def is_completed(self) -> NDArray[np.bool_]:
        """Return (N,) True where the end effector reached the target in every scenario."""
        return np.asarray((self.end == End.ARRIVED).all(axis=0))


@reports_progress("running the tasks")
def make_task_bank(
    arm: Arm,
    per_joint: int = 400,
    joints: Sequence[int | str] | None = None,
    *,
    distance: float = TASK_DISTANCE_M,
    task: str | Task | Sequence[str] = "planar",
    seed: int = 0,
    scenarios: Sequence[Scenario] = SCENARIO_NAMES,
    stick: Joystick | None = None,
    rules: EndRules | None = None,
) -> TaskBank:
    """Sample random tasks and run each under computer control in every scenario.

    Args:
        arm: The arm.
        per_joint: Number of tasks for each joint.
        joints: Names or indices of the joints, from 0. Default: all joints.
        distance: Distance from start to target, m.
        task: Task rows that the joystick moves: 2 or 3 linear ones.
        seed: Seed of the random tasks.
        scenarios: Scenarios of the trials.
        stick: Joystick. Default: that of the paper.
        rules: Rules that end a trial. Default: ``EndRules()``.

    Source: Goel et al. 2003, section 5.
    """
    tasks = sample_tasks(arm, per_joint, joints, distance=distance, task=task, seed=seed)
    return TaskBank.from_trials(
        tasks, run_tasks(arm, tasks, scenarios=scenarios, stick=stick, rules=rules, task=task), scenarios
    )
