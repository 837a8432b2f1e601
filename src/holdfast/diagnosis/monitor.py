"""The monitor: a record, or one control cycle after the other, against the bounds of a healthy arm."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.poses import rotations_of_quaternions
from holdfast.diagnosis.answer import Diagnosis
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.decision import CLASSIFY, ISOLATE, UNSURE, Decision
from holdfast.diagnosis.gaps import STALE, cycles
from holdfast.diagnosis.kinds import Verdict
from holdfast.diagnosis.observer import BAND, GAIN, LEVEL, friction_torque, level, momentum_kernel
from holdfast.diagnosis.plausibility import prepare_log
from holdfast.diagnosis.sensors import Sensors
from holdfast.diagnosis.signals import CALM, LIMITS, SLOW, SMOOTHED, Scaled, Signals, signals_of, tool_residual
from holdfast.faults.log import Log

Array = NDArray[np.float64]


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
        self._late, self._longest = round(self.sensors.latency * bounds.rate), cycles(STALE, 1 / bounds.rate)
        self._asked = (cycles(ISOLATE, self._dt), cycles(ISOLATE + CLASSIFY, self._dt))
        self._momentum = momentum_kernel(bounds.body(arm)).single() if np.isfinite(bounds.torque).all() else None
        self.reset()

    # ---- a record ----------------------------------------------------------------------------------------------------

    def run(self, log: Log) -> Diagnosis:
        """Over a record: what :meth:`step` says of it. Rows that are missing are as rows of NaN.

        Raises:
            InputError: Another rate than that of the bounds, another number of joints, or no row with all of its numbers.
        """
        bounds = self.bounds
        bounds.require(self.arm, log.rate)
        body = bounds.body(self.arm)
        log = prepare_log(self.arm, log)
        signals = signals_of(self.arm, log, coulomb=bounds.coulomb, viscous=bounds.viscous, body=body)
        scaled = signals.scaled(bounds.torque, bounds.tracking, bounds.position, bounds.angle)
        verdict = Verdict(False) if scaled.alarm is None else self._followed(log, signals, scaled, *scaled.alarm)
        return Diagnosis(arm=self.arm, log=log, bounds=bounds, signals=signals, scaled=scaled, verdict=verdict)

    def _decision(self, time: float, levels: tuple[str, ...], alarmed: tuple[str, ...], before: Array) -> Decision:
        watched = {"torques": "torque" in levels, "tool": "tool" in levels}
        return Decision(
            self.arm,
            self.bounds,
            self.sensors,
            time=time,
            level=before,
            joints=self._watched,
            **watched,
            tool_alone=alarmed == ("tool",),
        )

    def _followed(self, log: Log, signals: Signals, scaled: Scaled, row: int, alarmed: tuple[str, ...]) -> Verdict:
        """What a record comes to after its alarm."""
        sure = (scaled.torque[: row + 1] < UNSURE).all(axis=1)
        before = level(np.concatenate([np.zeros((1, log.n)), signals.torque[: row + 1][sure]]), signals.dt)[-1]
        decision = self._decision(float(log.t[row]), signals.levels, alarmed, before)
        rows = row + np.flatnonzero(signals.seen[row:])[: decision.ends]
        whole = (signals.v, signals.torque, signals.asked, signals.gravity, scaled.torque, scaled.tracking)
        parts, q, reference = [part[rows] for part in whole], log.q[rows], log.q_ref[rows]
        seen = np.asarray(np.isfinite(signals.tool[rows]).all(axis=1))
        if log.x is not None and log.quat is not None and seen.any():
            rotations = rotations_of_quaternions(log.quat[rows][seen])
            residual = tool_residual(self.arm, q[seen], log.x[rows][seen], rotations)
            samples = iter(zip(residual, self.arm.jacobian(q[seen]), strict=True))
        for k in range(len(q)):
            v, r, torque, gravity, z, y = (part[k] for part in parts)
            decision.add(q[k], reference[k], (v, r, torque, gravity), z, y)
            if seen[k]:
                decision.see(float(scaled.tool[rows[k]]), *next(samples))
        return decision.verdict(last=True)

    # ---- a control cycle ---------------------------------------------------------------------------------------------

    def reset(self) -> None:
        """Forget everything: the next step is the first."""
        self._cycle, self._fast, self._seen, self._seen_at = 0, 0, 0, 0
        self._v = self._r = self._p = self._gravity = self._tau = self._low = self._level = np.zeros(self.arm.n)
        self._q: Array | None = None
        self._felt = np.zeros(self.arm.n)  #  torques of cycles that were passed over
        self._missed, self._known, self._anew, self._past = 0, 0, 0, np.full((self._late + 1, self.arm.n), np.nan)
        self._reference: Array | None = None
        self._last = np.zeros((SMOOTHED, 6))
        self._watched = np.ones(self.arm.n, dtype=bool)
        self.rearm()

    def rearm(self) -> None:
        """Forget the alarm and what led to it, while the arm goes on: time runs on, and what follows the motion is kept."""
        self._over_z, self._over_y, self._over_w = np.zeros(self.arm.n), np.zeros(self.arm.n), 0.0
        self._alarm: Decision | None = None
        self.verdict = Verdict(False)

    def leave_out(self, joint: str) -> None:
        """Watch on without a joint that was stopped, until :meth:`reset`: the alarm is forgotten.

        Its torques are its brake's, and where it is may be known better than by its sensor: what follows the motion begins
        anew, and for 50 ms the torques tell nothing.

        Args:
            joint: Its name.

        Raises:
            InputError: The arm has no such joint.
        """
        self._watched[self.arm.joint_index(joint)] = False
        self._begin_anew()
        self._past[:], self._last[:], self._seen = np.nan, 0.0, 0
        self.rearm()

    def _begin_anew(self) -> None:
        self._q, self._r, self._anew = None, np.zeros(self.arm.n), self._longest + 1

    def step(
        self, q: ArrayLike, reference: ArrayLike, torque: ArrayLike | None = None, *, pose: ArrayLike | None = None
    ) -> Verdict:
        """One control cycle: what is known now.

        Args:
            q: (n,) what the joint sensors tell, rad and m; with NaN the cycle is passed over, and is nobody's fault.
            reference: (n,) what the servos follow, rad and m.
            torque: (n,) commanded, N m and N; None: not watched.
            pose: (4, 4) measured pose of the tool, taken ``sensors.latency`` ago; None, or NaN: no sample in this cycle.
        """
        place, wanted = np.asarray(q, dtype=np.float64), np.asarray(reference, dtype=np.float64)
        tau = None if torque is None or self._momentum is None else np.asarray(torque, dtype=np.float64)
        self._cycle += 1
        self._past[self._cycle % len(self._past)] = place
        if not np.isfinite(place + wanted).all() or (tau is not None and not np.isfinite(tau).all()):
            self._missed += 1
            if tau is not None and np.isfinite(tau).all():
                self._felt, self._known = self._felt + tau, self._known + 1
            return self.verdict
        elapsed = (self._missed + 1) * self._dt  # longer after cycles that were passed over
        self._bridge(place, tau)
        self._observe(place, tau)
        z = np.where(self._watched, np.abs(self._r) / self.bounds.torque, 0.0)
        y = np.where(self._watched, self._tracking(wanted, place, elapsed, alone=tau is None), 0.0)
        self._over_z = np.maximum(0.0, self._over_z + (z - 1) * self._dt)
        self._over_y = np.maximum(0.0, self._over_y + np.nan_to_num(y - 1) * self._dt)
        then = self._past[(self._cycle + 1) % len(self._past)]
        seen = None if pose is None else self._look(then, np.asarray(pose, dtype=np.float64))
        if self._alarm is None:
            if (z < UNSURE).all():
                self._level = self._level + min(1.0, LEVEL * self._dt) * (self._r - self._level)
            over = {"torque": self._over_z.max(), "tracking": self._over_y.max(), "tool": self._over_w}
            alarmed = tuple(name for name in over if over[name] > LIMITS[name])
            if alarmed:
                time = (self._cycle - 1) * self._dt
                levels = ("tracking", *["torque"] * (tau is not None), *["tool"] * (self._seen > 0))
                self._alarm, self.verdict = self._decision(time, levels, alarmed, self._level), Verdict(True, time)
        if self._alarm is not None and self._alarm.count < self._alarm.ends:
            self._alarm.add(place, wanted, (self._v, self._r, self._low, self._gravity), z, y)
            if seen is not None:
                self._alarm.see(*seen, self.arm.jacobian(then))
            if seen is not None or self._alarm.count in self._asked:
                self.verdict = self._alarm.verdict()
        return self.verdict

    @property
    def stale(self) -> tuple[str, ...]:
        """What has told no number for 50 ms: ``joints`` (sensors, references or torques), ``tool`` once it has been seen."""
        tool = self._seen > 0 and self._cycle - self._seen_at > self._longest
        return ("joints",) * (self._missed > self._longest) + ("tool",) * tool

    def _bridge(self, q: Array, tau: Array | None) -> None:
        """Follow straight lines over cycles that were passed over; after too many begin anew, once the filters have settled."""
        if self._q is not None and self._missed > self._longest:
            self._begin_anew()
        elif self._q is not None and self._missed:
            start, step = self._q, (q - self._q) / (self._missed + 1)
            torque = self._felt / self._known if self._known == self._missed else self._tau
            for k in range(1, self._missed + 1):
                self._observe(start + k * step, None if tau is None else torque)
        self._missed, self._known, self._felt = 0, 0, np.zeros(len(q))

    def _tracking(self, reference: Array, q: Array, elapsed: float, *, alone: bool) -> Array:
        """In units of its bounds; with joint sensors alone NaN unless all references were slow for a while."""
        if self._reference is not None and (np.abs(reference - self._reference) >= SLOW * elapsed).any():
            self._fast = self._cycle
        self._reference = reference
        if alone and self._cycle - self._fast < cycles(CALM, self._dt):
            return np.full(len(q), np.nan)
        return np.asarray(np.abs(reference - q) / self.bounds.tracking)

    def _look(self, q: Array, pose: Array) -> tuple[float, Array] | None:
        """A sample of the tool's pose: its smoothed residual in units of the bounds, and its own."""
        if not (np.isfinite(pose).all() and np.isfinite(q).all()):
            return None
        residual = tool_residual(self.arm, q[None], pose[None, :3, 3], pose[None, :3, :3])[0]
        self._last[self._seen % SMOOTHED] = residual
        mean = self._last[: self._seen + 1].sum(axis=0) / min(self._seen + 1, SMOOTHED)
        bounds = self.bounds
        w = max(float(np.linalg.norm(mean[:3])) / bounds.position, float(np.linalg.norm(mean[3:])) / bounds.angle)
        if self._seen:
            since = min(self._cycle - self._seen_at, self._longest)  # of a long silence one sample proves nothing
            self._over_w = max(0.0, self._over_w + (w - 1) * since * self._dt)
        self._seen, self._seen_at = self._seen + 1, self._cycle
        return w, residual

    def _observe(self, q: Array, tau: Array | None) -> None:
        n, dt = self.arm.n, self._dt
        anew = self._q is None or self._anew > 0
        if self._q is not None:  # the arm moves when it is seen again: its first rate is not filtered
            self._v = self._v + (1.0 if self._anew > self._longest else min(1.0, BAND * dt)) * ((q - self._q) / dt - self._v)
            self._anew = max(0, self._anew - 1)
        elif tau is not None:
            self._tau = self._low = tau
        self._q = q
        if tau is None or self._momentum is None:
            return
        self._tau = self._tau + min(1.0, BAND * dt) * (tau - self._tau)
        self._low = self._low + min(1.0, GAIN * dt) * (self._tau - self._low)
        p, energy, self._gravity = self._momentum(np.concatenate((q, self._v))).reshape(3, n)
        if not anew:
            known = self._tau + energy - self._gravity - friction_torque(self._v, self.bounds.coulomb, self.bounds.viscous)
            self._r = (1 - GAIN * dt) * self._r + GAIN * (p - self._p - dt * known)
        self._p = p
