"""An index of one's own with a matrix in joint space, against NumPy and finite differences."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError, TaskError
from holdfast.kinematics.indices import CustomIndex, compute_inertia_matrix, compute_singular_values


def test_a_weighted_jacobian_against_numpy_and_finite_differences(rng):
    arm = hf.arms.load("panda")
    weights = rng.uniform(0.5, 2.0, 7)

    def weighted(j, q, joints):
        return ca.det(j @ ca.diag(ca.DM(weights[joints])) @ j.T) + 1e-3 * q[joints[0]]

    index = CustomIndex(weighted, arm, "position")
    q = np.array([0.1, 0.4, -0.2, -1.5, 0.3, 1.4, 0.2])
    jacobian = arm.jacobian(q)[:3]
    for k, value in enumerate(index.by_joint(q)):
        joints = [i for i in range(7) if i != k]
        part = jacobian[:, joints]
        expected = np.linalg.det(part * weights[joints] @ part.T) + 1e-3 * q[joints[0]]
        assert value == pytest.approx(expected, rel=1e-10)
    differences = [(index(q + s) - index(q - s)) / 2e-6 for s in 1e-6 * np.eye(7)]
    assert index.gradient(q) == pytest.approx(differences, abs=1e-7)


def test_the_inertia_matrix_is_that_of_the_inverse_dynamics(rng):
    arm = hf.arms.load("panda")
    q = rng.uniform(-1, 1, 7)
    symbols = ca.SX.sym("q", 7)
    mass = np.array(ca.Function("mass", [symbols], [compute_inertia_matrix(arm, symbols)])(q))
    zero = np.zeros(7)
    columns = [arm.torque_terms(q, zero, e)[0] for e in np.eye(7)]
    assert mass == pytest.approx(np.array(columns).T, abs=1e-12)
    assert mass == pytest.approx(mass.T, abs=1e-12)


@pytest.mark.parametrize("m", [1, 3, 6])
def test_singular_values_and_their_slopes(m, rng):
    symbols = ca.SX.sym("a", m, 7)
    values = compute_singular_values(symbols)
    both = ca.Function("s", [symbols], [values, ca.jacobian(ca.sum1(values), symbols)])
    a = rng.normal(size=(m, 7))
    found, slope = (np.array(x) for x in both(a))
    u, sigma, vt = np.linalg.svd(a, full_matrices=False)
    assert np.sort(found.ravel())[::-1] == pytest.approx(sigma, rel=1e-10)
    assert pytest.approx(u @ vt, abs=1e-9) == slope.reshape(7, m).T  # the gradient of the nuclear norm
    with pytest.raises(InputError, match="the matrix has shape 7x7; it must have 1 to 6 rows"):
        compute_singular_values(ca.SX.sym("b", 7, 7))


def test_an_error_of_the_formula_is_told_in_one_sentence():
    arm = hf.arms.load("panda")
    for formula in (lambda j: j @ j, lambda j, q, joints: j[:, 9]):
        with pytest.raises(TaskError, match=r"mine: its formula failed for a Jacobian of shape \(3, 6\): ") as caught:
            CustomIndex(formula, arm, "position", name="mine")([0.0] * 7)
        assert "\n" not in str(caught.value)
