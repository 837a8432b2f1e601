"""Theorem R3: what a kernel's sum is for real Jacobians, and certificates that the replay in integers accepts or refuses."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from measurements.upper_bounds import pair_kernels
from scipy.special import eval_gegenbauer

import holdfast as hf
from holdfast.kinematics.index_bounds.theorems import PAIR_BOUNDS

SPECIFIED = {  # what the specification's table says of c(n, n - m, 2)
    (5, 2): 0.516252,
    (6, 2): 0.610551,
    (7, 2): 0.673590,
    (8, 2): 0.719256,
    (9, 2): 0.753868,
    (10, 2): 0.780828,
    (7, 3): 0.521993,
    (8, 3): 0.583389,
    (9, 3): 0.635095,
    (10, 3): 0.674159,
}


@pytest.mark.parametrize("size", [(7, 2), (8, 2)])
def test_certificates_are_replayed(size):
    certificate = pair_kernels.stored_certificates()[size]
    assert float(certificate.bound) <= certificate.proved_bound() <= PAIR_BOUNDS[size]
    n, m = size
    c = hf.index_bounds.upper_bound(n=n, m=m, k=2)
    assert (c.bound, c.bound_by) == (PAIR_BOUNDS[size], "R3")


def test_no_bound_is_above_the_specified_one_nor_below_what_is_attained():
    assert set(PAIR_BOUNDS) == set(SPECIFIED) == set(pair_kernels.stored_certificates())
    for (n, m), said in SPECIFIED.items():
        assert (
            hf.index_bounds.upper_bound(n=n, m=m, k=2).best_known
            < pair_kernels.stored_certificates()[n, m].bound
            <= PAIR_BOUNDS[n, m]
            < said
        )


@pytest.mark.parametrize("size", [(6, 2), (9, 3)])
def test_the_sum_over_pairs_and_joints_is_not_negative_for_any_jacobian(size, rng):
    """Evaluated from the exact polynomials, beside the definition by SciPy's Gegenbauer polynomials."""
    c = pair_kernels.stored_certificates()[size]
    n, m = size
    low, high = map(float, c.squared_column_norm_range)
    pairs, joints = pair_kernels.kernel_polynomial(c).astype(float), pair_kernels.diagonal_term(c).astype(float)
    for _ in range(20):
        rows = np.linalg.qr(rng.normal(size=(n, m)))[0]
        projector = rows @ rows.T
        y = np.diag(projector)
        s = projector**2 / np.outer(y, y)
        u = (y - low) / (high - low)
        each = np.polynomial.polynomial.polyval3d(*np.broadcast_arrays(u[:, None], u[None], s), pairs)
        assert each[0, 1] == pytest.approx(defined(c, y[0], y[1], s[0, 1]), rel=1e-6, abs=1e-8)
        assert each[~np.eye(n, dtype=bool)].sum() + np.polynomial.polynomial.polyval(u, joints).sum() > -1e-9


def defined(c, y, z, s):
    """The kernel in floating point, from the certificate's numbers."""

    def gegenbauer(degree, dimension, square):
        a = max((dimension - 2) / 2, 1e-9)  # dimension 2: Chebyshev, a limit
        return eval_gegenbauer(2 * degree, a, np.sqrt(square)) / eval_gegenbauer(2 * degree, a, 1)

    x, w = ((4 * (v - c.m / c.n)) ** np.arange(5) for v in (y, z))
    lost = (1 - y) * (1 - z)
    total = 0.0
    for degree, r in enumerate(c.row):
        total += x[:3] @ (r @ r.T).astype(float) @ w[:3] * gegenbauer(degree, c.m, s)
    for degree, r in enumerate(c.null, start=1):
        total += lost**degree * (x[:3] @ (r @ r.T).astype(float) @ w[:3]) * gegenbauer(degree, c.n - c.m, y * z * s / lost)
    h1, h0, h = (np.array(f, dtype=float) for f in c.linear)
    return total + ((h1 @ x) * z * s + (h1 @ w) * y * s + (h0 @ x) * z + (h0 @ w) * y + h @ x + h @ w) / 2


def test_a_certificate_that_is_wrong_is_refused():
    c = pair_kernels.stored_certificates()[7, 2]
    with pytest.raises(ValueError, match="not proven"):
        replace(c, bound=c.bound * Fraction(98, 100)).proved_bound()
    other = c.row[1].copy()
    other[0, 0] += Fraction(1, 5)
    with pytest.raises(ValueError, match="not proven"):
        replace(c, row=(c.row[0], other, *c.row[2:])).proved_bound()
    with pytest.raises(ValueError, match="no room"):
        replace(c, bound=Fraction(99, 100)).proved_bound()


def test_halves_of_a_polynomial_are_rounded_upwards(rng):
    """Bernstein coefficients after many halvings stay above the exact values, and near them."""
    exact = np.array([Fraction(int(x), 997) for x in rng.integers(-900, 900, size=6)])
    rounded = pair_kernels._round_up(exact)
    scale = pair_kernels._LARGEST_COEFFICIENT / max(abs(x) for x in exact)
    for _ in range(25):
        side = int(rng.integers(2))
        rounded = pair_kernels._bisect_coefficients(rounded, 0)[side]
        rows = [exact]
        while len(rows[-1]) > 1:
            rows.append((rows[-1][:-1] + rows[-1][1:]) / 2)
        exact = np.array([r[-side] for r in rows][:: 1 if side == 0 else -1])
        more = [Fraction(int(a)) - scale * b for a, b in zip(rounded, exact, strict=True)]
        assert min(more) >= 0
        assert max(more) < 200
