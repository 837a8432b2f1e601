"""Result of a run of the closed loop with bodies and motors, and its distance from the kinematic run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from holdfast.control.physics.servos import Servos, max_tracking_error, saturated_fraction
from holdfast.control.simulation.runs import RunPath, Runs
from holdfast.core.caching import cached_property
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.collision.contacts import Contact

if TYPE_CHECKING:
    from holdfast.control.laws.law import Law

Ending = Literal["converged", "stuck", "moving", "undecided"]
Why = Literal["none", "singular", "time_limit", "unstable", "contact"]

KINEMATIC_SAMPLES = 4000  # samples of the kinematic path, at equal times
PATH_SEGMENTS = 800  # segments of equal length, into which each path is split to measure their distance


@dataclass(frozen=True, eq=False, kw_only=True)
class PhysicalRun(Result):
    """One run of :func:`holdfast.simulate_physics` over T control cycles.

    Attributes:
        law: The control law.
        servos: The joint servos.
        stiffness: (n,) stiffness of the servos, N m/rad (N/m for prismatic joints).
        damping: (n,) damping of the servos, N m s/rad (N s/m for prismatic joints).
        kinematic: The same run without bodies, by :func:`holdfast.control.simulation.simulate`.
        outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``.
        reason: Reason why the run is undecided (``singular``, ``time_limit`` or ``unstable``); ``contact`` if an object holds
            the arm; else ``none``.
        time: (T,) simulated time, s.
        q: (T, n) measured configuration, rad and m.
        reference: (T, n) references of the servos, rad and m.
        torque: (T, n) motor torque of healthy joints with gravity compensation, N m and N; 0 for a locked joint.
        x: (T, 3) tool point in the world, m.
        error: (T,) norm of the task's error, m and rad.
        contacts: First contact of each link with each object of the cell, in order of time; None without a cell.
    """

    law: Law
    servos: Servos
    stiffness: FloatArray
    damping: FloatArray
    kinematic: Runs
    outcome: Ending
    reason: Why
    time: FloatArray
    q: FloatArray
    reference: FloatArray
    torque: FloatArray
    x: FloatArray
    error: FloatArray
    contacts: tuple[Contact, ...] | None = None

    @property
    def agrees(self) -> bool:
        """True if the kinematic run ended in the same way."""
        return self.outcome == str(self.kinematic.outcome)

    @property
    def ending(self) -> str:
        """Outcome of the run as text, with the reason if it is undecided."""
        if self.reason == "time_limit":
            return f"still moving at the limit of {self.time[-1]:.6g} s"
        return self.outcome if self.reason == "none" else f"{self.outcome} ({self.reason})"

    @cached_property
    def errors_apart(self) -> tuple[FloatArray, FloatArray]:
        """(T,) distance from the target, m, and (T,) angle from the target, rad."""
        return self.kinematic._simulator.compute_errors(self.kinematic, 0, self.q)

    @cached_property
    def kinematic_path(self) -> RunPath:
        """Path of the kinematic run over the time of this run, or until it was at rest."""
        return self.kinematic.path(0, KINEMATIC_SAMPLES, until=max(float(self.time[-1]), 1e-3))

    @property
    def terminal_distance(self) -> float:
        """Distance between the tool points of both runs at the end of this run, m."""
        return float(np.linalg.norm(self.x[-1] - self.kinematic_path.x[-1]))

    @property
    def terminal_turn(self) -> float:
        """Angle between the tool orientations of both runs at the end of this run, rad."""
        ends = np.stack([self.q[-1], self.kinematic_path.q[-1]])
        physical_rotation, kinematic_rotation = self.law.arm.forward_kinematics(ends)[:, :3, :3]
        # The arccosine of the trace would lose half of the digits of small angles.
        return float(2 * np.arcsin(min(np.linalg.norm(physical_rotation - kinematic_rotation) / np.sqrt(8), 1.0)))

    @cached_property
    def path_distance(self) -> float:
        """Largest distance of a point of either tool path from the other path, m, as curves regardless of time."""
        physical_points, kinematic_points = _resample_evenly(self.x), _resample_evenly(self.kinematic_path.x)
        return max(_max_distance(physical_points, kinematic_points), _max_distance(kinematic_points, physical_points))

    @property
    def tracking_error(self) -> FloatArray:
        """(n,) largest distance of each joint from its reference while it was healthy, rad or m."""
        return max_tracking_error(self.q, self.reference, self.is_locked)

    @property
    def saturated_fraction(self) -> FloatArray:
        """(n,) fraction of the time for which the motor of each joint was torque-saturated while the joint was healthy."""
        return saturated_fraction(self.law.arm, self.torque, self.is_locked)

    @cached_property
    def is_locked(self) -> BoolArray:
        """(T, n) array that is True where a joint is locked."""
        return np.asarray(self.time[:, None] >= self.kinematic.lock_time - 1e-9)


def _resample_evenly(points: FloatArray) -> FloatArray:
    """Resample a path (T, 3) to points (P, 3) at equal lengths along it."""
    length = np.r_[0.0, np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()]
    if length[-1] == 0:
        return points[:1]
    sample_lengths = np.linspace(0, length[-1], PATH_SEGMENTS + 1)
    return np.stack([np.interp(sample_lengths, length, column) for column in points.T], axis=1)


def _max_distance(points: FloatArray, path: FloatArray) -> float:
    """Return the largest distance of points (P, 3) from a path of straight segments (S, 3)."""
    if len(path) == 1:
        return float(np.linalg.norm(points - path[0], axis=1).max())
    start, segments = path[:-1], np.diff(path, axis=0)
    squared_lengths = np.maximum((segments**2).sum(axis=1), np.finfo(np.float64).tiny)
    offsets = points[:, None] - start
    fraction = np.clip((offsets * segments).sum(axis=2) / squared_lengths, 0, 1)
    return float(np.linalg.norm(offsets - fraction[:, :, None] * segments, axis=2).min(axis=1).max())
