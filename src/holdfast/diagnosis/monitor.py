"""The monitor: a record, or one control cycle after the other, against the bounds of a healthy arm."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, checked_class
from holdfast.arm.model import Arm
from holdfast.diagnosis.answer import Diagnosis
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.kinds import AGAIN, CLASSIFY, ISOLATE, WATCHED, Verdict, Window, decided
from holdfast.diagnosis.observer import BAND, GAIN, friction_torque, low_passed, momentum_kernel
from holdfast.diagnosis.signals import LIMITS, Scaled, Signals, bridged, signals_of
from holdfast.errors import InputError
from holdfast.faults.log import Log

Array = NDArray[np.float64]


@checked_class
@dataclass(frozen=True)
class Sensors:
    """How good the sensors are.

    Attributes:
        position: Standard deviation of the measured tool point, m.
        angle: Of its orientation, rad.
        joint: Of a joint sensor, rad or m.

    Raises:
        InputError: A number that is not above 0.
    """

    position: float = 0.5e-3
    angle: float = 1e-3
    _: KW_ONLY
    joint: float = 2e-5

    def __post_init__(self) -> None:
        for name in ("position", "angle", "joint"):
            if not getattr(self, name) > 0:
                raise InputError(f"the deviation of '{name}' is {getattr(self, name):g}; it must be above 0")


@checked
def diagnose(arm: Arm, log: Log, bounds: Bounds, *, sensors: Sensors | None = None) -> Diagnosis:
    """What a record shows: the first alarm, its joint and kind, and which joints moved too little to tell.

    Args:
        arm: The arm.
        log: What it recorded.
        bounds: Of the healthy arm, by :func:`holdfast.diagnosis.calibrate`.
        sensors: How good they are.

    Raises:
        InputError: Bounds of another arm or rate, a record of another arm.
        ArmError: Torques are there, and the arm's inertial data are missing or impossible.
    """
    return Monitor(arm, bounds, sensors=sensors).run(log)


class Monitor:
    """Watches an arm: :meth:`step` in its control loop, :meth:`run` over a record.

    Args:
        arm: The arm.
        bounds: Of the healthy arm.
        sensors: How good they are.

    Raises:
        InputError: Bounds of another arm.
        ArmError: The bounds have torques, and the arm's inertial data are missing or impossible.
    """

    def __init__(self, arm: Arm, bounds: Bounds, *, sensors: Sensors | None = None) -> None:
        bounds.require(arm, bounds.rate)
        self.arm, self.bounds, self.sensors = arm, bounds, sensors or Sensors()
        self._dt = 1 / bounds.rate
        self._momentum = momentum_kernel(arm).single() if np.isfinite(bounds.torque).all() else None
        self.reset()

    # ---- a record ----------------------------------------------------------------------------------------------------

    def run(self, log: Log) -> Diagnosis:
        """Over a record.

        Raises:
            InputError: Another rate than that of the bounds, or another number of joints.
        """
        bounds = self.bounds
        bounds.require(self.arm, log.rate)
        signals = signals_of(self.arm, log, coulomb=bounds.coulomb, viscous=bounds.viscous)
        scaled = signals.scaled(bounds.torque, bounds.tracking, bounds.position, bounds.angle)
        verdict = Verdict(False)
        if scaled.alarm is not None:
            row, alarmed = scaled.alarm
            verdict = self._decided(_window(log, signals, scaled, row, alarmed))
        return Diagnosis(arm=self.arm, log=log, bounds=bounds, signals=signals, scaled=scaled, verdict=verdict)

    def _decided(self, window: Window) -> Verdict:
        return decided(
            self.arm,
            window,
            bound=self.bounds.torque,
            coulomb=self.bounds.coulomb,
            deviations=(self.sensors.position, self.sensors.angle),
            noise=self.sensors.joint,
        )

    # ---- a control cycle ---------------------------------------------------------------------------------------------

    def reset(self) -> None:
        """Forget everything: the next step is the first."""
        self._time, self._alarm, self._rows = 0.0, 0, list[tuple[Array, ...]]()
        self._q: Array | None = None
        self._over_z, self._over_y = np.zeros(self.arm.n), np.zeros(self.arm.n)
        self.verdict = Verdict(False)

    def step(self, q: ArrayLike, reference: ArrayLike, torque: ArrayLike | None = None) -> Verdict:
        """One control cycle: what is known now. Joints and torques alone are watched here, not the tool's pose.

        Args:
            q: (n,) what the joint sensors tell, rad and m; with NaN the cycle is passed over.
            reference: (n,) what the servos follow, rad and m.
            torque: (n,) commanded, N m and N; None: not watched.
        """
        place, wanted = np.asarray(q, dtype=np.float64), np.asarray(reference, dtype=np.float64)
        tau = None if torque is None or self._momentum is None else np.asarray(torque, dtype=np.float64)
        if not np.isfinite(place + wanted).all() or (tau is not None and not np.isfinite(tau).all()):
            self._time += self._dt
            return self.verdict
        self._observe(place, tau)
        z = np.abs(self._r) / self.bounds.torque
        y = np.abs(wanted - place) / self.bounds.tracking
        self._over_z = np.maximum(0.0, self._over_z + (z - 1) * self._dt)
        self._over_y = np.maximum(0.0, self._over_y + (y - 1) * self._dt)
        if self._alarm or self._over_z.max() > LIMITS["torque"] or self._over_y.max() > LIMITS["tracking"]:
            self._after(place, wanted, z, y, tau is not None)
        self._time += self._dt
        return self.verdict

    def _observe(self, q: Array, tau: Array | None) -> None:
        n, dt = self.arm.n, self._dt
        if self._q is None:
            zero = np.zeros(n)
            self._v, self._r, self._p, self._gravity = zero, zero, zero, zero
            self._tau = self._low = zero if tau is None else tau
            first = True
        else:
            self._v = self._v + min(1.0, BAND * dt) * ((q - self._q) / dt - self._v)
            first = False
        self._q = q
        if tau is None or self._momentum is None:
            return
        self._tau = self._tau + min(1.0, BAND * dt) * (tau - self._tau)
        self._low = self._low + min(1.0, GAIN * dt) * (self._tau - self._low)
        p, energy, self._gravity = self._momentum(np.concatenate((q, self._v))).reshape(3, n)
        if not first:
            known = self._tau + energy - self._gravity - friction_torque(self._v, self.bounds.coulomb, self.bounds.viscous)
            self._r = (1 - GAIN * dt) * self._r + GAIN * (p - self._p - dt * known)
        self._p = p

    def _after(self, q: Array, reference: Array, z: Array, y: Array, torques: bool) -> None:
        """What follows an alarm is kept until the joint and the kind are known."""
        isolate, last = _cycles(ISOLATE, self._dt), _cycles(ISOLATE + CLASSIFY, self._dt)
        if not self._alarm:
            self.verdict = Verdict(True, self._time)
        self._alarm += 1
        if self._alarm > last:
            return
        self._rows.append((q, reference, self._v, self._r, self._low, self._gravity, z, y))
        if self._alarm not in (isolate, last):
            return
        parts = [np.array(part) for part in zip(*self._rows, strict=True)]
        names = ("q", "reference", "v", "residual", "torque", "gravity", "z", "y")
        none = np.zeros((0, self.arm.n))
        window = Window(
            time=self.verdict.time,
            split=min(isolate, self._alarm),
            levels=("tracking", "torque") if torques else ("tracking",),
            alarmed=(),
            w=np.full(self._alarm, np.nan),
            pose_q=none,
            x=none,
            quat=none,
            **dict(zip(names, parts, strict=True)),
        )
        found = self._decided(window)
        self.verdict = found if self._alarm == last else Verdict(True, found.time, joint=found.joint)


def _cycles(seconds: float, dt: float) -> int:
    return max(1, round(seconds / dt))


def _window(log: Log, signals: Signals, scaled: Scaled, row: int, alarmed: tuple[str, ...]) -> Window:
    """What follows an alarm in a record."""
    split, last = _cycles(ISOLATE, signals.dt), _cycles(ISOLATE + CLASSIFY, signals.dt)
    some, q = slice(row, row + last), bridged(log.q)
    torque = np.zeros(q.shape)
    if log.tau is not None:
        tau = bridged(log.tau)
        torque = low_passed(low_passed(tau, signals.dt, BAND, tau[0]), signals.dt, GAIN, tau[0])
    far = slice(row, row + _cycles(WATCHED, signals.dt))
    seen = np.flatnonzero(np.isfinite(signals.tool[far]).all(axis=1)) + row
    n = log.n
    return Window(
        time=float(log.t[row]),
        split=min(split, len(q[some])),
        levels=signals.levels,
        alarmed=alarmed,
        q=q[some],
        reference=bridged(log.q_ref)[some],
        v=signals.v[some],
        residual=signals.torque[some],
        torque=torque[some],
        gravity=signals.gravity[some],
        z=scaled.torque[some],
        y=scaled.tracking[some],
        w=scaled.tool[row : row + _cycles(AGAIN, signals.dt)],
        pose_q=q[seen],
        x=np.zeros((0, n)) if log.x is None else log.x[seen],
        quat=np.zeros((0, n)) if log.quat is None else log.quat[seen],
    )
