"""Write rows to CSV files, and read columns of numbers from them."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.output import open_replacement
from holdfast.core.files.spreadsheet import escape_formula, unescape_formula
from holdfast.core.typing import FloatArray


def write_rows(path: str | Path, header: Iterable[str], rows: Iterable[Iterable[Any]], content_name: str = "") -> Path:
    """Write rows of texts and numbers with all digits; ``content_name`` is the name of the content in error messages.

    Raises:
        StoreError: The file cannot be written.
    """
    file = Path(path)
    with open_replacement(file, content_name) as stream:
        writer = csv.writer(stream)
        writer.writerow(map(escape_formula, header))
        writer.writerows([escape_formula(value) for value in row] for row in rows)
    return file


@dataclass(frozen=True)
class CsvTable:
    """Contents of a CSV file.

    Attributes:
        title: Name and path of the file, for messages.
        header: Names of all columns.
        numbered_lines: Line number in the file and cells of each line below the header.
    """

    title: str
    header: tuple[str, ...]
    numbered_lines: tuple[tuple[int, list[str]], ...]

    def select_columns(self, names: Sequence[str]) -> FloatArray:
        """Return the columns ``names`` (K strings of the header) of all L lines, (L, K).

        Raises:
            InputError: There are no lines, or a cell of these columns is not a finite number.
        """
        column_indices, rows = [self.header.index(name) for name in names], []
        for number, cells in self.numbered_lines:
            title = f"{self.title}, line {number}"
            try:
                row = [float(cells[index]) for index in column_indices]
            except (ValueError, IndexError) as error:
                raise InputError(f"{title}: it must hold {len(self.header)} numbers, got {','.join(cells)}") from error
            if not np.isfinite(row).all():
                raise InputError(f"{title}: it holds NaN or infinity; give finite numbers")
            rows.append(row)
        if not rows:
            raise InputError(f"{self.title}: there must be one line or more of finite numbers below the header")
        return np.array(rows)


def read_csv_table(file: Path, title: str) -> CsvTable:
    """Read a CSV file whose first line has the column names; ``title`` is the name of the file in messages.

    Raises:
        InputError: The file cannot be read, or is not CSV.
    """
    try:
        with reading.guard_reading(title, "give a CSV file"):
            reader = csv.reader(reading.read_text(file).splitlines())
        lines = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if any(map(str.strip, cells))]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{title} is not a CSV file: {error}") from error
    header = tuple(map(unescape_formula, lines[0][1])) if lines else ()
    return CsvTable(title, header, tuple(lines[1:]))
