"""Detection thresholds of a healthy arm, calibrated from its logs, with the resulting rate of false alarms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import replace_file
from holdfast.core.files.sealed import read_sealed
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.fitting import fit_masses_and_friction, scale_masses
from holdfast.response.diagnosis.plausibility import prepare_log, require_explained_torques, require_reference_tracking
from holdfast.response.diagnosis.signals import EXCESS_LIMITS_S, compute_signals
from holdfast.response.faults.log import Log

BOUND_FACTOR = 1.5  # on the largest healthy residual
BOUND_FACTOR_SENSORS_ALONE = 2.5  # with joint sensors alone
RATE_TOLERANCE = 0.01  # largest relative difference between the sample rates of a log and of the thresholds
_SECONDS_PER_HOUR = 3600.0
_FILE_FORMAT = 2
_JOINT_VECTORS = ("torque", "change", "tracking", "coulomb", "viscous", "scales", "speed")
_MAX_VALUE = 1e9  # N m, rad, m, rad/s and Hz: no threshold of a robot is larger


@dataclass(frozen=True, eq=False, kw_only=True)
class Bounds(Result):
    """Detection thresholds: the largest residuals in the logs of a healthy arm, times ``factor``.

    Attributes:
        fingerprint: Fingerprint of the calibrated arm.
        joints: Names of the n joints.
        rate: Sample rate of the logs, Hz.
        torque: (n,) threshold of the residual torque, N m and N; infinite without torques.
        change: (n,) threshold of the residual torque minus its level, the average of the last 0.15 s, N m and N.
        tracking: (n,) threshold of the distance of a joint from its reference, rad and m.
        position: Threshold of the distance between measured and computed tool point, m; infinite without measured poses.
        angle: Threshold of the angle between measured and computed tool orientation, rad; infinite without measured poses.
        coulomb: (n,) dry friction in the model of the healthy arm, N m and N.
        viscous: (n,) viscous friction in the model of the healthy arm, N m s/rad and N s/m.
        scales: (n,) factors on the masses and inertias of the links, fitted to the logs; 1 without a fit.
        factor: Ratio of the thresholds to the largest healthy residuals.
        speed: (n,) largest rate of the references, rad/s and m/s. Faster motion was not calibrated.
        hours: Duration of the healthy motion, h.
        logs: Number of logs.
        alarms: Number of false alarms if each log is monitored with the thresholds of all others; None with a single log.
    """

    fingerprint: str
    joints: tuple[str, ...]
    rate: float
    torque: FloatArray
    change: FloatArray
    tracking: FloatArray
    position: float
    angle: float
    coulomb: FloatArray
    viscous: FloatArray
    scales: FloatArray
    factor: float
    speed: FloatArray
    hours: float
    logs: int
    alarms: int | None

    def false_alarms(self) -> tuple[float, float] | None:
        """Return the false alarms per hour, and the 95 % upper confidence limit of their rate; None if they were not counted.

        The limit is ``chi2_0.95(2 k + 2) / (2 H)`` for k alarms in H hours, which is 3.0/H without an alarm. It holds for this
        arm and this kind of motion, and no lower rate may be claimed.

        Source: the exact limit of a Poisson rate, Garwood 1936.
        """
        if self.alarms is None:
            return None
        from scipy.stats import chi2

        return self.alarms / self.hours, float(chi2.ppf(0.95, 2 * self.alarms + 2) / (2 * self.hours))

    def lock_delays(self) -> FloatArray:
        """Return the time (n,) in s from a lock to the alarm of the joint sensors, at half the calibrated speed.

        The tracking error grows as ``v t``, and its excess over the threshold ``b`` reaches the limit ``L`` after
        ``b / v + sqrt(2 L b / v)``. The time is infinite for a joint that never moved.
        """
        with np.errstate(divide="ignore"):
            time_to_bound = self.tracking / (self.speed / 2)
        return np.asarray(time_to_bound + np.sqrt(2 * EXCESS_LIMITS_S["tracking"] * time_to_bound))

    def body(self, arm: Arm) -> Arm:
        """Return the ``arm`` with its link masses multiplied by ``scales``."""
        return scale_masses(arm, self.scales)

    def to_json(self, file: str | Path) -> Path:
        """Write the JSON file ``file`` that :func:`holdfast.response.diagnosis.load` reads, and return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        data: dict[str, Any] = {"format": _FILE_FORMAT}
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray):
                data[name] = [number if np.isfinite(number) else None for number in value.tolist()]
            else:
                data[name] = None if value == np.inf else value
        replace_file(Path(file), seal_document(data), "bounds")
        return Path(file)

    def require_sound(self) -> None:
        """Raise an error for thresholds with which a monitor would detect nothing or everything.

        Raises:
            InputError: A value has a wrong length or size; the message names it.
        """
        joint_count = len(self.joints)
        vectors = {name: getattr(self, name) for name in _JOINT_VECTORS}
        for name, value in vectors.items():
            if value.shape != (joint_count,):
                raise InputError(f"{name} has shape {value.shape}; it must be ({joint_count},), one value for each joint")
        measured = {"torque": self.torque, "change": self.change, "tracking": self.tracking, "scales": self.scales}
        if np.isinf(self.torque).all() and np.isinf(self.change).all():
            del measured["torque"], measured["change"]
        if not (self.position == np.inf == self.angle):
            measured |= {"position": np.atleast_1d(self.position), "angle": np.atleast_1d(self.angle)}
        measured |= {"rate": np.atleast_1d(self.rate), "hours": np.atleast_1d(self.hours)}
        for name, value in measured.items():
            _require_between(name, value, np.finfo(np.float64).tiny, "above 0")
        for name in ("coulomb", "viscous", "speed"):
            _require_between(name, vectors[name], 0.0, "0 or more")
        _require_between("factor", np.atleast_1d(self.factor), 1.0, "1 or more")
        if not self.logs >= 1 or not (self.alarms is None or self.alarms >= 0):
            raise InputError(f"alarms is {self.alarms} and logs is {self.logs}; alarms must be 0 or more, and logs 1 or more")

    def require(self, arm: Arm, rate: float) -> None:
        """Raise an error if the thresholds do not belong to ``arm`` and to the sample rate ``rate``, Hz.

        Raises:
            InputError: The fingerprint or the rate differs.
        """
        if arm.fingerprint != self.fingerprint:
            raise InputError(f"the thresholds are not of '{arm.name}'; calibrate with logs of this arm")
        if abs(rate / self.rate - 1) > RATE_TOLERANCE:
            raise InputError(
                f"the log has {rate:.4g} samples a second and the thresholds have {self.rate:.4g}; use logs of one rate"
            )


