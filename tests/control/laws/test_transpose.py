"""The Jacobian transpose with optimal step: what it does in one step, and where it stops."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles


@pytest.fixture(autouse=True)
def _no_compilation(monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")


def test_the_step_leaves_the_least_error(mixed5, rng):
    q, e = oracles.inside(mixed5, rng, 20), rng.normal(size=(20, 3))
    rates = hf.control.jacobian_transpose(mixed5, "position").velocity(q, e)
    for j, error, found in zip(oracles.jacobian(mixed5, q)[:, :3], e, rates, strict=True):
        left = np.linalg.norm(error - j @ found)
        assert all(left < np.linalg.norm(error - factor * j @ found) for factor in (0.9, 0.99, 1.01, 1.1))
        np.testing.assert_allclose(np.cross(found[:3], (j.T @ error)[:3]), 0, atol=1e-9)  # along the slope


def test_a_command_across_everything_the_arm_can_do_is_no_rates():
    arm = hf.arms.load("planar-3r")
    law = hf.control.jacobian_transpose(arm, "planar")
    np.testing.assert_array_equal(law.velocity(np.zeros(3), [1.0, 0.0]), 0)  # stretched along x
    assert law.damping(np.zeros(3), [1.0, 0.0]) == 0
    assert law.quadratic() is None


def test_the_closed_loop_converges_and_its_stationary_points_have_no_slope():
    arm = hf.arms.load("planar-3r")
    law, target = hf.control.jacobian_transpose(arm, "planar"), np.array([1.5, 1.5])
    runs = hf.simulate(law, np.array([0.3, 0.5, 0.7]), target)
    assert str(runs.outcome) == "converged"
    points = hf.stationary_points(law, target, {1: 1.0}, seed=0)
    missed = points.error > 1e-6
    assert missed.any()
    lengths = [1.0, 1.0, 1.0]
    for q in points.q[missed]:
        slope = oracles.planar_jacobian(lengths, q).T @ (target - oracles.planar_hand(lengths, q))
        np.testing.assert_allclose(slope[[0, 2]], 0, atol=1e-8)
