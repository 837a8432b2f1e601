"""Whether a goal is within reach of an arm with faults at all: success counts against what was feasible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.faults.entry import SENSOR
from holdfast.faults.events import FaultEvent
from holdfast.reach import reachable_when_locked
from holdfast.recovery import recover
from holdfast.recovery.question import task_of
from holdfast.recovery.rows import row_solver
from holdfast.solvers import solve_ik

Array = NDArray[np.float64]
Answer = Literal["yes", "no", "not found", "unknown"]

_LOCKS = frozenset({"locked", "slipping_clutch"})
_BRAKED = frozenset({"limp", *SENSOR})
_YIELD = 0.02  # rad or m, of a stop
_EXACT = 1e-6  # m and rad: what a motion to the goal itself may be off
_CONFIGURATIONS = 64  # of a goal at which a weak motor is asked to carry the arm


@dataclass(frozen=True)
class Feasibility:
    """Whether a goal is within reach.

    Attributes:
        answer: ``yes``; ``no``, which is proved; ``not found``, which proves nothing; or ``unknown``.
        why: One sentence.
        q: (n,) a configuration at the goal, rad and m; None but for ``yes``.
    """

    answer: Answer
    why: str
    q: Array | None = None


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
    """Whether the tool of an arm with faults can be at a goal, within the joints' limits. No obstacles are looked at.

    A locked joint stays where it is; a free-swinging joint, and one whose sensor cannot be trusted, is locked by its brake. A
    weak motor must carry the arm against gravity at some configuration of the goal. Friction and speed make a goal late, not
    infeasible. Given where the arm is, a motion from there must exist as well, and what is then proved to be impossible is a
    ``no``.

    Args:
        arm: The healthy arm.
        goal: (3,) position or (4, 4) pose of the tool in the world, m.
        places: The faults that are there, with where their joints were at the onset, rad or m.
        task: Rows of the pose that matter; position or pose by the goal if not given.
        within: Angle in rad by which the tool's z axis may be off that of the pose, any turn about it allowed; see
            :func:`holdfast.recover`.
        at: (n,) where the arm is, rad and m; None: a configuration at the goal is enough.
        brakes: Whether the joints have brakes.
        restarts: Random starts of the search.
        tolerance: Largest distance from the goal that counts as success, m, and rad for a pose; at most 1. A motion from ``at``
            is searched for to the goal itself, so what is then proved impossible within a larger tolerance is ``not found``.

    Raises:
        InputError: A goal of another shape, or an unknown joint.
    """
    where = np.asarray(goal, dtype=np.float64)
    if where.shape not in ((3,), (4, 4)):
        raise InputError(f"goal has shape {where.shape}; it must be a position (3,) or a pose (4, 4), m")
    if within is not None and where.ndim == 1:
        raise InputError("within is about the tool's z axis, and the goal is a position (3,); give a pose (4, 4), m")
    rows = task or ("position" if where.ndim == 1 else "pose")
    rows = rows if within is None else task_of(arm, rows, None, within)
    pose = np.eye(4)
    pose[: len(where), 3 if where.ndim == 1 else slice(None)] = where
    held = {e.joint: _within(arm, e.joint, x) for e, x in places.items() if e.kind in _LOCKS or (brakes and e.kind in _BRAKED)}
    left = [e for e in places if e.joint not in held]
    swinging = next((e for e in left if e.kind == "limp"), None)
    weak = {e.joint: float(e.parameters.get("gain", e.parameters.get("ceiling", 0.0))) for e in left if e.kind == "weak"}
    if swinging is not None:
        weak[swinging.joint] = 0.0
    if weak and held:
        return Feasibility("unknown", "locks and weak motors together are not looked at")
    if weak:
        return _carried(arm, pose, rows, within, weak, tolerance)
    ranges = {e.joint: _range(arm, e, places[e]) for e in left if e.kind == "reduced_range"}
    parts = [f"{joint} locked" for joint in held] + [f"{joint} within its reduced range" for joint in ranges]
    what = f"with {' and '.join(parts)}" if parts else "by the healthy arm"
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    if at is not None and parts:
        left_over = Degraded(arm, locked=held, ranges=ranges)
        recovered = _recovered(arm, left_over, at, goal=pose, within=within, rows=rows, what=what)
        unproved = recovered.answer == "no" and tolerance > _EXACT
        return replace(recovered, answer="not found") if unproved else recovered
    if held and ranges:
        return Feasibility("unknown", "locks and reduced ranges together need where the arm is: give at")
    if within is not None:
        remaining = Degraded(arm, locked=held, ranges=ranges) if parts else None
        tilted = _in_cone(arm, remaining, pose, as_task(arm, rows), within, restarts, tolerance)
        if not len(tilted):
            return Feasibility("not found", f"no configuration of the goal was found {what}")
        return Feasibility("yes", f"the goal is reached {what}", tilted[0])
    if held:
        locked = held if len(held) == 1 else Degraded(arm, locked=held)
        found = reachable_when_locked(arm, pose, locked, task=rows, restarts=restarts, tolerance=tolerance)
    else:
        whole = Degraded(arm, ranges=ranges).limited if ranges else arm
        found = solve_ik(whole, pose, task=rows, restarts=restarts, tolerance=tolerance)
    if not found.success:
        return Feasibility("not found", f"no configuration of the goal was found {what}")
    return Feasibility("yes", f"the goal is reached {what}", np.asarray(found.q))


def _within(arm: Arm, name: str, place: float) -> float:
    """Stops give way a little: a joint that is barely beyond one is at it."""
    joint = arm.joints[arm.joint_index(name)]
    inside = float(np.clip(place, joint.lower, joint.upper))
    return inside if abs(inside - place) <= _YIELD else place


def _range(arm: Arm, event: FaultEvent, place: float) -> tuple[float, float]:
    """What is left of a joint's range, as the injector has it: where the joint is belongs to it."""
    joint, numbers = arm.joints[arm.joint_index(event.joint)], event.parameters
    travel = float(numbers.get("travel", 0.0))
    low = place + travel if travel < 0 else min(float(numbers.get("lower", joint.lower)), place)
    high = place + travel if travel > 0 else max(float(numbers.get("upper", joint.upper)), place)
    return max(low, joint.lower), min(high, joint.upper)


