"""The loop with bodies and motors against Pinocchio's dynamics, the kinematic loop and the published cases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from scipy.integrate import solve_ivp

import dynamics
import holdfast as hf
import oracles
from cards import check_card
from holdfast.control.physics.loop import _classify_unfinished_run
from holdfast.control.physics.robot import ServoRobot
from holdfast.control.physics.servos import max_reference_offsets
from holdfast.core.errors import ArmError, InputError
from holdfast.interface.presentation.renderers import present

RAD = np.deg2rad


@pytest.fixture(scope="module")
def panda() -> hf.Arm:
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def home() -> np.ndarray:
    return np.array(hf.arms.about("panda").home)


@pytest.fixture(scope="module")
def law(panda):
    return hf.control.pseudoinverse(panda, "position", gain=2.0, speed_limit=0.1)


@pytest.fixture(scope="module")
def goal(panda, home):
    return panda.forward_kinematics(home)[:3, 3] + [0.05, 0.1, -0.1]


@pytest.fixture(scope="module")
def two():
    return hf.control.pseudoinverse(hf.arms.load("planar-2r"), "planar")


# ---- another route to the same motion ------------------------------------------------------------------------------


def by_pinocchio(arm, law, run, target, time, lock):
    """The same servos on Pinocchio's dynamics and scipy's integrator; one joint locks at a control cycle's time."""
    model, _, _ = dynamics.to_pinocchio(arm)
    q, v, reference = run.q[0].copy(), np.zeros(arm.n), run.q[0].copy()
    period, friction = 1 / run.servos.rate, np.array([j.friction for j in arm.joints])
    lead = max_reference_offsets(arm, run.stiffness)
    free, path = np.arange(arm.n), [q.copy()]
    data = model.createData()
    for k in range(round(time / period)):
        if k == round(lock[1] / period):
            m = dynamics.mass_matrix(arm, q)
            free = np.delete(np.arange(arm.n), lock[0])
            v[free], v[lock[0]] = np.linalg.solve(m[np.ix_(free, free)], (m @ v)[free]), 0.0
        e = target - oracles.forward(arm, q[None])[0, :3, 3]
        rates = np.linalg.pinv(oracles.jacobian(arm, q[None])[0, :3]) @ (law.gain * e)
        reference = np.clip(reference + period * rates, q - lead, q + lead)

        def slope(_, y, free=free, wanted=reference, rates=rates):
            position, speed = y[: arm.n], y[arm.n :]
            weight = run.servos.compensation * pin.computeGeneralizedGravity(model, data, position)
            torque = run.stiffness * (wanted - position) + run.damping * (rates - speed) + weight - friction * speed
            m = np.triu(pin.crba(model, data, position))
            m = m + np.triu(m, 1).T
            left = torque - pin.nonLinearEffects(model, data, position, speed)
            acceleration = np.zeros(arm.n)
            acceleration[free] = np.linalg.solve(m[np.ix_(free, free)], left[free])
            return np.concatenate([speed, acceleration])

        end = solve_ivp(slope, (0, period), np.concatenate([q, v]), rtol=1e-7, atol=1e-10).y[:, -1]
        q, v = end[: arm.n], end[arm.n :]
        path.append(q.copy())
    return np.array(path)


