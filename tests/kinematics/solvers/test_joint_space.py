"""Neighbours of a few configurations are those of SciPy's tree, bit for bit, round the corner where a joint has no limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from holdfast import arms
from holdfast.kinematics.indices.susceptibility import torque
from holdfast.kinematics.solvers import joint_space, optimise


@pytest.fixture(params=["none", "some", "all"])
def arm(request):
    seven = arms.load("panda")
    turning = {"none": [], "some": [0, 3, 6], "all": range(7)}[request.param]
    return replace(
        seven, joints=tuple(replace(j, lower=-np.inf, upper=np.inf) if k in turning else j for k, j in enumerate(seven.joints))
    )


@pytest.mark.parametrize(("points", "rows"), [(1, 1), (40, 300), (300, 40), (1000, 1000), (1100, 1000)])
def test_neighbours(arm, points, rows, rng):
    a, b = rng.uniform(-8, 8, (points, 7)), rng.uniform(-8, 8, (rows, 7))
    b[: min(points, rows) : 3] = a[: min(points, rows) : 3] + 1e-9
    away, which = joint_space.find_nearest(arm, a, b)
    expected = joint_space.build_tree(arm, a).query(joint_space.wrap_joints_to_positive(arm, b))
    assert away.tobytes() == expected[0].tobytes()
    assert np.array_equal(which, expected[1])
    assert away == pytest.approx(np.linalg.norm(joint_space.joint_difference(arm, b, a[which]), axis=1), abs=1e-12)
    for apart in (1e-6, float(np.median(away))):
        both = np.concatenate([a, b])
        found = {tuple(p) for p in joint_space.find_close_pairs(arm, both, apart).tolist()}
        assert found == joint_space.build_tree(arm, both).query_pairs(apart)


def test_no_turn_more_than_is_needed(rng):
    """A joint of a UR5 turns twice: of the values that are the same the one next to the middle, always within the limits."""
    arm = arms.load("ur5-rail")
    q = rng.uniform(arm.lower, arm.upper, (500, arm.n))
    same = joint_space.wrap_around_limit_center(arm, q)
    np.testing.assert_allclose(arm.forward_kinematics(same), arm.forward_kinematics(q), atol=1e-12)
    assert ((same >= arm.lower) & (same <= arm.upper)).all()
    assert np.abs(same[:, ~arm.prismatic]).max() <= np.pi + 1e-12
    assert np.abs(q[:, ~arm.prismatic]).max() > 1.5 * np.pi
    some = np.array([3.5, -4.0, 2.0, 0.1, 0, 0, 40.0])
    half = replace(arm, joints=tuple(replace(j, upper=np.inf) for j in arm.joints))  # nothing to be next to
    assert joint_space.wrap_around_limit_center(half, some).tobytes() == some.tobytes()


def test_the_best_configuration_has_no_turn_more_than_is_needed():
    arm = arms.load("ur5-rail")
    q = np.array([0, 0, -1, 1.2, -0.5, 0.5, 0])
    found = optimise(arm, arm.forward_kinematics(q), torque(arm), seed=0, starts=4)
    assert np.abs(found.q[1:]).max() <= np.pi
    assert arm.forward_kinematics(found.q) == pytest.approx(arm.forward_kinematics(q), abs=1e-6)
    assert torque(arm)(found.q) == pytest.approx(found.value, rel=1e-12)
