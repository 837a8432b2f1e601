"""The linear program of one ascent step, against an exact solver; the scores it raises, against numpy and differences."""

from __future__ import annotations

from functools import lru_cache

import casadi as ca
import numpy as np
import pytest
from scipy.optimize import linprog

import oracles
from holdfast.kernels.linalg import factor_householder
from holdfast.kinematics.indices import CustomIndex, Manipulability, ObjectivePart, RelativeManipulability
from holdfast.kinematics.solvers.maximin import maximin_step
from holdfast.model.arm import kinematics

RADIUS = 0.3
FAR = 1e3  # what stands for no limit


@lru_cache
def compiled(functions: int, r: int, limits: int) -> ca.Function:
    values, slopes = ca.SX.sym("s", functions), ca.SX.sym("g", functions, r)
    rows, low, high = ca.SX.sym("a", limits, r), ca.SX.sym("low", limits), ca.SX.sym("high", limits)
    radius = ca.SX.sym("radius")
    z = maximin_step(
        [ObjectivePart(1.0, ca.vertsplit(values), [[slopes[k, i] for i in range(r)] for k in range(functions)])],
        [[rows[k, i] for i in range(r)] for k in range(limits)],
        [low[k] for k in range(limits)],
        [high[k] for k in range(limits)],
        radius,
    )
    return ca.Function("step", [values, slopes, rows, low, high, radius], [ca.vertcat(*z)])


def best(s, g, a, low, high, radius):
    """``max min_k s_k + g_k z`` by HiGHS; None where no z is within the limits."""
    r = g.shape[1]
    rows = np.r_[np.c_[-g, np.ones(len(g))], np.c_[a, np.zeros(len(a))], np.c_[-a, np.zeros(len(a))]]
    result = linprog(
        np.r_[np.zeros(r), -1.0], A_ub=rows, b_ub=np.r_[s, high, -low], bounds=[(-radius, radius)] * r + [(None, None)]
    )
    return None if result.status == 2 else -result.fun


def programs(rng, functions, r, limits, count, active):
    """Programs like those of an arm: rows of an orthonormal basis, squares of rho, z = 0 within the limits."""
    for _ in range(count):
        a = np.linalg.qr(rng.normal(size=(max(limits, r), r)))[0][:limits]
        room = 10.0 ** rng.uniform(-5, -0.5, (2, limits)) if active else rng.uniform(2, 4, (2, limits))
        if active:
            room[rng.random((2, limits)) < 0.25] = FAR
            room[rng.random((2, limits)) < 0.1] = 0.0  # a joint at its limit
        yield rng.uniform(0, 0.4, functions), rng.normal(size=(functions, r)) * 0.5, a, -room[0], room[1]


def measured(step, programs, radius=RADIUS):
    """What each step misses of the exact optimum, how far it leaves the limits, and what it gains; shares of the radius."""
    short, over, gain = [], [], []
    for s, g, a, low, high in programs:
        z = np.array(step(s, g, a, low, high, radius)).ravel()
        assert np.isfinite(z).all()
        exact = best(s, g, a, low, high, radius)
        assert exact is not None
        reached = (s + g @ z).min()
        short.append(exact - reached)
        gain.append(reached - s.min())
        over.append(np.r_[a @ z - high, low - a @ z, np.abs(z) - radius].max())
    return np.array(short) / radius, np.array(over) / radius, np.array(gain) / radius


@pytest.mark.parametrize(("functions", "r", "limits"), [(7, 1, 7), (8, 2, 8), (9, 3, 9), (12, 5, 11), (1, 2, 3), (3, 3, 0)])
def test_close_to_the_exact_solution(functions, r, limits, rng):
    step = compiled(functions, r, limits)
    short, over, gain = measured(step, programs(rng, functions, r, limits, 60, active=False))
    assert short.max() < 0.01
    assert short.min() > -1e-6  # nothing beats the optimum
    assert over.max() < 1e-6
    assert gain.min() > -1e-3


