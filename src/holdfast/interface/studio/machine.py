"""Compiled arm of all pages: its indices, objectives, clearance, and control laws."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.formatting import format_number
from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.typing import FloatArray, T
from holdfast.interface.presentation.arm.body import stretched_length
from holdfast.kinematics.holding.static_check import holds
from holdfast.kinematics.indices import susceptibility
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.model.arm.task import Task
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance

REACH_TOLERANCE = 1e-6  # distance of an end effector from a target that it has reached, m and rad


class CompiledArm:
    """Arm with its compiled functions, shared by all pages; safe for several threads."""

    def __init__(self, arm: Arm, task: Task, cell: Cell | None = None) -> None:
        self.arm, self.task, self.cell = arm, task, cell
        self._compiled: dict[object, Any] = {}
        self._compile_lock = threading.RLock()

    def _compile_once(self, key: object, compile_value: Callable[[], T]) -> T:
        with self._compile_lock:
            if key not in self._compiled:
                self._compiled[key] = compile_value()
            return cast(T, self._compiled[key])

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
        clearance = self._compile_once("clearance", lambda: Clearance.by_default(self.arm, self.cell))
        return clearance.with_cell(self.cell_with_moved(moved)) if moved and clearance is not None else clearance

    def cell_with_moved(self, moved: Sequence[tuple[str, Sequence[float]]]) -> Cell:
        """Return the cell with the objects in their moved poses.

        Raises:
            InputError: There is no cell.
        """
        if self.cell is None:
            raise InputError("there is no cell; start the studio with --cell FILE")
        return self.cell.with_poses({name: pose_from_quaternion(numbers[:3], numbers[3:]) for name, numbers in moved})

    # ---- measures and laws ------------------------------------------------------------------------------------------

    def get_index(self, name: str) -> Index:
        """Return the index over single failures.

        Raises:
            HoldfastError: The arm has no such index.
        """
        return self._compile_once(("index", name), lambda: by_name(name, self.arm, self.task))

    def get_susceptibility(self, name: str) -> susceptibility.Susceptibility:
        """Return the susceptibility.

        Raises:
            HoldfastError: The arm has no such susceptibility.
        """
        return self._compile_once(("susceptibility", name), lambda: susceptibility.by_name(name, self.arm))

    def get_law(self, text: str) -> Law:
        """Return the control law with the label ``name`` or ``name:value``.

        Raises:
            InputError: The law is unknown, its setting is invalid, or it has no setting.
        """
        law: Law = self._compile_once(("law", text), lambda: LAW_REGISTRY.make(text, self.arm, option="law", task=self.task))
        return law

    def describe_power_loss(self, q: FloatArray, powerless: tuple[int, ...], friction: float | None) -> str:
        """Describe the beginning of the fall of joints at q (n,) with dry ``friction``, N m or N; empty without masses."""
        if not powerless or not self.has_masses:
            return ""
        try:
            tool_drop = self._compile_once(powerless, lambda: susceptibility.tool_drop(self.arm, powerless))
            acceleration = float(tool_drop(q))
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

    def evaluate_index_bars(self, q: FloatArray, name: str) -> dict[str, Any]:
        """Evaluate an index at q (n,) for the lock of each joint, as ``JointBars``.

        Raises:
            HoldfastError: The arm has no such index.
        """
        index = self.get_index(name)
        evaluation = index.evaluate(q)
        return {
            "title": index.name,
            "better": index.better,
            "unit": [index.unit] * self.arm.n,
            "values": to_plain(evaluation.by_failure),
            "worst": int(evaluation.worst),
            "status": "" if evaluation.status == 0 else "the healthy arm is singular here",
        }

    def evaluate_susceptibility_bars(self, q: FloatArray, name: str) -> dict[str, Any]:
        """Evaluate a susceptibility at q (n,) for the torque loss of each joint, as ``JointBars``.

        Raises:
            HoldfastError: The arm has no such susceptibility.
        """
        measure = self.get_susceptibility(name)
        values = np.abs(measure.by_joint(q))
        worst = int(np.nan_to_num(values).argmax())
        texts = {"title": measure.name, "better": "smaller", "unit": list(measure.joint_unit), "status": ""}
        return {**texts, "values": to_plain(values), "worst": worst}

    # ---- targets and objects ----------------------------------------------------------------------------------------

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

    def find_nearest_object(
        self, q: FloatArray, moved: Sequence[tuple[str, Sequence[float]]]
    ) -> tuple[str, dict[str, Any] | None]:
        """Find the object of the cell that is nearest to the arm at q (n,).

        Returns:
            Sentence about the distance, empty without a cell. None without an object; else the nearest points ``arm`` and
            ``object`` (3,), m, the ``name`` of the object, and whether it is closer than the margin (``blocked``).
        """
        clearance = self.get_clearance(moved)
        if clearance is None or clearance.obstacles is None or clearance.cell is None:
            return "" if self.cell is None else "The cell is empty.", None
        obstacles = clearance.obstacles
        gap = obstacles.find_nearest_gap(q)
        blocked, pair = bool(gap.margin < 0), obstacles.names[gap.pair]
        if gap.distance < 0:
            text = f"In collision: {pair}; the collision model of the arm is {-gap.distance:.3g} m inside."
        else:
            margin = f", closer than the margin of {gap.distance - gap.margin:.3g} m" if blocked else ""
            text = f"Closest: {pair}, at least {gap.distance:.3g} m{margin}."
        name = clearance.cell.objects[obstacles.pairs[gap.pair][1]].name
        return text, {"arm": to_plain(gap.on_arm), "object": to_plain(gap.on_object), "name": name, "blocked": blocked}


def to_plain(values: ArrayLike) -> list[Any]:
    """Convert an array to lists for JSON, with null for infinite numbers and NaN."""
    array = np.asarray(values, dtype=np.float64)
    plain = array.astype(object)
    plain[~np.isfinite(array)] = None
    return cast(list[Any], plain.tolist())


def describe_error(error: BaseException) -> str:
    """Format an exception as a sentence for the user."""
    text = str(error) if isinstance(error, HoldfastError) else f"{type(error).__name__}: {error}"
    return text[:1].upper() + text[1:]
