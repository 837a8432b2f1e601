"""Faults in Gymnasium environments that are simulated with MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.model.arm.model import Arm
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.fault_model import FaultModel, HasJointNames
from holdfast.response.faults.feasibility import Feasibility, feasible
from holdfast.response.faults.injector import FaultInjector
from holdfast.response.faults.kind import find_kind
from holdfast.response.faults.learning.physics_calls import PhysicsInterceptor
from holdfast.response.faults.learning.recording import EpisodeRecorder

try:
    from gymnasium import Wrapper
except ImportError:  # reported when a wrapper is created, so that the other names can be imported
    Wrapper = object

_PROBE_STEP = 0.5  # rad or m: an entry that changes by exactly this is the joint's value, and not its sine
_MODEL_ATTRIBUTES = (("model", "data"), ("robot_env.model", "robot_env.data"), ("sim.model._model", "sim.data._data"))


class FaultInfo(Mapping[str, Any]):
    """Content of ``info["fault"]``: ``id``, ``events``, ``active``, ``feasible``, and ``why``.

    The last two are computed when they are first read after a fault has begun, never inside a step.
    """

    def __init__(self, injector: FaultInjector, evaluate_feasibility: Callable[[], Feasibility]) -> None:
        self._injector, self._evaluate_feasibility = injector, evaluate_feasibility

    def __getitem__(self, key: str) -> Any:
        if key in ("feasible", "why"):
            feasibility = self._evaluate_feasibility()
            return feasibility.answer if key == "feasible" else feasibility.why
        applied = self._injector.applied
        match key:
            case "id":
                return self._injector.events.id
            case "events":
                return [{**event.to_stored(), "applied": applied.get(event)} for event in self._injector.events]
            case "active":
                return [f"{event.joint}: {event.kind}" for event in self._injector.active]
        raise KeyError(key)

    def __iter__(self) -> Iterator[str]:
        return iter(("id", "events", "active", "feasible", "why"))

    def __len__(self) -> int:
        return 5

    def __repr__(self) -> str:
        active = self["active"]
        marks = [", active" if f"{event.joint}: {event.kind}" in active else "" for event in self._injector.events]
        parts = [f"  {event.sentence()}{mark}" for event, mark in zip(self._injector.events, marks, strict=True)]
        return "\n".join([f"FaultInfo: {len(parts)} {'fault' if len(parts) == 1 else 'faults'} in this episode", *parts])


class FaultWrapper(Wrapper):  # type: ignore[misc]
    """Environment whose joints fail at times of its own clock (needs ``holdfast-arms[learn]`` and ``holdfast-arms[physics]``).

    ``reset`` restores every number of the model before the environment resets, then samples the next episode;
    ``reset(options={"episode": 12})`` selects one. A fault that begins during a step takes effect with the next one; both times
    are in ``info["fault"]``. Observations change only if a sensor fails, and only in the entries of that joint's value. A
    controller inside the environment that reads MuJoCo's data sees the true values.

    Args:
        env: Environment with a MuJoCo model, from Gymnasium, Gymnasium-Robotics or robosuite.
        faults: Fault model, or the events of every episode.
        joints: Names of joints in the model, or an arm. Default: the joints of ``arm``, or else those that
            :class:`FaultInjector` selects.
        arm: Arm of the environment; with ``goal`` it is used to decide if the goal is feasible.
        goal: Function ``goal(env)`` that returns the target of the tool, (3,) or (4, 4), m.
        within: Angle in rad by which the tool's z axis may deviate from that of the goal, a pose; see :func:`holdfast.recover`.
        tolerance: Largest distance from the goal that counts as success, m, and rad for a pose.
        observes: Entries of the observation (a vector, or its part ``observation``) that contain a joint's value, by joint.
            Default: they are found by moving each joint.
        reveal: False: ``info`` contains no faults; they are only in ``env.fault``, which policies do not see.
        horizon: End of an episode, s; see :meth:`holdfast.response.faults.FaultModel.draw`.
        record: Folder to which each episode is added; see :func:`holdfast.response.faults.read_episodes`.

    Attributes:
        fault: Content of ``info["fault"]``.

    Raises:
        InputError: The environment has no MuJoCo model, or the model cannot have the faults.
        StoreError: The folder cannot be created.
        HoldfastError: Gymnasium or MuJoCo is not installed.
    """

    def __init__(
        self,
        env: Any,
        faults: FaultModel | Sequence[FaultEvent],
        *,
        joints: HasJointNames | Sequence[str] | None = None,
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
            raise HoldfastError("Gymnasium is not installed; pip install 'holdfast-arms[learn]'")
        super().__init__(env)
        self._mujoco = import_mujoco()
        model, data = _find_model(env.unwrapped)
        self.injector = FaultInjector(model, data, arm if joints is None else joints, faults=faults, horizon=horizon)
        self._physics = PhysicsInterceptor(self.injector)
        self._arm, self._goal, self._reveal = arm, goal, reveal
        self._tolerance, self._within = tolerance, within
        self._observes, self._entries_given, self._episode = dict(observes or {}), observes is not None, -1
        self._qpos_rows = model.jnt_qposadr[[model.joint(name).id for name in self.injector.joints]]
        self._recorder = None if record is None else EpisodeRecorder(record)
        self._seed: int | None = None
        self._prepare_episode()

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Restore the model, reset the environment with ``seed`` and ``options``, and sample the faults of the next episode."""
        self._finish_episode("left")
        self._seed = seed
        remaining_options = dict(options or {})
        self._episode = int(remaining_options.pop("episode", self._episode + 1))
        self.injector.restore()
        observation, info = self.env.reset(seed=seed, options=remaining_options or None)
        model, data = _find_model(self.env.unwrapped)
        if model is not self.injector.model:  # some environments reload their model
            old = self.injector
            self.injector = FaultInjector(model, data, old.joints, faults=old.faults, horizon=old.horizon)
            self._physics = PhysicsInterceptor(self.injector)
        self.injector.reset(self._episode)
        self._prepare_episode()
        if self._has_sensor_faults:
            self._locate_entries(observation)
        return self._corrupt_observation(observation), {**info, "fault": self.fault} if self._reveal else info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Step the environment by an ``action``, with the faults that have begun."""
        injector = self.injector
        injector.advance(injector.data.time)
        if self._has_dropouts:
            action = self._hold_dropped_commands(action)
        time_before, call_count = injector.data.time, self._physics.call_count
        with self._physics.intercept():
            observation, reward, terminated, truncated, info = self.env.step(action)
        if self._physics.call_count == call_count and injector.data.time != time_before and injector.changes_model:
            raise InputError(
                f"{type(self.env.unwrapped).__name__} does not move its model with mujoco.mj_step, so its faults do not act; "
                "write the loop with holdfast.response.faults.FaultInjector"
            )
        if self._has_sensor_faults:
            injector.time = injector.data.time
            observation = self._corrupt_observation(observation)
        if self._reveal:
            info["fault"] = self.fault
        if self._recorder is not None:
            self._record_step(action, reward)
            self._success: bool | None = next((bool(info[key]) for key in ("is_success", "success") if key in info), None)
            if terminated or truncated:
                self._finish_episode("terminated" if terminated else "truncated")
        return observation, reward, terminated, truncated, info

    def close(self) -> None:
        """Write the file of the last episode, and close the environment."""
        self._finish_episode("left")
        self.env.close()

    # ---- internal ----------------------------------------------------------------------------------------------------

    def _record_step(self, action: Any, reward: Any) -> None:
        """Record this step as the log of a robot would."""
        assert self._recorder is not None
        injector, model, data = self.injector, self.injector.model, self.injector.data
        reference = np.full(len(injector.joints), np.nan)
        gains, stiffness = model.actuator_gainprm[:, 0], -model.actuator_biasprm[:, 1]
        for index, name in enumerate(injector.joints):
            for actuator in injector.actuators_of(name):
                if stiffness[actuator] > 0 and model.actuator_gear[actuator, 0] == 1:  # a position servo
                    reference[index] = data.ctrl[actuator] * gains[actuator] / stiffness[actuator]
        injector.time = data.time
        q, torque = injector.read_sensors(data.qpos[self._qpos_rows]), data.qfrc_actuator[injector.dofs]
        self._recorder.record_step(data.time, reference, q, torque, action, reward)

    def _finish_episode(self, outcome: str) -> None:
        if self._recorder is None:
            return
        events, feasibility = self.injector.events, self._evaluate_feasibility().answer
        self._recorder.finish_episode(
            seed=self._seed, episode=self._episode, events=events, feasible=feasibility, outcome=outcome, success=self._success
        )

    def _prepare_episode(self) -> None:
        """Prepare the state of a new episode."""
        kinds = [find_kind(event.kind) for event in self.injector.events]
        self._has_sensor_faults = any(kind.is_sensor for kind in kinds)
        self._has_dropouts = any(kind.drops_commands for kind in kinds)
        self._last_action: FloatArray | None = None
        self._success = None
        self._feasibility: Feasibility | None = None
        self.fault: FaultInfo = FaultInfo(self.injector, self._evaluate_feasibility)
        if self._has_dropouts and self.env.action_space.shape != (self.injector.model.nu,):
            raise InputError("a dropout needs actions that are the actuators' controls; this environment has other actions")

    def _evaluate_feasibility(self) -> Feasibility:
        if self._feasibility is not None:
            return self._feasibility
        if self._arm is None or self._goal is None:
            return Feasibility("unknown", "no arm or no goal is given")
        if not self.injector.applied:
            return Feasibility("unknown", "no fault has begun")
        unknown_joint = next((event.joint for event in self.injector.places if event.joint not in self._arm.joint_names), None)
        if unknown_joint is not None:
            return Feasibility("unknown", f"'{unknown_joint}' is not a joint of the arm")
        goal, places = self._goal(self.env), self.injector.places
        self._feasibility = feasible(self._arm, goal, places, within=self._within, tolerance=self._tolerance)
        return self._feasibility

    def _hold_dropped_commands(self, action: Any) -> Any:
        """Return the action in which joints without commands keep their last one."""
        last_action = action if self._last_action is None else self._last_action
        held_action = np.array(action)
        for event in self.injector.active:
            if find_kind(event.kind).drops_commands:
                actuators = self.injector.actuators_of(event.joint)
                held_action[actuators] = last_action[actuators]
        self._last_action = held_action
        return held_action

    def _corrupt_observation(self, observation: Any) -> Any:
        """Return the observation with the readings of the failed sensors."""
        if not self._has_sensor_faults or not any(find_kind(event.kind).is_sensor for event in self.injector.active):
            return observation
        true_q = self.injector.data.qpos[self._qpos_rows]
        reading_errors = self.injector.read_sensors(true_q) - true_q
        observations = observation if isinstance(observation, dict) else {"observation": observation}
        corrupted = np.array(observations["observation"])
        for event in self.injector.active:
            if find_kind(event.kind).is_sensor:
                entries = list(self._observes.get(event.joint, ()))
                corrupted[entries] += reading_errors[self.injector.joints.index(event.joint)]
        return {**observations, "observation": corrupted} if isinstance(observation, dict) else corrupted

    def _locate_entries(self, observation: Any) -> None:
        """Find the entries of the joints whose sensors will fail, once."""
        failing = [event.joint for event in self.injector.events if find_kind(event.kind).is_sensor]
        joints = [joint for joint in failing if joint not in self._observes]
        if self._entries_given or not joints:
            return
        get_observation = getattr(self.env.unwrapped, "_get_obs", None)
        if get_observation is None:
            raise InputError(
                "the environment has no _get_obs, so the entries of the joints' values cannot be found; give observes"
            )
        model, data, state_kind = self.injector.model, self.injector.data, self._mujoco.mjtState.mjSTATE_INTEGRATION
        state = np.zeros(self._mujoco.mj_stateSize(model, state_kind))
        self._mujoco.mj_getState(model, data, state, state_kind)
        before = _to_vector(get_observation())
        if before.shape != _to_vector(observation).shape or not np.allclose(before, _to_vector(observation), atol=1e-4):
            raise InputError("another wrapper changes the observation; put it around this one, or give observes")
        for joint in joints:
            data.qpos[self._qpos_rows[self.injector.joints.index(joint)]] += _PROBE_STEP
            self._mujoco.mj_forward(model, data)
            changes = _to_vector(get_observation()) - before
            entries = np.flatnonzero(np.abs(changes - _PROBE_STEP) < 1e-5)
            self._mujoco.mj_setState(model, data, state, state_kind)
            if not entries.size:
                raise InputError(f"no entry of the observation is the value of '{joint}'; give observes, or another fault")
            self._observes[joint] = entries.tolist()
        self._mujoco.mj_forward(model, data)


def _to_vector(observation: Any) -> FloatArray:
    return np.asarray(observation["observation"] if isinstance(observation, dict) else observation, dtype=np.float64)


def _find_model(env: Any) -> tuple[Any, Any]:
    """Return the MuJoCo model and data of an environment."""
    mujoco = import_mujoco()
    for attribute_paths in _MODEL_ATTRIBUTES:
        objects = []
        for attribute_path in attribute_paths:
            value = env
            for name in attribute_path.split("."):
                value = getattr(value, name, None)
            objects.append(value)
        if isinstance(objects[0], mujoco.MjModel) and isinstance(objects[1], mujoco.MjData):
            return objects[0], objects[1]
    raise InputError(f"{type(env).__name__} has no MuJoCo model; faults are for environments with MuJoCo")
