"""An environment that reads everything it can from its model and data sees no fault in them."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from holdfast.core.errors import InputError
from holdfast.response.faults import FaultEvent, FaultInjector, FaultWrapper

gymnasium = pytest.importorskip("gymnasium")
mujoco = pytest.importorskip("mujoco")

ARM = """
<mujoco><option timestep="0.002"/>
<worldbody><body><joint name="a" axis="0 1 0" damping="0.1" range="-150 150"/>
<geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0"/>
<body pos="0.4 0 0"><joint name="b" axis="0 1 0" damping="0.2"/><geom type="capsule" size="0.03" fromto="0 0 0 0.3 0 0"/>
<body pos="0.3 0 0"><joint name="c" axis="0 0 1" damping="0.1" range="-100 100"/><geom type="sphere" pos="0.1 0 0" size="0.03"/>
</body></body></body></worldbody>
<actuator><position joint="a" kp="80" kv="8" ctrlrange="-2 2" forcerange="-60 60"/>
<position joint="b" kp="60" kv="6" ctrlrange="-1.5 1.5" forcerange="-40 40"/>
<position joint="c" kp="20" kv="2" ctrlrange="-1.5 1.5" forcerange="-20 20"/></actuator></mujoco>
"""
FAULTS = {
    "locked": {},
    "slipping_clutch": {},
    "limp": {},
    "weak": {"gain": 0.3},
    "friction": {"coulomb": 2.0, "viscous": 0.5},
    "reduced_range": {"travel": 0.05},
    "reduced_speed": {"velocity": 0.5},
    "sensor_bias": {"bias": 0.1},
    "sensor_drift": {"rate": 0.1},
    "sensor_freeze": {},
    "sensor_noise": {"deviation": 0.01},
    "command_dropout": {},
}
# Fields of MjData with the forces of a lock, its constraint's rows, the accelerations that follow, and the solver's own work.
LOCK_FORCES = (
    "qacc",
    "qfrc_constraint",
    "qfrc_smooth",
    "qfrc_passive",
    "qfrc_damper",
    "efc_",
    "solver",
    "cacc",
    "cfrc",
    "iacc",
)
LOCK_FORCES += (
    "ifrc_",
    "iefc_",
    "island",
    "nisland",
    "tree_island",
    "map_",
    "dof_island",
    "timer",
    "maxuse_",
    "parena",
    "nJ",
    "nefc",
    "nl",
    "nidof",
    "qH",
)


def array_fields(thing):
    """Every array that an MjModel or MjData shows, with those of its options."""
    parts = {"": thing} | {f"{part}.": getattr(thing, part) for part in ("opt", "stat", "vis") if hasattr(thing, part)}
    found = {}
    for prefix, part in parts.items():
        for name in dir(part):
            value = None if name.startswith("_") else getattr(part, name)
            if isinstance(value, (np.ndarray, float, int)):
                found[prefix + name] = np.array(value).tobytes()
    return found


class CuriousEnv(gymnasium.Env):
    """Clips its targets to every range that the model shows, and notes every field of the model between its steps."""

    def __init__(self, step=None):
        self.model = mujoco.MjModel.from_xml_string(ARM)
        self.data = mujoco.MjData(self.model)
        self.healthy, self.twin = mujoco.MjModel.from_xml_string(ARM), mujoco.MjData(self.model)
        self.fields, self.targets, self.differences = array_fields(self.model), [], set()
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (6,), np.float64)
        self.action_space = gymnasium.spaces.Box(-np.pi, np.pi, (3,), np.float64)
        self._step = step

    def reset(self, *, seed=None, options=None):
        mujoco.mj_resetData(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)
        self.targets = []
        return self._get_obs(), {}

    def step(self, action):
        self.look()
        model, target = self.model, np.clip(action, *self.model.actuator_ctrlrange.T)
        low, high = model.jnt_range.T
        target = np.where(model.jnt_limited, np.minimum(np.maximum(target, low), high), target)
        self.targets.append(target)
        self.data.ctrl[:] = target
        for _ in range(3):
            (self._step or mujoco.mj_step)(model, self.data)
            self.look()
        mujoco.mj_step1(model, d=self.data)
        self.look()
        mujoco.mj_step2(model, self.data)
        return self._get_obs(), 0.0, False, False, {}

    def look(self):
        fields = array_fields(self.model)
        self.differences |= {name for name in fields if fields[name] != self.fields[name]}

    def compare_data(self):
        """Fields of the data that differ from those of a twin without a fault in the same state."""
        kind = mujoco.mjtState.mjSTATE_INTEGRATION
        state = np.zeros(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, self.data, state, kind)
        mujoco.mj_setState(self.healthy, self.twin, state, kind)
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_forward(self.healthy, self.twin)
        mine, other = array_fields(self.data), array_fields(self.twin)
        return {name for name in mine if mine[name] != other[name] and not name.startswith(LOCK_FORCES)}

    def _get_obs(self):
        self.look()
        return np.r_[self.data.qpos, self.data.qvel]


def actions(steps):
    return np.random.default_rng(5).uniform(-1.5, 1.5, (steps, 3)) * np.linspace(0, 1, steps)[:, None]


@pytest.mark.parametrize("kind", FAULTS)
def test_no_field_of_the_model_shows_a_fault(kind):
    runs = {}
    for name, events in (("faulty", [FaultEvent(kind, "b", 0.05, parameters=FAULTS[kind])]), ("twin", [])):
        env = CuriousEnv()
        wrapped = FaultWrapper(env, events, joints=["a", "b", "c"])
        wrapped.reset(seed=1)
        runs[name] = [wrapped.step(action)[0] for action in actions(40)]
        assert env.differences == set()
        runs[name + " targets"] = np.array(env.targets)
    if kind != "command_dropout":  # the wrapper holds the action itself
        assert (runs["faulty targets"] == runs["twin targets"]).all()
    assert (np.array(runs["faulty"]) != np.array(runs["twin"])).any()


def test_a_lock_holds_and_its_data_show_its_forces_alone():
    env = CuriousEnv()
    wrapped = FaultWrapper(env, [FaultEvent("locked", "b", 0.05)], joints=["a", "b", "c"])
    wrapped.reset(seed=1)
    places, shown = [], set()
    look = env._get_obs
    env._get_obs = lambda: (shown.update(env.compare_data()), places.append(env.data.qpos[1]), look())[-1]
    for action in actions(100):
        wrapped.step(action)
    assert np.ptp(places[10:]) < 1e-5
    assert shown == set()


def test_changes_by_the_environment_are_kept():
    env = CuriousEnv()
    wrapped = FaultWrapper(env, [FaultEvent("friction", "b", 0.0, parameters={"viscous": 0.5})], joints=["a", "b", "c"])
    wrapped.reset()
    wrapped.step(np.zeros(3))
    env.model.dof_damping[1] = 3.0
    env.fields = array_fields(env.model)
    wrapped.step(np.ones(3))
    assert env.differences == set()
    mujoco.mj_forward(env.model, env.data)
    assert env.data.qfrc_damper[1] == pytest.approx(-3.0 * env.data.qvel[1])


def test_the_package_is_itself_between_steps_and_imported_names_count(monkeypatch):
    function, namespace = mujoco.mj_step, globals()
    monkeypatch.setitem(namespace, "imported_step", mujoco.mj_step)
    env = CuriousEnv(step=lambda *both: namespace["imported_step"](*both))
    wrapped = FaultWrapper(env, [FaultEvent("locked", "b", 0.0)], joints=["a", "b", "c"])
    wrapped.reset()
    for _ in range(20):
        wrapped.step(np.ones(3))
    assert abs(env.data.qpos[1]) < 1e-5
    assert mujoco.mj_step is namespace["imported_step"] is function


def test_an_environment_that_steps_by_other_means_is_refused():
    class PrivateEnv(CuriousEnv):
        def step(self, action):
            self._step(self.model, self.data)
            return self._get_obs(), 0.0, False, False, {}

    for events, refused in (([FaultEvent("limp", "b", 0.0)], True), ([], False)):
        wrapped = FaultWrapper(PrivateEnv(step=partial(mujoco.mj_step, nstep=2)), events, joints=["a", "b", "c"])
        wrapped.reset()
        if refused:
            with pytest.raises(InputError, match=r"PrivateEnv does not move its model with mujoco\.mj_step"):
                wrapped.step(np.zeros(3))
        else:
            wrapped.step(np.zeros(3))


def test_in_a_loop_the_controller_reads_a_healthy_model_after_each_step():
    model = mujoco.MjModel.from_xml_string(ARM)
    data, healthy, seen = mujoco.MjData(model), array_fields(model), set()
    events = [FaultEvent(kind, joint, 0.01, parameters=FAULTS[kind]) for kind in FAULTS for joint in "abc"]
    injector = FaultInjector(model, data, ["a", "b", "c"], faults=events)
    for k in range(50):
        data.ctrl[:] = 0.1
        if k == 25:
            injector.brake("b")
        injector.before_step(data.time)
        during = array_fields(model)
        mujoco.mj_step(model, data)
        injector.restore()
        fields = array_fields(model)
        seen |= {name for name in fields if fields[name] != healthy[name]}
    assert seen == set()
    assert during != healthy
