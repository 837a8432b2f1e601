"""What is locked, has lost range or is slow: read, refused, and taken wherever a known lock is."""

from __future__ import annotations

import contextlib
import importlib
import inspect
import json
import pkgutil

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.model.failure_modes import Degraded

# Public callables with ``locked=`` that take no Degraded, and why.
OTHERS = {
    **dict.fromkeys(
        ("reach_claim", "ReachClaim", "out_of_reach_claim", "OutOfReachClaim"), "an interval, anywhere in which one joint locks"
    ),
    "assess": "asks of each joint alone, as if it locked: nothing is known to have failed",
    "CertificateCheck": "a result: a name",
    "StructuralZeroClaim": "an index: whichever angle it locks at",
    "Degraded": "is itself",
    "StationaryPoints": "a result, of indices",
    "is_stuck": "a matrix, not an arm: indices of its columns",
    "stuck_subspace": "a matrix, not an arm: indices of its columns",
    "RemainingWorkspace": "a result: flags",
    "RunPath": "a drawn path of a run: flags",
    **dict.fromkeys(("read_locks", "locks_at", "locks_with_values", "degraded_at"), "reads it, for all those below"),
    "simulate_physics": "gives it to simulate as it is",
}


def public() -> dict[str, object]:
    """Every public callable with ``locked=``."""
    found = {}
    packages = [m.name for m in pkgutil.walk_packages(hf.__path__, "holdfast.") if m.ispkg and m.name.count(".") <= 2]
    for module in [hf, *map(importlib.import_module, packages)]:
        for name in getattr(module, "__all__", dir(module)):
            thing = getattr(module, name, None)
            if name.startswith("_") or not callable(thing) or not getattr(thing, "__module__", "").startswith("holdfast"):
                continue
            with contextlib.suppress(ValueError):  # exceptions have no signature
                if "locked" in inspect.signature(thing).parameters:
                    found[name] = thing
    return found


@pytest.fixture(scope="module")
def three():
    arm = hf.arms.load("planar-3r")
    return arm, Degraded(arm, locked={"joint2": 0.6}), np.array([0.3, 0.6, 0.9])


def calls(three):
    arm, _, q = three
    law = hf.control.pseudoinverse(arm, "planar")
    pose = arm.forward_kinematics(np.array([0.5, 0.6, 0.2]))
    return {
        "recover": lambda x: hf.recover(arm, x, q, goal=pose, task="planar", samples=0).q,
        "check_waypoints": lambda x: hf.recovery.check_waypoints(arm, [q, q], x).looked_at,
        "execute": lambda x: hf.execute(arm, [q, q + np.array([0.1, 0, 0.1])], [0, 1], locked=x, settle=0.0).q,
        "reachable_when_locked": lambda x: hf.reachable_when_locked(arm, [1.5, 1.5], x, task="planar").q,
        "simulate": lambda x: hf.simulate(law, q, [1.5, 1.5], locked=x).q_final,
        "basins": lambda x: hf.basins(law, [1.5, 1.5], x, starts=5).end,
        "stationary_points": lambda x: hf.stationary_points(law, [1.5, 1.5], x).q,
    }


def test_every_known_lock_may_be_a_degraded(three):
    names, made = set(public()), calls(three)
    assert names == set(made) | set(OTHERS), (
        "a public function has got or lost locked=: make it take a Degraded, and call it here"
    )
    locked = three[1]
    for name, call in made.items():
        plain = ["joint2"] if name == "simulate" else {"joint2": 0.6}
        np.testing.assert_array_equal(call(locked), call(plain), err_msg=name)


def test_what_only_counts_locks_refuses_ranges_and_speeds_in_a_sentence(three):
    arm = three[0]
    bad = Degraded(arm, locked={"joint2": 0.6}, ranges={"joint1": (-1, 1)})
    for name, call in calls(three).items():
        if name in ("recover", "check_waypoints", "execute", "reachable_when_locked"):
            call(bad)
        else:
            with pytest.raises(InputError, match="only locked joints count here, but the failures include a range of 'joint1'"):
                call(bad)
    elsewhere = Degraded(arm, locked={"joint2": 0.5})
    with pytest.raises(InputError, match="a joint locks where it is"):
        calls(three)["simulate"](elsewhere)
    with pytest.raises(InputError, match="belong to 'planar-3r', not to 'panda'"):
        hf.recover(hf.arms.load("panda"), bad, np.zeros(7))


def test_it_is_a_box_of_limits_and_speeds(rng):
    arm = hf.arms.load("panda")
    low, high = np.sort(rng.uniform(arm.lower[1], arm.upper[1], 2))
    bad = Degraded(arm, locked=[3, "panda_joint6"], ranges={1: (low, high)}, speeds={"panda_joint1": 0.3})
    q = rng.uniform(arm.lower, arm.upper)
    assert np.isnan(bad.lo[[3, 5]]).all()
    at = bad.at(q)
    others = [0, 2, 4, 6]
    np.testing.assert_array_equal(at.lo[others], arm.lower[others])
    np.testing.assert_array_equal(at.hi[others], arm.upper[others])
    np.testing.assert_array_equal([at.lo[[3, 5]], at.hi[[3, 5]]], [q[[3, 5]]] * 2)
    assert (at.lo[1], at.hi[1]) == (low, high)
    speed = np.array([j.velocity for j in arm.joints]) * [0.3, 1, 1, 0, 1, 0, 1]
    np.testing.assert_array_equal(at.v, speed)
    assert list(at.moves) == [True, True, True, False, True, False, True]
    np.testing.assert_allclose(at.limited.forward_kinematics(q), arm.forward_kinematics(q))


