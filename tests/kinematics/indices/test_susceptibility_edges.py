"""Every row of the table of edge cases (specification, section 7): conventions, flags and errors, never a silent NaN."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast import susceptibility as sus
from holdfast.core.status import Status

NAMES = ["torque", "acceleration", "swing-angle"]  # of joints that fail alone
ROD = hf.Link(1.0, np.array([0.5, 0, 0]), np.diag([0.01, 0.08, 0.08]))
POINT = np.zeros((3, 3))


def joint(name, kind="revolute", place=(0, 0, 0), axis=(0, 1, 0), **options):
    return hf.Joint(name, kind, oracles.pose(None, place), axis=np.array(axis, dtype=float), **options)


def two(second: hf.Link, axis=(0, 1, 0), kind="revolute", **options) -> hf.Arm:
    """A rod on a level axis that carries a second body on an axis at its end; gravity down."""
    return hf.Arm(name="two", joints=(joint("one"), joint("two", kind, (1, 0, 0), axis, **options)), links=(ROD, second))


def flags(result):
    return [Status(int(s)).name for s in np.ravel(result.joint_status)]


def test_balanced_joint():
    """A wheel: its centre of mass on its own axis."""
    arm = two(hf.Link(2.0, np.zeros(3), np.diag([0.1, 0.2, 0.1])))
    q = np.array([0.3, 0.4])
    for name in NAMES:
        result = sus.by_name(name, arm).evaluate(q)
        assert result.by_joint[1] == pytest.approx(0, abs=1e-14)
        assert result.by_joint[0] != 0
        assert (result.status, flags(result)) == (Status.OK, ["OK", "DEGENERATE" if name == "swing-angle" else "OK"])
    slopes = sus.swing_angle(arm).jacobian(q)
    np.testing.assert_array_equal(slopes[1], 0)
    assert slopes[0, 0] == pytest.approx(-1)
    assert np.isfinite(sus.swing_angle(arm).gradient(q)).all()


def test_balanced_but_for_rounding():
    """Rounding noise of 1e-16 kg m has a direction, which means nothing."""
    arm = two(hf.Link(2.0, np.array([1e-16, 0, -3e-16]), np.diag([0.1, 0.2, 0.1])))
    result = sus.swing_angle(arm).evaluate(np.array([0.3, 0.4]))
    assert result.by_joint[1] == 0
    assert flags(result) == ["OK", "DEGENERATE"]


def test_gravity_along_the_axis(rng):
    arm = replace(two(ROD), gravity=np.array([0.0, 9.81, 0]))
    q = rng.uniform(-1, 1, (5, 2))
    for name in NAMES:
        result = sus.by_name(name, arm).evaluate(q)
        np.testing.assert_allclose(result.by_joint, 0, atol=1e-14)
        assert set(flags(result)) == {"DEGENERATE" if name == "swing-angle" else "OK"}
        np.testing.assert_allclose(sus.by_name(name, arm).gradient(q), 0, atol=1e-13)


def test_gravity_along_the_axis_at_some_configurations():
    """A second axis that the first joint turns upright: only those rows are flagged."""
    arm = two(ROD, axis=(1, 0, 0))
    arm = replace(arm, links=(ROD, hf.Link(1.0, np.array([0.2, 0.1, 0.3]), 0.1 * np.eye(3))))
    measure = sus.swing_angle(arm)
    q = np.array([[np.pi / 2, 0.7], [np.pi / 2 + 1e-6, 0.7], [-np.pi / 2, 0.7], [0.3, 0.7]])
    result = measure.evaluate(q)
    np.testing.assert_array_equal(result.joint_status[:, 1], [Status.DEGENERATE, 0, Status.DEGENERATE, 0])
    np.testing.assert_array_equal(result.by_joint[[0, 2], 1], 0)
    np.testing.assert_array_equal(measure.jacobian(q)[[0, 2], 1], 0)
    assert np.isfinite(measure.gradient(q)).all()
    assert np.isfinite(measure(q)).all()


def test_no_gravity(rng):
    arm = replace(oracles.with_bodies(oracles.random_arm(rng, types="RPR"), rng), gravity=np.zeros(3))
    q = rng.uniform(-1, 1, (3, 3))
    for name in NAMES:
        measure = sus.by_name(name, arm)
        result = measure.evaluate(q)
        np.testing.assert_array_equal(result.by_joint, 0)
        np.testing.assert_array_equal(measure.gradient(q), 0)
        expected = ["DEGENERATE", "NOT_DEFINED", "DEGENERATE"] if name == "swing-angle" else ["OK"] * 3
        assert flags(result)[:3] == expected


def test_sliding_joints_do_not_swing(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="PRPR"), rng)
    q = rng.uniform(-1, 1, 4)
    measure = sus.swing_angle(arm)
    result = measure.evaluate(q)
    np.testing.assert_array_equal(result.by_joint[[0, 2]], 0)
    assert flags(result) == ["NOT_DEFINED", "OK", "NOT_DEFINED", "OK"]
    slopes = measure.jacobian(q)
    np.testing.assert_array_equal(slopes[[0, 2]], 0)
    assert abs(slopes[1, 2]) > 1e-6  # the swing of joint 2 changes as joint 3 slides, rad/m
    fall = sus.acceleration(arm).by_joint(q)
    mass = sum(b.mass for b in arm.links)
    z = arm.base[:3, :3] @ arm.joints[0].origin[:3, :3] @ arm.joints[0].axis
    np.testing.assert_allclose(fall[0], z @ arm.gravity, rtol=1e-12)
    np.testing.assert_allclose(sus.torque(arm).by_joint(q)[0], -mass * z @ arm.gravity, rtol=1e-12)
    assert sus.torque(arm).joint_unit == ("N", "N m", "N", "N m")
    assert sus.acceleration(arm).joint_unit == ("m/s^2", "rad/s^2", "m/s^2", "rad/s^2")


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_exactly_above_the_axis(zero):
    """+pi, never -pi; the derivative is still -1."""
    arm = two(ROD)
    for q in ([-np.pi / 2, zero], [-np.pi / 2 + 1e-17, zero]):
        result = sus.swing_angle(arm).evaluate(np.array(q))
        np.testing.assert_array_equal(result.by_joint, np.pi)
        assert flags(result) == ["OK", "OK"]
    np.testing.assert_allclose(np.diag(sus.swing_angle(arm).jacobian(np.array([-np.pi / 2, zero]))), -1, rtol=1e-12)
    exact = replace(arm, gravity=np.array([9.81, 0, 0.0]))  # straight up against gravity at q = 0, without rounding
    for turned in (exact, replace(exact, joints=tuple(replace(j, axis=-j.axis) for j in exact.joints))):
        q = np.full(2, zero)
        up = replace(turned, gravity=-turned.gravity)
        np.testing.assert_array_equal(sus.swing_angle(up).by_joint(q), np.pi)
        np.testing.assert_array_equal(sus.swing_angle(turned).by_joint(q), 0)
        np.testing.assert_allclose(np.diag(sus.swing_angle(up).jacobian(q)), -1, rtol=1e-12)
        np.testing.assert_allclose(sus.torque(up).by_joint(q), 0, atol=1e-13)


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_nothing_behind_a_joint_has_mass(kind):
    empty = hf.Link(0.0, np.zeros(3), POINT)
    arm = two(empty, kind=kind)
    q = np.array([0.2, 0.1])
    assert sus.torque(arm).by_joint(q)[1] == 0
    result = sus.swing_angle(arm).evaluate(q)
    assert result.by_joint[1] == 0
    assert flags(result) == ["OK", "DEGENERATE" if kind == "revolute" else "NOT_DEFINED"]
    assert np.isfinite(sus.swing_angle(arm).gradient(q)).all()
    with pytest.raises(hf.ArmError, match=r"nothing behind joint 'two' has mass.*armature"):
        sus.acceleration(arm)
    rotor = two(empty, kind=kind, armature=0.1)
    assert sus.acceleration(rotor).by_joint(q)[1] == 0


def test_all_mass_on_the_axis_is_not_a_number_with_a_flag():
    """A point mass at the end of a slide that crosses the axis: 0/0 only when the slide is in."""
    slide = joint("slide", "prismatic", (0, 0, 0), (0, 0, 1), lower=-1, upper=1)
    arm = hf.Arm(
        name="slide",
        joints=(joint("one"), joint("two", place=(1, 0, 0)), slide),
        links=(ROD, hf.Link(0, np.zeros(3), POINT), hf.Link(1, np.zeros(3), POINT)),
    )
    measure = sus.acceleration(arm)
    q = np.array([[0.2, 0.3, 0.0], [0.2, 0.3, 0.5], [np.nan, 0.3, 0.5]])
    result = measure.evaluate(q)
    np.testing.assert_array_equal(np.isnan(result.by_joint), [[False, True, False], [False] * 3, [True] * 3])
    np.testing.assert_array_equal(np.isnan(result.value), [True, False, True])
    np.testing.assert_array_equal(result.status, [Status.NO_INERTIA, Status.OK, Status.BAD_INPUT])
    assert flags(result) == ["OK", "NO_INERTIA", "OK", "OK", "OK", "OK", "BAD_INPUT", "BAD_INPUT", "BAD_INPUT"]
    np.testing.assert_array_equal(np.isnan(measure.gradient(q)).any(axis=1), [True, False, True])
    with pytest.raises(hf.HoldfastError, match="row 0, no_inertia"):
        result.require_ok()
    # A joint without weight does not spoil the others.
    others = sus.acceleration(arm, [1, 0, 1])
    assert np.isfinite(others(q[0]))
    assert np.isfinite(others.gradient(q[0])).all()
    swing = sus.swing_angle(arm).evaluate(q[0])
    assert (swing.by_joint[1], flags(swing)[1]) == (0, "DEGENERATE")


@pytest.mark.parametrize("name", NAMES)
def test_nan_in_q(name, rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRP"), rng)
    measure = sus.by_name(name, arm)
    q = rng.uniform(-1, 1, (4, 3))
    clean = measure.evaluate(q)
    q[1, 0], q[2, 2] = np.nan, np.inf
    result = measure.evaluate(q)
    bad = np.array([False, True, True, False])
    for got, before in ((result.value, clean.value), (result.by_joint, clean.by_joint)):
        assert np.isnan(got[bad]).all()
        np.testing.assert_array_equal(got[~bad], before[~bad])
    np.testing.assert_array_equal(result.status, np.where(bad, Status.BAD_INPUT, Status.OK))
    assert (result.joint_status[bad] == Status.BAD_INPUT).all()
    assert np.isnan(measure.gradient(q)[bad]).all()
    assert np.isnan(measure.jacobian(q)[bad]).all()
    for ask in (measure, measure.evaluate, measure.by_joint, measure.gradient, measure.jacobian):
        with pytest.raises(hf.InputError, match="NaN or infinity"):
            ask(q[1])
        with pytest.raises(hf.InputError, match="has 2 values per configuration; it must have 3"):
            ask(q[:, :2])


@pytest.mark.parametrize("name", NAMES)
def test_no_rows(name, rng):
    measure = sus.by_name(name, oracles.with_bodies(oracles.random_arm(rng, types="RRP"), rng))
    q = np.zeros((0, 3))
    result = measure.evaluate(q)
    assert (result.value.shape, result.by_joint.shape, result.joint_status.shape) == ((0,), (0, 3), (0, 3))
    assert (measure.gradient(q).shape, measure.jacobian(q).shape) == ((0, 3), (0, 3, 3))


def test_one_configuration_has_no_leading_axis(rng):
    measure = sus.torque(arms.load("planar-3r"))
    result = measure.evaluate(rng.uniform(-1, 1, 3))
    assert (np.shape(result.value), result.by_joint.shape, np.shape(result.status), result.joint_status.shape) == (
        (),
        (3,),
        (),
        (3,),
    )
    assert result.require_ok() is result


def test_arms_without_inertials_are_refused():
    arm = arms.load("pa10-9dof")
    for name in NAMES:
        with pytest.raises(hf.ArmError, match=r"'pa10-9dof', link after joint 'joint1': it has no inertial data"):
            sus.by_name(name, arm)


def test_a_measure_that_does_not_exist():
    with pytest.raises(hf.InputError, match=r"'speed' is not known; use one of torque, acceleration, swing-angle"):
        sus.by_name("speed", arms.load("planar-3r"))


def test_every_flag_has_advice():
    assert all(s.sentence and not s.sentence.endswith(".") for s in Status)


def test_how_a_measure_speaks_of_itself():
    arm = arms.load("planar-3r")
    measure = sus.swing_angle(arm, [1, 2, 3])
    assert (measure.name, measure.slug, measure.better) == ("swing angle susceptibility", "swing-angle", "smaller")
    assert (measure.unit, measure.joint_unit) == ("(rad)^2, weighted", ("rad",) * 3)
    assert "English" in measure.source
    assert measure.describe() == "swing angle susceptibility after any one joint swings free, diagonal weights"
    assert "planar-3r" in repr(measure)
    assert sus.torque(arm, "worst-case").unit == "1"
    assert sus.by_name(measure.slug, arm).slug == measure.slug
