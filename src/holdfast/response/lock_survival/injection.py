"""Test locks of a motion at random times with an integrator that is independent of the lock tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.probability.intervals import Interval
from holdfast.core.progress import ProgressCount
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.response.lock_survival import tables
from holdfast.response.lock_survival.lock_evaluation import MAX_CHANGING_SETS, can_reach_remaining_poses, is_off_path
from holdfast.response.lock_survival.problem import SurvivalProblem

_ARC_STEP = 0.02  # step along the branch, in rad, m, and fifths of the duration
_DURATION_WEIGHT_RAD = 5.0  # weight of the duration relative to joints, rad
_MAX_ARC_LENGTH = 60.0  # largest length of a branch, in the same unit
_FINAL_ERROR_TOLERANCE = 1e-3  # m and rad at the end; a larger error means that the integration failed


@dataclass(frozen=True, eq=False, kw_only=True)
class LockTests:
    """Results of N locks at random times.

    Attributes:
        time: (N,) times of the locks, s.
        joint: (N,) index of the locked joint.
        survived: (N,) True where the failed arm finished the path.
        expected: (N,) prediction at the last sample before the lock.
        told: (N,) True where the next sample has the same prediction; between samples that differ there is no prediction.
        interval: Confidence interval of the probability that a lock is survived.
    """

    time: FloatArray
    joint: IndexArray
    survived: BoolArray
    expected: BoolArray
    told: BoolArray
    interval: Interval

    @property
    def agreement(self) -> float:
        """Fraction of the locks with a predicted outcome for which the test has the same outcome."""
        return float((self.survived == self.expected)[self.told].mean()) if self.told.any() else 1.0

    @property
    def disagreements(self) -> list[tuple[float, int]]:
        """Time in s and joint index of the locks with a predicted outcome that the test contradicts."""
        is_different = self.told & (self.survived != self.expected)
        return list(zip(self.time[is_different].tolist(), self.joint[is_different].tolist(), strict=True))


def sample_lock_times(
    problem: SurvivalProblem, lock_count: int, generator: np.random.Generator
) -> tuple[FloatArray, IndexArray]:
    """Sample times (N,) and joints (N,): joints by their rates; times uniformly, or as first failures within the duration."""
    rates, duration = problem.rates, problem.path.duration
    joints = generator.choice(problem.arm.n, size=lock_count, p=rates.each / rates.total)
    uniform_values = generator.uniform(size=lock_count)
    if rates.per_second:
        failure_probability = -np.expm1(-rates.total * duration)
        return -np.log1p(-uniform_values * failure_probability) / rates.total, joints
    return uniform_values * duration, joints


def can_finish_path(
    problem: SurvivalProblem, q: FloatArray, lock_times: FloatArray, locked_joints: IndexArray, *, q_start: FloatArray
) -> BoolArray:
    """Return (N,) True where the arm, at q (N, n) on the path at time (N,) with joint (N,) locked there, finishes the path.

    Its motion began at ``q_start`` (n,).
    """
    if problem.mode == "detour":
        return can_reach_remaining_poses(problem, q, np.searchsorted(problem.time, lock_times), locked_joints)
    if problem.redundancy == 1:
        return _reaches_last_pose(problem, q, lock_times, locked_joints, tuple(problem.immobile_joints))
    survived = np.zeros(len(q), dtype=bool)
    for fixed_joints in problem.fixed_joint_sets:  # the failed arm may fix any of these sets
        undecided = np.flatnonzero(~survived & ~np.isin(locked_joints, fixed_joints))
        survived[undecided] = _reaches_last_pose(
            problem, q[undecided], lock_times[undecided], locked_joints[undecided], (*problem.immobile_joints, *fixed_joints)
        )
    narrower = problem.with_axis_at(q_start)
    if narrower is not None:
        undecided = np.flatnonzero(~survived & ~is_off_path(narrower, q, narrower.path.pose(lock_times)))
        survived[undecided] = can_finish_path(
            narrower, q[undecided], lock_times[undecided], locked_joints[undecided], q_start=q_start
        )
    undecided = np.flatnonzero(~survived)
    survived[undecided] = _can_finish_by_switching(problem, q[undecided], lock_times[undecided], locked_joints[undecided])
    return survived


def _can_finish_by_switching(
    problem: SurvivalProblem, q: FloatArray, lock_times: FloatArray, locked_joints: IndexArray
) -> BoolArray:
    """Return (N,) True where a redundant arm, which may fix other joints at every sample, finishes the path."""
    configurations, lock_indices = q[:0], np.empty(0, dtype=np.int64)
    first_samples = np.searchsorted(problem.time, lock_times, side="right")
    for sample in range(1, len(problem.time)):
        new_locks = np.flatnonzero(np.minimum(first_samples, len(problem.time) - 1) == sample)
        configurations, lock_indices = np.concatenate([configurations, q[new_locks]]), np.concatenate([lock_indices, new_locks])
        start_times = np.maximum(lock_times[lock_indices], problem.time[sample - 1])
        landed, landed_locks = [configurations[:0]], [lock_indices[:0]]
        for fixed_joints in problem.fixed_joint_sets[:MAX_CHANGING_SETS]:
            selected = np.flatnonzero(~np.isin(locked_joints[lock_indices], fixed_joints))
            stopped_joints = locked_joints[lock_indices[selected]], (*problem.immobile_joints, *fixed_joints)
            end_configurations, has_arrived = _follow_branch(
                problem, configurations[selected], start_times[selected], stopped_joints, problem.time[sample]
            )
            landed.append(end_configurations[has_arrived])
            landed_locks.append(lock_indices[selected[has_arrived]])
        configurations, lock_indices = np.concatenate(landed), np.concatenate(landed_locks)
        selected = tables.select_farthest_by_owner(configurations, lock_indices)
        configurations, lock_indices = configurations[selected], lock_indices[selected]
    survived = np.zeros(len(q), dtype=bool)
    survived[lock_indices[_are_on_last_pose(problem, configurations)]] = True
    return survived


def _reaches_last_pose(
    problem: SurvivalProblem, q: FloatArray, lock_times: FloatArray, locked_joints: IndexArray, fixed_joints: tuple[int, ...]
) -> BoolArray:
    """Return (N,) True where the branch through (joints, time) leads to the last pose."""
    locks = locked_joints, fixed_joints
    end_configurations, has_arrived = _follow_branch(problem, q, lock_times, locks, problem.path.duration)
    has_arrived[has_arrived] = _are_on_last_pose(problem, end_configurations[has_arrived])
    return has_arrived


def _follow_branch(
    problem: SurvivalProblem,
    q: FloatArray,
    lock_times: FloatArray,
    stopped_joints: tuple[IndexArray, tuple[int, ...]],
    end_time: float,
) -> tuple[FloatArray, BoolArray]:
    """Follow the branch through (joints, time) to a time; return its end, and True where it reaches that time.

    The branch is followed by its arc length, with fourth-order Runge-Kutta steps. A branch ends where time reverses on it,
    because there is no continuation along the path.
    """
    arm, scale = problem.arm, _DURATION_WEIGHT_RAD / problem.path.duration
    locked_joints, fixed_joints = stopped_joints
    scaled_end = end_time * scale
    end_configurations, reached = np.full(q.shape, np.nan), np.zeros(len(q), dtype=bool)
    active = np.arange(len(q))
    state = np.column_stack([q, lock_times * scale])
    tangent = np.zeros(state.shape)
    tangent[:, -1] = 1.0
    with ProgressCount("locks", len(q)) as add_progress:
        for _ in range(int(_MAX_ARC_LENGTH / _ARC_STEP)):
            if not active.size:
                break
            active_joints = locked_joints[active]
            first = _compute_tangent(problem, state, (active_joints, fixed_joints), tangent, scale)
            second = _compute_tangent(problem, state + _ARC_STEP / 2 * first, (active_joints, fixed_joints), first, scale)
            third = _compute_tangent(problem, state + _ARC_STEP / 2 * second, (active_joints, fixed_joints), second, scale)
            fourth = _compute_tangent(problem, state + _ARC_STEP * third, (active_joints, fixed_joints), third, scale)
            state = state + _ARC_STEP / 6 * (first + 2 * second + 2 * third + fourth)
            tangent = fourth
            is_past_end = (state[:, -1] >= scaled_end) & (fourth[:, -1] > 0)
            # A branch that has passed the end is evaluated at the end, not at the end of its step.
            overshoot = np.where(is_past_end, (state[:, -1] - scaled_end) / np.where(is_past_end, fourth[:, -1], 1.0), 0.0)
            configurations = state[:, :-1] - overshoot[:, None] * fourth[:, :-1]
            is_valid = ((configurations >= arm.lower - 1e-9) & (configurations <= arm.upper + 1e-9)).all(axis=1) & (
                fourth[:, -1] > 0
            )
            is_valid[is_valid] = problem.conditions.are_met(configurations[is_valid], 1e-9)
            arrived = np.flatnonzero(is_past_end & is_valid)
            end_configurations[active[arrived]], reached[active[arrived]] = configurations[arrived], True
            is_active = is_valid & ~is_past_end
            add_progress(int(np.count_nonzero(~is_active)))
            active, state, tangent = active[is_active], state[is_active], tangent[is_active]
    return end_configurations, reached


def _are_on_last_pose(problem: SurvivalProblem, q: FloatArray) -> BoolArray:
    """Return True for branches that passed the end on the last pose."""
    last_poses = np.broadcast_to(problem.lock.poses[-1], (len(q), 4, 4))
    return np.asarray(
        np.max(solver(problem.arm, problem.task).position_and_rotation_errors(q, last_poses), axis=0, initial=0.0)
        <= _FINAL_ERROR_TOLERANCE
    )


def _compute_tangent(
    problem: SurvivalProblem,
    state: FloatArray,
    stopped_joints: tuple[IndexArray, tuple[int, ...]],
    previous: FloatArray,
    scale: float,
) -> FloatArray:
    """Return the unit tangent (N, n + 1) of the branch at (joints, scaled time), in the direction of ``previous``."""
    arm, task = problem.arm, problem.task
    n, rows = arm.n, np.arange(len(state))
    path_times = np.clip(state[:, -1] / scale, 0.0, problem.path.duration * (1 - 1e-12))
    twist = problem.path.twist(path_times) / scale
    columns = np.concatenate([arm.jacobian(state[:, :-1]), -twist[:, :, None]], axis=2)
    if task.frame == "tool":
        inverse_rotations = arm.forward_kinematics(state[:, :-1])[:, :3, :3].transpose(0, 2, 1)
        columns = np.concatenate([inverse_rotations @ columns[:, :3], inverse_rotations @ columns[:, 3:]], axis=1)
    system = np.zeros((len(state), n + 1, n + 1))
    system[:, : task.m] = task.rows @ columns
    locked_joints, fixed_joints = stopped_joints
    system[rows, task.m, locked_joints] = 1.0
    for row, fixed_joint in enumerate(fixed_joints):
        system[:, task.m + 1 + row, fixed_joint] = 1.0
    system[:, n] = previous
    right_side = np.zeros((len(state), n + 1, 1))
    right_side[:, n] = 1.0
    try:
        tangent = np.linalg.solve(system, right_side)[:, :, 0]
    except np.linalg.LinAlgError:
        tangent = (np.linalg.pinv(system) @ right_side)[:, :, 0]
    return np.asarray(tangent / np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), 1e-300))


def interpolate_motion(problem: SurvivalProblem, q: FloatArray, times: FloatArray) -> FloatArray:
    """Return a motion (T, n) at times (N,), projected to the pose at that time and to the joint limits.

    A motion that keeps the axis of a cone fixed at its samples does so between them.
    """
    narrower = problem.with_axis_at(q[0])
    if narrower is not None and not is_off_path(narrower, q).any():
        return interpolate_motion(narrower, q, times)
    arm = problem.arm
    sample = np.clip(np.searchsorted(problem.time, times, side="right") - 1, 0, len(q) - 2)
    fractions = (times - problem.time[sample]) / np.diff(problem.time)[sample]
    interpolated = q[sample] + fractions[:, None] * joint_space.joint_difference(arm, q[sample + 1], q[sample])
    poses = problem.path.pose(times)
    corrected_q = problem.lock.tracer.project_onto_poses(interpolated, poses)[0]
    inside = np.clip(corrected_q, arm.lower, arm.upper)
    if problem.redundancy > 1:
        return problem.conditions.project_configurations(inside, poses)
    beyond = np.flatnonzero((corrected_q != inside).any(axis=1))  # for a motion along a limit
    limiting_joints = np.abs(corrected_q - inside)[beyond].argmax(axis=1)
    limited_q, is_solved = problem.lock.solve_poses(inside[beyond], limiting_joints, poses[beyond])
    corrected_q[beyond[is_solved]] = limited_q[is_solved]
    return corrected_q