@pytest.mark.parametrize("radius", [0.1, 0.3, 0.6])
@pytest.mark.parametrize(("functions", "r", "limits"), [(7, 1, 7), (8, 2, 8), (9, 3, 9), (12, 5, 11), (1, 2, 3)])
def test_joints_near_and_at_their_limits(functions, r, limits, radius, rng):
    short, over, gain = measured(compiled(functions, r, limits), programs(rng, functions, r, limits, 80, active=True), radius)
    # Against limits that it starts on, a fixed number of iterations sometimes stops early; the limits are kept all the same.
    assert np.median(short) < 0.005
    assert np.quantile(short, 0.8) < 0.08
    assert short.min() > -0.02  # a floor on the room left may pass a limit by a little
    assert over.max() < 2e-3
    assert gain.min() > -0.02


def test_a_start_outside_the_limits_comes_back(rng):
    step = compiled(9, 3, 9)

    def moved():
        for s, g, a, low, high in programs(rng, 9, 3, 9, 100, active=True):
            shift = a @ rng.uniform(-0.01, 0.01, 3)
            yield s, g, a, low + shift, high + shift

    cases = list(moved())
    before = np.array([max((-high).max(), low.max()) for _, _, _, low, high in cases]) / RADIUS
    assert np.median(before) > 0.005  # z = 0 is outside
    short, over, _ = measured(step, cases)
    assert np.quantile(short, 0.8) < 0.08
    assert np.quantile(over, 0.9) < 0.02
    assert over.max() < 0.1


@pytest.mark.parametrize("scales", [(1.0, 1.0), (1e4, 1e-5)])
@pytest.mark.parametrize("sizes", [(1, 1), (7, 1), (5, 4, 1)])
def test_a_weighted_sum_of_minima(sizes, scales, rng):
    r, limits, count = 3, 7, 60
    functions, weights = sum(sizes), (1.0, 3.0, 0.5)[: len(sizes)]
    owner = np.repeat(np.arange(len(sizes)), sizes)
    size = np.resize(scales, len(sizes))
    values, slopes = ca.SX.sym("s", functions), ca.SX.sym("g", functions, r)
    rows, low, high = ca.SX.sym("a", limits, r), ca.SX.sym("low", limits), ca.SX.sym("high", limits)
    parts = [
        ObjectivePart(
            w / c,
            [values[k] for k in np.flatnonzero(owner == p)],
            [ca.horzsplit(slopes[k, :]) for k in np.flatnonzero(owner == p)],
        )
        for p, (w, c) in enumerate(zip(weights, size, strict=True))
    ]
    z = maximin_step(
        parts, [ca.horzsplit(rows[k, :]) for k in range(limits)], ca.vertsplit(low), ca.vertsplit(high), ca.SX(RADIUS)
    )
    step = ca.Function("step", [values, slopes, rows, low, high], [ca.vertcat(*z)])
    short = []
    for s, g, a, lo, hi in programs(rng, functions, r, limits, count, active=False):
        s, g = s * size[owner], g * size[owner][:, None]

        def total(z, s=s, g=g):
            reached = s + g @ z
            return sum(w / c * reached[owner == p].min() for p, (w, c) in enumerate(zip(weights, size, strict=True)))

        # variables z, t_p: maximise the weighted t_p
        t = -np.eye(len(sizes))[owner]
        upper = np.r_[np.c_[-g, -t], np.c_[a, np.zeros((limits, len(sizes)))], np.c_[-a, np.zeros((limits, len(sizes)))]]
        cost = np.r_[np.zeros(r), [-w / c for w, c in zip(weights, size, strict=True)]]
        best = linprog(cost, A_ub=upper, b_ub=np.r_[s, hi, -lo], bounds=[(-RADIUS, RADIUS)] * r + [(None, None)] * len(sizes))
        got = total(np.array(step(s, g, a, lo, hi)).ravel())
        short.append((-best.fun - got) / (-best.fun - total(np.zeros(r))))
    assert np.median(short) < 0.02
    assert np.quantile(short, 0.9) < 0.15
    assert min(short) > -1e-6


# ---- the scores ----------------------------------------------------------------------------------------------------------


