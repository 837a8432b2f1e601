"""A goal that is proved to have no configuration, as a file that the verifier checks."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError

pytest.importorskip("flint", reason="python-flint is not installed")
START = np.radians([20, -10, 15, -110, -10, 105, 60])


@pytest.mark.parametrize(("task", "locked"), [("position", [3]), ("pose", [3]), ("position", [3, 1])])
def test_a_proof_is_a_certificate(tmp_path, task, locked):
    panda = hf.arms.load("panda")
    goal = panda.forward_kinematics(START)
    goal[:3, 3] += [0.5, 0, 0.3]
    found = hf.recover(panda, locked, START, goal=goal, task=task, samples=0, starts=16, clearance=False)
    check = hf.check_certificate(found.certificate().write(tmp_path / "goal.certificate"))
    assert check.ok
    assert check.undecided == 0
    for k in locked:  # several locks are limits that are equal
        assert f"{panda.joint_names[k]} {float(START[k])!r} to {float(START[k])!r}" in check.claim


def test_what_has_none():
    found = hf.recover(hf.arms.load("planar-3r"), [1], [0.1, 0.2, 0.3], samples=0)
    with pytest.raises(InputError, match="the goal names joints beyond their remaining limits"):
        found.certificate()


def test_of_a_tool_path_the_pose_that_has_none(tmp_path):
    arm, start = hf.arms.load("planar-3r"), np.array([0.3, 0.6, 0.4])
    here = arm.forward_kinematics(start)
    path = hf.paths.line(here, here[:3, 3] + [1.5, 0, 0])
    found = hf.recover(arm, [1], start, goal=None, path=path, task="planar", samples=0, starts=4)
    assert found.verdict.kind == "a pose of the path"
    certificate = found.certificate()
    x, y = found.proved_pose[:2, 3]
    assert np.hypot(x, y) > 1 + 2 * np.cos(0.3)  # the arm with its second joint at 0.6 rad is no longer
    check = hf.check_certificate(certificate.write(tmp_path / "path.certificate"))
    assert check.ok
    assert check.undecided == 0
    assert f"x {float(x)!r} to {float(x)!r}" in check.claim
