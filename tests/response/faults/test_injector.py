"""Faults in MuJoCo models: what each does to the torque, and that the model is the same bytes afterwards."""

from __future__ import annotations

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.faults import FaultEvent, FaultInjector

ARM = """
<mujoco><option timestep="0.002" gravity="0 0 -9.81"/>
<worldbody><body><joint name="a" axis="0 1 0" damping="0.1"/><geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0"/>
<body pos="0.4 0 0"><joint name="b" axis="0 1 0" range="-120 120" limited="true"/>
<geom type="capsule" size="0.03" fromto="0 0 0 0.3 0 0"/>
<body pos="0.3 0 0"><joint name="c" axis="0 0 1"/><geom type="sphere" size="0.03"/></body></body></body></worldbody>
<actuator><motor joint="a" gear="2" ctrllimited="true" ctrlrange="-30 30"/>
<position joint="b" kp="80" kv="8" forcelimited="true" forcerange="-40 40"/></actuator></mujoco>
"""
EVENTS = [
    FaultEvent("locked", "a", 0.05, end=0.2),
    FaultEvent("weak", "b", 0.1, parameters={"gain": 0.3}),
    FaultEvent("friction", "b", 0.12, parameters={"coulomb": 0.2, "viscous": 0.4}),
    FaultEvent("reduced_range", "c", 0.1, parameters={"travel": -0.2}),
    FaultEvent("reduced_speed", "a", 0.22, parameters={"velocity": 2.0}),
    FaultEvent("limp", "b", 0.3),
]


@pytest.fixture
def plant():
    model = mujoco.MjModel.from_xml_string(ARM)
    return model, mujoco.MjData(model)


