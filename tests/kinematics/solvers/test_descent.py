"""Descent under constraints, against scipy's SLSQP and against what is known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from holdfast.kinematics.solvers.descent import minimise_constrained


def problem(rng):
    """A distance on a sphere, kept out of a ball, within a box: cost, slope, constraints and slopes."""
    n = int(rng.integers(3, 8))
    far, centre, bend = rng.normal(size=n), rng.normal(size=n), rng.uniform(0.5, 2, n)
    middle, radius = 1.2 * far / np.linalg.norm(far), rng.uniform(0.1, 0.6)

    def look(x):
        away, beyond = x - 2 * far, x - middle
        kept = np.array([x @ x - 1, beyond @ beyond - radius**2])
        cost = away @ (bend * away) + np.sin(x @ centre)
        return cost, 2 * bend * away + np.cos(x @ centre) * centre, kept, np.stack([2 * x, 2 * beyond])

    low, high = np.full(n, -0.9), np.full(n, np.inf)
    while True:
        start = rng.normal(size=n)
        start /= np.linalg.norm(start)
        if (start >= low).all() and look(start)[2][1] >= 0:
            return look, start, low, high


def bettered(look, x, low, high):
    """What SLSQP gains from x."""
    wanted = [
        {"type": "eq", "fun": lambda x: look(x)[2][:1], "jac": lambda x: look(x)[3][:1]},
        {"type": "ineq", "fun": lambda x: look(x)[2][1:], "jac": lambda x: look(x)[3][1:]},
    ]
    found = minimize(
        lambda x: look(x)[0],
        x,
        jac=lambda x: look(x)[1],
        method="SLSQP",
        bounds=list(zip(low, high, strict=True)),
        constraints=wanted,
        options={"ftol": 1e-12, "maxiter": 200},
    )
    return look(x)[0] - found.fun


def test_it_ends_at_a_local_minimum_that_slsqp_cannot_better():
    """The quadratic programs of CasADi fail now and then; then it says where it came, and the caller looks."""
    fine = 0
    for seed in range(40):
        look, start, low, high = problem(np.random.default_rng(seed))
        x = minimise_constrained(look, start, low, high, 1)
        assert (x >= low).all()
        assert (x <= high).all()
        kept = look(x)[2]
        fine += abs(kept[0]) < 1e-8 and kept[1] > -1e-8 and bettered(look, x, low, high) < 1e-7
    assert fine >= 34


def test_the_nearest_point_of_a_circle():
    """The middle lies at (3, 4): the nearest point of the unit circle is known."""

    def look(x):
        away = x - np.array([3.0, 4])
        return away @ away, 2 * away, np.array([x @ x - 1]), 2 * x[None]

    free = np.full(2, np.inf)
    np.testing.assert_allclose(minimise_constrained(look, np.array([1.0, 0]), -free, free, 1), [0.6, 0.8], atol=1e-8)
    standing = np.array([1.0, np.inf])
    np.testing.assert_array_equal(minimise_constrained(look, np.array([1.0, 0]), np.array([1.0, -np.inf]), standing, 1), [1, 0])


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_where_nothing_is_known_it_stays(value):
    def look(x):
        return value, np.full(2, value), np.full(1, value), np.full((1, 2), value)

    start = np.array([0.3, 0.4])
    np.testing.assert_array_equal(minimise_constrained(look, start, np.zeros(2), np.ones(2), 1), start)


def test_what_has_no_limit_does_not_matter():
    """A constraint at infinity, as the clearance of an arm without pairs."""

    def look(x):
        return x @ x, 2 * x, np.array([np.inf]), np.zeros((1, 2))

    np.testing.assert_allclose(minimise_constrained(look, np.ones(2), np.full(2, -5.0), np.full(2, 5.0), 0), 0, atol=1e-8)