def test_a_file_gives_back_what_was_saved(tmp_path, rng):
    arm = hf.arms.load("panda")
    bad = Degraded(arm, locked={3: rng.normal(), 5: 1e-7}, ranges={1: (-0.5, 1e-5)}, speeds={0: 1 / 3})
    for made in (bad, Degraded(arm, locked=["panda_joint4"])):
        again = Degraded.load(made.save(tmp_path / "failure.yaml"), arm)
        assert (again.locked, again.ranges, again.speeds) == (made.locked, made.ranges, made.speeds)
    file = tmp_path / "by_hand.yaml"
    file.write_text("locked: [panda_joint4]\nrange: {panda_joint2: [-0.5, 1e-1]}\nspeed: {panda_joint1: 0.3}\n")
    read = Degraded.load(file, arm)
    assert (read.locked, read.ranges, read.speeds) == (
        {"panda_joint4": None},
        {"panda_joint2": (-0.5, 0.1)},
        {"panda_joint1": 0.3},
    )
    assert "within -28.65 to 5.73 deg" in read.describe()


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("locked: {joint9: 1}", "has no joint 'joint9'"),
        ("locked: {panda_joint4: .nan}", "panda_joint4"),
        ("locked: {panda_joint4: up}", "panda_joint4"),
        ("range: {panda_joint2: [0.8, -0.5]}", "0.8 to -0.5 rad; swap them"),
        ("range: {panda_joint2: [0.8, 0.8]}", "a joint that cannot move is locked"),
        ("range: {panda_joint2: [-3, 0]}", "is not within its limits, -1.76"),
        ("range: {panda_joint2: [1]}", "two finite numbers, rad"),
        ("speed: {panda_joint1: 0}", "above 0 and at most 1"),
        ("speed: {panda_joint1: 30}", "above 0 and at most 1"),
        ("speed: {panda_joint1: 0.3}\nlocked: [panda_joint1]", "is locked and has a range or a speed"),
        ("locked: [panda_joint1, panda_joint1]", "locked twice"),
        ("locked: []", "nothing of 'panda' is degraded"),
        ("speeds: {panda_joint1: 0.3}", "the key 'speeds' is not known; the keys here are locked, range, speed"),
        ("- 1", "must hold keys and values"),
    ],
)
def test_a_wrong_entry_is_one_sentence(tmp_path, text, sentence):
    file = tmp_path / "failure.yaml"
    file.write_text(text)
    with pytest.raises(InputError) as error:
        Degraded.load(file, hf.arms.load("panda"))
    assert sentence in str(error.value)
    assert str(error.value).startswith("failure file '")
    assert "\n" not in str(error.value)


def test_a_fraction_of_no_limit_is_refused():
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0) for _ in range(3)])
    with pytest.raises(InputError, match="has no velocity limit, so there is no fraction of it"):
        Degraded(arm, speeds={0: 0.5})


def test_recovery_keeps_the_reduced_range_and_speed(rng):
    arm = hf.arms.load("panda")
    home = np.array(arm.states["home"])
    at = home.copy()
    at[[0, 1]] = 0.9, 0.6
    bad = Degraded(arm, locked={"panda_joint7": at[6]}, ranges={"panda_joint1": (0.4, 1.2)}, speeds={"panda_joint2": 0.1})
    pose = arm.forward_kinematics(np.where(np.arange(7) == 0, 0.5, home))
    found = hf.recover(arm, bad, at, goal=pose, metric="time", samples=30)
    assert found.ok, found.reason
    assert (found.q[:, 0] >= 0.4).all()
    assert (found.q[:, 0] <= 1.2).all()
    np.testing.assert_allclose(arm.forward_kinematics(found.q[-1]), pose, atol=3e-6)
    steps = np.abs(np.diff(found.q, axis=0)) / [0.1 * j.velocity if k == 1 else j.velocity for k, j in enumerate(arm.joints)]
    assert found.length == pytest.approx(steps.max(axis=1).sum())
    assert found.check().ok
    assert not hf.recovery.check_waypoints(arm, [at, home], bad).ok
    assert json.dumps(found.to_dict())
    assert "panda_joint1 within 22.92 to 68.75 deg" in " ".join(found.describe())
    beyond = hf.recover(arm, bad, home, goal=pose, samples=0)
    assert beyond.ending == hf.recovery.RecoveryOutcome.START_OUTSIDE_LIMITS
    assert "its limits are now 0.4 to 1.2" in beyond.reason
    lost = hf.recover(arm, bad, at, samples=0)  # home itself is outside the range: its pose is aimed at
    assert lost.relaxed is not None
    assert lost.relaxed.names[0] == "panda_joint1"
    assert lost.relaxed.misses[0] == pytest.approx(0.4)