def everything(model):
    """All numbers of a model, as MuJoCo stores them."""
    buffer = np.zeros(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()


def run(injector, steps, controls=(5.0, 0.4), each=None):
    model, data = injector.model, injector.data
    for _ in range(steps):
        data.ctrl[:] = controls
        injector.before_step(data.time)
        mujoco.mj_step(model, data)
        if each is not None:
            each()


def test_a_model_is_the_same_bytes_and_the_run_the_same_bits(plant):
    model, data = plant
    before = everything(model)
    injector = FaultInjector(model, data, None, faults=EVENTS)
    ends = []
    for episode in range(2):
        mujoco.mj_resetData(model, data)
        injector.reset(episode)
        assert everything(model) == before
        run(injector, 200)
        assert everything(model) != before
        ends.append(np.r_[data.qpos, data.qvel].tobytes())
    injector.restore()
    assert everything(model) == before
    assert ends[0] == ends[1]
    assert sorted(injector.applied.values()) == pytest.approx([e.onset for e in injector.events])


def test_a_lock_holds_and_keeps_the_momenta_of_the_others(plant, rng):
    model, data = plant
    data.qpos[:], data.qvel[:] = rng.uniform(-1, 1, 3), rng.uniform(-3, 3, 3)
    mujoco.mj_forward(model, data)
    mass = np.zeros((3, 3))
    mujoco.mj_fullM(model, data, mass)
    place, before = data.qpos[1], mass @ data.qvel
    injector = FaultInjector(model, data, None, faults=[FaultEvent("locked", "b", 0.0)])
    injector.before_step(0.0)
    assert data.qvel[1] == pytest.approx(0, abs=1e-12)
    assert (mass @ data.qvel)[[0, 2]] == pytest.approx(before[[0, 2]], rel=1e-12)
    creep = []
    run(injector, 500, each=lambda: creep.append(abs(data.qpos[1] - place)))
    assert max(creep) < 1e-6


@pytest.mark.parametrize("integrator", ["EULER", "RK4", "IMPLICIT", "IMPLICITFAST"])
def test_a_lock_holds_against_jolts_and_the_damping_of_others(plant, rng, integrator):
    model, data = plant
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    model.dof_damping[:] = 0.5
    injector = FaultInjector(model, data, None, faults=[FaultEvent("locked", "b", 0.1)])
    run(injector, 60, (60.0, 1.0))
    place, creep = injector.places[injector.events[0]], []
    for _ in range(100):
        run(injector, 5, rng.uniform(-30, 30, 2), lambda: creep.append(abs(data.qpos[1] - place)))
    # Limits that merely touch: 4 to 14 mrad; that overlap, without damping of its own: 0.17 mrad.
    assert max(creep) < 1e-5
    assert np.abs(data.qvel[0]) > 0.1


def test_a_lock_at_an_angle_waits_until_the_joint_passes(plant):
    model, data = plant
    model.opt.gravity[:] = 0
    data.qvel[0] = 1.0
    injector = FaultInjector(model, data, ["a"], faults=[FaultEvent("locked", "a", 0.0, parameters={"at": 0.1})])
    run(injector, 20, (0.0, 0.0))
    assert 0.02 < data.qpos[0] < 0.1
    run(injector, 300, (0.0, 0.0))
    assert data.qpos[0] == pytest.approx(0.1, abs=2e-4)


def test_torques_are_those_of_the_fault(plant):
    model, data = plant
    healthy, faulty = [], []
    for found, events in ((healthy, []), (faulty, [FaultEvent("weak", j, 0.0, parameters={"gain": 0.3}) for j in "ab"])):
        mujoco.mj_resetData(model, data)
        data.qpos[:] = 0.3
        injector = FaultInjector(model, data, None, faults=events)
        run(injector, 1)
        found.append(data.qfrc_actuator[:2].copy())
        injector.restore()
    assert faulty[0] == pytest.approx(0.3 * healthy[0], rel=1e-12)
    injector = FaultInjector(model, data, None, faults=[FaultEvent("limp", "a", 0.0), FaultEvent("limp", "b", 0.0)])
    run(injector, 5)
    assert data.qfrc_actuator.tolist() == [0, 0, 0]
    injector.restore()
    injector = FaultInjector(model, data, None, faults=[FaultEvent("weak", "a", 0.0, parameters={"ceiling": 0.1})])
    run(injector, 1, (30.0, 0.0))
    assert data.qfrc_actuator[0] == pytest.approx(6.0)  # a tenth of gear 2 times 30
    injector.restore()
    injector = FaultInjector(model, data, None, faults=[FaultEvent("reduced_speed", "a", 0.0, parameters={"velocity": 4.0})])
    data.qvel[0] = 3.0
    run(injector, 1, (30.0, 0.0))
    assert data.qfrc_actuator[0] == pytest.approx(15.0)  # driving: a quarter of 60
    data.qvel[0] = 3.0
    run(injector, 1, (-30.0, 0.0))
    assert data.qfrc_actuator[0] == pytest.approx(-60.0)  # braking: all of it


def test_a_stop_and_friction(plant):
    model, data = plant
    model.opt.gravity[:] = 0
    events = [
        FaultEvent("reduced_range", "c", 0.0, parameters={"travel": 0.05}),
        FaultEvent("friction", "a", 0.0, parameters={"coulomb": 100.0}),
    ]
    injector = FaultInjector(model, data, None, faults=events)
    injector.before_step(0.0)
    data.qvel[2] = 1.0
    run(injector, 200, (20.0, 0.0))
    assert 0.0 < data.qpos[2] < 0.06
    assert abs(data.qpos[0]) < 0.2  # 40 N m against 100: MuJoCo's dry friction creeps; without any it is 20 times as far


def test_sensors_and_commands(plant):
    model, data = plant
    events = [
        FaultEvent("sensor_bias", "a", 0.1, parameters={"bias": -0.2}),
        FaultEvent("sensor_drift", "b", 0.1, parameters={"rate": 0.5}),
        FaultEvent("sensor_freeze", "c", 0.1),
        FaultEvent("command_dropout", "a", 0.1),
    ]
    injector = FaultInjector(model, data, None, faults=events)
    run(injector, 50)
    assert injector.read_sensors(data.qpos).tolist() == data.qpos.tolist()
    frozen = data.qpos[2]
    run(injector, 1)
    run(injector, 50, (-3.0, 0.0))
    assert data.ctrl[0] == 5.0
    injector.before_step(data.time)
    assert injector.read_sensors(data.qpos) == pytest.approx(
        [data.qpos[0] - 0.2, data.qpos[1] + 0.5 * (data.time - 0.1), frozen]
    )
    injector = FaultInjector(model, data, ["c", "a"], faults=[FaultEvent("slipping_clutch", "c", 0.0)])
    injector.before_step(0.0)
    assert injector.read_sensors(data.qpos[[2, 0]], reference=[7.0, 8.0]).tolist() == [7.0, data.qpos[0]]


@pytest.mark.parametrize(
    ("event", "words"),
    [
        (FaultEvent("limp", "c", 0.0), "'limp' is a fault of a motor, and 'c' has none"),
        (FaultEvent("limp", "x", 0.0), "a fault names joint 'x'; the joints are a, b, c"),
        (FaultEvent("locked", "b", 0.0, parameters={"at": 3.0}), "'b' locks at 3, beyond its limits"),
    ],
)
def test_what_a_model_cannot_have(event, words, plant):
    with pytest.raises(InputError, match=words):
        FaultInjector(*plant, None, faults=[event])
    with pytest.raises(InputError, match="no hinge or slide 'y'"):
        FaultInjector(*plant, ["y"], faults=hf.faults.FaultModel([hf.faults.limp("y")]))
    arm = SimpleNamespace(joint_names=("c",), joints=[SimpleNamespace(name="c", lower=-0.1, upper=0.1)])
    with pytest.raises(InputError, match=r"'c' locks at 0.2, beyond its limits -0.1 and 0.1"):
        FaultInjector(*plant, arm, faults=[FaultEvent("locked", "c", 0.0, parameters={"at": 0.2})])
