"""Distance of two segments against bounded least squares, for crossing, parallel, touching and pointlike ones."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from holdfast.model.collision.segments import LineSegment, closest_parameters, distance_between_points


def ours(p, u, q, v):
    """Distance and feet of the segments p + s u and q + t v, by constant folding."""
    a, b = (LineSegment(ca.SX(ca.DM(x)), ca.SX(ca.DM(y)), float(np.dot(y, y))) for x, y in ((p, u), (q, v)))
    s, t = closest_parameters(a, b)
    return tuple(float(ca.evalf(x)) for x in (distance_between_points(a, b, s, t), s, t))


def theirs(p, u, q, v):
    """Least squares on the unit square: exact up to rounding, also where it is rank deficient."""
    done = lsq_linear(np.column_stack([u, -np.asarray(v)]), np.subtract(q, p), (0, 1), method="bvls", tol=1e-15)
    return np.sqrt(2 * done.cost)


def check(p, u, q, v, atol=1e-12):
    value, s, t = ours(p, u, q, v)
    assert 0 <= s <= 1
    assert 0 <= t <= 1
    apart = np.linalg.norm(np.add(p, np.multiply(s, u)) - np.add(q, np.multiply(t, v)))
    assert value == pytest.approx(max(apart, 1e-12), abs=1e-15)
    # A squared distance is known to about the rounding of the squared sizes.
    assert value**2 == pytest.approx(theirs(p, u, q, v) ** 2, abs=1e-15 + atol * value)
    return value


def test_random_segments(rng):
    for _ in range(300):
        p, u, q, v = rng.normal(size=(4, 3)) * 10 ** rng.uniform(-1.5, 0.5, (4, 1))
        check(p, u, q, v)


def test_no_sampled_pair_of_points_is_closer(rng):
    s, t = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60))
    for _ in range(50):
        p, u, q, v = rng.normal(size=(4, 3))
        apart = (p - q)[:, None, None] + u[:, None, None] * s - v[:, None, None] * t
        sampled = np.sqrt((apart**2).sum(axis=0)).min()
        value = ours(p, u, q, v)[0]
        assert sampled - 0.02 * (np.linalg.norm(u) + np.linalg.norm(v)) < value <= sampled + 1e-14


def test_segments_in_one_plane_and_on_one_line(rng):
    for _ in range(200):
        p, u, q, v = rng.integers(-2, 3, (4, 3)).astype(float)  # many parallel, collinear, touching and pointlike ones
        check(p, u, q, v)


@pytest.mark.parametrize("sense", [1, -1])
def test_parallel_segments(rng, sense):
    for _ in range(100):
        p, u, q = rng.normal(size=(3, 3))
        check(p, u, q, sense * rng.uniform(0.1, 3) * u)


@settings(max_examples=150)
@given(seed=st.integers(0, 2**32 - 1), angle=st.floats(-16, 0).map(lambda x: 10**x), gap=st.floats(-9, 0).map(lambda x: 10**x))
def test_nearly_parallel_segments(seed, angle, gap):
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    u = turn @ [1.0, 0, 0]
    v = turn @ [np.cos(angle), np.sin(angle), 0] * rng.choice([-1, 1]) * rng.uniform(0.2, 2)
    q = turn @ [rng.uniform(-1.5, 1.5), 0.1 * angle, gap]
    value, _, _ = ours(np.zeros(3), u, q, v)
    # sin^2 of the angle is known to 1e-15 only, which moves a foot across a strip that narrow.
    assert value**2 == pytest.approx(theirs(np.zeros(3), u, q, v) ** 2, abs=5e-15)


def test_points(rng):
    zero = np.zeros(3)
    for _ in range(50):
        p, u, q = rng.normal(size=(3, 3))
        assert check(p, zero, q, zero) == pytest.approx(np.linalg.norm(p - q))
        assert check(p, u, q, zero) == pytest.approx(check(q, zero, p, u))


def test_derivatives_are_finite_where_feet_are_not_unique():
    x = ca.SX.sym("x", 12)
    cases = [
        [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0],  # parallel, side by side
        [0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0],  # on one line
        [0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0],  # the same
        [0, 0, 0, 1, 0, 0, 0.5, -0.5, 0, 0, 1, 0],  # crossing
        [0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0],  # touching at their ends
    ]
    for squares in ((1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0)):
        spans = [x[3:6], x[9:12]]
        a, b = (LineSegment(x[6 * k : 6 * k + 3], spans[k] if squares[k] else ca.SX(3, 1), squares[k]) for k in (0, 1))
        value = distance_between_points(a, b, *closest_parameters(a, b))
        f = ca.Function("f", [x], [value, ca.gradient(value, x), ca.jacobian(value, x)])
        for case in cases:
            assert all(np.isfinite(np.array(y)).all() for y in f(case))
