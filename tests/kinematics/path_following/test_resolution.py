"""Laws of redundancy resolution against NumPy, finite differences and linear programs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog

import holdfast as hf
import oracles
from holdfast.core.status import Status
from holdfast.kinematics.indices import NegatedObjective, RelativeManipulability, susceptibility
from holdfast.kinematics.path_following import AugmentedJacobian, ExtendedJacobian, GradientProjection

GAIN = 0.07


def without_limits(arm: hf.Arm) -> hf.Arm:
    free = {"lower": -np.inf, "upper": np.inf, "velocity": np.inf}
    return replace(arm, joints=tuple(replace(j, **free) for j in arm.joints))


@pytest.fixture(scope="module")
def panda() -> hf.Arm:
    return without_limits(hf.arms.load("panda"))


@pytest.fixture(scope="module")
def flat(generator) -> hf.Arm:
    """Five parallel axes in a tilted plane, with links: three degrees of redundancy for a position."""
    rng = generator("flat five")
    return oracles.with_bodies(oracles.planar_arm(rng, 5), rng)


@pytest.fixture(scope="module")
def cases(panda, flat):
    """Arm, task, objective, and configurations to draw from."""
    return {
        "panda": (panda, "pose", susceptibility.torque(panda, "effort")),
        "flat": (flat, "planar", susceptibility.torque(flat)),
        "sum": (flat, "planar", 2.0 * susceptibility.torque(flat) + 3.0 * susceptibility.acceleration(flat)),
    }


def states(arm, task, rng, count):
    """Configurations that are not near a singularity, task Jacobians and twists."""
    q = rng.uniform(-2.5, 2.5, (40 * count, arm.n))
    j = np.einsum("mi,nij->nmj", task.rows, oracles.jacobian(arm, q))
    s = np.linalg.svd(j, compute_uv=False)
    good = s[:, -1] > 0.25 * np.quantile(s[:, -1], 0.95)
    return q[good][:count], j[good][:count], rng.normal(size=(count, 6))


def particular_and_null(j, v):
    inverse = np.linalg.pinv(j)
    return np.einsum("nij,nj->ni", inverse, v), np.eye(j.shape[2]) - inverse @ j


@pytest.mark.parametrize("case", ["panda", "flat", "sum"])
def test_gradient_projection_is_the_formula(cases, case, rng):
    arm, task, objective = cases[case]
    law = GradientProjection(arm, objective, GAIN, task=task, period=None)
    q, j, twist = states(arm, law.task, rng, 20)
    particular, null = particular_and_null(j, twist @ law.task.rows.T)
    slope = np.array([oracles.slope(objective, x) for x in q])
    expected = particular - GAIN * np.einsum("nij,nj->ni", null, slope)
    found = law.rates(q, twist)
    np.testing.assert_allclose(found.rates, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(np.einsum("nij,nj->ni", j, found.rates), twist @ law.task.rows.T, atol=1e-7)
    assert (found.status == Status.OK).all()
    assert (found.self_motion == 1).all()
    assert (found.task == 1).all()
    step = law.prepare()(q[3], twist[3])
    np.testing.assert_array_equal(step, found.rates[3])
    np.testing.assert_array_equal(law.step.extra_outputs, (found.self_motion[3], found.task[3], found.damping[3]))


def test_an_objective_wanted_the_other_way_moves_the_other_way(cases, rng):
    arm, task, objective = cases["flat"]
    law, back = (GradientProjection(arm, o, GAIN, task=task, period=None) for o in (objective, NegatedObjective(objective)))
    q, _, _ = states(arm, law.task, rng, 5)
    np.testing.assert_allclose(law.rates(q, np.zeros(6)[None].repeat(5, 0)).rates, -back.rates(q, np.zeros((5, 6))).rates)


def test_one_twist_serves_many_configurations(cases, rng):
    arm, task, objective = cases["flat"]
    law = GradientProjection(arm, objective, GAIN, task=task, period=None)
    q, _, twist = states(arm, law.task, rng, 3)
    together = law.rates(q, twist[0])
    assert together.rates.shape == (3, arm.n)
    single = law.rates(q[1], twist[0])
    np.testing.assert_array_equal(single.rates, together.rates[1])
    assert single.status == Status.OK


def test_extended_jacobian_keeps_the_slope_along_the_self_motion(generator, rng):
    arm = without_limits(hf.arms.load("planar-3r"))
    objective = susceptibility.torque(arm, "worst-case")
    law = ExtendedJacobian(arm, objective, 5.0, task="planar", period=None)
    q, _, twist = states(arm, law.task, rng, 30)
    rates = law.rates(q, twist).rates
    near = np.linalg.norm(rates, axis=1) < 20  # of an algorithmic singularity differences say little
    assert near.sum() > 15
    q, rates = q[near], rates[near]

    def slope(x):
        j = law.task.rows @ oracles.jacobian(arm, x[None])[0]
        null = np.cross(*j)  # of two rows of three: its length and sign go smoothly along
        return null @ oracles.slope(objective, x) / np.linalg.norm(null)

    h = 1e-4
    now = np.array([slope(x) for x in q])
    rate = np.array([(slope(x + h * d) - slope(x - h * d)) / (2 * h) for x, d in zip(q, rates, strict=True)])
    # Closing in at 5/s, whatever the hand does.
    np.testing.assert_allclose(rate, -5.0 * now, rtol=1e-4, atol=1e-3 * np.abs(now).max())


@pytest.mark.parametrize("case", ["panda", "flat"])
def test_augmented_jacobian_closes_in_on_its_value(cases, case, rng):
    arm, task, objective = cases[case]
    q0 = rng.uniform(-1, 1, arm.n)
    wanted = float(objective(q0))
    law = AugmentedJacobian(arm, objective, wanted, gain=3.0, task=task, period=None)
    q, j, twist = states(arm, law.task, rng, 20)
    rates = law.rates(q, twist).rates
    slope = np.array([oracles.slope(objective, x) for x in q])
    across = np.einsum("nij,nj->ni", particular_and_null(j, twist @ law.task.rows.T)[1], slope)
    steep = np.linalg.norm(across, axis=1) > 0.1 * np.linalg.norm(slope, axis=1)
    assert steep.sum() >= 3
    change = np.einsum("ni,ni->n", slope, rates)[steep]
    np.testing.assert_allclose(change, (3.0 * (wanted - objective(q)))[steep], rtol=2e-3, atol=2e-3 * np.abs(change).max())
    np.testing.assert_allclose(np.einsum("nij,nj->ni", j, rates), twist @ law.task.rows.T, atol=1e-6)


def test_the_cap_takes_from_the_self_motion_alone(cases, rng):
    arm, task, objective = cases["flat"]
    free = GradientProjection(arm, objective, GAIN, task=task, period=None)
    q, j, twist = states(arm, free.task, rng, 200)
    v = twist @ free.task.rows.T
    particular, _ = particular_and_null(j, v)
    cap = float(np.median(np.linalg.norm(particular, axis=1)))
    found = GradientProjection(arm, objective, GAIN, task=task, rate_cap=cap, period=None).rates(q, twist)
    np.testing.assert_allclose(np.einsum("nij,nj->ni", j, found.rates), v, atol=1e-7)
    own = free.rates(q, twist).rates - particular
    task_alone, norm = np.linalg.norm(particular, axis=1), np.linalg.norm(found.rates, axis=1)
    over = task_alone >= cap
    assert 0.2 < over.mean() < 0.8
    np.testing.assert_allclose(norm[over], task_alone[over], rtol=1e-9)
    assert (found.self_motion[over] == 0).all()
    assert (norm[~over] <= cap * (1 + 1e-9)).all()
    # |p + s z| = cap for p at right angles to z.
    share = np.sqrt((cap**2 - task_alone[~over] ** 2) / (own[~over] ** 2).sum(axis=1)).clip(max=1)
    np.testing.assert_allclose(found.self_motion[~over], share, rtol=1e-5)


@pytest.fixture(scope="module")
def bounded(flat):
    """The arm of five joints with limits, and a control period."""
    joints = [replace(j, lower=-1.2, upper=1.4, velocity=2.0) for j in flat.joints]
    return replace(flat, joints=tuple(joints)), 0.02


def test_limits_hold_within_a_period_and_self_motion_makes_room(bounded, rng):
    arm, period = bounded
    law = GradientProjection(arm, susceptibility.torque(arm), GAIN, task="planar", rate_cap=None, period=period)
    count = 400
    q = rng.uniform(arm.lower, arm.upper, (count, arm.n))
    near = rng.random((count, arm.n)) < 0.3  # many joints close to a limit
    side = np.where(rng.random((count, arm.n)) < 0.5, arm.lower + 0.01 * rng.random(), arm.upper - 0.01 * rng.random())
    q = np.where(near, side, q)
    j = np.einsum("mi,nij->nmj", law.task.rows, oracles.jacobian(arm, q))
    q, j = (x[np.linalg.svd(j, compute_uv=False)[:, -1] > 0.3] for x in (q, j))
    twist = rng.uniform(0.1, 6.0, (len(q), 1)) * rng.normal(size=(len(q), 6))
    found = law.rates(q, twist)
    low = np.maximum(-2.0, (arm.lower - q) / period)
    high = np.minimum(2.0, (arm.upper - q) / period)
    assert (found.rates >= low - 1e-6).all()
    assert (found.rates <= high + 1e-6).all()
    v = twist @ law.task.rows.T
    calm = found.damping == 0
    moved = np.einsum("nij,nj->ni", j, found.rates)
    np.testing.assert_allclose(moved[calm], (found.task[:, None] * v)[calm], atol=1e-6)
    assert ((found.status == Status.SLOWED) == (found.task < 1)).all()
    feasible = np.array([_feasible(*case) for case in zip(j, v, low, high, strict=True)])
    slowed = found.task < 1 - 1e-6
    assert 50 < feasible.sum() < len(q) - 50
    assert (found.self_motion[feasible] > 0).mean() > 0.5
    assert not (~feasible & ~slowed & calm).any()
    missed = (feasible & slowed).sum() / feasible.sum()
    print(f"feasible {feasible.sum()} of {len(q)}, slowed though feasible {missed:.1%}")
    assert missed < 0.02


def _feasible(j, v, low, high) -> bool:
    """A linear program's answer: do any rates within their bounds give the velocity?"""
    return linprog(np.zeros(len(low)), A_eq=j, b_eq=v, bounds=list(zip(low, high, strict=True))).status == 0


