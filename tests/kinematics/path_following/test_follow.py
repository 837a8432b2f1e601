"""Paths followed: the hand stays on them, the start is the best, the objective does what the law says."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from pyarrow import parquet
from scipy.integrate import solve_ivp
from scipy.optimize import root

import holdfast as hf
import oracles
from holdfast.kinematics.indices import susceptibility
from holdfast.kinematics.paths import Constant, TimedPath, Trapezoid, arc, line


@pytest.fixture(scope="module")
def torque(planar):
    return susceptibility.torque(planar, "worst-case")


@pytest.fixture(scope="module")
def projected(planar, torque, across):
    return hf.follow(planar, across(1.8, -1.8), minimise=torque, task="planar", best=True)


@pytest.fixture(scope="module")
def extended(planar, torque, across):
    return hf.follow(planar, across(1.2, -1.8), minimise=torque, task="planar", method="extended-jacobian")


@pytest.fixture(scope="module")
def wave(planar):
    """An arc below the base: nowhere near a singularity, algorithmic or not."""
    return TimedPath(arc([1.3, -1.5, 0], [0.9, -1.75, 0], [0.4, -1.8, 0]), Trapezoid(4.0))


def manifold_best(arm, p, objective, count=20_000):
    """Best value over the self-motion of a hand position, by brute force over the first joint and both elbows."""
    q1 = np.linspace(-np.pi, np.pi, count)
    rest = p - np.stack([np.cos(q1), np.sin(q1)], axis=1)
    far = np.linalg.norm(rest, axis=1)
    ok = far <= 2
    q1, rest, far = q1[ok], rest[ok], far[ok]
    bend = 2 * np.arccos(far / 2)
    found = []
    for sign in (1, -1):
        q3 = sign * bend
        q2 = np.arctan2(rest[:, 1], rest[:, 0]) - q3 / 2 - q1
        found.append(objective(np.stack([q1, q2, q3], axis=1)).min())
    return min(found)


def test_the_hand_stays_on_its_path(planar, projected):
    hand = oracles.forward(planar, projected.q)[:, :2, 3]
    np.testing.assert_allclose(hand[:, 1], -1.8, atol=5e-6)
    np.testing.assert_allclose(hand[:, 0], np.linspace(1.8, -1.8, 501), atol=5e-6)
    assert projected.on_path
    assert projected.headline.startswith("the end effector stays on its path")


def test_the_start_is_the_best_of_its_pose(planar, torque, projected):
    best = manifold_best(planar, np.array([1.8, -1.8]), torque)
    assert projected.value[0] == pytest.approx(best, rel=1e-5)


def test_the_best_of_each_pose_is_what_brute_force_finds(planar, torque, projected):
    for k in range(0, 501, 50):
        best = manifold_best(planar, projected.poses[k][:2, 3], torque)
        assert best <= projected.best_value[k] * (1 + 1e-4)
        assert projected.best_value[k] == pytest.approx(best, rel=3e-3)
        assert projected.value[k] >= best * (1 - 1e-4)


def test_the_numbers_of_the_paper(projected):
    """Fig. 5: at worst 38 % of the largest, on the left; F over the joints' largest values, divided by 3."""
    share = projected.value / 3
    assert share.max() == pytest.approx(0.3815, abs=1e-3)
    assert share.argmax() == 500
    assert share[250:].mean() > share[:250].mean()


def test_gradient_projection_is_what_scipy_integrates(planar, torque, wave):
    """``J^+ v - gain (I - J^+ J) grad F`` with a Jacobian of its own, F by differences, the hand's velocity by differences."""
    q0 = np.array([-1.9, 1.4, 0.5])
    start = wave.pose(np.zeros(1))[0, :2, 3]
    for _ in range(30):  # onto the path
        q0 = q0 + np.linalg.pinv(oracles.planar_jacobian([1, 1, 1], q0)) @ (start - oracles.planar_hand([1, 1, 1], q0))
    found = hf.follow(planar, wave, minimise=torque, task="planar", q=q0, gain=0.4, limits=False, samples=101)

    def rates(t, q):
        ends = np.clip([t - 1e-5, t + 1e-5], 0, wave.duration)
        hand = wave.pose(ends)[:, :2, 3]
        j = oracles.planar_jacobian([1, 1, 1], q)
        inverse = np.linalg.pinv(j)
        slope = np.array([(torque(q + s) - torque(q - s)) / 2e-6 for s in 1e-6 * np.eye(3)])
        wanted = (hand[1] - hand[0]) / (ends[1] - ends[0])
        return inverse @ wanted - 0.4 * (slope - inverse @ (j @ slope))

    expected = solve_ivp(rates, (0, wave.duration), q0, t_eval=found.time, rtol=1e-8, atol=1e-9).y.T
    assert np.ptp(expected, axis=0).max() > 0.3
    np.testing.assert_allclose(found.q, expected, atol=2e-4)
    np.testing.assert_allclose(found.value, [torque(q) for q in expected], atol=2e-4)


