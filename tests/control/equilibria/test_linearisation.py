"""The linearisation against the closed form (22), differences, and what is known of solutions."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast import arms
from holdfast.control import Damped, FailureTolerant, Pseudoinverse, Weighted
from holdfast.control.equilibria import Kind, linearisation
from holdfast.control.equilibria.stability import classify_kinds, is_attracting


def pose_at(x):
    pose = np.eye(4)
    pose[: len(x), 3] = x
    return pose


def planar(q):
    """Position, Jacobian and its derivatives by each joint, (2,), (2, 3), (3, 2, 3), of three unit links."""
    s = np.cumsum(q)
    u, v = np.array([np.cos(s), np.sin(s)]), np.array([-np.sin(s), np.cos(s)])
    j = np.cumsum(v[:, ::-1], axis=1)[:, ::-1]
    slopes = np.array([[-u[:, max(c, k) :].sum(axis=1) for c in range(3)] for k in range(3)]).transpose(0, 2, 1)
    return u.sum(axis=1), j, slopes


def closed_form(q, x, w):
    """Columns of eq. (22) for a weighted inverse."""
    p, j, slopes = planar(q)
    inverse = np.linalg.inv(w)
    m = np.linalg.inv(j @ inverse @ j.T)
    g, e = inverse @ j.T @ m, x - p
    columns = [-g @ slopes[k] @ g @ e + (np.eye(3) - g @ j) @ inverse @ slopes[k].T @ m @ e - g @ j[:, k] for k in range(3)]
    return np.array(columns).T


def test_weighted_inverse_against_the_closed_form(rng):
    a = rng.normal(size=(3, 3))
    w = a @ a.T + np.eye(3)
    law = Weighted(arms.load("planar-3r"), w, "planar", gain=2.5)  # the gain only scales time
    linear, healthy = linearisation(law), np.array([True, False, True])
    for _ in range(20):
        q, x = rng.uniform(-np.pi, np.pi, 3), rng.uniform(-2, 2, 2)
        expected = closed_form(q, x, law.weights)[np.ix_(healthy, healthy)]
        np.testing.assert_allclose(
            linear.matrices(q[None], pose_at(x), healthy)[0], expected, rtol=1e-8, atol=1e-8 * np.abs(expected).max()
        )


@pytest.mark.parametrize("make", [Pseudoinverse, lambda a, t: Damped(a, 0.2, t), FailureTolerant], ids=["pinv", "damped", "ft"])
def test_any_law_against_differences(rng, make):
    law = make(arms.load("planar-3r"), "planar")
    linear, healthy = linearisation(law), np.ones(3, dtype=bool)
    q, pose, h = rng.uniform(-2, 2, (10, 3)), pose_at([0.7, 0.4]), 1e-6
    exact = linear.matrices(q, pose, healthy)
    for k in range(3):
        step = h * np.eye(3)[k]
        rates = [linear.rates(q + s * step, pose)[0] for s in (1, -1)]
        np.testing.assert_allclose(exact[:, :, k], (rates[0] - rates[1]) / (2 * h), rtol=1e-5, atol=1e-6)


def test_a_task_with_turns_against_differences_and_at_the_target(rng, planar4):
    """Also where the target is reached, where the derivative of the rotation vector is 0/0."""
    law = Pseudoinverse(planar4, "planar-pose")
    linear, healthy = linearisation(law), np.arange(4) != 2
    q, pose = rng.uniform(-2, 2, 4), planar4.forward_kinematics(rng.uniform(-2, 2, 4))
    exact = linear.matrices(q[None], pose, healthy)[0]
    h = 1e-6
    steps = h * np.eye(4)[healthy]
    ahead, behind = (linear.rates(q + s * steps, pose)[0][:, healthy] for s in (1, -1))
    np.testing.assert_allclose(exact, ((ahead - behind) / (2 * h)).T, rtol=1e-4, atol=1e-4 * np.abs(exact).max())
    reached = linear.eigenvalues(q[None], planar4.forward_kinematics(q), healthy)[0]
    n = np.linalg.svd(law.task.rows @ planar4.jacobian(q))[2][-1]
    np.testing.assert_allclose(np.sort(reached.real), [-1, -1, -(n[2] ** 2)], atol=1e-8)


def test_kinds():
    values = np.array([[-1, -2], [-1, 2], [1, 2], [0, -1], [-1, -2], [1j, -1j], [np.nan, 0], [-1e-7, -1]], dtype=complex)
    error = np.array([1, 1, 1, 1, 0, 1, 1, 1.0])
    expected = [
        Kind.SINK,
        Kind.SADDLE,
        Kind.SOURCE,
        Kind.DEGENERATE,
        Kind.SOLUTION,
        Kind.DEGENERATE,
        Kind.DEGENERATE,
        Kind.DEGENERATE,
    ]
    assert classify_kinds(values, error).tolist() == expected
    assert is_attracting(values).tolist() == [True, False, False, True, True, True, False, True]


def test_speed_limit_is_left_out(rng):
    arm, q = arms.load("planar-3r"), rng.uniform(-2, 2, (5, 3))
    slow, fast = (linearisation(Pseudoinverse(arm, "planar", speed_limit=v)) for v in (0.01, None))
    healthy = np.array([False, True, True])
    np.testing.assert_array_equal(slow.matrices(q, pose_at([1.0, 1]), healthy), fast.matrices(q, pose_at([1.0, 1]), healthy))