def test_a_joint_that_starts_outside_its_limits_is_brought_back(bounded, rng):
    arm, period = bounded
    law = GradientProjection(arm, susceptibility.torque(arm), GAIN, task="planar", rate_cap=None, period=period)
    q = rng.uniform(-0.5, 0.5, arm.n)
    q[1] = arm.upper[1] + 0.01
    found = law.rates(q, 0.1 * rng.normal(size=6))
    assert np.isfinite(found.rates).all()
    assert found.rates[1] <= 1e-6


def test_rates_stay_bounded_near_a_singularity(panda, rng):
    law = GradientProjection(
        panda, susceptibility.torque(panda, "effort"), 1.0, task="pose", rate_cap=None, period=None, damping=0.05
    )
    away = 10 ** rng.uniform(-12, -1, (300, 1))
    q = away * rng.uniform(-1, 1, (300, 7))  # stretched upwards: singular
    found = law.rates(q, rng.normal(size=(300, 6)))
    assert np.isfinite(found.rates).all()
    assert np.linalg.norm(found.rates, axis=1).max() < 200
    assert (found.damping[away[:, 0] < 1e-3] > 0).all()
    assert (found.status[away[:, 0] < 1e-3] == Status.SINGULAR).all()
    assert np.isfinite(law.rates(np.zeros(7), np.ones(6)).rates).all()


