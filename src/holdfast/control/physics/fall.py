"""Result of the free swing of a failed joint, over time and at the moments at which brakes act."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from holdfast.core.files.output import write_table
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.contacts import Contact

Outcome = Literal["rest", "stop", "contact", "balanced", "moving"]


@dataclass(frozen=True, kw_only=True)
class BrakedDrop:
    """State of the joint and the tool when the brakes act.

    The brakes are assumed to stop the joint at once, so the tool stays there. The higher ``speed`` is, the more optimistic is
    this assumption.

    Attributes:
        after_ms: Time from the failure to the brakes, ms.
        angle: Displacement of the joint since the failure, rad or m.
        speed: Speed of the joint at that moment, rad/s or m/s.
        drop: Displacement of the tool along gravity since the failure, m; negative if the tool has risen.
        distance: Distance between the tool point at that moment and at the failure, m.
    """

    after_ms: float
    angle: float
    speed: float
    drop: float
    distance: float


@dataclass(frozen=True, kw_only=True)
class FreeSwing(Result):
    """Motion of an arm at rest whose joint ``joint`` swings free from time 0, with all others locked, over T time steps.

    Attributes:
        arm: The arm.
        q: (n,) configuration at the failure, rad or m.
        joint: Index from 0 of the failed joint.
        damping: Viscous friction of the joint, N m s/rad or N s/m.
        time: (T,) time since the failure, s.
        angle: (T,) displacement of the joint since the failure, rad or m; positive about or along its axis.
        velocity: (T,) velocity of the joint, rad/s or m/s.
        tool_position: (T, 3) tool point in the world, m.
        rest_angle: Displacement at which the joint stops, rad or m; NaN if it was still moving at the end.
            Without stops this is the swing angle of English and Maciejewski (1998), eq. (38).
        peak: Largest distance of the joint from its value at the failure, rad or m.
        initial_acceleration: Acceleration at the moment of failure without stops, rad/s^2 or m/s^2. This is the acceleration
            measure of English and Maciejewski (1998), eq. (22), with the rotor inertia added.
        outcome: ``rest`` (hangs still), ``stop`` (lies against a limit), ``contact`` (lies against an object), ``balanced``
            (gravity does not move it) or ``moving`` (not at rest at the end of the time).
        drops: State at each brake time.
        cell: Objects around the arm; None without a cell.
        contacts: First contact of each link with each object of the cell, in order of time; None without a cell.
    """

    arm: Arm
    q: FloatArray
    joint: int
    damping: float
    time: FloatArray
    angle: FloatArray
    velocity: FloatArray
    tool_position: FloatArray
    rest_angle: float
    peak: float
    initial_acceleration: float
    outcome: Outcome
    drops: tuple[BrakedDrop, ...]
    cell: Cell | None = None
    contacts: tuple[Contact, ...] | None = None

    @property
    def is_settled(self) -> bool:
        """False if the joint was still moving at the end."""
        return self.outcome != "moving"

    @property
    def is_at_stop(self) -> bool:
        """True if the joint ended against one of its limits."""
        return self.outcome == "stop"

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion to ``file`` as rows over time: displacement and velocity of the joint, and the tool point, m.

        Raises:
            StoreError: The file cannot be written.
        """
        unit = self.arm.joints[self.joint].unit
        header = ["time_s", f"moved_{unit}", f"speed_{unit}_s", "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.angle, self.velocity, self.tool_position]))
