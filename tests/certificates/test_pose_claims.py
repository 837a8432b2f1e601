"""Certificates of poses, against sampled errors, scipy's rotations and Pinocchio's inverse kinematics."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from fuzzed import Claimed
from rivals import NINE
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.certificates import reach_claim, tolerant_claim
from holdfast.certificates.taylor import ReachSolver, TaylorForm
from holdfast.core.errors import InputError

START = np.radians([20, -10, 15, -110, -10, 105, 60])


def axial(off):
    return np.stack([off[:, 2, 1] - off[:, 1, 2], off[:, 0, 2] - off[:, 2, 0], off[:, 1, 0] - off[:, 0, 1]], axis=1) / 2


@pytest.mark.parametrize(("turning", "locked"), [(False, 2), (True, -1), (True, 2)])
def test_the_error_is_never_larger_than_its_bound(locked, turning, rng):
    """As for positions; a section that follows roll, pitch and yaw turns the tool as scipy does, to first order."""
    arm, count = oracles.random_arm(rng, types="R" * 7, limits=2.5), 30
    q = rng.uniform(-1.5, 1.5, (count, 7))
    if not turning:  # one rotation for all, and a configuration where bounds say something
        jacobians = np.delete(arm.jacobian(q), locked, axis=2)
        q = np.tile(q[np.linalg.cond(jacobians).argmin()], (count, 1))
    tool = arm.forward_kinematics(q)
    nearly = Rotation.from_rotvec(rng.uniform(-0.01, 0.01, 3)).as_matrix()
    wanted = (tool[:, :3, :3] @ nearly) if turning else np.tile(tool[0, :3, :3] @ nearly, (count, 1, 1))
    reach = ReachSolver(arm, "pose", locked, np.tile([-9.0, 9.0], (7, 1)), None if turning else wanted[0])
    targets = tool[:, :3, 3] + rng.uniform(-1e-3, 1e-3, (count, 3))
    if turning:
        targets = np.concatenate([targets, Rotation.from_matrix(wanted).as_euler("xyz")], axis=1)
    form, axes = TaylorForm.expand_at(reach, q, targets), targets.shape[1]
    cells, sections = rng.uniform(0, 0.03, (count, axes + (locked >= 0))), rng.uniform(0, 0.03, (count, 6))
    above, below, far = form.bound_error_and_travel(cells, sections)
    jacobians, inverse = arm.jacobian(q), np.zeros((count, 7, 6))
    off = tool[:, :3, :3] @ wanted.transpose(0, 2, 1)
    np.testing.assert_allclose(form.error, np.concatenate([tool[:, :3, 3] - targets[:, :3], axial(off)], axis=1), atol=1e-12)

    def error(q, targets):
        at = arm.forward_kinematics(q)
        turned = Rotation.from_euler("xyz", targets[:, 3:]).as_matrix() if turning else wanted
        return np.concatenate([at[:, :3, 3] - targets[:, :3], axial(at[:, :3, :3] @ turned.transpose(0, 2, 1))], axis=1)

    by_joint, by_angle = (
        np.stack([(error(q + a, targets + b) - error(q - a, targets - b)) / 2e-6 for a, b in steps], axis=2)
        for steps in (
            [(1e-6 * np.eye(7)[k], 0) for k in range(7)],
            [(0, 1e-6 * np.eye(axes)[k]) for k in range(3, axes)] or [(0, 0)],
        )
    )
    inverse[:, reach.free] = np.linalg.pinv(by_joint[:, :, reach.free])
    assert np.abs(by_joint[:, :3] - jacobians[:, :3]).max() < 1e-6
    closest = 0.0
    for _ in range(40):
        delta, s = rng.choice([-1.0, 1.0, 0.3], cells.shape) * cells, rng.choice([-1.0, 1.0, 0.3], (count, 6)) * sections
        moved = s.copy()
        moved[:, :3] += delta[:, :3]
        if turning:
            moved -= (by_angle @ delta[:, 3:6, None])[..., 0]
        if locked >= 0:
            moved -= by_joint[:, :, locked] * delta[:, -1:]
        follow = (inverse @ moved[:, :, None])[..., 0]
        if locked >= 0:
            follow[:, locked] = delta[:, -1]
        assert (np.abs(follow) <= far + 1e-8).all()
        gap = error(q + follow, targets + delta[:, :axes]) - s
        assert (gap <= above + 1e-8).all()
        assert (-gap <= below + 1e-8).all()
        closest = max(closest, float(np.maximum(gap / above, -gap / below).max()))
    assert closest > 0.03  # ten coordinates seldom conspire


def reached(arm, model, tool, data, place, wanted, locked, angle, rng):
    """Whether scipy's bounded least squares with Pinocchio's kinematics finds a configuration with this pose of the tool."""
    free = [k for k in range(arm.n) if k != locked]
    goal = pin.SE3(wanted, place)

    def off(x):
        q = np.full(arm.n, angle)
        q[free] = x
        pin.framesForwardKinematics(model, data, q)
        return pin.log6(goal.actInv(data.oMf[tool])).vector

    for _ in range(60):
        bounds = arm.lower[free], arm.upper[free]
        found = least_squares(off, rng.uniform(*bounds), bounds=bounds, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if np.abs(found.fun).max() < 1e-9:
            return True
    return False


@pytest.mark.parametrize(("turning", "locked"), [(False, 0), (True, -1)])
def test_every_pose_has_a_configuration(panda, turning, locked, rng, tmp_path):
    """Random targets of a proved box, corners among them, by inverse kinematics that share nothing."""
    tip = panda.forward_kinematics(START)
    angles = Rotation.from_matrix(tip[:3, :3]).as_euler("ZYX")[::-1]  # yaw about z is the first of these
    rpy = np.column_stack([angles - 0.02, angles + 0.02])
    lock = {locked: (START[locked] - 0.03, START[locked] + 0.03)} if locked >= 0 else None
    claim = reach_claim(panda, tip[:3, 3], 0.03, locked=lock, **({"rpy": rpy} if turning else {"rotation": tip[:3, :3]}))
    proof = hf.certify(claim)
    assert proof.ok
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert check.ok
    assert check.undecided == 0
    assert Claimed(tmp_path / "a.certificate").unreached(rng, 300)[0] == 0
    assert ("Rz(yaw) Ry(pitch) Rx(roll)" in check.claim) == turning
    model, tool = oracles.to_pinocchio(panda)
    data = model.createData()
    at = claim.box[:, 0] + rng.uniform(-0.2, 1.2, len(claim.box)).clip(0, 1) * np.diff(claim.box)[:, 0]
    roll, pitch, yaw = at[3:] if turning else (0, 0, 0)
    wanted = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix() if turning else tip[:3, :3]
    angle = rng.uniform(*claim.angle) if locked >= 0 else 0.0
    assert reached(panda, model, tool, data, at[:3], wanted, locked, angle, rng)


def test_a_tool_turned_half_way_round_is_not_where_it_should_be(panda):
    """The axial part of what is left to turn is 0 there as well; joint 7 cannot turn so far."""
    tip = panda.forward_kinematics(START)
    limits = {k: (x - 0.3, x + 0.3) for k, x in enumerate(START)}
    assert hf.certify(reach_claim(panda, tip[:3, 3], 0.01, rotation=tip[:3, :3], limits=limits), halvings=2).proved == 1
    turned = tip[:3, :3] @ Rotation.from_euler("z", np.pi).as_matrix()
    with pytest.raises(InputError, match="no configuration was found"):
        hf.certify(reach_claim(panda, tip[:3, 3], 0.01, rotation=turned, limits=limits), halvings=2)


def test_a_box_whose_middle_is_singular_is_halved(panda):
    """Newton does not get there, but parts of the box are reached."""
    q = np.radians([0, -45, 0, -135, 0, 90, 45])
    tip = panda.forward_kinematics(q)
    claim = reach_claim(panda, tip[:3, 3], 0.06, rotation=tip[:3, :3], locked={5: (q[5] - 0.05, q[5] + 0.05)})
    assert hf.certify(claim, halvings=1).nodes > 5


def test_what_was_given_up_is_looked_at_once_more(panda, monkeypatch):
    """A search follows a bad branch of the arm into the smallest cells; configurations drawn for these find a good one."""
    q = np.radians([-35, -45, 51, -111, -46, 84, -3])
    tool = panda.forward_kinematics(q)
    claim = reach_claim(panda, tool[:3, 3], 0.06, rotation=tool[:3, :3], locked={6: (q[6] - 0.05, q[6] + 0.05)})
    assert hf.certify(claim, seed=6).undecided == 0
    monkeypatch.setattr("holdfast.certificates.target_boxes.search._MAX_RETRY_FRACTION", 0)
    once = hf.certify(claim, seed=6)
    assert 0 < once.undecided < 1e-6


@pytest.mark.parametrize(("lock", "most"), [(None, 60), (9, 800)])
def test_cubes_of_poses_of_a_nine_joint_arm_take_few_boxes(lock, most):
    """Most of its configurations prove little: where the pool begins decides between hundreds of boxes and thousands."""
    arm = hf.arms.load("pa10-9dof")
    ranges = dict(zip(arm.joint_names, np.radians(NINE).tolist(), strict=True))
    within = {"limits": ranges} if lock is None else {"locked": {lock - 1: ranges[arm.joint_names[lock - 1]]}}
    turn = Rotation.from_euler("y", 174, degrees=True).as_matrix()
    proof = hf.certify(reach_claim(arm, [0.968, 0, 0.025], 0.05, rotation=turn, **within))
    assert float(proof.proved) == 1
    assert proof.leaves <= most


def test_a_pose_is_tolerant_of_a_lock(panda, tmp_path):
    tip = panda.forward_kinematics(START)
    ranges = {k: (x - 0.02, x + 0.02) for k, x in enumerate(START)}
    claim = tolerant_claim(panda, tip[:3, 3], 0.005, rotation=tip[:3, :3], working_ranges=ranges, failures=[0, 6])
    proof = hf.certify(claim)
    assert proof.ok
    assert hf.check_certificate(proof.write(tmp_path)).tolerant == 1


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"rotation": np.eye(2)}, "orthonormal"),
        ({"rotation": -np.eye(3)}, "right-handed"),
        ({"rotation": np.full((3, 3), np.nan)}, "orthonormal"),
        ({"rotation": np.eye(3), "rpy": np.zeros((3, 2))}, "one of them"),
        ({"rpy": [[0, 1], [0, 1], [1, 0]]}, "the lower first"),
        ({"rpy": [0, 1, 2]}, "roll, pitch and yaw"),
        ({"rotation": np.eye(3), "centre": (0.5, 0)}, "three numbers"),
    ],
)
def test_what_makes_no_claim(panda, change, sentence):
    with pytest.raises(InputError, match=sentence):
        reach_claim(panda, **({"centre": (0.5, 0, 0.5), "size": 0.1} | change))


def test_a_pose_needs_six_joints():
    arm = hf.arms.load("ur5")
    with pytest.raises(InputError, match="5 joints are free for 6 task rows"):
        reach_claim(arm, (0.4, 0.1, 0.3), 0.01, rotation=np.eye(3), locked={0: (0, 0.1)})


def test_pointing_and_a_planar_pose(panda, three, tmp_path, rng):
    """Random targets and locked angles of proved boxes: scipy finds a configuration with the tool there, turned so."""
    tip = panda.forward_kinematics(START)
    claims = [
        reach_claim(panda, tip[:3, 3], 0.01, rotation=tip[:3, :3], task="pointing", locked={6: (1.0, 1.1)}),
        reach_claim(three, (1.5, 0.5), 0.05, rpy=(0.8, 0.85)),
        reach_claim(panda, tip[:3, 3], 0.02, locked={1: (START[1] - 0.02, START[1] + 0.02)}, limits={4: (START[4],) * 2}),
    ]
    for claim in claims:
        proof = hf.certify(claim)
        assert proof.ok
        assert hf.check_certificate(proof.write(tmp_path / "a.certificate")).ok
        target, free = (
            rng.uniform(*claim.box.T),
            (claim.limits[:, 0] < claim.limits[:, 1]) & (np.arange(claim.arm.n) != claim.locked),
        )
        q = np.clip(np.where(free, START[: claim.arm.n], claim.limits[:, 0]), *claim.limits.T)
        if claim.locked >= 0:
            q[claim.locked] = rng.uniform(*claim.angle)

        def off(x, claim=claim, target=target, free=free, q=q):
            full = q.copy()
            full[free] = x
            at = claim.arm.forward_kinematics(full)
            place = at[:3, 3][: 2 if claim.task == "planar-pose" else 3] - target[:3][: 2 if claim.task == "planar-pose" else 3]
            yaw = target[-1]
            turned = {"pointing": at[:3, 2] - tip[:3, 2], "planar-pose": at[:2, 0] - [np.cos(yaw), np.sin(yaw)]}
            return np.append(place, turned.get(claim.task, np.zeros(6 - len(place))))

        starts = [q[free], *rng.uniform(-1.5, 1.5, (20, int(free.sum())))]
        found = min(np.abs(least_squares(off, x, xtol=1e-15, ftol=1e-15, gtol=1e-15).fun).max() for x in starts)
        assert found < 1e-8
