"""The coefficients against scipy's and against the order that they promise."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import DOP853 as Scipy
from scipy.integrate import solve_ivp

from holdfast.control.simulation.tableaus import CLASSIC_RK4, DOP853


def test_dop853_is_that_of_scipy():
    for k, row in enumerate(DOP853.rows[:-1]):
        np.testing.assert_allclose(row, Scipy.A[k + 1, : k + 1], rtol=0, atol=1e-14)
    np.testing.assert_allclose(DOP853.rows[-1], Scipy.B, rtol=0, atol=1e-14)
    for ours, theirs in zip(DOP853.errors, (Scipy.E5, Scipy.E3), strict=True):
        np.testing.assert_allclose(ours, theirs[:12], rtol=0, atol=1e-14)
        assert theirs[12] == 0


def pendulum(y):
    return np.array([y[1], -np.sin(y[0]) * (1 + 0.3 * y[1])])


def step(tableau, y, h):
    """End of a step, its middle and the derivative there."""
    k = [pendulum(y)]
    for row in tableau.rows[:-1]:
        k.append(pendulum(y + h * sum(w * d for w, d in zip(row, k, strict=True))))
    end = y + h * sum(w * d for w, d in zip(tableau.rows[-1], k, strict=True))
    if tableau.middle is None:
        return end, None, None
    k.append(pendulum(end))
    way, slope = (sum(w * d for w, d in zip(weights, k, strict=True)) for weights in tableau.middle)
    return end, y + h * way, slope


def exact(y, h):
    return solve_ivp(lambda t, y: pendulum(y), (0, h), y, "DOP853", rtol=2.3e-14, atol=1e-16).y[:, -1]


@pytest.mark.parametrize(("tableau", "order"), [(DOP853, 8), (CLASSIC_RK4, 4)])
def test_a_step_has_its_order(tableau, order):
    y = np.array([1.0, 0.7])
    long, short = (np.abs(step(tableau, y, h)[0] - exact(y, h)).max() for h in (1.0, 0.5))
    assert long / short > 2**order


def test_the_middle_of_a_step_is_of_sixth_order():
    y = np.array([1.0, 0.7])
    errors = []
    for h in (0.5, 0.25):
        _, middle, slope = step(DOP853, y, h)
        at = exact(y, h / 2)
        errors.append((np.abs(middle - at).max(), np.abs(slope - pendulum(at)).max()))
    (long, long_slope), (short, short_slope) = errors
    assert long / short > 2**6
    assert long_slope / short_slope > 2**5
    assert short < 1e-6
