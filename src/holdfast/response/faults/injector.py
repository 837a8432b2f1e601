"""Inject faults into any MuJoCo model. Only fields of the model change, it is not recompiled, and every change can be undone.

Source: derived here; the methods of locking a joint were compared in simulation (see the how-to page).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.response.faults.events import FaultEvent, FaultEvents
from holdfast.response.faults.fault_model import FaultModel, HasJointNames, list_joint_names
from holdfast.response.faults.kind import find_kind
from holdfast.response.faults.model_joint import ActiveFault, ModelJoint, SensorReading, find_actuators

TIME_TOLERANCE_S = 1e-9  # a fault that begins this close to the time of a step takes effect in this step, s


class FaultInjector:
    """Inject faults into a MuJoCo model and remove them again.

    The caller's loop is ``reset(episode)``, then for each step ``before_step(time)``, after the controller has written
    ``data.ctrl``, ``mujoco.mj_step``, and ``restore()``. Between ``restore`` and the next ``before_step`` no field of the model
    shows the fault, so a controller that reads limits, gains or damping from the model reads those of the healthy robot. A
    controller that should see sensor faults takes its joint values from ``read_sensors``. A pair of limits that overlap at the
    position of a locked joint holds it, and its momentum is transferred to the others as in an impact without rebound, unless
    the model has active equality constraints. MuJoCo applies implicit damping after its constraints, which would move the
    locked joint through the damping of the others. Therefore, the locked joint gets a damping that is large enough.

    Args:
        model: ``mujoco.MjModel`` with hinge and slide joints.
        data: ``mujoco.MjData``.
        joints: Arm, names of joints in the model, or None. None: named hinges and slides that have an actuator or belong to a
            mechanism with actuators, which excludes a goal and a floating base; all of them, if no joint has an actuator.
        faults: Fault model, or the events of one episode.
        horizon: End of an episode, s; see :meth:`holdfast.response.faults.FaultModel.draw`.

    Attributes:
        joints: Names of the n joints.
        events: Events of the current episode.
        applied: Time, s, of the step at which each event took effect; only for events that have begun.
        is_inserted: True while the active faults are in the model.

    Raises:
        InputError: The model lacks a joint, or cannot have a fault, such as a weak motor of a joint without a motor.
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
            driven = [number for number in _list_driven_joints(mujoco, model) if model.jnt_type[number] in allowed_types]
            joints = [name for name in (model.joint(number).name for number in driven) if name]
        self.joints = list_joint_names(joints)
        arm_limits = {joint.name: (joint.lower, joint.upper) for joint in getattr(joints, "joints", ())}
        self._ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in self.joints]
        for name, joint_id in zip(self.joints, self._ids, strict=True):
            if joint_id < 0 or model.jnt_type[joint_id] not in allowed_types:
                raise InputError(f"the model has no hinge or slide '{name}'; give the names of joints that it has")
        self._dofs = model.jnt_dofadr[self._ids]
        actuators = find_actuators(mujoco, model)
        integrators, flags = mujoco.mjtIntegrator, mujoco.mjtDisableBit
        implicit_integrators = [int(getattr(integrators, f"mjINT_{name}")) for name in ("EULER", "IMPLICIT", "IMPLICITFAST")]
        no_damping_flags = sum(int(getattr(flags, f"mjDSBL_{name}", 0)) for name in ("EULERDAMP", "DAMPER", "PASSIVE"))
        is_damped = not model.opt.disableflags & no_damping_flags
        self._changes: list[tuple[FloatArray, Any, Any]] = []  # array, row and value before the faults were inserted
        self._model_joints = [
            ModelJoint(
                model=model,
                data=data,
                index=index,
                joint_id=joint_id,
                actuators=actuators.get(joint_id, np.zeros(0, dtype=np.int64)),
                arm_limits=arm_limits.get(self.joints[index]),
                has_implicit_damping=is_damped and model.opt.integrator in implicit_integrators,
                changes=self._changes,
            )
            for index, joint_id in enumerate(self._ids)
        ]
        self.is_inserted = False
        self.events = FaultEvents()
        self.applied: dict[FaultEvent, float] = {}
        self.reset(0)
        self._check_entries()

    def reset(self, episode: int = 0) -> FaultEvents:
        """Undo all changes and sample the events of ``episode``, an index from 0; given events occur in every episode.

        Raises:
            InputError: The model cannot have a fault.
        """
        self.restore()
        for joint in self._model_joints:
            joint.read_effort(self._mujoco)
        faults = self.faults
        if isinstance(faults, (str, Path)):
            raise InputError(f"the faults are '{faults}'; read a file with holdfast.response.faults.load first")
        if isinstance(faults, FaultModel):
            self.events = faults.draw(self.joints, episode=episode, horizon=self.horizon)
        else:
            invalid = next((item for item in faults if not isinstance(item, FaultEvent)), None)
            if invalid is not None:
                raise InputError(
                    f"one of the faults is {invalid!r}; give a holdfast.response.faults.FaultModel, or FaultEvents"
                )
            self.events = FaultEvents(faults)
        for event in self.events:
            self._check_event(event)
        self._active: dict[FaultEvent, ActiveFault] = {}
        self._brakes: list[ActiveFault] = []
        self.applied, self.time = {}, -math.inf
        self._noise = np.random.default_rng(int(self.events.id[:16], 16))
        self._schedule_changes()
        return self.events

    def insert(self) -> None:
        """Insert the active faults into the model, on top of its current values."""
        self.restore()
        for fault in (*self._active.values(), *self._brakes):
            if not fault.is_pending:
                find_kind(fault.kind).apply(fault)
        self.is_inserted = True

    def restore(self) -> None:
        """Restore every number of the model, bit for bit, until the next ``before_step``."""
        for array, row, value in reversed(self._changes):
            array[row] = value
        self._changes.clear()
        self.is_inserted = False

    def actuators_of(self, joint: str) -> NDArray[np.int64]:
        """Return the indices of the actuators of ``joint``, given by name."""
        return self._model_joints[self.joints.index(joint)].actuators

    @property
    def dofs(self) -> NDArray[np.int64]:
        """Indices (n,) of the joints' degrees of freedom in the model."""
        return np.asarray(self._dofs)

    @property
    def places(self) -> dict[FaultEvent, float]:
        """Positions of the joints of the active events at their onset, rad or m."""
        return {event: fault.position for event, fault in self._active.items()}

    @property
    def changes_model(self) -> bool:
        """True if a fault of this episode changes the model; faults of sensors and of commands do not."""
        return any(find_kind(event.kind).changes_model for event in self.events)

    @property
    def active(self) -> FaultEvents:
        """Currently active events."""
        return FaultEvents(self._active)

    def brake(self, joint: str) -> None:
        """Brake ``joint`` (name) at once, until the next reset. A brake is not a fault and does not appear in ``active``."""
        model_joint = self._model_joints[self.joints.index(joint)]
        braked = ActiveFault("locked", model_joint, {}, self.time, model_joint.q)
        self._stop_with_impact(braked)
        self._brakes.append(braked)
        self._apply_brake_change()

    def release(self, joint: str) -> None:
        """Release ``joint`` (name), which was braked."""
        self._brakes = [braked for braked in self._brakes if braked.joint.name != joint]
        self._apply_brake_change()

    def before_step(self, time: float) -> None:
        """Begin and end the faults that are due at ``time``, s, and insert the active ones into the model."""
        self.advance(time)
        if not self.is_inserted:
            self.insert()

    def advance(self, time: float) -> None:
        """Begin and end the faults that are due at ``time``, s, without inserting them into a model that has none."""
        self.time, inserted = time, self.is_inserted
        if time >= self._next_change_s:
            self.insert()
            self._begin_and_end_faults(time)
        for fault in self._faults_each_step:
            self._update_fault(fault)
        if not inserted and self.is_inserted:
            self.restore()

    def read_sensors(self, q: ArrayLike, *, reference: ArrayLike | None = None) -> FloatArray:
        """Return the readings of the joint sensors.

        Args:
            q: (n,) true joint positions, rad and m.
            reference: (n,) references of the servos, rad and m, which the sensor of a slipping clutch follows.

        Returns:
            (n,) sensor readings, rad and m.
        """
        readings = np.array(q, dtype=np.float64)
        references = None if reference is None else np.asarray(reference, dtype=np.float64)
        for fault in self._active.values():
            index = fault.joint.index
            joint_reference = None if references is None else float(references[index])
            reading = SensorReading(float(readings[index]), self.time, joint_reference, self._noise)
            readings[index] = find_kind(fault.kind).read_sensor(reading, fault)
        return readings

    # ---- internal ----------------------------------------------------------------------------------------------------

    def _check_event(self, event: FaultEvent) -> None:
        if event.joint not in self.joints:
            raise InputError(f"a fault names joint '{event.joint}'; the joints are {', '.join(self.joints)}")
        find_kind(event.kind).check(self._model_joints[self.joints.index(event.joint)], event.parameters)

    def _check_entries(self) -> None:
        """Raise an error if the model cannot have a fault that a later episode could contain."""
        for entry in self.faults.entries if isinstance(self.faults, FaultModel) else ():
            names = entry.joints or self.joints
            weights = entry.weights or (1.0,) * len(names)
            for name in (name for name, weight in zip(names, weights, strict=True) if weight > 0 and entry.probability > 0):
                for bound_index in (0, 1):
                    laws = entry.parameters.items()
                    numbers = {key: law if isinstance(law, str) else law.ends[bound_index] for key, law in laws}
                    self._check_event(FaultEvent(entry.kind, name, 0.0, parameters=numbers))

    def _schedule_changes(self) -> None:
        """Set the time of the next onset or end, and the faults that need work at every step."""
        change_times = [event.onset for event in self.events if event not in self.applied]
        change_times += [event.end for event in self._active]
        self._next_change_s = min(change_times, default=math.inf) - TIME_TOLERANCE_S
        self._faults_each_step = [
            fault for fault in self._active.values() if fault.is_pending or find_kind(fault.kind).updates_each_step
        ]

    def _begin_and_end_faults(self, time: float) -> None:
        self._active = {event: fault for event, fault in self._active.items() if event.end > time + TIME_TOLERANCE_S}
        for event in self.events:
            if event in self.applied or event.onset > time + TIME_TOLERANCE_S:
                continue
            self.applied[event] = time
            if event.end <= time + TIME_TOLERANCE_S:
                continue
            joint, kind = self._model_joints[self.joints.index(event.joint)], find_kind(event.kind)
            fault = ActiveFault(event.kind, joint, event.parameters, event.onset, joint.q)
            kind.begin(fault)
            self._active[event] = fault
            if kind.holds_joint and not fault.is_pending:
                self._stop_with_impact(fault)
        self.insert()
        self._schedule_changes()

    def _apply_brake_change(self) -> None:
        """Apply a change of the brakes to the model if it currently contains the faults."""
        if self.is_inserted:
            self.insert()

    def _update_fault(self, fault: ActiveFault) -> None:
        kind = find_kind(fault.kind)
        if not fault.is_pending:
            kind.update(fault)
            if kind.changes_model:
                self._apply_brake_change()
        elif kind.take_delayed_effect(fault):
            self.insert()
            fault.is_pending = False
            if kind.holds_joint:
                self._stop_with_impact(fault)
            self.insert()
            self._schedule_changes()

    def _stop_with_impact(self, fault: ActiveFault) -> None:
        """Stop a joint, together with the locked joints, as in an impact: the momenta of all others are conserved."""
        velocity = self.data.qvel
        if self.model.neq and self.data.eq_active.any():
            return
        fault.is_still = fault.position == fault.joint.q
        if not velocity.any():
            return
        others = [other for other in (*self._active.values(), *self._brakes) if not other.is_pending]
        dofs = sorted({fault.joint.dof, *(other.joint.dof for other in others if find_kind(other.kind).holds_joint)})
        self._mujoco.mj_forward(self.model, self.data)
        units = np.zeros((len(dofs), self.model.nv))
        units[np.arange(len(dofs)), dofs] = 1.0
        responses = np.zeros_like(units)
        self._mujoco.mj_solveM(self.model, self.data, responses, units)
        velocity -= responses.T @ np.linalg.solve(responses[:, dofs].T, velocity[dofs])


def _list_driven_joints(mujoco: Any, model: Any) -> list[int]:
    """Return the joints with an actuator, and those of the same body tree except its root; all joints where none has one."""
    actuated = set(find_actuators(mujoco, model))
    body_roots = model.body_rootid[model.jnt_bodyid]
    trees = {body_roots[joint_id] for joint_id in actuated}
    in_tree = [root in trees and body != root for root, body in zip(body_roots, model.jnt_bodyid, strict=True)]
    return [joint_id for joint_id in range(model.njnt) if not actuated or joint_id in actuated or in_tree[joint_id]]
