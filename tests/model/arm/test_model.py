"""Joints, links and arms: what they refuse, and composite bodies against Pinocchio."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast import arms
from holdfast.core.errors import ArmError, InputError
from holdfast.model.arm.dh import DH
from holdfast.model.arm.formats import urdf
from holdfast.model.arm.machine import ArmData, Joint, Link
from holdfast.model.arm.model import Arm
from holdfast.model.arms.builtin import DATA_FOLDER


def random_pose(rng: np.random.Generator) -> np.ndarray:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = Rotation.random(rng=rng).as_matrix(), rng.normal(size=3)
    return out


def random_link(rng: np.random.Generator, name: str | None = None) -> Link:
    points = rng.normal(size=(3, 5))
    spread = points @ points.T
    return Link(rng.uniform(0.1, 3), rng.normal(size=3), np.trace(spread) * np.eye(3) - spread, name=name)


def as_pin(link: Link) -> pin.Inertia:
    return pin.Inertia(link.mass, link.com, link.inertia)


def same(link: Link, expected: pin.Inertia) -> None:
    assert link.mass == pytest.approx(expected.mass)
    np.testing.assert_allclose(link.com, expected.lever, atol=1e-12)
    np.testing.assert_allclose(link.inertia, expected.inertia, atol=1e-11)


@pytest.mark.parametrize("seed", range(5))
def test_bodies_move_and_join_as_in_pinocchio(seed: int) -> None:
    rng = np.random.default_rng(seed)
    bodies, pose = [random_link(rng, "x") for _ in range(3)], random_pose(rng)
    moved = bodies[0].in_frame(pose)
    same(moved, pin.SE3(pose).act(as_pin(bodies[0])))
    assert moved.name == "x"
    same(Link.merge(bodies, "sum"), as_pin(bodies[0]) + as_pin(bodies[1]) + as_pin(bodies[2]))


def test_massless_bodies_join() -> None:
    empty = Link.merge([])
    assert (empty.mass, empty.inertia.sum()) == (0, 0)
    rotor = Link(0.0, np.ones(3), np.eye(3))
    assert Link.merge([rotor, rotor], "r").inertia.tolist() == (2 * np.eye(3)).tolist()
    arm = Link(2.0, np.ones(3), np.eye(3))
    both = Link.merge([rotor, arm])
    assert (both.mass, both.com.tolist()) == (2, [1, 1, 1])


AXIS = np.array([0, 0, 1.0])
BAD: list[tuple[Any, str]] = [
    (lambda: Joint("j", "ball", np.eye(4), axis=AXIS), "joint 'j' has type 'ball'; use revolute, continuous or prismatic"),
    (lambda: Joint("j", "revolute", np.eye(3), axis=AXIS), "origin of joint 'j' must be a 4x4 array of finite numbers"),
    (
        lambda: Joint("j", "revolute", 2 * np.eye(4), axis=AXIS),
        "origin of joint 'j': its upper left 3x3 block is not a rotation",
    ),
    (lambda: Joint("j", "revolute", np.diag([1, 1, -1, 1]), axis=AXIS), "is not a rotation"),
    (lambda: Joint("j", "revolute", np.diag([1, 1, 1, 2]), axis=AXIS), "origin of joint 'j': its last row is"),
    (lambda: Joint("j", "revolute", np.full((4, 4), np.nan), axis=AXIS), "must be a 4x4 array of finite numbers"),
    (lambda: Joint("j", "revolute", np.eye(4), axis=np.zeros(3)), "axis of joint 'j' is"),
    (lambda: Joint("j", "revolute", np.eye(4), axis=np.ones(2)), "it must be 3 finite numbers below 1e12, not all 0"),
    (lambda: Joint("j", "revolute", np.eye(4), axis=np.array([np.nan, 0, 1])), "axis of joint 'j' is"),
    (
        lambda: Joint("j", "revolute", np.eye(4), axis=AXIS, lower=1, upper=-1),
        "limits of joint 'j' are reversed: lower 1 is above upper -1; swap them",
    ),
    (lambda: Link(1.0, np.zeros(2), np.eye(3), name="l"), "link 'l': com has shape (2,) and inertia (3, 3); they must be"),
    (lambda: Link(1.0, np.zeros(3), np.eye(2)), "link: com has shape (3,) and inertia (2, 2); they must be (3,) and (3, 3)"),
    (lambda: Link(np.nan, np.zeros(3), np.eye(3), name="l"), "link 'l': mass, com and inertia must be finite numbers"),
    (lambda: Link(-1.0, np.zeros(3), np.eye(3), name="l"), "link 'l': mass is -1 kg; it must be 0 or more"),
    (lambda: Link(1.0, np.zeros(3), np.triu(np.ones((3, 3))), name="l"), "link 'l': the inertia matrix is not symmetric"),
    (lambda: Arm(name="a", joints=()), "arm 'a' has no joints; it needs at least one"),
    (
        lambda: Arm.from_dh([DH(1, 0, name="x"), DH(1, 0, name="x")]),
        "the joint name 'x' is used more than once; names must be unique",
    ),
    (
        lambda: Arm(name="a", joints=(Joint("j", "revolute", np.eye(4), axis=AXIS),), links=(None, None)),
        "arm 'a' has 1 joints and 2 links; it needs one",
    ),
    (lambda: Arm.from_dh([DH(1, 0)], gravity=(0, 0)), "gravity must be 3 finite numbers, m/s^2"),
    (lambda: Arm.from_dh([DH(1, 0)], base=np.zeros((4, 4))), "base of arm 'arm': its upper left 3x3 block is not a rotation"),
    (lambda: Arm.from_dh([DH(1, 0)], tool=2 * np.eye(4)), "tool of arm 'arm': its upper left 3x3 block is not a rotation"),
    (lambda: Arm.from_dh([DH(1, 0)], convention="craig"), "DH convention 'craig' is not known; use 'standard' or 'modified'"),
    (lambda: Arm.from_dh([DH(1, 0)], links=[]), "arm 'arm' has 1 DH rows and 0 links; it needs one link per row"),
    (lambda: Arm.from_dh([DH(1, np.nan)]), "DH row 1 ('joint1'): alpha is nan; it must be a finite number"),
    (lambda: Arm.from_dh([DH(1, 0, type="ball")]), "DH row 1 ('joint1') has type 'ball'; use revolute or prismatic"),
]


@pytest.mark.parametrize(("make", "sentence"), BAD, ids=[case[1][:50] for case in BAD])
def test_refusals(make: Any, sentence: str) -> None:
    with pytest.raises(ArmError) as caught:
        make()
    assert sentence in str(caught.value)


def test_joints_are_found_by_name_and_index() -> None:
    arm = arms.load("panda")
    assert arm.joint_index("panda_joint3") == arm.joint_index(2) == arm.joint_index(np.int64(2)) == 2
    assert arm.joint_indices(["panda_joint5", 0]) == (0, 4)
    with pytest.raises(InputError, match="joint index 7 is out of range; 'panda' has joints 0 to 6"):
        arm.joint_index(7)
    with pytest.raises(InputError, match="joint index -1 is out of range"):
        arm.joint_index(-1)
    with pytest.raises(InputError, match="'panda' has no joint 'elbow'; its joints are panda_joint1, "):
        arm.joint_index("elbow")
    with pytest.raises(InputError, match="'panda' has no joint 'True'"):
        arm.joint_index(True)


def test_configurations_are_checked() -> None:
    arm = arms.load("planar-3r")
    with pytest.raises(InputError, match="q for 'planar-3r' has 2 values per configuration; it must have 3, one per joint"):
        arm.forward_kinematics([0, 0])
    with pytest.raises(InputError, match="has 0 values per configuration"):
        arm.forward_kinematics(1.0)
    with pytest.raises(InputError, match=r"q for 'planar-3r' has the shape \(2, 5, 3\); it must be \(3,\) or \(N, 3\)"):
        arm.forward_kinematics(np.zeros((2, 5, 3)))
    with pytest.raises(InputError, match="q for 'planar-3r' is not numbers; it must be numbers, 3 per configuration"):
        arm.jacobian(["a", "b", "c"])
    assert arm.forward_kinematics(np.zeros((5, 3))).shape == (5, 4, 4)


def test_one_joint_has_the_shapes_of_many() -> None:
    arm = Arm.from_dh([DH(1, 0)])
    assert arm.forward_kinematics([0.5]).shape == (4, 4)
    assert arm.jacobian([0.5]).shape == (6, 1)
    assert arm.forward_kinematics([[0.5], [0.6]]).shape == (2, 4, 4)


def test_an_arm_does_not_change_and_its_copies_do() -> None:
    arm, rng = arms.load("planar-3r"), np.random.default_rng(0)
    with pytest.raises(FrozenInstanceError):
        arm.name = "other"  # type: ignore[misc]
    for array in (arm.base, arm.tool, arm.gravity, arm.lower, arm.joints[0].origin, arm.joints[0].axis, arm.links[0].com):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    base, tool, box, q = random_pose(rng), random_pose(rng), random_link(rng), rng.uniform(-3, 3, 3)
    moved = arm.with_base(base).with_tool(tool).with_payload(box)
    bare = arm.with_tool(np.eye(4)).forward_kinematics(q)
    np.testing.assert_allclose(moved.forward_kinematics(q), base @ bare @ tool, atol=1e-12)
    # The last row's frame is 1 m along the last link, and the box was given in it.
    assert moved.payload is not None
    np.testing.assert_allclose(moved.payload.com, box.com + np.array([1.0, 0.0, 0.0]), atol=1e-12)
    assert len({arm.fingerprint, moved.fingerprint, arm.with_payload(box).fingerprint}) == 3
    assert replace(arm, name="x", source="y").fingerprint == arm.fingerprint
    assert repr(arm) == "Arm('planar-3r', 3 joints)"


def test_from_urdf_is_the_reader() -> None:
    arm = Arm.from_urdf(
        str(DATA_FOLDER.joinpath("panda.urdf")), tip="panda_link8", name="mine", hold={"panda_finger_joint1": 0.01}
    )
    assert (arm.name, arm.n) == ("mine", 7)


def test_an_arm_has_all_that_its_machine_says() -> None:
    file = str(DATA_FOLDER.joinpath("panda.urdf"))
    machine, arm = urdf.load_urdf(file, tip="panda_link8"), Arm.from_urdf(file, tip="panda_link8")
    assert type(machine) is ArmData
    assert type(arm) is Arm
    assert (arm.title, arm.source, arm.fingerprint) == (
        machine.name + f" ({machine.chain})",
        machine.source,
        machine.fingerprint,
    )
    assert repr(machine) == "ArmData('panda', 7 joints)"


def test_an_arm_goes_to_another_process_without_what_was_compiled_from_it() -> None:
    arm = replace(arms.load("ur5-rail"), name="used")
    q = np.array(arms.about("ur5-rail").home)
    arm.forward_kinematics(q), arm.without_limits.frames(q)
    there = pickle.loads(pickle.dumps(arm))
    assert (there.title, there.fingerprint) == (arm.title, arm.fingerprint)
    np.testing.assert_array_equal(there.frames(q), arm.frames(q))


def test_limits_are_changed_and_taken_away() -> None:
    arm = arms.load("ur5-rail")
    lower, upper = arm.lower + 0.1, arm.upper - 0.1
    narrow = arm.with_limits(lower, upper)
    np.testing.assert_array_equal([narrow.lower, narrow.upper], [lower, upper])
    assert replace(narrow, joints=arm.joints).fingerprint == arm.fingerprint
    assert not np.isfinite([arm.without_limits.lower, arm.without_limits.upper]).any()
    assert arm.without_limits is arm.without_limits
    with pytest.raises(InputError, match="has 2 values per configuration; it must have 7"):
        arm.with_limits([0, 0], upper)


def test_the_jacobian_derivative_by_differences() -> None:
    arm, step = arms.load("ur5-rail"), 1e-6
    q = np.array(arms.about("ur5-rail").home) + 0.3
    shifts = step * np.eye(arm.n)
    expected = (arm.jacobian(q + shifts) - arm.jacobian(q - shifts)) / (2 * step)
    np.testing.assert_allclose(arm.jacobian_derivative(q), expected, atol=1e-8)


def test_complex_numbers_are_refused_and_not_cut() -> None:
    arm = hf.arms.load("planar-3r")
    for q in (np.array([0.1, 0.2, 1j]), [0.1, 0.2, 1j]):
        with pytest.raises(hf.InputError, match="q for 'planar-3r' is complex numbers; it must be numbers, 3 per"):
            arm.forward_kinematics(q)


def test_what_is_not_finite_is_bad_input_of_its_row_and_of_no_other() -> None:
    """Infinity as NaN: alone it is refused, in a batch its row has no value, so that one row does not cost the others."""
    arm = hf.arms.load("planar-3r")
    index = hf.indices.relative_manipulability(arm, "planar")
    for bad in (np.nan, np.inf, -np.inf):
        batch = np.array([[0.1, 0.2, 0.3], [0.1, bad, 0.3]])
        found = index.evaluate(batch)
        assert found.status.tolist() == [hf.Status.OK, hf.Status.BAD_INPUT]
        assert np.isfinite(found.value[0])
        assert np.isnan(found.value[1])
        with pytest.raises(hf.InputError, match="holds NaN or infinity"):
            index.evaluate(batch[1])
