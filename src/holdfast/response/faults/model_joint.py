"""Joint of a MuJoCo model that a fault changes, and the state of an active fault."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray

LOCK_OVERLAP = 1e-3  # overlap of the two limits of a lock, rad or m, so that both act at every step
_LOCK_DAMPING_FACTOR = 1e6  # damping of a locked joint over inertia per time step, if MuJoCo integrates damping implicitly
_NO_LIMIT = 1e9  # position of a missing stop, rad or m
_STIFF_TIME_STEPS = 2.0  # shortest stable time constant of MuJoCo's contacts, in time steps
_STOP_IMPEDANCE = (0.9999, 0.9999, 0.001, 0.5, 2.0)


def find_actuators(mujoco: ModuleType, model: Any) -> dict[int, NDArray[np.int64]]:
    """Return the indices of the actuators of each driven joint, by the index of the joint in the model."""
    on_joint = [int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)]
    joints = np.asarray(model.actuator_trnid).reshape(-1, 2)[:, 0]
    drives_joint = np.isin(np.asarray(model.actuator_trntype), on_joint)
    return {joint_id: np.flatnonzero(drives_joint & (joints == joint_id)) for joint_id in set(joints[drives_joint].tolist())}


@dataclass(eq=False, kw_only=True)
class ModelJoint:
    """Joint of a MuJoCo model. Every change of the model is stored so that it can be undone."""

    model: Any  # ``mujoco.MjModel``
    data: Any  # ``mujoco.MjData``
    index: int  # number of the joint among the injector's joints
    joint_id: int  # number of the joint in the model
    actuators: NDArray[np.int64]  # numbers of the actuators of the joint
    # limits of the arm's joint, rad or m, where an arm is given, because its model may have no stops
    arm_limits: tuple[float, float] | None
    has_implicit_damping: bool  # True if MuJoCo integrates damping implicitly
    changes: list[tuple[FloatArray, Any, Any]]  # array, row, and earlier value of each change
    _effort: float | None = None

    @property
    def name(self) -> str:
        """Name of the joint."""
        return str(self.model.joint(self.joint_id).name)

    @property
    def dof(self) -> int:
        """Number of the degree of freedom."""
        return int(self.model.jnt_dofadr[self.joint_id])

    @property
    def q(self) -> float:
        """Position, rad or m."""
        return float(self.data.qpos[self.model.jnt_qposadr[self.joint_id]])

    @property
    def speed(self) -> float:
        """Velocity with its sign, rad/s or m/s."""
        return float(self.data.qvel[self.dof])

    @property
    def model_limits(self) -> tuple[float, float]:
        """Limits in the model, rad or m; far away where the model has none."""
        lower, upper = self.model.jnt_range[self.joint_id] if self.model.jnt_limited[self.joint_id] else (-_NO_LIMIT, _NO_LIMIT)
        return lower, upper

    @property
    def limits(self) -> tuple[float, float]:
        """Limits of the arm, or of the model if no arm is given, rad or m; infinite where there are none."""
        if self.arm_limits is not None:
            return self.arm_limits
        return self.model_limits if self.model.jnt_limited[self.joint_id] else (-math.inf, math.inf)

    @property
    def command(self) -> FloatArray:
        """Commands of the actuators."""
        return np.array(self.data.ctrl[self.actuators])

    def write_command(self, command: FloatArray) -> None:
        """Replace the commands of the actuators."""
        self.data.ctrl[self.actuators] = command

    def require_actuator(self, kind: str) -> None:
        """Raise an error for a motor fault of a joint without an actuator.

        Raises:
            InputError: The joint has no actuator.
        """
        if not self.actuators.size:
            raise InputError(f"'{kind}' is a fault of a motor, and '{self.name}' has none; choose another")

    def total_effort(self, kind: str) -> float:
        """Return the total effort of all motors, N m or N.

        Raises:
            InputError: The model does not limit the effort of a motor.
        """
        if self._effort is None:
            raise InputError(
                f"'{kind}' of '{self.name}' needs the effort of its motor, and the model states none; give it "
                "actuatorfrcrange, forcerange or ctrlrange"
            )
        return self._effort

    def read_effort(self, mujoco: ModuleType) -> None:
        """Read the effort from the current model, which must be without faults."""
        model, joint_id, total = self.model, self.joint_id, 0.0
        fixed_gain = int(mujoco.mjtGain.mjGAIN_FIXED), int(mujoco.mjtBias.mjBIAS_NONE)
        self._effort = None
        if model.jnt_actfrclimited[joint_id]:
            self._effort = float(np.abs(model.jnt_actfrcrange[joint_id]).max())
            return
        for actuator in self.actuators:
            gear = abs(float(model.actuator_gear[actuator, 0]))
            if model.actuator_forcelimited[actuator]:
                force = np.abs(model.actuator_forcerange[actuator]).max()
            elif (
                model.actuator_ctrllimited[actuator]
                and (model.actuator_gaintype[actuator], model.actuator_biastype[actuator]) == fixed_gain
            ):
                force = np.abs(model.actuator_ctrlrange[actuator]).max() * abs(model.actuator_gainprm[actuator, 0])
            else:
                return
            total += gear * float(force)
        self._effort = total if self.actuators.size else None

    def write_field(self, field: str, row: Any, value: Any) -> None:
        """Write rows of a field of the model, and store their earlier value."""
        array = getattr(self.model, field)
        self.changes.append((array, row, np.copy(array[row])))
        array[row] = value

    def limit_force(self, lower: float, upper: float) -> None:
        """Limit the total force of the actuators, N m or N."""
        self.write_field("jnt_actfrclimited", self.joint_id, 1)
        self.write_field("jnt_actfrcrange", self.joint_id, (lower, upper))

    def limit_range(self, lower: float, upper: float) -> None:
        """Limit the range, rad or m."""
        self.write_field("jnt_limited", self.joint_id, 1)
        self.write_field("jnt_range", self.joint_id, (lower, upper))

    def hold(self, position: float, *, is_still: bool) -> None:
        """Hold the joint at a position, rad or m, by a pair of limits that overlap there."""
        model, time_step = self.model, self.model.opt.timestep
        self.limit_range(position + LOCK_OVERLAP, position - LOCK_OVERLAP)
        self.write_field("jnt_solref", self.joint_id, (_STIFF_TIME_STEPS * time_step, 1.0))
        self.write_field("jnt_solimp", self.joint_id, _STOP_IMPEDANCE)
        if is_still and self.has_implicit_damping:
            self.write_field("dof_damping", self.dof, _LOCK_DAMPING_FACTOR * model.dof_M0[self.dof] / time_step)


@dataclass(eq=False)
class ActiveFault:
    """State of an active fault."""

    kind: str  # name of the kind
    joint: ModelJoint  # joint with the fault
    numbers: Mapping[str, float | str]  # parameters by name, with their sign
    onset: float  # time of the onset, s
    position: float  # position of the joint at the onset, or at which it is held, rad or m
    is_pending: bool = False  # True if the fault waits until the joint reaches a position
    is_still: bool = False  # True if the joint was stopped at the position at which it is held
    memory: Any = None  # what the kind keeps from one step to the next

    def number(self, name: str, default: float = 0.0) -> float:
        """Return a parameter, or the default where it is not given."""
        return float(self.numbers.get(name, default))


@dataclass(frozen=True)
class SensorReading:
    """Reading of a joint sensor."""

    value: float  # reading without the fault, rad or m
    time: float  # time, s
    reference: float | None  # reference of the servo, rad or m; None if it is not known
    generator: np.random.Generator  # random generator of the noise