def load(file: str | Path) -> Bounds:
    """Read thresholds from the JSON file ``file`` of :meth:`Bounds.to_json`.

    Raises:
        InputError: The file does not exist or is not a threshold file.
    """
    try:
        data = read_sealed(file)
        if data.pop("format") != _FILE_FORMAT:
            raise ValueError
        for name in _JOINT_VECTORS:
            data[name] = np.array([_read_number(number) for number in data[name]], dtype=np.float64)
        for name in ("position", "angle", "rate", "factor", "hours"):
            data[name] = _read_number(data[name])
        for name in ("logs", "alarms"):
            if not (isinstance(data[name], int) or (name == "alarms" and data[name] is None)):
                raise ValueError
        bounds = Bounds(**{**data, "joints": tuple(map(str, data["joints"]))})
        bounds.require_sound()
        return bounds
    except OSError as error:
        raise InputError(
            f"bounds '{file}' cannot be read ({error.strerror or error}); give the file that calibrate wrote"
        ) from error
    except InputError as error:
        raise InputError(f"bounds '{file}': {error}; make the file again with holdfast calibrate") from error
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        raise InputError(f"bounds '{file}': it is not a threshold file; make one with holdfast calibrate") from error


def _read_number(value: Any) -> float:
    """Return a number of the file, in which null stands for infinity."""
    if isinstance(value, bool) or not isinstance(value, int | float | None):
        raise ValueError
    return np.inf if value is None else float(value)


def _require_between(name: str, value: FloatArray, minimum: float, requirement: str) -> None:
    wrong = np.flatnonzero(~((value >= minimum) & (value <= _MAX_VALUE)))
    if wrong.size:
        raise InputError(f"{name} is {value[wrong[0]]:g}; it must be {requirement} and at most {_MAX_VALUE:g}")


