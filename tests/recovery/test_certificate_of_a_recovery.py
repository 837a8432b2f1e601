"""A goal that is proved to have no configuration, as a file that the verifier checks."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.errors import InputError

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
    with pytest.raises(InputError, match="only proofs of the kinds"):
        found.certificate()
