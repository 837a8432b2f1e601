"""Compiled arm of all pages: its indices, objectives, clearance, and control laws."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError, HoldfastError, InputError, TaskError
from holdfast.core.formatting import format_number
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import stretched_length
from holdfast.kinematics.holding.static_check import holds
from holdfast.kinematics.indices import susceptibility
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.kinematics.indices.objective import Objective
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.model.arm.task import Task
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance

REACH_TOLERANCE = 1e-6  # distance of an end effector from a target that it has reached, m and rad


@dataclass(frozen=True)
class JointBars:
    """One number per joint.

    Attributes:
        title: Name of the measured quantity.
        better: ``larger`` or ``smaller``.
        unit: Unit of the values; several units where joints differ.
        values: (n,) values; NaN or infinite where there is none.
        worst: Index of the joint with the worst failure, from 0.
        status: Sentence about a special case; else empty.
    """

    title: str
    better: str
    unit: tuple[str, ...]
    values: FloatArray
    worst: int
    status: str = ""


@dataclass(frozen=True)
class NearestObject:
    """Object of the cell that is nearest to the arm.

    Attributes:
        text: Sentence about the distance.
        name: Name of the object; empty if the cell is empty or invalid.
        blocked: True if the arm is closer than the margin.
        arm, object: Nearest points of the arm and of the object (3,), m; None without an object.
    """

    text: str
    name: str = ""
    blocked: bool = False
    arm: FloatArray | None = None
    object: FloatArray | None = None


class CompiledArm:
    """Arm with its compiled functions, shared by all pages; safe for several threads."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self.arm, self.task, self.cell = arm, task, cell
        self._indices: dict[str, Index | str] = {}
        self._susceptibilities: dict[str, susceptibility.Susceptibility | str] = {}
        self._objectives: dict[str, tuple[Objective, Objective] | str] = {}
        self._laws: dict[str, Law] = {}
        self._tool_drops: dict[tuple[int, ...], susceptibility.Susceptibility] = {}
        self._clearance: Clearance | None = None
        self._compile_lock = threading.RLock()

    # ---- geometry ---------------------------------------------------------------------------------------------------

    def tool_pose(self, q: FloatArray) -> FloatArray:
        """Return the tool pose (4, 4) in the world."""
        return np.asarray(self.arm.frames(q)[-1])

    @cached_property
    def size(self) -> float:
        """Length of the stretched arm, m, to which the drawing is scaled."""
        return stretched_length(self.arm)

    def get_clearance(self, moved: Sequence[tuple[str, Sequence[float]]]) -> Clearance | None:
        """Return the clearance to enforce, with the objects in their moved poses; None without a cell.

        Raises:
            InputError: The arm's base touches an object.
        """
        if self.cell is None:
            return None
        with self._compile_lock:
            if self._clearance is None:
                self._clearance = Clearance.by_default(self.arm, self.cell)
            assert self._clearance is not None
            return self._clearance.with_cell(self.cell_with_moved(moved)) if moved else self._clearance

    def cell_with_moved(self, moved: Sequence[tuple[str, Sequence[float]]]) -> Cell:
        """Return the cell, of an arm that has one, with the objects in their moved poses."""
        assert self.cell is not None
        return self.cell.with_poses({name: pose_from_quaternion(numbers[:3], numbers[3:]) for name, numbers in moved})

    # ---- measures and laws ------------------------------------------------------------------------------------------

    def get_index(self, name: str) -> Index | str:
        """Return the index over single failures, or the reason why the arm has none."""
        with self._compile_lock:
            if name not in self._indices:
                try:
                    self._indices[name] = by_name(name, self.arm, self.task)
                except (InputError, TaskError) as error:
                    self._indices[name] = str(error)
            return self._indices[name]

    def get_susceptibility(self, name: str) -> susceptibility.Susceptibility | str:
        """Return the susceptibility, or the reason why the arm has none."""
        with self._compile_lock:
            if name not in self._susceptibilities:
                try:
                    self._susceptibilities[name] = susceptibility.by_name(name, self.arm)
                except ArmError as error:
                    self._susceptibilities[name] = str(error)
            return self._susceptibilities[name]

    def get_objectives(self, name: str) -> tuple[Objective, Objective] | str:
        """Return the objectives of the best and the worst configuration, or the reason why there are none."""
        with self._compile_lock:
            if name not in self._objectives:
                measure = self.get_index(name) if INDEX_REGISTRY.covers(name) else self.get_susceptibility(name)
                self._objectives[name] = measure if isinstance(measure, str) else (measure, measure.reversed())
            return self._objectives[name]

    def get_law(self, text: str) -> Law:
        """Return the control law with the label ``name`` or ``name:value``; it is compiled once.

        Raises:
            InputError: The law is unknown, its setting is invalid, or it has no setting.
        """
        with self._compile_lock:
            if text not in self._laws:
                self._laws[text] = LAW_REGISTRY.make(text, self.arm, option="law", task=self.task)
            return self._laws[text]

    def describe_power_loss(self, q: FloatArray, powerless: tuple[int, ...], friction: float | None) -> str:
        """Describe the beginning of the fall of joints at q (n,) with dry ``friction``, N m or N; empty without masses."""
        if not powerless or not self.has_masses:
            return ""
        try:
            with self._compile_lock:
                if powerless not in self._tool_drops:
                    self._tool_drops[powerless] = susceptibility.tool_drop(self.arm, powerless)
            acceleration = float(self._tool_drops[powerless](q))
            check = holds(self.arm, q, free=powerless, friction=Friction(coulomb=friction))
        except HoldfastError as error:
            return str(error)
        joint = self.arm.joints[check.joint]
        early, late = (format_number(1000 * acceleration * time**2 / 2, 3) for time in (0.05, 0.1))
        return (
            f"Without torque the arm {'holds' if check.holds else 'falls'}: {joint.name} has a margin of "
            f"{format_number(float(check.margin), 3)} {'N' if joint.prismatic else 'N m'}. Without dry friction the tool "
            f"accelerates down with {format_number(acceleration, 3)} m/s^2: {early} mm after 50 ms, {late} mm after 100 ms."
        )

    def evaluate_index_bars(self, q: FloatArray, name: str) -> JointBars | str:
        """Evaluate an index at q (n,), or return the reason why the arm has none."""
        index = self.get_index(name)
        if isinstance(index, str):
            return index
        evaluation = index.evaluate(q)
        units = (index.unit,) * self.arm.n
        singular = "" if evaluation.status == 0 else "the healthy arm is singular here"
        return JointBars(index.name, index.better, units, evaluation.by_failure, int(evaluation.worst), singular)

    def evaluate_susceptibility_bars(self, q: FloatArray, name: str) -> JointBars | str:
        """Evaluate a susceptibility at q (n,), or return the reason why the arm has none."""
        measure = self.get_susceptibility(name)
        if isinstance(measure, str):
            return measure
        values = np.abs(measure.by_joint(q))
        return JointBars(measure.name, "smaller", tuple(measure.joint_unit), values, int(np.nan_to_num(values).argmax()))

    # ---- targets and objects ----------------------------------------------------------------------------------------

    def pose_error_norm(self, q: FloatArray, pose: FloatArray) -> float:
        """Return the distance between the end effector at q (n,) and a pose (4, 4), by the rows of the task; m and rad."""
        from scipy.spatial.transform import Rotation

        tool = self.tool_pose(q)
        to_task_frame = tool[:3, :3].T if self.task.frame == "tool" else np.eye(3)
        angular = Rotation.from_matrix(pose[:3, :3] @ tool[:3, :3].T).as_rotvec()
        return float(
            np.linalg.norm(self.task.rows @ np.r_[to_task_frame @ (pose[:3, 3] - tool[:3, 3]), to_task_frame @ angular])
        )

    def nearby_configuration(self, q: FloatArray) -> FloatArray:
        """Return a configuration near q (n,) within the limits, whose pose is a reachable target."""
        offsets = np.where(self.arm.prismatic, 0.1 * self.size, 0.3) * np.where(np.arange(self.arm.n) % 2, -1.0, 1.0)
        is_within_limits = (q + offsets >= self.arm.lower) & (q + offsets <= self.arm.upper)
        return np.asarray(np.clip(np.where(is_within_limits, q + offsets, q - offsets), self.arm.lower, self.arm.upper))

    @cached_property
    def has_masses(self) -> bool:
        """True if the masses of all links are known, so that the arm can fall."""
        return all(link is not None for link in self.arm.links)

    def find_nearest_object(self, q: FloatArray, moved: Sequence[tuple[str, Sequence[float]]]) -> NearestObject | None:
        """Find the object of the cell that is nearest to the arm at q (n,); None without a cell."""
        if self.cell is None:
            return None
        try:
            clearance = self.get_clearance(moved)
        except InputError as error:
            return NearestObject(describe_error(error), blocked=True)
        if clearance is None or clearance.obstacles is None or clearance.cell is None:
            return NearestObject("The cell is empty.")
        obstacles = clearance.obstacles
        gap = obstacles.find_nearest_gap(q)
        blocked, pair = bool(gap.margin < 0), obstacles.names[gap.pair]
        if gap.distance < 0:
            text = f"In collision: {pair}; the collision model of the arm is {-gap.distance:.3g} m inside."
        else:
            margin = f", closer than the margin of {gap.distance - gap.margin:.3g} m" if blocked else ""
            text = f"Closest: {pair}, at least {gap.distance:.3g} m{margin}."
        name = clearance.cell.objects[obstacles.pairs[gap.pair][1]].name
        return NearestObject(text, name, blocked, np.asarray(gap.on_arm), np.asarray(gap.on_object))


def describe_error(error: BaseException) -> str:
    """Format an exception as a sentence for the user."""
    text = str(error) if isinstance(error, HoldfastError) else f"{type(error).__name__}: {error}"
    return text[:1].upper() + text[1:]
