"""``hf.holds`` against the inequalities of Pinocchio's torques, brute force, and the first motion of the dynamics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.status import Status
from holdfast.kinematics.holding.static_check import STOP_TOLERANCE

pytestmark = pytest.mark.interpreted


def friction_arm(rng, types=None):
    """A random arm with limits, efforts, dry friction, and bodies."""
    arm = oracles.with_bodies(oracles.random_arm(rng, n=int(rng.integers(2, 8)), types=types, limits=2.0), rng, payload=True)
    joints = []
    for joint in arm.joints:
        coulomb = rng.uniform(0, 20) * rng.integers(0, 2)
        static = coulomb * rng.uniform(1, 2) * rng.integers(0, 2)
        joints.append(replace(joint, effort=rng.uniform(1, 120), coulomb_friction=coulomb, stiction=static))
    return replace(arm, joints=tuple(joints))


def snapped(arm, rng, count):
    """Configurations of which many joints are exactly at a limit."""
    q = oracles.inside(arm, rng, count)
    draw = rng.random(q.shape)
    q = np.where(((draw < 0.2) & np.isfinite(arm.lower)) | (q <= arm.lower + STOP_TOLERANCE), arm.lower, q)
    return np.where(((draw > 0.8) & np.isfinite(arm.upper)) | (q >= arm.upper - STOP_TOLERANCE), arm.upper, q)


def bears(torque, lower, upper, q, strength):
    """Whether one joint bears its torque, as a person would decide it."""
    if q == lower and torque > 0:  # gravity pushes it into its lower stop
        return True
    if q == upper and torque < 0:
        return True
    return abs(torque) <= strength


def test_the_inequalities_of_pinocchio(rng):
    held = []
    for _ in range(40):
        arm = friction_arm(rng)
        q, load, effort = snapped(arm, rng, 2_500), rng.uniform(0, 0.5, arm.n), rng.choice([0.0, 0.3])
        free = np.flatnonzero(rng.random(arm.n) < 0.7).tolist() or [0]
        check = hf.holds(arm, q, free=free, friction=hf.Friction(load=load), effort=effort)
        torque = oracles.generalized_gravity(arm, q)
        strength = np.array([max(j.stiction, j.coulomb_friction) + effort * j.effort for j in arm.joints]) + load * np.abs(
            torque
        )
        expected = np.vectorize(bears)(torque, arm.lower, arm.upper, q, strength)
        np.testing.assert_array_equal(check.holds, expected[:, free].all(axis=1))
        lacking = np.where(expected, np.inf, strength - np.abs(torque))[:, free].min(axis=1)
        falls = ~check.holds
        np.testing.assert_allclose(check.margin[falls], lacking[falls], rtol=1e-10, atol=1e-10)
        assert not expected[np.flatnonzero(falls), check.joint[falls]].any()
        assert ((check.margin >= 0) == check.holds).all()
        assert ((check.factor >= 1) == check.holds).all()
        held += check.holds.tolist()
    assert len(held) == 100_000
    assert 0.05 < np.mean(held) < 0.95


def test_exactly_so_much_effort_and_no_less(rng):
    for _ in range(10):
        arm = friction_arm(rng)
        q = snapped(arm, rng, 20)
        torque, least = oracles.generalized_gravity(arm, q), hf.holds(arm, q).least_effort

        def all_bear(row, share, arm=arm, q=q, torque=torque):
            strengths = [max(j.stiction, j.coulomb_friction) + share * j.effort for j in arm.joints]
            return all(map(bears, torque[row], arm.lower, arm.upper, q[row], strengths))

        for row, share in enumerate(least):
            assert all_bear(row, share * (1 + 1e-10))
            assert share == 0 or not all_bear(row, share * (1 - 1e-10))


def test_the_largest_payload_of_pinocchio(rng):
    decided = 0
    for _ in range(10):
        arm = friction_arm(rng)
        q = snapped(arm, rng, 10)
        largest = hf.holds(arm, q, effort=1.0).largest_payload

        def all_bear(row, mass, arm=arm, q=q):
            point = hf.Link(mass, arm.tool[:3, 3], np.zeros((3, 3)))
            loaded = replace(arm, payload=hf.Link.merge([arm.payload, point]))
            (torque,) = oracles.generalized_gravity(loaded, q[row : row + 1])
            strengths = [max(j.stiction, j.coulomb_friction) + j.effort for j in arm.joints]
            return all(map(bears, torque, arm.lower, arm.upper, q[row], strengths))

        for row, mass in enumerate(largest):
            if np.isnan(mass):
                assert not any(all_bear(row, each) for each in np.linspace(0, 50, 40))
            elif np.isfinite(mass):
                assert all_bear(row, mass * (1 - 1e-10))
                assert not all_bear(row, mass * (1 + 1e-10) + 1e-12)
                decided += mass > 0
            else:
                assert all_bear(row, 1e4)
    assert decided > 5


def first_acceleration(inertia, torque, friction, lower, upper):
    """The accelerations from rest, by coordinate descent of ``a'Ma/2 + g'a + sum s |a|`` with one-sided stops."""
    a = np.zeros(len(torque))
    for _ in range(20_000):
        before = a.copy()
        for i in range(len(a)):
            pull = torque[i] + inertia[i] @ a - inertia[i, i] * a[i]
            a[i] = np.clip(-np.sign(pull) * max(abs(pull) - friction[i], 0) / inertia[i, i], lower[i], upper[i])
        if np.abs(a - before).max() <= 1e-13 * max(np.abs(a).max(), 1.0):
            break
    return a


def test_nothing_moves_where_it_holds_and_something_where_not(rng):
    import pinocchio as pin

    verdicts = []
    for _ in range(15):
        arm = friction_arm(rng)
        model, _ = oracles.to_pinocchio(arm)
        data = model.createData()
        q = snapped(arm, rng, 12)
        friction = rng.uniform(0.5, 1.5, arm.n) * np.abs(arm.gravity_torque(q[0])) + 3.0
        check = hf.holds(arm, q, friction=hf.Friction(coulomb=friction))
        for row, x in enumerate(q):
            if abs(check.margin[row]) < 1e-6:
                continue
            upper_part = np.triu(pin.crba(model, data, x))
            inertia = upper_part + np.triu(upper_part, 1).T
            torque = pin.computeGeneralizedGravity(model, data, x)
            lowest, highest = np.where(x == arm.lower, 0.0, -np.inf), np.where(x == arm.upper, 0.0, np.inf)
            moves = first_acceleration(inertia, torque, friction, lowest, highest).any()
            assert check.holds[row] == (not moves)
            verdicts.append(bool(moves))
    assert {True, False} == set(verdicts)


# ---- special cases -------------------------------------------------------------------------------------------------------


def rod(**options):
    """A rod of 2 kg on a level axis, its centre of mass at 0.5 m, level at q = 0; a positive turn lowers it."""
    joint = hf.Joint("j", "revolute", np.eye(4), axis=np.array([0.0, 1, 0]), **{"lower": -1.0, "upper": 1.0} | options)
    tool = oracles.pose(None, [1.0, 0, 0])
    return hf.Arm(name="rod", joints=(joint,), links=(hf.Link(2.0, np.array([0.5, 0, 0]), 0.1 * np.eye(3)),), tool=tool)


def test_by_hand():
    arm, level = rod(effort=20.0, coulomb_friction=4.0), [0.0]
    check = hf.holds(arm, level)
    assert check.torque == pytest.approx(-9.81)
    assert (bool(check.holds), int(check.joint)) == (False, 0)
    assert check.margin == pytest.approx(4 - 9.81)
    assert check.factor == pytest.approx(4 / 9.81)
    assert check.least_effort == pytest.approx((9.81 - 4) / 20)
    assert np.isnan(check.largest_payload)
    assert hf.holds(arm, level, effort=1.0).largest_payload == pytest.approx((24 - 9.81) / 9.81)
    assert hf.holds(arm, level, friction=hf.Friction(stiction=10)).holds
    assert hf.holds(arm, level, friction=hf.Friction(load=0.6)).margin == pytest.approx(4 + 0.6 * 9.81 - 9.81)
    lowered, raised = hf.holds(arm, [1.0]), hf.holds(arm, [-1.0])
    assert lowered.holds
    assert lowered.need == pytest.approx(-9.81 * np.cos(1))  # the stop carries it
    assert lowered.factor == lowered.largest_payload == np.inf
    assert not raised.holds
    assert not hf.holds(arm, [1.0], stops=False).holds
    assert hf.holds(rod(lower=0.0, upper=0.0), level).margin == np.inf


def test_a_balanced_joint_needs_no_friction():
    arm = hf.arms.load("panda")
    check = hf.holds(arm, [0.3, 0.4, 0.1, -2.0, 0.2, 1.5, 0.6], free="1")
    assert check.holds
    assert (check.torque[0], check.margin) == (0, 0)


def test_four_decimals_of_a_limit_are_the_limit():
    arm = rod(upper=np.pi / 2)
    assert hf.holds(arm, [1.5708]).stop == 1
    assert hf.holds(arm, [np.pi / 2 - 2 * STOP_TOLERANCE]).stop == 0


def test_an_unknown_effort_gives_no_number():
    assert np.isnan(hf.holds(rod(), [0.0]).least_effort)
    assert hf.holds(rod(), [1.0]).least_effort == 0


def test_a_batch_is_its_rows(rng):
    arm = friction_arm(rng)
    q = snapped(arm, rng, 5)
    broken = q.copy()
    broken[2, 0] = np.nan
    check = hf.holds(arm, broken)
    np.testing.assert_array_equal(check.status, [0, 0, Status.BAD_INPUT, 0, 0])
    assert (check.joint[2], bool(check.holds[2])) == (-1, False)
    for row in (0, 1, 3, 4):
        alone = hf.holds(arm, q[row])
        for name in ("torque", "need", "available", "holds", "margin", "factor", "joint", "least_effort", "largest_payload"):
            np.testing.assert_array_equal(getattr(check, name)[row], getattr(alone, name))
    with pytest.raises(hf.HoldfastError, match="row 2, bad_input"):
        check.require_ok()
    assert hf.holds(arm, np.zeros((0, arm.n))).holds.shape == (0,)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"q": [1.2]}, r"joint 'j' is 0\.2 rad outside its limits, -1 to 1; .*stops=False"),
        ({"q": [[0.0], [-1.5]]}, "0.5 rad outside its limits in row 1"),
        ({"q": [np.nan]}, "NaN or infinity"),
        ({"free": []}, "no joint of 'rod' is named"),
        ({"free": ["k"]}, "has no joint 'k'"),
        ({"friction": hf.Friction(coulomb=-1.0)}, "coulomb friction of joint '.*' is -1; it must be a finite number of 0"),
        ({"friction": hf.Friction(coulomb=np.inf)}, "coulomb friction of joint '.*' is inf"),
        ({"friction": hf.Friction(coulomb=[1.0, 2.0])}, r"coulomb friction has shape \(2,\)"),
        ({"friction": hf.Friction(coulomb=2.0, stiction=1.0)}, "stiction of joint 'j' is 1, below its coulomb friction 2"),
        ({"friction": hf.Friction(load=1.0)}, "load fraction of friction of joint 'j' is 1; it must be below 1"),
        ({"effort": 35.0}, "effort is 35; it must be a fraction from 0 to 1"),
        ({"effort": 0.5}, "joint 'j' of 'rod' has no effort limit"),
    ],
)
def test_bad_input_is_one_sentence(options, words):
    with pytest.raises(hf.InputError, match=words):
        hf.holds(rod(), **{"q": [0.0]} | options)


def test_an_arm_without_masses_is_refused():
    with pytest.raises(hf.ArmError, match="no inertial data"):
        hf.holds(hf.arms.load("pa10-9dof"), np.zeros(9), stops=False)


def test_what_a_person_reads(rng):
    arm = rod(effort=20.0)
    fallen, held = hf.holds(arm, [0.0]), hf.holds(arm, [1.0])
    assert fallen.describe()[0] == "The arm falls: j needs 9.81 N m to stay, and has 0 N m."
    assert any("No dry friction is given" in line for line in fallen.describe())
    assert held.describe()[0] == "The arm holds: j has the smallest margin, 5.3 N m."
    assert "holds 1 of 2 configurations" in hf.holds(arm, [[0.0], [1.0]]).describe()[0]
    assert "1 row of NaN has no verdict" in hf.holds(arm, [[np.nan], [1.0]]).describe()[0]
    assert fallen.to_dict()["largest_payload_kg"] is None
