"""Single points of failure by structure: joints whose failure ends the task in every configuration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from holdfast.core.errors import TaskError
from holdfast.core.formatting import format_number, format_percent, list_alternatives
from holdfast.core.labels import TASK_SIZES
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.determinants import Manipulability, RelativeManipulability
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, plane_normal

_SAMPLE_CONFIGURATIONS = 256
# Largest number of joints in a set, and of sets that a text names.
_MAX_SET_SIZE = 3
_MAX_NAMED_SETS = 4
_SQUARED_RHO_TOLERANCE = 1e-10  # a smaller rho^2 of several joints is due to rounding, also of 1.5708 for pi/2 in a file
_ZERO_RHO = 1e-7  # a smaller rho is due to rounding, which is about 1e-15
WEAK_FRACTION = 0.03  # fraction of the best manipulability below which the lock of a joint nearly ends a task
_NEAR_POINT_M = 0.05  # axes that miss a common point by more do not nearly meet
_NEARLY_ZERO_RHO = 0.01  # rho that remains if axes miss each other by half a millimetre, or by the digits of pi/2 in a file


@dataclass(frozen=True, kw_only=True)
class WeakJoint:
    """Joint whose lock leaves little of the manipulability of a task in every configuration.

    Attributes:
        joint: Index from 0.
        manipulability_left: Largest manipulability found after the joint has locked, as a fraction of the largest one found
            for the healthy arm.
        best: Largest relative manipulability found after the worst single failure, for comparison with the bound.
        bound: Value that no configuration can exceed.
        axis_distance: Distance, m, by which the three axes before or after the joint miss a common point, the larger of both;
            None if there are not three revolute axes, or if they do not nearly meet.
    """

    joint: int
    manipulability_left: float
    best: float
    bound: float
    axis_distance: float | None


@dataclass(frozen=True, kw_only=True)
class Structure:
    """Effect of locking each joint on a task, for any configuration.

    Attributes:
        task: Name of the task.
        redundancy: Number of joints minus rows of the task; if it is 0 or less, any lock ends the task.
        fatal: Indices from 0 of the joints after whose lock the task is singular in every configuration.
        never: True if the healthy arm is singular for the task in every configuration.
        together: Minimal sets of two and three joints after whose simultaneous lock the task is singular in every
            configuration, among the sets that leave as many joints as the task has rows.
        nearly: Indices from 0 of joints whose lock leaves almost no relative manipulability, and its largest value found, above
            0 and at most 0.01. Their axes miss each other only by the rounding or the calibration in the arm's file.
        weak: Joints whose lock leaves at most 3 % of the best manipulability; they are nearly single points of failure.
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
        """True if no single lock ends the task, or nearly ends it, by structure."""
        return self.redundancy > 0 and not self.fatal and not self.nearly and not self.never


def structure(arm: Arm, task: str | Task | Sequence[str] = "pose") -> Structure:
    """Find the joints whose lock makes a task singular in every configuration.

    These are the joints whose relative manipulability vanishes at each of 256 random configurations (with a fixed seed). A
    function that is analytic in q and zero at these configurations is zero everywhere, up to events of probability zero.

    Args:
        arm: The arm.
        task: Task, or its name or components.
    """
    arm_task = as_task(arm, task)
    redundancy = arm.n - arm_task.m
    if redundancy <= 0:
        return Structure(task=arm_task.name, redundancy=redundancy, fatal=tuple(range(arm.n)), never=False)
    generator = np.random.default_rng(20120514)
    # Joint limits are ignored, because a narrow range could hide the structure.
    q = generator.uniform(-np.pi, np.pi, (_SAMPLE_CONFIGURATIONS, arm.n))
    index = RelativeManipulability(arm, arm_task)
    result = index.evaluate(q)
    largest = result.by_failure.max(axis=0)
    fatal = tuple(np.flatnonzero(largest < _ZERO_RHO).tolist())
    nearly = tuple(
        (int(joint), float(largest[joint])) for joint in np.flatnonzero((largest >= _ZERO_RHO) & (largest <= _NEARLY_ZERO_RHO))
    )
    never = bool((result.value == 0).all() and (result.by_failure == 0).all())
    together = () if never else _find_fatal_sets(index.task_jacobian(q), fatal)
    weak = () if never or fatal or nearly else _find_weak_joints(arm, arm_task, q, result.by_failure, index.bound or 1.0)
    return Structure(
        task=arm_task.name, redundancy=redundancy, fatal=fatal, never=never, together=together, nearly=nearly, weak=weak
    )


def _find_weak_joints(arm: Arm, task: Task, q: FloatArray, by_failure: FloatArray, bound: float) -> tuple[WeakJoint, ...]:
    """Find the joints after whose lock the largest manipulability at q (N, n) is at most 3 % of the healthy one."""
    after_lock = Manipulability(arm, task).by_joint(q)
    healthy = np.divide(after_lock, by_failure, out=np.zeros_like(after_lock), where=by_failure > 0).max()
    fractions = after_lock.max(axis=0) / (healthy or 1.0)
    best = float(by_failure.min(axis=1).max())
    return tuple(
        WeakJoint(
            joint=int(joint),
            manipulability_left=float(fractions[joint]),
            best=best,
            bound=bound,
            axis_distance=_measure_concurrency_error(arm, int(joint)),
        )
        for joint in np.flatnonzero(fractions <= WEAK_FRACTION)
    )


