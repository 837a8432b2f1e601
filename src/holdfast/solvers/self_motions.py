"""All configurations of a pose: the self-motion manifold, traced where it is made of curves, sampled where it is more.

Source: Goel, Maciejewski, Balakrishnan 2005, section on self-motion manifolds: follow the null vector of the Jacobian
(predictor) and go back to the pose with Newton steps (corrector), from configurations that inverse kinematics found.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.arm.task import Task, as_task, target_pose
from holdfast.errors import InputError, TaskError
from holdfast.files.output import write_table
from holdfast.notice import each, says
from holdfast.result import Result
from holdfast.solvers.curve_tracing import Component, Tracer
from holdfast.status import Status

Array = NDArray[np.float64]

STARTS = 128


@dataclass(frozen=True, eq=False, kw_only=True)
class SelfMotion(Result):
    """The configurations of one pose, as far as they were found.

    Attributes:
        arm: The arm.
        pose: (4, 4) in the world.
        task: Which of its rows are met.
        redundancy: Dimension of the manifold, n - m.
        components: Its curves, for redundancy 1; empty otherwise.
        q: (N, n) all points: of all components one after the other, or the sample.
        spacing: Of the points, rad (and m).
        status: ``OK``, ``NOT_FOUND`` (no configuration was found, which proves nothing) or ``BAD_INPUT``.
        bounds: For each joint the values at which it may lock without losing the pose, rad or m, ``(low, high)`` each, if
            somebody asked :func:`holdfast.joint_bounds` for them.
    """

    arm: Arm
    pose: Array
    task: Task
    redundancy: int
    components: tuple[Component, ...]
    q: Array
    spacing: float
    status: Status
    bounds: Sequence[Sequence[tuple[float, float]]] | None = None

    def describe(self) -> list[str]:
        """A few sentences for people."""
        lines = [f"{self.arm.title}, task {self.task.name}: {self._found()}"]
        lines += [f"curve {k + 1}: {c.length:.3g} rad, {self.ends(k)}" for k, c in enumerate(self.components)]
        for joint, arcs in zip(self.arm.joints, self.bounds or [], strict=False):
            factor, unit = joint.shown
            ranges = " or ".join(f"{factor * a:.2f} to {factor * b:.2f} {unit}" for a, b in arcs)
            lines.append(f"{joint.name} may lock {f'at {ranges}' if arcs else 'nowhere'} without losing the target")
        return lines

    def _found(self) -> str:
        if self.status != Status.OK:
            return self.status.sentence
        if self.redundancy > 1:
            return f"{len(self.q)} configurations of a manifold of dimension {self.redundancy}, {self.spacing:.3g} rad apart"
        closed = sum(c.closed for c in self.components)
        lengths = ", ".join(f"{c.length:.3g}" for c in self.components)
        plural = "s" if len(self.components) != 1 else ""
        return f"{len(self.components)} curve{plural} of configurations, {closed} closed, lengths {lengths} rad"

    def ends(self, k: int) -> str:
        """What ends curve k, for people."""
        c = self.components[k]
        if c.closed:
            return "closed"
        names = self.arm.joint_names
        return " to ".join("singular configuration" if i is None else f"limit of {names[i]}" for i in c.bounded_by)

    def to_csv(self, file: str | Path, degrees: bool = False) -> Path:
        """Write all points as rows, with the number of their curve; revolute joints in rad or degrees.

        Raises:
            StoreError: It cannot be written.
        """
        turning = degrees & ~self.arm.prismatic
        units = ["deg" if turns else joint.unit for turns, joint in zip(turning, self.arm.joints, strict=True)]
        sizes = [len(c.q) for c in self.components] or [len(self.q)]
        curve = np.repeat(np.arange(1, len(sizes) + 1), sizes)
        rows = np.column_stack([curve, np.where(turning, np.rad2deg(self.q), self.q)])
        header = ["curve", *(f"{name}_{unit}" for name, unit in zip(self.arm.joint_names, units, strict=True))]
        return write_table(file, "points", header, rows, ["%d", *["%.12g"] * self.arm.n])


@checked
def self_motion(
    arm: Arm,
    target: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    spacing: float = 0.05,
    seed: int = 0,
    starts: int = STARTS,
) -> SelfMotion:
    """All configurations of a target that were found, within the joint limits; ``fibres`` takes many poses.

    Args:
        arm: The arm.
        target: (m,) for tasks without angular rows: the task's rows of the wanted tool point, m. For any task, (4, 4), a
            tool pose in the world.
        task: Rows of the pose that matter.
        spacing: Distance of neighbouring points in joint space, rad; see :func:`holdfast.solvers.fibres`.
        seed: Of the starts.
        starts: Random starts of inverse kinematics: more find shorter curves.

    Raises:
        InputError: A target of another shape or with NaN, or options out of range.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005.
    """
    rows = as_task(arm, task)
    return fibres(arm, target_pose(rows, target), rows, spacing=spacing, seed=seed, starts=starts)[0]


@says("tracing self-motions")
def fibres(
    arm: Arm,
    poses: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    spacing: float = 0.05,
    seed: int = 0,
    starts: int = STARTS,
    follow: bool = False,
) -> list[SelfMotion]:
    """The self-motion manifold of each pose, within the joint limits.

    With one degree of redundancy every curve on which a start of inverse kinematics converges is traced, both ways, until it
    closes or a joint reaches its limit. Curves that no start converges to are missed: more starts find shorter ones. With
    more redundancy the manifold is sampled: neighbours of known points are added until none is farther than about the
    spacing from the points (or until there are 4000).

    Args:
        arm: The arm.
        poses: (4, 4) or (N, 4, 4) in the world; only the rows of the task must be met.
        task: Rows of the pose that matter.
        spacing: Distance of neighbouring points in joint space, rad (a prismatic joint counts 1 m as 1 rad). Steps are
            shortened where the curve bends.
        seed: Of the starts; start k of pose i does not depend on the number of poses behind it.
        starts: Random starts of inverse kinematics per pose.
        follow: The poses follow each other along a path: each curve of a pose is also looked for at the poses before and
            behind it. Only with one degree of redundancy.

    Returns:
        One :class:`SelfMotion` per pose; every point meets its pose to 1e-9 rad, and m for an arm of 1 m.

    Raises:
        InputError: Poses that are not 4x4 transforms, or options out of range.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005.
    """
    targets = check_poses(poses)
    rows = as_task(arm, task)
    redundancy = arm.n - rows.m
    if redundancy < 1:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{rows.name}' {rows.m} rows: without redundancy a pose has no "
            "self-motion; choose a task with fewer rows"
        )
    if not (np.isfinite(spacing) and 0 < spacing <= 0.5):
        raise InputError(f"spacing is {spacing:g}; it must be above 0 and at most 0.5 rad")
    if starts < 1:
        raise InputError(f"starts is {starts}; it must be 1 or more")
    finite: NDArray[np.bool_] = np.asarray(np.isfinite(targets).all(axis=(1, 2)))
    tracer = _tracer(arm, tuple(map(tuple, rows.rows.tolist())), rows.frame)
    owner, q = tracer.seeds(targets, np.flatnonzero(finite), seed, starts)
    components: list[list[Component]] = [[] for _ in targets]
    if redundancy == 1:
        tracer.curves(targets, owner, q, spacing, components)
        if follow:
            tracer.passed_on(targets, spacing, components)
        points = [np.concatenate([c.q for c in found]) if found else np.empty((0, arm.n)) for found in components]
    else:
        points = [tracer.sample(t, q[owner == i], spacing) for i, t in enumerate(each("poses", targets, whole=True))]
    found_any = [Status.OK if len(p) else Status.NOT_FOUND for p in points]
    status = [s if ok else Status.BAD_INPUT for s, ok in zip(found_any, finite, strict=True)]
    return [
        SelfMotion(arm=arm, pose=t, task=rows, redundancy=redundancy, components=tuple(c), q=p, spacing=spacing, status=s)
        for t, c, p, s in zip(targets, components, points, status, strict=True)
    ]


@lru_cache(maxsize=16)
def _tracer(arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"]) -> Tracer:
    return Tracer(arm, Task("task", np.array(rows), frame))
