"""Point-to-point motion without a path that is least exposed to locks after which the goal is out of reach."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import HoldfastError, InputError, TaskError
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.self_motions import TRACING_STARTS, SelfMotion, fibres, make_tracer
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, target_pose
from holdfast.response.lock_survival.rates import FailureRates, RatesLike

Spans = list[tuple[float, float]]

_REFINED_NODES = 20  # best nodes around which the goal is refined
_POINTS_PER_SEGMENT = 32


@dataclass(frozen=True, eq=False, kw_only=True)
class Approach:
    """Motion from a start to a goal pose in which each joint moves independently at its velocity limit.

    Attributes:
        arm, task: Arm, and the rows of the goal that matter.
        rates: Failure rates of the joints.
        start, goal: (n,) first configuration, and final configuration at the goal pose, rad and m.
        outside: (n,) time in s that each joint spends at values at which a lock loses the goal.
        ranges: Values of each joint at which it may lock while the goal stays within reach, as intervals ``(low, high)``.
        velocity: (n,) speeds of the joints, rad/s and m/s.
    """

    arm: Arm
    task: Task
    rates: FailureRates
    start: FloatArray
    goal: FloatArray
    outside: FloatArray
    ranges: Sequence[Spans]
    velocity: FloatArray

    @property
    def exposure(self) -> float:
        """Exposure ``sum rate_i outside_i``: with rates in 1/s the expected number of locks that lose the goal, else in s."""
        return float(self.rates.each @ self.outside)

    @property
    def duration(self) -> float:
        """Time in s until the last joint is at its goal."""
        return float((np.abs(self.goal - self.start) / self.velocity).max())

    def positions_at(self, time: ArrayLike) -> FloatArray:
        """Return the joints (n,) or (N, n), rad and m, at ``time``, one or (N,), s; each moves to its goal and waits there."""
        travels = np.asarray(time, dtype=np.float64)[..., None] * self.velocity
        displacement = self.goal - self.start
        return np.asarray(self.start + np.sign(displacement) * np.minimum(travels, np.abs(displacement)))


@check_arguments
@reports_progress("searching for the safest motion to the goal")
def plan_motion_to(
    arm: Arm,
    start: ArrayLike,
    goal: ArrayLike,
    *,
    rates: RatesLike | FailureRates | None = None,
    per_second: bool = False,
    task: str | Task | Sequence[str] = "pose",
    velocity: ArrayLike | None = None,
    spacing: float = 0.02,
    seed: int = 0,
    starts: int = TRACING_STARTS,
) -> Approach:
    """Plan the motion to a goal pose with the least exposure to locks after which the goal is out of reach.

    Without obstacles, a lock of joint i loses nothing if some configuration of the goal has the locked value. Each joint must
    travel from its start to its goal independently of the others, so its shortest time outside such values is that at its
    velocity limit. All joints attain this time if each moves at its own limit. The optimum over all motions is therefore a
    minimum over the configurations of the goal.

    Args:
        arm: Arm that moves; with obstacles in the way the exposure is a lower bound.
        start: (n,) configuration, rad and m, or (4, 4) pose, for which the best configuration is chosen.
        goal: (m,) for tasks without angular rows, or (4, 4), as for :func:`holdfast.self_motion`.
        rates: Failure rates, (n,) or by joint name, as relative weights. Default: 1 each.
        per_second: True if the rates are in 1/s.
        task: Task whose rows must reach the goal.
        velocity: (n,) or one number, rad/s and m/s. Default: the joints' velocity limits.
        spacing: Distance of the points on the self-motion curves, rad.
        seed: Seed of the search for these curves.
        starts: Random starts of that search per pose.

    Raises:
        InputError: The start, goal, rates or velocities are invalid, or a joint has no velocity limit.
        TaskError: The arm has no or more than one degree of redundancy.
        HoldfastError: No configuration of the goal, or of the start, was found.

    Source: ranges of a joint over a self-motion manifold, Lewis and Maciejewski 1997; the closed form is ours.
    """
    task_rows = as_task(arm, task)
    if arm.n - task_rows.m != 1:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{task_rows.name}' {task_rows.m} rows; one joint more than "
            f"rows is needed"
        )
    failing = FailureRates.for_arm(arm, rates, per_second=per_second)
    max_speeds = require_real_numbers([joint.velocity for joint in arm.joints] if velocity is None else velocity, "velocity")
    if max_speeds.shape not in ((), (arm.n,)) or not (np.isfinite(max_speeds) & (max_speeds > 0)).all():
        raise InputError(
            f"velocity is {max_speeds.tolist()}; give one number or {arm.n}, finite and above 0, for the joints of '{arm.name}'"
        )
    max_speeds = np.broadcast_to(max_speeds, arm.n)
    options = {"spacing": spacing, "seed": seed, "starts": starts}
    goal_self_motion = _require_configuration(fibres(arm, target_pose(task_rows, goal), task_rows, **options)[0], "goal")  # type: ignore[arg-type]
    if np.shape(start) == (4, 4):
        start_configurations = _require_configuration(fibres(arm, start, task_rows, **options)[0], "start").q  # type: ignore[arg-type]
    else:
        start_configurations = arm.check_configurations(start)[None]
        if start_configurations.shape != (1, arm.n) or not np.isfinite(start_configurations).all():
            raise InputError(f"the start of '{arm.name}' must be one configuration of {arm.n} finite numbers, or a pose (4, 4)")
        if ((start_configurations < arm.lower) | (start_configurations > arm.upper)).any():
            raise InputError("the start lies outside the joint limits")
    exposures = _JointExposure(arm, goal_self_motion.arcs(), failing.each / max_speeds)
    best_start, best_goal = exposures.choose_start_and_goal(start_configurations, goal_self_motion.q)
    best_goal = _refine_goal(exposures, goal_self_motion, best_start, best_goal)
    if len(start_configurations) > 1:
        best_start, _ = exposures.choose_start_and_goal(start_configurations, best_goal[None])
    unwound_goal, outside = exposures.choose_goal_revolutions(best_start, best_goal)
    return Approach(
        arm=arm,
        task=task_rows,
        rates=failing,
        start=best_start,
        goal=unwound_goal,
        outside=outside / max_speeds,
        ranges=exposures.safe_ranges,
        velocity=max_speeds,
    )


def _require_configuration(self_motion: SelfMotion, end_name: str) -> SelfMotion:
    if not len(self_motion.q):
        raise HoldfastError(f"no configuration of the {end_name} was found: {self_motion.summary}")
    return self_motion


class _JointExposure:
    """Lengths that joints travel at values at which a lock loses the goal.

    Attributes:
        safe_ranges: Values of each joint at which a lock does not lose the goal.
    """

    def __init__(self, arm: Arm, safe_ranges: list[Spans], weights: FloatArray) -> None:
        self.arm, self.safe_ranges, self._weights = arm, safe_ranges, weights
        is_unlimited = joint_space.is_unlimited(arm)
        revolutions = [count * 2 * np.pi for count in range(-3, 4)]
        self._safe_spans = [
            sorted((lower + offset, upper + offset) for lower, upper in spans for offset in (revolutions if circle else [0.0]))
            for spans, circle in zip(safe_ranges, is_unlimited, strict=True)
        ]

    def _measure_unsafe_length(self, joint: int, values: FloatArray) -> FloatArray:
        """Return the length of the values that lose the goal between 0 and each value, negative below 0."""
        safe_lengths = np.zeros(values.shape)
        for lower, upper in self._safe_spans[joint]:
            safe_lengths += np.clip(values, lower, upper) - np.clip(0.0, lower, upper)
        return np.asarray(values - safe_lengths)

    def _choose_direction(self, joint: int, start: FloatArray, goal: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the end of joint k from a to b, which broadcast, in the less exposed direction, and its unsafe length."""
        if not joint_space.is_unlimited(self.arm)[joint]:
            return goal + 0 * start, np.abs(
                self._measure_unsafe_length(joint, goal) - self._measure_unsafe_length(joint, start)
            )
        unsafe_at_start = self._measure_unsafe_length(joint, start)
        shorter_end = start + np.arctan2(np.sin(goal - start), np.cos(goal - start))
        longer_end = shorter_end - np.sign(shorter_end - start) * 2 * np.pi
        shorter_cost, longer_cost = (
            np.abs(self._measure_unsafe_length(joint, end) - unsafe_at_start) for end in (shorter_end, longer_end)
        )
        return np.where(longer_cost < shorter_cost - 1e-12, longer_end, shorter_end), np.minimum(shorter_cost, longer_cost)

    def choose_start_and_goal(self, starts: FloatArray, ends: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the least exposed pair of starts (S, n) and ends (G, n); among equals the shortest motion."""
        costs, lengths = np.zeros((len(starts), len(ends))), np.zeros((len(starts), len(ends)))
        for joint, weight in enumerate(self._weights):
            joint_ends, unsafe_lengths = self._choose_direction(joint, starts[:, None, joint], ends[None, :, joint])
            costs += weight * unsafe_lengths
            lengths += np.abs(joint_ends - starts[:, None, joint])
        best = np.argwhere(costs <= costs.min() + 1e-12)
        start_index, end_index = best[lengths[best[:, 0], best[:, 1]].argmin()]
        return starts[start_index], ends[end_index]

    def compute_exposures(self, start: FloatArray, ends: FloatArray) -> FloatArray:
        """Return the costs (G,) of the ends (G, n) for one start."""
        return np.asarray(
            sum(
                weight * self._choose_direction(joint, start[joint], ends[:, joint])[1]
                for joint, weight in enumerate(self._weights)
            )
        )

    def choose_goal_revolutions(self, start: FloatArray, goal: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the joints at the goal, with the best number of revolutions, and the unsafe length of each."""
        ends, unsafe_lengths = zip(
            *(self._choose_direction(joint, start[joint : joint + 1], goal[joint : joint + 1]) for joint in range(self.arm.n)),
            strict=True,
        )
        return np.concatenate(ends), np.concatenate(unsafe_lengths)


def _refine_goal(exposures: _JointExposure, self_motion: SelfMotion, start: FloatArray, goal: FloatArray) -> FloatArray:
    """Refine the best goal between the nodes: subdivide the pieces next to the best nodes and bring them back to the pose."""
    pieces = [np.stack([component.q[:-1], component.q[1:]], axis=1) for component in self_motion.components]
    pieces += [
        np.stack(
            [component.q[-1], component.q[-1] + joint_space.joint_difference(self_motion.arm, component.q[0], component.q[-1])]
        )[None]
        for component in self_motion.components
        if component.closed
    ]
    segments = np.concatenate(pieces)
    segment_costs = np.minimum(
        exposures.compute_exposures(start, segments[:, 0]), exposures.compute_exposures(start, segments[:, 1])
    )
    best_segments = segments[np.argsort(segment_costs, kind="stable")[:_REFINED_NODES]]
    fractions = np.linspace(0, 1, _POINTS_PER_SEGMENT + 1)[:, None, None]
    interpolated = (best_segments[:, 0] + fractions * (best_segments[:, 1] - best_segments[:, 0])).reshape(
        -1, self_motion.arm.n
    )
    poses = np.broadcast_to(self_motion.pose, (len(interpolated), 4, 4))
    corrected_q, is_on_pose, _ = make_tracer(self_motion.arm, self_motion.task).project_onto_poses(interpolated, poses)
    inside = is_on_pose & ((corrected_q >= self_motion.arm.lower) & (corrected_q <= self_motion.arm.upper)).all(axis=1)
    return exposures.choose_start_and_goal(start[None], np.concatenate([goal[None], corrected_q[inside]]))[1]