def evaluated(index):
    """A function q -> scores (F,), slopes (F, r), null-space directions (n, r), as the ascent builds them."""
    q = kinematics.joint_symbols(index.arm)
    j = kinematics.invariant_jacobian(index.arm, q) if index.task.invariant else index.task.jacobian(index.arm, q)
    qr = factor_householder(j)
    rows = qr.null_space_basis()
    directions = [ca.vertcat(*[row[c] for row in rows]) for c in range(index.arm.n - index.task.m)]
    values, slopes = index.scores(q, j, qr, directions)
    slopes = ca.vertcat(*[ca.horzcat(*row) for row in slopes])
    made = ca.Function("scores", [q], [ca.vertcat(*values), slopes, ca.horzcat(*directions)])
    return lambda x: [np.array(y) for y in made(x)]


def assert_scores(index, expected, rng, count=8, task="pose", length=1.0):
    """``expected``: a numpy function q (M, n) -> (M, F)."""
    function = evaluated(index)
    arm, checked = index.arm, 0
    for q in oracles.inside(arm, rng, count):
        j = oracles.task_jacobian(arm, q[None], task, length=length)
        if oracles.condition(j)[0] > 100:
            continue
        checked += 1
        values, slopes, null = function(q)
        np.testing.assert_allclose(j[0] @ null, 0, atol=1e-11)
        np.testing.assert_allclose(null.T @ null, np.eye(null.shape[1]), atol=1e-12)
        at = expected(q[None])[0]
        np.testing.assert_allclose(values.ravel(), at, rtol=1e-9, atol=1e-12 * np.abs(at).max())
        assert slopes.shape == (len(index.failures), null.shape[1])
        wanted = oracles.slope(expected, q).T @ null
        np.testing.assert_allclose(slopes, wanted, rtol=1e-6, atol=1e-7 * max(np.abs(wanted).max(), np.abs(at).max()))
    assert checked >= count // 2


@pytest.mark.parametrize("failures", ["single", "some"])
@pytest.mark.parametrize("kind", [RelativeManipulability, Manipulability])
@pytest.mark.parametrize(
    ("arm", "task"), [("mixed8", "pose"), ("mixed7", "pointing"), ("pa10", "pose"), ("mixed5", "position")]
)
def test_slopes_of_built_in_indices(arm, task, kind, failures, rng, request):
    arm = request.getfixturevalue(arm)
    index = kind(arm, task, [(3,), (0, 2), (1,), (1, 4)] if failures == "some" else "single")
    name = "relative-manipulability" if kind is RelativeManipulability else "manipulability"

    def expected(q):
        return oracles.index(name, oracles.task_jacobian(arm, q, task), index.failures) ** 2

    assert_scores(index, expected, rng, task=task)
    q = oracles.inside(arm, rng, 5)
    np.testing.assert_allclose(index.by_joint(q) ** 2, expected(q), rtol=1e-6, atol=1e-10)


@pytest.mark.parametrize("task", ["pose", "position"])
def test_slopes_with_a_characteristic_length(task, mixed8, rng):
    index = Manipulability(mixed8, task, length=0.3)

    def expected(q):
        return oracles.index("manipulability", oracles.task_jacobian(mixed8, q, task, length=0.3), index.failures) ** 2

    assert_scores(index, expected, rng, task=task, length=0.3)


@pytest.mark.parametrize("better", ["larger", "smaller"])
@pytest.mark.parametrize("failures", ["single", "pairs"])
def test_slopes_of_an_index_of_your_own(better, failures, mixed5, rng):
    index = CustomIndex(lambda j: ca.sumsqr(j) + j[0, 0] * j[1, 2], mixed5, "position", failures=failures, better=better)
    sign = 1.0 if better == "larger" else -1.0

    def expected(q):
        j = oracles.task_jacobian(mixed5, q, "position")
        kept = [np.delete(j, list(s), axis=2) for s in index.failures]
        return sign * np.stack([(x**2).sum(axis=(1, 2)) + x[:, 0, 0] * x[:, 1, 2] for x in kept], axis=1)

    assert_scores(index, expected, rng, task="position")


def test_scores_of_random_arms(rng):
    for n in (7, 8, 9):
        arm = oracles.random_arm(rng, n, types="".join(rng.permutation(list("RRRRRRRRC"[9 - n :]))), limits=2.5)
        for index, name in ((RelativeManipulability(arm), "relative-manipulability"), (Manipulability(arm), "manipulability")):
            assert_scores(
                index,
                lambda q, arm=arm, name=name, index=index: oracles.index(name, oracles.jacobian(arm, q), index.failures) ** 2,
                rng,
            )
