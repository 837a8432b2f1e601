"""Many arms with faults at once, beside one arm at a time written down in NumPy."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.response.faults import FaultEvent, FaultEvents, FaultModel, FaultVectorEnv

gymnasium = pytest.importorskip("gymnasium")
pytestmark = pytest.mark.interpreted

EVENTS = [
    None,
    FaultEvent("locked", "joint2", 0.105),
    FaultEvent("locked", "joint1", 0.0, end=0.4),
    FaultEvent("reduced_speed", "joint2", 0.2, parameters={"velocity": 0.1}),
    FaultEvent("reduced_range", "joint3", 0.1, parameters={"travel": -0.05}),
    FaultEvent("reduced_range", "joint1", 0.1, parameters={"lower": -0.1, "upper": 0.9}),
    FaultEvent("sensor_bias", "joint1", 0.2, parameters={"bias": 0.2}),
    FaultEvent("sensor_drift", "joint2", 0.1, end=0.6, parameters={"rate": 0.3}),
    FaultEvent("sensor_freeze", "joint3", 0.3),
    FaultEvent("command_dropout", "joint1", 0.25),
    FaultEvent("slipping_clutch", "joint2", 0.15),
]
START, PERIOD = np.array([0.4, 0.7, 0.5]), 0.05


class Given:
    """A fault model whose episodes are those above."""

    seed = 0

    def draw(self, joints, *, episode, horizon):
        event = EVENTS[episode % len(EVENTS)]
        return FaultEvents([] if event is None else [event])


@pytest.fixture(scope="module")
def law():
    arm = hf.arms.load("planar-3r").with_limits([-2.5] * 3, [2.5] * 3)
    return hf.control.damped(arm, 0.1, task="planar", gain=1.5, speed_limit=1.0)


def goals(generator, count):
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :2, 3] = [0.6, 1.8]
    return poses


def one_arm(law, event, actions):
    """(steps + 1, n) true and told, step by step."""
    arm, most = law.arm, np.array([j.velocity if np.isfinite(j.velocity) else 2 * np.pi for j in law.arm.joints])
    i = None if event is None else arm.joint_index(event.joint)
    q, command, rows, place, shown = START.copy(), np.zeros(3), [], None, None
    told, low, high = q.copy(), arm.lower.copy(), arm.upper.copy()
    for k in range(len(actions) + 1):
        time = k * PERIOD
        on = event is not None and event.onset <= time + 1e-9 < event.end
        if on and place is None:
            place = shown = q[i]
        told = q.copy()
        if on:
            told[i] += event.parameters.get("bias", 0.0) + event.parameters.get("rate", 0.0) * (time - event.onset)
            told[i] = {"sensor_freeze": place, "slipping_clutch": shown}.get(event.kind, told[i])
        rows.append((q.copy(), told.copy()))
        if k == len(actions):
            return np.array(rows)
        error = np.array([0.6, 1.8]) - arm.forward_kinematics(told)[:2, 3]
        v = 1.5 * error / max(1.0, 1.5 * np.linalg.norm(error) / 1.0)
        rates = np.clip(law.velocity(told, v) + actions[k] * most, -most, most)
        if on and event.kind == "command_dropout":
            rates[i] = command[i]
        command, real = rates, rates.copy()
        lo, hi = low.copy(), high.copy()
        if on:
            p = event.parameters
            if event.kind in ("locked", "slipping_clutch"):
                real[i] = 0.0
            if event.kind == "reduced_speed":
                real[i] = np.clip(real[i], -p["velocity"], p["velocity"])
            if "travel" in p:
                lo[i] = place + p["travel"]
            if "lower" in p:
                lo[i], hi[i] = min(p["lower"], place), max(p["upper"], place)
            if event.kind == "slipping_clutch":
                shown += PERIOD * command[i]
        q = np.clip(q + PERIOD * real, lo, hi)
    raise AssertionError


def made(law, count, faults=None, **options):
    options |= {"period": PERIOD, "goals": goals, "start": START, "tolerance": (0.0, 0.0)}
    return FaultVectorEnv(law, count, faults or Given(), **options)


def test_each_arm_moves_as_one_alone_written_down(law, rng):
    env, steps = made(law, len(EVENTS)), 20
    actions = rng.uniform(-0.1, 0.1, (steps, len(EVENTS), 3))
    observation, info = env.reset(seed=1)
    seen, true = [observation], [env.q.copy()]
    for k in range(steps):
        observation, reward, *_, info = env.step(actions[k])
        seen.append(observation)
        true.append(env.q.copy())
    for row, event in enumerate(EVENTS):
        expected = one_arm(law, event, actions[:, row])
        assert np.array(true)[:, row] == pytest.approx(expected[:, 0], abs=1e-9), event
        assert np.array(seen)[:, row, :3] == pytest.approx(expected[:, 1], abs=1e-9), event
    off = np.linalg.norm([0.6, 1.8] - law.arm.forward_kinematics(env.q)[:, :2, 3], axis=1)
    assert reward == pytest.approx(-off, abs=1e-9)
    told = [0.6, 1.8] - law.arm.forward_kinematics(observation[:, :3])[:, :2, 3]
    assert observation[:, 3:5] == pytest.approx(told, abs=1e-9)
    assert info["fault"]["active"].any(axis=1).tolist() == [
        event is not None and event.onset <= 1.0 < event.end for event in EVENTS
    ]


def test_noise_has_the_deviation_of_its_entry(law):
    env = made(law, 300, FaultModel([hf.faults.sensor_noise("joint2", deviation=0.1, onset=0.0)]))
    env.reset(seed=4)
    observation = env.step(np.zeros((300, 3)))[0]
    wrong = observation[:, :3] - env.q
    assert np.std(wrong[:, 1]) == pytest.approx(0.1, rel=0.25)
    assert not wrong[:, [0, 2]].any()


def test_many_are_as_one_after_the_other_and_begin_anew(law, rng):
    """Row i has the episodes i, i + N, ...: the same as an environment of one arm that is reset as often."""
    faults = FaultModel(
        [hf.faults.locked(onset=(0.0, 0.3)), hf.faults.sensor_bias(bias=0.1, onset=0.1, probability=0.5)], seed=5
    )
    many, steps = made(law, 3, faults, horizon=0.4), 19
    actions = rng.uniform(-1, 1, (steps, 3, 3))
    rows, ends, ids = [many.reset(seed=0)[0]], [], []
    for k in range(steps):
        observation, _, terminated, truncated, info = many.step(actions[k])
        rows.append(observation)
        ends.append(truncated.copy())
        ids.append(info["fault"]["id"])
        assert not terminated.any()
    assert np.array(ends).all(axis=1).nonzero()[0].tolist() == [7, 16]  # eight steps, and one that begins anew
    for row in range(3):
        for turn in range(2):
            episode = row + 3 * turn
            assert ids[9 * turn][row] == faults.draw(law.arm, episode=episode, horizon=0.4).id
            single = made(law, 1, FaultModel(faults.entries, faults.seed), horizon=0.4)
            single._episode_numbers[:] = episode - 1
            alone = [single.reset()[0][0]]
            alone += [single.step(actions[9 * turn + k, row : row + 1])[0][0] for k in range(8)]
            assert np.array(rows)[9 * turn : 9 * turn + 9, row] == pytest.approx(np.array(alone), abs=1e-12)


def test_it_is_an_environment_of_gymnasium(law):
    from gymnasium.wrappers.vector import RecordEpisodeStatistics

    env = RecordEpisodeStatistics(FaultVectorEnv(law, 4, period=PERIOD, horizon=20.0, goals=goals, start=START, reveal=False))
    observation, info = env.reset(seed=3)
    assert env.observation_space.contains(observation)
    assert info == {}
    done = np.zeros(4, dtype=bool)
    for _ in range(200):
        observation, _, terminated, _, info = env.step(np.zeros((4, 3)))
        done |= terminated
    assert done.all()  # the law alone reaches the target
    assert env.observation_space.contains(observation)


def test_bad_input(law):
    with pytest.raises(InputError, match=r"use holdfast\.simulate_faults"):
        FaultVectorEnv(law, 2, FaultModel([hf.faults.limp(onset=0.1)])).reset(seed=0)
    with pytest.raises(InputError, match="give at least one arm"):
        FaultVectorEnv(law, 0)
    env = made(law, 2)
    env.reset(seed=0)
    with pytest.raises(InputError, match="a row for each arm"):
        env.step(np.zeros(3))


@pytest.mark.parametrize("framework", ["torch", "jax"])
def test_arrays_are_shared_with_a_framework_both_ways(framework, law):
    pytest.importorskip(framework, reason=f"{framework} is not installed: CONTRIBUTING has the command that runs this test")
    env = made(law, 8)
    observation, _ = env.reset(seed=1)
    there, pointer = shared(framework, observation)
    assert pointer == observation.ctypes.data or (framework == "jax" and observation.ctypes.data % 64)  # JAX then copies it
    twin = made(law, 8)
    twin.reset(seed=1)
    for action in (0.1 * there[:, :3], 0.1 * there[:, 3:6]):
        for a, b in zip(env.step(action)[:4], twin.step(np.asarray(action))[:4], strict=True):
            np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(there, observation)  # later steps have arrays of their own


def shared(framework, array):
    """An array of PyTorch or JAX that shares one with a ``__dlpack__``, and where it is."""
    if framework == "torch":
        import torch

        there = torch.from_dlpack(array)
        return there, there.data_ptr()
    import jax

    jax.config.update("jax_enable_x64", True)
    there = jax.dlpack.from_dlpack(array)
    return there, there.unsafe_buffer_pointer()
