"""Verdicts on degraded arms read from URDF files, against Pinocchio on the same files."""

from __future__ import annotations

from importlib.resources import as_file, files

import numpy as np
import pinocchio as pin
import pytest

import holdfast as hf

DATA = files("holdfast.model.arms") / "data"
STARTS, STEPS = 40, 60


@pytest.fixture(scope="module", params=[("iiwa14.urdf", "lbr_iiwa_link_7"), ("xarm7.urdf", "link_eef")], ids=["iiwa", "xarm"])
def both(request):
    """An arm, Pinocchio's model of it, and the frame of its tool there."""
    name, tip = request.param
    with as_file(DATA / name) as file:
        arm, model = hf.Arm.from_urdf(file, tip=tip), pin.buildModelFromUrdf(str(file))
    return arm, model, model.getFrameId(tip)


def drawn(arm, rng, kinds):
    """A failure of as many joints, of the kinds given."""
    low, high = arm.lower, arm.upper
    found = {"locked": {}, "ranges": {}, "speeds": {}}
    for k, kind in zip(rng.choice(arm.n, len(kinds), replace=False), kinds, strict=True):
        ends = np.sort(rng.uniform(low[k], high[k], 2))
        found[kind][arm.joint_names[k]] = {"locked": ends[0], "ranges": tuple(ends), "speeds": 0.3}[kind]
    return hf.Degraded(arm, **found)


def pinocchio_finds(model, frame, goal, low, high, rng):
    """Whether damped Newton steps within limits get to a pose from any of some random starts."""
    data, wanted = model.createData(), pin.SE3(goal[:3, :3], goal[:3, 3])
    free = high > low
    for q in rng.uniform(low, high, (STARTS, len(low))):
        for _ in range(STEPS):
            jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL) * free
            error = pin.log6(pin.updateFramePlacement(model, data, frame).actInv(wanted)).vector
            if np.abs(error).max() < 1e-8:
                return True
            q = np.clip(q + np.linalg.solve(jacobian.T @ jacobian + 1e-6 * np.eye(len(q)), jacobian.T @ error), low, high)
    return False


def test_verdicts_agree_with_pinocchio_on_the_file(both, rng):
    arm, model, frame = both
    data, seen = model.createData(), {"solved": 0, "proved infeasible": 0}
    kinds = (["locked"], ["locked", "locked"], ["ranges", "speeds"], ["locked", "ranges", "locked"])
    for case in range(8):
        bad = drawn(arm, rng, kinds[case // 2])
        at = rng.uniform(bad.lo, bad.hi)
        reached = bool(case % 2) or len(bad.locked) < 2  # where the failed arm can be; otherwise where the healthy arm can
        goal = arm.forward_kinematics(rng.uniform(bad.lo, bad.hi) if reached else rng.uniform(arm.lower, arm.upper))
        found = hf.recover(arm, bad, at, goal=goal, clearance=False, samples=0, tries=1)
        answer = found.verdict.answer
        seen[answer] = seen.get(answer, 0) + 1
        if answer == "solved":
            assert found.ok
            q = found.q
            assert ((q >= bad.lo - 1e-12) & (q <= bad.hi + 1e-12)).all()
            pin.framesForwardKinematics(model, data, q[-1])
            end = data.oMf[frame]
            np.testing.assert_allclose(end.translation, goal[:3, 3], atol=1e-5)
            np.testing.assert_allclose(end.rotation, goal[:3, :3], atol=2e-5)
        elif answer == "proved infeasible":
            assert not reached
            assert not pinocchio_finds(model, frame, goal, bad.lo, bad.hi, rng)
    assert seen["solved"] >= 5
    assert seen["proved infeasible"] >= 1
