"""Read columns of tables, with their units, into the arrays of a log."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError, model_validator

from holdfast.errors import InputError
from holdfast.files import reading
from holdfast.files.yaml import Strict, content, sentence

Array = NDArray[np.float64]

_TIME = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_LENGTH = {"m": 1.0, "mm": 1e-3}
_JOINT = {"rad": 1.0, "deg": np.pi / 180, **_LENGTH}
_UNITS = {"t": _TIME, "q_ref": _JOINT, "q": _JOINT, "tau": {"N m": 1.0}, "x": _LENGTH, "quat": {}}  # the first: if not given


class _Column(Strict):
    column: str | list[str]
    unit: str | None = None

    @model_validator(mode="before")
    @classmethod
    def _alone(cls, data: Any) -> Any:
        """A column in its usual unit is its name alone."""
        return {"column": data} if isinstance(data, (str, list)) else data


class _Columns(Strict):
    t: _Column = _Column(column="t")
    q_ref: _Column = _Column(column="q_ref_*")
    q: _Column = _Column(column="q_*")
    tau: _Column = _Column(column="tau_*")
    x: _Column = _Column(column="x_*")
    quat: _Column = _Column(column="quat_*")


def read(path: Path, columns: str | Path | None) -> dict[str, Array]:
    """Arrays of a table (.csv, .parquet) in SI units, by their names in a log; what is not there is left out.

    Args:
        path: The file.
        columns: A YAML file, see :meth:`holdfast.faults.Log.load`; None: names and units of a log.

    Raises:
        InputError: Either cannot be read, a column is not there, or it does not hold numbers.
    """
    told = _Columns() if columns is None else _described(columns)
    with reading.guarded(advice="give an .npz, .csv or .parquet file"):
        raw = reading.raw(path)
    names, numbers = (_parquet if path.suffix.lower() == ".parquet" else _csv)(raw)
    found = {}
    for name, one in told:
        chosen = _named(one.column, names)
        gone = [column for column in chosen if column not in names] if chosen else [one.column]
        if not gone:
            size = _UNITS[name][one.unit] if one.unit else 1.0
            found[name] = np.column_stack([numbers(column) for column in chosen]) * size
        elif name in told.model_fields_set or name in ("t", "q_ref", "q"):
            some = ", ".join(f"'{x}'" for x in names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "")
            raise InputError(f"it has no column '{gone[0]}' for {name}, but {some}; name them in a file of columns (--columns)")
    return {**found, "t": found["t"][:, 0]}


def _described(columns: str | Path) -> _Columns:
    try:
        told = _Columns.model_validate(content(Path(columns), "holdfast.faults.Log.load", "q and q_ref"))
        for name, one in told:
            if one.unit is not None and one.unit not in _UNITS[name]:
                raise InputError(f"{name}: unit '{one.unit}' is not known; use {', '.join(_UNITS[name]) or 'none'}")
        return told
    except ValidationError as error:
        raise InputError(f"columns '{columns}': {sentence(error, _Columns, ('str', 'list[str]'))}") from error
    except InputError as error:
        raise InputError(f"columns '{columns}': {error}") from error


def _named(column: str | list[str], names: Collection[str]) -> list[str]:
    """Those of a list, or of a pattern in which ``*`` is a joint's number, from 0 or 1 without gaps."""
    if not isinstance(column, str) or "*" not in column:
        return [column] if isinstance(column, str) else column
    pattern = re.compile(r"(\d+)".join(map(re.escape, column.split("*", 1))))
    found = {int(match[1]): name for name in names if (match := pattern.fullmatch(name))}
    numbers = sorted(found)
    if numbers and (numbers[0] > 1 or numbers[-1] - numbers[0] >= len(numbers)):
        raise InputError(f"its columns {column} have a gap: their numbers are {', '.join(map(str, numbers))}")
    return [found[k] for k in numbers]


def _csv(raw: bytes) -> tuple[list[str], Callable[[str], Array]]:
    """Names, and a column's numbers; empty cells are NaN. Commas, semicolons or tabs part cells, as in the first line."""
    lines = raw.decode("utf-8-sig", "replace").splitlines()
    mark = max(",;\t", key=(lines[0] if lines else "").count)
    try:
        rows = [(k, row) for k, row in enumerate(csv.reader(lines, delimiter=mark), start=1) if row]
    except csv.Error as error:  # a cell of more than 131,072 characters, or a NUL character
        raise InputError(f"it is no table of numbers ({error}); give one with columns t, q_ref_1, ..., q_1, ...") from error
    if len(rows) < 2:
        raise InputError("it has no rows of numbers; give a header and a line for each sample")
    header = [name.strip() for name in rows[0][1]]
    for k, row in rows:
        if len(row) != len(header):
            raise InputError(f"line {k} has {len(row)} cells, and the first line {len(header)}")

    def numbers(name: str) -> Array:
        at, found = header.index(name), []
        for k, row in rows[1:]:
            try:
                found.append(float((row[at] if mark == "," else row[at].replace(",", ".")).strip() or "nan"))
            except ValueError as error:
                raise InputError(f"line {k} has '{row[at]}' in column '{name}'; give numbers") from error
        return np.array(found)

    return header, numbers


def arrow() -> tuple[Any, Any]:
    """Of pyarrow the package and what reads Parquet.

    Raises:
        InputError: It is not installed.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise InputError("Parquet needs pyarrow; install holdfast[parquet], or give an .npz or .csv file") from error
    return pyarrow, parquet


def _parquet(raw: bytes) -> tuple[list[str], Callable[[str], Array]]:
    pyarrow, parquet = arrow()
    try:
        # Threads of pyarrow end the whole process where they still run when Python ends.
        table = parquet.read_table(io.BytesIO(raw), use_threads=False, pre_buffer=False)
    except Exception as error:  # damaged files raise many kinds
        raise InputError("it is no Parquet file that can be read; give one with columns t, q_ref_1, ..., q_1, ...") from error
    names = []
    for field in table.schema:
        lengths = _list_lengths(pyarrow, table[field.name]) if pyarrow.types.is_nested(field.type) else 0
        names += [field.name, *(f"{field.name}[{k}]" for k in range(lengths))]

    def numbers(name: str) -> Array:
        entry = re.fullmatch(r"(.*)\[(\d+)\]", name)
        whole, chosen = (entry[1], int(entry[2])) if name not in table.column_names and entry else (name, None)
        try:
            if not _list_lengths(pyarrow, table[whole]):
                with np.errstate(invalid="ignore"):  # a signaling NaN becomes a quiet one
                    return np.asarray(table[whole], dtype=np.float64)
            values = np.array(table[whole].to_pylist(), dtype=np.float64)
        except Exception as error:  # lists of unequal lengths, text, dates, damaged pages
            raise InputError(f"column '{whole}' does not hold numbers or lists of numbers of one length") from error
        return values if chosen is None else values[:, chosen]

    return names, numbers


def _list_lengths(pyarrow: Any, column: Any) -> int:
    """Return the length of the lists in a column, 0 where it holds single values."""
    if not pyarrow.types.is_nested(column.type) or not len(column):
        return 0
    first = column[0].as_py()
    return len(first) if isinstance(first, list) else 0
