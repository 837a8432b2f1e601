"""Small symbolic factorisations against LAPACK, through plain CasADi functions."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from scipy.linalg import null_space

import oracles
from holdfast.kernels import linalg

SIZES = [(1, 2), (1, 5), (2, 3), (2, 6), (3, 4), (3, 7), (5, 7), (6, 7), (6, 9)]


def entries(a):
    """A matrix of numbers as rows of ``SX`` scalars."""
    return [[ca.SX(float(x)) for x in row] for row in np.atleast_2d(a)]


def numbers(rows):
    return np.array([[float(ca.DM(ca.evalf(x))) for x in row] for row in rows])


def number(x):
    return float(ca.evalf(ca.SX(x)))


def with_condition(rng, m, n, cond):
    """A random (m, n) matrix with singular values from 1 down to 1 / cond."""
    u = np.linalg.qr(rng.normal(size=(m, m)))[0]
    v = np.linalg.qr(rng.normal(size=(n, n)))[0]
    return u * np.geomspace(1, 1 / cond, m) @ v[:m]


def factor(a):
    """The factorisation at one matrix, as a kernel would do it: zeros of ``a`` are structural."""
    symbol = ca.SX.sym("a", ca.DM(a).sparsity() if np.all(a) else ca.sparsify(ca.DM(a)).sparsity())
    qr = linalg.factor_householder(symbol)
    n, m = qr.n, qr.m
    null = ca.vertcat(*[ca.horzcat(*r) for r in qr.null_space_basis()])
    unit = [[ca.SX(float(i == k)) for i in range(n)] for k in range(n)]
    pinv = ca.vertcat(*[ca.horzcat(*qr.apply_pinv_transposed(qr.apply_q_transposed(e))) for e in unit])
    f = ca.Function(
        "f", [symbol], [ca.densify(null), pinv, qr.gram_determinant(), qr.singular_value_product(), qr.squared_norm()]
    )
    values = [np.array(x) for x in f(ca.DM(a))]
    return values[0].reshape(n, n - m), values[1].reshape(n, m), *(float(x.squeeze()) for x in values[2:])


@pytest.mark.parametrize(("m", "n"), SIZES)
def test_householder_against_lapack(m, n, rng):
    for _ in range(5):
        a = rng.normal(size=(m, n))
        null, pinv, squared, volume, norm = factor(a)
        other = null_space(a)
        np.testing.assert_allclose(null.T @ null, np.eye(n - m), atol=1e-14)
        np.testing.assert_allclose(null @ null.T, other @ other.T, atol=1e-13 * oracles.condition(a))
        np.testing.assert_allclose(pinv, np.linalg.pinv(a), atol=1e-13 * oracles.condition(a) ** 2)
        assert squared == pytest.approx(np.linalg.det(a @ a.T), rel=1e-11)
        assert volume == pytest.approx(np.linalg.svd(a, compute_uv=False).prod(), rel=1e-12)
        assert norm == pytest.approx((a**2).sum(), rel=1e-13)


@pytest.mark.parametrize(("m", "n"), [(2, 4), (3, 7), (6, 9)])
def test_householder_with_structural_zeros_speaks_in_the_callers_order(m, n, rng):
    for _ in range(10):
        a = np.where(rng.random((m, n)) < 0.5, 0.0, rng.normal(size=(m, n)))
        a[np.arange(m), rng.permutation(n)[:m]] += 2.0  # full rank, and the sparsest row is not always the first
        null, pinv, squared, _, _ = factor(a)
        other = null_space(a)
        tolerance = 1e-13 * oracles.condition(a) ** 2
        np.testing.assert_allclose(null @ null.T, other @ other.T, atol=tolerance)
        np.testing.assert_allclose(pinv, np.linalg.pinv(a), atol=tolerance)
        assert squared == pytest.approx(np.linalg.det(a @ a.T), rel=1e-9)


def test_a_zero_column_is_a_null_direction(rng):
    a = rng.normal(size=(3, 6))
    a[:, 2] = 0.0
    null, pinv, *_ = factor(a)
    assert np.linalg.norm(null[2]) == pytest.approx(1, abs=1e-15)
    np.testing.assert_allclose(pinv[2], 0, atol=1e-15)


@pytest.mark.parametrize("cond", [1e3, 1e5, 1e7])
def test_householder_keeps_its_digits_near_singular(cond, rng):
    if not oracles.LONG:
        pytest.skip("long double is double here, so there is no better answer to compare with")
    for _ in range(20):
        a = with_condition(rng, 6, 9, cond)
        null, *_ = factor(a)
        rho = oracles.rho_long(a.astype(np.longdouble))
        assert np.abs(np.linalg.norm(null, axis=1) - rho).max() < 2e-15 * cond


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_determinant_and_squared_volume(size, rng):
    a = rng.normal(size=(size, size))
    assert number(linalg.determinant(entries(a))) == pytest.approx(np.linalg.det(a), rel=1e-12)
    wide = rng.normal(size=(size, size + 2))
    assert number(linalg.gram_determinant(entries(wide))) == pytest.approx(np.linalg.det(wide @ wide.T), rel=1e-12)


def test_squared_volume_is_exact_near_zero(rng):
    """Two rows 1e-9 apart: the Gram determinant has no digit left, the minors have them all."""
    a = rng.normal(size=3)
    step = 1e-9 * rng.normal(size=3)
    b = a + step
    expected = np.sum(np.cross(a, b - a) ** 2)  # b - a: the rounded difference is exact
    assert number(linalg.gram_determinant(entries([a, b]))) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("size", [1, 2, 3, 6])
def test_solve_spd(size, rng):
    for cond in (10, 1e6):
        a = with_condition(rng, size, size + 1, np.sqrt(cond))
        a = a @ a.T
        b = rng.normal(size=size)
        x = numbers([linalg.solve_spd(entries(a), entries(b)[0])])[0]
        np.testing.assert_allclose(x, np.linalg.solve(a, b), rtol=1e-12 * cond)
        np.testing.assert_allclose(a @ x, b, atol=1e-13 * np.abs(x).max())


@pytest.mark.parametrize(("m", "n"), [(1, 3), (2, 3), (3, 7), (6, 9)])
def test_jacobi_sweeps_end_at_the_singular_values(m, n, rng):
    symbol = ca.SX.sym("a", m, n)
    rows, largest = linalg.jacobi_sweep([[symbol[i, k] for k in range(n)] for i in range(m)])
    sweep = ca.Function("sweep", [symbol], [ca.vertcat(*[ca.horzcat(*r) for r in rows]), largest])
    for a in (
        rng.normal(size=(m, n)),
        with_condition(rng, m, n, 1e6),
        10.0 ** -np.arange(m)[:, None] * rng.normal(size=(m, n)),
    ):
        turned, cosine, sweeps = a, 1.0, 0
        while cosine > 1e-15 and sweeps < 12:
            turned, cosine = (np.array(x) for x in sweep(turned))
            sweeps += 1
        sizes = np.sort(np.linalg.norm(turned, axis=1))[::-1]
        truth = np.linalg.svd(a, compute_uv=False)
        np.testing.assert_allclose(sizes, truth, atol=1e-14 * truth[0])
        np.testing.assert_allclose(turned.T @ turned, a.T @ a, atol=1e-13 * truth[0] ** 2)  # rotations only
        assert sweeps < 10


def test_jacobi_is_accurate_for_small_singular_values_of_graded_rows(rng):
    """Rows scaled by 1 to 1e-12: LAPACK loses the small values in absolute error, Jacobi must not."""
    a = np.linalg.qr(rng.normal(size=(7, 3)))[0].T + 0.3 * rng.normal(size=(3, 7))
    scale = np.array([1.0, 1e-6, 1e-12])
    rows = entries(scale[:, None] * a)
    for _ in range(8):
        rows, cosine = linalg.jacobi_sweep(rows)
        rows = entries(numbers(rows))
    assert number(cosine) < 1e-15
    sizes = np.linalg.norm(numbers(rows), axis=1)
    # Gram-Schmidt of the unscaled rows: the k-th distance times its scale, up to scale ratios squared (1e-12).
    expected = np.abs(np.diag(np.linalg.qr(a.T)[1])) * scale
    np.testing.assert_allclose(np.sort(sizes)[::-1], expected, rtol=1e-11)


def test_jacobi_survives_zero_rows():
    rows, largest = linalg.jacobi_sweep(entries([[0.0, 0, 0], [1, 2, 2], [0, 0, 0]]))
    np.testing.assert_allclose(np.linalg.norm(numbers(rows), axis=1), [0, 3, 0])
    assert number(largest) == 0.0


def test_dot(rng):
    a, b = rng.normal(size=(2, 5))
    assert number(linalg.dot_product(entries(a)[0], entries(b)[0])) == pytest.approx(a @ b, rel=1e-14)
