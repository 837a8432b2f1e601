"""Log of the joints of a robot or a simulation over time, in npz, CSV, and Parquet files."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.output import guard_writing, write_table
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.response.faults import columns as tables

_ARRAY_WIDTHS = {"t": 0, "q_ref": -1, "q": -1, "tau": -1, "x": 3, "quat": 4}  # -1: one column per joint
_REQUIRED_ARRAYS = ("t", "q_ref", "q")
_MIN_CLOCK_TIME_S = 1e6  # s: later times are clock times
_MIN_RATE_HZ = 40.0  # Hz: the rate of the observer; it is meaningless below
_MAX_GAP_FACTOR = 20  # ratio of expected to present samples; beyond it, the gaps separate several logs
_UNEVEN_FRACTION = 0.01  # of the period: time stamps that deviate less from even ones count as even
MAX_LIMIT_EXCESS = 0.5  # rad or m beyond a limit; a reference further beyond has other units
_MAX_SPEED_FACTOR = 2.0  # of a speed limit; a faster reference has other units


@dataclass(frozen=True, eq=False, kw_only=True)
class Log:
    """Log of T samples of n joints, evenly spaced.

    Gaps in time are filled with rows of NaN for the missing samples. If the clock is uneven and the references are smooth over
    its times, the joint signals are interpolated to even times. If they are smooth over the sample number, only the time stamps
    are uneven, and the signals are kept.

    Attributes:
        t: (T,) increasing times, s.
        q_ref: (T, n) references of the servos, rad and m.
        q: (T, n) measured joint positions, rad and m; NaN where there is no sample.
        tau: (T, n) commanded torques of the motors, N m and N. None: not recorded.
        x: (T, 3) measured tool point in the world frame, m, in the row of the time at which it was taken; NaN where there is no
            sample. None: not measured.
        quat: (T, 4) measured orientation of the tool in the world frame, quaternion x, y, z, w; given together with ``x``.

    Raises:
        InputError: The shapes do not match, time does not increase, or nearly all samples are missing.
    """

    t: FloatArray
    q_ref: FloatArray
    q: FloatArray
    tau: FloatArray | None = None
    x: FloatArray | None = None
    quat: FloatArray | None = None

    def __post_init__(self) -> None:
        times = np.asarray(self.t, dtype=np.float64)
        if times.ndim != 1 or len(times) < 2 or not np.isfinite(times).all():
            raise InputError(f"t has shape {times.shape}; it must be the finite times of two samples or more, s")
        if not (np.diff(times) > 0).all():
            row = int(np.flatnonzero(~(np.diff(times) > 0))[0]) + 1
            raise InputError(f"t does not increase at row {row}: {times[row - 1]:g} s, then {times[row]:g} s")
        object.__setattr__(self, "t", times)
        joints = np.shape(self.q)[-1] if np.ndim(self.q) == 2 else 0
        for name, width in list(_ARRAY_WIDTHS.items())[1:]:
            value = getattr(self, name)
            if value is None and name not in _REQUIRED_ARRAYS:
                continue
            array, expected_shape = np.asarray(value, dtype=np.float64), (len(times), joints if width < 0 else width)
            if array.shape != expected_shape or not joints:
                raise InputError(f"{name} has shape {array.shape}; it must be {expected_shape}, a row for each time")
            object.__setattr__(self, name, array)
        if (self.x is None) != (self.quat is None):
            raise InputError("only one of x and quat is there; give the tool's position and its orientation, or neither")
        rows = _assign_even_rows(times)
        count = int(rows[-1]) + 1
        if count > _MAX_GAP_FACTOR * len(times):
            raise InputError(
                f"nearly all samples are missing: {len(times)} in {self.duration:.4g} s, at {count / self.duration:.4g} a "
                "second; give its parts as separate logs"
            )
        if count > len(times):
            object.__setattr__(self, "t", np.interp(np.arange(count), rows, times))
            for name in list(_ARRAY_WIDTHS)[1:]:
                if (value := getattr(self, name)) is not None:
                    padded = np.full((count, value.shape[1]), np.nan)
                    padded[rows] = value
                    object.__setattr__(self, name, padded)
        else:
            even_times = np.linspace(times[0], times[-1], len(times))
            if np.abs(times - even_times).max() > _UNEVEN_FRACTION / self.rate and _sum_squared_curvature(
                _interpolate_at(even_times, times, self.q_ref)
            ) < _sum_squared_curvature(self.q_ref):
                object.__setattr__(self, "t", even_times)
                for name in ("q_ref", "q", "tau"):
                    if (value := getattr(self, name)) is not None:
                        object.__setattr__(self, name, _interpolate_at(even_times, times, value))

    @property
    def n(self) -> int:
        """Number of joints."""
        return int(self.q.shape[1])

    @property
    def rate(self) -> float:
        """Samples per second."""
        return (len(self.t) - 1) / self.duration

    @property
    def duration(self) -> float:
        """Time from the first sample to the last, s."""
        return float(self.t[-1] - self.t[0])

    def require(self, arm: Arm) -> None:
        """Raise an error if the log cannot be one of ``arm`` in rad, m and s.

        Raises:
            InputError: The number of joints differs, there are fewer than 40 samples a second, or references are far beyond the
                limits of the joints.
        """
        if self.n != arm.n:
            raise InputError(
                f"the log has {self.n} joints and '{arm.name}' has {arm.n}; give the arm that was recorded, or name the "
                "columns of its joints"
            )
        if self.rate < _MIN_RATE_HZ:
            raise InputError(
                f"the log has {self.rate:.4g} samples a second; it must have {_MIN_RATE_HZ:g} or more, with t in s"
            )
        for joint, reference in zip(arm.joints, self.q_ref.T, strict=True):
            lower, upper = np.fmin.reduce(reference), np.fmax.reduce(reference)
            # A reference may jump, but not in most samples.
            speed = float(np.quantile(np.nan_to_num(np.abs(np.diff(reference))), 0.9)) * self.rate
            if (
                lower < joint.lower - MAX_LIMIT_EXCESS
                or upper > joint.upper + MAX_LIMIT_EXCESS
                or speed > _MAX_SPEED_FACTOR * joint.velocity
            ):
                unit = joint.unit
                raise InputError(
                    f"q_ref of '{joint.name}' is from {lower:.4g} to {upper:.4g} {unit} at {speed:.3g} {unit}/s, and the "
                    f"joint's limits are {joint.lower:.4g}, {joint.upper:.4g} {unit} and {joint.velocity:.3g} {unit}/s; give a "
                    f"log in {unit} and s, its joints in the arm's order"
                )

    @classmethod
    def load(cls, file: str | Path, *, columns: str | Path | None = None, latency: float = 0.0) -> Log:
        """Load an ``.npz`` file with arrays of these names, or CSV or Parquet with ``t, q_ref_1, ..., q_1, ..., x_1, ...``.

        A YAML file describes columns of other names or units; columns that it does not contain have the default names.

        .. code-block:: yaml

            t: {column: "Time [ms]", unit: ms}  # or s, us, ns
            q: {column: "A* actual", unit: deg} # * is the joint's number, from 0 or 1; or rad, m, mm
            q_ref: [base_set, arm_set, wrist_set] # or their names, from base to tool
            tau: "A* torque"

        Args:
            file: Path; its ending selects the format. Times beyond 1e6 s are clock times and are counted from the first.
            columns: Path of the YAML file. None: default names and units.
            latency: Delay of the tool pose in the file, s. The poses are moved to the rows of the times at which they were
                taken.

        Raises:
            InputError: The file cannot be read, or an array is missing or wrong; the message names it.
        """
        path = Path(file)
        arrays = read_log_arrays(path, columns)
        try:
            return cls(**arrays)._shift_pose(latency)
        except InputError as error:
            raise InputError(f"log '{path}': {error}") from error

    def _shift_pose(self, latency: float) -> Log:
        """Shift the pose to the rows of the times at which it was taken."""
        rows = round(latency * self.rate)
        if not 0 <= latency < self.duration:
            raise InputError(f"latency is {latency:g} s; it must be 0 or more and shorter than the log")
        if rows == 0 or self.x is None or self.quat is None:
            return self
        missing = np.full((rows, 7), np.nan)
        shifted = np.concatenate([np.column_stack([self.x, self.quat])[rows:], missing])
        return replace(self, x=shifted[:, :3], quat=shifted[:, 3:])

    def save(self, file: str | Path, **more: FloatArray) -> Path:
        """Write an ``.npz`` file (single precision except for the time), CSV or Parquet, and return its path.

        Args:
            file: Path; its ending selects the format.
            **more: Additional arrays of an ``.npz`` file, which :meth:`load` ignores.

        Raises:
            InputError: The format is Parquet, and pyarrow is not installed.
            StoreError: The file cannot be written.
        """
        path = Path(file)
        available = {name: value for name in _ARRAY_WIDTHS if (value := getattr(self, name)) is not None}
        if path.suffix.lower() in (".csv", ".parquet"):
            matrices = [(name, array.shape[1]) for name, array in available.items() if array.ndim == 2]
            header = ["t", *(f"{name}_{column + 1}" for name, width in matrices for column in range(width))]
            rows = np.column_stack(list(available.values()))
            if path.suffix.lower() == ".csv":
                return write_table(path, "log", header, rows)
            pyarrow, parquet = tables.import_pyarrow()
            with guard_writing(path, "log", "choose another path"):
                parquet.write_table(pyarrow.table(dict(zip(header, rows.T, strict=True))), path)
            return path
        arrays = {**available, **more}
        arrays = {name: array if name == "t" else array.astype(np.float32) for name, array in arrays.items()}
        with guard_writing(path, "log", "choose another path"), path.open("wb") as stream:
            np.savez_compressed(stream, **arrays)
        return path


def read_log_arrays(path: Path, columns: str | Path | None) -> dict[str, FloatArray]:
    """Read the arrays of a log from a file, as they are; ``columns`` as in :meth:`Log.load`.

    Raises:
        InputError: As :meth:`Log.load`.
    """
    try:
        if path.suffix.lower() in (".csv", ".parquet", ".txt"):
            arrays = dict(tables.read_arrays(path, columns))
        else:
            if columns is not None:
                raise InputError("a file of columns is for .csv and .parquet")
            arrays = _read_npz(path)
        missing = [name for name in _REQUIRED_ARRAYS if name not in arrays]
        if missing:
            raise InputError(f"it has no {' and no '.join(missing)}; a log has at least t, q_ref and q")
        if arrays["t"].ndim == 1 and (arrays["t"][:1] > _MIN_CLOCK_TIME_S).any():
            arrays["t"] = arrays["t"] - arrays["t"][0]
        return arrays
    except InputError as error:
        raise InputError(f"log '{path}': {error}") from error


def _assign_even_rows(t: FloatArray) -> NDArray[np.int64]:
    """Return the row of each sample on an even grid; rows between them are missing samples.

    An uneven clock shifts times in both directions about their grid, and a gap shifts all later ones; the closer grid is used.
    """
    steps = np.diff(t)
    even_rows = np.arange(len(t), dtype=np.int64)
    period = steps[steps <= 1.5 * np.median(steps)].mean()
    counts = np.maximum(np.rint(np.minimum(steps / period, _MAX_GAP_FACTOR * len(t) + 1)), 1)
    gapped_rows = np.r_[0, np.cumsum(counts)].astype(np.int64)
    return min((gapped_rows, even_rows), key=lambda candidate: float(np.std(t * (candidate[-1] / (t[-1] - t[0])) - candidate)))


def _interpolate_at(times: FloatArray, t: FloatArray, values: FloatArray) -> FloatArray:
    """Return values (T, n), known at ``t``, at other times."""
    return np.stack([np.interp(times, t, column) for column in values.T], axis=1)


def _sum_squared_curvature(values: FloatArray) -> float:
    """Return the sum of squared second differences of values (T, n)."""
    return float(np.nansum(np.diff(values, n=2, axis=0) ** 2))


def _read_npz(path: Path) -> dict[str, FloatArray]:
    with reading.guard_reading(advice="give an .npz or .csv file"):
        content = reading.read_bytes(path)
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as data, np.errstate(invalid="ignore"):  # a signaling NaN
            return {name: np.asarray(data[name], dtype=np.float64) for name in data.files if name in _ARRAY_WIDTHS}
    except Exception as error:  # zipfile, zlib and NumPy raise errors of many types
        raise InputError("it is not an .npz file of numbers; give one with t, q_ref and q, or a .csv file") from error
