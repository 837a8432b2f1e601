"""Tables of configurations in CSV files: one column per joint, such as ``joint1_rad`` or ``slide_m``, and any other columns."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.spreadsheet import unescape_formula
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm


def joint_columns(arm: Arm) -> list[str]:
    """Return the names of the joints' columns."""
    return [f"{joint.name}_{joint.unit}" for joint in arm.joints]


def motion_column_names(arm: Arm) -> tuple[list[str], list[str], list[str]]:
    """Return the names of the columns of joints, their rates, and their accelerations."""
    rates = [f"{joint.name}_rate_{joint.unit}_per_s" for joint in arm.joints]
    return joint_columns(arm), rates, [f"{joint.name}_acceleration_{joint.unit}_per_s2" for joint in arm.joints]


@dataclass(frozen=True)
class JointTable:
    """Contents of a table of configurations.

    Attributes:
        title: What it is and where, for messages.
        header: Names of all its columns.
        numbered_lines: Number in the file and cells of each line below the header.
    """

    title: str
    header: tuple[str, ...]
    numbered_lines: tuple[tuple[int, list[str]], ...]

    def select_columns(self, names: Sequence[str]) -> FloatArray:
        """Return the columns with the given names, (K, len(names)).

        Raises:
            InputError: There are no lines, or one without finite numbers there.
        """
        column_indices, rows = [self.header.index(name) for name in names], []
        for number, cells in self.numbered_lines:
            try:
                rows.append([float(cells[index]) for index in column_indices])
            except (ValueError, IndexError) as error:
                raise InputError(f"{self.title}, line {number}: it must hold {len(self.header)} numbers") from error
        columns = np.array(rows).reshape(len(rows), len(column_indices))
        if not len(columns) or not np.isfinite(columns).all():
            raise InputError(f"{self.title}: there must be one line or more below the header, all of finite numbers")
        return columns


def read_joint_table(arm: Arm, file: Path, content_name: str, leading_column: str) -> JointTable:
    """Read a table that has a column for each joint of an arm.

    Args:
        arm: The arm.
        file: CSV.
        content_name: It should hold, for messages.
        leading_column: Name of a column that may precede the joints', for messages.

    Raises:
        InputError: Unreadable, or a joint's column is missing or given twice.
    """
    title = f"{content_name} '{file}'"
    try:
        with reading.guard_reading(title, "give a CSV file"):
            reader = csv.reader(reading.read_text(file).splitlines())
        lines = [(reader.line_num, cells) for cells in reader if cells]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{title}: this is not a CSV table: {error}") from error
    header = tuple(unescape_formula(text.strip()) for text in lines[0][1]) if lines else ()
    required = joint_columns(arm)
    for name in required:
        if header.count(name) != 1:
            raise InputError(
                f"{title}: column '{name}' is missing or given twice; '{arm.name}' needs "
                f"{', '.join([leading_column, *required])}"
            )
    return JointTable(title, header, tuple(lines[1:]))