def test_the_motion_is_that_of_another_simulator(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RPRR", limits=2.0), rng, payload=True, armature=True)
    arm = replace(arm, joints=tuple(replace(j, friction=0.3) for j in arm.joints))
    q0 = oracles.inside(arm, rng, 1)[0]
    law = hf.control.pseudoinverse(arm, "position")
    target = oracles.forward(arm, q0[None])[0, :3, 3] + 0.2 * rng.normal(size=3)
    servos = hf.Servos(bandwidth=4.0, ratio=1.2, rate=100.0, compensation=0.9, step=1e-4)
    run = hf.simulate_physics(law, q0, target, locked=[2], servos=servos, time_limit=0.6, time=0.3)
    expected = by_pinocchio(arm, law, run, target, 0.6, (2, 0.3))
    moved = np.abs(expected - q0).max()
    np.testing.assert_allclose(run.q[: len(expected)], expected, atol=1e-3 * moved + 1e-6)
    assert moved > 1e-3


def test_two_links_move_as_the_textbook_says():
    """Mass matrix, Coriolis and gravity terms of a planar 2R arm written out, the same servos, and a joint that locks."""
    l1, l2, c1, c2, m1, m2, i1, i2, g = 0.6, 0.5, 0.25, 0.2, 3.0, 2.0, 0.08, 0.05, 9.81
    turn = np.array([0.0, 0, 1])
    arm = hf.Arm(
        name="two links",
        joints=(
            hf.Joint("first", "continuous", np.eye(4), axis=turn),
            hf.Joint("second", "continuous", oracles.pose(position=[l1, 0, 0]), axis=turn),
        ),
        links=(hf.Link(m1, np.array([c1, 0, 0]), i1 * np.eye(3)), hf.Link(m2, np.array([c2, 0, 0]), i2 * np.eye(3))),
        tool=oracles.pose(position=[l2, 0, 0]),
        gravity=np.array([0, -g, 0]),
    )
    law = hf.control.pseudoinverse(arm, "planar", gain=1.5)
    q, target = np.array([0.4, 1.1]), np.array([-0.2, 0.7])
    servos = hf.Servos(bandwidth=3.0, ratio=1.0, rate=50.0, compensation=0.8, step=1e-4)
    run = hf.simulate_physics(law, q, target, locked=[1], servos=servos, time_limit=0.6, time=0.3)
    period, lead = 1 / 50.0, max_reference_offsets(arm, run.stiffness)
    v, reference, path = np.zeros(2), q.copy(), [q.copy()]

    def matrix(second: float) -> np.ndarray:
        off = i2 + m2 * (c2**2 + l1 * c2 * np.cos(second))
        first = i1 + m1 * c1**2 + i2 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * np.cos(second))
        return np.array([[first, off], [off, i2 + m2 * c2**2]])

    def weight(at: np.ndarray) -> np.ndarray:
        far = m2 * c2 * g * np.cos(at.sum())
        return np.array([(m1 * c1 + m2 * l1) * g * np.cos(at[0]) + far, far])

    for k in range(30):
        moves = np.array([1.0, 0.0 if k >= 15 else 1.0])
        if k == 15:
            m = matrix(q[1])
            v = np.array([(m @ v)[0] / m[0, 0], 0.0])
        rates = np.linalg.solve(oracles.planar_jacobian([l1, l2], q), 1.5 * (target - oracles.planar_hand([l1, l2], q)))
        reference = np.clip(reference + period * rates, q - lead, q + lead)

        def slope(_, y, wanted=reference, rates=rates, moves=moves):
            at, speed = y[:2], y[2:]
            h = m2 * l1 * c2 * np.sin(at[1])
            coriolis = np.array([-h * speed[1] * (2 * speed[0] + speed[1]), h * speed[0] ** 2])
            torque = run.stiffness * (wanted - at) + run.damping * (rates - speed) + 0.8 * weight(at)
            left, m = torque - coriolis - weight(at), matrix(at[1])
            if moves[1]:
                return np.concatenate([speed, np.linalg.solve(m, left)])
            return np.array([speed[0], 0.0, left[0] / m[0, 0], 0.0])

        end = solve_ivp(slope, (0, period), np.concatenate([q, v]), rtol=1e-9, atol=1e-12).y[:, -1]
        q, v = end[:2], end[2:]
        path.append(q.copy())
    assert np.ptp(path, axis=0).min() > 0.05
    np.testing.assert_allclose(run.q[: len(path)], path, atol=1e-4)


def test_a_joint_that_locks_while_moving_passes_on_no_momentum_that_is_not_there(panda, home, rng):
    rates, healthy = rng.normal(size=7), np.arange(7) != 3
    after = ServoRobot(panda, home, hf.Servos())
    after.data.qvel[:] = rates
    after.lock_all_except(healthy)
    m = dynamics.mass_matrix(panda, home)
    np.testing.assert_allclose(after.data.qvel, np.linalg.solve(m[np.ix_(healthy, healthy)], (m @ rates)[healthy]), rtol=1e-6)
    left = np.zeros(7)
    left[healthy] = after.data.qvel
    assert left @ m @ left < rates @ m @ rates


# ---- the kinematic picture -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("k", "at"), [(4, 0.0), (3, 0.5)])
def test_stiff_and_slow_is_the_kinematic_path(law, home, goal, k, at):
    run = hf.simulate_physics(law, home, goal, locked={k: None}, servos=hf.Servos(bandwidth=20.0), time=at)
    assert (run.outcome, run.reason, run.agrees) == ("converged", "none", True)
    assert run.path_distance < (2e-3 if at else 1e-3)  # a lock on the way is a blow
    assert run.terminal_distance < 1e-6
    assert run.terminal_turn < 1e-3
    standing = run.q[run.time >= at, k]
    np.testing.assert_array_equal(standing, standing[0])
    assert abs(standing[0] - run.kinematic.q_final[k]) < 1e-3
    assert run.tracking_error.max() < 2e-3
    efforts = [joint.effort for joint in run.law.arm.joints]
    assert (np.abs(run.torque[1:]) < 0.999 * np.array(efforts)).all()  # at the first instant, the command leaps


