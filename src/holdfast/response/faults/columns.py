"""Read columns of tables, with their units, into the arrays of a log."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError, model_validator

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.yaml import Strict, describe_validation_error, read_mapping
from holdfast.core.typing import FloatArray

_TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_LENGTH_UNITS = {"m": 1.0, "mm": 1e-3}
_JOINT_UNITS = {"rad": 1.0, "deg": np.pi / 180, **_LENGTH_UNITS}
_REQUIRED_ARRAYS = ("t", "q_ref", "q")
# The first unit of each array is the default.
_ARRAY_UNITS = {"t": _TIME_UNITS, "q_ref": _JOINT_UNITS, "q": _JOINT_UNITS, "tau": {"N m": 1.0}, "x": _LENGTH_UNITS, "quat": {}}


class _Column(Strict):
    column: str | list[str]
    unit: str | None = None

    @model_validator(mode="before")
    @classmethod
    def _parse_name_alone(cls, data: Any) -> Any:
        """Accept a column name alone, which means the default unit."""
        return {"column": data} if isinstance(data, (str, list)) else data


class _Columns(Strict):
    t: _Column = _Column(column="t")
    q_ref: _Column = _Column(column="q_ref_*")
    q: _Column = _Column(column="q_*")
    tau: _Column = _Column(column="tau_*")
    x: _Column = _Column(column="x_*")
    quat: _Column = _Column(column="quat_*")


# Source: logToCSV in libfranka 0.5 to 0.15, and the recipes of the RTDE client library of Universal Robots.
_KNOWN_LAYOUTS = [
    _Columns(),
    _Columns.model_validate(
        {"t": {"column": "time", "unit": "ms"}, "q": "state.q[*]", "q_ref": "state.q_d[*]", "tau": "state.tau_J[*]"}
    ),
    _Columns.model_validate({"t": {"column": "duration", "unit": "ms"}, "q": "q[*]", "q_ref": "q_d[*]", "tau": "tau_J[*]"}),
    _Columns.model_validate({"t": "timestamp", "q": "actual_q_*", "q_ref": "target_q_*", "tau": "target_moment_*"}),
]


def read_arrays(path: Path, columns: str | Path | None) -> dict[str, FloatArray]:
    """Read the arrays of a table (.csv, .parquet) in SI units, by their names in a log; missing optional columns are left out.

    Args:
        path: Path of the table.
        columns: YAML file of columns, see :meth:`holdfast.response.faults.Log.load`. None: names and units of a log, of
            libfranka, or of an RTDE client.

    Raises:
        InputError: A file cannot be read, a column is missing, or a column contains other data than numbers.
    """
    stated = None if columns is None else _read_layout(columns)
    with reading.guard_reading(advice="give an .npz, .csv or .parquet file"):
        content_bytes = reading.read_bytes(path)
    column_names, numbers = (_parse_parquet if path.suffix.lower() == ".parquet" else _parse_csv)(content_bytes)
    layout = stated or _find_layout(column_names)
    arrays = {}
    for name, column in layout:
        selected = _expand_columns(column.column, column_names)
        missing = [column_name for column_name in selected if column_name not in column_names] if selected else [column.column]
        if not missing:
            unit_factor = _ARRAY_UNITS[name][column.unit] if column.unit else 1.0
            arrays[name] = np.column_stack([numbers(column_name) for column_name in selected]) * unit_factor
        elif (stated and name in stated.model_fields_set) or name in _REQUIRED_ARRAYS:
            available = ", ".join(f"'{shown}'" for shown in column_names[:8])
            available += f" and {len(column_names) - 8} more" if len(column_names) > 8 else ""
            raise InputError(
                f"it has no column '{missing[0]}' for {name}, but {available}; name them in a file of columns (--columns)"
            )
    return {**arrays, "t": arrays["t"][:, 0]}


def _find_layout(column_names: Sequence[str]) -> _Columns:
    """Return the known layout whose columns are in a table, or the default one."""
    for layout in _KNOWN_LAYOUTS:
        required = [_expand_columns(getattr(layout, name).column, column_names) for name in _REQUIRED_ARRAYS]
        if all(selected and set(selected) <= set(column_names) for selected in required):
            return layout
    return _KNOWN_LAYOUTS[0]


def _read_layout(columns: str | Path) -> _Columns:
    try:
        layout = _Columns.model_validate(read_mapping(Path(columns), "holdfast.response.faults.Log.load", "q and q_ref"))
        for name, column in layout:
            if column.unit is not None and column.unit not in _ARRAY_UNITS[name]:
                raise InputError(f"{name}: unit '{column.unit}' is not known; use {', '.join(_ARRAY_UNITS[name]) or 'none'}")
        return layout
    except ValidationError as error:
        raise InputError(f"columns '{columns}': {describe_validation_error(error, _Columns, ('str', 'list[str]'))}") from error
    except InputError as error:
        raise InputError(f"columns '{columns}': {error}") from error


def _expand_columns(column: str | list[str], names: Collection[str]) -> list[str]:
    """Return the columns of a list, or of a pattern in which ``*`` is the joint's number, from 0 or 1 without gaps."""
    if not isinstance(column, str) or "*" not in column:
        return [column] if isinstance(column, str) else column
    pattern = re.compile(r"(\d+)".join(map(re.escape, column.split("*", 1))))
    by_number = {int(match[1]): name for name in names if (match := pattern.fullmatch(name))}
    numbers = sorted(by_number)
    if numbers and (numbers[0] > 1 or numbers[-1] - numbers[0] >= len(numbers)):
        raise InputError(f"its columns {column} have a gap: their numbers are {', '.join(map(str, numbers))}")
    return [by_number[number] for number in numbers]


