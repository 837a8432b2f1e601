"""Faults in environments of Gymnasium, and whether a goal is feasible with them."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.faults import FaultEvent, FaultWrapper, feasible

gymnasium = pytest.importorskip("gymnasium")


@pytest.fixture
def reacher():
    env = gymnasium.make("Reacher-v5")
    yield env
    env.close()


def driven(env, steps, seed=3, **options):
    observations = [env.reset(seed=seed, options=options or None)[0]]
    actions = np.random.default_rng(seed).uniform(-1, 1, (steps, 2)).astype(np.float32)
    return np.array(observations + [env.step(action)[0] for action in actions])


def test_an_episode_again_is_the_same_bits_and_without_faults_that_of_the_environment(reacher):
    plain = driven(reacher, 20)
    faults = hf.faults.FaultModel([hf.faults.locked(["joint0", "joint1"], onset=(0.05, 0.2), probability=0.7)], seed=2)
    env = FaultWrapper(reacher, faults)
    runs = [driven(env, 20, episode=k) for k in (0, 1, 2, 0)]
    assert runs[0].tobytes() == runs[3].tobytes()
    for k, run in enumerate(runs[:3]):
        happened = bool(faults.draw(["root", "joint0", "joint1"], episode=k))
        assert (run.tobytes() == plain.tobytes()) != happened


def test_a_locked_joint_and_what_is_told(reacher):
    env = FaultWrapper(reacher, [FaultEvent("locked", "joint1", 0.105)])
    driven(env, 5)
    assert env.fault["active"] == []
    data, places = env.unwrapped.data, []
    for _ in range(100):
        _, _, _, _, info = env.step(np.ones(2, dtype=np.float32))
        places.append(data.qpos[1])
    told = info["fault"]
    assert told["active"] == ["joint1: locked"]
    assert told["events"][0]["applied"] == pytest.approx(0.12)  # steps of 20 ms
    assert (told["feasible"], len(told)) == ("unknown", 5)
    assert np.ptp(places[10:]) < 3.3e-3
    assert "fault" not in FaultWrapper(reacher, [], reveal=False).reset()[1]


def test_a_sensor_fault_changes_only_its_entries(reacher):
    env = reacher.unwrapped
    env._get_obs = lambda: np.r_[env.data.qpos[:2], env.data.qvel[:2], np.cos(env.data.qpos[:2])]
    wrapped = FaultWrapper(env, [FaultEvent("sensor_bias", "joint1", 0.0, parameters={"bias": 0.25})])
    driven(wrapped, 3)
    seen, true = wrapped.step(np.zeros(2, dtype=np.float32))[0], env._get_obs()
    assert seen - true == pytest.approx([0, 0.25, 0, 0, 0, 0], abs=1e-12)


def test_any_joint_is_one_that_is_driven_and_a_sensor_is_one_that_is_seen(reacher):
    """Reacher's target slides are no joints of the arm, its observation shows sines; a walker's place in space is no joint."""
    assert FaultWrapper(reacher, []).injector.joints == ("joint0", "joint1")
    hopper = gymnasium.make("Hopper-v5")
    assert FaultWrapper(hopper, []).injector.joints == ("thigh_joint", "leg_joint", "foot_joint")
    hopper.close()
    event = FaultEvent("sensor_bias", "joint1", 0.0, parameters={"bias": 0.25})
    with pytest.raises(InputError, match="no entry of the observation is the value of 'joint1'"):
        FaultWrapper(reacher, [event]).reset(seed=1)
    FaultWrapper(reacher, [event], observes={"joint1": ()}).reset(seed=1)
    flat = gymnasium.wrappers.TransformObservation(reacher, lambda seen: 2 * seen, None)
    with pytest.raises(InputError, match="another wrapper changes the observation"):
        FaultWrapper(flat, [event]).reset(seed=1)
    with pytest.raises(InputError, match=r"the faults are 'faults.yaml'; read a file with"):
        FaultWrapper(reacher, "faults.yaml")


def test_a_dropout_holds_the_action(reacher):
    env = FaultWrapper(reacher, [FaultEvent("command_dropout", "joint0", 0.02)])
    env.reset(seed=1)
    for action in ([0.5, 0.1], [0.2, 0.3], [-0.9, 0.4]):
        env.step(np.array(action, dtype=np.float32))
    assert env.unwrapped.data.ctrl == pytest.approx([0.5, 0.4])


def test_what_has_no_model_is_refused():
    with pytest.raises(InputError, match="has no MuJoCo model"):
        FaultWrapper(gymnasium.make("CartPole-v1"), [])


def test_feasibility_against_the_closed_form_of_a_planar_arm(three, rng):
    arm = three.arm  # three links of length 1
    seen = set()
    for _ in range(30):
        angle, goal = rng.uniform(-3, 3), np.r_[rng.uniform(-2, 2, 2), 0.0]
        found = feasible(arm, goal, {FaultEvent("locked", arm.joint_names[2], 0.0): angle}, restarts=20)
        outer = np.hypot(1 + np.cos(angle), np.sin(angle))  # the last two links are one
        want = abs(1 - outer) <= np.linalg.norm(goal) <= 1 + outer
        assert (found.answer == "yes") == want
        if want:
            assert arm.forward_kinematics(found.q)[:3, 3] == pytest.approx(goal, abs=1e-5)
            assert found.q[2] == angle
        seen.add(want)
    assert seen == {True, False}


def test_a_weak_motor_must_carry_the_arm():
    panda = hf.arms.load("panda")
    goal = panda.forward_kinematics([0, 0.6, 0, -1.8, 0, 2.4, 0.8])[:3, 3]
    event = FaultEvent("weak", "panda_joint2", 0.0, parameters={"gain": 0.9})
    found = feasible(panda, goal, {event: 0.6})
    assert found.answer == "yes"
    assert abs(panda.gravity_torque(found.q)[1]) <= 0.9 * panda.joints[1].effort
    none = feasible(panda, goal, {FaultEvent("weak", "panda_joint2", 0.0, parameters={"gain": 1e-6}): 0.6})
    assert none.answer == "not found"
    assert "gravity exceeds the torque" in none.why
    assert feasible(panda, goal, {FaultEvent("limp", "panda_joint4", 0.0): -1.8}).answer == "yes"  # its brake holds it
    # A stop gives way: a joint 5 mrad beyond it is at it, and one 50 mrad beyond is an error.
    limp = FaultEvent("limp", "panda_joint7", 0.0)
    beyond = feasible(panda, goal, {limp: panda.upper[6] + 0.005})
    assert beyond.q[6] == panda.upper[6]
    with pytest.raises(InputError, match="its limits are"):
        feasible(panda, goal, {limp: panda.upper[6] + 0.05})


def test_a_reduced_range_is_feasible_where_the_elbow_angle_of_the_goal_is_within_it():
    """Two links of 1 m reach a distance d with an elbow of acos(d^2 / 2 - 1), to either side."""
    arm = hf.arms.load("planar-2r").with_limits([-3.1, -3.1], [3.1, 3.1])
    event = FaultEvent("reduced_range", arm.joint_names[1], 0.0, parameters={"lower": 0.3, "upper": 1.0})
    for elbow, answer in ((0.7, "yes"), (1.5, "not found"), (0.1, "not found")):
        goal = arm.forward_kinematics([0.4, elbow])[:3, 3]
        found = feasible(arm, goal, {event: 0.6}, task="planar")
        assert found.answer == answer, found
        if answer == "yes":
            assert found.q[1] == pytest.approx(elbow, abs=1e-5)
    lock = FaultEvent("locked", arm.joint_names[1], 0.0)
    goal = arm.forward_kinematics([0.4, 0.7])[:3, 3]
    found = [feasible(arm, goal, {lock: place}, task="planar", at=[0.0, place]) for place in (0.7, 1.2)]
    assert [one.answer for one in found] == ["yes", "no"]
    assert "proved" in found[1].why
    both = {lock: 0.7, FaultEvent("reduced_range", arm.joint_names[0], 0.0, parameters={"lower": 0.0, "upper": 1.0}): 0.2}
    assert feasible(arm, goal, both, task="planar").answer == "unknown"
    assert feasible(arm, goal, both, task="planar", at=[0.2, 0.7]).answer == "yes"


def test_episodes_are_recorded_and_read_back(reacher, tmp_path):
    faults = hf.faults.FaultModel([hf.faults.sensor_bias(["joint1"], bias=0.25, onset=0.05)], seed=2)
    wrapped = FaultWrapper(reacher, faults, joints=["joint0", "joint1"], record=tmp_path / "runs", observes={"joint1": ()})
    data, true = wrapped.unwrapped.data, []
    for episode in (3, 5):
        wrapped.reset(seed=episode, options={"episode": episode})
        for _ in range(50 if episode == 3 else 7):
            wrapped.step(np.full(2, 0.1, dtype=np.float32))
            true.append([data.time, *data.qpos[:2], *data.qfrc_actuator[:2]])
    wrapped.close()
    first, second = hf.faults.read_episodes(tmp_path / "runs")
    assert [(e.episode, e.seed, e.outcome, e.feasible) for e in (first, second)] == [
        (3, 3, "truncated", "unknown"),
        (5, 5, "left", "unknown"),
    ]
    assert first.events == faults.draw(["joint0", "joint1"], episode=3)
    assert first.id == first.events.id
    log, expected = first.log(), np.array(true[:50])
    assert log.t == pytest.approx(expected[:, 0], abs=1e-12)
    # It begins with the step after 0.05 s, and is told at the end of that.
    # It begins with the step after 0.05 s, and is told at the end of that.
    sign = np.sign(first.events[0].parameters["bias"])
    wrong = np.where(log.t[:, None] >= 0.08 - 1e-9, [0.0, 0.25 * sign], 0.0)
    assert log.q == pytest.approx(expected[:, 1:3] + wrong, abs=1e-6)
    assert log.tau == pytest.approx(expected[:, 3:], abs=1e-6)
    assert np.isnan(log.q_ref).all()  # torque motors follow no reference
    assert len(second.log().t) == 7
    with np.load(first.file) as arrays:
        assert arrays["reward"].shape == (50,)
        assert arrays["action"] == pytest.approx(0.1)
    (tmp_path / "runs" / "episodes.jsonl").write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match="line 1 of"):
        hf.faults.read_episodes(tmp_path / "runs")
    with pytest.raises(InputError, match=r"has no episodes\.jsonl"):
        hf.faults.read_episodes(tmp_path)


def test_in_an_environment_of_gymnasium_robotics():
    """A lock holds, a motor without torque gives none, and the model is itself again; skipped where that is not installed."""
    robotics = pytest.importorskip("gymnasium_robotics")
    gymnasium.register_envs(robotics)
    env = gymnasium.make("AdroitHandDoor-v1")
    joints = ["ARTz", "WRJ1", "FFJ2"]
    events = [FaultEvent("locked", "WRJ1", 0.1), FaultEvent("limp", "FFJ2", 0.1)]
    wrapped = FaultWrapper(env, events, joints=joints)
    model, data = env.unwrapped.model, env.unwrapped.data
    before = [model.jnt_range.tobytes(), model.jnt_actfrcrange.tobytes()]
    wrapped.reset(seed=1)
    wrist, finger = (model.joint(name) for name in joints[1:])
    places, rng = [], np.random.default_rng(0)
    for _ in range(60):
        wrapped.step(rng.uniform(-1, 1, env.action_space.shape).astype(np.float32))
        if wrapped.fault["active"]:
            places.append(data.qpos[wrist.qposadr[0]])
            assert data.qfrc_actuator[finger.dofadr[0]] == 0.0
    assert len(places) >= 45
    assert np.ptp(places) < 13e-3  # a lock by limits is soft against motors as strong as these
    wrapped.reset(seed=1)
    assert [model.jnt_range.tobytes(), model.jnt_actfrcrange.tobytes()] == before
    env.close()
