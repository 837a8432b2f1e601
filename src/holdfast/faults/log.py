"""What a robot or a simulation recorded of its joints over time, in npz, CSV and Parquet files."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.faults import columns as tables
from holdfast.files import reading
from holdfast.files.output import guarded, write_table

Array = NDArray[np.float64]
_WIDTHS = {"t": 0, "q_ref": -1, "q": -1, "tau": -1, "x": 3, "quat": 4}  # -1: one for each joint
_NEEDED = ("t", "q_ref", "q")
_CLOCK = 1e6  # s: later times are those of a clock
_LEAST = 40.0  # Hz: the observer's own rate, below which it says nothing
_SPARSE = 20  # times as many samples as there are: longer gaps are between records, not in one
_UNEVEN_FRACTION = 0.01  # of the period: time stamps that differ less from even ones are even
_BEYOND, _FASTER = 0.5, 2.0  # rad or m beyond a limit, and of a speed limit: such references are in other units


@dataclass(frozen=True, eq=False, kw_only=True)
class Log:
    """T samples of n joints, evenly spaced.

    Where times leap, rows of NaN stand for the samples that are missing. Where the clock is uneven and the references are
    smooth over its times, the joint signals are interpolated to even times; where they are smooth over the sample number,
    only the time stamps are uneven, and the signals stay as they are.

    Attributes:
        t: (T,) s, increasing.
        q_ref: (T, n) what the servos are to follow, rad and m.
        q: (T, n) what the joint sensors tell, rad and m; NaN where there is no sample.
        tau: (T, n) commanded torques of the motors, N m and N; None: not recorded.
        x: (T, 3) measured tool point in the world, m, NaN where there is no sample, in the row of the time at which it was
            taken; None: not measured.
        quat: (T, 4) measured orientation of the tool, a quaternion x, y, z, w; with ``x``.

    Raises:
        InputError: Shapes that do not fit, time that does not increase, or nearly all samples missing.
    """

    t: Array
    q_ref: Array
    q: Array
    tau: Array | None = None
    x: Array | None = None
    quat: Array | None = None

    def __post_init__(self) -> None:
        t = np.asarray(self.t, dtype=np.float64)
        if t.ndim != 1 or len(t) < 2 or not np.isfinite(t).all():
            raise InputError(f"t has shape {t.shape}; it must be the finite times of two samples or more, s")
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
        rows = _rows_of(t)
        count = int(rows[-1]) + 1
        if count > _SPARSE * len(t):
            raise InputError(
                f"nearly all samples are missing: {len(t)} in {self.duration:.4g} s, at {count / self.duration:.4g} a second; "
                "give its parts as records of their own"
            )
        if count > len(t):
            object.__setattr__(self, "t", np.interp(np.arange(count), rows, t))
            for name in list(_WIDTHS)[1:]:
                if (value := getattr(self, name)) is not None:
                    whole = np.full((count, value.shape[1]), np.nan)
                    whole[rows] = value
                    object.__setattr__(self, name, whole)
        else:
            even = np.linspace(t[0], t[-1], len(t))
            if np.abs(t - even).max() > _UNEVEN_FRACTION / self.rate and _bend(_interpolate_at(even, t, self.q_ref)) < _bend(
                self.q_ref
            ):
                object.__setattr__(self, "t", even)
                for name in ("q_ref", "q", "tau"):
                    if (value := getattr(self, name)) is not None:
                        object.__setattr__(self, name, _interpolate_at(even, t, value))

    @property
    def n(self) -> int:
        """Joints."""
        return int(self.q.shape[1])

    @property
    def rate(self) -> float:
        """Samples per second."""
        return (len(self.t) - 1) / self.duration

    @property
    def duration(self) -> float:
        """From the first sample to the last, s."""
        return float(self.t[-1] - self.t[0])

    def require(self, arm: Arm) -> None:
        """Refuse a record that cannot be of an arm, in these units.

        Raises:
            InputError: Another number of joints, fewer than 40 samples a second, or references far beyond what joints can.
        """
        if self.n != arm.n:
            raise InputError(
                f"the record has {self.n} joints and '{arm.name}' has {arm.n}; give the arm that was recorded, or name the "
                "columns of its joints"
            )
        if self.rate < _LEAST:
            raise InputError(f"the record has {self.rate:.4g} samples a second; it must have {_LEAST:g} or more, with t in s")
        for joint, q in zip(arm.joints, self.q_ref.T, strict=True):
            low, high = np.fmin.reduce(q), np.fmax.reduce(q)
            # A reference may leap, but not all the time.
            speed = float(np.quantile(np.nan_to_num(np.abs(np.diff(q))), 0.9)) * self.rate
            if low < joint.lower - _BEYOND or high > joint.upper + _BEYOND or speed > _FASTER * joint.velocity:
                unit = joint.unit
                raise InputError(
                    f"q_ref of '{joint.name}' is from {low:.4g} to {high:.4g} {unit} at {speed:.3g} {unit}/s, and the joint's "
                    f"limits are {joint.lower:.4g}, {joint.upper:.4g} {unit} and {joint.velocity:.3g} {unit}/s; give a record "
                    f"in {unit} and s, its joints in the arm's order"
                )

    @classmethod
    def load(cls, file: str | Path, *, columns: str | Path | None = None, latency: float = 0.0) -> Log:
        """From ``.npz`` with arrays of these names, or CSV or Parquet with columns ``t, q_ref_1, ..., q_1, ..., x_1, ...``.

        Columns of other names or units are described in a YAML file; what it leaves out is as above.

        .. code-block:: yaml

            t: {column: "Time [ms]", unit: ms}  # or s, us, ns
            q: {column: "A* actual", unit: deg} # * is the joint's number, from 0 or 1; or rad, m, mm
            q_ref: [base_set, arm_set, wrist_set] # or their names, from base to tool
            tau: "A* torque"

        Args:
            file: By its name. Times beyond 1e6 s are those of a clock: they are counted from the first.
            columns: That file.
            latency: s, by which the tool's pose is in the file after it was taken: its samples go to the rows of their times.

        Raises:
            InputError: Unreadable, or something is missing or wrong; the message names it.
        """
        path = Path(file)
        try:
            if path.suffix.lower() in (".csv", ".parquet"):
                arrays = dict(tables.read(path, columns))
            else:
                if columns is not None:
                    raise InputError("a file of columns is for .csv and .parquet")
                arrays = _from_npz(path)
            missing = [name for name in _NEEDED if name not in arrays]
            if missing:
                raise InputError(f"it has no {' and no '.join(missing)}; a log has at least t, q_ref and q")
            if arrays["t"].ndim == 1 and (arrays["t"][:1] > _CLOCK).any():
                arrays["t"] = arrays["t"] - arrays["t"][0]
            return cls(**arrays)._earlier(latency)
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
            pyarrow, parquet = tables.arrow()
            with guarded(path, "log", "choose another path"):
                parquet.write_table(pyarrow.table(dict(zip(header, rows.T, strict=True))), path)
            return path
        with guarded(path, "log", "choose another path"), path.open("wb") as stream:
            arrays = {**given, **more}
            np.savez_compressed(stream, **{x: a if x == "t" else a.astype(np.float32) for x, a in arrays.items()})
        return path


def _rows_of(t: Array) -> NDArray[np.int64]:
    """Return the row of each sample on an even grid; rows between them are missing samples.

    An uneven clock shifts times to and fro about their grid, a gap shifts all later ones; the closer grid is taken.
    """
    steps = np.diff(t)
    even = np.arange(len(t), dtype=np.int64)
    period = steps[steps <= 1.5 * np.median(steps)].mean()
    counts = np.maximum(np.rint(np.minimum(steps / period, _SPARSE * len(t) + 1)), 1)
    gapped = np.r_[0, np.cumsum(counts)].astype(np.int64)
    return min((gapped, even), key=lambda rows: float(np.std(t * (rows[-1] / (t[-1] - t[0])) - rows)))


def _interpolate_at(times: Array, t: Array, values: Array) -> Array:
    """Return values (T, n), known at ``t``, at other times."""
    return np.stack([np.interp(times, t, column) for column in values.T], axis=1)


def _bend(values: Array) -> float:
    """Return the sum of squared second differences of values (T, n)."""
    return float(np.nansum(np.diff(values, n=2, axis=0) ** 2))


def _from_npz(path: Path) -> dict[str, Array]:
    with reading.guarded(advice="give an .npz or .csv file"):
        content = reading.raw(path)
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as data, np.errstate(invalid="ignore"):  # a signaling NaN
            return {name: np.asarray(data[name], dtype=np.float64) for name in data.files if name in _WIDTHS}
    except Exception as error:  # zipfile, zlib and NumPy have many ways of saying no
        raise InputError("it is no .npz file of numbers; give one with t, q_ref and q, or a .csv file") from error