def _in_cone(arm: Arm, left: Degraded | None, goal: Array, rows: Task, within: float, restarts: int, tolerance: float) -> Array:
    """Search configurations (K, n) of a goal (4, 4) that leaves the tool's z axis an angle (rad), from random starts."""
    limited, at, free = (arm, np.zeros(arm.n), np.ones(arm.n, bool)) if left is None else (left.limited, left.lo, left.moves)
    solver = row_solver(arm, rows, within).within(limited)
    poses = np.repeat(goal[None], restarts, axis=0)
    q = solver.run(solver.starts(restarts, at, free, np.random.default_rng(0)), poses, np.ones((restarts, solver.rows.m)), free)
    return q[(np.abs(solver.errors(q, poses)) <= tolerance).all(axis=1)]


def _recovered(
    arm: Arm, left: Degraded, at: ArrayLike, *, goal: Array, within: float | None, rows: str | Task, what: str
) -> Feasibility:
    """By a motion of the arm as it is now, or a proof that there is none."""
    found = recover(arm, left, at, goal=goal, within=within, task=rows, samples=0, clearance=False)
    if found.ok:
        return Feasibility("yes", f"a motion to the goal was found {what}", np.asarray(found.q[-1]))
    if found.verdict.kind == "start":
        return Feasibility("unknown", found.verdict.why)
    if found.verdict.answer == "proved infeasible":
        return Feasibility("no", f"{what} it is proved: {found.verdict.why}")
    return Feasibility("not found", f"no motion to the goal was found {what}: {found.verdict.why}")


def _carried(
    arm: Arm, goal: Array, task: str | Task, within: float | None, gains: Mapping[str, float], tolerance: float
) -> Feasibility:
    """Whether weak motors hold the arm against gravity in some configuration of the goal."""
    if within is None:
        found = solve_ik(arm, np.repeat(goal[None], _CONFIGURATIONS, axis=0), task=task, restarts=4, tolerance=tolerance)
        q = found.q[found.success]
    else:
        q = _in_cone(arm, None, goal, as_task(arm, task), within, _CONFIGURATIONS, tolerance)
    if not len(q):
        return Feasibility("not found", "no configuration of the goal was found by the healthy arm")
    joints = [arm.joint_index(joint) for joint in gains]
    effort = np.array([arm.joints[j].effort for j in joints]) * list(gains.values())
    over = (np.abs(arm.gravity_torque(q)[:, joints]) - effort).max(axis=1)
    best, names = int(over.argmin()), " and ".join(gains)
    if over[best] > 0:
        return Feasibility("not found", f"gravity asks more of {names} in each of {len(q)} configurations of the goal")
    return Feasibility("yes", f"{names} can carry the arm at the goal", q[best])