def _measure_concurrency_error(arm: Arm, joint: int) -> float | None:
    """Measure by how many metres the three axes before and the three after a joint miss a common point."""
    groups = [range(joint - 3, joint), range(joint + 1, joint + 4)]
    if joint < 3 or joint + 3 >= arm.n or arm.prismatic[[number for group in groups for number in group]].any():
        return None
    frames = arm.frames(np.full(arm.n, 0.5))[1:-1]  # the distances of neighbouring axes are the same at every configuration
    axes = [frames[number][:3, :3] @ axis_joint.axis for number, axis_joint in enumerate(arm.joints)]
    largest = 0.0
    for group in groups:
        nearest = [
            _find_nearest_points(frames[number][:3, 3], axes[number], frames[number + 1][:3, 3], axes[number + 1])
            for number in group[:2]
        ]
        if any(pair is None for pair in nearest):
            return None
        (first, on_middle), (again_on_middle, last) = (pair for pair in nearest if pair is not None)
        gaps = (first - on_middle, again_on_middle - on_middle, last - again_on_middle)
        largest = max(largest, *(float(np.linalg.norm(gap)) for gap in gaps))
    return largest if largest <= _NEAR_POINT_M else None


def _find_nearest_points(p: FloatArray, u: FloatArray, r: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Find the nearest points of the lines p + s u and r + t v, unit vectors u and v; None for parallel lines."""
    cosine = float(u @ v)
    if 1 - cosine**2 < _SQUARED_RHO_TOLERANCE:
        return None
    gap = r - p
    s, t = np.linalg.solve([[1.0, -cosine], [cosine, -1.0]], [u @ gap, v @ gap])
    return p + s * u, r + t * v


def _find_fatal_sets(jacobians: FloatArray, fatal: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Return the minimal sets of two and three joints with vanishing minors of the null-space projector for all Jacobians."""
    m, n = jacobians.shape[1:]
    row_basis = np.linalg.svd(jacobians)[2][:, :m]
    projector = np.eye(n) - np.swapaxes(row_basis, 1, 2) @ row_basis
    fatal_sets = [frozenset({joint}) for joint in fatal]
    for size in range(2, min(_MAX_SET_SIZE, n - m) + 1):
        for candidate in combinations(range(n), size):
            if any(smaller <= set(candidate) for smaller in fatal_sets):
                continue
            if np.linalg.det(projector[:, candidate][:, :, candidate]).max() < _SQUARED_RHO_TOLERANCE:
                fatal_sets.append(frozenset(candidate))
    return tuple(tuple(sorted(fatal_set)) for fatal_set in fatal_sets if len(fatal_set) > 1)


def structures(arm: Arm) -> list[Structure]:
    """Return the structure for every task that ``arm`` can have, the most demanding task first."""
    is_planar = plane_normal(arm) is not None
    results = []
    for name in sorted(
        (name for name in TASK_SIZES if name.startswith("planar") == is_planar), key=TASK_SIZES.__getitem__, reverse=True
    ):
        try:
            results.append(structure(arm, name))
        except TaskError:
            continue
    return results


def explain(arm: Arm, found: Structure, others: list[Structure]) -> str:
    """Return one or two sentences on the structure ``found`` of ``arm`` for a task, and on surviving tasks in ``others``."""
    survivors = [
        candidate.task for candidate in others if candidate.survives and not candidate.weak and candidate.task != found.task
    ]
    instead = f" Possible after every single lock: {', '.join(survivors)}." if survivors else ""
    if found.never:
        return f"'{arm.name}' can never do task '{found.task}', for which it is singular in every configuration.{instead}"
    if found.redundancy <= 0:
        return f"'{arm.name}' is not redundant for task '{found.task}': any locked joint ends it.{instead}"
    if found.weak:
        return " ".join(_describe_weak(arm, found, weak) for weak in found.weak) + instead
    if not found.fatal and not found.nearly:
        set_texts = [" + ".join(arm.joint_names[joint] for joint in candidate) for candidate in found.together]
        more_text = f" and {len(set_texts) - _MAX_NAMED_SETS} more" if len(set_texts) > _MAX_NAMED_SETS else ""
        sets_text = (
            f" Sets of joints whose locks make it singular everywhere: {', '.join(set_texts[:_MAX_NAMED_SETS])}{more_text}."
            if set_texts
            else ""
        )
        return f"No single joint of '{arm.name}' is a point of failure by structure for task '{found.task}'.{sets_text}"
    sentences = []
    if found.fatal:
        sentences.append(
            f"Single point of failure by structure: once {_name_joints(arm, found.fatal)} locks, '{arm.name}' is singular for "
            f"task '{found.task}' in every configuration, however well it is chosen."
        )
    for joint, fraction in found.nearly:
        sentences.append(
            f"Nearly a single point of failure by structure: once {_name_joints(arm, [joint])} locks, '{arm.name}' has at "
            f"most {format_number(fraction)} of its manipulability for task '{found.task}' left, at each of "
            f"{_SAMPLE_CONFIGURATIONS} random configurations."
        )
    return " ".join(sentences) + instead


def _describe_weak(arm: Arm, task_structure: Structure, weak: WeakJoint) -> str:
    sentence = (
        f"No joint of '{arm.name}' is exactly a single point of failure for task '{task_structure.task}', but "
        f"{_name_joints(arm, [weak.joint])} nearly is: its lock leaves at most {format_percent(weak.manipulability_left)} of "
        f"the best manipulability, and at {_SAMPLE_CONFIGURATIONS} random configurations the best relative manipulability "
        f"after the worst lock is {format_number(weak.best)} of at most {format_number(weak.bound)}."
    )
    if weak.axis_distance is not None:
        sentence += (
            f" The three axes before the joint, or the three after it, miss a common point by "
            f"{1000 * weak.axis_distance:.2g} mm."
        )
    return sentence


def _name_joints(arm: Arm, joints: Sequence[int]) -> str:
    return list_alternatives([f"{arm.joint_names[joint]} (joint {joint + 1})" for joint in joints])
