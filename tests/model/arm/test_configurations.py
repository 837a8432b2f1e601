"""Where configurations are drawn from."""

from __future__ import annotations

import numpy as np

import holdfast as hf
from holdfast.model.arm.configurations import sampling_limits


def test_finite_limits_stay_within_those_of_the_joint():
    inf = np.inf
    limits = [(-1, 2), (-inf, inf), (0, inf), (5, inf), (-inf, -5), (-inf, 0)]
    joints = [
        hf.Joint(f"{kind}{k}", kind, np.eye(4), axis=np.array([0, 0, 1.0]), lower=low, upper=high)
        for kind in ("revolute", "prismatic")
        for k, (low, high) in enumerate(limits)
    ]
    arm = hf.Arm(name="limits", joints=tuple(joints))
    low, high = sampling_limits(arm)
    free = np.repeat([np.pi, 1.0], 6)
    np.testing.assert_allclose(low, [-1, -np.pi, 0, 5, -5 - np.pi, -np.pi, -1, -1, 0, 5, -6, -1])
    np.testing.assert_allclose(high, [2, np.pi, np.pi, 5 + np.pi, -5, 0, 2, 1, 1, 6, -5, 0])
    assert (low >= arm.lower).all()
    assert (high <= arm.upper).all()
    assert (high - low <= np.maximum(2 * free, 3)).all()