def test_softer_servos_go_farther_astray(law, home, goal):
    apart = [hf.simulate_physics(law, home, goal, locked=[4], servos=hf.Servos(bandwidth=b)).path_distance for b in (20.0, 2.0)]
    assert apart[1] > 2 * apart[0]


def test_compensated_gravity_is_no_gravity(law, panda, home, goal):
    weightless = replace(panda, gravity=np.zeros(3))
    same = hf.control.pseudoinverse(weightless, "position", gain=2.0, speed_limit=0.1)
    runs = [hf.simulate_physics(x, home, goal, locked=[4], time_limit=1.0) for x in (law, same)]
    check_card(runs[0])
    np.testing.assert_allclose(runs[0].q, runs[1].q, atol=1e-8)
    weight = dynamics.gravity_torque(panda, home)
    weight[4] = 0
    np.testing.assert_allclose((runs[0].torque - runs[1].torque)[0], weight, atol=5e-3)  # the first period's mean
    uncompensated = hf.simulate_physics(law, home, goal, locked=[4], servos=hf.Servos(compensation=0.0))
    assert uncompensated.outcome == "converged"  # the law sees the true configuration
    assert uncompensated.path_distance > runs[0].path_distance


@pytest.mark.parametrize(("phi", "angle"), [(120, -261.7868), (75, 28.0389 - 360)])
def test_the_published_two_link_arm_ends_where_it_does_on_paper(two, phi, angle):
    target = [1 + 2 * np.cos(RAD(phi)), 2 * np.sin(RAD(phi))]
    run = hf.simulate_physics(two, RAD([0.0, -30.0]), target, locked=[0], servos=hf.Servos(bandwidth=5.0, rate=250.0))
    assert run.outcome == "stuck"
    assert run.agrees
    assert np.rad2deg(run.q[-1, 1]) == pytest.approx(angle, abs=1e-2)
    np.testing.assert_array_equal(run.q[:, 0], 0)


def test_the_published_two_link_arm_that_never_rests_keeps_turning(two):
    target = [1 + 2 * np.cos(RAD(60)), 2 * np.sin(RAD(60))]
    run = hf.simulate_physics(
        two, RAD([0.0, -30.0]), target, locked=[0], servos=hf.Servos(bandwidth=5.0, rate=250.0), time_limit=20.0
    )
    assert (run.outcome, run.agrees) == ("moving", True)
    assert np.ptp(run.q[:, 1]) / run.time[-1] == pytest.approx(1.732051, rel=1e-2)
    assert run.path_distance < 0.02


def test_where_nothing_moves(two):
    run = hf.simulate_physics(two, RAD([0.0, -30.0]), [1.0, 1.0], locked=[0, 1])
    assert (run.outcome, run.agrees, run.path_distance) == ("stuck", True, 0.0)
    assert run.tracking_error.tolist() == run.saturated_fraction.tolist() == [0, 0]


# ---- where it does not hold ----------------------------------------------------------------------------------------


def test_weak_motors_saturate_within_their_effort_and_lag(panda, home, goal):
    weight = np.abs(dynamics.gravity_torque(panda, home))
    weak = replace(panda, joints=tuple(replace(j, effort=1.05 * w + 0.1) for j, w in zip(panda.joints, weight, strict=True)))
    law = hf.control.pseudoinverse(weak, "position", gain=2.0, speed_limit=0.1)
    run = hf.simulate_physics(law, home, goal, locked=[4], time_limit=1.5)
    effort = np.array([j.effort for j in weak.joints])
    assert (np.abs(run.torque) <= effort * (1 + 1e-12)).all()
    assert run.saturated_fraction.max() > 0.02
    assert run.saturated_fraction[4] == 0
    assert (np.abs(run.reference - run.q) <= effort / run.stiffness + 1e-9).all()
    assert run.path_distance > 2e-3
    assert any("at their torque limit" in line for line in run.describe())