def test_rates_and_accelerations_are_derivatives(planar, torque, wave):
    t = hf.follow(planar, wave, minimise=torque, task="planar")
    np.testing.assert_allclose(np.gradient(t.q, t.time, axis=0)[2:-2], t.qd[2:-2], atol=5e-3)
    np.testing.assert_allclose(np.gradient(t.qd, t.time, axis=0)[1:-1], t.qdd[1:-1], atol=1e-9)
    np.testing.assert_allclose(t.qd[[0, -1]], 0, atol=1e-3)  # from rest to rest
    gravity = planar.gravity_torque(t.q)
    at_rest = np.abs(t.torques(1e4) - gravity).max()
    assert at_rest < 1e-3 * np.abs(t.torques(0.25) - gravity).max()
    np.testing.assert_allclose(t.torques(2.0), planar.inverse_dynamics(t.q, t.qd / 2, t.qdd / 4))
    with pytest.raises(hf.InputError, match="time_scale is 0"):
        t.torques(0)


def test_extended_jacobian_is_the_stationary_point(planar, torque, extended):
    """At samples, the root of 'on the path and no slope along the self-motion' that scipy finds nearby."""
    rows = extended.task.rows

    def conditions(q, target):
        j = rows @ oracles.jacobian(planar, q[None])[0]
        null = np.cross(*j)
        return [*(oracles.forward(planar, q[None])[0, :2, 3] - target), null @ oracles.slope(torque, q)]

    assert extended.on_path
    for k in (0, 100, 200, 300, 400, 500):
        found = root(conditions, extended.q[k] + 1e-4, args=(extended.poses[k][:2, 3],), tol=1e-12)
        assert found.success
        np.testing.assert_allclose(found.x, extended.q[k], atol=2e-4)


def test_augmented_jacobian_keeps_the_value(planar, torque, wave):
    q = hf.follow(planar, wave, minimise=torque, task="planar").q[0]
    values = [float(torque(q)), manifold_best(planar, np.array([1.3, -1.5]), -1 * torque)]
    wanted = values[0] + 0.2 * abs(values[1] - values[0])
    t = hf.follow(planar, wave, minimise=torque, task="planar", method="augmented-jacobian", wanted=wanted)
    later = t.time > 0.4
    np.testing.assert_allclose(t.value[later], wanted, rtol=1e-4)
    assert t.on_path


def test_least_norm_moves_least(planar, torque, wave):
    start = hf.follow(planar, wave, minimise=torque, task="planar")
    least = hf.follow(planar, wave, minimise=torque, task="planar", method="none", q=start.q[0])
    assert least.method == "least-norm rates"
    j = np.einsum("mi,nij->nmj", least.task.rows, oracles.jacobian(planar, least.q))
    twist = wave.twist(least.time) @ least.task.rows.T
    np.testing.assert_allclose(least.qd, np.einsum("nij,nj->ni", np.linalg.pinv(j), twist), atol=2e-3)
    assert least.value[-1] > start.value[-1]


def test_maximise_is_the_other_way(planar, torque, wave):
    low, high = (hf.follow(planar, wave, **{way: torque}, task="planar") for way in ("minimise", "maximise"))
    assert (high.value > low.value).all()
    assert high.objective.better == "larger"
    worst = -manifold_best(planar, np.array([1.3, -1.5]), -1 * torque)
    assert high.value[0] == pytest.approx(worst, rel=1e-5)


