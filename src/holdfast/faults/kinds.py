"""Kinds of faults, with a function for each: its effect on the joint, and its parameters.

All take ``joints`` (a name, several, or None for any joint) and, as keywords, what :class:`holdfast.faults.Fault` says of
``weights``, ``probability``, ``onset``, ``duration``, ``rate_per_hour``, ``together``, ``on`` and ``off``. A number may be a
law, as ``(0.2, 0.7)``; see there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypedDict, Unpack

from holdfast.faults.entry import Fault
from holdfast.faults.spread import ParameterDistribution

Joints = str | Sequence[str] | None
Value = float | tuple[float, float] | Mapping[str, float | Sequence[float]] | ParameterDistribution


class FaultTiming(TypedDict, total=False):
    """Options that every kind of fault accepts."""

    weights: Sequence[float] | None
    probability: float
    onset: Value | None
    duration: Value | None
    rate_per_hour: float | None
    together: int
    on: float | None
    off: float | None


def locked(joints: Joints = None, *, at: Value | str = "here", **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault that stops the joint at the onset for good; with ``at``, rad or m, when the joint next passes there."""
    return Fault("locked", {"at": at}, joints, **when)


def limp(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a motor without torque: the joint is free-swinging."""
    return Fault("limp", {}, joints, **when)


def weak(
    joints: Joints = None, *, gain: Value | None = None, ceiling: Value | None = None, **when: Unpack[FaultTiming]
) -> Fault:
    """Return a fault of a motor with ``gain`` times its torque, or a torque limit of ``ceiling`` times its effort,
    each 0 to 1.
    """
    return Fault("weak", {"gain": gain, "ceiling": ceiling}, joints, **when)


def friction(
    joints: Joints = None, *, coulomb: Value | None = None, viscous: Value | None = None, **when: Unpack[FaultTiming]
) -> Fault:
    """Return a fault with more friction: ``coulomb``, N m (N), and ``viscous``, N m s/rad (N s/m), at least one of them."""
    return Fault("friction", {"coulomb": coulomb, "viscous": viscous}, joints, **when)


def reduced_range(
    joints: Joints = None,
    *,
    travel: Value | None = None,
    lower: Value | None = None,
    upper: Value | None = None,
    **when: Unpack[FaultTiming],
) -> Fault:
    """Return a fault with a stop ``travel``, rad or m, from the position at the onset, on a random side, or at ``lower``,
    ``upper``.
    """
    return Fault("reduced_range", {"travel": travel, "lower": lower, "upper": upper}, joints, **when)


def reduced_speed(joints: Joints = None, *, velocity: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a motor that drives with at most effort times 1 - speed / ``velocity``, rad/s or m/s, and brakes as
    before.
    """
    return Fault("reduced_speed", {"velocity": velocity}, joints, **when)


def sensor_bias(joints: Joints = None, *, bias: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a sensor whose reading is off by ``bias``, rad or m, with a random sign."""
    return Fault("sensor_bias", {"bias": bias}, joints, **when)


def sensor_drift(joints: Joints = None, *, rate: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a sensor whose reading drifts at ``rate``, rad/s or m/s, with a random sign."""
    return Fault("sensor_drift", {"rate": rate}, joints, **when)


def sensor_freeze(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a sensor whose reading keeps its value from the onset."""
    return Fault("sensor_freeze", {}, joints, **when)


def sensor_noise(joints: Joints = None, *, deviation: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a sensor with normal noise of this standard deviation, rad or m, on every reading."""
    return Fault("sensor_noise", {"deviation": deviation}, joints, **when)


def command_dropout(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint that receives no new commands: the last one holds."""
    return Fault("command_dropout", {}, joints, **when)


def slipping_clutch(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a clutch: a brake holds the link, while the sensor, on the motor's side, follows the reference."""
    return Fault("slipping_clutch", {}, joints, **when)
