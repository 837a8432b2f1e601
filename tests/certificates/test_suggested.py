"""The claim that an assessment suggests."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.studies.assessment.suggested import make_region_claim


def test_every_pose_of_the_region_is_a_target(panda):
    region = hf.Region.box([0.5, 0.1, 0.5], [0.05, 0.04, 0], [0.2, 0.1, np.pi], [0.02, 0.04, 0.06], order="abdi")
    task = hf.indices.relative_manipulability(panda, "pose").task
    claim = make_region_claim(panda, region, task, 0)
    for pose in region.poses(next(region.blocks(0, 1))[:50]):
        roll, pitch, yaw = (
            np.arctan2(pose[2, 1], pose[2, 2]) % (2 * np.pi),
            np.arcsin(-pose[2, 0]),
            np.arctan2(pose[1, 0], pose[0, 0]),
        )
        target = np.array([*pose[:3, 3], roll, pitch, yaw])
        assert (target >= claim.box[:, 0] - 1e-9).all()
        assert (target <= claim.box[:, 1] + 1e-9).all()
    np.testing.assert_allclose(np.diff(claim.box)[:, 0], [0.05, 0.04, 0, 0.06, 0.04, 0.02], atol=1e-12)
    with pytest.raises(InputError, match="not reached"):
        make_region_claim(panda, region, task, 3)


def test_a_sample_of_positions(panda):
    region = hf.Region.box([0.485, 0, 0.53], 0.05)
    result = hf.assess(panda, region, hf.indices.relative_manipulability(panda, "position"), poses=50, clearance=False)
    assert hf.certify(result.claim()).ok
