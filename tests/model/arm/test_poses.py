"""Rotations against scipy's."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from holdfast.model.arm import poses


def drawn(rng):
    """Rotations by small, ordinary and nearly or exactly half turns."""
    axes = rng.normal(size=(600, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.concatenate(
        [rng.uniform(0, np.pi, 400), 10.0 ** rng.uniform(-16, -1, 100), np.pi - 10.0 ** rng.uniform(-9, -1, 100)]
    )
    return np.concatenate([axes * angles[:, None], np.zeros((1, 3)), np.pi * np.eye(3)])


def test_rotation_vectors_there_and_back(rng):
    vectors = drawn(rng)
    expected = Rotation.from_rotvec(vectors).as_matrix()
    found = poses.rotations_of_vectors(vectors)
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-15)
    np.testing.assert_allclose(found @ found.transpose(0, 2, 1), np.tile(np.eye(3), (len(found), 1, 1)), rtol=0, atol=2e-15)
    back = poses.rotation_vectors(expected)
    np.testing.assert_allclose(back, Rotation.from_matrix(expected).as_rotvec(), rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(poses.rotations_of_vectors(back), expected, rtol=0, atol=4e-15)


def test_half_turns_go_the_way_they_always_went():
    exact = np.array(
        [np.diag([1.0, -1, -1]), np.diag([-1.0, 1, -1]), np.diag([-1.0, -1, 1]), [[0, 1, 0], [1, 0, 0], [0, 0, -1]]]
    )
    np.testing.assert_allclose(poses.rotation_vectors(exact), Rotation.from_matrix(exact).as_rotvec(), rtol=0, atol=1e-15)


def test_quaternions_of_any_length(rng):
    q = rng.normal(size=(300, 4)) * 10.0 ** rng.uniform(-3, 3, (300, 1))
    np.testing.assert_allclose(poses.rotations_of_quaternions(q), Rotation.from_quat(q).as_matrix(), rtol=0, atol=2e-15)


@pytest.mark.parametrize("shape", [(), (0,), (4, 2)])
def test_shapes(shape, rng):
    vectors = rng.normal(size=(*shape, 3))
    matrices = poses.rotations_of_vectors(vectors)
    assert matrices.shape == (*shape, 3, 3)
    assert poses.rotation_vectors(matrices).shape == (*shape, 3)


def test_nan_stays_nan():
    assert np.isnan(poses.rotations_of_vectors([np.nan, 0, 0])).all()


def test_angles_about_z_y_and_x(rng):
    angles = rng.uniform([-np.pi, -np.pi / 2, -np.pi], [np.pi, np.pi / 2, np.pi], (300, 3))
    np.testing.assert_allclose(poses.zyx_angles(Rotation.from_euler("ZYX", angles).as_matrix()), angles, rtol=0, atol=1e-12)
    upright = Rotation.from_euler("ZYX", [[0.3, np.pi / 2, 0.5], [0.3, -np.pi / 2, 0.5]]).as_matrix()
    found = poses.zyx_angles(upright)
    np.testing.assert_allclose(Rotation.from_euler("ZYX", found).as_matrix(), upright, rtol=0, atol=1e-12)
    assert (found[:, 2] == 0).all()
