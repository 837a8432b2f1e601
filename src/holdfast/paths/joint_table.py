"""Tables of configurations in CSV files: a column for each joint, ``joint1_rad`` or ``slide_m``, and others beside them."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.files import reading
from holdfast.files.spreadsheet import read_cell

Array = NDArray[np.float64]


def joint_columns(arm: Arm) -> list[str]:
    """The names of the joints' columns."""
    return [f"{j.name}_{j.unit}" for j in arm.joints]


def motion_columns(arm: Arm) -> tuple[list[str], list[str], list[str]]:
    """The names of the columns of joints, their rates and their accelerations."""
    rates = [f"{j.name}_rate_{j.unit}_per_s" for j in arm.joints]
    return joint_columns(arm), rates, [f"{j.name}_acceleration_{j.unit}_per_s2" for j in arm.joints]


@dataclass(frozen=True)
class JointTable:
    """What such a file holds.

    Attributes:
        title: What it is and where, for messages.
        head: Names of all its columns.
        lines: Number in the file and cells of each line below the header.
    """

    title: str
    head: tuple[str, ...]
    lines: tuple[tuple[int, list[str]], ...]

    def numbers(self, names: Sequence[str]) -> Array:
        """The columns of these names, (K, len(names)).

        Raises:
            InputError: There are no lines, or one without finite numbers there.
        """
        places, rows = [self.head.index(name) for name in names], []
        for number, cells in self.lines:
            try:
                rows.append([float(cells[k]) for k in places])
            except (ValueError, IndexError) as error:
                raise InputError(f"{self.title}, line {number}: it must hold {len(self.head)} numbers") from error
        found = np.array(rows).reshape(len(rows), len(places))
        if not len(found) or not np.isfinite(found).all():
            raise InputError(f"{self.title}: there must be one line or more below the header, all of finite numbers")
        return found


def read_joint_table(arm: Arm, file: Path, what: str, first: str) -> JointTable:
    """A table that has a column for each joint of an arm.

    Args:
        arm: The arm.
        file: CSV.
        what: It should hold, for messages.
        first: Name of a column that may precede the joints', for messages.

    Raises:
        InputError: Unreadable, or a joint's column is missing or given twice.
    """
    title = f"{what} '{file}'"
    try:
        with reading.guarded(title, "give a CSV file"):
            reader = csv.reader(reading.text(file).splitlines())
        lines = [(reader.line_num, cells) for cells in reader if cells]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{title}: this is not a CSV table: {error}") from error
    head = tuple(read_cell(text.strip()) for text in lines[0][1]) if lines else ()
    wanted = joint_columns(arm)
    for name in wanted:
        if head.count(name) != 1:
            raise InputError(
                f"{title}: column '{name}' is missing or given twice; '{arm.name}' needs {', '.join([first, *wanted])}"
            )
    return JointTable(title, head, tuple(lines[1:]))
