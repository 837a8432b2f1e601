"""Feasibility of a goal for an arm with faults. A success rate is meaningful relative to the feasible episodes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.solvers import solve_ik
from holdfast.kinematics.workspace import reachable_when_locked
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.model.failure_modes import Degraded
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.kind import find_kind
from holdfast.response.recovery import recover
from holdfast.response.recovery.problem import choose_task
from holdfast.response.recovery.task_rows import make_row_solver

Answer = Literal["yes", "no", "not found", "unknown"]

_STOP_COMPLIANCE = 0.02  # compliance of a stop, rad or m
_EXACT_TOLERANCE = 1e-6  # tolerance of a motion to the exact goal, m and rad
_GRAVITY_TEST_CONFIGURATIONS = 64  # configurations of a goal in which the torque of a weak motor is checked


@dataclass(frozen=True)
class Feasibility:
    """Feasibility of a goal.

    Attributes:
        answer: ``yes``; ``no``, which is proved; ``not found``, which is no proof; or ``unknown``.
        why: Reason, one sentence.
        q: (n,) configuration at the goal, rad and m; None unless the answer is ``yes``.
    """

    answer: Answer
    why: str
    q: FloatArray | None = None


def feasible(
    arm: Arm,
    goal: ArrayLike,
    places: Mapping[FaultEvent, float],
    *,
    task: str | Task | None = None,
    within: float | None = None,
    at: ArrayLike | None = None,
    brakes: bool = True,
    restarts: int = 100,
    tolerance: float = 1e-6,
) -> Feasibility:
    """Check if the tool of an arm with faults can reach a goal within the joint limits. Obstacles are ignored.

    A locked joint keeps its position. A free-swinging joint, and a joint whose sensor cannot be trusted, is locked by its
    brake. A weak motor must carry the arm against gravity in some configuration of the goal. Friction and speed limits delay
    the motion but do not make a goal infeasible. If ``at`` is given, a motion from there to the goal is required as well, and
    the answer is ``no`` if this motion is proved impossible.

    Args:
        arm: The healthy arm.
        goal: (3,) position or (4, 4) pose of the tool in the world, m.
        places: Active faults, with the positions of their joints at the onset, rad or m.
        task: Task whose rows must reach the goal. Default: position or pose, by the shape of the goal.
        within: Angle in rad by which the tool's z axis may deviate from that of the pose, with any rotation about it; see
            :func:`holdfast.recover`.
        at: (n,) current configuration, rad and m. None: a configuration at the goal suffices.
        brakes: True if the joints have brakes.
        restarts: Number of random starts of the search.
        tolerance: Largest distance from the goal that counts as success, m, and rad for a pose; at most 1. A motion from ``at``
            is searched to the exact goal, so an impossibility proof with a larger tolerance counts as ``not found``.

    Raises:
        InputError: The goal has another shape, or a joint is unknown.
    """
    target = np.asarray(goal, dtype=np.float64)
    if target.shape not in ((3,), (4, 4)):
        raise InputError(f"goal has shape {target.shape}; it must be a position (3,) or a pose (4, 4), m")
    if within is not None and target.ndim == 1:
        raise InputError("within is about the tool's z axis, and the goal is a position (3,); give a pose (4, 4), m")
    task_rows = task or ("position" if target.ndim == 1 else "pose")
    task_rows = task_rows if within is None else choose_task(arm, task_rows, None, within)
    pose = np.eye(4)
    pose[: len(target), 3 if target.ndim == 1 else slice(None)] = target
    locked_values, ranges = dict[str, float](), dict[str, tuple[float, float]]()
    weak_gains: dict[str, float] = {}
    for event, position in places.items():
        kind = find_kind(event.kind)
        if kind.holds_joint or (brakes and kind.needs_brake):
            locked_values[event.joint] = _snap_to_limits(arm, event.joint, position)
    for event, position in places.items():
        kind, joint = find_kind(event.kind), arm.joints[arm.joint_index(event.joint)]
        if event.joint in locked_values:
            continue
        gain = kind.torque_fraction(event.parameters)
        if gain is not None:
            weak_gains[event.joint] = min(gain, weak_gains.get(event.joint, gain))
        remaining_range = kind.remaining_range((joint.lower, joint.upper), position, event.parameters)
        if remaining_range is not None:
            ranges[event.joint] = max(remaining_range[0], joint.lower), min(remaining_range[1], joint.upper)
    if weak_gains and locked_values:
        return Feasibility("unknown", "locks and weak motors together are not checked")
    if weak_gains:
        return _check_weak_motor_torques(arm, pose, task_rows, within, weak_gains, tolerance)
    conditions = [f"{joint} locked" for joint in locked_values] + [f"{joint} within its reduced range" for joint in ranges]
    condition_text = f"with {' and '.join(conditions)}" if conditions else "by the healthy arm"
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    if at is not None and conditions:
        remaining_arm = Degraded(arm, locked=locked_values, ranges=ranges)
        recovered = _check_by_recovery(
            arm, remaining_arm, at, goal=pose, within=within, rows=task_rows, condition_text=condition_text
        )
        is_unproved = recovered.answer == "no" and tolerance > _EXACT_TOLERANCE
        return replace(recovered, answer="not found") if is_unproved else recovered
    if locked_values and ranges:
        return Feasibility("unknown", "locks and reduced ranges together need the current configuration; give at")
    if within is not None:
        degraded_arm = Degraded(arm, locked=locked_values, ranges=ranges) if conditions else None
        tilted = _solve_in_cone(arm, degraded_arm, pose, as_task(arm, task_rows), within, restarts, tolerance)
        if not len(tilted):
            return Feasibility("not found", f"no configuration of the goal was found {condition_text}")
        return Feasibility("yes", f"the goal is reached {condition_text}", tilted[0])
    if locked_values:
        locked = locked_values if len(locked_values) == 1 else Degraded(arm, locked=locked_values)
        solution = reachable_when_locked(arm, pose, locked, task=task_rows, restarts=restarts, tolerance=tolerance)
    else:
        limited_arm = Degraded(arm, ranges=ranges).limited if ranges else arm
        solution = solve_ik(limited_arm, pose, task=task_rows, restarts=restarts, tolerance=tolerance)
    if not solution.success:
        return Feasibility("not found", f"no configuration of the goal was found {condition_text}")
    return Feasibility("yes", f"the goal is reached {condition_text}", np.asarray(solution.q))


def _snap_to_limits(arm: Arm, name: str, position: float) -> float:
    """Return the position, or the limit if the position is barely beyond it, because stops give way a little."""
    joint = arm.joints[arm.joint_index(name)]
    limited_position = float(np.clip(position, joint.lower, joint.upper))
    return limited_position if abs(limited_position - position) <= _STOP_COMPLIANCE else position


def _solve_in_cone(
    arm: Arm, degraded: Degraded | None, goal: FloatArray, rows: Task, within: float, restarts: int, tolerance: float
) -> FloatArray:
    """Search configurations (K, n) of a goal (4, 4) whose tool z axis may deviate by an angle (rad), from random starts."""
    limited, q_locked, is_free = arm, np.zeros(arm.n), np.ones(arm.n, bool)
    if degraded is not None:
        limited, q_locked, is_free = degraded.limited, degraded.lo, degraded.moves
    solver = make_row_solver(arm, rows, within).with_limits(limited)
    poses = np.repeat(goal[None], restarts, axis=0)
    starts = solver.sample_configurations(restarts, q_locked, is_free, np.random.default_rng(0))
    q = solver.solve(starts, poses, np.ones((restarts, solver.rows.m)), is_free)
    return q[(np.abs(solver.compute_errors(q, poses)) <= tolerance).all(axis=1)]


def _check_by_recovery(
    arm: Arm,
    degraded: Degraded,
    q_start: ArrayLike,
    *,
    goal: FloatArray,
    within: float | None,
    rows: str | Task,
    condition_text: str,
) -> Feasibility:
    """Return the feasibility from a motion of the arm from its current configuration, or from a proof that there is none."""
    recovery = recover(arm, degraded, q_start, goal=goal, within=within, task=rows, samples=0, clearance=False)
    if recovery.ok:
        return Feasibility("yes", f"a motion to the goal was found {condition_text}", np.asarray(recovery.q[-1]))
    if recovery.verdict.kind == "start":
        return Feasibility("unknown", recovery.verdict.why)
    if recovery.verdict.answer == "proved infeasible":
        return Feasibility("no", f"{condition_text} it is proved: {recovery.verdict.why}")
    return Feasibility("not found", f"no motion to the goal was found {condition_text}: {recovery.verdict.why}")


def _check_weak_motor_torques(
    arm: Arm, goal: FloatArray, task: str | Task, within: float | None, gains: Mapping[str, float], tolerance: float
) -> Feasibility:
    """Return the feasibility from the torque of weak motors against gravity in some configuration of the goal."""
    if within is None:
        solutions = solve_ik(
            arm, np.repeat(goal[None], _GRAVITY_TEST_CONFIGURATIONS, axis=0), task=task, restarts=4, tolerance=tolerance
        )
        q = solutions.q[solutions.success]
    else:
        q = _solve_in_cone(arm, None, goal, as_task(arm, task), within, _GRAVITY_TEST_CONFIGURATIONS, tolerance)
    if not len(q):
        return Feasibility("not found", "no configuration of the goal was found by the healthy arm")
    joints = [arm.joint_index(joint) for joint in gains]
    efforts = np.array([arm.joints[index].effort for index in joints]) * list(gains.values())
    overloads = (np.abs(arm.gravity_torque(q)[:, joints]) - efforts).max(axis=1)
    best, names = int(overloads.argmin()), " and ".join(gains)
    if overloads[best] > 0:
        return Feasibility("not found", f"gravity exceeds the torque of {names} in each of {len(q)} configurations of the goal")
    return Feasibility("yes", f"{names} can carry the arm at the goal", q[best])
