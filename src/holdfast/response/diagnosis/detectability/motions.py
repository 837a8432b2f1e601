"""Read recorded or planned motions from files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths.joint_table import joint_columns, read_joint_table
from holdfast.model.arm.model import Arm
from holdfast.response.faults.log import Log


def read_motion(arm: Arm, file: str | Path) -> tuple[FloatArray, float]:
    """Read a motion of an ``arm`` from a ``file``: a log, or a CSV table with ``time_s`` and one column for each joint.

    Returns:
        References (T, n), rad and m, and their sample rate, Hz.

    Raises:
        InputError: The file cannot be read, or has neither format.
    """
    path = Path(file)
    first_bytes = path.read_bytes()[:6] if path.is_file() else b""
    if first_bytes != b"time_s":
        log = Log.load(path)
        return log.q_ref, log.rate
    table = read_joint_table(arm, path, "motion", "time_s")
    numbers = table.select_columns(["time_s", *joint_columns(arm)])
    if len(numbers) < 2 or not (np.diff(numbers[:, 0]) > 0).all():
        raise InputError(f"{table.title}: its time must increase over two lines or more")
    return numbers[:, 1:], float(1 / np.median(np.diff(numbers[:, 0])))


def resample_motion(q: FloatArray, rate: float, new_rate: float) -> FloatArray:
    """Return a motion (T, n) at another sample rate in Hz, by linear interpolation between its samples."""
    t = np.arange(int(np.floor((len(q) - 1) / rate * new_rate + 1e-9)) + 1) / new_rate
    return np.stack([np.interp(t, np.arange(len(q)) / rate, column) for column in q.T], axis=1)
