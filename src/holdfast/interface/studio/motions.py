"""Motions for playback, and their files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths.joint_table import joint_columns, read_joint_table
from holdfast.model.arm.model import Arm

TIME_COLUMNS = ("time_s", "time_cycles", "travel_rad")


@dataclass(frozen=True)
class PlayedMotion:
    """Configurations over time.

    Attributes:
        label: Caption of the motion.
        time: (T,) increasing times, in ``unit``.
        unit: Unit of the time: s, cycles, or rad of joint travel.
        q: (T, n) configurations, rad and m.
    """

    label: str
    time: FloatArray
    unit: str
    q: FloatArray

    def to_plain(self) -> dict[str, Any]:
        """Return the motion as plain data for JSON."""
        return {"label": self.label, "unit": self.unit, "time": self.time.tolist(), "q": self.q.tolist()}


def read_motion(arm: Arm, path: str | Path) -> PlayedMotion:
    """Read the motion from a CSV file of ``holdfast follow``, ``simulate`` or ``recover``, or from their output folder.

    Raises:
        InputError: There is no such file, or a column or number is missing or wrong; the message names it.
    """
    file = Path(path)
    if file.is_dir():
        names = ("trajectory.csv", "run.csv", "waypoints.csv", "motion.csv")
        motion_files = [file / name for name in names if (file / name).is_file()]
        if not motion_files:
            raise InputError(
                f"folder '{file}' contains no motion; give one that follow, simulate, recover or plan-motion wrote with --out"
            )
        file = motion_files[0]
    table = read_joint_table(arm, file, "motion", TIME_COLUMNS[0])
    time_column = next((name for name in TIME_COLUMNS if name in table.header), None)
    if time_column is None:
        raise InputError(f"{table.title}: a column '{TIME_COLUMNS[0]}' is missing; it must contain the time of each row")
    samples = table.select_columns([time_column, *joint_columns(arm)])
    if (np.diff(samples[:, 0]) < 0).any():
        raise InputError(f"{table.title}: time must not run backwards; sort the lines by '{time_column}'")
    return PlayedMotion(file.name, samples[:, 0], time_column.rpartition("_")[2], samples[:, 1:])
