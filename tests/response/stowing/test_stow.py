"""Stow configurations and the paths to them: closed forms, inequalities of Pinocchio, dense sampling, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from falling_arms import LENGTH, pendulum

pytestmark = pytest.mark.filterwarnings("error")
FRICTION = hf.Friction(coulomb=[2.0, 8.0, 2.0, 4.0, 0.5, 0.5, 0.2], viscous=0.5)
START = np.radians([0.0, -45, 0, -135, 0, 90, 45])
SEARCH = {"friction": FRICTION, "samples": 5000}


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def stowed(panda):
    return hf.stow(panda, START, **SEARCH)


def test_a_stow_configuration_holds_by_the_torques_of_pinocchio(panda, stowed):
    torque = oracles.generalized_gravity(panda, stowed.q[None])[0]
    friction = np.array(FRICTION.coulomb)
    need = np.where(stowed.q == panda.lower, -torque, np.where(stowed.q == panda.upper, torque, np.abs(torque)))
    assert (1.5 * need <= friction + 1e-9).all()
    assert stowed.holds
    assert stowed.fall.outcome == "holds"
    assert stowed.clearance(stowed.q) > 0
    assert ((stowed.q >= panda.lower) & (stowed.q <= panda.upper)).all()
    limits = np.array([joint.velocity for joint in panda.joints])
    assert stowed.duration == pytest.approx((np.abs(stowed.q - START) / limits).max())


def test_a_box_around_a_stow_configuration_is_proved(panda, stowed):
    at_stop = (stowed.q == panda.lower) | (stowed.q == panda.upper)
    half = np.where(at_stop, 0.0, 1e-3)
    lower, upper = np.maximum(stowed.q - half, panda.lower), np.minimum(stowed.q + half, panda.upper)
    proof = hf.certify(hf.certificates.hold_claim(panda, lower, upper, friction=FRICTION))
    assert proof.proved == 1


def test_more_friction_lets_the_arm_stow_nearer(panda, stowed):
    strong = hf.Friction(coulomb=100.0, viscous=0.5)
    near = hf.stow(panda, START, friction=strong, samples=5000)
    assert near.duration < stowed.duration
    with pytest.raises(hf.InputError, match="in its stow configuration already"):
        hf.plan_stow_path(hf.stow(panda, near.q, friction=strong, samples=500))


def test_the_same_seed_gives_the_same_configuration(panda, stowed):
    np.testing.assert_array_equal(hf.stow(panda, START, **SEARCH).q, stowed.q)


def test_a_region_and_slower_joints(panda):
    region = hf.Region.joints(panda.lower, np.append(panda.upper[:6], panda.lower[6] + 0.5))
    slow = hf.stow(panda, START, where=region, speeds=0.1, **SEARCH)
    assert slow.q[6] <= panda.lower[6] + 0.5
    assert slow.duration == pytest.approx(np.abs(slow.q - START).max() / 0.1)


def test_without_a_holding_configuration_the_smallest_drop_is_returned(panda):
    region = hf.Region.joints(START - 0.1, START + 0.1)
    weak = hf.stow(panda, where=region, friction=hf.Friction(coulomb=0.1, viscous=0.5), samples=500)
    assert not weak.holds
    assert weak.found == 0
    assert weak.fall.of == "any point"
    assert weak.resting is None
    assert weak.fall.drop > 0


def test_without_a_holding_configuration_the_arm_lies_down_on_the_floor():
    arm, floor = pendulum(lower=-1.5, upper=1.5), hf.Cell([hf.cell.HalfSpace("floor", pose=[0, 0, -0.4])])
    ball = hf.Capsules((hf.collision.LinkCapsule(0, (LENGTH, 0, 0), (LENGTH, 0, 0), radius=0.05),))
    clearance = hf.Clearance(arm, ball, floor, itself=False)
    options = {"friction": hf.Friction(viscous=0.0), "where": hf.Region.joints([-1.4], [1.4]), "samples": 500}
    lying = hf.stow(arm, clearance=clearance, **options)
    height = 0.4 - 0.05 + LENGTH * np.sin(lying.q[0])  # of the ball above the floor
    assert 0 < height < 0.01
    assert not lying.holds
    assert lying.fall.drop == pytest.approx(height, abs=1e-3)
    assert lying.resting.outcome == "rest"
    assert lying.resting.drop == pytest.approx(height, abs=2e-3)
    assert [contact.object for contact in lying.resting.contacts] == ["floor"]
    words = " ".join(lying.describe())
    assert "the arm then lies still, in contact with floor" in words
    assert "which is no proof" in words
    assert lying.to_dict()["resting"]["drop_m"] == lying.resting.drop
    assert hf.stow(arm, clearance=False, **options).resting is None
    assert hf.stow(arm, clearance=clearance, **options | {"friction": hf.Friction(coulomb=30.0)}).resting is None


def dense(path, count=40):
    """Configurations and rates along a path, independent of its curve."""
    for a, b, start, end in zip(path.q[:-1], path.q[1:], path.time[:-1], path.time[1:], strict=True):
        for fraction in np.linspace(0.01, 0.99, count):
            yield a + fraction * (b - a), (b - a) / (end - start)


@pytest.mark.parametrize("monotone", [False, True])
def test_a_path_stays_clear_and_below_its_bound(panda, stowed, monotone):
    path = hf.plan_stow_path(stowed, monotone=monotone, nodes=300, tolerance=0.3, duration=1.0)
    assert path.is_found
    np.testing.assert_array_equal(path.q[[0, -1]], [START, stowed.q])
    limits = np.array([joint.velocity for joint in panda.joints])
    np.testing.assert_allclose((np.abs(np.diff(path.q, axis=0)) / limits).max(axis=1) / path.speed_fraction, np.diff(path.time))
    q, rates = map(np.array, zip(*dense(path), strict=True))
    assert (stowed.clearance(q) > 0).all()
    fall = hf.power_loss(panda, q, rates, friction=FRICTION, clearance=stowed.clearance, duration=1.0)
    assert fall.drop.max() <= path.bound + 0.01
    if monotone:
        assert (fall.drop - np.minimum.accumulate(fall.drop)).max() <= 0.3 + 0.02


def test_a_path_around_an_obstacle(panda, stowed):
    middle = panda.forward_kinematics((START + stowed.q) / 2)[:3, 3]
    cell = hf.Cell([hf.cell.Box("post", size=[0.06] * 3, pose=oracles.pose(None, middle))])
    blocked = hf.stow(panda, START, cell=cell, **SEARCH)
    path = hf.plan_stow_path(blocked, nodes=400, tolerance=0.6, duration=0.5)
    assert path.straight is None
    assert path.is_found
    assert blocked.clearance(np.array([q for q, _ in dense(path)])).min() > 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"factor": 0.5}, "factor is 0.5"),
        ({"samples": 0}, "samples is 0"),
        ({"at": np.full(7, 9.0)}, "within the limits"),
        ({"at": np.zeros(6)}, "6 values"),
        ({"speeds": 0.0, "at": START}, "has no speed limit above 0"),
        ({"where": hf.Region.box([0, 0, 0], 1)}, "contains poses"),
    ],
)
def test_a_wrong_request_is_refused(panda, options, message):
    with pytest.raises(hf.InputError, match=message):
        hf.stow(panda, **SEARCH | options)


def test_an_arm_that_nothing_holds_is_refused():
    with pytest.raises(hf.InputError, match="nothing holds 'pendulum' but its motors"):
        hf.stow(pendulum(), friction=hf.Friction(viscous=0.0))


def test_a_path_needs_a_start(panda):
    with pytest.raises(hf.InputError, match="give it to stow as at"):
        hf.plan_stow_path(hf.stow(panda, **SEARCH))
    with pytest.raises(hf.InputError, match="tolerance is -1"):
        hf.plan_stow_path(hf.stow(panda, START, **SEARCH), tolerance=-1.0)
