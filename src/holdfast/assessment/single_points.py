"""Single points of failure by structure: joints whose failure ends the task in every configuration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.errors import TaskError
from holdfast.grammar import TASKS
from holdfast.indices.determinants import Manipulability, RelativeManipulability
from holdfast.words import either, number, percent

Array = NDArray[np.float64]

_DRAWS = 256
_MOST, _NAMED = 3, 4  # joints of a set, and sets that are named
_FLAT = 1e-10  # rho^2 of several joints is rounding noise, or that of 1.5708 for pi/2 in a file
_ZERO = 1e-7  # rho of a joint that the self-motion never moves is rounding noise, about 1e-15
WEAK_FRACTION = 0.03  # of the best manipulability: below it the lock of a joint all but ends a task
_NEAR_POINT_M = 0.05  # axes that miss a common point by more do not nearly meet
_LITTLE = 0.01  # rho that is left where axes meet but for half a millimetre, or for the digits of pi/2 in a file


@dataclass(frozen=True, kw_only=True)
class WeakJoint:
    """A joint whose lock leaves little of the manipulability of a task in every configuration.

    Attributes:
        joint: Index from 0.
        manipulability_left: Largest manipulability found once the joint has locked, as a fraction of the largest one found
            of the healthy arm.
        best: Largest relative manipulability found after the worst single failure, which is compared with the bound.
        bound: The value no configuration can exceed.
        axis_distance: Distance in metres by which the three axes before or after the joint miss a common point, the larger
            of both; None where they are not three, not revolute, or do not nearly meet.
    """

    joint: int
    manipulability_left: float
    best: float
    bound: float
    axis_distance: float | None


@dataclass(frozen=True, kw_only=True)
class Structure:
    """The effect of locking each joint on a task whatever the configuration.

    Attributes:
        task: Name of the task.
        redundancy: Joints minus rows; 0 or less means that any lock ends the task.
        fatal: Joints, indices from 0, without which the task is singular in every configuration.
        never: The healthy arm itself is singular for the task in every configuration.
        together: Sets of two and three joints that do so when they lock at once and no fewer of them do; of those alone that
            leave as many joints as the task has rows.
        nearly: Joints, indices from 0, whose lock leaves almost nothing, and the most of it that was found, above 0 and
            at most 0.01: axes that would meet but for the rounding or the calibration in the arm's file.
        weak: Joints whose lock leaves at most 3 % of the best manipulability; they are no single points of failure by
            structure, but nearly.
    """

    task: str
    redundancy: int
    fatal: tuple[int, ...]
    never: bool
    together: tuple[tuple[int, ...], ...] = ()
    nearly: tuple[tuple[int, float], ...] = ()
    weak: tuple[WeakJoint, ...] = ()

    @property
    def survives(self) -> bool:
        """True if no single lock ends the task by structure, or all but ends it."""
        return self.redundancy > 0 and not self.fatal and not self.nearly and not self.never


def structure(arm: Arm, task: str | Task | Sequence[str] = "pose") -> Structure:
    """Find the joints whose lock makes a task singular everywhere.

    A joint is one if its relative manipulability vanishes at each of 256 random configurations (seeded): a function that
    is analytic in q and zero there is zero everywhere, up to events of probability zero.
    """
    t = as_task(arm, task)
    redundancy = arm.n - t.m
    if redundancy <= 0:
        return Structure(task=t.name, redundancy=redundancy, fatal=tuple(range(arm.n)), never=False)
    generator = np.random.default_rng(20120514)
    # Not the joint limits: a narrow range could hide what another part of it shows.
    q = generator.uniform(-np.pi, np.pi, (_DRAWS, arm.n))
    index = RelativeManipulability(arm, t)
    result = index.evaluate(q)
    most = result.by_failure.max(axis=0)
    fatal = tuple(np.flatnonzero(most < _ZERO).tolist())
    nearly = tuple((int(k), float(most[k])) for k in np.flatnonzero((most >= _ZERO) & (most <= _LITTLE)))
    never = bool((result.value == 0).all() and (result.by_failure == 0).all())
    together = () if never else _together(index.task_jacobian(q), fatal)
    weak = () if never or fatal or nearly else _weak_joints(arm, t, q, result.by_failure, index.bound or 1.0)
    return Structure(task=t.name, redundancy=redundancy, fatal=fatal, never=never, together=together, nearly=nearly, weak=weak)


def _weak_joints(arm: Arm, task: Task, q: Array, by_failure: Array, bound: float) -> tuple[WeakJoint, ...]:
    """Find the joints after whose lock the largest manipulability at q (N, n) is at most 3 % of the healthy one."""
    after_lock = Manipulability(arm, task).by_joint(q)
    healthy = np.divide(after_lock, by_failure, out=np.zeros_like(after_lock), where=by_failure > 0).max()
    left = after_lock.max(axis=0) / (healthy or 1.0)
    best = float(by_failure.min(axis=1).max())
    return tuple(
        WeakJoint(
            joint=int(k),
            manipulability_left=float(left[k]),
            best=best,
            bound=bound,
            axis_distance=_distance_from_common_points(arm, int(k)),
        )
        for k in np.flatnonzero(left <= WEAK_FRACTION)
    )


def _distance_from_common_points(arm: Arm, joint: int) -> float | None:
    """Measure how far the three axes before and the three after a joint are from meeting in a point each, in metres."""
    groups = [range(joint - 3, joint), range(joint + 1, joint + 4)]
    if joint < 3 or joint + 3 >= arm.n or arm.prismatic[[k for group in groups for k in group]].any():
        return None
    frames = arm.frames(np.full(arm.n, 0.5))[1:-1]  # the distances of neighbouring axes are the same at every configuration
    axes = [frames[k][:3, :3] @ each.axis for k, each in enumerate(arm.joints)]
    most = 0.0
    for group in groups:
        near = [_nearest_points(frames[k][:3, 3], axes[k], frames[k + 1][:3, 3], axes[k + 1]) for k in group[:2]]
        if any(pair is None for pair in near):
            return None
        (first, on_middle), (again_on_middle, last) = (pair for pair in near if pair is not None)
        gaps = (first - on_middle, again_on_middle - on_middle, last - again_on_middle)
        most = max(most, *(float(np.linalg.norm(gap)) for gap in gaps))
    return most if most <= _NEAR_POINT_M else None


def _nearest_points(p: Array, u: Array, r: Array, v: Array) -> tuple[Array, Array] | None:
    """Find the nearest points of the lines p + s u and r + t v, unit vectors u and v; None for parallel lines."""
    across = float(u @ v)
    if 1 - across**2 < _FLAT:
        return None
    gap = r - p
    s, t = np.linalg.solve([[1.0, -across], [across, -1.0]], [u @ gap, v @ gap])
    return p + s * u, r + t * v


def _together(jacobians: Array, fatal: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Least sets of two and three joints whose minors of the null-space projector vanish for all Jacobians (N, m, n)."""
    m, n = jacobians.shape[1:]
    rows = np.linalg.svd(jacobians)[2][:, :m]
    projector = np.eye(n) - np.swapaxes(rows, 1, 2) @ rows
    found = [frozenset({k}) for k in fatal]
    for size in range(2, min(_MOST, n - m) + 1):
        for some in combinations(range(n), size):
            if any(less <= set(some) for less in found):
                continue
            if np.linalg.det(projector[:, some][:, :, some]).max() < _FLAT:
                found.append(frozenset(some))
    return tuple(tuple(sorted(s)) for s in found if len(s) > 1)


