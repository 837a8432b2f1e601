"""What a robot or a simulation recorded of its joints over time, in npz, CSV and Parquet files."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.files import reading
from holdfast.files.output import guarded, write_table

Array = NDArray[np.float64]
_WIDTHS = {"t": 0, "q_ref": -1, "q": -1, "tau": -1, "x": 3, "quat": 4}  # -1: one for each joint
_NEEDED = ("t", "q_ref", "q")
_COLUMN = re.compile(r"(q_ref|q|tau|x|quat)_(\d+)")


@dataclass(frozen=True, eq=False, kw_only=True)
class Log:
    """T samples of n joints.

    Attributes:
        t: (T,) s, increasing.
        q_ref: (T, n) what the servos are to follow, rad and m.
        q: (T, n) what the joint sensors tell, rad and m; NaN where there is no sample.
        tau: (T, n) commanded torques of the motors, N m and N; None: not recorded.
        x: (T, 3) measured tool point in the world, m, NaN where there is no sample, in the row of the time at which it was
            taken; None: not measured.
        quat: (T, 4) measured orientation of the tool, a quaternion x, y, z, w; with ``x``.

    Raises:
        InputError: Shapes that do not fit, or time that does not increase.
    """

    t: Array
    q_ref: Array
    q: Array
    tau: Array | None = None
    x: Array | None = None
    quat: Array | None = None

    def __post_init__(self) -> None:
        t = np.asarray(self.t, dtype=np.float64)
        if t.ndim != 1 or len(t) < 2:
            raise InputError(f"t has shape {t.shape}; it must be the times of two samples or more, s")
        if not (np.diff(t) > 0).all():
            row = int(np.flatnonzero(~(np.diff(t) > 0))[0]) + 1
            raise InputError(f"t does not increase at row {row}: {t[row - 1]:g} s, then {t[row]:g} s")
        object.__setattr__(self, "t", t)
        joints = np.shape(self.q)[-1] if np.ndim(self.q) == 2 else 0
        for name, width in list(_WIDTHS.items())[1:]:
            value = getattr(self, name)
            if value is None and name not in _NEEDED:
                continue
            array, wanted = np.asarray(value, dtype=np.float64), (len(t), joints if width < 0 else width)
            if array.shape != wanted or not joints:
                raise InputError(f"{name} has shape {array.shape}; it must be {wanted}, a row for each time")
            object.__setattr__(self, name, array)
        if (self.x is None) != (self.quat is None):
            raise InputError("only one of x and quat is there; give the tool's position and its orientation, or neither")

    @property
    def n(self) -> int:
        """Joints."""
        return int(self.q.shape[1])

    @property
    def rate(self) -> float:
        """Samples per second, of the median step."""
        return float(1 / np.median(np.diff(self.t)))

    @property
    def duration(self) -> float:
        """From the first sample to the last, s."""
        return float(self.t[-1] - self.t[0])

    @classmethod
    def load(cls, file: str | Path, *, latency: float = 0.0) -> Log:
        """From ``.npz`` with arrays of these names, or CSV or Parquet with columns ``t, q_ref_1, ..., q_1, ..., x_1, ...``.

        Args:
            file: By its name.
            latency: s, by which the tool's pose is in the file after it was taken: its samples go to the rows of their times.

        Raises:
            InputError: Unreadable, or something is missing or wrong; the message names it.
        """
        path = Path(file)
        try:
            readers = {".csv": _from_csv, ".parquet": _from_parquet}
            arrays = readers.get(path.suffix.lower(), _from_npz)(path)
            missing = [name for name in _NEEDED if name not in arrays]
            if missing:
                raise InputError(f"it has no {' and no '.join(missing)}; a log has at least t, q_ref and q")
            return cls(**{name: arrays[name] for name in _WIDTHS if name in arrays})._earlier(latency)
        except InputError as error:
            raise InputError(f"log '{path}': {error}") from error

    def _earlier(self, latency: float) -> Log:
        """With the pose in the rows of the times at which it was taken."""
        rows = round(latency * self.rate)
        if not 0 <= latency < self.duration:
            raise InputError(f"latency is {latency:g} s; it must be 0 or more and shorter than the record")
        if rows == 0 or self.x is None or self.quat is None:
            return self
        late = np.full((rows, 7), np.nan)
        moved = np.concatenate([np.column_stack([self.x, self.quat])[rows:], late])
        return replace(self, x=moved[:, :3], quat=moved[:, 3:])

    def save(self, file: str | Path, **more: Array) -> Path:
        """Write ``.npz`` (single precision but for the time) or, by its name, CSV or Parquet.

        Args:
            file: Path.
            more: Other arrays of an ``.npz`` file, which :meth:`load` passes over.

        Raises:
            InputError: Parquet without pyarrow.
            StoreError: It cannot be written.
        """
        path = Path(file)
        given = {name: value for name in _WIDTHS if (value := getattr(self, name)) is not None}
        if path.suffix.lower() in (".csv", ".parquet"):
            header = ["t", *(f"{name}_{k + 1}" for name, a in given.items() if a.ndim == 2 for k in range(a.shape[1]))]
            rows = np.column_stack(list(given.values()))
            if path.suffix.lower() == ".csv":
                return write_table(path, "log", header, rows)
            pyarrow, parquet = _arrow()
            with guarded(path, "log", "choose another path"):
                parquet.write_table(pyarrow.table(dict(zip(header, rows.T, strict=True))), path)
            return path
        with guarded(path, "log", "choose another path"), path.open("wb") as stream:
            arrays = {**given, **more}
            np.savez_compressed(stream, **{x: a if x == "t" else a.astype(np.float32) for x, a in arrays.items()})
        return path


def _from_npz(path: Path) -> Mapping[str, Any]:
    with reading.guarded(advice="give an .npz or .csv file"):
        content = reading.raw(path)
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as data:
            return {name: np.asarray(data[name], dtype=np.float64) for name in data.files if name in _WIDTHS}
    except Exception as error:  # zipfile, zlib and NumPy have many ways of saying no
        raise InputError("it is no .npz file of numbers; give one with t, q_ref and q, or a .csv file") from error


def _from_csv(path: Path) -> Mapping[str, Any]:
    with reading.guarded(advice="give an .npz or .csv file"):
        lines = reading.raw(path).decode("utf-8", "replace").splitlines()
    header = [name.strip() for name in (lines[0] if lines else "").split(",")]
    try:
        rows = np.array([[float(x or "nan") for x in line.split(",")] for line in lines[1:] if line.strip()])
        columns = dict(zip(header, rows.T, strict=True))
    except ValueError as error:
        raise InputError(f"its rows are not {len(header)} numbers each, as its first line names them") from error
    return _arranged(columns)


def _arrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise InputError("Parquet needs pyarrow; install holdfast[parquet], or give an .npz or .csv file") from error
    return pyarrow, parquet


def _from_parquet(path: Path) -> Mapping[str, Any]:
    _, parquet = _arrow()
    with reading.guarded(advice="give an .npz, .csv or .parquet file"):
        content = reading.raw(path)
    try:
        table = parquet.read_table(io.BytesIO(content))
        numbers = {name: np.asarray(table[name], dtype=np.float64) for name in table.column_names if _is_ours(name)}
    except Exception as error:  # pyarrow has errors of its own
        raise InputError("it is no Parquet file of numbers; give one with columns t, q_ref_1, ..., q_1, ...") from error
    return _arranged(numbers)


def _is_ours(name: str) -> bool:
    return name == "t" or _COLUMN.fullmatch(name) is not None


def _arranged(columns: Mapping[str, Array]) -> Mapping[str, Any]:
    """Columns ``q_1, q_2, ...`` as arrays."""
    found: dict[str, dict[int, Array]] = {}
    for name, values in columns.items():
        if name == "t":
            continue
        match = _COLUMN.fullmatch(name)
        if match:
            found.setdefault(match[1], {})[int(match[2])] = values
    arrays: dict[str, Any] = {"t": columns["t"]} if "t" in columns else {}
    for name, parts in found.items():
        if sorted(parts) != list(range(1, len(parts) + 1)):
            raise InputError(f"its columns {name}_1, {name}_2, ... have a gap")
        arrays[name] = np.column_stack([parts[k] for k in sorted(parts)])
    return arrays