def _parse_csv(raw: bytes) -> tuple[list[str], Callable[[str], FloatArray]]:
    """Return the column names and a function that returns the numbers of a column; empty cells are NaN."""
    lines = raw.decode("utf-8-sig", "replace").splitlines()
    first_line = lines[0] if lines else ""
    delimiter = max(",;\t", key=first_line.count) if any(mark in first_line for mark in ",;\t") else " "
    try:
        if delimiter == " ":  # RTDE clients separate cells by blanks
            lines = [" ".join(line.split()) for line in lines]
        rows = [(line_number, row) for line_number, row in enumerate(csv.reader(lines, delimiter=delimiter), start=1) if row]
    except csv.Error as error:  # a cell of more than 131,072 characters, or a NUL character
        raise InputError(f"it is not a table of numbers ({error}); give one with columns t, q_ref_1, ..., q_1, ...") from error
    if len(rows) < 2:
        raise InputError("it has no rows of numbers; give a header and a line for each sample")
    header = [name.strip() for name in rows[0][1]]
    for line_number, row in rows:
        if len(row) != len(header):
            raise InputError(f"line {line_number} has {len(row)} cells, and the first line {len(header)}")

    def read_numbers(name: str) -> FloatArray:
        index, values = header.index(name), []
        for line_number, row in rows[1:]:
            try:
                values.append(float((row[index] if delimiter == "," else row[index].replace(",", ".")).strip() or "nan"))
            except ValueError as error:
                raise InputError(f"line {line_number} has '{row[index]}' in column '{name}'; give numbers") from error
        return np.array(values)

    return header, read_numbers


def import_pyarrow() -> tuple[Any, Any]:
    """Import pyarrow and its Parquet reader.

    Raises:
        InputError: pyarrow is not installed.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise InputError("Parquet needs pyarrow; install holdfast-arms[parquet], or give an .npz or .csv file") from error
    return pyarrow, parquet


def _parse_parquet(raw: bytes) -> tuple[list[str], Callable[[str], FloatArray]]:
    pyarrow, parquet = import_pyarrow()
    try:
        # One thread: threads of pyarrow that still run when Python exits would crash the process.
        table = parquet.read_table(io.BytesIO(raw), use_threads=False, pre_buffer=False)
    except Exception as error:  # damaged files raise errors of many types
        raise InputError("it is not a readable Parquet file; give one with columns t, q_ref_1, ..., q_1, ...") from error
    names = []
    for field in table.schema:
        lengths = _get_list_length(pyarrow, table[field.name]) if pyarrow.types.is_nested(field.type) else 0
        names += [field.name, *(f"{field.name}[{k}]" for k in range(lengths))]

    def read_numbers(name: str) -> FloatArray:
        base_name, chosen, match = name, None, re.fullmatch(r"(.*)\[(\d+)\]", name)
        if name not in table.column_names and match:
            base_name, chosen = match[1], int(match[2])
        try:
            if not _get_list_length(pyarrow, table[base_name]):
                with np.errstate(invalid="ignore"):  # a signaling NaN becomes a quiet one
                    return np.asarray(table[base_name], dtype=np.float64)
            values = np.array(table[base_name].to_pylist(), dtype=np.float64)
        except Exception as error:  # lists of unequal lengths, text, dates, damaged pages
            raise InputError(f"column '{base_name}' does not hold numbers or lists of numbers of one length") from error
        return values if chosen is None else values[:, chosen]

    return names, read_numbers


def _get_list_length(pyarrow: Any, column: Any) -> int:
    """Return the length of the lists in a column, 0 where it contains single values."""
    if not pyarrow.types.is_nested(column.type) or not len(column):
        return 0
    first = column[0].as_py()
    return len(first) if isinstance(first, list) else 0