@check_arguments
@reports_progress("calibrating")
def calibrate(
    arm: Arm,
    logs: Sequence[Log],
    *,
    factor: float | None = None,
    coulomb: ArrayLike | None = None,
    viscous: ArrayLike | None = None,
    fit: bool = False,
) -> Bounds:
    """Calibrate detection thresholds from logs of a healthy arm, and count how often these logs would have raised an alarm.

    The threshold of each residual is its largest value in any log, times ``factor``. To count false alarms, each log is
    monitored with the thresholds of all others.

    Args:
        arm: Arm that was recorded, with inertial data if torques were recorded.
        logs: Logs of healthy motion, of the kind that will be monitored.
        factor: Ratio of the thresholds to the largest residuals, 1 or more. Default: 1.5, or 2.5 without recorded torques.
            Without torques, tracking is monitored and calibrated in slow motion only (every reference below 0.6 rad/s and m/s
            for 0.1 s).
        coulomb: (n,) dry friction of the joints, N m and N. Default: 0.
        viscous: (n,) viscous friction of the joints, N m s/rad and N s/m. Default: the friction of the arm's model.
        fit: Fit link masses and joint friction to the logs first, for tighter thresholds; ``coulomb``, if given, is kept.

    Raises:
        InputError: There is no log; the logs have other joints, several rates, or the measured joints as references; the
            arm's model does not explain them (units, signs, order of joints); or the factor is below 1.
        ArmError: Torques were recorded, and the arm's inertial data are missing or impossible.

    Source: derived here. Residuals are bounded and not modelled as noise, because measured residuals are errors of friction,
    inertia and gravity. These are correlated over seconds, and tests designed for independent noise alarm on them all the time.
    """
    if not logs:
        raise InputError("there is no log to calibrate with; give logs of healthy motion")
    if factor is None:
        factor = BOUND_FACTOR if any(log.tau is not None for log in logs) else BOUND_FACTOR_SENSORS_ALONE
    if not factor >= 1:
        raise InputError(f"factor is {factor:g}; it must be 1 or more")
    coulomb_friction = np.zeros(arm.n) if coulomb is None else np.broadcast_to(np.asarray(coulomb, dtype=np.float64), (arm.n,))
    own_friction = np.array([joint.friction for joint in arm.joints])
    viscous_friction = own_friction if viscous is None else np.broadcast_to(np.asarray(viscous), (arm.n,))
    logs = [prepare_log(arm, log) for log in logs]
    rate = logs[0].rate
    for log in logs:
        if abs(log.rate / rate - 1) > RATE_TOLERANCE:
            raise InputError(f"the logs have {rate:.4g} and {log.rate:.4g} samples a second; use logs of one rate")
    require_reference_tracking(arm, logs)
    require_explained_torques(arm, logs, coulomb=coulomb_friction, viscous=viscous_friction)
    scales = np.ones(arm.n)
    if fit:
        scales, coulomb_friction, viscous_friction = fit_masses_and_friction(arm, logs, coulomb_friction, viscous_friction)
    fitted_arm = scale_masses(arm, scales)
    residual_signals = [
        compute_signals(arm, log, coulomb=coulomb_friction, viscous=viscous_friction, body=fitted_arm)
        for log in track("logs", logs)
    ]
    largest = [
        np.array([log_signals.largest_residual(name) for log_signals in residual_signals])
        for name in ("torque", "tracking", "position", "angle")
    ]
    if all(np.isnan(log_signals.tracking).all() for log_signals in residual_signals):
        raise InputError("the logs have neither torques nor slow motion, in which joint sensors alone suffice; record either")
    without_error = np.flatnonzero(largest[1].max(axis=0) == 0)
    if without_error.size:
        raise InputError(
            f"'{arm.joint_names[without_error[0]]}' never departs from its reference in the logs; q_ref must be the reference "
            "of the servos, not the measured position"
        )
    change = factor * np.array([log_signals.largest_residual("change") for log_signals in residual_signals]).max(axis=0)
    alarms: int | None = None
    if len(logs) > 1:
        alarms = 0
        for index, signals in enumerate(residual_signals):
            others = [factor * np.delete(residuals, index, axis=0).max(axis=0) for residuals in largest]
            alarms += signals.scale_by_bounds(*others).alarm is not None
    bounds = [factor * residuals.max(axis=0) for residuals in largest]
    seconds = sum(log.duration * float(signals.seen.mean()) for log, signals in zip(logs, residual_signals, strict=True))
    return Bounds(
        fingerprint=arm.fingerprint,
        joints=arm.joint_names,
        rate=rate,
        torque=bounds[0],
        change=change,
        tracking=bounds[1],
        position=float(bounds[2]),
        angle=float(bounds[3]),
        coulomb=np.array(coulomb_friction),
        viscous=np.array(viscous_friction, dtype=np.float64),
        scales=scales,
        factor=float(factor),
        speed=np.nanmax([np.nanmax(np.abs(np.diff(log.q_ref, axis=0) * rate), axis=0) for log in logs], axis=0),
        hours=seconds / _SECONDS_PER_HOUR,
        logs=len(logs),
        alarms=alarms,
    )