def structures(arm: Arm) -> list[Structure]:
    """The structure of every task that the arm's kind of motion has, the most demanding first."""
    flat = plane_normal(arm) is not None
    found = []
    for name in sorted((name for name in TASKS if name.startswith("planar") == flat), key=TASKS.__getitem__, reverse=True):
        try:
            found.append(structure(arm, name))
        except TaskError:
            continue
    return found


def explain(arm: Arm, found: Structure, others: list[Structure]) -> str:
    """One or two sentences for people about one task, with the tasks that do survive."""
    survivors = [s.task for s in others if s.survives and not s.weak and s.task != found.task]
    instead = f" A task that every single lock leaves possible: {', '.join(survivors)}." if survivors else ""
    if found.never:
        return f"'{arm.name}' can never do task '{found.task}': it is singular in every configuration.{instead}"
    if found.redundancy <= 0:
        return f"'{arm.name}' is not redundant for task '{found.task}': any locked joint ends it.{instead}"
    if found.weak:
        return " ".join(_describe_weak(arm, found, each) for each in found.weak) + instead
    if not found.fatal and not found.nearly:
        sets = [" + ".join(arm.joint_names[k] for k in s) for s in found.together]
        more = f" and {len(sets) - _NAMED} more" if len(sets) > _NAMED else ""
        also = f" Sets whose locks together end it in every configuration: {', '.join(sets[:_NAMED])}{more}." if sets else ""
        return f"No single joint of '{arm.name}' is a point of failure by structure for task '{found.task}'.{also}"
    parts = []
    if found.fatal:
        parts.append(
            f"Single point of failure by structure: once {_either(arm, found.fatal)} locks, '{arm.name}' is singular for task "
            f"'{found.task}' in every configuration, however well it is chosen."
        )
    for k, left in found.nearly:
        parts.append(
            f"All but a single point of failure by structure: once {_either(arm, [k])} locks, '{arm.name}' has at most "
            f"{number(left)} of its manipulability for task '{found.task}' left, at each of {_DRAWS} random configurations."
        )
    return " ".join(parts) + instead


def _describe_weak(arm: Arm, found: Structure, weak: WeakJoint) -> str:
    text = (
        f"No joint of '{arm.name}' is exactly a single point of failure for task '{found.task}', but "
        f"{_either(arm, [weak.joint])} nearly is: its lock leaves at most {percent(weak.manipulability_left)} of the best "
        f"manipulability, and at {_DRAWS} random configurations the best relative manipulability after the worst lock is "
        f"{number(weak.best)} of at most {number(weak.bound)}."
    )
    if weak.axis_distance is not None:
        text += (
            f" The three axes before the joint, or the three after it, miss a common point by "
            f"{1000 * weak.axis_distance:.2g} mm."
        )
    return text


def _either(arm: Arm, joints: Sequence[int]) -> str:
    return either([f"{arm.joint_names[k]} (joint {k + 1})" for k in joints])
