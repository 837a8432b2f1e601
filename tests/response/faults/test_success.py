"""Success of the feasible episodes, and what a wrapper with an arm refuses or tells."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.faults import FaultEvent, FaultWrapper, feasible, success_rate

gymnasium = pytest.importorskip("gymnasium")
mujoco = pytest.importorskip("mujoco")
stats = pytest.importorskip("scipy.stats")

MODEL = """
<mujoco><worldbody><body><joint name="planar_joint1" axis="0 0 1"/><geom size="0.1"/>
<body pos="1 0 0"><joint name="planar_joint2" axis="0 0 1"/><geom size="0.1"/>
<body pos="1 0 0"><joint name="finger" type="slide" range="0 0.1"/><geom size="0.02"/></body></body></body></worldbody>
<actuator><motor joint="planar_joint1"/><motor joint="planar_joint2"/><motor joint="finger"/></actuator></mujoco>
"""


class Gripper(gymnasium.Env):
    """Two links and a finger."""

    observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (3,), np.float64)
    action_space = gymnasium.spaces.Box(-1, 1, (3,), np.float64)

    def __init__(self, names):
        text = MODEL
        for k, name in enumerate(names, start=1):
            text = text.replace(f"planar_joint{k}", name)
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def reset(self, *, seed=None, options=None):
        mujoco.mj_resetData(self.model, self.data)
        return self.data.qpos.copy(), {}

    def step(self, action):
        self.data.ctrl[:] = action
        mujoco.mj_step(self.model, self.data, nstep=5)
        return self.data.qpos.copy(), 0.0, False, False, {"is_success": self.data.time > 0.05}


@pytest.fixture
def arm():
    return hf.arms.load("planar-2r")


def test_any_joint_is_one_of_the_arm_and_a_finger_has_no_verdict(arm):
    env = Gripper(arm.joint_names)
    faults = hf.faults.FaultModel([hf.faults.locked()], seed=1)
    wrapped = FaultWrapper(env, faults, arm=arm, goal=lambda env: [1.0, 1.0, 0.0])
    assert wrapped.injector.joints == arm.joint_names
    for episode in range(10):
        wrapped.reset(options={"episode": episode})
        *_, info = wrapped.step(np.zeros(3))
        assert info["fault"]["feasible"] in ("yes", "not found")
    lock = FaultEvent("locked", "finger", 0.0)
    wrapped = FaultWrapper(env, [lock], joints=[*arm.joint_names, "finger"], arm=arm, goal=lambda env: [1.0, 1.0, 0.0])
    wrapped.reset()
    *_, info = wrapped.step(np.zeros(3))
    assert (info["fault"]["feasible"], info["fault"]["why"]) == ("unknown", "'finger' is not a joint of the arm")


def test_a_goal_that_is_tilted_out_of_the_plane_is_feasible_in_a_wide_enough_cone(arm):
    reach, tilt = float(arm.forward_kinematics(np.zeros(2))[0, 3]), np.deg2rad(20)
    goal = np.eye(4)
    goal[:2, 3] = reach * np.cos(0.3), reach * np.sin(0.3)  # with the second joint locked at 0
    goal[:3, :3] = [[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
    answers = []
    for within in (np.deg2rad(19), np.deg2rad(21)):
        lock = FaultEvent("locked", arm.joint_names[1], 0.0)
        wrapped = FaultWrapper(Gripper(arm.joint_names), [lock], arm=arm, goal=lambda env: goal, within=within, tolerance=1e-3)
        wrapped.reset()
        answers.append(wrapped.step(np.zeros(3))[-1]["fault"]["feasible"])
    assert answers == ["not found", "yes"]


def test_a_fault_of_a_later_episode_is_refused_when_the_wrapper_is_made(arm):
    env = Gripper(arm.joint_names)
    rare = hf.faults.FaultModel([hf.faults.locked("finger", probability=1e-9)])
    with pytest.raises(InputError, match="'locked' names joint 'finger'; the joints are"):
        FaultWrapper(env, rare, arm=arm)
    FaultWrapper(env, rare)
    speed = hf.faults.FaultModel([hf.faults.reduced_speed("finger", velocity=1.0, probability=1e-9)])
    with pytest.raises(InputError, match="needs the effort of its motor"):
        FaultWrapper(env, speed)


def test_a_fault_is_readable(arm):
    wrapped = FaultWrapper(Gripper(arm.joint_names), [FaultEvent("weak", "finger", 0.5, parameters={"gain": 0.25})])
    assert repr(wrapped.fault) == "FaultInfo: 1 fault in this episode\n  finger: weak from 0.5 s on (gain 0.25)"


def test_success_is_recorded_and_counted_with_the_interval_of_scipy(arm, tmp_path):
    wrapped = FaultWrapper(Gripper(arm.joint_names), [], record=tmp_path / "runs")
    for steps in (3, 8):
        wrapped.reset()
        for _ in range(steps):
            wrapped.step(np.zeros(3))
    wrapped.close()
    episodes = hf.faults.read_episodes(tmp_path / "runs")
    assert [episode.success for episode in episodes] == [False, True]
    assert success_rate(episodes).counts["unknown"] == (1, 2)
    some = [SimpleNamespace(feasible="yes", success=k < 17, file=tmp_path) for k in range(20)]
    some += [SimpleNamespace(feasible="no", success=False, file=tmp_path)] * 5
    counted = success_rate(some)
    rate, exact = counted.rate(), stats.binomtest(17, 20).proportion_ci(0.95, method="exact")
    assert (rate.value, rate.low, rate.high) == pytest.approx((0.85, exact.low, exact.high), abs=1e-9)
    assert str(counted).splitlines()[0].startswith("goal feasible: yes: 17 of 20 episodes succeeded, 85.0% (95% interval 62.1%")
    assert counted.rate("unknown") is None
    unreported = [SimpleNamespace(feasible="yes", success=None, file=tmp_path / "a.npz")]
    with pytest.raises(InputError, match=r"'a\.npz' has no success"):
        success_rate(unreported)
    assert success_rate(unreported, lambda episode: True).rate().value == 1.0


def test_a_goal_just_out_of_reach_is_feasible_within_the_tolerance(arm):
    """Links of 1 m with the second joint locked straight reach 2 m and no more."""
    lock = {FaultEvent("locked", arm.joint_names[1], 0.0): 0.0}
    goal = [2.03, 0.0, 0.0]
    for tolerance, answer in ((1e-6, "not found"), (0.02, "not found"), (0.04, "yes")):
        assert feasible(arm, goal, lock, task="planar", tolerance=tolerance).answer == answer
    found = feasible(arm, goal, lock, task="planar", tolerance=0.04, at=[0.3, 0.0])
    assert found.answer != "no"
    with pytest.raises(InputError, match="tolerance is 0; it must be above 0 and at most 1"):
        feasible(arm, goal, lock, tolerance=0.0)
