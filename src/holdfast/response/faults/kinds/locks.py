"""Faults that hold a joint."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Unpack

from holdfast.core.errors import InputError
from holdfast.response.faults.entry import Fault, FaultTiming, Joints, Value
from holdfast.response.faults.kind import FaultKind, FaultParameter, Numbers, register_kind

if TYPE_CHECKING:
    from holdfast.kernels.program import SX
    from holdfast.response.faults.model_joint import ActiveFault, ModelJoint, SensorReading
    from holdfast.response.faults.step_symbols import StepSymbols


class _HoldingKind(FaultKind):
    holds_joint = needs_brake = True

    def apply(self, fault: ActiveFault) -> None:
        fault.joint.hold(fault.position, is_still=fault.is_still)


class LockedKind(_HoldingKind):
    """A locked joint."""

    code = 0
    parameters = ((FaultParameter("at", word="here"),),)

    def is_delayed(self, numbers: Numbers) -> bool:
        return numbers.get("at", "here") != "here"

    def check(self, joint: ModelJoint, numbers: Numbers) -> None:
        if not self.is_delayed(numbers):
            return
        position, (lower, upper) = float(numbers["at"]), joint.limits
        if not lower <= position <= upper:
            raise InputError(f"'{joint.name}' locks at {position:g}, beyond its limits {lower:g} and {upper:g}")

    def begin(self, fault: ActiveFault) -> None:
        """Store the side from which the joint approaches the position at which it locks."""
        if self.is_delayed(fault.numbers):
            distance = fault.position - fault.number("at")
            fault.is_pending, fault.memory = distance != 0, math.copysign(1.0, distance)

    def take_delayed_effect(self, fault: ActiveFault) -> bool:
        position = fault.number("at")
        has_arrived: bool = (fault.joint.q - position) * fault.memory <= 0
        if has_arrived:
            fault.position = position
        return has_arrived


class SlippingClutchKind(_HoldingKind):
    """A brake holds the link, and the sensor on the motor's side follows the reference."""

    code = 11

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        return reading.value if reading.reference is None else reading.reference

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        step.q_measured = step.select(active, step.q_motor, step.q_measured)


@register_kind(LockedKind())
def locked(joints: Joints = None, *, at: Value | str = "here", **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault that stops a joint permanently.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        at: Position at which the joint locks when it next passes it, rad or m. Default: its position at the onset.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("locked", {"at": at}, joints, **when)


@register_kind(SlippingClutchKind())
def slipping_clutch(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a clutch: a brake holds the link, and the sensor on the motor's side follows the reference.

    ``joints`` are names of possible joints (None: any), and ``when`` are options of :class:`holdfast.response.faults.Fault`.
    """
    return Fault("slipping_clutch", {}, joints, **when)
