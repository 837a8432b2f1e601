"""The learned policy on Pusher: its network, what it can do, and how it is counted."""

from __future__ import annotations

import numpy as np
import pytest
from measurements.faults.policy import __main__ as counting
from measurements.faults.policy import network, train
from measurements.faults.policy.task import LIMIT, environment, finished, kinds
from measurements.faults.policy.teacher import Teacher
from scipy.stats import binomtest

pytest.importorskip("gymnasium")
FEW = 6


def test_slopes_are_those_of_differences(rng):
    policy = network.made(np.zeros(5), np.ones(5), width=7, outputs=3, limit=2.0, generator=rng)
    policy.layers[:] = [part.astype(np.float64) + rng.normal(0, 0.3, part.shape) for part in policy.layers]
    x, wanted = rng.normal(size=(4, 5)), rng.uniform(-1, 1, (4, 3))

    def loss():
        y = x
        for k in (0, 2, 4):
            y = y @ policy.layers[k] + policy.layers[k + 1]
            y = np.tanh(y) if k == 4 else np.maximum(y, 0)
        return 0.5 * np.square(y - wanted).sum()

    passed = policy._passed(x)
    for k, slope in policy._slopes(passed, passed[-1] - wanted):
        at = tuple(rng.integers(size) for size in policy.layers[k].shape)
        before, values = policy.layers[k][at], []
        for step in (1e-3, -1e-3):
            policy.layers[k][at] = before + step
            values.append(loss())
        policy.layers[k][at] = before
        assert slope[at] == pytest.approx((values[0] - values[1]) / 2e-3, rel=2e-2, abs=1e-3)


def test_a_network_learns_and_is_the_same_when_it_is_read(tmp_path, rng):
    policy = network.made(np.zeros(2), np.ones(2), width=32, outputs=1, limit=2.0, generator=rng)
    x = rng.uniform(-1, 1, (500, 2)).astype(np.float32)
    wanted = np.sin(3 * x[:, :1]) * x[:, 1:]
    policy.learn(x, wanted, steps=1000, batch=64, generator=rng)
    assert np.square(policy(x) - wanted).mean() < 0.1 * np.square(wanted).mean()
    policy.save(tmp_path / "a.npz")
    assert network.load(tmp_path / "a.npz")(x).tobytes() == policy(x).tobytes()


@pytest.mark.parametrize("name", counting.POLICIES)
def test_the_policies_of_the_repository_finish(name):
    file = counting.HERE / f"{name}.npz"
    assert file.stat().st_size < 1e6
    policy, env = network.load(file), environment(None, 0)
    assert sum(finished(env, policy, seed=k, episode=k) for k in range(FEW)) >= FEW - 2
    still = environment(None, 0)
    assert not any(finished(still, lambda observation: np.zeros(7), seed=k, episode=k) for k in range(2))


def test_who_knows_of_a_weak_motor_asks_it_for_more():
    env = environment(kinds()["weak"], 3)
    asked = []
    for knows in (False, True):
        env.reset(seed=1, options={"episode": 0})
        teacher = Teacher(env, knows=knows)
        for _ in range(70):  # to 3.5 s, when it is weak
            env.step(np.zeros(7, dtype=np.float32))
        asked.append(teacher())
    (event,) = env.injector.active
    weak = env.injector.joints.index(event.joint)
    assert asked[1][weak] == pytest.approx(np.clip(asked[0][weak] / event.parameters["gain"], -LIMIT, LIMIT))
    assert np.delete(asked[1], weak) == pytest.approx(np.delete(asked[0], weak))


def test_who_counts_does_not_take_a_fault_of_before_for_the_arm():
    env = environment(kinds()["reduced_range"], 3)
    healthy = env.unwrapped.model.jnt_range.copy()
    finished(env, lambda observation: np.zeros(7, dtype=np.float32), seed=1, episode=0)
    assert env.injector.active
    assert (env.unwrapped.model.jnt_range == healthy).all()
    teacher = Teacher(env, knows=True)
    env.reset(seed=1, options={"episode": 1})
    low, high, *_ = teacher._limits()
    assert (low == healthy[:7, 0]).all()
    assert (high == healthy[:7, 1]).all()


def test_counting_goes_on_and_tries_other_ways_where_nobody_finished(monkeypatch):
    asked = []

    def told(env, act, *, seed, episode):
        asked.append((act, episode))
        return (act, episode) in (("a", 1), ("way 1", 2))

    monkeypatch.setattr(counting, "finished", told)
    drivers = {name: lambda env, name=name: name for name in ("a", "known", "way 0", "way 1")}
    done = counting.outcomes("none", 3, drivers, {"a": [True]})
    assert done == {"a": [True, True, False], "known": [False] * 3, "way 0": [False] * 3, "way 1": [False, False, True]}
    assert [k for act, k in asked if act == "a"] == [1, 2]
    assert [k for act, k in asked if act.startswith("way")] == [2, 2]
    done |= {"healthy": done["a"], "faults": [False] * 3}
    assert counting.row("none", done)[:3] == ["none", "100.0 (29.24 to 100)", "0.0 (0 to 70.76)"]
    assert counting.row("none", done)[3].startswith("66.7 (")
    exact = binomtest(296, 300).proportion_ci(0.95, method="exact")  # its upper end is not rounded to 100
    assert counting.percent(296, 300) == f"98.7 ({100 * exact.low:.4g} to {100 * exact.high:.4g})"


def test_training_goes_on_to_the_same_weights(tmp_path, monkeypatch):
    for name, value in (("ROUNDS", 2), ("EPISODES", 1), ("FITS", 3), ("LAST", 3), ("STEPS", 5), ("WIDTH", 8)):
        monkeypatch.setattr(train, name, value)
    whole = train.train(True, 1, tmp_path / "whole")
    monkeypatch.setattr(train, "ROUNDS", 1)
    train.train(True, 1, tmp_path / "parts")
    monkeypatch.setattr(train, "ROUNDS", 2)
    parts = train.train(True, 1, tmp_path / "parts")
    assert all((a == b).all() for a, b in zip(whole.layers, parts.layers, strict=True))
    assert dict(whole.about) | {"minutes": ""} == dict(parts.about) | {"minutes": ""}
