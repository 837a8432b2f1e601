"""Exact gradients against central differences of the numpy oracle, and against the closed forms of the paper's spec."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import oracles
from holdfast import indices
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.kinematics.indices import CustomIndex
from holdfast.model.arm.task import task_from_rows
from holdfast.model.failure_modes import failure_sets

# arm, task, frame, failures, length
CASES = {
    "PA10 pose": ("pa10", "pose", "base", "single", 0.7),
    "mixed pointing": ("mixed7", "pointing", "tool", "single", 1.0),
    "mixed position, pairs": ("mixed5", "position", "base", "pairs", 1.0),
    "mixed rows, sets": ("mixed5", ["vx", "wy"], "tool", [(0, 2), 4, (1, 3, 4)], 0.5),
    "planar, pairs": ("planar4", "planar", "base", "pairs", 2.0),
    "planar pose": ("planar4", "planar-pose", "base", "single", 1.0),
}


def away_from_kinks(index, jacobian, q, sets):
    """Rows whose worst failure is clear and which are not near a singularity or a double extreme singular value."""
    j = jacobian(q)
    values = oracles.index(index.slug, j, sets, index)
    ordered = np.sort(-values if index.better == "smaller" else values, axis=1)
    gap = (ordered[:, 1] - ordered[:, 0]) / np.abs(ordered[:, 0])
    worst = values.argmax(1) if index.better == "smaller" else values.argmin(1)
    apart = []
    for x, k in zip(j, worst, strict=True):
        s = np.linalg.svd(np.delete(x, list(sets[k]), axis=1), compute_uv=False)
        apart.append(np.min(-np.diff(s)) / s[0] if s.size > 1 else 1.0)
    cond = 1 / np.maximum(1e-300, oracles.index("minimum-singular-value", j, sets).min(1))
    return (gap > 0.05) & (np.array(apart) > 0.02) & (oracles.condition(j) < 30) & (cond < 30)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("name", INDEX_REGISTRY)
def test_gradient_against_central_differences(name, case, request, rng):
    arm_name, task, frame, failures, length = CASES[case]
    arm = request.getfixturevalue(arm_name)
    given = task if isinstance(task, str) else task_from_rows(task, frame=frame)
    index, sets = oracles.index_of(name, arm, given, failures, length), failure_sets(arm, failures)

    def jacobian(q):
        return oracles.task_jacobian(arm, q, task, frame, length)

    q = oracles.inside(arm, rng, 400)
    q = q[away_from_kinks(index, jacobian, q, sets)][:6]
    assert len(q) >= 3
    gradient = index.gradient(q)
    assert gradient.shape == q.shape
    for row, g in zip(q, gradient, strict=True):
        expected = oracles.slope(lambda x: oracles.worst(index.better, oracles.index(name, jacobian(x), sets, index)), row)
        np.testing.assert_allclose(g, expected, atol=2e-7 * max(1.0, np.abs(expected).max()))
        assert np.abs(expected).max() > 1e-3
        np.testing.assert_array_equal(index.gradient(row), g)


@pytest.mark.parametrize("arm_name", ["pa10", "mixed7"])
def test_gradient_against_the_closed_forms(arm_name, request, rng):
    """``d(rho_k^2)/dq_j = -2 a_k' (j'_k - J' J' a_k)`` and ``d log det(J J')/dq_j = 2 tr(G J' J')``."""
    arm = request.getfixturevalue(arm_name)
    rho, kr = indices.relative_manipulability(arm), indices.manipulability(arm)
    q = oracles.inside(arm, rng, 60)
    jacobians = oracles.jacobian(arm, q)
    checked = 0
    for row, j in zip(q, jacobians, strict=True):
        if oracles.condition(j) > 200:
            continue
        dj = oracles.jacobian_slope(arm, j)
        g = np.linalg.inv(j @ j.T)
        squares = 1 - np.einsum("ik,ij,jk->k", j, g, j)
        for index, values in ((rho, squares), (kr, squares)):
            k = int(values.argmin())
            a = g @ j[:, k]
            d_square = np.array([-2 * a @ (d[:, k] - d @ j.T @ a) for d in dj])
            d_log = np.array([2 * np.trace(g @ d @ j.T) for d in dj])
            size = np.linalg.det(j @ j.T)
            if index is rho:
                expected = d_square / (2 * np.sqrt(squares[k]))
            else:
                expected = (d_square * size + squares[k] * size * d_log) / (2 * np.sqrt(squares[k] * size))
            tolerance = 1e-11 * oracles.condition(j) ** 2 * max(1, np.abs(expected).max())
            np.testing.assert_allclose(index.gradient(row), expected, atol=tolerance)
            assert index.worst_joint(row) == k
        checked += 1
    assert checked > 20


def test_gradient_of_a_tie_is_that_of_one_of_them(flat4):
    """Two joints with the same value by symmetry: the gradient is the one of a single failure, not a mixture."""
    q = np.array([0.3, 0.5, -0.4, 0.9])
    index = indices.relative_manipulability(flat4, "planar", [0, 1, 2, 3])
    singles = [indices.relative_manipulability(flat4, "planar", [k]) for k in range(4)]
    k = int(index.worst_failure(q))
    np.testing.assert_allclose(index.gradient(q), singles[k].gradient(q), rtol=1e-12, atol=1e-13)


def test_a_custom_index_equals_the_built_in_one(mixed5, rng):
    def formula(j):
        return ca.sqrt(ca.det(j @ j.T))

    q = oracles.inside(mixed5, rng, 100)
    q = q[oracles.condition(oracles.jacobian(mixed5, q)[:, :2]) < 20]
    for failures in ([0, 1, 2, 3, 4], [(0, 1), 4]):
        own = CustomIndex(formula, mixed5, ["vx", "vy"], failures=failures, length=0.5, name="own", unit="1")
        built_in = indices.manipulability(mixed5, ["vx", "vy"], failures, length=0.5)
        np.testing.assert_allclose(own.by_joint(q), built_in.by_joint(q), rtol=1e-9, atol=1e-12)
        np.testing.assert_array_equal(own.worst_failure(q), built_in.worst_failure(q))
        np.testing.assert_allclose(own.gradient(q), built_in.gradient(q), rtol=1e-7, atol=1e-8)


def test_a_custom_index_that_should_be_small(mixed7, rng):
    """Squared Frobenius norm: the worst failure is the one that leaves the most, and the gradient follows it."""
    own = CustomIndex(ca.sumsqr, mixed7, "position", name="size", better="smaller", bound=0.0)
    q = oracles.inside(mixed7, rng, 30)
    j = oracles.jacobian(mixed7, q)[:, :3]
    values = np.stack([(np.delete(j, k, 2) ** 2).sum((1, 2)) for k in range(7)], 1)
    np.testing.assert_allclose(own.by_joint(q), values, rtol=1e-13)
    np.testing.assert_allclose(own(q), values.max(1), rtol=1e-13)
    for row in q[:4]:

        def worst(x, row=row):
            j = oracles.jacobian(mixed7, x)[:, :3]
            k = int(own.worst_joint(row))
            return (np.delete(j, k, 2) ** 2).sum((1, 2))

        np.testing.assert_allclose(own.gradient(row), oracles.slope(worst, row), atol=1e-8)
    assert (own.bound, own.better, own.singular_value_by_convention) == (0.0, "smaller", np.inf)
