"""The error of an orientation up to half a turn, against rotations made from their axis and angle."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from holdfast.kernels import Kernel
from holdfast.kinematics.solvers.inverse_kinematics import pointing_error, pose_error

NEAR = [0.0, 1e-13, 1e-11, 3e-10, 1e-9, 1e-8, 1e-6, 1e-5, 1e-3, 0.1, 1.0, 2.5, np.pi - 1e-7, np.pi - 1e-10]


@pytest.fixture(scope="module")
def errors():
    """``errors[pointing](rotations, targets)``: the angular part, (N, 3)."""
    symbols = [ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("t", 3), ca.SX.sym("rt", 3, 3)]

    def of(expression):
        kernel = Kernel("orientation error", symbols, [expression(*symbols)], backend="casadi")
        return lambda rotation, target: kernel(np.zeros(3), rotation, np.zeros(3), target)[:, 3:]

    return {False: of(pose_error), True: of(pointing_error)}


def frames(rng, count):
    """Orthonormal to rounding."""
    q = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    return q * np.sign(np.linalg.det(q))[:, None, None]


def turned(rotation, axis, less):
    """Targets half a turn, less so much, about an axis away."""
    x, y, z = axis.T
    zero = np.zeros_like(x)
    k = np.stack([np.stack([zero, -z, y], 1), np.stack([z, zero, -x], 1), np.stack([-y, x, zero], 1)], 1)
    return (np.eye(3) + np.sin(less) * k + (1 + np.cos(less)) * (k @ k)) @ rotation


@pytest.mark.parametrize("pointing", [False, True])
@pytest.mark.parametrize("less", NEAR)
def test_it_is_the_shortest_turn_whichever_way_it_points(errors, rng, pointing, less):
    rotation = frames(rng, 200)
    # Pointing: an axis across z, so that nothing turns about the tool axis. Else any.
    angle = rng.uniform(0, 2 * np.pi, 200)[:, None]
    axis = np.cos(angle) * rotation[:, :, 0] + np.sin(angle) * rotation[:, :, 1]
    if not pointing:
        axis = frames(rng, 200)[:, :, 0]
    found = errors[pointing](rotation, turned(rotation, axis, less))
    expected = (np.pi - less) * axis
    if less == 0:
        assert np.linalg.norm(found, axis=1) == pytest.approx(np.pi, abs=1e-14)
        if not pointing:
            assert np.abs(np.cross(found, axis)).max() < 1e-13
    else:
        # Across the axis what is known of z is rounding, over the sine.
        np.testing.assert_allclose(found, expected, atol=1e-8 + (1e-14 / less if pointing else 0))


def test_at_exactly_half_a_turn_the_largest_component_of_the_axis_is_positive(errors):
    half = [np.diag(d) for d in ([1.0, -1, -1], [-1.0, 1, -1], [-1.0, -1, 1])]
    found = errors[False](np.broadcast_to(np.eye(3), (3, 3, 3)), np.array(half))
    np.testing.assert_allclose(found, np.pi * np.eye(3), atol=1e-15)
    np.testing.assert_allclose(errors[True](np.eye(3)[None], half[0][None]), [[np.pi, 0, 0]], atol=1e-15)
