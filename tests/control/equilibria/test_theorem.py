"""Theorem 1' against the commanded rates themselves, and the two conditions of the paper that do not suffice."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast.control.equilibria import column_residual, is_stuck, null_components, stuck_subspace
from holdfast.core.errors import InputError


def three_link(q, links=(1, 1, 1)):
    """Jacobian of the planar arm, written apart."""
    s, length = np.cumsum(np.deg2rad(q)), np.asarray(links)
    p = np.array([[(length[k:] * f(s[k:])).sum() for k in range(3)] for f in (np.cos, np.sin)])
    return np.array([-p[1], p[0]])


def commanded(j, w, x):
    return np.linalg.solve(w, j.T) @ np.linalg.solve(j @ np.linalg.solve(w, j.T), x)


def random_weights(rng, n):
    a = rng.normal(size=(n, n))
    return a @ a.T + 0.3 * np.eye(n)


def test_subspace_is_where_no_healthy_joint_is_commanded(rng):
    """Random cases; in many the subspace is not empty."""
    found = 0
    for _ in range(400):
        n = int(rng.integers(2, 8))
        m = int(rng.integers(1, n + 1))
        locked = rng.permutation(n)[: int(rng.integers(1, n))]
        j, w = rng.normal(size=(m, n)), random_weights(rng, n)
        healthy = np.setdiff1d(np.arange(n), locked)
        if m > 1 and rng.random() < 0.5:
            # Make the healthy columns of J W^-1 lose rank: project them off a direction.
            u, spread = rng.normal(size=m), j @ np.linalg.inv(w)
            u /= np.linalg.norm(u)
            spread[:, healthy] -= np.outer(u, u @ spread[:, healthy])
            j = spread @ w
        if np.linalg.svd(j)[1][-1] < 1e-3:
            continue
        basis = stuck_subspace(j, w, locked)
        spread = j @ np.linalg.inv(w)
        rank = np.linalg.matrix_rank(spread[:, healthy], tol=1e-8 * np.linalg.norm(spread, 2))
        assert basis.shape == (m, m - rank)
        if m > rank:
            found += 1
            x = basis @ rng.normal(size=m - rank)
            rates = commanded(j, w, x)
            assert np.abs(rates[healthy]).max() < 1e-7 * np.abs(rates).max()
            assert is_stuck(j, w, locked, command=x, tolerance=1e-6)
            # The command is in the span of the locked columns, with the commanded rates as factors.
            np.testing.assert_allclose(j[:, locked] @ rates[locked], x, atol=1e-7 * np.linalg.norm(x) * (1 + np.linalg.cond(j)))
        assert not is_stuck(j, w, locked, command=rng.normal(size=m), tolerance=1e-6) or m - rank == m
    assert found > 100


def test_a_command_along_the_locked_column_is_not_enough():
    j = three_link([20, 40, 60])
    assert not is_stuck(j, None, [0], command=j[:, 0])
    np.testing.assert_allclose(commanded(j, np.eye(3), j[:, 0]), [0.8901, 0.2349, -0.2065], atol=1e-4)
    assert stuck_subspace(j, None, [0]).shape == (2, 0)


def test_both_conditions_of_the_paper_are_not_enough_for_two_joints():
    j = three_link([20, 40, 60])
    assert not is_stuck(j, None, [0, 1], command=[1.0, 0.0])
    assert commanded(j, np.eye(3), np.array([1.0, 0]))[2] == pytest.approx(-0.2548, abs=1e-4)
    basis = stuck_subspace(j, None, [0, 1])
    assert basis.shape == (2, 1)
    np.testing.assert_allclose(basis[:, 0] * np.sign(basis[0, 0]), [0.9508, -0.3097], atol=1e-4)
    assert is_stuck(j, None, [0, 1], command=basis[:, 0])


@pytest.mark.parametrize("weighted", [False, True])
def test_one_joint_is_stuck_where_the_null_vectors_say(rng, weighted):
    """``N' w_i = 0`` and a command along the column: necessary and sufficient for one locked joint."""
    w = random_weights(rng, 4) if weighted else np.eye(4)
    null = np.linalg.qr(np.c_[rng.normal(size=(4, 2))])[0]
    null -= np.outer(w[:, 1], w[:, 1] @ null) / (w[:, 1] @ w[:, 1])  # now N' w_1 = 0
    j = rng.normal(size=(2, 2)) @ np.linalg.svd(null.T)[2][2:]
    np.testing.assert_allclose(null_components(j, w, 1), 0, atol=1e-10)
    assert is_stuck(j, w, [1], command=j[:, 1])
    assert np.abs(null_components(j, w, 0)).max() > 1e-3
    assert not is_stuck(j, w, [0], command=j[:, 0])


def test_column_residual_is_zero_along_the_column_only(rng, mixed7):
    q = rng.uniform(-1, 1, mixed7.n)
    j = mixed7.jacobian(q)
    for k in range(mixed7.n):
        np.testing.assert_allclose(column_residual(mixed7, q, k, command=-0.7 * j[:, k]), 0, atol=1e-12)
        assert np.linalg.norm(column_residual(mixed7, q, k, command=rng.normal(size=6))) > 1e-3


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda j: stuck_subspace(j[0], None, [0]), "it must be \\(m, n\\) finite numbers"),
        (lambda j: stuck_subspace(j, [1, 2], [0]), "weights must be \\(3,\\)"),
        (lambda j: stuck_subspace(j, [1, -1, 1], [0]), "weights must be"),
        (lambda j: is_stuck(j, None, [3], command=[1, 0]), "names joint 3"),
        (lambda j: is_stuck(j, None, [0], command=[1, 0, 0]), "command has shape \\(3,\\)"),
    ],
)
def test_wrong_input_is_one_sentence(call, words):
    with pytest.raises(InputError, match=words):
        call(three_link([20, 40, 60]))
