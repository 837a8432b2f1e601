"""Self-motions that isolate a locked joint: planned, and evaluated from the tool's measured pose alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.files.output import write_table
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.paths.joint_table import joint_columns
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotations_of_quaternions
from holdfast.model.arm.task import Task, as_task
from holdfast.model.collision.clearance import Clearance
from holdfast.response.diagnosis.detectability.motions import resample_motion
from holdfast.response.diagnosis.detectability.separation import (
    LOG_LIKELIHOOD_THRESHOLD,
    hypothesis_separations,
    inseparable_pairs,
    inverse_pose_deviations,
    null_space,
    pose_differences,
    project_to_task,
    self_motion_rates,
    tool_poses_by_hypothesis,
    undetectable_joints,
)
from holdfast.response.diagnosis.sensors import Sensors
from holdfast.response.faults.log import Log

PLAN_RATE_HZ = 100.0  # sample rate of the plan, Hz
REST_BEFORE_S = 0.2
REST_AFTER_S = 0.3
RAMP_TIME_S = 0.3  # duration of acceleration and of deceleration, s
_LIMIT_MARGIN = 0.05  # smallest distance from a joint limit, rad or m
_DIRECTION_COUNT = 24
_MAX_LEGS = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class ProbingMotion(Result):
    """Self-motion with the locks that it can isolate. Joints count from 0; hypothesis 0 is that no joint is locked.

    Attributes:
        arm: Arm that executes the motion.
        task: Task whose value stays constant along the motion.
        suspects: Candidate joints, which may be locked.
        t: (T,) sample times, s.
        q: (T, n) references, rad and m.
        separation: (n + 1, n + 1) separation of the hypotheses "healthy" and "joint locked", in nats; above 9.2, two are
            separable.
        visible: (n,) largest rate of each joint over self-motions of unit rate at the start.
        sensors: Accuracy of the measured pose.
        tool: Largest position error of the tool on the plan, m.
    """

    arm: Arm
    task: Task
    suspects: tuple[int, ...]
    t: FloatArray
    q: FloatArray
    separation: FloatArray
    visible: FloatArray
    sensors: Sensors
    tool: float

    @cached_property
    def untestable(self) -> tuple[str, ...]:
        """Candidate joints whose lock the tool's pose does not reveal on this motion."""
        return tuple(self.arm.joint_names[joint] for joint in undetectable_joints(self.separation, self.suspects))

    @cached_property
    def inseparable(self) -> tuple[tuple[str, str], ...]:
        """Pairs of testable candidate joints that the motion does not distinguish."""
        names = self.arm.joint_names
        return tuple((names[first], names[second]) for first, second in inseparable_pairs(self.separation, self.suspects))

    @property
    def isolable(self) -> tuple[str, ...]:
        """Candidate joints that are distinguished from a healthy arm and from every other candidate joint."""
        inseparable = {name for pair in self.inseparable for name in pair}
        names = [self.arm.joint_names[joint] for joint in self.suspects]
        return tuple(name for name in names if name not in self.untestable and name not in inseparable)

    def to_csv(self, file: str | Path) -> Path:
        """Write the references to the CSV file ``file`` with ``time_s`` and one column for each joint, and return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        return write_table(file, "probe", ["time_s", *joint_columns(self.arm)], np.column_stack([self.t, self.q]))

    def resample(self, rate: float) -> FloatArray:
        """Return the references (K, n) at the sample rate ``rate``, Hz, by linear interpolation of the plan."""
        return resample_motion(self.q, PLAN_RATE_HZ, rate)

    def decide(self, log: Log) -> Identification:
        """Identify the locked joint from a ``log`` of this motion; see :func:`holdfast.response.diagnosis.identify`."""
        return identify(self.arm, log, suspects=[self.arm.joint_names[joint] for joint in self.suspects], sensors=self.sensors)


@dataclass(frozen=True, eq=False, kw_only=True)
class Identification(Result):
    """Identification of a locked joint from a log of a probing motion.

    Attributes:
        joint: Name of the locked joint; None if the test is inconclusive or no candidate joint is locked.
        remaining: Hypotheses that explain the pose about as well as the best one: joints, and "none" for no lock.
        cleared: Joints that are not locked, because no lock explains the pose far better.
        time: Time of the decision, or of the end of the log, s.
        displacement: Distance of the measured tool at that time from its position at rest, m.
    """

    joint: str | None
    remaining: tuple[str, ...]
    cleared: tuple[str, ...]
    time: float
    displacement: float


@check_arguments
@reports_progress("planning a self-motion")
def plan_identification(
    arm: Arm,
    q: ArrayLike,
    *,
    suspects: Sequence[str | int] | None = None,
    task: str | Task | Sequence[str] = "pose",
    duration: float = 5.0,
    speed: float = 0.25,
    sensors: Sensors | None = None,
    clearance: Clearance | None = None,
    margin: float = 0.0,
    seed: int = 0,
) -> ProbingMotion:
    """Plan a self-motion from which the tool pose alone reveals which joint is locked.

    With one degree of redundancy, the planner compares the two directions, and with more, 24 random directions. It chooses the
    direction that separates the most pairs of candidate joints. While some pairs remain, it adds a leg, up to three in total.

    Args:
        arm: Arm that executes the motion.
        q: (n,) start configuration, rad and m.
        suspects: Candidate joints, by name or index from 0. Default: all joints.
        task: Task whose value stays constant.
        duration: Longest duration of each leg, s.
        speed: Norm of the joint rates, rad/s and m/s.
        sensors: Accuracy of the measured pose. Default: ``Sensors()``.
        clearance: Collision model for the plan and for the motion under the lock of every candidate joint. None: collisions
            are not checked.
        margin: Smallest distance to objects and between links, m; used with ``clearance``.
        seed: Seed of the random directions.

    Raises:
        InputError: A joint is unknown, the arm is not redundant for the task, the time is too short to move, or the start
            configuration is not collision-free.

    Source: derived here; the bound on the information in any motion is Wald's.
    """
    required_task, sensors = as_task(arm, task), sensors or Sensors()
    start = arm.check_configurations(q)
    if start.ndim != 1:
        raise InputError(f"q has shape {start.shape}; it must be one configuration")
    if arm.n <= required_task.m:
        raise InputError(
            f"'{arm.name}' has no redundancy for task '{required_task.name}', so it has no self-motions; choose fewer rows"
        )
    if not duration > 2 * RAMP_TIME_S or not speed > 0:
        raise InputError(f"duration is {duration:g} s and speed {speed:g}; they must be above {2 * RAMP_TIME_S:g} and above 0")
    if clearance is not None and not clearance(start) > margin:
        raise InputError("the start configuration collides, or is closer than the margin to itself or the cell; choose another")
    chosen = tuple(range(arm.n)) if suspects is None else tuple(arm.joint_index(candidate) for candidate in suspects)
    motion = np.repeat(start[None], round(REST_BEFORE_S * PLAN_RATE_HZ), axis=0)
    rng, best_score = np.random.default_rng(seed), (-1, 0.0)
    hypothesis_indices = [0, *(candidate_index + 1 for candidate_index in chosen)]
    pairs = len(hypothesis_indices) * (len(hypothesis_indices) - 1) // 2
    for _ in range(_MAX_LEGS):
        curves = _trace_self_motions(arm, required_task, motion[-1], start, (duration - RAMP_TIME_S) * speed, speed, rng)
        legs = [_time_curve(curve, speed) for curve in curves]
        legs = [_truncate_before_collision(arm, motion, leg, chosen, clearance, margin) for leg in legs]
        trials, selection = [np.concatenate([motion, leg]) for leg in legs], np.ix_(hypothesis_indices, hypothesis_indices)
        scores = [_score_separation(hypothesis_separations(arm, trial, sensors)[selection]) for trial in trials]
        best_trial = max(range(len(trials)), key=lambda k: scores[k])
        if scores[best_trial] <= best_score:
            break
        motion, best_score = trials[best_trial], scores[best_trial]
        if best_score[0] == pairs:
            break
    motion = np.concatenate([motion, np.repeat(motion[-1:], round(REST_AFTER_S * PLAN_RATE_HZ), axis=0)])
    poses = arm.forward_kinematics(motion)
    tool_errors = project_to_task(arm, required_task, motion, pose_differences(poses, poses[0])[..., None])[..., 0]
    return ProbingMotion(
        arm=arm,
        task=required_task,
        suspects=chosen,
        t=np.arange(len(motion)) / PLAN_RATE_HZ,
        q=motion,
        separation=hypothesis_separations(arm, motion, sensors),
        visible=self_motion_rates(arm, start, required_task),
        sensors=sensors,
        tool=float(np.linalg.norm(tool_errors, axis=1).max()),
    )


@check_arguments
def identify(
    arm: Arm, log: Log, *, suspects: Sequence[str | int] | None = None, sensors: Sensors | None = None
) -> Identification:
    """Identify the locked joint from the measured tool pose on a motion alone, without the joint sensors.

    Samples are processed in order until one hypothesis leads all others by ``ln 10^4``. The mean pose at rest before the
    motion is subtracted.

    Args:
        arm: Arm that was recorded.
        log: Log with the tool pose that begins at rest, with the lock present from its beginning.
        suspects: Candidate joints, by name or index from 0. Default: all joints.
        sensors: Accuracy of the measured pose. Default: ``Sensors()``.

    Raises:
        InputError: The number of joints differs, or the log has no pose, or none before the references move.

    Source: derived here, a sequential likelihood ratio test (Wald).
    """
    if log.n != arm.n:
        raise InputError(f"the log has {log.n} joints and '{arm.name}' has {arm.n}; give the arm that was recorded")
    if log.x is None or log.quat is None:
        raise InputError("the log has no measured pose of the tool; record x and quat")
    chosen = tuple(range(arm.n)) if suspects is None else tuple(arm.joint_index(candidate) for candidate in suspects)
    pose_rows = np.flatnonzero(np.isfinite(log.x).all(axis=1) & np.isfinite(log.quat).all(axis=1))
    is_moving = np.abs(log.q_ref - log.q_ref[0]).max(axis=1) > 1e-9
    resting = pose_rows[pose_rows < (int(is_moving.argmax()) if is_moving.any() else len(is_moving))]
    if not resting.size:
        raise InputError("the log has no tool pose before the references move; begin the log at rest")
    measured = np.zeros((len(pose_rows), 4, 4))
    measured[:, :3, :3], measured[:, :3, 3] = rotations_of_quaternions(log.quat[pose_rows]), log.x[pose_rows]
    motion = np.concatenate([log.q_ref[:1], log.q_ref[pose_rows]])
    hypothesis_indices = [0, *(candidate_index + 1 for candidate_index in chosen)]
    pose_errors = pose_differences(measured, tool_poses_by_hypothesis(arm, motion)[hypothesis_indices, 1:])
    pose_errors -= pose_errors[:, : len(resting)].mean(axis=1, keepdims=True)
    log_likelihoods = -np.cumsum(((pose_errors * inverse_pose_deviations(sensors or Sensors())) ** 2).sum(axis=2), axis=1) / 2
    runner_up = np.sort(log_likelihoods, axis=0)[-2]
    is_decided = log_likelihoods.max(axis=0) - runner_up > LOG_LIKELIHOOD_THRESHOLD
    row = int(is_decided.argmax()) if is_decided.any() else len(pose_rows) - 1
    final_likelihoods, names = log_likelihoods[:, row], np.array(["none", *(arm.joint_names[joint] for joint in chosen)])
    is_remaining = final_likelihoods.max() - final_likelihoods <= LOG_LIKELIHOOD_THRESHOLD
    is_cleared = final_likelihoods[0] - final_likelihoods[1:] > LOG_LIKELIHOOD_THRESHOLD
    remaining = tuple(names[is_remaining].tolist())
    return Identification(
        joint=remaining[0] if remaining[1:] == () and remaining[0] != "none" else None,
        remaining=remaining,
        cleared=tuple(names[1:][is_cleared].tolist()),
        time=float(log.t[pose_rows[row]]),
        displacement=float(np.linalg.norm(log.x[pose_rows[row]] - log.x[resting].mean(axis=0))),
    )


def _score_separation(separation: FloatArray) -> tuple[int, float]:
    """Return the number of separable pairs of hypotheses, and a measure of how well they are separated."""
    pair_separations = separation[np.triu_indices(len(separation), 1)]
    total = float(np.minimum(pair_separations, 3 * LOG_LIKELIHOOD_THRESHOLD).sum())
    return int((pair_separations > LOG_LIKELIHOOD_THRESHOLD).sum()), total


def _trace_self_motions(
    arm: Arm, task: Task, start: FloatArray, home: FloatArray, length: float, speed: float, rng: np.random.Generator
) -> list[FloatArray]:
    """Trace curves (K, n) of the self-motion from ``start``, in steps of 1/100 s at ``speed``, until the joint limits stop
    them.
    """
    step_length = speed / PLAN_RATE_HZ
    _, null_basis = null_space(arm, task, start[None])
    if null_basis.shape[2] == 1:
        directions = np.array([null_basis[0, :, 0], -null_basis[0, :, 0]])
    else:
        directions = rng.normal(size=(_DIRECTION_COUNT, null_basis.shape[2])) @ null_basis[0].T
    tangents = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    configurations, tool_pose = np.repeat(start[None], len(tangents), axis=0), arm.forward_kinematics(home)
    curves, count, is_active = [configurations], np.ones(len(tangents), dtype=int), np.ones(len(tangents), dtype=bool)
    # A start within the margin of a limit may move away from the limit.
    lower, upper = np.minimum(arm.lower + _LIMIT_MARGIN, start), np.maximum(arm.upper - _LIMIT_MARGIN, start)
    for _ in range(int(length / step_length)):
        inverse, null_basis = null_space(arm, task, configurations)
        tangents = np.einsum("bnk,bmk,bm->bn", null_basis, null_basis, tangents)
        norms = np.linalg.norm(tangents, axis=1, keepdims=True)
        tangents = tangents / np.maximum(norms, 1e-12)
        pose_errors = pose_differences(tool_pose, arm.forward_kinematics(configurations))[..., None]
        task_errors = project_to_task(arm, task, configurations, pose_errors)
        next_q = configurations + step_length * tangents + 0.5 * (inverse @ task_errors)[..., 0]
        is_active &= (norms[:, 0] > 1e-6) & ((next_q >= lower) & (next_q <= upper)).all(axis=1)
        if not is_active.any():
            break
        configurations = np.where(is_active[:, None], next_q, configurations)
        curves.append(configurations)
        count += is_active
    all_curves = np.stack(curves, axis=1)
    return [all_curves[index, : count[index]] for index in range(len(tangents))]


def _time_curve(curve: FloatArray, speed: float) -> FloatArray:
    """Turn a curve in steps of 1/100 s at ``speed`` into a motion that accelerates and decelerates within 0.3 s each."""
    length = (len(curve) - 1) * speed / PLAN_RATE_HZ
    ramp = min(RAMP_TIME_S, length / speed)
    total = length / speed + ramp
    times = np.arange(1, int(np.ceil(total * PLAN_RATE_HZ)) + 1) / PLAN_RATE_HZ
    accelerated = np.minimum(times, ramp) ** 2 / (2 * max(ramp, 1e-9)) + np.maximum(times - ramp, 0.0)
    decelerated = np.maximum(times - (total - ramp), 0.0) ** 2 / (2 * max(ramp, 1e-9))
    arc_length = np.clip((accelerated - decelerated) * speed, 0.0, length)
    curve_lengths = np.arange(len(curve)) * speed / PLAN_RATE_HZ
    return np.stack([np.interp(arc_length, curve_lengths, column) for column in curve.T], axis=1)


def _truncate_before_collision(
    arm: Arm,
    earlier_motion: FloatArray,
    leg: FloatArray,
    candidates: tuple[int, ...],
    clearance: Clearance | None,
    margin: float,
) -> FloatArray:
    """Return the part of a leg that is collision-free with any single candidate joint locked."""
    if clearance is None or not len(leg):
        return leg
    is_free = np.asarray(clearance(leg)) > margin
    for joint in candidates:
        locked = leg.copy()
        locked[:, joint] = earlier_motion[0, joint]
        is_free &= np.asarray(clearance(locked)) > margin
    return leg[: len(leg) if is_free.all() else int((~is_free).argmax())]
