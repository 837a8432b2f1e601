"""Verdicts, and classification of a joint's fault from sums over the cycles after the alarm."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

STILL = 2e-3  # travel of a joint that does not move, rad or m
PART = 0.15  # and as a fraction of the travel of its reference
NOISE_FACTOR = 12.0  # standard deviations of the sensor that are added to it
ALL = 0.93  # torque loss above which the joint is free-swinging
FRICTION_LOSS_RANGE = (0.8, 1.2)  # torque losses that friction may conceal
MORE = 1.1  # torque loss that no motor fault can cause
TIMES = 2.0  # of dry friction: a torque that would move a joint that can move
AWAY = 5.0  # of the tracking threshold: at this error, a joint with hardly any motor torque has none
LOST = 20.0  # of the tracking threshold: an intact servo holds a pushed joint closer than this
SCALE = 0.25  # of the torque threshold: deviation of the residual
GROWN = 10.0  # of dry friction: friction is assumed not to grow by more
DRIVEN = 0.5  # of dry friction: smallest torque that counts as driving a joint


@dataclass(frozen=True)
class FaultVerdict:
    """Verdict of a monitor.

    Attributes:
        alarm: True if a residual raised an alarm.
        time: Time of the alarm, s; NaN without one.
        _: The following attributes are decided 20 and 120 ms after the alarm, and may be revised until 2 s after it.
        joint: Name of the faulty joint; None if no joint is faulty or it is not isolated yet.
        kind: ``locked``, ``standstill`` (locked, or free-swinging and held by friction), ``limp``, ``weak``, ``friction``,
            ``sluggish`` (torque loss or more friction, which look alike where gravity is small), ``sensor`` (sensor of the
            joint, or a slipping clutch), ``contact`` or ``unknown``.
        loss: Fraction of its torque that the motor lost; NaN if the kind does not involve a loss.
        uncertainty: Largest error of ``loss`` while the residuals of a healthy arm stay within those of calibration. It is
            large where the motor's torque is mostly friction, or the masses are not known.
        candidates: Kinds that remain possible.
        suspect: Name of the only joint that was above its threshold, if the kind is ``contact``; a fault of this joint remains
            possible. None otherwise.
        evidence: Phrases that state the reasons.
    """

    alarm: bool
    time: float = np.nan
    _: KW_ONLY
    joint: str | None = None
    kind: str = "unknown"
    loss: float = np.nan
    uncertainty: float = np.nan
    candidates: tuple[str, ...] = ()
    suspect: str | None = None
    evidence: tuple[str, ...] = ()


class FaultClassifier:
    """Sums over the motion of a joint after the alarm, from which its kind of fault is classified.

    Args:
        joint: Index of the joint, from 0.
        coulomb: Dry friction of the joint, N m or N.
        bounds: Thresholds of its residual torque, N m or N, and of its tracking error, rad or m.
        largest: Largest residual torque of the healthy arm on this joint, N m or N.
        noise: Standard deviation of the joint sensor, rad or m.
        torques: True if torques are monitored.
    """

    def __init__(
        self, joint: int, *, coulomb: float, bounds: tuple[float, float], largest: float, noise: float, torques: bool
    ) -> None:
        self.joint, self._coulomb, self._bounds, self._sensor_noise, self._has_torques = joint, coulomb, bounds, noise, torques
        self._cycle_count, self._tracking_error, self._healthy_residual, self._torque_sum = 0, 0.0, largest, 0.0
        self._q_range, self._reference_range = [np.inf, -np.inf], [np.inf, -np.inf]
        self._max_requested_torque, self._min_gravity_torque = 0.0, np.inf
        self._rr = self._rt = self._rs = self._tt = self._ts = self._ss = 0.0

    def add_cycle(self, q: float, reference: float, slip: float, torques: Sequence[float]) -> None:
        """Add the signals of one cycle.

        Args:
            q: Measured joint position, rad or m.
            reference: Reference of the joint, rad or m.
            slip: Smoothed sign of the rate, which is the direction of dry friction.
            torques: Residual torque, commanded torque through both filters of the residual, and gravity torque, N m or N.
        """
        residual, torque, gravity = torques
        self._cycle_count, self._tracking_error = self._cycle_count + 1, abs(reference - q)
        self._q_range = [min(self._q_range[0], q), max(self._q_range[1], q)]
        self._reference_range = [min(self._reference_range[0], reference), max(self._reference_range[1], reference)]
        self._max_requested_torque = max(self._max_requested_torque, abs(torque - gravity))
        self._min_gravity_torque = min(self._min_gravity_torque, abs(gravity))
        self._rr, self._rt, self._rs = self._rr + residual * residual, self._rt + residual * torque, self._rs + residual * slip
        self._tt, self._ts, self._ss = self._tt + torque * torque, self._ts + torque * slip, self._ss + slip * slip
        self._torque_sum += abs(torque)

    @property
    def exceeds_external_force_error(self) -> bool:
        """True if the joint is farther from its reference than an external force moves a joint with an intact motor."""
        return self._tracking_error > LOST * self._bounds[1]

    def classify(self, unit: str, candidates_without_pose: tuple[str, ...]) -> dict[str, Any]:
        """Return kind, loss, candidates, and evidence.

        A motor can lose at most all of its torque. A joint was pushed if it follows its reference against its motor although
        its motion requires a torque.

        Args:
            unit: Unit of the joint position.
            candidates_without_pose: Kinds that remain possible where the tool pose is not measured.
        """
        travel, reference_travel = (max(highest - lowest, 0.0) for lowest, highest in (self._q_range, self._reference_range))
        is_still = travel < STILL and travel < PART * reference_travel + NOISE_FACTOR * self._sensor_noise
        evidence = [f"it moved by {travel:.3g} {unit}, its reference by {reference_travel:.3g} {unit}"]

        def make_answer(kind: str, candidates: tuple[str, ...], loss: float = np.nan) -> dict[str, Any]:
            if np.isnan(loss):
                return {"kind": kind, "candidates": candidates, "evidence": tuple(evidence)}
            # Uncertainty of -sum r tau / sum tau^2 if r is off by at most `largest`.
            uncertainty = self._healthy_residual * self._torque_sum / self._tt
            loss_text = f"its motor lost {loss:.0%} of its torque, which may be off by {uncertainty:.0%}"
            return make_answer(kind, candidates) | {
                "loss": loss,
                "uncertainty": uncertainty,
                "evidence": (*evidence, loss_text),
            }

        if not self._has_torques:
            if is_still:
                return make_answer("locked", ("locked", "standstill", *candidates_without_pose))
            return make_answer("unknown", ())
        loss = float(np.clip(-self._rt / self._tt, 0.0, 1.3)) if self._tt > 0 else np.nan
        drag = max(0.0, -self._rs / max(self._ss, 1e-12))
        loss_error = self._rr + 2 * loss * self._rt + loss**2 * self._tt
        drag_error = self._rr + 2 * drag * self._rs + drag**2 * self._ss
        if is_still and self._max_requested_torque >= TIMES * self._coulomb:
            if FRICTION_LOSS_RANGE[0] < loss < FRICTION_LOSS_RANGE[1] and self._min_gravity_torque < TIMES * self._coulomb:
                evidence.append("friction may hold it, because gravity on it is small")
                return make_answer("standstill", ("locked", "limp", *candidates_without_pose), loss)
            return make_answer("locked", ("locked", *candidates_without_pose))
        if not min(loss_error, drag_error) < 0.5 * self._rr:
            return make_answer("unknown", ("weak", "friction", "reduced_range", "reduced_speed", *candidates_without_pose))
        follows = self._tracking_error < self._bounds[1]
        is_driven = self._rs + self._ts > DRIVEN * self._coulomb * self._ss > 0
        drag_disadvantage = (drag_error - loss_error) / (self._cycle_count * (SCALE * self._bounds[0]) ** 2)
        if abs(drag_disadvantage) < 1 and (drag <= GROWN * self._coulomb or self._coulomb == 0):
            alternatives = "a weak motor, more friction and a push" if follows else "a weak motor and more friction"
            evidence.append(f"{alternatives} explain its torque equally well")
            return make_answer("sluggish", ("weak", "friction", *["contact"] * follows), loss)
        if drag_disadvantage < 0:
            return make_answer("friction", ("friction",))
        if follows and is_driven and loss > MORE:
            evidence.append("it follows its reference against its motor, so an external force moved it")
            return make_answer("contact", ("contact",))
        if loss > ALL or (loss > FRICTION_LOSS_RANGE[0] and self._tracking_error > AWAY * self._bounds[1]):
            return make_answer("limp", ("limp",) if loss > ALL else ("limp", "weak"), loss)
        return make_answer("weak", ("weak",), loss)
