"""Speeds that a failure takes from the tool, against linear algebra that is done in another way."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest
import scipy.linalg

import holdfast as hf
from holdfast.kinematics.indices.lost_directions import find_speed_losses


@pytest.mark.parametrize("failed", [(0,), (3,), (1, 5), (0, 2, 6)])
def test_losses_are_the_generalised_eigenvectors(rng, failed):
    j = rng.normal(size=(4, 8))
    found = find_speed_losses(j, failed)
    kept = np.delete(j, failed, axis=1)
    values, vectors = scipy.linalg.eigh(kept @ kept.T, j @ j.T)
    assert len(found) == len(failed)
    for k, loss in enumerate(found):
        assert loss.kept == pytest.approx(np.sqrt(values[k]), abs=1e-12)
        other = vectors[:, k] / np.linalg.norm(vectors[:, k])
        assert abs(other @ loss.direction) == pytest.approx(1, abs=1e-9)
    ratio = np.linalg.det(kept @ kept.T) / np.linalg.det(j @ j.T)
    assert np.prod([loss.kept for loss in found]) == pytest.approx(np.sqrt(ratio), rel=1e-9)


def eigenvalues_of_two_locks(j, failed):
    """Return the squared remaining fractions of two locks from exact rational numbers, smallest first."""
    rows = [[Fraction(float(x)) for x in row] for row in j]
    gram = [[sum(a * b for a, b in zip(x, y, strict=True)) for y in rows] for x in rows]
    columns = [[row[k] for row in rows] for k in failed]
    system = [line + [column[i] for column in columns] for i, line in enumerate(gram)]
    for i in range(len(system)):  # Gauss-Jordan; the Gram matrix is positive definite
        system[i] = [x / system[i][i] for x in system[i]]
        for k in range(len(system)):
            if k != i:
                system[k] = [x - system[k][i] * y for x, y in zip(system[k], system[i], strict=True)]
    size = len(gram)
    taken = [[sum(c[i] * system[i][size + k] for i in range(size)) for k in range(2)] for c in columns]
    (a, b), (c, d) = ((1 - taken[0][0], -taken[0][1]), (-taken[1][0], 1 - taken[1][1]))
    with localcontext() as context:
        context.prec = 80
        trace, determinant = (Decimal(x.numerator) / Decimal(x.denominator) for x in (a + d, a * d - b * c))
        larger = (trace + (trace**2 - 4 * determinant).sqrt()) / 2
        return [float((determinant / larger).sqrt()), float(larger.sqrt())]


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-6, 1e-9])
def test_losses_of_two_locks_are_exact(rng, size):
    """``sqrt(1 - s^2)`` with the failed joints' part s of the row space has an error of 1e-8 for small remainders."""
    for _ in range(5):
        null_space = rng.normal(size=(8, 3))
        null_space[[2, 5]] *= size * np.array([[1.0], [0.1]])
        j = rng.uniform(0.5, 2, 5)[:, None] * np.linalg.svd(null_space)[0][:, 3:].T
        found = [loss.kept for loss in find_speed_losses(j, [2, 5])]
        np.testing.assert_allclose(found, eigenvalues_of_two_locks(j, [2, 5]), rtol=0, atol=2e-15)


def test_remaining_speed_is_the_largest_component_along_the_direction(rng):
    """The largest component along u of a velocity at joint rates of norm 1 is ``|J' u|``, healthy and failed."""
    for _ in range(10):
        j = rng.normal(size=(6, 9))
        failed = rng.permutation(9)[: int(rng.integers(1, 3))]
        for loss in find_speed_losses(j, failed):
            healthy, reduced = (np.linalg.norm(loss.direction @ x) for x in (j, np.delete(j, failed, axis=1)))
            assert loss.kept == pytest.approx(reduced / healthy, abs=1e-12)


def test_losses_of_a_singular_arm_are_those_of_its_motions(rng):
    column_space = np.linalg.qr(rng.normal(size=(6, 4))).Q
    inner = rng.normal(size=(4, 7))
    found, expected = find_speed_losses(column_space @ inner, [1, 4]), find_speed_losses(inner, [1, 4])
    assert len(found) == 2
    for loss, inner_loss in zip(found, expected, strict=True):
        assert loss.kept == pytest.approx(inner_loss.kept, abs=1e-13)
        assert abs(loss.direction @ column_space @ inner_loss.direction) == pytest.approx(1, abs=1e-12)


def test_without_redundancy_and_with_many_locks_directions_are_lost(rng):
    for columns, failed, count in ((4, (1,), 1), (6, (0, 2, 3), 3), (6, (0, 1, 2, 3, 5), 4), (6, tuple(range(6)), 4)):
        found = find_speed_losses(rng.normal(size=(4, columns)), failed)
        assert len(found) == count
        assert sum(loss.lost for loss in found) == min(count, len(failed) - (columns - 4))
        directions = np.array([loss.direction for loss in found])
        np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)
        assert np.linalg.matrix_rank(directions) == count


def test_a_joint_that_does_not_move_the_tool_takes_nothing(rng):
    j = rng.normal(size=(3, 6))
    j[:, 4] = 0.0
    first, second = find_speed_losses(j, [2, 4])
    assert (first.kept, second.kept) == pytest.approx((find_speed_losses(j, [2])[0].kept, 1.0), abs=1e-14)
    assert second.kept <= 1
    assert np.linalg.norm(second.direction) == pytest.approx(1)


def test_share_of_one_joint_is_its_relative_manipulability(mixed7, rng):
    rho = hf.indices.relative_manipulability(mixed7)
    q = rng.uniform(-1, 1, 7)
    j = mixed7.jacobian(q)
    for k, value in enumerate(rho.by_joint(q)):
        assert find_speed_losses(j, [k])[0].kept == pytest.approx(value, abs=1e-13)


def test_a_direction_that_only_one_joint_makes_is_lost(rng):
    j = rng.normal(size=(3, 5))
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    j -= np.outer(axis, axis @ j)  # no joint moves along the axis ...
    j[:, 2] += axis  # ... but one
    (loss,) = find_speed_losses(j, [2])
    assert loss.kept < 1e-13
    assert abs(loss.direction @ axis) == pytest.approx(1)
    np.testing.assert_allclose(loss.direction @ np.delete(j, 2, axis=1), 0, atol=1e-12)


def test_nothing_fails_nothing_is_lost(rng):
    assert find_speed_losses(rng.normal(size=(3, 5)), []) == []
    assert find_speed_losses(np.zeros((3, 5)), [1]) == []
