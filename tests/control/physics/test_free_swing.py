"""Free swings against closed forms, Pinocchio's statics and inertia, and scipy's integrator."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dynamics
import holdfast as hf
import oracles
from cards import check_card
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec

G, LENGTH, MASS = 9.81, 0.7, 2.0


def pendulum(inertia: float = 0.0, **joint) -> hf.Arm:
    """A heavy point on a light rod along x, turning about -y: level at q = 0, upright at pi/2."""
    link = hf.Link(MASS, np.array([LENGTH, 0, 0]), inertia * np.eye(3))
    return hf.Arm(
        name="pendulum",
        joints=(hf.Joint("hinge", "continuous", np.eye(4), axis=np.array([0.0, -1, 0]), **joint),),
        links=(link,),
        tool=oracles.pose(None, [LENGTH, 0, 0]),
    )


def slide(lower: float, upper: float, axis=(0.0, 0, 1)) -> hf.Arm:
    joint = hf.Joint("lift", "prismatic", np.eye(4), axis=np.array(axis), lower=lower, upper=upper)
    return hf.Arm(name="slide", joints=(joint,), links=(hf.Link(MASS, np.zeros(3), np.eye(3)),))


def drawn(rng, **options) -> tuple[hf.Arm, np.ndarray]:
    arm = oracles.with_bodies(oracles.random_arm(rng, limits=3.0, **options), rng, payload=True)
    return arm, oracles.inside(arm, rng, 1)[0]


# ---- closed forms ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("q", [0.0, 1.0, -1.2, 2.5, -3.0])
def test_a_pendulum_starts_with_g_over_l_and_ends_hanging(q):
    swing = hf.free_swing(pendulum(), [q], "hinge", damping=2.0)
    assert swing.initial_acceleration == pytest.approx(-G / LENGTH * np.cos(q), rel=1e-9)
    hanging = np.arctan2(np.sin(-np.pi / 2 - q), np.cos(-np.pi / 2 - q))
    assert swing.rest_angle == pytest.approx(hanging, abs=2e-4)
    assert (swing.outcome, swing.is_settled, swing.is_at_stop) == ("rest", True, False)
    assert swing.peak >= abs(swing.rest_angle) - 1e-9
    np.testing.assert_allclose(swing.tool_position[-1], [0, 0, -LENGTH], atol=2e-4)


def test_without_friction_the_energy_stays_and_it_does_not_settle():
    swing = hf.free_swing(pendulum(), [0.0], 0, damping=0.0, duration=5.0)
    energy = 0.5 * MASS * (LENGTH * swing.velocity) ** 2 + MASS * G * swing.tool_position[:, 2]
    np.testing.assert_allclose(energy, 0, atol=1e-6)
    assert swing.outcome == "moving"
    assert np.isnan(swing.rest_angle)
    assert not swing.is_settled
    assert swing.time[-1] == pytest.approx(5.0)
    assert swing.peak == pytest.approx(np.pi, abs=1e-4)


def test_friction_without_a_word_is_a_tenth_of_critical_or_the_joint_s_own():
    critical = 2 * np.sqrt(MASS * G * LENGTH * MASS * LENGTH**2)
    options = {"brake_after": (), "duration": 0.1}
    assert hf.free_swing(pendulum(), [0.3], 0, **options).damping == pytest.approx(0.1 * critical)
    assert hf.free_swing(pendulum(friction=0.5 * critical), [0.3], 0, **options).damping == 0.5 * critical
    assert hf.free_swing(pendulum(friction=1e-3), [0.3], 0, **options).damping == pytest.approx(0.1 * critical)
    assert hf.free_swing(pendulum(friction=1e-3), [0.3], 0, damping=0.2, **options).damping == 0.2


def test_very_stiff_friction_creeps_and_does_not_blow_up():
    stiff = 2e4 * MASS * LENGTH**2
    swing = hf.free_swing(pendulum(), [0.0], 0, damping=stiff, duration=1.0)
    creep = MASS * G * LENGTH / stiff
    assert swing.angle[-1] == pytest.approx(-creep, rel=0.01)
    assert swing.outcome == "moving"


def test_the_drop_is_that_of_a_fall_and_the_brakes_stop_it_there():
    swing = hf.free_swing(pendulum(), [0.0], 0, damping=0.0, duration=1.0, brake_after=(20, 50, 1000))
    check_card(swing)
    for drop, t in zip(swing.drops[:2], (0.02, 0.05), strict=True):
        assert drop.drop == pytest.approx(G * t * t / 2, rel=1e-3)
        assert drop.distance == pytest.approx(drop.drop, rel=0.01)
        assert drop.angle == pytest.approx(-drop.drop / LENGTH, rel=1e-3)
        assert drop.speed == pytest.approx(-G * t / LENGTH, rel=1e-3)
    assert swing.drops[2].angle == pytest.approx(swing.angle[-1])


def test_a_limit_stops_it_without_rebound_when_asked_for():
    arm = pendulum()
    arm = replace(arm, joints=(replace(arm.joints[0], type="revolute", lower=-1.0, upper=1.0),))
    stopped = hf.free_swing(arm, [0.5], 0, limits=True)
    assert stopped.is_at_stop
    assert stopped.rest_angle == pytest.approx(-1.5, abs=1e-3)
    assert stopped.peak < 1.53
    assert not hf.free_swing(arm, [0.5], 0, damping=2.0).is_at_stop


@pytest.mark.parametrize(("axis", "end"), [((0.0, 0, 1), -0.3), ((0.0, 0, -1), 0.6), ((0.0, 0.6, 0.8), -0.3)])
def test_a_sliding_joint_falls_to_its_stop(axis, end):
    swing = hf.free_swing(slide(-0.2, 0.7, axis), [0.1], "lift")
    assert swing.is_at_stop
    assert swing.rest_angle == pytest.approx(end, abs=1e-4)
    assert swing.initial_acceleration == pytest.approx(-G * axis[2])
    assert swing.damping == 0


@pytest.mark.parametrize(
    ("arm", "why"),
    [
        (slide(-np.inf, np.inf, (1.0, 0, 0)), "level"),
        (replace(pendulum(), gravity=np.zeros(3)), "weightless"),
        (replace(pendulum(), gravity=np.array([0, 9.81, 0])), "gravity along the axis"),
        (replace(pendulum(), links=(hf.Link(1.0, np.array([0, 0.3, 0]), np.eye(3)),)), "mass on the axis"),
    ],
)
def test_what_gravity_does_not_move_is_balanced(arm, why):
    swing = hf.free_swing(arm, [0.2], 0)
    assert swing.outcome == "balanced", why
    assert swing.is_settled
    assert swing.initial_acceleration == 0
    assert swing.rest_angle == pytest.approx(0, abs=1e-6)
    assert all(abs(d.drop) < 1e-6 for d in swing.drops)


# ---- against Pinocchio and scipy -------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", range(8))
def test_random_arms_rest_where_the_centre_of_mass_is_lowest_and_start_as_statics_say(rng, case):
    arm, q = drawn(rng)
    k = int(rng.integers(arm.n))
    inertia = dynamics.mass_matrix(arm, q)[k, k]
    heaviness = np.abs(dynamics.gravity_torque(arm, q)[k])
    swing = hf.free_swing(arm, q, k, damping=None if arm.prismatic[k] else np.sqrt(inertia * heaviness))
    assert swing.initial_acceleration == pytest.approx(-dynamics.gravity_torque(arm, q)[k] / inertia, rel=1e-9)
    if arm.prismatic[k]:
        assert swing.is_at_stop
        end = arm.upper[k] if swing.initial_acceleration > 0 else arm.lower[k]
        assert swing.rest_angle == pytest.approx(end - q[k], abs=1e-4)
    else:
        assert swing.rest_angle == pytest.approx(dynamics.swing_angle(arm, q, k), abs=3e-4)
    held = np.tile(q, (len(swing.time), 1))
    held[:, k] += swing.angle
    np.testing.assert_allclose(swing.tool_position, arm.forward_kinematics(held)[:, :3, 3], atol=1e-10)


@pytest.mark.parametrize("name", ["panda", "xarm7", "planar-3r"])
def test_built_in_arms_rest_where_the_centre_of_mass_is_lowest(name, rng):
    arm = hf.arms.load(name)
    q = np.array(hf.arms.about(name).home) + rng.uniform(-0.3, 0.3, arm.n)
    tau, inertia = dynamics.gravity_torque(arm, q), dynamics.mass_matrix(arm, q).diagonal()
    for k in rng.choice(arm.n, 2, replace=False):
        # A vertical first axis is balanced; Pinocchio calls its torque rounding noise too.
        swing = hf.free_swing(arm, q, int(k), damping=1.2 * np.sqrt(inertia[k] * max(abs(tau[k]), 0.05)))
        assert swing.initial_acceleration == pytest.approx(-tau[k] / inertia[k], rel=1e-6, abs=1e-9)
        if swing.outcome == "rest":
            assert np.degrees(swing.rest_angle) == pytest.approx(np.degrees(dynamics.swing_angle(arm, q, int(k))), abs=0.5)
        else:
            assert abs(tau[k]) < 1e-9


def test_the_motion_is_that_of_an_independent_integrator(rng):
    arm, q = drawn(rng, types="RPRR")
    inertia, damping = dynamics.mass_matrix(arm, q)[2, 2], 0.3
    unit = np.eye(4)[2]

    def rate(_, state):
        torque = dynamics.gravity_torque(arm, q + state[0] * unit)[2]
        return [state[1], (-torque - damping * state[1]) / inertia]

    swing = hf.free_swing(arm, q, 2, damping=damping, duration=2.0)
    expected = solve_ivp(rate, (0, 2.0), [0, 0], t_eval=swing.time[::50], rtol=1e-9, atol=1e-10).y
    np.testing.assert_allclose(swing.angle[::50], expected[0], atol=1e-6)
    np.testing.assert_allclose(swing.velocity[::50], expected[1], atol=1e-5)


def test_a_swing_below_a_joint_that_is_slid_out_is_that_of_an_integrator(rng):
    """The joint that lets go carries sliding ones; its inertia and torque are Pinocchio's at where they stand."""
    arm, q = drawn(rng, types="RPPR")
    unit = np.eye(4)[0]
    inertia, damping = dynamics.mass_matrix(arm, q)[0, 0], 0.4

    def rate(_, state):
        return [state[1], (-dynamics.gravity_torque(arm, q + state[0] * unit)[0] - damping * state[1]) / inertia]

    swing = hf.free_swing(arm, q, 0, damping=damping, duration=1.5)
    expected = solve_ivp(rate, (0, 1.5), [0, 0], t_eval=swing.time[::50], rtol=1e-9, atol=1e-10).y
    np.testing.assert_allclose(swing.angle[::50], expected[0], atol=1e-6)
    np.testing.assert_allclose(swing.velocity[::50], expected[1], atol=1e-5)


