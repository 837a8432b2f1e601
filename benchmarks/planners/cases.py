"""Cases of the suite, all from one seed: a failure, the start configuration, and the task.

The suite is rebuilt from what is public of DEFT (arXiv 2602.02895): its own sampling, tolerances and split could not be read.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths import Path, line, sequence
from holdfast.kinematics.tool_constraints import ToolConstraint, upright
from holdfast.model.arm import Arm
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.task import Task, as_task, task_from_rows
from holdfast.model.collision import Clearance
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.task_rows import make_row_solver

Rng = np.random.Generator

_MAX_SAMPLES = 4000  # configurations drawn before a case counts as impossible to draw
# _LANE_COUNT, _LANE_LENGTH_M and _LANE_SPACING_M: of wiping: lanes, and m of each and between two
_LANE_COUNT = 3
_LANE_LENGTH_M = 0.2
_LANE_SPACING_M = 0.04
_MAX_TILT_RAD = np.deg2rad(2)  # by which the tool may lean where it is kept upright
_FAILURE_KINDS = ("lock", "range", "speed")
_KIND_PROBABILITIES = (0.5, 0.3, 0.2)  # how often each is drawn


@dataclass(frozen=True, eq=False)
class BenchmarkCase:
    """Failure, start configuration, and task of one benchmark case.

    Attributes:
        task: Its name, a key of ``CASE_MAKERS``.
        degraded: What has failed.
        at: (n,) where the arm is, rad and m: within what is left, and clear.
        rows: Of the end effector's pose that matter.
        goal: (4, 4) pose to be reached, world, m; None if a path is to be followed.
        path: To be followed; None if a pose is to be reached.
        keep: What must be kept along the whole motion.
    """

    task: str
    degraded: Degraded
    at: FloatArray
    _: KW_ONLY
    rows: Task
    goal: FloatArray | None = None
    path: Path | None = None
    keep: tuple[ToolConstraint, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return everything that defines the case, as JSON data."""
        failed = self.degraded
        corners = None if self.path is None else self.path.pose(self.path.bounds).tolist()
        return {
            "task": self.task,
            "locked": dict(failed.locked),
            "range": {name: list(limits) for name, limits in failed.ranges.items()},
            "speed": dict(failed.speeds),
            "at": self.at.tolist(),
            "rows": self.rows.to_dict(),
            "goal": None if self.goal is None else self.goal.tolist(),
            "path": corners,
            **({"keep": [constraint.to_dict() for constraint in self.keep]} if self.keep else {}),
        }


def sample_failure(arm: Arm, max_joints: int, rng: Rng) -> Degraded:
    """Sample one to ``max_joints`` joints, each locked, with a reduced range, or slower.

    The number is uniform; of each joint a lock, a range, a speed with probability 0.5, 0.3, 0.2. A lock is uniform within the
    limits, a range a fraction from 0.1 to 0.7 of them anywhere, a speed a fraction from 0.1 to 0.5.
    """
    lower, upper = sampling_limits(arm)
    failures: dict[str, dict[str, Any]] = {kind: {} for kind in _FAILURE_KINDS}
    for index in rng.choice(arm.n, size=rng.integers(1, max_joints + 1), replace=False):
        kind = _FAILURE_KINDS[rng.choice(len(_FAILURE_KINDS), p=_KIND_PROBABILITIES)]
        width = (upper[index] - lower[index]) * rng.uniform(0.1, 0.7)
        range_start = rng.uniform(lower[index], upper[index] - width)
        values = {
            "lock": rng.uniform(lower[index], upper[index]),
            "range": (range_start, range_start + width),
            "speed": rng.uniform(0.1, 0.5),
        }
        failures[kind][arm.joint_names[index]] = values[kind]
    return Degraded(arm, locked=failures["lock"], ranges=failures["range"], speeds=failures["speed"])


