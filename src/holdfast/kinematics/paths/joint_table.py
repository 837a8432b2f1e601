"""Tables of configurations in CSV files: one column per joint, such as ``joint1_rad`` or ``slide_m``, and any other columns."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files.csv_table import CsvTable, read_csv_table
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm


def joint_columns(arm: Arm) -> list[str]:
    """Return the column names of the joints."""
    return [f"{joint.name}_{joint.unit}" for joint in arm.joints]


def motion_column_names(arm: Arm) -> tuple[list[str], list[str], list[str]]:
    """Return the column names of the joints, their rates, and their accelerations."""
    rates = [f"{joint.name}_rate_{joint.unit}_per_s" for joint in arm.joints]
    return joint_columns(arm), rates, [f"{joint.name}_acceleration_{joint.unit}_per_s2" for joint in arm.joints]


def read_joint_table(arm: Arm, file: Path, content_name: str, leading_column: str) -> CsvTable:
    """Read a table that has a column for each joint of an arm.

    Args:
        arm: Arm model.
        file: CSV file.
        content_name: Name of the content, for messages.
        leading_column: Name of a column that may precede the joint columns, for messages.

    Raises:
        InputError: The file cannot be read, or the column of a joint is missing or given twice.
    """
    table = read_csv_table(file, f"{content_name} '{file}'")
    required = joint_columns(arm)
    for name in required:
        if table.header.count(name) != 1:
            raise InputError(
                f"{table.title}: column '{name}' is missing or given twice; '{arm.name}' needs "
                f"{', '.join([leading_column, *required])}"
            )
    return table


def is_motion_table(file: Path) -> bool:
    """Return True for a table whose first column is ``time_s``."""
    return file.is_file() and file.read_bytes()[:6] == b"time_s"


def read_motion_table(arm: Arm, file: Path) -> tuple[FloatArray, FloatArray]:
    """Read a table with ``time_s`` and one column for each joint of an arm.

    Returns:
        Times (T,), s, and configurations (T, n), rad and m.

    Raises:
        InputError: The file cannot be read, a column is missing, or the time does not increase over two lines or more.
    """
    table = read_joint_table(arm, file, "motion", "time_s")
    numbers = table.select_columns(["time_s", *joint_columns(arm)])
    if len(numbers) < 2 or not (np.diff(numbers[:, 0]) > 0).all():
        raise InputError(f"{table.title}: its time must increase over two lines or more")
    return numbers[:, 0], numbers[:, 1:]
