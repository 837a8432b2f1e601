"""Faults in any MuJoCo model: only fields of the model change, nothing is compiled again, and all of it can be undone.

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
from holdfast.faults.actuators import Actuators
from holdfast.faults.entry import SENSOR, TORQUE
from holdfast.faults.events import FaultEvent, FaultEvents
from holdfast.faults.scheme import Faults, Jointed, names_of

Array = NDArray[np.float64]

EARLY = 1e-9  # s: what begins at a step's time is not left to the next one
OVERLAP = 1e-3  # rad or m that a lock's two limits overlap: both act at every step, not one after it was passed
_HEAVY = 1e6  # of a locked joint's inertia a time step: its damping where MuJoCo integrates damping implicitly
_FAR = 1e9  # rad or m: a stop where there is none
_STIFF = 2.0  # time steps: the shortest time constant that MuJoCo's contacts keep stable
_IMPEDANCE = (0.9999, 0.9999, 0.001, 0.5, 2.0)
_HOLDS = ("locked", "slipping_clutch")


@dataclass
class _Active:
    """An event that is there: its joint's number, where that was at the onset, and what it holds."""

    event: FaultEvent
    joint: int
    place: float
    since: float
    pending: bool = False  # a lock that waits for its angle
    still: bool = False  # a joint that was stopped where it is held
    command: Array | None = None
    force_range: tuple[float, float] | None = None  # N m or N, of a motor whose speed is reduced


