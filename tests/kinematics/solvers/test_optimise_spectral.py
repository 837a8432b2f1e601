"""Optimising the indices of singular values: scores against numpy, optima against SLSQP and exhaustive search."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from scipy.optimize import minimize

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.core.errors import TaskError
from holdfast.core.status import Status
from holdfast.kernels import Kernel
from holdfast.kernels.linalg import factor_householder
from holdfast.kinematics.indices import Index, SpectralIndex
from holdfast.kinematics.solvers import optimise, solver
from holdfast.model.arm import kinematics

FORMULAS = ("mean", "geometric mean", "minimum", "condition number")
NAMES = {
    "mean": "mean-singular-value",
    "geometric mean": "geometric-mean-singular-value",
    "minimum": "minimum-singular-value",
    "condition number": "condition-number",
}


def by_failure(formula, arm, q, task="pose", length=1.0):
    j = oracles.task_jacobian(arm, q, task, length=length)
    return oracles.index(NAMES[formula], j, [(k,) for k in range(arm.n)])


def score(formula, arm, q, task="pose", length=1.0):
    """The index, larger is better: the condition number by its inverse."""
    values = by_failure(formula, arm, q, task, length)
    return 1 / values if formula == "condition number" else values


def scores_kernel(index):
    """Scores, slopes and directions as the ascent asks for them: the Jacobian handed over may be of another frame."""
    arm = index.arm
    q = kinematics.joint_symbols(arm)
    j = kinematics.invariant_jacobian(arm, q) if index.task.invariant else index.task.jacobian(arm, q)
    qr = factor_householder(j)
    rows = qr.null_space_basis()
    directions = [ca.vertcat(*[row[c] for row in rows]) for c in range(arm.n - index.task.m)]
    values, slopes = index.scores(q, j, qr, directions)
    outputs = [ca.vertcat(*values), ca.vertcat(*[ca.horzcat(*row) for row in slopes]), ca.horzcat(*directions)]
    return Kernel("scores", [q], outputs, backend="casadi")


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("name", "task", "length"), [("mixed8", "pose", 0.4), ("mixed5", "position", 0.7)])
def test_scores_and_slopes(formula, name, task, length, request, rng):
    arm = request.getfixturevalue(name)
    index = SpectralIndex(formula, arm, task, length=length)
    q = oracles.inside(arm, rng, 40)
    values, slopes, directions = scores_kernel(index)(q)
    free = arm.n - index.task.m
    slopes, directions = slopes.reshape(len(q), arm.n, free), directions.reshape(len(q), arm.n, free)
    wanted = score(formula, arm, q, task, length)
    np.testing.assert_allclose(values, wanted, rtol=1e-5 if formula == "mean" else 1e-7)
    for row in range(len(q)):
        for c in range(free):
            v = directions[row, :, c]
            along = oracles.slope(lambda x, v=v, row=row: score(formula, arm, q[row] + x * v, task, length), np.zeros(1), 1e-4)[
                0
            ]
            np.testing.assert_allclose(slopes[row, :, c], along, rtol=1e-3, atol=2e-4 * np.abs(along).max())


# ---- a planar arm: its best configuration by exhaustive search ---------------------------------------------------------


def planar3(limit):
    return hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=-limit, upper=limit) for _ in range(3)], name="planar")


def planar_pose(distance, angle):
    pose = np.eye(4)
    pose[:2, 3] = distance * np.cos(angle), distance * np.sin(angle)
    return pose


@pytest.mark.parametrize("formula", FORMULAS)
def test_exhaustive_search_on_the_self_motion(formula, rng):
    arm = planar3(1.8)
    poses = np.array([planar_pose(*x) for x in zip(rng.uniform(0.8, 2.8, 40), rng.uniform(-1.2, 1.2, 40), strict=True)])
    best = optimise(arm, poses, SpectralIndex(formula, arm, "planar")).require_ok()
    reached = oracles.forward(arm, best.q)
    np.testing.assert_allclose(reached[:, :3, 3], poses[:, :3, 3], atol=2e-6)
    assert ((best.q >= arm.lower) & (best.q <= arm.upper)).all()
    mine = score(formula, arm, best.q, "planar").min(axis=1)
    value = oracles.worst("smaller" if formula == "condition number" else "larger", by_failure(formula, arm, best.q, "planar"))
    np.testing.assert_allclose(best.value, value, rtol=1e-9)
    sign = -1.0 if formula == "condition number" else 1.0
    assert (sign * best.value >= sign * best.start_value).all()
    exact = np.array([score(formula, arm, oracles.three_link_fibre(arm, p[:3, 3]), "planar").min(axis=1).max() for p in poses])
    assert (exact - mine <= 1e-3).mean() >= 0.95
    assert (mine - exact).max() < 1e-2  # the search is a grid


@pytest.mark.parametrize("formula", ["minimum", "condition number"])
def test_a_pose_with_only_a_singular_configuration(formula):
    """Stretched out, where the condition number is infinite: nothing to find, nothing to divide by."""
    arm = planar3(1.8)
    best = optimise(arm, np.array([planar_pose(3.0, 0.0), planar_pose(2.0, 0.3)]), SpectralIndex(formula, arm, "planar"))
    assert best.status[1] == Status.OK
    assert np.isfinite(best.value[1])
    assert best.success[0]
    singular = best.value[0] > 1e3 if formula == "condition number" else best.value[0] < 1e-3
    assert singular
    assert not np.isnan(best.agreeing).any()


# ---- the Panda: SLSQP from the best of many configurations -------------------------------------------------------------


def slsqp(formula, arm, pose, starts):
    """max t subject to score >= t, the pose and the limits, derivatives by differences; the best score found."""
    n, step = arm.n, 1e-6 * np.eye(arm.n)

    def error(q):
        reached = oracles.forward(arm, q)
        turn = pose[:3, :3].T @ reached[:, :3, :3]
        twist = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], 1)
        return np.c_[reached[:, :3, 3] - pose[:3, 3], twist]

    def jac(function, q):
        return (function(q + step) - function(q - step)).T / 2e-6

    constraints = [
        {
            "type": "ineq",
            "fun": lambda x: score(formula, arm, x[None, :n])[0] - x[n],
            "jac": lambda x: np.c_[jac(lambda q: score(formula, arm, q), x[:n]), -np.ones(n)],
        },
        {"type": "eq", "fun": lambda x: error(x[None, :n])[0], "jac": lambda x: np.c_[jac(error, x[:n]), np.zeros(6)]},
    ]
    bounds = [*zip(arm.lower, arm.upper, strict=True), (None, None)]
    found = -np.inf
    for q in starts:
        result = minimize(
            lambda x: -x[n],
            np.r_[q, score(formula, arm, q[None]).min()],
            jac=lambda x: -np.eye(n + 1)[n],
            method="SLSQP",
            bounds=bounds,
            constraints=constraints,
            options={"maxiter": 40, "ftol": 1e-9},
        )
        q = np.clip(result.x[:n], arm.lower, arm.upper)[None]
        if np.abs(oracles.forward(arm, q)[0] - pose).max() < 1e-6:
            found = max(found, score(formula, arm, q).min())
    return found


def test_as_good_as_slsqp_on_the_panda(rng):
    formula = "minimum"
    arm = arms.load("panda")
    poses = oracles.forward(arm, oracles.inside(arm, rng, 12))
    best = optimise(arm, poses, SpectralIndex(formula, arm), starts=128).require_ok()
    mine = score(formula, arm, best.q).min(axis=1)
    np.testing.assert_allclose(oracles.forward(arm, best.q), poses, atol=3e-6)
    np.testing.assert_allclose(best.value, mine, rtol=1e-9)
    assert (best.value >= best.start_value).all()
    draws = 40
    some = hf.solve_ik(arm, np.repeat(poses, draws, axis=0), seed=5, restarts=3)
    q, ok = some.q.reshape(len(poses), draws, -1), some.success.reshape(len(poses), draws)
    reference = []
    for k, pose in enumerate(poses):
        mine_q = q[k][ok[k]]
        values = score(formula, arm, mine_q).min(axis=1)
        reference.append(slsqp(formula, arm, pose, mine_q[np.argsort(-values)[:1]]))
    short = np.array(reference) - mine
    assert (short <= 1e-3).mean() >= 0.9  # one of twelve
    assert np.median(np.abs(short)) < 1e-3  # and the reference is one


# ---- what can and cannot be optimised ----------------------------------------------------------------------------------


@pytest.mark.parametrize("formula", ["geometric mean", "minimum", "condition number", "mean"])
def test_joints_that_fail_together(formula, planar4, rng):
    failures = [(0, 2), (3,)]
    poses = oracles.forward(planar4, oracles.inside(planar4, rng, 6))
    index = SpectralIndex(formula, planar4, "planar", failures=failures)
    best = optimise(planar4, poses, index).require_ok()
    sign = 1 if index.better == "larger" else -1
    assert (sign * best.value >= sign * best.start_value).all()
    assert (sign * best.value > sign * best.start_value).mean() > 0.5
    # Every configuration of each pose, on a grid of the angles of its first two links, brought onto the pose.
    engine = solver(planar4, index.task)
    for pose, value in zip(poses, best.value, strict=True):
        many, on = engine.attempt(oracles.inside(planar4, rng, 3000), np.broadcast_to(pose, (3000, 4, 4)), 1e-6)
        assert sign * value >= (sign * index(many[on])).max() - 0.02 * abs(value)


def test_what_is_measured_are_scores_and_their_gradients(mixed5, rng):
    for formula in ("minimum", "condition number", "mean"):
        index = SpectralIndex(formula, mixed5, "position", failures=[(0, 3), (1,), (2, 4)])
        q = oracles.inside(mixed5, rng, 4)
        values = index.by_joint(q)
        found = index.measure(q)
        np.testing.assert_allclose(found[:, :3], 1 / values if formula == "condition number" else values, rtol=1e-9)
        for row, x in zip(found, q, strict=True):
            wanted = oracles.slope(lambda y, index=index: index.measure(y)[:, :3], x)
            np.testing.assert_allclose(row[3:].reshape(3, 5), wanted.T, rtol=1e-5, atol=1e-6)
    with pytest.raises(TaskError, match="no law can serve it"):
        hf.path_following.GradientProjection(mixed5, index)


def test_an_index_without_scores(mixed5, rng):
    class Bare(Index):
        def _evaluate_by_failure(self, q):
            raise NotImplementedError

        def _evaluate_gradient(self, q):
            raise NotImplementedError

    poses = oracles.forward(mixed5, oracles.inside(mixed5, rng, 1))
    with pytest.raises(TaskError, match="bare cannot be optimised: it has no scores"):
        optimise(mixed5, poses, Bare("bare", mixed5, "position"))
