"""The kinds of faults, a function for each: what goes wrong with the joint, and by how much.

All take ``joints`` (a name, several, or None for any joint) and, as keywords, what :class:`holdfast.faults.Fault` says of
``weights``, ``probability``, ``onset``, ``duration``, ``rate_per_hour``, ``together``, ``on`` and ``off``. A number may be a
law, as ``(0.2, 0.7)``; see there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypedDict, Unpack

from holdfast.faults.entry import Fault
from holdfast.faults.spread import Spread

Joints = str | Sequence[str] | None
Value = float | tuple[float, float] | Mapping[str, float | Sequence[float]] | Spread


class When(TypedDict, total=False):
    """What every kind takes."""

    weights: Sequence[float] | None
    probability: float
    onset: Value | None
    duration: Value | None
    rate_per_hour: float | None
    together: int
    on: float | None
    off: float | None


def locked(joints: Joints = None, *, at: Value | str = "here", **when: Unpack[When]) -> Fault:
    """The joint stops at the onset and stays; or with ``at``, rad or m, when it next passes there."""
    return Fault("locked", {"at": at}, joints, **when)


def limp(joints: Joints = None, **when: Unpack[When]) -> Fault:
    """The motor gives no torque: the joint is free-swinging."""
    return Fault("limp", {}, joints, **when)


def weak(joints: Joints = None, *, gain: Value | None = None, ceiling: Value | None = None, **when: Unpack[When]) -> Fault:
    """The motor gives ``gain`` times its torque; or is cut off at ``ceiling`` times its effort. Either is between 0 and 1."""
    return Fault("weak", {"gain": gain, "ceiling": ceiling}, joints, **when)


def friction(
    joints: Joints = None, *, coulomb: Value | None = None, viscous: Value | None = None, **when: Unpack[When]
) -> Fault:
    """More friction than before: ``coulomb``, N m (N), and ``viscous``, N m s/rad (N s/m), one of them at least."""
    return Fault("friction", {"coulomb": coulomb, "viscous": viscous}, joints, **when)


def reduced_range(
    joints: Joints = None,
    *,
    travel: Value | None = None,
    lower: Value | None = None,
    upper: Value | None = None,
    **when: Unpack[When],
) -> Fault:
    """A stop ``travel`` away, rad or m, to a side that is drawn, of where it is then; or stops at ``lower``, ``upper``."""
    return Fault("reduced_range", {"travel": travel, "lower": lower, "upper": upper}, joints, **when)


def reduced_speed(joints: Joints = None, *, velocity: Value, **when: Unpack[When]) -> Fault:
    """The motor drives with at most effort times 1 - speed / ``velocity``, rad/s or m/s; it brakes as before."""
    return Fault("reduced_speed", {"velocity": velocity}, joints, **when)


def sensor_bias(joints: Joints = None, *, bias: Value, **when: Unpack[When]) -> Fault:
    """The sensor reads ``bias``, rad or m, too much or too little: the sign is drawn."""
    return Fault("sensor_bias", {"bias": bias}, joints, **when)


def sensor_drift(joints: Joints = None, *, rate: Value, **when: Unpack[When]) -> Fault:
    """The reading departs from the joint at ``rate``, rad/s or m/s, with a sign that is drawn."""
    return Fault("sensor_drift", {"rate": rate}, joints, **when)


def sensor_freeze(joints: Joints = None, **when: Unpack[When]) -> Fault:
    """The reading stays what it was at the onset."""
    return Fault("sensor_freeze", {}, joints, **when)


def sensor_noise(joints: Joints = None, *, deviation: Value, **when: Unpack[When]) -> Fault:
    """Normal noise of this standard deviation, rad or m, on every reading."""
    return Fault("sensor_noise", {"deviation": deviation}, joints, **when)


def command_dropout(joints: Joints = None, **when: Unpack[When]) -> Fault:
    """The joint gets no new commands: the last one holds."""
    return Fault("command_dropout", {}, joints, **when)


def slipping_clutch(joints: Joints = None, **when: Unpack[When]) -> Fault:
    """The link stays where it is, held by its brake, while the sensor, on the motor's side, follows the reference."""
    return Fault("slipping_clutch", {}, joints, **when)