class CaseSampler:
    """Sampler of the cases of an arm and the objects that it must avoid."""

    def __init__(self, arm: Arm, clearance: Clearance | None) -> None:
        self.arm, self.clearance = arm, clearance
        self._pointing_solver = make_row_solver(arm, task_from_rows(["wx", "wy"], frame="tool"))

    def sample_case(self, task: str, rng: Rng) -> BenchmarkCase:
        """Return a case of a task.

        Raises:
            InputError: No such task, or no case of it was found.
        """
        if task not in CASE_MAKERS:
            raise InputError(f"task '{task}' of the suite is not known; use {', '.join(CASE_MAKERS)}")
        return CASE_MAKERS[task](self, task, rng)

    # ---- configurations ----------------------------------------------------------------------------------------------

    def is_collision_free(self, q: FloatArray) -> NDArray[np.bool_]:
        """Return (N,) True for collision-free configurations (N, n)."""
        if self.clearance is None:
            return np.ones(len(q), dtype=bool)
        return np.asarray(self.clearance.margin_left(q) >= 0)

    def sample_configuration(self, lower: FloatArray, upper: FloatArray, rng: Rng) -> FloatArray:
        """Return a collision-free configuration (n,), uniform between the limits (n,) each."""
        for _ in range(_MAX_SAMPLES // 40):
            q = rng.uniform(lower, upper, (40, self.arm.n))
            valid = np.flatnonzero(self.is_collision_free(q))
            if valid.size:
                return np.asarray(q[valid[0]])
        raise NoValidSampleError

    def sample_pointing_down(self, lower: FloatArray, upper: FloatArray, rng: Rng) -> FloatArray:
        """Return a collision-free configuration (n,) whose tool z axis points straight down."""
        is_movable = upper > lower
        downward_pose = np.diag([1.0, -1.0, -1.0, 1.0])
        for _ in range(_MAX_SAMPLES // 40):
            q = rng.uniform(lower, upper, (40, self.arm.n))
            poses = np.tile(downward_pose, (len(q), 1, 1))
            weights = np.ones((len(q), 2))
            q = self._pointing_solver.solve(q, poses, weights, is_movable)
            within_limits = ((q >= lower) & (q <= upper) | ~is_movable).all(axis=1)
            valid = np.flatnonzero(
                within_limits & self._pointing_solver.meets_rows(q, poses, weights, is_movable) & self.is_collision_free(q)
            )
            if valid.size:
                return np.asarray(q[valid[0]])
        raise NoValidSampleError


class NoValidSampleError(Exception):
    """Exception for a failure for which no valid configuration was found; another failure is sampled then."""


def _finite_degraded_limits(degraded: Degraded) -> tuple[FloatArray, FloatArray]:
    """Return the finite limits in force."""
    lower, upper = sampling_limits(degraded.limited)
    is_movable = degraded.moves
    return np.where(is_movable, lower, degraded.lo), np.where(is_movable, upper, degraded.hi)


def _retry_failures(
    make_case: Callable[[CaseSampler, str, Rng], BenchmarkCase],
) -> Callable[[CaseSampler, str, Rng], BenchmarkCase]:
    """Wrap a function that makes a case so that it tries other failures until one allows a case."""

    def make_with_retries(draw: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
        for _ in range(100):
            try:
                return make_case(draw, task, rng)
            except NoValidSampleError:
                continue
        raise InputError(f"no case of '{task}' could be drawn for '{draw.arm.name}': hardly any configuration of it is clear")

    return make_with_retries


# ---- tasks ---------------------------------------------------------------------------------------------------------------


@_retry_failures
def _make_reach_case(sampler: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
    """Make a case whose goal is the pose of a collision-free configuration of the degraded or of the healthy arm."""
    arm, degraded = sampler.arm, sample_failure(sampler.arm, 3, rng)
    limits = _finite_degraded_limits(degraded)
    start = sampler.sample_configuration(*limits, rng)
    goal_configuration = sampler.sample_configuration(*(sampling_limits(arm) if "healthy" in task else limits), rng)
    return BenchmarkCase(
        task, degraded, start, rows=as_task(arm, task.rpartition("-")[2]), goal=arm.forward_kinematics(goal_configuration)
    )


@_retry_failures
def _make_line_case(sampler: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
    """Make a case of a 0.3 m line in a random direction at constant orientation, or of 0.25 m back along the tool axis, as for
    a drawer.
    """
    degraded = sample_failure(sampler.arm, 2, rng)
    start = sampler.sample_configuration(*_finite_degraded_limits(degraded), rng)
    start_pose = sampler.arm.forward_kinematics(start)
    displacement = rng.normal(size=3)
    displacement = -0.25 * start_pose[:3, 2] if task == "drawer" else 0.3 * displacement / np.linalg.norm(displacement)
    return BenchmarkCase(
        task,
        degraded,
        start,
        rows=as_task(sampler.arm, "pose"),
        path=line(start_pose, _translate_pose(start_pose, displacement)),
    )


@_retry_failures
def _make_wipe_case(sampler: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
    """Make a case of three lanes in the plane normal to the tool axis, whose direction is constant; rotation about
    it is free.
    """
    degraded = sample_failure(sampler.arm, 2, rng)
    start = sampler.sample_configuration(*_finite_degraded_limits(degraded), rng)
    start_pose = sampler.arm.forward_kinematics(start)
    poses, x, y = [start_pose], 0.0, 0.0
    for lane_index in range(_LANE_COUNT):
        x = _LANE_LENGTH_M - x
        poses.append(_translate_pose(start_pose, x * start_pose[:3, 0] + y * start_pose[:3, 1]))
        if lane_index < _LANE_COUNT - 1:
            y += _LANE_SPACING_M
            poses.append(_translate_pose(start_pose, x * start_pose[:3, 0] + y * start_pose[:3, 1]))
    return BenchmarkCase(task, degraded, start, rows=as_task(sampler.arm, "pointing"), path=sequence(poses))


@_retry_failures
def _make_tray_case(sampler: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
    """Make a case of a horizontal 0.3 m line with the tool straight down; rotation about the vertical is free."""
    degraded = sample_failure(sampler.arm, 2, rng)
    start = sampler.sample_pointing_down(*_finite_degraded_limits(degraded), rng)
    start_pose = sampler.arm.forward_kinematics(start)
    angle = rng.uniform(0, 2 * np.pi)
    displacement = 0.3 * np.array([np.cos(angle), np.sin(angle), 0.0])
    return BenchmarkCase(
        task,
        degraded,
        start,
        rows=as_task(sampler.arm, "pointing"),
        path=line(start_pose, _translate_pose(start_pose, displacement)),
    )


@_retry_failures
def _make_upright_case(sampler: CaseSampler, task: str, rng: Rng) -> BenchmarkCase:
    """Make a case between two configurations with the tool straight down, where the tool may tilt by at most 2 deg
    on the path.
    """
    degraded = sample_failure(sampler.arm, 2, rng)
    start, goal_configuration = (sampler.sample_pointing_down(*_finite_degraded_limits(degraded), rng) for _ in range(2))
    goal = sampler.arm.forward_kinematics(goal_configuration)
    constraint = upright(_MAX_TILT_RAD).anchor(sampler.arm.forward_kinematics(start))
    return BenchmarkCase(task, degraded, start, rows=as_task(sampler.arm, "pose"), goal=goal, keep=(constraint,))


def _translate_pose(pose: FloatArray, displacement: FloatArray) -> FloatArray:
    translated = pose.copy()
    translated[:3, 3] += displacement
    return translated


CASE_MAKERS: dict[str, Callable[[CaseSampler, str, Rng], BenchmarkCase]] = {
    "reach-pose": _make_reach_case,
    "reach-pointing": _make_reach_case,
    "reach-position": _make_reach_case,
    "reach-healthy-pose": _make_reach_case,
    "reach-healthy-pointing": _make_reach_case,
    "reach-healthy-position": _make_reach_case,
    "line": _make_line_case,
    "drawer": _make_line_case,
    "wipe": _make_wipe_case,
    "tray": _make_tray_case,
    "upright": _make_upright_case,
}
