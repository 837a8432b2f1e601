"""Whether a goal is within reach of an arm with faults at all: success counts against what was feasible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.faults.entry import SENSOR
from holdfast.faults.events import FaultEvent
from holdfast.reach import reachable_when_locked
from holdfast.solvers import solve_ik

Array = NDArray[np.float64]
Answer = Literal["yes", "not found", "unknown"]

_LOCKS = frozenset({"locked", "slipping_clutch"})
_BRAKED = frozenset({"limp", *SENSOR})
_CONFIGURATIONS = 64  # of a goal at which a weak motor is asked to carry the arm


@dataclass(frozen=True)
class Feasibility:
    """Whether a goal is within reach.

    Attributes:
        answer: ``yes``; ``not found``, which proves nothing; or ``unknown``.
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
    brakes: bool = True,
    restarts: int = 100,
) -> Feasibility:
    """Whether the tool of an arm with faults can be at a goal, within the joints' limits. No obstacles are looked at.

    A locked joint stays where it is; a free-swinging joint, and one whose sensor cannot be trusted, is locked by its brake. A
    weak motor must carry the arm against gravity at some configuration of the goal. Friction and speed make a goal late, not
    infeasible.

    Args:
        arm: The healthy arm.
        goal: (3,) position or (4, 4) pose of the tool in the world, m.
        places: The faults that are there, with where their joints were at the onset, rad or m.
        task: Rows of the pose that matter; position or pose by the goal if not given.
        brakes: Whether the joints have brakes.
        restarts: Random starts of the search.

    Raises:
        InputError: A goal of another shape, or an unknown joint.
    """
    where = np.asarray(goal, dtype=np.float64)
    if where.shape not in ((3,), (4, 4)):
        raise InputError(f"goal has shape {where.shape}; it must be a position (3,) or a pose (4, 4), m")
    rows = task or ("position" if where.ndim == 1 else "pose")
    pose = np.eye(4)
    pose[: len(where), 3 if where.ndim == 1 else slice(None)] = where
    held = {e.joint: place for e, place in places.items() if e.kind in _LOCKS or (brakes and e.kind in _BRAKED)}
    left = [e for e in places if e.joint not in held]
    swinging = next((e for e in left if e.kind == "limp"), None)
    weak = {e.joint: float(e.parameters.get("gain", e.parameters.get("ceiling", 0.0))) for e in left if e.kind == "weak"}
    if swinging is not None:
        weak[swinging.joint] = 0.0
    if weak and held:
        return Feasibility("unknown", "locks and weak motors together are not looked at")
    if weak:
        return _carried(arm, pose, rows, weak)
    limited = next((e for e in left if e.kind == "reduced_range"), None)
    if limited is not None:
        return Feasibility("unknown", f"how far {limited.joint} still moves is not looked at")
    if held:
        locked = held if len(held) == 1 else Degraded(arm, locked=held)
        found = reachable_when_locked(arm, where, locked, task=rows, restarts=restarts)
        what = "with " + " and ".join(f"{joint} locked" for joint in held)
    else:
        found, what = solve_ik(arm, pose, task=rows, restarts=restarts), "by the healthy arm"
    if not found.success:
        return Feasibility("not found", f"no configuration of the goal was found {what}")
    return Feasibility("yes", f"the goal is reached {what}", np.asarray(found.q))


def _carried(arm: Arm, goal: Array, task: str | Task, gains: Mapping[str, float]) -> Feasibility:
    """Whether weak motors hold the arm against gravity in some configuration of the goal."""
    found = solve_ik(arm, np.repeat(goal[None], _CONFIGURATIONS, axis=0), task=task, restarts=4)
    q = found.q[found.success]
    if not len(q):
        return Feasibility("not found", "no configuration of the goal was found by the healthy arm")
    joints = [arm.joint_index(joint) for joint in gains]
    effort = np.array([arm.joints[j].effort for j in joints]) * list(gains.values())
    over = (np.abs(arm.gravity_torque(q)[:, joints]) - effort).max(axis=1)
    best, names = int(over.argmin()), " and ".join(gains)
    if over[best] > 0:
        return Feasibility("not found", f"gravity asks more of {names} in each of {len(q)} configurations of the goal")
    return Feasibility("yes", f"{names} can carry the arm at the goal", q[best])
