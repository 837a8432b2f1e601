"""Faults of joint sensors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

from holdfast.response.faults.entry import Fault, FaultTiming, Joints, Value
from holdfast.response.faults.kind import FaultKind, FaultParameter, register_kind

if TYPE_CHECKING:
    from holdfast.kernels.program import SX
    from holdfast.response.faults.model_joint import ActiveFault, SensorReading
    from holdfast.response.faults.step_symbols import StepSymbols


class _SensorKind(FaultKind):
    is_sensor = needs_brake = True


class SensorBiasKind(_SensorKind):
    """A reading with a constant error."""

    code = 6
    parameters = ((FaultParameter("bias", 0.0, has_random_sign=True),),)

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        return reading.value + fault.number("bias")

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        step.q_measured += step.select(active, step.first, 0.0)


class SensorDriftKind(_SensorKind):
    """A reading whose error grows with time."""

    code = 7
    parameters = ((FaultParameter("rate", 0.0, has_random_sign=True),),)

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        return reading.value + fault.number("rate") * max(reading.time - fault.onset, 0.0)

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        step.q_measured += step.select(active, step.first * (step.time - step.onset), 0.0)


class SensorFreezeKind(_SensorKind):
    """A reading that keeps its value."""

    code = 8

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        return fault.position

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        step.q_measured = step.select(active, step.q_onset, step.q_measured)


class SensorNoiseKind(_SensorKind):
    """A reading with normal noise."""

    code = 9
    parameters = ((FaultParameter("deviation", 0.0),),)
    draws_noise = True

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        return reading.value + fault.number("deviation") * reading.generator.standard_normal()

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        step.q_measured += step.select(active, step.first * step.noise, 0.0)


@register_kind(SensorBiasKind())
def sensor_bias(joints: Joints = None, *, bias: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint sensor with a constant error.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        bias: Magnitude of the error, rad or m; its sign is random.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("sensor_bias", {"bias": bias}, joints, **when)


@register_kind(SensorDriftKind())
def sensor_drift(joints: Joints = None, *, rate: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint sensor whose error grows linearly with time.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        rate: Magnitude of the drift rate, rad/s or m/s; its sign is random.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("sensor_drift", {"rate": rate}, joints, **when)


@register_kind(SensorFreezeKind())
def sensor_freeze(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint sensor whose reading keeps its value from the onset.

    ``joints`` are names of possible joints (None: any), and ``when`` are options of :class:`holdfast.response.faults.Fault`.
    """
    return Fault("sensor_freeze", {}, joints, **when)


@register_kind(SensorNoiseKind())
def sensor_noise(joints: Joints = None, *, deviation: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint sensor with normal noise on every reading.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        deviation: Standard deviation of the noise, rad or m.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("sensor_noise", {"deviation": deviation}, joints, **when)
