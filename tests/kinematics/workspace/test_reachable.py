"""Whether a target is within reach with a joint locked."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import InputError, Status, arms, reachable_when_locked


@pytest.fixture(scope="module")
def panda() -> hf.Arm:
    return arms.load("panda")


def test_one_angle_many_angles_and_many_targets(panda, rng):
    home = np.array(arms.about("panda").home)
    pose = panda.forward_kinematics(home)
    one = reachable_when_locked(panda, pose, {"panda_joint4": home[3]})
    assert one.success
    assert one.q[3] == home[3]
    np.testing.assert_allclose(oracles.forward(panda, one.q[None])[0], pose, atol=2e-6)
    far = reachable_when_locked(panda, pose, {3: np.array([home[3], -0.1])})
    np.testing.assert_array_equal(far.status, [Status.OK, Status.NOT_FOUND])
    q = oracles.inside(panda, rng, 5)
    for many in (
        reachable_when_locked(panda, panda.forward_kinematics(q), {2: q[:, 2]}),
        reachable_when_locked(panda, panda.forward_kinematics(q)[:, :3, 3], {2: 0.3}, task="position"),
    ):
        assert many.q.shape == (5, 7)
    assert reachable_when_locked(panda, panda.forward_kinematics(q), {2: q[:, 2]}).success.all()


def test_nan_rows_are_marked(panda):
    found = reachable_when_locked(panda, [0.3, 0.2, 0.5], {2: [0.1, np.nan]}, task="position")
    np.testing.assert_array_equal(found.status, [Status.OK, Status.BAD_INPUT])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"locked": {"elbow": 0.1}}, "has no joint 'elbow'"),
        ({"locked": {2: 0.1, 3: -1.0}}, "locked names 2 joints; give {joint: value} of one"),
        ({"locked": {3: None}}, "the lock of 'panda_joint4' is not numbers; it must be a value, rad"),
        ({"locked": "panda_joint4"}, "locked is 'panda_joint4'; it must be a mapping"),
        ({"locked": {3: 0.5}}, "joint 'panda_joint4' cannot be locked at 0.5 rad; its limits are"),
        ({"locked": {3: [[-1.0]]}}, r"the lock of 'panda_joint4' has shape \(1, 1\)"),
        ({"target": np.zeros((3, 3)), "locked": {3: [-1.0, -2.0]}}, "there are 3 targets and 2 values"),
        ({"restarts": 0}, "restarts is 0"),
        ({"tolerance": 0.0}, "tolerance is 0"),
    ],
)
def test_errors(panda, options, message):
    call = {"target": [0.3, 0.2, 0.5], "locked": {3: -1.0}, "task": "position", **options}
    with pytest.raises(InputError, match=message):
        reachable_when_locked(panda, **call)