def test_what_is_not_decided_says_why(two, law, home, goal):
    short = hf.simulate_physics(law, home, goal, locked=[4], time_limit=3.0)
    assert (short.outcome, short.reason, short.agrees) == ("undecided", "time_limit", False)
    assert short.time[-1] == pytest.approx(3.0)
    singular = hf.simulate_physics(two, [0.0, 0.0], [1.0, 1.0])
    assert (singular.outcome, singular.reason) == ("undecided", "singular")
    wild = hf.Servos(bandwidth=2000.0, ratio=1e-4, rate=100.0, step=0.01)
    with np.errstate(all="ignore"):
        burst = hf.simulate_physics(two, [0.3, 0.8], [1.0, 1.0], locked=[], servos=wild, time_limit=3.0)
    assert (burst.outcome, burst.reason) == ("undecided", "unstable")


def test_only_a_repeated_motion_never_stops():
    """Closed forms: a joint that turns, an oscillation, both with a drift or a decay, and a motion shorter than two periods."""
    time, turning = np.arange(0, 20, 0.004), np.array([True, False])

    def verdict(joint, slide, until=20.0):
        q = np.column_stack([joint, slide])[time <= until]
        return _classify_unfinished_run(q, 250.0, 1.0, turning)

    wave, still = np.sin(2 * np.pi * time / 3.7), 0 * time
    undecided = ("undecided", "time_limit")
    assert verdict(1.7 * time, still) == ("moving", "none")
    assert verdict(still, 1.7 * time) == undecided
    assert verdict(still, wave) == ("moving", "none")
    assert verdict(wave, np.cos(2 * np.pi * time / 3.7)) == ("moving", "none")
    assert verdict(still, wave, until=6.0) == undecided
    assert verdict(still, wave + 1e-3 * time) == undecided
    assert verdict(still, wave * np.exp(-1e-3 * time)) == undecided
    assert verdict(wave, np.exp(-time / 10)) == undecided
    assert verdict(still, still) == undecided


# ---- the edges -----------------------------------------------------------------------------------------------------


def test_gains(panda, law, home, goal):
    given = hf.Servos(stiffness=[600.0] * 7, damping=[40.0] * 7)
    run = hf.simulate_physics(law, home, goal, locked=[4], servos=given, time_limit=0.1)
    assert (run.stiffness == 600).all()
    assert (run.damping == 40).all()
    assert "as given" in given.describe()
    tuned = hf.simulate_physics(
        law, home, goal, locked=[4], servos=hf.Servos(bandwidth=2.0, ratio=0.5, compensation=0.8), time_limit=0.1
    )
    inertia = np.diag(dynamics.mass_matrix(panda, home))
    friction, natural = np.array([j.friction for j in panda.joints]), 4 * np.pi
    found = (tuned.stiffness - natural * friction) / natural**2
    assert (found >= inertia * (1 - 1e-6)).all()
    np.testing.assert_allclose(tuned.damping, natural * found, rtol=1e-9)
    assert "80% of gravity" in tuned.servos.describe()
    assert hf.Servos(rate=500.0).substeps == 2
    assert hf.Servos(rate=1000.0).substeps == 1
    assert hf.Servos(rate=300.0).substeps == 4


def test_wrong_input_is_one_sentence(law, home, goal):
    with pytest.raises(InputError, match="q0 and target give 2 runs"):
        hf.simulate_physics(law, [home, home], goal)
    with pytest.raises(InputError, match="time_limit is -1"):
        hf.simulate_physics(law, home, goal, time_limit=-1)
    with pytest.raises(InputError, match="bandwidth of the servos is 0"):
        hf.Servos(bandwidth=0)
    with pytest.raises(InputError, match="compensation of the servos is -1"):
        hf.Servos(compensation=-1)
    with pytest.raises(InputError, match="stiffness of the servos must be 7 finite numbers above 0"):
        hf.simulate_physics(law, home, goal, servos=hf.Servos(stiffness=[1.0], damping=[1.0] * 7))
    with pytest.raises(InputError, match="only one of stiffness and damping"):
        hf.Servos(stiffness=[1.0] * 7)
    with pytest.raises(InputError, match="no joint"):
        hf.simulate_physics(law, home, goal, locked=["elbow"])
    bare = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0)] * 3, name="bare")
    with pytest.raises(ArmError, match="inertia"):
        hf.simulate_physics(hf.control.pseudoinverse(bare, "planar"), [0.1, 0.2, 0.3], [1, 1])


def test_the_figure_and_the_words(law, home, goal):
    run = hf.simulate_physics(law, home, goal, locked=[4], time_limit=1.0)
    assert len(run.figures()["physics"].axes) == 3
    said = " ".join(run.describe())
    assert "in the kinematic simulation: converged" in said
    assert "still moving at the limit of 1 s" in said
    assert any("distance between the tool paths" in fact.label for fact in present(run).facts)
