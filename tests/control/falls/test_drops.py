"""Drops along motions, over random configurations, and with brakes: closed forms, single falls, bad inputs."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import beta

import holdfast as hf
from falling_arms import FREE, MASS, G, lift, pendulum


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


FRICTION = hf.Friction(coulomb=0.5, viscous=0.3)
SHORT = {"friction": FRICTION, "duration": 0.3, "step": 4e-3}


def motion(arm, rng, count=15):
    """A smooth motion at uneven times, with its rates."""
    time = np.sort(rng.uniform(0, 1.5, count))
    middle, size = (arm.lower + arm.upper) / 2, 0.2 * (arm.upper - arm.lower)
    return time, middle + size * np.sin(2 * time)[:, None], 2 * size * np.cos(2 * time)[:, None]


# ---- along a motion --------------------------------------------------------------------------------------------------


def test_every_instant_is_a_fall_with_the_rates_of_the_motion(panda, rng):
    time, q, rates = motion(panda, rng)
    curve = hf.power_loss_along(panda, q, time, rates=rates, refine=False, **SHORT)
    falls = hf.power_loss(panda, q, rates, **SHORT)
    np.testing.assert_array_equal(curve.drop, falls.drop)
    np.testing.assert_array_equal(curve.time, time)
    assert curve.worst == np.argmax(falls.drop)
    assert curve.falls.drop.max() == falls.drop[curve.worst]
    assert curve.exposure == pytest.approx(np.sum(np.diff(time) * (falls.drop[1:] + falls.drop[:-1]) / 2))
    assert curve.spacing == np.diff(time).max()
    assert np.isnan(curve.impact_speed).all()


def test_rates_of_a_parabola_are_exact_at_uneven_times(panda, rng):
    time = np.sort(rng.uniform(0, 1, 9))
    slope, bend = rng.uniform(-0.3, 0.3, (2, 7))
    middle = (panda.lower + panda.upper) / 2
    q = middle + np.outer(time, slope) + np.outer(time**2, bend)
    curve = hf.power_loss_along(panda, q, time, refine=False, **SHORT)
    np.testing.assert_allclose(curve.falls.rates, slope + 2 * np.outer(time, bend), atol=1e-9)
    assert curve.rates_from == "fitted"


def test_instants_are_added_only_where_the_drop_changes(rng):
    arm = pendulum(lower=-1.5, upper=1.5)
    time = np.linspace(0, 1, 6)
    q, rates = np.array([-1.5, -1.5, -1.5, 1.2, 1.2, 1.2])[:, None], np.zeros((6, 1))
    curve = hf.power_loss_along(arm, q, time, rates=rates, friction=FREE)
    assert np.isin(time, curve.time).all()
    added = curve.time[~np.isin(curve.time, time)]
    assert len(added) >= 3
    assert ((added > 0.4) & (added < 0.6)).all()
    np.testing.assert_array_equal(curve.drop, hf.power_loss(arm, curve.falls.q, curve.falls.rates, friction=FREE).drop)


def test_the_hold_up_time_ends_where_the_drop_stays_small():
    arm, heights = lift(lower=0.0), np.array([0.5, 0.2, 0.4, 0.05, 0.0])
    curve = hf.power_loss_along(arm, heights[:, None], np.arange(5.0), rates=np.zeros((5, 1)), friction=FREE, refine=False)
    np.testing.assert_allclose(curve.drop, heights, atol=1e-9)
    assert [curve.find_hold_up_time(limit) for limit in (0.6, 0.3, 0.1, 0.02)] == [0.0, 3.0, 3.0, 4.0]
    rising = hf.power_loss_along(arm, heights[::-1, None], np.arange(5.0), rates=np.zeros((5, 1)), friction=FREE, refine=False)
    assert rising.find_hold_up_time(0.3) is None


def test_held_joints_stop_at_once(panda, rng):
    time, q, rates = motion(panda, rng, 5)
    curve = hf.power_loss_along(panda, q, time, rates=rates, refine=False, free=[3], **SHORT)
    only = np.zeros_like(rates)
    only[:, 3] = rates[:, 3]
    np.testing.assert_array_equal(curve.drop, hf.power_loss(panda, q, only, free=[3], **SHORT).drop)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"time": [0.0, 1.0, 1.0, 2.0, 3.0]}, "increasing"),
        ({"time": [0.0, 1.0]}, r"q has shape \(5, 7\) and time \(2,\)"),
        ({"q": np.full((5, 7), np.nan)}, "row 0"),
        ({"q": np.zeros((4, 7)), "time": np.arange(4.0)}, "4 rows without rates"),
        ({"rates": np.zeros((5, 6))}, "rates has shape"),
        ({"rates": np.full((5, 7), 150.0)}, "moves at 150 rad/s at 0 s; if q is in degrees"),
    ],
)
def test_a_wrong_motion_is_refused(panda, change, message):
    q = np.tile((panda.lower + panda.upper) / 2, (5, 1))
    arguments = {"q": q, "time": np.arange(5.0), "rates": None} | change
    with pytest.raises(hf.InputError, match=message):
        hf.power_loss_along(panda, **arguments)


# ---- probability -----------------------------------------------------------------------------------------------------


def test_the_probability_is_the_fraction_of_single_falls(panda):
    result = hf.power_loss_probability(panda, 0.05, samples=200, seed=3, **SHORT)
    drops = hf.power_loss(panda, result.fall.q, **SHORT).drop
    hits = int((drops <= 0.05).sum())
    interval = result.interval()
    assert 0 < hits < 200
    assert interval.value == hits / 200
    assert (interval.low, interval.high) == pytest.approx(
        (beta.ppf(0.025, hits, 201 - hits), beta.ppf(0.975, hits + 1, 200 - hits))
    )
    assert ((result.fall.q >= panda.lower) & (result.fall.q <= panda.upper)).all()
    np.testing.assert_array_equal(drops[result.rank_worst(3)], np.sort(drops)[::-1][:3])
    assert result.interval(1e-9).value <= interval.value <= result.interval(9.0).value == 1


def test_the_map_averages_over_two_joints(panda):
    result = hf.power_loss_probability(panda, 0.05, samples=300, **SHORT)
    first, second, means = result.map("panda_joint2", 3, bins=4)
    q = result.fall.q
    inside = (q[:, 1] >= first[1]) & (q[:, 1] < first[2]) & (q[:, 3] >= second[2]) & (q[:, 3] < second[3])
    assert means[1, 2] == pytest.approx(result.value[inside].mean())


def test_regions_of_joints_and_of_poses(panda):
    low, high = (panda.lower * 3 + panda.upper) / 4, (panda.lower + panda.upper * 3) / 4
    joints = hf.power_loss_probability(panda, 0.1, where=hf.Region.joints(low, high), samples=50, **SHORT)
    assert ((joints.fall.q >= low) & (joints.fall.q <= high)).all()
    box = hf.Region.box([0.4, 0, 0.4], 0.1, rpy_center=[np.pi, 0, 0])
    poses = hf.power_loss_probability(panda, 0.1, where=box, samples=20, **SHORT)
    assert len(poses.value) + poses.unreached == 20
    points = panda.forward_kinematics(poses.fall.q)[:, :3, 3]
    assert (np.abs(points - [0.4, 0, 0.4]) <= 0.05 + 1e-6).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"below": 0.0}, "below is 0"),
        ({"below": np.nan}, "below is nan"),
        ({"measure": "height"}, "measure"),
        ({"measure": "impact_speed"}, "needs contacts"),
        ({"samples": 0}, "samples is 0"),
        ({"q": np.full((3, 7), np.nan)}, "none of 3 configurations"),
        ({"where": hf.Region.box([0, 0, 0], 1, weight={"z": [(0.0, 1), (0.5, 3)]})}, "has weights"),
    ],
)
def test_a_wrong_request_for_a_probability_is_refused(panda, options, message):
    with pytest.raises(hf.InputError, match=message):
        hf.power_loss_probability(panda, **{"below": 0.1, "samples": 10} | options)


# ---- brakes ----------------------------------------------------------------------------------------------------------


def test_a_brake_of_finite_force_adds_the_braking_distance():
    forces, delays = np.array([1.5, 3.0]) * MASS * G, np.array([0.0, 0.05, 0.1])
    result = hf.compare_brakes(lift(), [0.0], torque=forces.tolist(), after=delays, friction=FREE, duration=1.0)
    speed, deceleration = G * delays, forces[:, None] / MASS - G
    np.testing.assert_allclose(result.drop, G * delays**2 / 2 + speed**2 / (2 * deceleration), atol=1e-8)
    np.testing.assert_allclose(result.drop_at_brake, G * delays**2 / 2, atol=1e-8)
    assert result.drop_without == pytest.approx(G / 2, abs=1e-8)
    assert result.need == pytest.approx([MASS * G])


def test_a_brake_below_the_need_does_not_stop_the_arm():
    result = hf.compare_brakes(lift(), [0.0], torque=[0.9 * MASS * G, 1.1 * MASS * G], after=[0.0], friction=FREE)
    assert result.drop[0, 0] == pytest.approx(0.1 * G / 2 * 2.0**2, abs=1e-6)
    assert result.drop[1, 0] == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"torque": []}, "torque is empty"),
        ({"torque": [-1.0]}, "brake torque of joint 'lift' is -1"),
        ({"after": [-0.1]}, "after is -0.1 s"),
        ({"after": []}, "at least one delay"),
        ({"q": [[0.0], [1.0]]}, "compared in one configuration"),
    ],
)
def test_wrong_brakes_are_refused(options, message):
    with pytest.raises(hf.InputError, match=message):
        hf.compare_brakes(lift(), **{"q": [0.0], "torque": [30.0]} | options)
