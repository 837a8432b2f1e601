"""Inject faults into any MuJoCo model: only fields of the model change, it is not recompiled, and every change can be undone.

Source: derived here; how the ways of locking a joint compare was measured in simulation (see the how-to page).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.mjcf import import_mujoco
from holdfast.errors import InputError
from holdfast.faults.actuators import JointActuators
from holdfast.faults.entry import SENSOR_KINDS, TORQUE_KINDS
from holdfast.faults.events import FaultEvent, FaultEvents
from holdfast.faults.scheme import FaultModel, HasJointNames, list_joint_names
from holdfast.typing import FloatArray

TIME_TOLERANCE_S = 1e-9  # s: what begins at a step's time is not left to the next one
LOCK_OVERLAP = 1e-3  # rad or m that a lock's two limits overlap: both act at every step, not one after it was passed
_LOCK_DAMPING_FACTOR = 1e6  # of a locked joint's inertia a time step: its damping where MuJoCo integrates damping implicitly
_NO_LIMIT = 1e9  # rad or m: a stop where there is none
_STIFF_TIME_STEPS = 2.0  # time steps: the shortest time constant that MuJoCo's contacts keep stable
_STOP_IMPEDANCE = (0.9999, 0.9999, 0.001, 0.5, 2.0)
_LOCKING_KINDS = ("locked", "slipping_clutch")


@dataclass
class _ActiveFault:
    """Active event: the number of its joint, the position of the joint at the onset, and its state."""

    event: FaultEvent
    joint: int
    position: float
    approach_sign: float
    is_pending: bool = False  # a lock that waits for its angle
    is_still: bool = False  # a joint that was stopped where it is held
    command: FloatArray | None = None
    force_range: tuple[float, float] | None = None  # N m or N, of a motor whose speed is reduced


class FaultInjector:
    """Inject faults into a MuJoCo model and remove them again.

    The caller's loop is ``reset(episode)``, then for each step ``before_step(time)``, after the controller has written
    ``data.ctrl``, ``mujoco.mj_step``, and ``restore()``. Between ``restore`` and the next ``before_step`` no field of the model
    shows the fault, so a controller that reads limits, gains or damping from the model reads those of the healthy robot. A
    controller that should see sensor faults takes its joint values from ``read_sensors``. A locked joint is held by
    a pair of limits that overlap there, and its momentum goes into the others as in an impact without rebound, unless the
    model has active equality constraints. MuJoCo's implicit damping comes after its constraints and would move the joint by
    what the others' damping gives: the joint gets so much of its own that it does not.

    Args:
        model: ``mujoco.MjModel``; its joints are hinges or slides.
        data: ``mujoco.MjData``.
        joints: An arm, names of joints in the model, or None: hinges and slides that have a name and an actuator, or hang on a
            machine that has some; so neither a goal nor the base of what walks. All, where there is no actuator on a joint.
        faults: A fault model, or the events of one episode.
        horizon: s, the end of an episode, see :meth:`holdfast.faults.FaultModel.draw`.

    Attributes:
        joints: Names of the n joints.
        events: Of this episode.
        applied: Of the events that have begun the time of the step at which they took effect, s.
        is_inserted: Whether the model has the active faults now.

    Raises:
        InputError: A joint that the model does not have; a fault that it cannot have, as a weak motor without a motor.
        HoldfastError: MuJoCo is not installed.
    """

    def __init__(
        self,
        model: Any,
        data: Any,
        joints: HasJointNames | Sequence[str] | None,
        *,
        faults: FaultModel | Sequence[FaultEvent],
        horizon: float = math.inf,
    ) -> None:
        self._mujoco = mujoco = import_mujoco()
        self.model, self.data, self.faults, self.horizon = model, data, faults, horizon
        allowed_types = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
        if joints is None:
            joints = [
                model.joint(joint_id).name
                for joint_id in _list_driven_joints(mujoco, model)
                if model.jnt_type[joint_id] in allowed_types and model.joint(joint_id).name
            ]
        self.joints, self._arm_joints = list_joint_names(joints), {joint.name: joint for joint in getattr(joints, "joints", ())}
        self._ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in self.joints]
        for name, joint_id in zip(self.joints, self._ids, strict=True):
            if joint_id < 0 or model.jnt_type[joint_id] not in allowed_types:
                raise InputError(f"the model has no hinge or slide '{name}'; give the names of joints that it has")
        self._qpos, self._dofs = model.jnt_qposadr[self._ids], model.jnt_dofadr[self._ids]
        self._actuators = JointActuators(mujoco, model, self._ids)
        implicit_integrators = [
            int(getattr(mujoco.mjtIntegrator, f"mjINT_{name}")) for name in ("EULER", "IMPLICIT", "IMPLICITFAST")
        ]
        no_damping_flags = sum(
            int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}", 0)) for name in ("EULERDAMP", "DAMPER", "PASSIVE")
        )
        self._has_implicit_damping = (
            model.opt.integrator in implicit_integrators and not model.opt.disableflags & no_damping_flags
        )
        self._changes: list[tuple[FloatArray, Any, Any]] = []  # array, row and value before the faults were inserted
        self.is_inserted = False
        self.events = FaultEvents()
        self.applied: dict[FaultEvent, float] = {}
        self.reset(0)
        self._check_entries()

    def reset(self, episode: int = 0) -> FaultEvents:
        """Undo all changes and draw the events of an episode; given events occur in each.

        Raises:
            InputError: A fault that the model cannot have.
        """
        self.restore()
        self._actuators.read_efforts()
        faults = self.faults
        if isinstance(faults, (str, Path)):
            raise InputError(f"the faults are '{faults}'; read a file of them by holdfast.faults.load")
        if isinstance(faults, FaultModel):
            self.events = faults.draw(self.joints, episode=episode, horizon=self.horizon)
        else:
            invalid = next((item for item in faults if not isinstance(item, FaultEvent)), None)
            if invalid is not None:
                raise InputError(f"one of the faults is {invalid!r}; give a holdfast.faults.FaultModel, or FaultEvents")
            self.events = FaultEvents(faults)
        for event in self.events:
            self._check_event(event)
        self._active: list[_ActiveFault] = []
        self._brakes: list[_ActiveFault] = []
        self.applied, self.time = {}, -math.inf
        self._noise = np.random.default_rng(int(self.events.id[:16], 16))
        self._schedule_changes()
        return self.events

    def insert(self) -> None:
        """Insert the active faults into the model, on top of its current values."""
        self.restore()
        for fault in (*self._active, *self._brakes):
            self._insert_fault(fault)
        self.is_inserted = True

    def restore(self) -> None:
        """Restore every number of the model, bit for bit, until the next ``before_step``."""
        for array, row, value in reversed(self._changes):
            array[row] = value
        self._changes.clear()
        self.is_inserted = False

    def actuators_of(self, joint: str) -> NDArray[np.int64]:
        """Return the numbers of the actuators of a joint, given by name."""
        return self._actuators.numbers_of_joint(self.joints.index(joint))

    @property
    def dofs(self) -> NDArray[np.int64]:
        """Numbers (n,) of the joints' degrees of freedom in the model."""
        return np.asarray(self._dofs)

    @property
    def places(self) -> dict[FaultEvent, float]:
        """Positions of the joints of the active events at their onset, rad or m."""
        return {fault.event: fault.position for fault in self._active}

    @property
    def changes_model(self) -> bool:
        """True if a fault of this episode changes the model; faults of sensors and of commands do not."""
        return any(event.kind not in SENSOR_KINDS | {"command_dropout"} for event in self.events)

    @property
    def active(self) -> FaultEvents:
        """Currently active events."""
        return FaultEvents(fault.event for fault in self._active)

    def brake(self, joint: str) -> None:
        """Brake a joint at once, until the next reset; this is no fault and does not appear in ``active``."""
        index = self.joints.index(joint)
        event = FaultEvent("locked", joint, self.time)
        braked = _ActiveFault(event, index, float(self.data.qpos[self._qpos[index]]), self.time)
        self._stop_joint(braked)
        self._brakes.append(braked)
        self._update_inserted()

    def release(self, joint: str) -> None:
        """Release a joint that was braked."""
        index = self.joints.index(joint)
        self._brakes = [braked for braked in self._brakes if braked.joint != index]
        self._update_inserted()

    def before_step(self, time: float) -> None:
        """Begin and end the faults that are due at a time, s, and insert the active ones into the model."""
        self.advance(time)
        if not self.is_inserted:
            self.insert()

    def advance(self, time: float) -> None:
        """Begin and end the faults that are due at a time, s, without inserting them into a model that has none."""
        self.time, inserted = time, self.is_inserted
        if time >= self._next_change_s:
            self.insert()
            self._begin_and_end_faults(time)
        for fault in self._faults_each_step:
            self._update_each_step(fault)
        if not inserted and self.is_inserted:
            self.restore()

    def read_sensors(self, q: ArrayLike, *, reference: ArrayLike | None = None) -> FloatArray:
        """Return the readings of the joint sensors.

        Args:
            q: (n,) true values, rad and m.
            reference: (n,) what the servos follow, which is what the sensor before a slipping clutch shows.

        Returns:
            (n,) readings.
        """
        readings = np.array(q, dtype=np.float64)
        for fault in self._active:
            index, numbers = fault.joint, fault.event.parameters
            match fault.event.kind:
                case "sensor_bias":
                    readings[index] += float(numbers["bias"])
                case "sensor_drift":
                    readings[index] += float(numbers["rate"]) * max(self.time - fault.event.onset, 0.0)
                case "sensor_freeze":
                    readings[index] = fault.position
                case "sensor_noise":
                    readings[index] += float(numbers["deviation"]) * self._noise.standard_normal()
                case "slipping_clutch" if reference is not None:
                    readings[index] = np.asarray(reference, dtype=np.float64)[index]
        return readings

    # ---- inside ------------------------------------------------------------------------------------------------------

    def _check_event(self, event: FaultEvent) -> None:
        if event.joint not in self.joints:
            raise InputError(f"a fault names joint '{event.joint}'; the joints are {', '.join(self.joints)}")
        index = self.joints.index(event.joint)
        joint_id, kind = self._ids[index], event.kind
        if kind in TORQUE_KINDS - {"friction"} or kind in ("reduced_speed", "command_dropout"):
            self._actuators.require_actuator(event)
        if kind == "weak" and "gain" in event.parameters and self.model.jnt_actgravcomp[joint_id]:
            raise InputError(
                f"the motor of '{event.joint}' compensates gravity inside MuJoCo, which no gain reaches; give the torque as a "
                "control, or use ceiling"
            )
        if kind == "reduced_speed" or "ceiling" in event.parameters:
            self._actuators.total_effort(index, event)
        lock_position = event.parameters.get("at", "here")
        if kind == "locked" and not isinstance(lock_position, str):
            lower, upper = self.model.jnt_range[joint_id] if self.model.jnt_limited[joint_id] else (-math.inf, math.inf)
            if event.joint in self._arm_joints:  # whose model may have no stops
                lower, upper = self._arm_joints[event.joint].lower, self._arm_joints[event.joint].upper
            if not lower <= lock_position <= upper:
                raise InputError(f"'{event.joint}' locks at {lock_position:g}, beyond its limits {lower:g} and {upper:g}")

    def _check_entries(self) -> None:
        """Raise an error for a fault model with a fault that a later episode could draw and the model cannot have."""
        for entry in self.faults.entries if isinstance(self.faults, FaultModel) else ():
            names = entry.joints or self.joints
            weights = entry.weights or (1.0,) * len(names)
            for name in (name for name, weight in zip(names, weights, strict=True) if weight > 0 and entry.probability > 0):
                for bound_index in (0, 1):
                    numbers = {
                        parameter: law if isinstance(law, str) else law.ends[bound_index]
                        for parameter, law in entry.parameters.items()
                    }
                    self._check_event(FaultEvent(entry.kind, name, 0.0, parameters=numbers))

    def _schedule_changes(self) -> None:
        """Set the time of the next onset or end, and the faults that need work at every step."""
        active_ids = {id(fault.event) for fault in self._active}
        change_times = [event.onset for event in self.events if event not in self.applied]
        change_times += [event.end for event in self.events if id(event) in active_ids]
        self._next_change_s = min(change_times, default=math.inf) - TIME_TOLERANCE_S
        stepwise_kinds = ("reduced_speed", "command_dropout")
        self._faults_each_step = [fault for fault in self._active if fault.is_pending or fault.event.kind in stepwise_kinds]

    def _begin_and_end_faults(self, time: float) -> None:
        qpos = self.data.qpos
        self._active = [fault for fault in self._active if fault.event.end > time + TIME_TOLERANCE_S]
        for event in self.events:
            if event in self.applied or event.onset > time + TIME_TOLERANCE_S:
                continue
            self.applied[event] = time
            if event.end <= time + TIME_TOLERANCE_S:
                continue
            index = self.joints.index(event.joint)
            fault = _ActiveFault(event, index, float(qpos[self._qpos[index]]), time)
            lock_position = event.parameters.get("at", "here")
            if event.kind == "locked" and not isinstance(lock_position, str):
                fault.is_pending, fault.approach_sign = (
                    fault.position != lock_position,
                    math.copysign(1.0, fault.position - lock_position),
                )
            if event.kind == "command_dropout":
                fault.command = self.data.ctrl[self._actuators.numbers_of_joint(index)].copy()
            self._active.append(fault)
            if event.kind in _LOCKING_KINDS and not fault.is_pending:
                self._stop_joint(fault)
        self._apply_faults()

    def _apply_faults(self) -> None:
        """Insert the currently active faults into the model, and nothing else."""
        self.insert()
        self._schedule_changes()

    def _update_inserted(self) -> None:
        """Apply a change of the brakes where the model currently has the faults."""
        if self.is_inserted:
            self.insert()

    def _write_field(self, field: str, row: Any, value: Any) -> None:
        """Write rows of a field of the model, and store their value for ``restore``."""
        array = getattr(self.model, field)
        self._changes.append((array, row, np.copy(array[row])))
        array[row] = value

    def _insert_fault(self, fault: _ActiveFault) -> None:
        joint_id, dof, model, numbers = self._ids[fault.joint], self._dofs[fault.joint], self.model, fault.event.parameters
        match fault.event.kind:
            case "locked" | "slipping_clutch" if not fault.is_pending:
                self._write_field("jnt_limited", joint_id, 1)
                self._write_field("jnt_range", joint_id, (fault.position + LOCK_OVERLAP, fault.position - LOCK_OVERLAP))
                self._write_field("jnt_solref", joint_id, (_STIFF_TIME_STEPS * model.opt.timestep, 1.0))
                self._write_field("jnt_solimp", joint_id, _STOP_IMPEDANCE)
                if fault.is_still and self._has_implicit_damping:
                    self._write_field("dof_damping", dof, _LOCK_DAMPING_FACTOR * model.dof_M0[dof] / model.opt.timestep)
            case "limp":
                self._limit_force(joint_id, 0.0, 0.0)
            case "weak" if "gain" in numbers:
                actuators = self._actuators.numbers_of_joint(fault.joint)
                for name in ("actuator_gainprm", "actuator_biasprm"):
                    self._write_field(name, actuators, getattr(model, name)[actuators] * numbers["gain"])
            case "weak":
                max_force = float(numbers["ceiling"]) * self._actuators.total_effort(fault.joint, fault.event)
                self._limit_force(joint_id, -max_force, max_force)
            case "reduced_speed" if fault.force_range is not None:
                self._limit_force(joint_id, *fault.force_range)
            case "friction":
                self._write_field("dof_frictionloss", dof, model.dof_frictionloss[dof] + float(numbers.get("coulomb", 0.0)))
                self._write_field("dof_damping", dof, model.dof_damping[dof] + float(numbers.get("viscous", 0.0)))
            case "reduced_range":
                lower, upper = model.jnt_range[joint_id] if model.jnt_limited[joint_id] else (-_NO_LIMIT, _NO_LIMIT)
                travel = float(numbers.get("travel", 0.0))
                if "travel" in numbers:
                    lower, upper = (lower, fault.position + travel) if travel > 0 else (fault.position + travel, upper)
                # A stop behind the joint would throw it: it begins where the joint is.
                lower = max(lower, min(float(numbers.get("lower", lower)), fault.position))
                upper = min(upper, max(float(numbers.get("upper", upper)), fault.position))
                self._write_field("jnt_limited", joint_id, 1)
                self._write_field("jnt_range", joint_id, (lower, upper))

    def _limit_force(self, joint_id: int, lower: float, upper: float) -> None:
        """Limit the force of all actuators on a joint, N m or N."""
        self._write_field("jnt_actfrclimited", joint_id, 1)
        self._write_field("jnt_actfrcrange", joint_id, (lower, upper))

    def _update_each_step(self, fault: _ActiveFault) -> None:
        index = fault.joint
        if fault.command is not None:
            self.data.ctrl[self._actuators.numbers_of_joint(index)] = fault.command
        elif fault.is_pending:
            lock_position, q = float(fault.event.parameters["at"]), float(self.data.qpos[self._qpos[index]])
            if (q - lock_position) * fault.approach_sign <= 0:
                self.insert()
                fault.is_pending, fault.position = False, lock_position
                self._stop_joint(fault)
                self._apply_faults()
        else:
            speed, effort = float(self.data.qvel[self._dofs[index]]), self._actuators.total_effort(index, fault.event)
            driving_effort = effort * max(0.0, 1.0 - abs(speed) / float(fault.event.parameters["velocity"]))
            fault.force_range = (-effort, driving_effort) if speed > 0 else (-driving_effort, effort)
            self._update_inserted()

    def _stop_joint(self, fault: _ActiveFault) -> None:
        """Stop a joint, together with the locked joints, as in an impact: the momenta of all others are conserved."""
        velocity = self.data.qvel
        if self.model.neq and self.data.eq_active.any():
            return
        fault.is_still = fault.position == self.data.qpos[self._qpos[fault.joint]]
        if not velocity.any():
            return
        locked_faults = (*self._active, *self._brakes)
        locked_dofs = {
            self._dofs[locked_fault.joint]
            for locked_fault in locked_faults
            if locked_fault.event.kind in _LOCKING_KINDS and not locked_fault.is_pending
        }
        dofs = sorted(locked_dofs | {self._dofs[fault.joint]})
        self._mujoco.mj_forward(self.model, self.data)
        units = np.zeros((len(dofs), self.model.nv))
        units[np.arange(len(dofs)), dofs] = 1.0
        responses = np.zeros_like(units)
        self._mujoco.mj_solveM(self.model, self.data, responses, units)
        velocity -= responses.T @ np.linalg.solve(responses[:, dofs].T, velocity[dofs])


def _list_driven_joints(mujoco: Any, model: Any) -> list[int]:
    """Return the joints with an actuator, and those of the same body tree except its root; all joints where none has one."""
    actuated = set(JointActuators(mujoco, model, []).driven_joints)
    body_roots = model.body_rootid[model.jnt_bodyid]
    trees = {body_roots[joint_id] for joint_id in actuated}
    return [
        joint_id
        for joint_id in range(model.njnt)
        if not actuated
        or joint_id in actuated
        or (body_roots[joint_id] in trees and model.jnt_bodyid[joint_id] != body_roots[joint_id])
    ]
