"""The result of a free swing of a failed joint over time and when brakes act."""

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

    The brakes are taken to stop the joint at once, so the tool stays there; ``speed`` says how bold that is.

    Attributes:
        after_ms: Time from the failure to the brakes, ms.
        angle: How far the joint has moved, rad or m.
        speed: Speed of the joint at that moment, rad/s or m/s.
        drop: How far the tool has moved down, along gravity, m; negative if it has risen.
        distance: Distance between the tool's place then and at the failure, m.
    """

    after_ms: float
    angle: float
    speed: float
    drop: float
    distance: float


@dataclass(frozen=True, kw_only=True)
class FreeSwing(Result):
    """The motion of an arm at rest whose joint ``joint`` swings free from time 0, with all others locked.

    Attributes:
        arm: The arm.
        q: (n,) configuration at the failure, rad or m.
        joint: Index from 0 of the failed joint.
        damping: Viscous friction used, N m s/rad or N s/m.
        time: (T,) s.
        angle: (T,) how far the joint has moved since the failure, rad or m; positive about or along its axis.
        velocity: (T,) rad/s or m/s.
        tool_position: (T, 3) tool point in the world, m.
        rest_angle: Where it stops, counted from the failure, rad or m; NaN if it was still moving at the end.
            Without stops this is the swing angle of English and Maciejewski (1998), eq. (38).
        peak: Largest distance from where it failed, rad or m.
        initial_acceleration: At the moment of failure, stops aside, rad/s^2 or m/s^2; the acceleration measure of English
            and Maciejewski (1998), eq. (22), with the rotor inertia added.
        outcome: ``rest`` (hangs still), ``stop`` (lies against a limit), ``contact`` (lies against an object), ``balanced``
            (gravity does not move it) or ``moving`` (not at rest in the time given).
        drops: One per brake time.
        cell: The objects around the arm, or None.
        contacts: First of each link with each object of the cell, in order of time; None without a cell.
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
        """Write the motion as rows over time: how far the joint has moved, its speed, and the tool point, m.

        Raises:
            StoreError: It cannot be written.
        """
        unit = self.arm.joints[self.joint].unit
        header = ["time_s", f"moved_{unit}", f"speed_{unit}_s", "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.angle, self.velocity, self.tool_position]))
