"""Result of a joint motion with bodies and motors: tool error, constraint violations, limits, and rest."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from holdfast.control.physics.servos import Servos, max_tracking_error, saturated_fraction
from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError
from holdfast.core.files.output import write_table
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.paths.joint_table import joint_columns
from holdfast.kinematics.tool_constraints.constraint import CONSTRAINT_TOLERANCE, ToolConstraint
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.contacts import Contact
from holdfast.model.failure_modes import Degraded

Ended = Literal["finished", "stopped", "moving", "unstable"]

LIMIT_TOLERANCE = 1e-3  # rad or m by which servos may exceed a position limit
_MIN_SHOWN_ERROR = 1e-3  # mm or deg
SPEED_TOLERANCE_FRACTION = 0.01  # fraction of a speed limit by which servos may exceed it


@dataclass(frozen=True, eq=False, kw_only=True)
class Execution(Result):
    """One run of :func:`holdfast.execute` over T control cycles.

    Attributes:
        arm: The healthy arm.
        degraded: Degraded arm at the end, with the values at which joints locked during the motion; None without a failure.
        servos: The joint servos.
        stiffness: (n,) stiffness of the servos, N m/rad (N/m for prismatic joints).
        damping: (n,) damping of the servos, N m s/rad (N s/m for prismatic joints).
        lock_time: (n,) time at which each joint locked, s; infinite for joints that did not lock.
        noticed: Time at which the controller detected the lock, s; infinite if it did not before the end of the motion.
        outcome: ``finished`` if the motion was executed to its end; ``stopped`` if the arm slowed to a standstill after the
            lock was detected; ``moving`` if it was not at rest at the end of the time; ``unstable`` if the physics diverged.
        time: (T,) simulated time, s.
        q: (T, n) measured configuration, rad and m.
        rates: (T, n) measured joint rates, rad/s and m/s.
        reference: (T, n) references of the servos, rad and m.
        planned: (T, n) configuration according to the motion, rad and m, slowed down after a lock is detected.
        torque: (T, n) motor torque of healthy joints with gravity compensation, N m and N; 0 for a locked joint.
        goal: (4, 4) pose or (3,) position that the tool should have at the end, m, world; None without a goal.
        keep: Constraints that the tool should satisfy at every instant.
        contacts: First contact of each link with each object of the cell, in order of time; None without a cell.
        cell: Objects around the arm; None without a cell.
        error_limit: Largest allowed distance of a joint from the motion, rad and m; None without a limit.
    """

    arm: Arm
    degraded: Degraded | None
    servos: Servos
    stiffness: FloatArray
    damping: FloatArray
    lock_time: FloatArray
    noticed: float
    outcome: Ended
    time: FloatArray
    q: FloatArray
    rates: FloatArray
    reference: FloatArray
    planned: FloatArray
    torque: FloatArray
    goal: FloatArray | None = None
    keep: tuple[ToolConstraint, ...] = ()
    contacts: tuple[Contact, ...] | None = None
    cell: Cell | None = None
    error_limit: tuple[float, float] | None = None

    @property
    def q_final(self) -> FloatArray:
        """(n,) configuration at the end, rad and m, from which :func:`holdfast.recover` starts, together with ``degraded``."""
        return np.asarray(self.q[-1])

    @cached_property
    def poses(self) -> FloatArray:
        """(T, 4, 4) poses of the end effector in the world, m."""
        return self.arm.forward_kinematics(self.q)

    @property
    def goal_distance(self) -> float | None:
        """Distance between the tool point at the end and the goal, m; None without a goal."""
        if self.goal is None:
            return None
        goal_point = self.goal[:3, 3] if self.goal.ndim == 2 else self.goal
        return float(np.linalg.norm(self.poses[-1, :3, 3] - goal_point))

    @property
    def goal_turn(self) -> float | None:
        """Angle between the tool at the end and the goal, rad; None without a goal that has an orientation."""
        if self.goal is None or self.goal.ndim == 1:
            return None
        return float(np.linalg.norm(rotation_vectors(self.poses[-1, :3, :3] @ self.goal[:3, :3].T)))

    @property
    def is_at_goal(self) -> bool:
        """True if the tool is at the goal, within 1 mm and 0.5 deg, or if there is no goal."""
        return (self.goal_distance or 0.0) <= CONSTRAINT_TOLERANCE[0] and (self.goal_turn or 0.0) <= CONSTRAINT_TOLERANCE[1]

    @cached_property
    def constraint_errors(self) -> tuple[tuple[float, float], ...]:
        """Largest position error, m, and orientation error, rad, of the tool for each constraint in ``keep``."""
        return tuple(constraint.farthest(self.poses) for constraint in self.keep)

    @cached_property
    def broken(self) -> tuple[str, ...]:
        """Violations of the constraints in ``keep``, a phrase each; none if all were satisfied."""
        return tuple(violation for constraint in self.keep if (violation := constraint.trouble(self.poses)))

    @cached_property
    def beyond_limits(self) -> dict[str, float]:
        """Largest excess of each joint that passed a limit in force by more than 1 mrad or 1 mm, by joint name, rad or m."""
        excess = np.zeros(self.arm.n)
        for arm, samples in self._arms_by_sample_range:
            q = self.q[samples]
            excess = np.maximum(excess, np.maximum(arm.lower - q, q - arm.upper).max(axis=0, initial=0.0))
        return {self.arm.joint_names[joint]: float(excess[joint]) for joint in np.flatnonzero(excess > LIMIT_TOLERANCE)}

    @cached_property
    def too_fast(self) -> dict[str, float]:
        """Highest speed of each joint that exceeded the speed limit in force by more than 1 %, by joint name, rad/s or m/s."""
        speed_by_joint: dict[str, float] = {}
        for arm, samples in self._arms_by_sample_range:
            peak_speeds = np.abs(self.rates[samples]).max(axis=0, initial=0.0)
            for joint, speed in zip(arm.joints, peak_speeds, strict=True):
                if speed > joint.velocity * (1 + SPEED_TOLERANCE_FRACTION):
                    speed_by_joint[joint.name] = max(float(speed), speed_by_joint.get(joint.name, 0.0))
        return speed_by_joint

    @property
    def _arms_by_sample_range(self) -> list[tuple[Arm, slice]]:
        """Arms with the limits in force and their samples; the degraded limits hold from the first lock on."""
        if self.degraded is None:
            return [(self.arm, slice(None))]
        first_lock = float(self.lock_time.min())
        sample = int(np.searchsorted(self.time, first_lock - 1e-9)) if np.isfinite(first_lock) else 0
        return [(self.arm, slice(sample)), (self.degraded.limited, slice(sample, None))]

    @cached_property
    def is_locked(self) -> BoolArray:
        """(T, n) array that is True where a joint is locked."""
        return np.asarray(self.time[:, None] >= self.lock_time - 1e-9)

    @property
    def tracking_error(self) -> FloatArray:
        """(n,) largest distance of each joint from its reference while it was healthy, rad or m."""
        return max_tracking_error(self.q, self.reference, self.is_locked)

    @cached_property
    def following_error(self) -> FloatArray:
        """(T, n) distance of each joint, including locked joints, from the motion, rad or m."""
        return np.abs(self.q - self.planned)

    @cached_property
    def first_excess(self) -> tuple[str, float] | None:
        """Name of the joint that first exceeds the limit of the following error, and the time, s; None if no joint does."""
        if self.error_limit is None:
            return None
        error_fraction = self.following_error / np.where(self.arm.prismatic, self.error_limit[1], self.error_limit[0])
        exceeding = np.flatnonzero((error_fraction > 1).any(axis=1))
        if not exceeding.size:
            return None
        return self.arm.joint_names[int(error_fraction[exceeding[0]].argmax())], float(self.time[exceeding[0]])

    @cached_property
    def tool_error(self) -> tuple[FloatArray, FloatArray]:
        """(T,) distance between the measured and the planned tool point, m, and (T,) angle between their orientations, rad."""
        planned = self.arm.forward_kinematics(self.planned)
        rotations = rotation_vectors(self.poses[:, :3, :3] @ planned[:, :3, :3].transpose(0, 2, 1))
        return np.linalg.norm(self.poses[:, :3, 3] - planned[:, :3, 3], axis=1), np.linalg.norm(rotations, axis=1)

    @property
    def saturated_fraction(self) -> FloatArray:
        """(n,) fraction of the time for which the motor of each joint was torque-saturated while the joint was healthy."""
        return saturated_fraction(self.arm, self.torque, self.is_locked)

    @property
    def ok(self) -> bool:
        """True if the motion was finished at the goal without violated constraints, exceeded limits, or contacts."""
        is_complete = self.outcome == "finished" and self.is_at_goal and not self.broken
        return is_complete and not self.beyond_limits and not self.too_fast and not self.contacts and self.first_excess is None

    def require_ok(self) -> Execution:
        """Return the execution, or raise :class:`holdfast.HoldfastError` with its faults."""
        if not self.ok:
            raise HoldfastError(f"execution: {'; '.join(self.faults())}")
        return self

    def faults(self) -> list[str]:
        """Return the reasons for which the execution is not ``ok``, a phrase each."""
        phrases = [] if self.outcome == "finished" else [_OUTCOME_TEXTS[self.outcome]]
        if not self.is_at_goal:
            phrases.append(f"the tool is {self._format_goal_error()} off the goal")
        phrases += [f"the tool was {violation}" for violation in self.broken]
        units = {joint.name: joint.unit for joint in self.arm.joints}
        phrases += [f"{name} was {value:.3g} {units[name]} outside its limits" for name, value in self.beyond_limits.items()]
        phrases += [f"{name} moved at {value:.4g} {units[name]}/s, too fast" for name, value in self.too_fast.items()]
        if self.first_excess is not None and self.error_limit is not None:
            joint = self.arm.joints[self.arm.joint_index(self.first_excess[0])]
            factor, unit = joint.display_unit
            limit = factor * self.error_limit[joint.prismatic]
            phrases.append(
                f"the following error first exceeds {limit:.4g} {unit} at {self.first_excess[1]:.4g} s, in {joint.name}"
            )
        return phrases + [contact.sentence() for contact in self.contacts or ()]

    def _format_goal_error(self) -> str:
        angle_text = "" if self.goal_turn is None else f" and {format_error(np.rad2deg(self.goal_turn))} deg"
        return f"{format_error(1000 * (self.goal_distance or 0.0))} mm{angle_text}"

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion to ``file`` as rows over time with the measured joints, rad and m, and the tool point, m.

        Raises:
            StoreError: The file cannot be written.
        """
        header = ["time_s", *joint_columns(self.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.q, self.poses[:, :3, 3]]))


def format_error(value: float) -> str:
    """Return an error in mm or deg as text; an error too small to matter becomes an upper bound."""
    return f"{value:.3g}" if value >= _MIN_SHOWN_ERROR or value == 0 else f"less than {_MIN_SHOWN_ERROR:g}"


_OUTCOME_TEXTS = {
    "finished": "the motion was carried out to its end",
    "stopped": "the arm stopped on the way",
    "moving": "the arm was still moving at the end",
    "unstable": "the physics left all bounds; make the servos softer or their rate higher",
}
