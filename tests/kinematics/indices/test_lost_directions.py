"""What a failure takes from the hand, against plain linear algebra that is done another way."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

import holdfast as hf
from holdfast.kinematics.indices.lost_directions import (
    find_speed_losses,
    manipulability_ellipsoid,
    null_space_joint_rates,
    remaining_manipulability,
)


def test_ellipsoid_is_the_gram_matrix_of_the_joints_that_move(rng):
    for failed in ((), (2,), (0, 4)):
        j = rng.normal(size=(3, 6))
        shape = manipulability_ellipsoid(j, failed)
        kept = np.delete(j, list(failed), axis=1)
        assert np.linalg.det(shape.axes) == pytest.approx(1)
        assert (np.diff(shape.radii) <= 0).all()
        np.testing.assert_allclose(shape.axes @ np.diag(shape.radii**2) @ shape.axes.T, kept @ kept.T, atol=1e-12)


def test_ellipsoid_of_a_flat_arm_is_flat(flat4):
    shape = manipulability_ellipsoid(flat4.jacobian([0.1, 0.4, -0.3, 0.8])[:3])
    assert shape.radii[2] == pytest.approx(0, abs=1e-12)
    assert abs(shape.axes[2, 2]) == pytest.approx(1)


@pytest.mark.parametrize("failed", [(0,), (3,), (1, 5), (0, 2, 6)])
def test_losses_are_the_generalised_eigenvectors(rng, failed):
    j = rng.normal(size=(4, 8))
    found = find_speed_losses(j, failed)
    kept = np.delete(j, failed, axis=1)
    values, vectors = scipy.linalg.eigh(kept @ kept.T, j @ j.T)
    assert len(found) == len(failed)
    for k, loss in enumerate(found):
        assert loss.kept == pytest.approx(np.sqrt(values[k]), abs=1e-9)
        other = vectors[:, k] / np.linalg.norm(vectors[:, k])
        assert abs(other @ loss.direction) == pytest.approx(1, abs=1e-9)
    ratio = np.linalg.det(kept @ kept.T) / np.linalg.det(j @ j.T)
    assert remaining_manipulability(found) == pytest.approx(np.sqrt(ratio), rel=1e-9)


def test_share_of_one_joint_is_its_relative_manipulability(mixed7, rng):
    rho = hf.indices.relative_manipulability(mixed7)
    q = rng.uniform(-1, 1, 7)
    j = mixed7.jacobian(q)
    for k, value in enumerate(rho.by_joint(q)):
        assert find_speed_losses(j, [k])[0].kept == pytest.approx(value, abs=1e-9)


def test_a_direction_that_only_one_joint_makes_is_lost(rng):
    j = rng.normal(size=(3, 5))
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    j -= np.outer(axis, axis @ j)  # no joint moves along the axis ...
    j[:, 2] += axis  # ... but one
    (loss,) = find_speed_losses(j, [2])
    assert loss.lost
    assert abs(loss.direction @ axis) == pytest.approx(1)
    np.testing.assert_allclose(loss.direction @ np.delete(j, 2, axis=1), 0, atol=1e-12)


def test_nothing_fails_nothing_is_lost(rng):
    assert find_speed_losses(rng.normal(size=(3, 5)), []) == []
    assert remaining_manipulability([]) == 1
    assert find_speed_losses(np.zeros((3, 5)), [1]) == []


@pytest.mark.parametrize(("failed", "count"), [((), 3), ((1,), 2), ((0, 3), 1), ((0, 1, 2), 0), (tuple(range(7)), 0)])
def test_null_directions_leave_the_hand_and_the_failed_joints_still(rng, failed, count):
    j = rng.normal(size=(4, 7))
    found = null_space_joint_rates(j, failed)
    assert found.shape == (count, 7)
    np.testing.assert_allclose(found @ j.T, 0, atol=1e-12)
    np.testing.assert_allclose(found @ found.T, np.eye(count), atol=1e-12)
    assert not found[:, list(failed)].any()