def test_a_sliding_joint_in_a_chain_falls_in_closed_form_until_its_stop(rng):
    """Force and mass are constant along a slide: v = F/c (1 - exp(-c t/m)); F is the weight of all it carries."""
    arm, q = drawn(rng, types="RPRR")
    chain = oracles.forward(
        replace(arm, joints=arm.joints[:2], links=arm.links[:2], tool=np.eye(4), payload=None), q[None, :2]
    )[0]
    mass = sum(link.mass for link in arm.links[1:]) + arm.payload.mass
    axis = chain[:3, :3] @ arm.joints[1].axis
    force, damping = mass * float(arm.gravity @ axis), 1.5 * mass
    swing = hf.free_swing(arm, q, 1, damping=damping, duration=1.0)
    final, rate = force / damping, damping / mass
    t = swing.time
    expected = final * (t - (1 - np.exp(-rate * t)) / rate)
    room = np.clip(expected, arm.lower[1] - q[1], arm.upper[1] - q[1])
    free = (room == expected) & (np.abs(expected - room[-1]) > 1e-3)
    assert free.sum() > 5
    np.testing.assert_allclose(swing.angle[free], expected[free], atol=1e-5)
    np.testing.assert_allclose(swing.velocity[free], (final * (1 - np.exp(-rate * t)))[free], atol=1e-4)


