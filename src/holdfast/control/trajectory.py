"""What came of following a path: joints over time, what it cost, and what happened on the way."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.errors import InputError, StoreError
from holdfast.indices import Objective

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Event:
    """Something that happened along a path.

    Attributes:
        kind: ``algorithmic singularity``, ``not at an extremum``, ``zero cost``, ``rate cap``, ``joint limit``, ``hand slowed``
            or ``near a singularity``.
        start, end: From when to when, s.
        text: One sentence for people.
    """

    kind: str
    start: float
    end: float
    text: str


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Joints along a path of the hand, T samples.

    Attributes:
        arm, task, objective: What moved, which rows of the hand were prescribed, and what the self-motion served.
        method: The law, for people.
        time: (T,) s.
        q, qd, qdd: (T, n) rad and m, and their rates per s and s^2.
        poses: (T, 4, 4) wanted poses of the hand in the world.
        position_error: (T,) m, of the task's rows.
        rotation_error: (T,) rad.
        value: (T,) of the objective.
        curvature: (T,) smallest curvature of the objective along the self-motion, larger than 0 at a proper local best; its
            unit is that of the objective per rad^2.
        self_motion: (T,) share of the self-motion that the rate cap let pass.
        task_share: (T,) share of the commanded velocity that was carried out.
        damping: (T,) above 0 where rates were damped near a singularity.
        events: What happened, in order.
        best_value: (T,) the best value over the whole self-motion manifold of each pose, or None if it was not asked for.
        best_path: (T, n) the best continuous motion through these manifolds, NaN where there is none; or None.
    """

    arm: Arm
    task: Task
    objective: Objective
    method: str
    time: Array
    q: Array
    qd: Array
    qdd: Array
    poses: Array
    position_error: Array
    rotation_error: Array
    value: Array
    curvature: Array
    self_motion: Array
    task_share: Array
    damping: Array
    events: tuple[Event, ...]
    best_value: Array | None = None
    best_path: Array | None = None

    @property
    def rate_norm(self) -> Array:
        """(T,) norm of the joint rates, rad/s (sliding joints in m/s)."""
        return np.asarray(np.linalg.norm(self.qd, axis=1))

    @property
    def on_path(self) -> bool:
        """True if the hand never left its path by more than 0.1 mm and 0.1 mrad."""
        return bool(np.nanmax(self.position_error) <= 1e-4 and np.nanmax(self.rotation_error) <= 1e-4)

    def torques(self, time_scale: float = 1.0) -> Array:
        """Torques (T, n) of the whole dynamics, viscous friction included, N m and N, with time stretched by a factor.

        Source: English and Maciejewski 1998, eq. (5).

        Raises:
            ArmError: The arm has no inertial data.
            InputError: A factor that is not above 0.
        """
        if not (np.isfinite(time_scale) and time_scale > 0):
            raise InputError(f"time_scale is {time_scale:g}; it must be above 0 (2: half as fast)")
        return self.arm.inverse_dynamics(self.q, self.qd / time_scale, self.qdd / time_scale**2)

    def columns(self) -> dict[str, Array]:
        """Named columns (T,) of the table that files hold: time, joints, rates, accelerations, errors, objective."""
        table = {"time_s": self.time}
        for suffix, values, per in (("", self.q, ""), ("_rate", self.qd, "_per_s"), ("_acceleration", self.qdd, "_per_s2")):
            for joint, column in zip(self.arm.joints, values.T, strict=True):
                table[f"{joint.name}{suffix}_{joint.unit}{per}"] = column
        table |= {
            "position_error_m": self.position_error,
            "rotation_error_rad": self.rotation_error,
            "objective": self.value,
            "self_motion_share": self.self_motion,
            "task_share": self.task_share,
        }
        if self.best_value is not None:
            table["best_objective"] = self.best_value
        return table

    def save(self, path: str | Path) -> Path:
        """Write the table as CSV, or as Parquet if the name ends in ``.parquet`` (needs pandas and pyarrow).

        Raises:
            StoreError: The file cannot be written, or what Parquet needs is not installed.
        """
        target = Path(path)
        table = self.columns()
        try:
            if target.suffix.lower() == ".parquet":
                import pandas as pd

                pd.DataFrame(table).to_parquet(target, index=False)
            else:
                with target.open("w", newline="", encoding="utf-8") as file:
                    writer = csv.writer(file)
                    writer.writerow(table)
                    writer.writerows(zip(*[[repr(float(x)) for x in column] for column in table.values()], strict=True))
        except ImportError as error:
            raise StoreError(f"'{target}': Parquet needs pyarrow; install holdfast[parquet], or give a name in .csv") from error
        except OSError as error:
            raise StoreError(f"'{target}' cannot be written: {error.strerror or error}") from error
        return target

    def describe(self) -> list[str]:
        """A few sentences for people: how far, how well, and what happened."""
        lines = [
            f"{self.method} on '{self.arm.name}', {self.time[-1]:.4g} s, {len(self.time)} samples; the hand stays within "
            f"{np.nanmax(self.position_error):.2g} m and {np.nanmax(self.rotation_error):.2g} rad of its path",
            f"{self.objective.name}: {self.value[0]:.4g} at the start, {self.value[-1]:.4g} at the end, "
            f"mean {self.value.mean():.4g}, range {self.value.min():.4g} to {self.value.max():.4g}",
            f"largest norm of the joint rates {self.rate_norm.max():.4g} rad/s at {self.time[self.rate_norm.argmax()]:.4g} s",
        ]
        return lines + [e.text for e in self.events]
