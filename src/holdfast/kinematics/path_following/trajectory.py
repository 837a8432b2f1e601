"""Result of tracking a path: joints over time, errors, objective values, and events."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.csv_table import write_rows
from holdfast.core.files.output import guard_writing
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.objective import NegatedObjective, Objective, WeightedSum
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility
from holdfast.kinematics.path_following.slow_motion import SlowMotion, slow_enough
from holdfast.kinematics.paths.joint_table import motion_column_names
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance

TRACKING_TOLERANCE = 1e-4  # m and rad


@dataclass(frozen=True, kw_only=True)
class Event:
    """An event along a path.

    Attributes:
        kind: ``algorithmic singularity``, ``not at an extremum``, ``fast motion``, ``zero cost``, ``value not kept``,
            ``value jump``, ``rate cap``, ``joint limit``, ``end effector slowed``, ``near a singularity``, ``kept clear`` (of
            an object, or of the arm itself, by self-motion) or ``too near`` (closer than required).
        start, end: Begin and end of the event, s.
        text: One sentence for people.
    """

    kind: str
    start: float
    end: float
    text: str


@dataclass(frozen=True, eq=False, kw_only=True)
class Trajectory(Result):
    """Joint motion along a path of the end effector, T samples.

    Attributes:
        arm, task, objective: Arm model, prescribed rows of the end effector, and objective of the self-motion.
        method: Name of the law, for people.
        gain: Gain of the law, with the unit that :func:`holdfast.follow` states.
        seed: Seed of the search for a start.
        rate_cap: Requested largest norm of the joint rates, rad/s, or None.
        time: (T,) time, s.
        q, qd, qdd: (T, n) joint values, rad and m, and their rates per s and s^2.
        poses: (T, 4, 4) target poses of the end effector in the world, m.
        position_error: (T,) position error in the task's rows, m.
        rotation_error: (T,) orientation error, rad.
        value: (T,) value of the objective.
        curvature: (T,) smallest curvature of the objective along the self-motion, above 0 at a proper local best; its unit is
            that of the objective per rad^2.
        self_motion: (T,) fraction of the self-motion that the rate cap allowed.
        task_share: (T,) fraction of the commanded velocity that was executed.
        damping: (T,) above 0 where rates were damped near a singularity.
        steps: Number of computed control steps.
        peak_rate: Largest norm of the joint rates, also between the samples, rad/s.
        peak_time: Time of this peak, s.
        events: Events in order of time.
        best_value: (T,) best value over the whole self-motion manifold of each pose, or None if it was not requested.
        best_path: (T, n) best continuous motion through these manifolds, NaN where there is none; or None.
        torque_bound: Bound by which the report and :meth:`to_dict` rate the slowness of the motion, N m and N; or None.
        clear_of: Collision model of the arm and its cell that the motion respects, or None.
        margin: Required distance beyond that of the cell, m.
    """

    arm: Arm
    task: Task
    objective: Objective
    method: str
    gain: float
    seed: int
    rate_cap: float | None
    time: FloatArray
    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    poses: FloatArray
    position_error: FloatArray
    rotation_error: FloatArray
    value: FloatArray
    curvature: FloatArray
    self_motion: FloatArray
    task_share: FloatArray
    damping: FloatArray
    steps: int
    peak_rate: float
    peak_time: float
    events: tuple[Event, ...]
    best_value: FloatArray | None = None
    best_path: FloatArray | None = None
    torque_bound: float | None = field(default=None, kw_only=True)
    clear_of: Clearance | None = None
    margin: float = 0.0
    _plain: Callable[[], Trajectory] | None = field(default=None, repr=False)

    @property
    def rate_norm(self) -> FloatArray:
        """Norm of the joint rates, (T,) rad/s (prismatic joints in m/s)."""
        return np.asarray(np.linalg.norm(self.qd, axis=1))

    @cached_property
    def clearance(self) -> FloatArray | None:
        """Smallest distance to the checked obstacles and links, (T,) m; a lower bound for objects. None if not checked."""
        return None if self.clear_of is None else self.clear_of(self.q)

    @property
    def nearest(self) -> tuple[int, str] | None:
        """Sample of the smallest clearance and its pair, ``joint3 & table``; None if there is no pair."""
        if self.clear_of is None or self.clearance is None or not self.clear_of.pair_names:
            return None
        sample = int(self.clearance.argmin())
        return sample, self.clear_of.pair_names[int(self.clear_of.by_pair(self.q[sample]).argmin())]

    @cached_property
    def without_objective(self) -> Trajectory | None:
        """Motion along the same path from the same start with least-norm rates; None if this motion has no objective."""
        return None if self._plain is None else self._plain()

    @property
    def worst(self) -> float:
        """Worst value of the objective along the path."""
        return float(self.value.max() if self.objective.better == "smaller" else self.value.min())

    @property
    def on_path(self) -> bool:
        """True if the end effector never left its path by more than 0.1 mm and 0.1 mrad."""
        return bool(
            np.nanmax(self.position_error) <= TRACKING_TOLERANCE and np.nanmax(self.rotation_error) <= TRACKING_TOLERANCE
        )

    @property
    def tool_error(self) -> str:
        """Largest error of the end effector in the components that the task prescribes, as text."""
        rows = self.task.rows
        parts = []
        for error, unit, rows_used in ((self.position_error, "mm", rows[:, :3]), (self.rotation_error, "mrad", rows[:, 3:])):
            if np.any(rows_used):
                largest = 1000 * float(np.nanmax(error))
                number_text = f"{largest:.0f}" if largest >= 100 else f"{largest:.3g}" if largest >= 1e-3 else "less than 0.001"
                parts.append(f"{number_text} {unit}")
        return " and ".join(parts)

    @property
    def headline(self) -> str:
        """Sentence on whether the end effector stayed on its path, and if not, when it left and how far."""
        if self.on_path:
            return f"the end effector stays on its path, off it by {self.tool_error}"
        is_off_path = (self.position_error > TRACKING_TOLERANCE) | (self.rotation_error > TRACKING_TOLERANCE)
        slowing_kinds = {"end effector slowed", "near a singularity"}
        causes = [event.kind for event in self.events if event.kind in slowing_kinds or event.kind == "joint limit"]
        reason = f" ({', '.join(dict.fromkeys(causes))})" if causes else ""
        return (
            f"THE END EFFECTOR LEAVES ITS PATH at {self.time[is_off_path.argmax()]:.4g} s, by up to {self.tool_error}, "
            f"for {is_off_path.mean():.0%} of the time{reason}"
        )

    @property
    def by_joint(self) -> dict[str, FloatArray]:
        """Measures of the failure of each joint, (T, n) signed, of every susceptibility in the objective, by its name."""
        return {measure.slug: measure.by_joint(self.q) for measure in find_susceptibilities(self.objective)}

    def torques(self, time_scale: float = 1.0) -> FloatArray:
        """Compute torques (T, n) of the whole dynamics with viscous friction, N m and N, with time stretched by ``time_scale``.

        Source: English and Maciejewski 1998, eq. (5).

        Raises:
            ArmError: The arm has no inertial data.
            InputError: The factor is not above 0.
        """
        if not (np.isfinite(time_scale) and time_scale > 0):
            raise InputError(f"time_scale is {time_scale:g}; it must be above 0 (2: half as fast)")
        return self.arm.inverse_dynamics(self.q, self.qd / time_scale, self.qdd / time_scale**2)

    def columns(self) -> dict[str, FloatArray]:
        """Return the columns (T,) of the exported table by name: time, joints, rates, accelerations, errors, objective."""
        table = {"time_s": self.time}
        for names, values in zip(motion_column_names(self.arm), (self.q, self.qd, self.qdd), strict=True):
            table |= dict(zip(names, values.T, strict=True))
        table |= {
            "position_error_m": self.position_error,
            "rotation_error_rad": self.rotation_error,
            "objective": self.value,
            "self_motion_fraction": self.self_motion,
            "task_fraction": self.task_share,
        }
        for measure in find_susceptibilities(self.objective):
            for joint, unit, column in zip(self.arm.joints, measure.joint_unit, measure.by_joint(self.q).T, strict=True):
                table[f"{joint.name}_{measure.slug}_{unit}"] = column
        if self.best_value is not None:
            table["best_objective"] = self.best_value
        if self.clearance is not None:
            table["clearance_m"] = self.clearance
        return table

    def to_csv(self, path: str | Path) -> Path:
        """Write the table to the CSV file ``path``, a row for each sample; the name of each column contains its unit.

        Raises:
            StoreError: The file cannot be written.
        """
        table = self.columns()
        columns = (np.asarray(column, dtype=np.float64).tolist() for column in table.values())
        return write_rows(path, table, zip(*columns, strict=True), "motion")

    def to_parquet(self, path: str | Path) -> Path:
        """Write the table of :meth:`to_csv` to the Parquet file ``path``.

        Raises:
            StoreError: The file cannot be written, or pyarrow is not installed.
        """
        try:
            import pyarrow
            from pyarrow import parquet

            with guard_writing(Path(path), "motion", "choose another path"):
                parquet.write_table(pyarrow.table(self.columns()), Path(path))
        except ImportError as error:
            raise StoreError(f"'{path}': Parquet needs pyarrow; install holdfast-arms[parquet], or write CSV") from error
        return Path(path)

    def slowness(self, bound: float) -> list[SlowMotion]:
        """Return for each joint how slow the motion must be; see :func:`holdfast.kinematics.path_following.slow_enough`.

        Args:
            bound: Bound of ``|torque - gravity torque|`` of every joint, N m and N.

        Source: English and Maciejewski 1998, eq. (6).
        """
        joint_bounds = np.where(np.eye(self.arm.n) > 0, bound, np.inf)
        return [slow_enough(self.arm, self.q, self.qd, qdd=self.qdd, bound=joint_bound) for joint_bound in joint_bounds]


def find_susceptibilities(objective: Objective) -> list[Susceptibility]:
    """Return the susceptibilities in an objective; only the first of each kind."""
    if isinstance(objective, NegatedObjective):
        return find_susceptibilities(objective.objective)
    parts = [term for _, term in objective.terms] if isinstance(objective, WeightedSum) else [objective]
    by_slug: dict[str, Susceptibility] = {}
    for part in parts:
        for measure in (
            [part] if isinstance(part, Susceptibility) else find_susceptibilities(part) if part is not objective else []
        ):
            by_slug.setdefault(measure.slug, measure)
    return list(by_slug.values())
