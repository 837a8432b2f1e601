"""What an arm on its path must meet beside the path's rows: room to what is around it, and rows kept of the tool's pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError
from holdfast.keep.kept import Kept
from holdfast.keep.manifold import Manifold
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.clear_parts import Clear
from holdfast.solvers.curve_tracing import Tracer
from holdfast.solvers.self_motions import SelfMotion
from holdfast.status import Status

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_LOOKED_AT = 8  # configurations, drawn, at which it is asked whether self-motion changes what is kept
_SAME = 1e-9  # m and rad per rad
_STILL = 1e-9  # m and rad


@dataclass(frozen=True, eq=False, kw_only=True)
class Conditions:
    """What is asked of every configuration.

    Attributes:
        arm, task: What moves, and which rows the path sets.
        room: A clearance and the margin to keep, m; None: nothing is kept clear of.
        keep: What is kept, through the first pose of the path.
        given: The parts of these that the rows of the path decide alone.
        left: The others, which the path leaves to the arm: cones that self-motion can leave.
    """

    arm: Arm
    task: Task
    room: tuple[Clearance, float] | None
    keep: tuple[Kept, ...]
    given: tuple[Kept, ...]
    left: tuple[Kept, ...]

    @classmethod
    def of(cls, arm: Arm, task: Task, room: tuple[Clearance, float] | None, keep: Sequence[Kept]) -> Conditions:
        """Those of an arm on a path whose rows are the task's.

        Raises:
            InputError: A row that is kept exactly and that the path leaves free.
        """
        parts = [part for one in keep for part in _parts(one)]
        given = tuple(part for part in parts if _set_by_path(arm, task, part))
        left = tuple(part for part in parts if part not in given)
        exact = next((part for part in left if len(part.normals) or part.turned or not part.angle), None)
        if exact is not None:
            raise InputError(
                f"the task '{task.name}' leaves free what is to be kept exactly ({exact}): prescribe it by the path and a "
                "task with more rows, such as pointing or pose" + (", or give an angle" if exact.direction is not None else "")
            )
        return cls(arm=arm, task=task, room=room, keep=tuple(keep), given=given, left=left)

    @property
    def any(self) -> bool:
        """Whether anything is asked."""
        return self.room is not None or bool(self.keep)

    @cached_property
    def manifold(self) -> Manifold | None:
        """Of what is left to the arm."""
        if not self.left:
            return None
        return Manifold(self.arm, self.left, self.arm.upper > self.arm.lower, finite_limits(self.arm))

    def holds(self, q: Array, slack: float = 0.0) -> Flags:
        """(N,) True where configurations (N, n) on the path have room, up to a slack in m, and keep what it leaves to them."""
        good = np.ones(len(q), dtype=bool)
        if self.room is not None:
            good &= self.room[0].room(q) >= self.room[1] - slack
        if self.manifold is not None:
            good[good] = self.manifold.holds(q[good])
        return good

    def broken(self, q: Array) -> tuple[int, str] | None:
        """The first of configurations (N, n) that breaks what is kept, and by how much, a phrase."""
        return _first_trouble(self.keep, self.arm.forward_kinematics(q))

    def keeps(self, q: Array) -> Flags:
        """(N,) True where configurations (N, n) keep what is kept."""
        poses = self.arm.forward_kinematics(q)
        return np.array([not any(one.trouble(pose[None]) for one in self.keep) for pose in poses], dtype=bool)

    def given_up(self, q: Array) -> tuple[int, str] | None:
        """As :meth:`broken` of what the path decides alone, of any configurations (T, n) on it."""
        return _first_trouble(self.given, self.arm.forward_kinematics(q))

    def why_none(self, found: SelfMotion) -> str:
        """Why no configuration of a pose is left, a sentence."""
        if self.manifold is None or found.status != Status.INFEASIBLE:
            return found.describe()[0]
        clear = "" if self.room is None else ", clear of what is around it,"
        return f"no configuration that was found{clear} keeps this: {'; '.join(map(str, self.left))}"

    def cut(self, tracer: Tracer, found: SelfMotion) -> SelfMotion:
        """The parts of curves of configurations that keep what the path leaves to them."""
        if self.manifold is None:
            return found
        names = [kept.name for kept in self.left]
        clear = Clear(self.manifold.gaps, self.manifold.changes(np.eye(self.arm.n)).T, names)
        parts = tuple(part for c in found.components for part in clear.parts(tracer, found.pose, c))
        q = np.concatenate([c.q for c in parts]) if parts else found.q[:0]
        return replace(found, components=parts, q=q, status=found.status if parts else Status.INFEASIBLE)

    def brought(self, q: Array, poses: Array) -> Array:
        """Configurations near q (N, n) that keep what is left to them and the rows of poses (N, 4, 4); maybe not all do."""
        if self.manifold is None:
            return q

        def of_path(at: Array, which: NDArray[np.intp]) -> tuple[Array, Array]:
            now, jacobian, pose = self.arm.forward_kinematics(at), self.arm.jacobian(at), poses[which]
            turned = rotation_vectors(pose[:, :3, :3] @ now[:, :3, :3].transpose(0, 2, 1))
            error = np.concatenate([pose[:, :3, 3] - now[:, :3, 3], turned], axis=1)
            rows = _rows(self.task, now)
            return np.einsum("nmk,nk->nm", rows, error), rows @ jacobian

        return self.manifold.projected(q, of_path)


def _first_trouble(keep: Sequence[Kept], poses: Array) -> tuple[int, str] | None:
    for k, pose in enumerate(poses if keep else []):
        said = [trouble for one in keep if (trouble := one.trouble(pose[None]))]
        if said:
            return k, " and ".join(said)
    return None


def _parts(kept: Kept) -> list[Kept]:
    """Where the tool point stays, and how the tool stays turned."""
    parts = []
    if len(kept.normals):
        parts.append(replace(kept, direction=None, turned=False))
    if kept.turned or kept.direction is not None:
        parts.append(replace(kept, normals=kept.normals[:0]))
    return parts


def _set_by_path(arm: Arm, task: Task, kept: Kept) -> bool:
    """Whether no motion that keeps the rows of the task changes what is kept: then the path decides alone."""
    low, high = finite_limits(arm)
    q = np.random.default_rng(np.random.SeedSequence(0)).uniform(low, high, (_LOOKED_AT, arm.n))
    poses, jacobian = arm.forward_kinematics(q), arm.jacobian(q) * (arm.upper > arm.lower)
    null = np.linalg.svd(_rows(task, poses) @ jacobian)[2][:, task.m :]
    change = jacobian @ null.transpose(0, 2, 1)
    if len(kept.normals):
        return bool(np.abs(kept.normals @ change[:, :3]).max(initial=0.0) <= _SAME)
    turned = change[:, 3:]
    if not kept.turned:
        axis = (poses[:, :3, :3] @ kept.axis)[:, :, None]
        turned = turned - axis * (axis * turned).sum(axis=1, keepdims=True)
    return bool(np.abs(turned).max(initial=0.0) <= _SAME)


def _rows(task: Task, poses: Array) -> Array:
    """(N, m, 6) rows of a task, of twists in the world, with the tool at poses (N, 4, 4)."""
    rows = np.broadcast_to(task.rows, (len(poses), *task.rows.shape))
    if task.frame == "base":
        return rows
    back = poses[:, :3, :3].transpose(0, 2, 1)
    return np.concatenate([rows[..., :3] @ back, rows[..., 3:] @ back], axis=2)


def task_jacobian(arm: Arm, task: Task, q: Array) -> Array:
    """(N, m, n) of the rows of a task, m and rad, at q (N, n)."""
    return np.asarray(_rows(task, arm.forward_kinematics(q)) @ arm.jacobian(q))


def with_axis(task: Task, path: TimedPath, axis: Array, direction: Array) -> tuple[Task, TimedPath] | None:
    """The task and path of that, for an axis (3,) in the tool's frame and a direction (3,) in the world, unit vectors.

    None where the task prescribes other rows than the position, or the path waits or turns in a place.
    """
    legs = path.path
    waits = np.linalg.norm(legs.shift, axis=1) + np.linalg.norm(legs.sweep, axis=1) <= _STILL
    if task.angular or task.m < 3 or waits.any():
        return None
    across = np.linalg.svd(axis[None])[2][1:]
    rows = np.block([[np.eye(3), np.zeros((3, 3))], [np.zeros((2, 3)), across]])
    starts = legs.starts.copy()
    starts[:, :3, :3] = _frame(direction) @ _frame(axis).T
    along = replace(path, path=replace(legs, starts=starts, turn=0 * legs.turn, oriented=True))
    return Task(f"{task.name} with the axis held", rows, "tool", length=task.length), along


def _frame(first: Array) -> Array:
    """(3, 3) right-handed axes, columns, the first given."""
    second = np.linalg.svd(first[None])[2][1]
    return np.column_stack([first, second, np.cross(first, second)])