class FaultInjector:
    """Puts faults into a MuJoCo model and takes them out again.

    The caller's loop is ``reset(episode)``, then for each step ``before_step(time)``, after the controller has written
    ``data.ctrl``, ``mujoco.mj_step``, and ``restore()``. Between ``restore`` and the next ``before_step`` no field of the model
    shows the fault, so a controller that reads limits, gains or damping from the model reads those of the healthy robot. A
    controller that should see sensor faults takes its joint values from ``read``. A locked joint is held by
    a pair of limits that overlap there, and its momentum goes into the others as in an impact without rebound, unless the
    model has active equality constraints. MuJoCo's implicit damping comes after its constraints and would move the joint by
    what the others' damping gives: the joint gets so much of its own that it does not.

    Args:
        model: ``mujoco.MjModel``; its joints are hinges or slides.
        data: ``mujoco.MjData``.
        joints: An arm, names of joints in the model, or None: hinges and slides that have a name and an actuator, or hang on a
            machine that has some; so neither a goal nor the base of what walks. All, where there is no actuator on a joint.
        faults: A fault model, or the events of one episode.
        horizon: s, the end of an episode, see :meth:`holdfast.faults.Faults.draw`.

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
        joints: Jointed | Sequence[str] | None,
        *,
        faults: Faults | Sequence[FaultEvent],
        horizon: float = math.inf,
    ) -> None:
        self._mujoco = mujoco = import_mujoco()
        self.model, self.data, self.faults, self.horizon = model, data, faults, horizon
        simple = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
        if joints is None:
            joints = [
                model.joint(k).name for k in _driven(mujoco, model) if model.jnt_type[k] in simple and model.joint(k).name
            ]
        self.joints, self._arm = names_of(joints), {one.name: one for one in getattr(joints, "joints", ())}
        self._ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in self.joints]
        for name, k in zip(self.joints, self._ids, strict=True):
            if k < 0 or model.jnt_type[k] not in simple:
                raise InputError(f"the model has no hinge or slide '{name}'; give the names of joints that it has")
        self._qpos, self._dofs = model.jnt_qposadr[self._ids], model.jnt_dofadr[self._ids]
        self._motors = Actuators(mujoco, model, self._ids)
        implicit = [int(getattr(mujoco.mjtIntegrator, f"mjINT_{name}")) for name in ("EULER", "IMPLICIT", "IMPLICITFAST")]
        off = sum(int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}", 0)) for name in ("EULERDAMP", "DAMPER", "PASSIVE"))
        self._damped = model.opt.integrator in implicit and not model.opt.disableflags & off
        self._changes: list[tuple[Array, Any, Any]] = []  # array, row and value before the faults were inserted
        self.is_inserted = False
        self.events = FaultEvents()
        self.applied: dict[FaultEvent, float] = {}
        self.reset(0)
        self._check_entries()

    def reset(self, episode: int = 0) -> FaultEvents:
        """Undo everything, and draw what happens in an episode; events that were given happen in each.

        Raises:
            InputError: A fault that the model cannot have.
        """
        self.restore()
        self._motors.note()
        given = self.faults
        if isinstance(given, (str, Path)):
            raise InputError(f"the faults are '{given}'; read a file of them by holdfast.faults.load")
        if isinstance(given, Faults):
            self.events = given.draw(self.joints, episode=episode, horizon=self.horizon)
        else:
            wrong = next((x for x in given if not isinstance(x, FaultEvent)), None)
            if wrong is not None:
                raise InputError(f"one of the faults is {wrong!r}; give a holdfast.faults.Faults, or FaultEvents")
            self.events = FaultEvents(given)
        for event in self.events:
            self._check(event)
        self._active: list[_Active] = []
        self._brakes: list[_Active] = []
        self.applied, self.time = {}, -math.inf
        self._noise = np.random.default_rng(int(self.events.id[:16], 16))
        self._look()
        return self.events

    def insert(self) -> None:
        """Put the active faults into the model, on top of the values that it has now."""
        self.restore()
        for one in (*self._active, *self._brakes):
            self._put(one)
        self.is_inserted = True

    def restore(self) -> None:
        """Give the model back every number that it had, bit for bit, until the next ``before_step``."""
        for array, row, value in reversed(self._changes):
            array[row] = value
        self._changes.clear()
        self.is_inserted = False

    def actuators_of(self, joint: str) -> NDArray[np.int64]:
        """Numbers of the actuators of a joint, given by name."""
        return self._motors.of(self.joints.index(joint))

    @property
    def dofs(self) -> NDArray[np.int64]:
        """(n,) numbers of the joints' degrees of freedom in the model."""
        return np.asarray(self._dofs)

    @property
    def places(self) -> dict[FaultEvent, float]:
        """Where the joints of the active events were when these began, rad or m."""
        return {one.event: one.place for one in self._active}

    @property
    def changes_model(self) -> bool:
        """Whether a fault of this episode changes the model; faults of sensors and of commands do not."""
        return any(event.kind not in SENSOR | {"command_dropout"} for event in self.events)

    @property
    def active(self) -> FaultEvents:
        """The events that are there now."""
        return FaultEvents(one.event for one in self._active)

    def brake(self, joint: str) -> None:
        """Let the brake of a joint stop it where it is, at once and until the next reset; no fault, and not in ``active``."""
        j = self.joints.index(joint)
        event = FaultEvent("locked", joint, self.time)
        one = _Active(event, j, float(self.data.qpos[self._qpos[j]]), self.time)
        self._stop(one)
        self._brakes.append(one)
        self._update()

    def release(self, joint: str) -> None:
        """Release a joint that was braked."""
        j = self.joints.index(joint)
        self._brakes = [one for one in self._brakes if one.joint != j]
        self._update()

    def before_step(self, time: float) -> None:
        """Begin and end the faults that are due at a time, s, and insert the active ones into the model."""
        self.advance(time)
        if not self.is_inserted:
            self.insert()

    def advance(self, time: float) -> None:
        """Begin and end the faults that are due at a time, s, without inserting them into a model that has none."""
        self.time, inserted = time, self.is_inserted
        if time >= self._next:
            self.insert()
            self._change(time)
        for one in self._every:
            self._work(one)
        if not inserted and self.is_inserted:
            self.restore()

    def read(self, q: ArrayLike, *, reference: ArrayLike | None = None) -> Array:
        """What the sensors tell of the joints.

        Args:
            q: (n,) true values, rad and m.
            reference: (n,) what the servos follow, which is what the sensor before a slipping clutch shows.

        Returns:
            (n,) readings.
        """
        told = np.array(q, dtype=np.float64)
        for one in self._active:
            j, numbers = one.joint, one.event.parameters
            match one.event.kind:
                case "sensor_bias":
                    told[j] += float(numbers["bias"])
                case "sensor_drift":
                    told[j] += float(numbers["rate"]) * max(self.time - one.event.onset, 0.0)
                case "sensor_freeze":
                    told[j] = one.place
                case "sensor_noise":
                    told[j] += float(numbers["deviation"]) * self._noise.standard_normal()
                case "slipping_clutch" if reference is not None:
                    told[j] = np.asarray(reference, dtype=np.float64)[j]
        return told

    # ---- inside ------------------------------------------------------------------------------------------------------

    def _check(self, event: FaultEvent) -> None:
        if event.joint not in self.joints:
            raise InputError(f"a fault names joint '{event.joint}'; the joints are {', '.join(self.joints)}")
        j = self.joints.index(event.joint)
        k, kind = self._ids[j], event.kind
        if kind in TORQUE - {"friction"} or kind in ("reduced_speed", "command_dropout"):
            self._motors.require(event)
        if kind == "weak" and "gain" in event.parameters and self.model.jnt_actgravcomp[k]:
            raise InputError(
                f"the motor of '{event.joint}' compensates gravity inside MuJoCo, which no gain reaches; give the torque as a "
                "control, or use ceiling"
            )
        if kind == "reduced_speed" or "ceiling" in event.parameters:
            self._motors.effort(j, event)
        at = event.parameters.get("at", "here")
        if kind == "locked" and not isinstance(at, str):
            low, high = self.model.jnt_range[k] if self.model.jnt_limited[k] else (-math.inf, math.inf)
            if event.joint in self._arm:  # whose model may have no stops
                low, high = self._arm[event.joint].lower, self._arm[event.joint].upper
            if not low <= at <= high:
                raise InputError(f"'{event.joint}' locks at {at:g}, beyond its limits {low:g} and {high:g}")

    def _check_entries(self) -> None:
        """Refuse a fault model with a fault that some later episode could draw and the model cannot have."""
        for entry in self.faults.entries if isinstance(self.faults, Faults) else ():
            names = entry.joints or self.joints
            weights = entry.weights or (1.0,) * len(names)
            for name in (name for name, weight in zip(names, weights, strict=True) if weight > 0 and entry.probability > 0):
                for end in (0, 1):
                    numbers = {key: law if isinstance(law, str) else law.ends[end] for key, law in entry.parameters.items()}
                    self._check(FaultEvent(entry.kind, name, 0.0, parameters=numbers))

    def _look(self) -> None:
        """When something begins or ends next, and what has work at every step."""
        begun = {id(one.event) for one in self._active}
        ahead = [e.onset for e in self.events if e not in self.applied]
        ahead += [e.end for e in self.events if id(e) in begun]
        self._next = min(ahead, default=math.inf) - EARLY
        each = ("reduced_speed", "command_dropout")
        self._every = [one for one in self._active if one.pending or one.event.kind in each]

    def _change(self, time: float) -> None:
        qpos = self.data.qpos
        self._active = [one for one in self._active if one.event.end > time + EARLY]
        for event in self.events:
            if event in self.applied or event.onset > time + EARLY:
                continue
            self.applied[event] = time
            if event.end <= time + EARLY:
                continue
            j = self.joints.index(event.joint)
            one = _Active(event, j, float(qpos[self._qpos[j]]), time)
            at = event.parameters.get("at", "here")
            if event.kind == "locked" and not isinstance(at, str):
                one.pending, one.since = one.place != at, math.copysign(1.0, one.place - at)
            if event.kind == "command_dropout":
                one.command = self.data.ctrl[self._motors.of(j)].copy()
            self._active.append(one)
            if event.kind in _HOLDS and not one.pending:
                self._stop(one)
        self._apply()

    def _apply(self) -> None:
        """Put what is there now into the model, and nothing else."""
        self.insert()
        self._look()

    def _update(self) -> None:
        """Follow a change of the brakes where the model has the faults now."""
        if self.is_inserted:
            self.insert()

    def _write(self, field: str, row: Any, value: Any) -> None:
        """Write rows of a field of the model, and keep their value for ``restore``."""
        array = getattr(self.model, field)
        self._changes.append((array, row, np.copy(array[row])))
        array[row] = value

    def _put(self, one: _Active) -> None:
        k, dof, m, numbers = self._ids[one.joint], self._dofs[one.joint], self.model, one.event.parameters
        match one.event.kind:
            case "locked" | "slipping_clutch" if not one.pending:
                self._write("jnt_limited", k, 1)
                self._write("jnt_range", k, (one.place + OVERLAP, one.place - OVERLAP))
                self._write("jnt_solref", k, (_STIFF * m.opt.timestep, 1.0))
                self._write("jnt_solimp", k, _IMPEDANCE)
                if one.still and self._damped:
                    self._write("dof_damping", dof, _HEAVY * m.dof_M0[dof] / m.opt.timestep)
            case "limp":
                self._limit_force(k, 0.0, 0.0)
            case "weak" if "gain" in numbers:
                rows = self._motors.of(one.joint)
                for name in ("actuator_gainprm", "actuator_biasprm"):
                    self._write(name, rows, getattr(m, name)[rows] * numbers["gain"])
            case "weak":
                most = float(numbers["ceiling"]) * self._motors.effort(one.joint, one.event)
                self._limit_force(k, -most, most)
            case "reduced_speed" if one.force_range is not None:
                self._limit_force(k, *one.force_range)
            case "friction":
                self._write("dof_frictionloss", dof, m.dof_frictionloss[dof] + float(numbers.get("coulomb", 0.0)))
                self._write("dof_damping", dof, m.dof_damping[dof] + float(numbers.get("viscous", 0.0)))
            case "reduced_range":
                low, high = m.jnt_range[k] if m.jnt_limited[k] else (-_FAR, _FAR)
                travel = float(numbers.get("travel", 0.0))
                if "travel" in numbers:
                    low, high = (low, one.place + travel) if travel > 0 else (one.place + travel, high)
                # A stop behind the joint would throw it: it begins where the joint is.
                low = max(low, min(float(numbers.get("lower", low)), one.place))
                high = min(high, max(float(numbers.get("upper", high)), one.place))
                self._write("jnt_limited", k, 1)
                self._write("jnt_range", k, (low, high))

    def _limit_force(self, k: int, least: float, most: float) -> None:
        """Limit the force of all actuators on a joint, N m or N."""
        self._write("jnt_actfrclimited", k, 1)
        self._write("jnt_actfrcrange", k, (least, most))

    def _work(self, one: _Active) -> None:
        j = one.joint
        if one.command is not None:
            self.data.ctrl[self._motors.of(j)] = one.command
        elif one.pending:
            at, q = float(one.event.parameters["at"]), float(self.data.qpos[self._qpos[j]])
            if (q - at) * one.since <= 0:
                self.insert()
                one.pending, one.place = False, at
                self._stop(one)
                self._apply()
        else:
            speed, effort = float(self.data.qvel[self._dofs[j]]), self._motors.effort(j, one.event)
            most = effort * max(0.0, 1.0 - abs(speed) / float(one.event.parameters["velocity"]))
            one.force_range = (-effort, most) if speed > 0 else (-most, effort)
            self._update()

    def _stop(self, one: _Active) -> None:
        """Stop a joint and those that are held already as in an impact: the momenta of all others are kept."""
        velocity = self.data.qvel
        if self.model.neq and self.data.eq_active.any():
            return
        one.still = one.place == self.data.qpos[self._qpos[one.joint]]
        if not velocity.any():
            return
        still = (*self._active, *self._brakes)
        held = {self._dofs[a.joint] for a in still if a.event.kind in _HOLDS and not a.pending}
        dofs = sorted(held | {self._dofs[one.joint]})
        self._mujoco.mj_forward(self.model, self.data)
        units = np.zeros((len(dofs), self.model.nv))
        units[np.arange(len(dofs)), dofs] = 1.0
        answers = np.zeros_like(units)
        self._mujoco.mj_solveM(self.model, self.data, answers, units)
        velocity -= answers.T @ np.linalg.solve(answers[:, dofs].T, velocity[dofs])


def _driven(mujoco: Any, model: Any) -> list[int]:
    """Joints with an actuator, and those of the same tree of bodies but for its root's; all, where none has one."""
    own = set(Actuators(mujoco, model, []).driven)
    root = model.body_rootid[model.jnt_bodyid]
    trees = {root[k] for k in own}
    return [k for k in range(model.njnt) if not own or k in own or (root[k] in trees and model.jnt_bodyid[k] != root[k])]
