"""Single points of failure by structure, against the rank of reduced Jacobians computed without the library."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import oracles
from holdfast import arms
from holdfast.studies.assessment import Structure, explain, structure, structures

SPATIAL = ["pose", "pointing", "position"]
PLANAR = ["planar-pose", "planar"]


def fatal_by_rank(arm, task) -> tuple[tuple[int, ...], bool]:
    """Joints without which the Jacobian has no full row rank at any of 60 configurations, and whether the whole has none."""
    q = np.random.default_rng(99).uniform(-3, 3, (60, arm.n))
    j = oracles.task_jacobian(arm, q, task)

    def deficient(matrix):
        if matrix.shape[2] < matrix.shape[1]:
            return True
        s = np.linalg.svd(matrix, compute_uv=False)
        return bool((s[:, -1] < 1e-9 * s[:, 0]).all())

    return tuple(k for k in range(arm.n) if deficient(np.delete(j, k, axis=2))), deficient(j)


@pytest.mark.parametrize("name", arms.names())
def test_every_built_in_arm_against_ranks(name):
    arm = arms.load(name)
    found = structures(arm)
    assert [s.task for s in found] == (PLANAR if name.startswith("planar") else SPATIAL)
    for s in found:
        fatal, never = fatal_by_rank(arm, s.task)
        rows = {"pose": 6, "pointing": 5, "position": 3, "planar": 2, "planar-pose": 3}[s.task]
        assert s.redundancy == arm.n - rows
        assert s.fatal == fatal, (s, fatal)
        if s.redundancy > 0:
            assert s.never == never
        assert s.survives == (not fatal and not never)


@pytest.mark.parametrize(
    ("name", "task", "fatal"),
    [
        ("pa10-7dof", "pose", (3,)),
        ("pa10-7dof", "pointing", (3,)),
        ("pa10-7dof", "position", ()),
        ("iiwa14", "pose", (3,)),
        ("iiwa14", "pointing", (3,)),
        ("pa10-9dof", "pose", ()),
        ("planar-3r", "planar", ()),
        ("planar-3r", "planar-pose", (0, 1, 2)),
        ("planar-2r", "planar", (0, 1)),
        ("ur5", "pose", (0, 1, 2, 3, 4, 5)),
    ],
)
def test_known_arms(name, task, fatal):
    """Specification, section 7: without the elbow the PA10-7C is singular everywhere; two more joints help."""
    assert structure(arms.load(name), task).fatal == fatal


@pytest.mark.parametrize(
    ("turned", "shifted"),
    [(1.5708 - np.pi / 2, 0.0), (0.0, 4.4e-4)],
    ids=["1.5708 for a quarter turn", "axes that miss by 0.44 mm, as in a common file of the iiwa"],
)
def test_axes_that_would_meet_but_for_the_digits_of_a_file(turned, shifted):
    """What a lock of the elbow leaves is next to nothing, and is said, with what singular values tell of the reduced arm."""
    arm = arms.load("iiwa14")
    joints = list(arm.joints)
    off = np.eye(4)
    off[:3, :3] = Rotation.from_euler("x", turned).as_matrix()
    off[0, 3] = shifted
    joints[2] = replace(joints[2], origin=joints[2].origin @ off)
    near = arm.__class__("near", tuple(joints), tool=arm.tool)
    found = structure(near, "pose")
    assert found.fatal == ()
    ((elbow, left),) = found.nearly
    assert elbow == 3
    assert not found.survives
    q = np.random.default_rng(20120514).uniform(-np.pi, np.pi, (256, 7))  # the configurations of the library
    j = oracles.task_jacobian(near, q, "pose")
    sizes = [np.linalg.svd(x, compute_uv=False).prod(axis=1) for x in (np.delete(j, 3, axis=2), j)]
    assert left == pytest.approx((sizes[0] / sizes[1]).max(), rel=1e-5)
    text = explain(near, found, structures(near))
    assert "Nearly a single point of failure by structure: once lbr_iiwa_joint_4 (joint 4) locks" in text
    assert text.endswith("Possible after every single lock: position.")
    if turned:  # sets of joints, too
        assert (3, 4, 5) in structure(near, "position").together


def test_a_random_arm_has_none_until_it_loses_its_redundancy(rng):
    seven = oracles.random_arm(rng, types="RRRPRRR")
    assert structure(seven, "pose") == Structure(task="pose", redundancy=1, fatal=(), never=False)
    six = seven.__class__("six", seven.joints[:6])
    assert structure(six, "pose") == Structure(task="pose", redundancy=0, fatal=tuple(range(6)), never=False)
    assert structure(six, ["vx", "vy", "wz"]).survives


def test_an_arm_that_can_never_do_the_task(planar4):
    """Four joints in a plane for three positions in space."""
    s = structure(planar4, "position")
    assert s.never
    assert not s.survives
    assert "never" in explain(planar4, s, structures(planar4))
    assert "planar" in explain(planar4, s, structures(planar4))


def test_sentences_for_people():
    arm = arms.load("pa10-7dof")
    pose, pointing, position = structures(arm)
    text = explain(arm, pose, [pose, pointing, position])
    assert "joint4 (joint 4)" in text
    assert text.endswith("position.")
    assert "pointing" not in text
    assert "No single joint" in explain(arm, position, [])
    ur5 = arms.load("ur5")
    assert "not redundant" in explain(ur5, structure(ur5, "pose"), structures(ur5))


@pytest.mark.parametrize(
    ("name", "task", "sets"),
    [
        ("ur5", "position", ["shoulder_pan_joint+wrist_2_joint"]),
        ("panda", "position", ["panda_joint4+panda_joint5+panda_joint6"]),
        ("pa10-9dof", "pose", ["joint1+joint2+joint6", "joint4+joint5+joint6", "joint4+joint8+joint9"]),
    ],
)
def test_sets_of_joints_that_end_a_task_together(name, task, sets):
    """Those that the specification's table of market arms has at zero, and by the rank of the reduced Jacobian."""
    arm = arms.load(name)
    found = structure(arm, task)
    assert set(sets) <= {"+".join(arm.joint_names[k] for k in some) for some in found.together}
    assert "Sets of joints whose locks make it singular" in explain(arm, found, [])
    j = oracles.task_jacobian(arm, np.random.default_rng(98).uniform(-3, 3, (40, arm.n)), task)
    for some in found.together:
        left = np.linalg.svd(np.delete(j, some, axis=2), compute_uv=False)
        assert left[:, -1].max() < 1e-9 * left[:, 0].max()
    assert structure(arms.load("pa10-9dof"), "position").together == ()