def test_nan_stays_in_its_row(cases, rng):
    arm, task, objective = cases["flat"]
    law = GradientProjection(arm, objective, GAIN, task=task, rate_cap=2.0, period=None)
    q, _, twist = states(arm, law.task, rng, 4)
    clean = law.rates(q, twist)
    q[1, 2], twist[2, 0] = np.nan, np.nan
    found = law.rates(q, twist)
    assert np.isnan(found.rates[1:3]).all()
    np.testing.assert_array_equal(found.status, [Status.OK, Status.BAD_INPUT, Status.BAD_INPUT, Status.OK])
    np.testing.assert_array_equal(found.rates[[0, 3]], clean.rates[[0, 3]])
    with pytest.raises(hf.InputError, match="NaN"):
        law.rates(q[1], twist[0])


def test_bad_input_is_answered_in_a_sentence(cases, panda):
    arm, task, objective = cases["flat"]
    for kind, what in (
        ({"rate_cap": 0.0}, "rate_cap is 0"),
        ({"rate_cap": np.nan}, "rate_cap is nan"),
        ({"period": -1.0}, "period is -1"),
        ({"damping": -0.1}, "damping is -0.1"),
        ({"gain": -1.0}, "gain is -1"),
        ({"gain": np.inf}, "gain is inf"),
    ):
        with pytest.raises(hf.InputError, match=what):
            GradientProjection(arm, objective, task=task, **kind)
    with pytest.raises(hf.InputError, match="gain is 0; it must be above 0"):
        ExtendedJacobian(arm, objective, 0.0, task=task)
    with pytest.raises(hf.InputError, match="wanted value is nan"):
        AugmentedJacobian(arm, objective, np.nan, gain=1.0, task=task)
    with pytest.raises(hf.InputError, match="make it with the same arm"):
        GradientProjection(panda, objective, task=task)
    with pytest.raises(hf.TaskError, match="no self-motion to use"):
        GradientProjection(arm, objective, task="pose")
    with pytest.raises(hf.TaskError, match="is defined for the task"):
        GradientProjection(panda, RelativeManipulability(panda, "position"), task="pose")
    law = GradientProjection(arm, objective, GAIN, task=task, period=None)
    for q, twist in (
        (np.zeros(arm.n), np.zeros(5)),
        (np.zeros((2, arm.n)), np.zeros((3, 6))),
        (np.zeros(arm.n), np.zeros((1, 1, 6))),
    ):
        with pytest.raises(hf.InputError, match="twist has shape"):
            law.rates(q, twist)
    assert "gradient projection" in repr(law)


def test_the_gain_weighs_the_objective_against_the_joint_rates(rng):
    """English and Maciejewski 1998, section VII: the rates minimise ``dF/dt + |rates|^2 / (2 gain)`` on the task."""
    arm = hf.arms.load("panda")
    objective = hf.susceptibility.torque(arm, "effort")
    gain = 0.7
    law = GradientProjection(arm, objective, gain=gain, period=None, damping=0.0)
    for q in oracles.inside(arm, rng, 5):
        twist, j = rng.normal(size=6), arm.jacobian(q)
        gradient = objective.gradient(q)
        # Stationarity of the Lagrangian: [I / gain, J'; J, 0] [rates; multipliers] = [-gradient; twist].
        system = np.block([[np.eye(7) / gain, j.T], [j, np.zeros((6, 6))]])
        expected = np.linalg.solve(system, np.r_[-gradient, twist])[:7]
        if np.linalg.cond(j) < 50 and (np.abs(expected) < [x.velocity for x in arm.joints]).all():
            np.testing.assert_allclose(law.rates(q, twist).rates, expected, rtol=1e-7, atol=1e-9)