def test_the_model_with_all_joints_free_is_the_arm(rng):
    import mujoco

    arm, q = drawn(rng, types="RPRCRP")
    free = range(arm.n)
    model = build_mujoco_spec(arm, np.zeros(arm.n), free).compile()
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    matrix = np.zeros((arm.n, arm.n))
    for k, unit in enumerate(np.eye(arm.n)):
        mujoco.mj_mulM(model, data, matrix[k], unit)
    np.testing.assert_allclose(matrix, dynamics.mass_matrix(arm, q), rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(data.qfrc_bias, dynamics.gravity_torque(arm, q), rtol=1e-9, atol=1e-9)
    pose = arm.forward_kinematics(q)
    np.testing.assert_allclose(data.site("tool").xpos, pose[:3, 3], atol=1e-12)
    np.testing.assert_allclose(data.site("tool").xmat.reshape(3, 3), pose[:3, :3], atol=1e-12)


def test_massless_links_between_joints_are_welcome(rng):
    arm, q = drawn(rng, types="RRR")
    light = replace(arm, links=(arm.links[0], hf.Link(0.0, np.zeros(3), np.zeros((3, 3))), arm.links[2]))
    for k in range(3):
        swing = hf.free_swing(light, q, k, duration=0.05, brake_after=())
        expected = -dynamics.gravity_torque(light, q)[k] / dynamics.mass_matrix(light, q)[k, k]
        assert swing.initial_acceleration == pytest.approx(expected, rel=1e-8)


# ---- sentences -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"q": [np.nan]}, "holds NaN"),
        ({"q": [[0.0]]}, "one configuration"),
        ({"q": [0.0, 0.0]}, "it must have 1"),
        ({"joint": "elbow"}, "no joint 'elbow'"),
        ({"damping": -1.0}, "damping is -1"),
        ({"damping": np.inf}, "damping is inf"),
        ({"duration": 0.0}, "duration is 0 s"),
        ({"duration": 1e-4}, "shorter than one step"),
        ({"step": 0.0}, "step is 0 s"),
        ({"step": 0.1}, "at most 0.02 s"),
        ({"brake_after": (-1.0,)}, "brake_after holds -1"),
        ({"brake_after": (500.0,), "duration": 0.4}, "after the end of the simulation at 0.4 s"),
    ],
)
def test_wrong_input_is_answered_with_a_sentence(options, sentence):
    with pytest.raises(hf.InputError, match=sentence):
        hf.free_swing(**({"arm": pendulum(), "q": [0.0], "joint": 0} | options))


def test_arms_that_cannot_swing_are_refused():
    with pytest.raises(hf.ArmError, match="link after joint 'joint1': it has no inertial data"):
        hf.free_swing(hf.arms.load("pa10-7dof"), np.zeros(7), 3)
    with pytest.raises(hf.ArmError, match="has no lower limit, towards which gravity moves it"):
        hf.free_swing(slide(-np.inf, 1.0), [0.0], 0)
    with pytest.raises(hf.ArmError, match="nothing that it carries has mass"):
        hf.free_swing(replace(pendulum(), links=(hf.Link(0.0, np.zeros(3), np.zeros((3, 3))),)), [0.0], 0)
    with pytest.raises(hf.ArmError, match="lies on its axis and has no inertia about it"):
        hf.free_swing(replace(pendulum(), links=(hf.Link(1.0, np.array([0, 0.3, 0]), np.zeros((3, 3))),)), [0.0], 0)
    arm = slide(-1.0, 1.0)
    with pytest.raises(hf.InputError, match="outside its limits -1 to 1"):
        hf.free_swing(arm, [2.0], 0)


def test_without_mujoco_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(hf.HoldfastError, match=r"holdfast-arms\[physics\]"):
        hf.free_swing(pendulum(), [0.0], 0)
