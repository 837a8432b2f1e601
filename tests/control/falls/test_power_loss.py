"""Falls against closed forms, an event-driven reference, MuJoCo, and scipy; properties; bad inputs."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import dynamics
import holdfast as hf
import oracles
from fall_reference import Reference
from falling_arms import FREE, LENGTH, MASS, WEIGHT, G, lift, pendulum
from holdfast.control.falls import FallOutcome


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


def panda_rows(arm, rng, count):
    return rng.uniform(arm.lower, arm.upper, (count, arm.n))


# ---- closed forms ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("amplitude", [0.3, 2.0, 3.0])
def test_the_period_of_a_pendulum(amplitude):
    period = 4 * np.sqrt(LENGTH / G) * ellipk(np.sin(amplitude / 2) ** 2)
    fall = hf.power_loss(pendulum(), [amplitude - np.pi / 2], friction=FREE, duration=period, step=1e-3)
    angle, rate = fall.q_at(0.75 * period)[0] + np.pi / 2, fall.rates_at(0.75 * period)[0]
    assert abs(angle / rate) <= 1e-6 * period
    assert fall.outcome == "moving"
    assert abs(fall.released) < 1e-6


def test_a_pendulum_with_coulomb_friction_stops_where_its_energy_is_used_up():
    coulomb, rate = 0.2 * WEIGHT, -1.5
    friction = hf.Friction(coulomb=coulomb, stiction=2 * WEIGHT, viscous=0.0)
    fall = hf.power_loss(pendulum(), [1.2 - np.pi / 2], [rate], friction=friction)
    turned, kinetic = -float(fall.q_final[0] + np.pi / 2), MASS * (LENGTH * rate) ** 2 / 2
    dissipated = coulomb * (1.2 + turned)
    assert kinetic + WEIGHT * (np.cos(turned) - np.cos(1.2)) == pytest.approx(dissipated, abs=1e-4 * WEIGHT)
    assert fall.outcome == "rest"
    assert fall.released == pytest.approx(dissipated, rel=1e-4)


def test_without_more_stiction_the_same_pendulum_swings_on():
    friction = hf.Friction(coulomb=0.2 * WEIGHT, viscous=0.0)
    fall = hf.power_loss(pendulum(), [1.2 - np.pi / 2], friction=friction, duration=10.0)
    assert fall.outcome == "rest"
    assert abs(np.sin(fall.q_final[0] + np.pi / 2)) <= 0.2
    assert fall.rest_time > 0.7


def test_a_slide_falls_with_dry_and_viscous_friction():
    dry, viscous = 5.0, 3.0
    friction = hf.Friction(coulomb=dry, viscous=viscous)
    fall = hf.power_loss(lift(), [0.0], friction=friction, step=1e-3, duration=1.0)
    time = np.array([0.1, 0.35, 1.0])
    limit, decay = (MASS * G - dry) / viscous, np.exp(-viscous / MASS * time)
    np.testing.assert_allclose(fall.drop_at(time), limit * (time - MASS / viscous * (1 - decay)), atol=1e-6)
    np.testing.assert_allclose(fall.rates_at(time)[:, 0], -limit * (1 - decay), atol=1e-6)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_rebounds_reach_the_square_of_restitution(restitution):
    height = 0.4
    first = np.sqrt(2 * height / G)
    fall = hf.power_loss(lift(lower=0.0), [height], friction=FREE, restitution=restitution, duration=6 * first)
    peak = first * (1 + restitution)
    assert fall.q_at(peak)[0] == pytest.approx(restitution**2 * height, abs=1e-6)
    second = peak + restitution * first + restitution**2 * first
    assert fall.q_at(second)[0] == pytest.approx(restitution**4 * height, abs=1e-6)
    assert fall.drop == pytest.approx(height, abs=1e-8)
    assert fall.outcome == ("moving" if restitution == 1 else "rest")


def test_load_and_stiction_decide_whether_a_joint_holds():
    torque = WEIGHT * np.cos(0.4)
    for load in (0.0, 0.3):
        for factor, outcome in ((1.001, "holds"), (0.999, "moving")):
            stiction = factor * torque * (1 - load)
            friction = hf.Friction(coulomb=0.0, stiction=stiction, viscous=0.0, load=load)
            fall = hf.power_loss(pendulum(), [0.4], friction=friction, duration=0.2)
            assert fall.outcome == outcome
            assert (fall.drop > 1e-3) == (outcome == "moving")


def test_brakes_act_after_their_delay_and_with_their_torque():
    delay, force = 0.1, 3 * MASS * G
    fall = hf.power_loss(lift(), [0.0], friction=FREE, brakes=hf.Brakes(after=delay, torque=force), duration=0.5)
    until_stop = G * delay / (force / MASS - G)
    assert fall.rest_time == pytest.approx(delay + until_stop, abs=1e-9)
    assert fall.drop == pytest.approx(G * delay * (delay + until_stop) / 2, abs=1e-9)
    weak = hf.power_loss(lift(), [0.0], friction=FREE, brakes=hf.Brakes(after=delay, torque=0.5 * MASS * G), duration=0.5)
    assert weak.rates_final[0] == pytest.approx(-G * (delay + 0.5 * 0.4), rel=1e-9)
    damped = hf.power_loss(lift(), [0.0], friction=FREE, brakes=hf.Brakes(after=0.1, torque=0.0, damping=400.0), duration=0.5)
    assert damped.rates_final[0] == pytest.approx(-MASS * G / 400.0, rel=1e-6)


def test_a_double_pendulum_in_absolute_angles():
    joint = {"type": "continuous", "axis": np.array([0.0, -1, 0])}
    lengths, masses = np.array([0.5, 0.4]), np.array([1.5, 0.8])
    arm = hf.Arm(
        name="double pendulum",
        joints=(hf.Joint("a", origin=np.eye(4), **joint), hf.Joint("b", origin=oracles.pose(None, [0.5, 0, 0]), **joint)),
        links=tuple(hf.Link(m, np.array([length, 0, 0]), np.zeros((3, 3))) for m, length in zip(masses, lengths, strict=True)),
    )

    def rates(_, y):  # absolute angles above the horizontal
        a, b, wa, wb = y
        total, coupling = masses.sum(), masses[1] * np.prod(lengths)
        inertia = np.array(
            [[total * lengths[0] ** 2, coupling * np.cos(a - b)], [coupling * np.cos(a - b), masses[1] * lengths[1] ** 2]]
        )
        force = -np.array(
            [
                coupling * wb**2 * np.sin(a - b) + total * G * lengths[0] * np.cos(a),
                -coupling * wa**2 * np.sin(a - b) + masses[1] * G * lengths[1] * np.cos(b),
            ]
        )
        return [wa, wb, *np.linalg.solve(inertia, force)]

    end = solve_ivp(rates, (0, 0.8), [0.3, 1.1, 0.5, -2.5], "DOP853", rtol=1e-11, atol=1e-11).y[:2, -1]
    for friction in (FREE, hf.Friction(coulomb=1e-12, viscous=0.0)):  # the smooth kernel, and the steps with dry friction
        fall = hf.power_loss(
            arm, [0.3, 0.8], [0.5, -3.0], friction=friction, duration=0.8, step=1e-3 if friction is FREE else 1e-4
        )
        np.testing.assert_allclose(np.cumsum(fall.q_final), end, atol=1e-4)


# ---- other simulators ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("types", ["RRR", "RPR", "PRR"])
def test_random_arms_fall_as_the_event_driven_reference(rng, types):
    arm = oracles.with_bodies(oracles.random_arm(rng, types=types, limits=1.5), rng, payload=True, armature=True)
    arm = replace(arm, gravity=9.81 * arm.gravity / np.linalg.norm(arm.gravity))
    coulomb = rng.uniform(0.1, 1.0, 3)
    numbers = {"coulomb": coulomb, "stiction": coulomb * rng.uniform(1.0, 2.5, 3), "load": [0.1, 0.0, 0.05]}
    numbers |= {"viscous": rng.uniform(0.0, 0.5, 3)}
    brake = (0.12, rng.uniform(1.0, 6.0, 3), np.array([0.0, 0.5, 1.0]))
    restitution = float(rng.choice([0.0, 0.4]))
    reference = Reference(arm, restitution=restitution, brake=brake, **numbers)
    starts, rates = oracles.inside(arm, rng, 4), rng.normal(size=(4, 3))
    starts[0], rates[:2] = np.where(rng.random(3) < 0.5, arm.lower, starts[0]), 0.0
    fall = hf.power_loss(
        arm,
        starts,
        rates,
        friction=hf.Friction(**numbers),
        brakes=hf.Brakes(after=brake[0], torque=brake[1], damping=brake[2]),
        restitution=restitution,
        duration=0.3,
        step=5e-4,
    )
    times = np.array([0.05, 0.12, 0.3])
    expected = np.array([reference.run(q, v, times)[0] for q, v in zip(starts, rates, strict=True)])
    np.testing.assert_allclose(fall.q_at(times), expected, atol=2e-4)
    assert (fall.residual == 0).all()


def test_the_panda_falls_as_the_reference_and_smaller_steps_are_better(panda):
    rows = panda_rows(panda, np.random.default_rng(1), 4)
    numbers = {"coulomb": 0.3, "stiction": 0.5, "viscous": 0.1}
    reference = Reference(panda, **numbers)
    times = [0.1, 0.3]
    expected = np.array([[reference.tool_at(q) for q in reference.run(row, np.zeros(7), times)[0]] for row in rows])
    errors = []
    for step in (8e-3, 2e-3):
        fall = hf.power_loss(panda, rows, friction=hf.Friction(**numbers), duration=0.3, step=step)
        errors.append(np.median(np.linalg.norm(fall.tool_at(times) - expected, axis=2), axis=0))
    assert (errors[1] <= [1e-5, 2e-4]).all()
    assert (errors[1] < errors[0] / 4).all()


def test_without_dry_friction_and_stops_the_panda_falls_as_in_mujoco(panda):
    rows = panda_rows(panda, np.random.default_rng(2), 3)
    fall = hf.power_loss(panda, rows, friction=hf.Friction(viscous=0.5), stops=False, duration=0.3, step=2e-3)
    model = replace(panda.without_limits, joints=tuple(replace(j, friction=0.5) for j in panda.without_limits.joints))
    compiled = model.to_mujoco().compile()
    compiled.opt.timestep, compiled.opt.integrator = 5e-4, mujoco.mjtIntegrator.mjINT_RK4
    for row, end in zip(rows, fall.q_final, strict=True):
        data = mujoco.MjData(compiled)
        data.qpos[:] = row
        for _ in range(600):
            mujoco.mj_step(compiled, data)
        np.testing.assert_allclose(end, data.qpos, atol=2e-6)


# ---- laws ------------------------------------------------------------------------------------------------------------


def test_energy_is_kept_without_friction_and_used_up_with_it(panda):
    rows = panda_rows(panda, np.random.default_rng(3), 6)
    fall = hf.power_loss(panda, rows, friction=FREE, stops=False, duration=0.3)
    kinetic = [v @ dynamics.mass_matrix(panda, q) @ v / 2 for q, v in zip(fall.q_final, fall.rates_final, strict=True)]
    np.testing.assert_allclose(fall.released, kinetic, rtol=1e-5, atol=1e-6)
    dry = hf.power_loss(panda, rows, friction=hf.Friction(coulomb=0.5, viscous=0.1), duration=0.3)
    kinetic = [v @ dynamics.mass_matrix(panda, q) @ v / 2 for q, v in zip(dry.q_final, dry.rates_final, strict=True)]
    assert (dry.released > kinetic).all()
    assert ((dry.q_final >= panda.lower) & (dry.q_final <= panda.upper)).all()


def test_neither_the_frame_nor_the_unit_of_mass_changes_a_fall(rng, panda):
    row, turn = panda_rows(panda, rng, 1)[0], oracles.random_pose(rng)
    numbers = {"coulomb": 0.3, "stiction": 0.6, "viscous": 0.2}
    fall = hf.power_loss(panda, row, friction=hf.Friction(**numbers), duration=0.2)
    turned = replace(panda, base=turn @ panda.base, gravity=turn[:3, :3] @ panda.gravity)
    twin = hf.power_loss(turned, row, friction=hf.Friction(**numbers), duration=0.2)
    np.testing.assert_allclose(twin.q_final, fall.q_final, atol=1e-8)
    assert twin.drop == pytest.approx(fall.drop, abs=1e-8)


def test_rows_do_not_depend_on_their_neighbours(panda):
    rows = panda_rows(panda, np.random.default_rng(4), 9)
    friction = hf.Friction(coulomb=0.3, viscous=0.1)
    fall = hf.power_loss(panda, rows, friction=friction, duration=0.2)
    alone = hf.power_loss(panda, rows[5], friction=friction, duration=0.2)
    for name in ("q_final", "rates_final", "drop", "released", "error"):
        np.testing.assert_array_equal(getattr(alone, name), getattr(fall, name)[5])
    np.testing.assert_array_equal(fall.q_at(0.2), fall.q_final)
    np.testing.assert_array_equal(fall.q_at([0.0, 0.2])[:, 0], rows)
    assert (fall.q_at(0.1).shape, fall.q_at([0.1]).shape, alone.q_at(0.1).shape) == ((9, 7), (9, 1, 7), (7,))
    assert (fall.drop_at([0.1, 0.2]).max(axis=1) <= fall.drop + 1e-12).all()
    assert len(fall) == 9
    damaged = rows.copy()
    damaged[2, 3] = np.nan
    other = hf.power_loss(panda, damaged, friction=friction, duration=0.2)
    np.testing.assert_array_equal(np.delete(other.q_final, 2, axis=0), np.delete(fall.q_final, 2, axis=0))
    assert (other.status[2], other.code[2]) == (hf.Status.BAD_INPUT, FallOutcome.UNKNOWN)
    assert np.isnan([other.drop[2], other.drop_at(0.1)[2], other.error[2]]).all()
    with pytest.raises(hf.HoldfastError, match="row 2, bad_input"):
        other.require_ok()
    assert fall.require_ok() is fall


def test_nothing_moves_within_the_inequalities_of_statics(panda):
    rows = panda_rows(panda, np.random.default_rng(5), 60)
    rows[::3, 1] = panda.upper[1]
    torque = np.array([dynamics.gravity_torque(panda, row) for row in rows])
    stiction = np.array([1.0, 40.0, 6.0, 15.0, 1.5, 1.5, 0.5])
    need = np.where(rows >= panda.upper, torque, np.abs(torque))
    fall = hf.power_loss(panda, rows, friction=hf.Friction(coulomb=0.0, stiction=stiction), duration=0.01)
    holds = (need <= stiction).all(axis=1)
    assert 0 < holds.sum() < len(rows)
    np.testing.assert_array_equal(fall.outcome == "holds", holds)
    np.testing.assert_array_equal(np.abs(fall.q_final - rows).max(axis=1) == 0, holds)
    assert (fall.rest_time[holds] == 0).all()


def test_what_holds_does_not_fall_and_everything_else_does(panda):
    """No contradiction where the margin is not rounding; every fourth joint is at a limit."""
    rng = np.random.default_rng(8)
    rows = panda_rows(panda, rng, 3_000)
    draw = rng.random(rows.shape)
    rows = np.where(draw < 0.12, panda.lower, np.where(draw > 0.88, panda.upper, rows))
    friction = hf.Friction(coulomb=[0.5, 40.0, 8.0, 16.0, 1.5, 1.5, 0.2], load=0.1)
    check = hf.holds(panda, rows, friction=friction)
    fall = hf.power_loss(panda, rows, friction=friction, duration=0.01)
    clear = np.abs(check.margin) > 1e-6
    moved = (fall.q_final != rows).any(axis=1)
    assert clear.sum() > 2_900
    assert 0.1 < check.holds.mean() < 0.9
    np.testing.assert_array_equal(moved[clear], ~check.holds[clear])
    np.testing.assert_array_equal((fall.outcome == "holds")[clear], check.holds[clear])


def test_the_error_covers_the_true_error_and_the_orders_are_two_and_four(panda):
    rows = panda_rows(panda, np.random.default_rng(9), 150)
    friction = hf.Friction(coulomb=[0.5] * 4 + [0.3] * 3, viscous=0.1)
    medians = {}
    for stops, model, fine, steps in ((True, friction, 2.5e-4, (8e-3, 4e-3)), (False, FREE, 6.25e-4, (1e-2, 5e-3))):
        true = hf.power_loss(panda, rows, friction=model, stops=stops, duration=0.3, step=fine).tool_at(0.3)
        for step in steps:
            fall = hf.power_loss(panda, rows, friction=model, stops=stops, duration=0.3, step=step)
            distance = np.linalg.norm(fall.tool_at(0.3) - true, axis=1)
            medians[stops, step] = np.median(distance)
            assert np.mean(fall.error >= distance) >= 0.9
            assert (fall.residual == 0).all()
    assert medians[True, 8e-3] > 2.5 * medians[True, 4e-3]
    assert medians[False, 1e-2] > 12 * medians[False, 5e-3]


def test_the_first_hundred_milliseconds_are_the_closed_form(panda):
    rows = panda_rows(panda, np.random.default_rng(10), 1_000)
    fall = hf.power_loss(panda, rows, friction=FREE, stops=False, duration=0.1)
    closed_form = hf.susceptibility.tool_drop(panda)(rows) * 0.1**2 / 2
    drop = fall.drop_at(0.1)
    assert np.median(np.abs(closed_form - drop) / np.abs(drop)) <= 0.02


def test_accuracy_halves_the_step_where_it_must(panda):
    rows = panda_rows(panda, np.random.default_rng(7), 5)
    friction = hf.Friction(coulomb=0.3, viscous=0.1)
    plain = hf.power_loss(panda, rows, friction=friction, duration=0.3, step=8e-3)
    bound = float(np.median(plain.error))
    fall = hf.power_loss(panda, rows, friction=friction, duration=0.3, step=8e-3, accuracy=bound)
    np.testing.assert_array_equal(fall.step < 8e-3, plain.error > bound)
    assert (fall.error <= bound).all()
    hopeless = hf.power_loss(panda, rows[0], friction=friction, duration=0.1, step=8e-3, accuracy=1e-15)
    assert hopeless.status == hf.Status.INACCURATE
    assert hopeless.step == pytest.approx(8e-3 / 64)


def test_falls_end_where_a_joint_stops_beside_its_stop(panda):
    """The steps of these falls once became ever shorter; 1 fall in 10,000 is like them."""
    rows = [
        [-2.07932676, -0.02085436, -2.15103158, -0.64405455, 1.74357031, 0.09243751, -1.79590587],
        [1.03287301, -0.68334807, -2.49195023, -2.4300044, 1.46094874, 0.94323358, 0.62050673],
        [1.67830425, -0.25566808, 0.14150674, -0.59716354, 1.88880766, 3.45702433, -2.61340984],
    ]
    friction = hf.Friction(coulomb=[0.5] * 4 + [0.3] * 3, viscous=0.1)
    fall = hf.power_loss(panda, rows, friction=friction, duration=1.0, step=4e-3).require_ok()
    assert np.isfinite(fall.error).all()
    assert (fall.residual == 0).all()


def test_held_joints_stay_where_they_are_also_outside_their_limits(panda):
    q = np.array([0.0, 0.1, 0.0, panda.upper[3] + 0.1, 0.0, 1.0, 0.0])
    fall = hf.power_loss(panda, q, free=[1], friction=hf.Friction(coulomb=0.1), duration=0.1)
    assert (np.delete(fall.q_final, 1) == np.delete(q, 1)).all()
    assert fall.q_final[1] != q[1]


def test_an_empty_batch_has_empty_results(panda):
    fall = hf.power_loss(panda, np.empty((0, 7)), duration=0.1)
    assert fall.drop.shape == (0,)
    assert fall.q_at(0.05).shape == (0, 7)


# ---- bad inputs ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"free": []}, "no joint of 'panda' is named"),
        ({"free": ["wrist"]}, "wrist"),
        ({"free": "8"}, "joint 8 is out of range"),
        ({"q": [0.0, 3.0, 0, -1, 0, 1, 0]}, r"q puts joint 'panda_joint2' 1\.\d+ rad outside its limits"),
        ({"q": [0.0] * 6}, "q for 'panda' has 6 values"),
        ({"q": [np.nan] * 7}, "NaN"),
        ({"rates": [0.0] * 6}, "rates has shape"),
        ({"rates": [np.inf] * 7}, "rates for 'panda' holds NaN or infinity"),
        ({"rates": [1.0] + [0.0] * 6, "free": [1]}, "rates moves joint 'panda_joint1' at 1 rad/s, which is held"),
        ({"friction": {"coulomb": -0.1}}, "coulomb friction of joint 'panda_joint1' is -0.1"),
        ({"friction": {"coulomb": [0.1, 0.2]}}, "coulomb friction has shape"),
        ({"friction": {"coulomb": 0.3, "stiction": 0.2}}, "stiction of joint 'panda_joint1' is 0.2, below"),
        ({"friction": {"viscous": np.nan}}, "viscous friction of joint 'panda_joint1' is nan"),
        ({"friction": {"load": 1.0}}, "load fraction of friction of joint 'panda_joint1' is 1"),
        ({"brakes": {"after": -0.1, "torque": 1.0}}, "after is -0.1 s"),
        ({"brakes": {"after": 0.1, "torque": -1.0}}, "brake torque of joint 'panda_joint1' is -1"),
        ({"restitution": 1.5}, "restitution is 1.5"),
        ({"duration": 0.0}, "duration is 0 s"),
        ({"duration": np.inf}, "duration is inf"),
        ({"step": 0.05}, "step is 0.05 s"),
        ({"accuracy": 0.0}, "accuracy is 0 m"),
    ],
)
def test_wrong_arguments_are_named(panda, options, message):
    given = {"q": [0.0, 0.1, 0, -1, 0, 1, 0], **options}
    if "friction" in given:
        given["friction"] = hf.Friction(**given["friction"])
    if "brakes" in given:
        given["brakes"] = hf.Brakes(**given["brakes"])
    with pytest.raises(hf.InputError, match=message):
        hf.power_loss(panda, **given)


def test_impossible_arms_and_times_are_named(panda):
    massless = replace(pendulum(), links=(hf.Link(1.0, np.zeros(3), np.zeros((3, 3))),))
    with pytest.raises(hf.ArmError, match="joint 'hinge': its links have no inertia"):
        hf.power_loss(massless, [0.0])
    with pytest.raises(hf.ArmError, match="no inertial data"):
        hf.power_loss(replace(pendulum(), links=(None,)), [0.0])
    fall = hf.power_loss(pendulum(), [0.0], duration=0.1)
    for time in (-0.1, 0.2, np.nan):
        with pytest.raises(hf.InputError, match=r"from 0 to the duration, 0\.1 s"):
            fall.q_at(time)


def test_strong_viscous_friction_does_not_make_the_steps_diverge():
    arm = hf.arms.load("xarm7")
    q = (arm.lower + arm.upper) / 2
    friction = hf.Friction(coulomb=0.0, viscous=30.0)
    fall = hf.power_loss(arm, q, friction=friction, stops=False, duration=0.5)
    fine = hf.power_loss(arm, q, friction=friction, stops=False, duration=0.5, step=1e-4)
    assert fall.status == hf.Status.OK
    np.testing.assert_allclose(fall.q_final, fine.q_final, atol=1e-4)
