"""The compiled arm behind a window: where its bodies are, what a failure takes, how the end effector is followed, and
its laws.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.poses import pose_of
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.cell.cell import Cell
from holdfast.clearance.clearance import Clearance
from holdfast.control.law import Law
from holdfast.errors import ArmError, HoldfastError, InputError, TaskError
from holdfast.indices import susceptibility
from holdfast.indices.index import Index, by_name
from holdfast.indices.lost_directions import Ellipsoid, Loss, ellipsoid, losses, null_directions
from holdfast.indices.objective import Objective
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.present.arm.body import stretched
from holdfast.registry import INDICES, LAWS
from holdfast.solvers.inverse_kinematics import solver

Array = NDArray[np.float64]
TOLERANCE = 1e-6  # m and rad, of an end effector that is dragged
SLIDE = 0.05  # rad (and m): longest step along a self-motion


@dataclass(frozen=True)
class Bars:
    """One number per joint.

    Attributes:
        title: What is measured.
        better: ``larger`` or ``smaller``.
        unit: Of the values; several units where joints differ.
        values: (n,) NaN or infinite where there is none.
        worst: The joint whose failure is the worst, from 0.
        status: A sentence, where something is to be said; else empty.
    """

    title: str
    better: str
    unit: tuple[str, ...]
    values: Array
    worst: int
    status: str = ""


@dataclass(frozen=True)
class Reading:
    """Everything that is shown live about one configuration.

    Attributes:
        bars: Of the index, or why there are none.
        weights: Of the susceptibility, or why there are none.
        before, after: Ellipsoids of the healthy and of the failed arm.
        hit: The joints whose failure ``after`` and ``losses`` are of: the failed ones, or the worst one if none has failed.
        losses: Directions in which speed is lost.
    """

    bars: Bars | str
    weights: Bars | str
    before: Ellipsoid
    after: Ellipsoid
    hit: tuple[int, ...]
    losses: list[Loss]


class Machine:
    """What all windows of an arm share; safe for several threads."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self.arm, self.task, self.cell = arm, task, cell
        self._indices: dict[str, Index | str] = {}
        self._susceptibilities: dict[str, susceptibility.Susceptibility | str] = {}
        self._objectives: dict[str, tuple[Objective, Objective] | str] = {}
        self._laws: dict[str, Law] = {}
        self._clear: Clearance | None = None
        self._making = threading.RLock()

    # ---- where things are ------------------------------------------------------------------------------------------

    @cached_property
    @recalled
    def _task_jacobian(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("task jacobian", [q], [ca.densify(self.task.jacobian(self.arm, q))])

    def hand(self, q: Array) -> Array:
        """Tool pose (4, 4) in the world."""
        return np.asarray(self.arm.frames(q)[-1])

    @cached_property
    def size(self) -> float:
        """Length of the stretched arm, m: what things are drawn in proportion to."""
        return stretched(self.arm)

    def clearance(self, moved: Sequence[tuple[str, Sequence[float]]]) -> Clearance | None:
        """What the arm keeps clear of, with objects where they were moved to; None without a cell.

        Raises:
            InputError: The arm's base touches an object.
        """
        if self.cell is None:
            return None
        with self._making:
            if self._clear is None:
                self._clear = Clearance.by_default(self.arm, self.cell)
            assert self._clear is not None
            return self._clear.with_cell(self.cell_with(moved)) if moved else self._clear

    def cell_with(self, moved: Sequence[tuple[str, Sequence[float]]]) -> Cell:
        """The cell, of an arm that has one, with objects where they were moved to."""
        assert self.cell is not None
        return self.cell.with_poses({name: pose_of(numbers[:3], numbers[3:]) for name, numbers in moved})

    # ---- what a failure takes --------------------------------------------------------------------------------------

    def index(self, name: str) -> Index | str:
        """The index over single failures, or the sentence that says why the arm has none."""
        with self._making:
            if name not in self._indices:
                try:
                    self._indices[name] = by_name(name, self.arm, self.task)
                except (InputError, TaskError) as error:
                    self._indices[name] = str(error)
            return self._indices[name]

    def susceptibility(self, name: str) -> susceptibility.Susceptibility | str:
        """The susceptibility, or the sentence that says why the arm has none."""
        with self._making:
            if name not in self._susceptibilities:
                try:
                    self._susceptibilities[name] = susceptibility.by_name(name, self.arm)
                except ArmError as error:
                    self._susceptibilities[name] = str(error)
            return self._susceptibilities[name]

    def objectives(self, name: str) -> tuple[Objective, Objective] | str:
        """What the best and the worst configuration are chosen by, or the sentence that says why they cannot be."""
        with self._making:
            if name not in self._objectives:
                found = self.index(name) if INDICES.covers(name) else self.susceptibility(name)
                self._objectives[name] = found if isinstance(found, str) else (found, found.reversed())
            return self._objectives[name]

    def law(self, text: str) -> Law:
        """A control law as its label says, ``name`` or ``name:value``; compiled once.

        Raises:
            InputError: It is not known, or its setting is none, or it takes none.
        """
        with self._making:
            if text not in self._laws:
                self._laws[text] = LAWS.make(text, self.arm, option="law", task=self.task)
            return self._laws[text]

    def read(self, q: Array, failed: Sequence[int], index: str, weight: str) -> Reading:
        """Everything that is shown live, at q (n,)."""
        bars = self._index_bars(q, index)
        hit = tuple(failed) or (() if isinstance(bars, str) else (bars.worst,))
        linear = self.arm.jacobian(q)[:3]
        j = self._task_jacobian(q).reshape(self.task.m, self.arm.n)
        return Reading(bars, self._weight_bars(q, weight), ellipsoid(linear), ellipsoid(linear, hit), hit, losses(j, hit))

    def _index_bars(self, q: Array, name: str) -> Bars | str:
        index = self.index(name)
        if isinstance(index, str):
            return index
        found = index.evaluate(q)
        units = (index.unit,) * self.arm.n
        singular = "" if found.status == 0 else "the healthy arm is singular here"
        return Bars(index.name, index.better, units, found.by_failure, int(found.worst), singular)

    def _weight_bars(self, q: Array, name: str) -> Bars | str:
        measure = self.susceptibility(name)
        if isinstance(measure, str):
            return measure
        values = np.abs(measure.by_joint(q))
        return Bars(measure.name, "smaller", tuple(measure.joint_unit), values, int(np.nan_to_num(values).argmax()))

    # ---- following the end effector ----------------------------------------------------------------------------------------

    def reach(self, q: Array, pose: Array, failed: Sequence[int]) -> tuple[Array, bool]:
        """The configuration near q (n,) that brings the end effector to a pose (4, 4), failed joints locked; and
        whether it does.

        Where the pose is out of reach it is the nearest found, never farther than q itself.
        """
        engine = solver(self.arm, self.task)
        free = np.ones(self.arm.n)
        free[list(failed)] = 0.0
        return engine.near(q, pose, free, TOLERANCE)

    def apart(self, q: Array, pose: Array) -> float:
        """How far the end effector at q (n,) is from a pose (4, 4), by the rows of the task; m and rad."""
        from scipy.spatial.transform import Rotation

        hand = self.hand(q)
        turn = hand[:3, :3].T if self.task.frame == "tool" else np.eye(3)
        angular = Rotation.from_matrix(pose[:3, :3] @ hand[:3, :3].T).as_rotvec()
        return float(np.linalg.norm(self.task.rows @ np.r_[turn @ (pose[:3, 3] - hand[:3, 3]), turn @ angular]))

    def beside(self, q: Array) -> Array:
        """A configuration a little away from q (n,), within the limits: its pose is a target that can be reached."""
        away = np.where(self.arm.prismatic, 0.1 * self.size, 0.3) * np.where(np.arange(self.arm.n) % 2, -1.0, 1.0)
        inside = (q + away >= self.arm.lower) & (q + away <= self.arm.upper)
        return np.asarray(np.clip(np.where(inside, q + away, q - away), self.arm.lower, self.arm.upper))

    @cached_property
    def swings(self) -> bool:
        """Whether a free joint can be let swing: the physics is installed, and it is known what the bodies weigh."""
        return find_spec("mujoco") is not None and all(link is not None for link in self.arm.links)

    def slide(self, q: Array, along: Array, failed: Sequence[int]) -> tuple[Array, Array]:
        """One step along the self-motion of q (n,) in the direction nearest to ``along`` (n,), whose norm is its length.

        Returns:
            Where it led, within the limits, and the unit direction (n,) it went in; q itself and 0 where there is no way on.
        """
        length = float(np.linalg.norm(along))
        basis = null_directions(self._task_jacobian(q).reshape(self.task.m, self.arm.n), failed)
        ahead = basis.T @ (basis @ along)
        size = float(np.linalg.norm(ahead))
        if length == 0 or size < 1e-6 * length:
            return q, np.zeros_like(q)
        direction = ahead / size
        new, on = self.reach(q + length * direction, self.hand(q), failed)
        inside = bool(((new >= self.arm.lower) & (new <= self.arm.upper)).all())
        if not on or not inside or np.linalg.norm(new - q) > 2 * length:
            return q, np.zeros_like(q)
        return new, direction

    def self_motions(self, q: Array, failed: Sequence[int]) -> Array:
        """Unit directions (r, n) of the self-motions of q."""
        return null_directions(self._task_jacobian(q).reshape(self.task.m, self.arm.n), failed)


def sentence(error: BaseException) -> str:
    """What a person is told of an exception."""
    text = str(error) if isinstance(error, HoldfastError) else f"{type(error).__name__}: {error}"
    return text[:1].upper() + text[1:]
