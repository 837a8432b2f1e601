"""Compiled arm of all windows: its kinematics, indices, objectives, clearance, and control laws."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError, HoldfastError, InputError, TaskError
from holdfast.core.formatting import format_number
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import stretched_length
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.holding.static_check import holds
from holdfast.kinematics.indices import susceptibility
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.kinematics.indices.lost_directions import (
    DirectionLoss,
    Ellipsoid,
    find_speed_losses,
    find_tool_ellipsoid,
    null_space_joint_rates,
)
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.model.arm import kinematics
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.model.arm.task import Task
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance

REACH_TOLERANCE = 1e-6  # tolerance of a dragged end effector, m and rad
MAX_SLIDE_STEP = 0.05  # longest step along a self-motion, rad (and m)


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
class LiveReading:
    """All live values of one configuration.

    Attributes:
        bars: Bars of the index, or the reason why there are none.
        weights: Bars of the susceptibility, or the reason why there are none.
        healthy_ellipsoid, failed_ellipsoid: Ellipsoids of the healthy and of the failed arm.
        failure_joints: Joints whose failure ``failed_ellipsoid`` and ``losses`` show: the failed ones, or the worst one if none
            has failed.
        losses: Directions in which speed is lost.
        power_loss: Sentences on the beginning of the fall after a power loss.
    """

    bars: JointBars | str
    weights: JointBars | str
    healthy_ellipsoid: Ellipsoid
    failed_ellipsoid: Ellipsoid
    failure_joints: tuple[int, ...]
    losses: list[DirectionLoss]
    power_loss: str


class CompiledArm:
    """Arm with its compiled functions, shared by all windows; safe for several threads."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self.arm, self.task, self.cell = arm, task, cell
        self._indices: dict[str, Index | str] = {}
        self._susceptibilities: dict[str, susceptibility.Susceptibility | str] = {}
        self._objectives: dict[str, tuple[Objective, Objective] | str] = {}
        self._laws: dict[str, Law] = {}
        self._tool_drops: dict[tuple[int, ...], susceptibility.Susceptibility] = {}
        self._clearance: Clearance | None = None
        self._compile_lock = threading.RLock()

    # ---- geometry --------------------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _task_jacobian(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("task jacobian", [q], [ca.densify(self.task.jacobian(self.arm, q))])

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

    # ---- effect of a failure ---------------------------------------------------------------------------------------

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

    def evaluate_live_reading(
        self,
        q: FloatArray,
        failed: Sequence[int],
        index_name: str,
        susceptibility_name: str,
        powerless: tuple[int, ...] = (),
        friction: float | None = None,
    ) -> LiveReading:
        """Evaluate all live values at q (n,), and with dry ``friction``, N m or N, for a power loss of the joints."""
        bars = self._evaluate_index_bars(q, index_name)
        failure_joints = tuple(failed) or (() if isinstance(bars, str) else (bars.worst,))
        linear_jacobian, angular_jacobian = np.split(self.arm.jacobian(q), 2)
        angular_rows = self.task.world_rows(self.tool_pose(q)[:3, :3])[:, 3:] @ angular_jacobian
        task_jacobian = self._task_jacobian(q).reshape(self.task.m, self.arm.n)
        return LiveReading(
            bars,
            self._evaluate_susceptibility_bars(q, susceptibility_name),
            find_tool_ellipsoid(linear_jacobian, angular_rows),
            find_tool_ellipsoid(linear_jacobian, angular_rows, failure_joints),
            failure_joints,
            find_speed_losses(task_jacobian, failure_joints),
            self._describe_power_loss(q, powerless, friction),
        )

    def _describe_power_loss(self, q: FloatArray, powerless: tuple[int, ...], friction: float | None) -> str:
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

    def _evaluate_index_bars(self, q: FloatArray, name: str) -> JointBars | str:
        index = self.get_index(name)
        if isinstance(index, str):
            return index
        evaluation = index.evaluate(q)
        units = (index.unit,) * self.arm.n
        singular = "" if evaluation.status == 0 else "the healthy arm is singular here"
        return JointBars(index.name, index.better, units, evaluation.by_failure, int(evaluation.worst), singular)

    def _evaluate_susceptibility_bars(self, q: FloatArray, name: str) -> JointBars | str:
        measure = self.get_susceptibility(name)
        if isinstance(measure, str):
            return measure
        values = np.abs(measure.by_joint(q))
        return JointBars(measure.name, "smaller", tuple(measure.joint_unit), values, int(np.nan_to_num(values).argmax()))

    # ---- following the end effector ----------------------------------------------------------------------------------------

    def solve_pose_near(self, q: FloatArray, pose: FloatArray, failed: Sequence[int]) -> tuple[FloatArray, bool]:
        """Find the configuration near q (n,) with the end effector at a pose (4, 4) and failed joints locked.

        Returns:
            Configuration (n,), and True if it reaches the pose. If not, it is the nearest one found, never farther than q.
        """
        ik_solver = solver(self.arm, self.task)
        is_movable = np.ones(self.arm.n)
        is_movable[list(failed)] = 0.0
        return ik_solver.solve_near(q, pose, is_movable, REACH_TOLERANCE)

    def pose_error_norm(self, q: FloatArray, pose: FloatArray) -> float:
        """Return the distance between the end effector at q (n,) and a pose (4, 4), by the rows of the task; m and rad."""
        from scipy.spatial.transform import Rotation

        tool = self.tool_pose(q)
        angular = Rotation.from_matrix(pose[:3, :3] @ tool[:3, :3].T).as_rotvec()
        return float(np.linalg.norm(self.task.world_rows(tool[:3, :3]) @ np.r_[pose[:3, 3] - tool[:3, 3], angular]))

    def nearby_configuration(self, q: FloatArray) -> FloatArray:
        """Return a configuration near q (n,) within the limits, whose pose is a reachable target."""
        offsets = np.where(self.arm.prismatic, 0.1 * self.size, 0.3) * np.where(np.arange(self.arm.n) % 2, -1.0, 1.0)
        is_within_limits = (q + offsets >= self.arm.lower) & (q + offsets <= self.arm.upper)
        return np.asarray(np.clip(np.where(is_within_limits, q + offsets, q - offsets), self.arm.lower, self.arm.upper))

    @cached_property
    def has_masses(self) -> bool:
        """True if the masses of all links are known, so that the arm can fall."""
        return all(link is not None for link in self.arm.links)

    def step_self_motion(self, q: FloatArray, step: FloatArray, failed: Sequence[int]) -> tuple[FloatArray, FloatArray]:
        """Take one step along the self-motion of q (n,) in the direction nearest to ``step`` (n,), whose norm is its length.

        Returns:
            New configuration within the limits, and unit direction (n,) of the step; q itself and 0 if no step is possible.
        """
        length = float(np.linalg.norm(step))
        basis = null_space_joint_rates(self._task_jacobian(q).reshape(self.task.m, self.arm.n), failed)
        projected = basis.T @ (basis @ step)
        projected_norm = float(np.linalg.norm(projected))
        if length == 0 or projected_norm < 1e-6 * length:
            return q, np.zeros_like(q)
        direction = projected / projected_norm
        q_next, is_reached = self.solve_pose_near(q + length * direction, self.tool_pose(q), failed)
        is_within_limits = bool(((q_next >= self.arm.lower) & (q_next <= self.arm.upper)).all())
        if not is_reached or not is_within_limits or np.linalg.norm(q_next - q) > 2 * length:
            return q, np.zeros_like(q)
        return q_next, direction

    def self_motion_directions(self, q: FloatArray, failed: Sequence[int]) -> FloatArray:
        """Return unit directions (r, n) of the self-motions of q."""
        return null_space_joint_rates(self._task_jacobian(q).reshape(self.task.m, self.arm.n), failed)


def describe_error(error: BaseException) -> str:
    """Format an exception as a sentence for the user."""
    text = str(error) if isinstance(error, HoldfastError) else f"{type(error).__name__}: {error}"
    return text[:1].upper() + text[1:]