def test_a_spatial_arm_and_a_sum(rng):
    arm = hf.arms.load("panda")
    q = np.array([0.1, -0.6, 0.2, -2.2, 0.1, 1.6, 0.8])
    first = arm.forward_kinematics(q)
    last = first.copy()
    last[:3, 3] += [0.0, 0.15, 0.05]
    both = susceptibility.torque(arm, "effort") + 1e-3 * susceptibility.swing_angle(arm, np.eye(7)[3])
    t = hf.follow(arm, TimedPath(line(first, last), Trapezoid(3.0)), minimise=both, q=q, gain=500.0, rate_cap=1.0)
    assert t.on_path
    assert t.task.name == "pose"
    np.testing.assert_array_equal(t.q[0], q)
    assert (t.q >= arm.lower - 1e-9).all()
    assert (t.q <= arm.upper + 1e-9).all()
    assert t.peak_rate <= 1.0 + 1e-6
    assert set(t.by_joint) == {"torque", "swing-angle"}
    np.testing.assert_allclose(t.by_joint["torque"], arm.gravity_torque(t.q), atol=1e-12)
    assert t.value[-1] < t.value[0]


def test_a_hand_that_limits_stop_is_not_called_on_its_path(across):
    arm = hf.arms.load("planar-3r")  # its second joint cannot turn over
    t = hf.follow(arm, across(1.9, -0.1), minimise=susceptibility.swing_angle(arm, [0, 1, 0]), task="planar")
    assert not t.on_path
    assert t.headline.startswith("THE END EFFECTOR LEAVES ITS PATH")
    assert any(line.startswith("THE END EFFECTOR LEAVES") for line in t.describe())
    assert any(e.kind == "joint limit" for e in t.events)
    assert (t.q >= arm.lower - 1e-9).all()
    assert (t.q <= arm.upper + 1e-9).all()


# ---- files -----------------------------------------------------------------------------------------------------------------


def test_files_hold_every_digit(projected, torque, tmp_path):
    table = projected.columns()
    assert list(table)[:2] == ["time_s", "joint1_rad"]
    np.testing.assert_array_equal(table["joint2_torque_N m"], torque.by_joint(projected.q)[:, 1])
    assert "best_objective" in table
    with projected.to_csv(tmp_path / "t.csv").open(newline="") as file:
        names, *rows = csv.reader(file)
    assert names == list(table)
    np.testing.assert_array_equal(np.array(rows, dtype=float).T, list(table.values()))
    read = parquet.read_table(projected.to_parquet(tmp_path / "t.parquet"))
    assert read.column_names == names
    for name, column in table.items():
        np.testing.assert_array_equal(read[name].to_numpy(), column)
    with pytest.raises(hf.StoreError, match="cannot write motion"):
        projected.to_csv(tmp_path / "none" / "t.csv")


# ---- bad input -------------------------------------------------------------------------------------------------------------


def test_bad_input_is_answered_in_a_sentence(planar, torque, wave, across):
    for options, what in (
        ({}, "exactly one of minimise and maximise"),
        ({"minimise": torque, "maximise": torque}, "exactly one of minimise and maximise"),
        ({"minimise": torque, "samples": 2}, "samples is 2"),
        ({"minimise": torque, "method": "best"}, "method 'best' is not known"),
        ({"minimise": torque, "q": [0, 0, 0]}, "from the first pose of the path"),
        ({"minimise": torque, "q": [0, np.nan, 0]}, "finite numbers"),
        ({"minimise": torque, "q": np.zeros((2, 3))}, "one configuration"),
        ({"minimise": torque, "rate_cap": 0}, "rate_cap is 0"),
        ({"minimise": torque, "rate_cap": np.nan}, "rate_cap is nan"),
        ({"minimise": torque, "gain": -1}, "gain is -1"),
        ({"minimise": torque, "wanted": 1.0}, "for the augmented Jacobian"),
    ):
        with pytest.raises(hf.InputError, match=what):
            hf.follow(planar, wave, task="planar", **options)
    with pytest.raises(hf.InputError, match="make it with the same arm"):
        hf.follow(hf.arms.load("panda"), wave, minimise=torque, task="position", q=np.zeros(7))
    with pytest.raises(hf.TaskError, match="no self-motion"):
        hf.follow(planar, wave, minimise=torque, task="pose")
    with pytest.raises(hf.HoldfastError, match="first pose of the path"):
        hf.follow(planar, TimedPath(line([4, 0, 0], [3, 0, 0]), Constant(1.0)), minimise=torque, task="planar")
