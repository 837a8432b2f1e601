"""Weights of a susceptibility: which are accepted, and the largest static torque against brute force."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast import susceptibility as sus


@pytest.fixture(scope="module")
def planar():
    return arms.load("planar-3r")


def test_value_is_the_quadratic_form(planar, rng, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    q = rng.uniform(-2, 2, (30, 3))
    a = rng.normal(size=(3, 3))
    half = rng.normal(size=(2, 3))
    skew = np.array([[0, 1, 2], [-1, 0, 3], [-2, -3, 0.0]])
    for weights, w in (
        (None, np.eye(3)),
        ([1.0, 0, 2], np.diag([1.0, 0, 2])),
        (a @ a.T, a @ a.T),
        (a @ a.T + skew, a @ a.T),
        (half.T @ half, half.T @ half),
        (np.zeros(3), np.zeros((3, 3))),
    ):
        for make in (sus.torque, sus.acceleration, sus.swing_angle):
            measure = make(planar, weights)
            f = measure.by_joint(q)
            np.testing.assert_allclose(measure.weights, w, atol=1e-14)
            np.testing.assert_allclose(measure(q), np.einsum("ni,ij,nj->n", f, w, f), rtol=1e-9, atol=1e-9)
            assert measure.gradient(q).shape == q.shape


@pytest.mark.parametrize(
    ("weights", "words"),
    [
        ([1.0, -1e-9, 1], "not positive semidefinite: their smallest eigenvalue is -1e-09"),
        ([[1, 2, 0], [2, 1, 0], [0, 0, 1]], "smallest eigenvalue is -1"),
        ([1, 2], r"shape \(2,\); 'planar-3r' has 3 joints, so \(3,\) or \(3, 3\)"),
        (np.eye(4), r"shape \(4, 4\)"),
        ([1, np.nan, 1], "NaN or infinity"),
        ([1, np.inf, 1], "NaN or infinity"),
        ([[1, 2], [3]], "must be numbers or one of 'effort', 'worst-case' or None"),
        ("largest", "'largest' are not known"),
        ("effort", r"joint 'joint1' of 'planar-3r' has no largest effort above 0.*worst-case"),
    ],
)
def test_weights_that_are_refused(weights, words, planar):
    with pytest.raises(hf.InputError, match=words):
        sus.torque(planar, weights)


def test_rounding_below_zero_is_accepted(planar):
    assert sus.torque(planar, [1.0, 1.0, -1e-14]).weights[2, 2] == -1e-14


@pytest.mark.parametrize("name", ["acceleration", "swing-angle"])
@pytest.mark.parametrize("weights", ["effort", "worst-case"])
def test_weights_named_after_torques_are_for_torques(name, weights, planar):
    with pytest.raises(hf.InputError, match=f"weights '{weights}' are of torques"):
        sus.by_name(name, planar, weights)


def test_effort_weights_are_shares_of_the_limits(rng):
    arm = arms.load("panda")
    measure = sus.torque(arm, "effort")
    q = oracles.inside(arm, rng, 20)
    effort = np.array([j.effort for j in arm.joints])
    np.testing.assert_allclose(measure(q), ((arm.gravity_torque(q) / effort) ** 2).sum(1), rtol=1e-9)
    assert measure.unit == "1"


@pytest.mark.parametrize("types", ["RRR", "RPRR", "RRRRRR"])
def test_largest_static_torque_against_brute_force(types, rng):
    """No sample exceeds it, and the best samples refined by scipy come to it."""
    from scipy.optimize import minimize

    arm = oracles.with_bodies(oracles.random_arm(rng, types=types, limits=1.5), rng, payload=True)
    largest = sus.largest_static_torque(arm)
    q = oracles.inside(arm, rng, 40000)
    tau = np.abs(arm.gravity_torque(q))
    assert (tau.max(axis=0) <= largest * (1 + 1e-12)).all()
    bounds = list(zip(arm.lower, arm.upper, strict=True))
    for k in range(arm.n):
        best = 0.0
        for start in q[np.argsort(-tau[:, k])[:20]]:
            sign = np.sign(arm.gravity_torque(start)[k])
            found = minimize(lambda x, k=k, s=sign: -s * arm.gravity_torque(x)[k], start, bounds=bounds, method="L-BFGS-B")
            best = max(best, -found.fun)
        assert largest[k] == pytest.approx(best, rel=1e-6)


def test_largest_static_torque_without_limits_and_at_the_limits(planar):
    free = replace(planar, joints=tuple(replace(j, type="continuous", lower=-np.inf, upper=np.inf) for j in planar.joints))
    np.testing.assert_allclose(sus.largest_static_torque(free), sus.largest_static_torque(planar), rtol=1e-12)
    # Joint 1 held between straight down and 30 deg from it, the others straight.
    held = [replace(planar.joints[0], lower=-np.pi / 2, upper=-np.pi / 3)]
    held += [replace(j, lower=0.0, upper=0.0) for j in planar.joints[1:]]
    np.testing.assert_allclose(
        sus.largest_static_torque(replace(planar, joints=tuple(held))), 9.81 * np.array([4.5, 2, 0.5]) / 2, rtol=1e-12
    )


def test_a_joint_that_gravity_never_loads_has_no_weight(rng):
    arm = arms.load("panda")  # its first axis is upright
    largest = sus.largest_static_torque(arm)
    assert largest[0] == 0
    assert (largest[1:] > 0.01).all()
    measure = sus.torque(arm, "worst-case")
    assert measure.weights[0, 0] == 0
    shares = measure.by_joint(oracles.inside(arm, rng, 2000))[:, 1:] / largest[1:]
    assert (np.abs(shares) <= 1 + 1e-12).all()
    assert np.isfinite(measure.gradient(np.zeros(7))).all()


def test_a_slide_without_limits_has_no_largest_torque(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RPR"), rng)
    with pytest.raises(hf.InputError, match="joint 'j1' of 'random-RPR' slides without limits"):
        sus.torque(arm, "worst-case")
