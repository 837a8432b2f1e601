"""Read recorded or planned motions from files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths.joint_table import is_motion_table, read_motion_table
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
    if not is_motion_table(path):
        log = Log.load(path)
        return log.q_ref, log.rate
    time, q = read_motion_table(arm, path)
    return q, float(1 / np.median(np.diff(time)))


def resample_motion(q: FloatArray, rate: float, new_rate: float) -> FloatArray:
    """Return a motion (T, n) at another sample rate in Hz, by linear interpolation between its samples."""
    t = np.arange(int(np.floor((len(q) - 1) / rate * new_rate + 1e-9)) + 1) / new_rate
    return np.stack([np.interp(t, np.arange(len(q)) / rate, column) for column in q.T], axis=1)
