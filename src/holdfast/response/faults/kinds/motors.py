"""Faults of motors, of their commands, and of gears."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

from holdfast.core.errors import InputError
from holdfast.response.faults.entry import Fault, FaultTiming, Joints, Value
from holdfast.response.faults.kind import FaultKind, FaultParameter, Numbers, register_kind

if TYPE_CHECKING:
    from holdfast.kernels.program import SX
    from holdfast.response.faults.model_joint import ActiveFault, ModelJoint
    from holdfast.response.faults.step_symbols import StepSymbols


class _MotorKind(FaultKind):
    def check(self, joint: ModelJoint, numbers: Numbers) -> None:
        joint.require_actuator(self.name)


class LimpKind(_MotorKind):
    """A motor without torque."""

    code = 1
    needs_brake = True

    def apply(self, fault: ActiveFault) -> None:
        fault.joint.limit_force(0.0, 0.0)

    def torque_fraction(self, numbers: Numbers) -> float:
        return 0.0


class WeakKind(_MotorKind):
    """A motor with less torque."""

    code = 2
    parameters = (
        (FaultParameter("gain", 0.0, 1.0, includes_ends=False),),
        (FaultParameter("ceiling", 0.0, 1.0, includes_ends=False),),
    )

    def check(self, joint: ModelJoint, numbers: Numbers) -> None:
        super().check(joint, numbers)
        if "gain" in numbers and joint.model.jnt_actgravcomp[joint.joint_id]:
            raise InputError(
                f"the motor of '{joint.name}' compensates gravity inside MuJoCo, which no gain affects; give the torque as a "
                "control, or use ceiling"
            )
        if "ceiling" in numbers:
            joint.total_effort(self.name)

    def apply(self, fault: ActiveFault) -> None:
        joint = fault.joint
        if "gain" in fault.numbers:
            for field in ("actuator_gainprm", "actuator_biasprm"):
                values = getattr(joint.model, field)[joint.actuators]
                joint.write_field(field, joint.actuators, values * fault.number("gain"))
        else:
            max_force = fault.number("ceiling") * joint.total_effort(self.name)
            joint.limit_force(-max_force, max_force)

    def torque_fraction(self, numbers: Numbers) -> float:
        return float(numbers.get("gain", numbers.get("ceiling", 0.0)))


class FrictionKind(FaultKind):
    """Increased friction."""

    code = 3
    parameters = ((FaultParameter("coulomb", 0.0), FaultParameter("viscous", 0.0)),)

    def apply(self, fault: ActiveFault) -> None:
        joint, model, dof = fault.joint, fault.joint.model, fault.joint.dof
        joint.write_field("dof_frictionloss", dof, model.dof_frictionloss[dof] + fault.number("coulomb"))
        joint.write_field("dof_damping", dof, model.dof_damping[dof] + fault.number("viscous"))


class ReducedSpeedKind(_MotorKind):
    """A motor whose driving torque decreases with its speed."""

    code = 5
    parameters = ((FaultParameter("velocity", 0.0, includes_ends=False),),)

    def check(self, joint: ModelJoint, numbers: Numbers) -> None:
        super().check(joint, numbers)
        joint.total_effort(self.name)

    def update(self, fault: ActiveFault) -> None:
        """Store the range of the force, N m or N."""
        speed, effort = fault.joint.speed, fault.joint.total_effort(self.name)
        driving_effort = effort * max(0.0, 1.0 - abs(speed) / fault.number("velocity"))
        fault.memory = (-effort, driving_effort) if speed > 0 else (-driving_effort, effort)

    def apply(self, fault: ActiveFault) -> None:
        if fault.memory is not None:
            fault.joint.limit_force(*fault.memory)

    def change_motion(self, step: StepSymbols, active: SX) -> None:
        step.speed_limits = step.select(active, step.minimum(step.first, step.speed_limits), step.speed_limits)


class CommandDropoutKind(_MotorKind):
    """A joint that keeps its last command."""

    code = 10
    drops_commands = True

    def begin(self, fault: ActiveFault) -> None:
        """Store the last command."""
        fault.memory = fault.joint.command

    def update(self, fault: ActiveFault) -> None:
        fault.joint.write_command(fault.memory)

    def change_motion(self, step: StepSymbols, active: SX) -> None:
        step.command = step.select(active, step.last_command, step.command)


@register_kind(LimpKind())
def limp(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a motor without torque, so that the joint is free-swinging.

    ``joints`` are names of possible joints (None: any), and ``when`` are options of :class:`holdfast.response.faults.Fault`.
    """
    return Fault("limp", {}, joints, **when)


@register_kind(WeakKind())
def weak(
    joints: Joints = None, *, gain: Value | None = None, ceiling: Value | None = None, **when: Unpack[FaultTiming]
) -> Fault:
    """Return a fault of a motor with partial torque loss; give ``gain`` or ``ceiling``.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        gain: Remaining torque as a fraction of the commanded torque, between 0 and 1.
        ceiling: Torque limit as a fraction of the motor's effort, between 0 and 1.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("weak", {"gain": gain, "ceiling": ceiling}, joints, **when)


@register_kind(FrictionKind())
def friction(
    joints: Joints = None, *, coulomb: Value | None = None, viscous: Value | None = None, **when: Unpack[FaultTiming]
) -> Fault:
    """Return a fault with increased friction; give at least one of its parameters.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        coulomb: Additional dry friction, N m (N for a prismatic joint).
        viscous: Additional viscous friction, N m s/rad (N s/m for a prismatic joint).
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("friction", {"coulomb": coulomb, "viscous": viscous}, joints, **when)


@register_kind(ReducedSpeedKind())
def reduced_speed(joints: Joints = None, *, velocity: Value, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a motor whose driving torque decreases linearly with speed: effort times 1 - speed / ``velocity``.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        velocity: Speed at which no driving torque remains, rad/s or m/s. The braking torque does not change.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("reduced_speed", {"velocity": velocity}, joints, **when)


@register_kind(CommandDropoutKind())
def command_dropout(joints: Joints = None, **when: Unpack[FaultTiming]) -> Fault:
    """Return a fault of a joint that receives no new commands and keeps its last one.

    ``joints`` are names of possible joints (None: any), and ``when`` are options of :class:`holdfast.response.faults.Fault`.
    """
    return Fault("command_dropout", {}, joints, **when)
