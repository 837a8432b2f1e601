"""Faults in environments of Gymnasium that are simulated with MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.mjcf import import_mujoco
from holdfast.arm.model import Arm
from holdfast.errors import HoldfastError, InputError
from holdfast.faults.entry import SENSOR
from holdfast.faults.events import FaultEvent
from holdfast.faults.feasibility import Feasibility, feasible
from holdfast.faults.injector import FaultInjector
from holdfast.faults.learning.physics_calls import PhysicsCalls
from holdfast.faults.learning.recording import Recorder
from holdfast.faults.scheme import Faults, Jointed

try:
    from gymnasium import Wrapper
except ImportError:  # said when one is made, so that the rest can be imported
    Wrapper = object

Array = NDArray[np.float64]
_NUDGE = 0.5  # rad or m: what moves by exactly so much is the joint's value, and no sine of it
_PLACES = (("model", "data"), ("robot_env.model", "robot_env.data"), ("sim.model._model", "sim.data._data"))


class FaultInfo(Mapping[str, Any]):
    """What ``info["fault"]`` tells: ``id``, ``events``, ``active``, ``feasible`` and ``why``.

    The last two are looked up when they are first asked for after a fault has begun, never inside a step.
    """

    def __init__(self, injector: FaultInjector, judge: Callable[[], Feasibility]) -> None:
        self._injector, self._judge = injector, judge

    def __getitem__(self, key: str) -> Any:
        if key in ("feasible", "why"):
            found = self._judge()
            return found.answer if key == "feasible" else found.why
        applied = self._injector.applied
        match key:
            case "id":
                return self._injector.events.id
            case "events":
                return [{**e.stored(), "applied": applied.get(e)} for e in self._injector.events]
            case "active":
                return [f"{e.joint}: {e.kind}" for e in self._injector.active]
        raise KeyError(key)

    def __iter__(self) -> Iterator[str]:
        return iter(("id", "events", "active", "feasible", "why"))

    def __len__(self) -> int:
        return 5

    def __repr__(self) -> str:
        active = self["active"]
        parts = [f"  {e.sentence()}{', active' if f'{e.joint}: {e.kind}' in active else ''}" for e in self._injector.events]
        return "\n".join([f"FaultInfo: {len(parts)} {'fault' if len(parts) == 1 else 'faults'} in this episode", *parts])


class FaultWrapper(Wrapper):  # type: ignore[misc]
    """An environment whose joints fail, by its own clock (needs ``holdfast[learn]`` and ``holdfast[physics]``).

    ``reset`` gives the model every number back before the environment resets, then draws the next episode;
    ``reset(options={"episode": 12})`` chooses one. What begins during a step takes effect with the next one; both times are
    in ``info["fault"]``. Observations change only where a sensor fails, and only in the entries of that joint's value; a
    controller inside the environment that reads MuJoCo's data keeps the truth.

    Args:
        env: An environment with a MuJoCo model: of Gymnasium, Gymnasium-Robotics or robosuite.
        faults: A fault model, or the events of every episode.
        joints: Names of joints in the model, or an arm; by default the joints of ``arm``, or else those that
            :class:`FaultInjector` takes.
        arm: The arm, and ``goal(env)``, where its tool should be, (3,) or (4, 4), m: to tell whether that is feasible.
        goal: See ``arm``.
        within: Angle in rad by which the tool's z axis may be off that of the goal, a pose; see :func:`holdfast.recover`.
        tolerance: Largest distance from the goal that counts as success, m, and rad for a pose.
        observes: Entries of the observation (a vector, or its part ``observation``) that hold a joint's value, by joint. If
            not given they are found by moving each joint.
        reveal: False: ``info`` says nothing, and only ``env.fault`` does, which no policy sees.
        horizon: s, the end of an episode, see :meth:`holdfast.faults.Faults.draw`.
        record: A folder for a record of each episode, see :func:`holdfast.faults.recorded`; more are added to it.

    Attributes:
        fault: What ``info["fault"]`` tells.

    Raises:
        InputError: No MuJoCo model is found, or it cannot have the faults.
        StoreError: The folder cannot be made.
        HoldfastError: Gymnasium or MuJoCo is not installed.
    """

    def __init__(
        self,
        env: Any,
        faults: Faults | Sequence[FaultEvent],
        *,
        joints: Jointed | Sequence[str] | None = None,
        arm: Arm | None = None,
        goal: Callable[[Any], Any] | None = None,
        within: float | None = None,
        observes: Mapping[str, Sequence[int]] | None = None,
        reveal: bool = True,
        tolerance: float = 1e-6,
        horizon: float = math.inf,
        record: str | Path | None = None,
    ) -> None:
        if Wrapper is object:
            raise HoldfastError("Gymnasium is not installed; pip install 'holdfast[learn]'")
        super().__init__(env)
        self._mujoco = import_mujoco()
        model, data = _found(env.unwrapped)
        self.injector = FaultInjector(model, data, arm if joints is None else joints, faults=faults, horizon=horizon)
        self._physics = PhysicsCalls(self.injector)
        self._arm, self._goal, self._reveal = arm, goal, reveal
        self._tolerance, self._within = tolerance, within
        self._observes, self._given, self._episode = dict(observes or {}), observes is not None, -1
        self._rows = model.jnt_qposadr[[model.joint(name).id for name in self.injector.joints]]
        self._recorder = None if record is None else Recorder(record)
        self._seed: int | None = None
        self._fresh()

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """The model as it was, the environment's own reset, and the next episode's faults."""
        self._finish("left")
        self._seed = seed
        chosen = dict(options or {})
        self._episode = int(chosen.pop("episode", self._episode + 1))
        self.injector.restore()
        observation, info = self.env.reset(seed=seed, options=chosen or None)
        if not self._has_model():  # some environments load theirs anew
            model, data = _found(self.env.unwrapped)
            self.injector = FaultInjector(
                model, data, self.injector.joints, faults=self.injector.faults, horizon=self.injector.horizon
            )
            self._physics = PhysicsCalls(self.injector)
        self.injector.reset(self._episode)
        self._fresh()
        if self._sensors:
            self._probe(observation)
        return self._seen(observation), self._told(info)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """The environment's step with the faults that have begun."""
        injector = self.injector
        injector.advance(injector.data.time)
        if self._dropouts:
            action = self._held(action)
        time, count = injector.data.time, self._physics.count
        with self._physics.watch():
            observation, reward, terminated, truncated, info = self.env.step(action)
        if self._physics.count == count and injector.data.time != time and injector.changes_model:
            raise InputError(
                f"{type(self.env.unwrapped).__name__} moves its model by other means than mujoco.mj_step, so its faults do not "
                "act; write the loop with holdfast.faults.FaultInjector"
            )
        if self._sensors:
            injector.time = injector.data.time
            observation = self._seen(observation)
        if self._reveal:
            info["fault"] = self.fault
        if self._recorder is not None:
            self._note(action, reward)
            self._success: bool | None = next((bool(info[key]) for key in ("is_success", "success") if key in info), None)
            if terminated or truncated:
                self._finish("terminated" if terminated else "truncated")
        return observation, reward, terminated, truncated, info

    def close(self) -> None:
        """Write the record of the last episode, and close the environment."""
        self._finish("left")
        self.env.close()

    # ---- inside ------------------------------------------------------------------------------------------------------

    def _note(self, action: Any, reward: Any) -> None:
        """What a robot would have recorded of this step."""
        assert self._recorder is not None
        injector, model, data = self.injector, self.injector.model, self.injector.data
        reference = np.full(len(injector.joints), np.nan)
        for j, name in enumerate(injector.joints):
            for a in injector.actuators_of(name):
                if model.actuator_biasprm[a, 1] < 0 and model.actuator_gear[a, 0] == 1:  # a servo of position
                    reference[j] = data.ctrl[a] * model.actuator_gainprm[a, 0] / -model.actuator_biasprm[a, 1]
        injector.time = data.time
        q, torque = injector.read(data.qpos[self._rows]), data.qfrc_actuator[injector.dofs]
        self._recorder.note(data.time, reference, q, torque, action, reward)

    def _finish(self, outcome: str) -> None:
        if self._recorder is None:
            return
        events, known = self.injector.events, self._judged().answer
        self._recorder.finish(
            seed=self._seed,
            episode=self._episode,
            events=events,
            feasible=known,
            outcome=outcome,
            success=self._success,
        )

    def _has_model(self) -> bool:
        return _found(self.env.unwrapped)[0] is self.injector.model

    def _fresh(self) -> None:
        """For a new episode."""
        kinds = {event.kind for event in self.injector.events}
        self._sensors, self._dropouts = bool(kinds & SENSOR), "command_dropout" in kinds
        self._last: Array | None = None
        self._success = None
        self._verdict: Feasibility | None = None
        self.fault: FaultInfo = FaultInfo(self.injector, self._judged)
        if self._dropouts and self.env.action_space.shape != (self.injector.model.nu,):
            raise InputError("a dropout needs actions that are the actuators' controls; this environment has others")

    def _told(self, info: dict[str, Any]) -> dict[str, Any]:
        return {**info, "fault": self.fault} if self._reveal else info

    def _judged(self) -> Feasibility:
        if self._verdict is not None:
            return self._verdict
        if self._arm is None or self._goal is None:
            return Feasibility("unknown", "no arm or no goal is given")
        if not self.injector.applied:
            return Feasibility("unknown", "no fault has begun")
        other = next((e.joint for e in self.injector.places if e.joint not in self._arm.joint_names), None)
        if other is not None:
            return Feasibility("unknown", f"'{other}' is not a joint of the arm")
        goal, places = self._goal(self.env), self.injector.places
        self._verdict = feasible(self._arm, goal, places, within=self._within, tolerance=self._tolerance)
        return self._verdict

    def _held(self, action: Any) -> Any:
        """The action in which a joint without commands keeps its last one."""
        last = action if self._last is None else self._last
        held = np.array(action)
        for event in self.injector.active:
            if event.kind == "command_dropout":
                which = self.injector.actuators_of(event.joint)
                held[which] = last[which]
        self._last = held
        return held

    def _seen(self, observation: Any) -> Any:
        """What sensors that fail make of an observation."""
        if not self._sensors or not any(e.kind in SENSOR for e in self.injector.active):
            return observation
        true = self.injector.data.qpos[self._rows]
        wrong = self.injector.read(true) - true
        whole = observation if isinstance(observation, dict) else {"observation": observation}
        seen = np.array(whole["observation"])
        for event in self.injector.active:
            if event.kind in SENSOR:
                entries = list(self._observes.get(event.joint, ()))
                seen[entries] += wrong[self.injector.joints.index(event.joint)]
        return {**whole, "observation": seen} if isinstance(observation, dict) else seen

    def _probe(self, observation: Any) -> None:
        """Find the entries of the joints whose sensors will fail, once."""
        joints = [e.joint for e in self.injector.events if e.kind in SENSOR and e.joint not in self._observes]
        if self._given or not joints:
            return
        look = getattr(self.env.unwrapped, "_get_obs", None)
        if look is None:
            raise InputError("the environment does not show where a joint's value is in its observation; give observes")
        model, data, kind = self.injector.model, self.injector.data, self._mujoco.mjtState.mjSTATE_INTEGRATION
        state = np.zeros(self._mujoco.mj_stateSize(model, kind))
        self._mujoco.mj_getState(model, data, state, kind)
        before = _vector(look())
        if before.shape != _vector(observation).shape or not np.allclose(before, _vector(observation), atol=1e-4):
            raise InputError("another wrapper changes the observation; put it around this one, or give observes")
        for joint in joints:
            data.qpos[self._rows[self.injector.joints.index(joint)]] += _NUDGE
            self._mujoco.mj_forward(model, data)
            moved = _vector(look()) - before
            entries = np.flatnonzero(np.abs(moved - _NUDGE) < 1e-5)
            self._mujoco.mj_setState(model, data, state, kind)
            if not entries.size:
                raise InputError(f"no entry of the observation is the value of '{joint}'; give observes, or another fault")
            self._observes[joint] = entries.tolist()
        self._mujoco.mj_forward(model, data)


def _vector(observation: Any) -> Array:
    return np.asarray(observation["observation"] if isinstance(observation, dict) else observation, dtype=np.float64)


def _found(env: Any) -> tuple[Any, Any]:
    """The MuJoCo model and data of an environment."""
    mujoco = import_mujoco()
    for places in _PLACES:
        found = []
        for place in places:
            thing = env
            for name in place.split("."):
                thing = getattr(thing, name, None)
            found.append(thing)
        if isinstance(found[0], mujoco.MjModel) and isinstance(found[1], mujoco.MjData):
            return found[0], found[1]
    raise InputError(f"{type(env).__name__} has no MuJoCo model that is found; faults are for environments with MuJoCo")
