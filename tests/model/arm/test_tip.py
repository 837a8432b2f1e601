"""Where an arm ends if nobody says: robots with grippers and frames beside the flange, against yourdfpy and Pinocchio."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import yourdfpy
from test_urdf import joint, link

import holdfast as hf
from holdfast.core.errors import ArmError
from holdfast.model.arms.builtin import DATA_FOLDER

SLIDE = "<axis xyz='0 1 0'/><limit lower='0' upper='0.02' velocity='1' effort='10'/>"


def turning(name: str, parent: str, child: str, axis: str, xyz: str) -> str:
    return joint(
        name,
        parent,
        child,
        inside=f"<origin xyz='{xyz}'/><axis xyz='{axis}'/><limit lower='-3' upper='3' velocity='2' effort='80'/>",
    )


def still(name: str, parent: str, child: str, xyz: str) -> str:
    return joint(name, parent, child, "fixed", f"<origin xyz='{xyz}'/>")


def sawyer(tmp_path: Path, *more: str, gripper: tuple[str, ...] = ()) -> Path:
    """Seven joints as Rethink's Sawyer has them (round lengths), a flange, a camera on the forearm, and what is given."""
    axes, steps = ("0 0 1", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"), ("0 0 0.32", *["0.13 0.05 0"] * 6)
    links = ["base", *[f"right_l{k}" for k in range(7)]]
    turned = [
        turning(f"right_j{k}", a, b, x, d) for k, (a, b, x, d) in enumerate(zip(links, links[1:], axes, steps, strict=False))
    ]
    parts = [*[link(x) for x in links], *turned, *more, *gripper]
    path = tmp_path / "sawyer.urdf"
    path.write_text(f"<robot name='sawyer'>{''.join(parts)}</robot>")
    return path


HAND = (link("right_hand"), still("right_hand", "right_l6", "right_hand", "0 0 0.0245"))
GRIPPER = (
    link("right_gripper_base"),
    still("right_gripper_base", "right_hand", "right_gripper_base", "0 0 0.025"),
    link("right_gripper_l_finger"),
    joint("right_gripper_l_finger_joint", "right_gripper_base", "right_gripper_l_finger", "prismatic", SLIDE),
    link("right_gripper_l_finger_tip"),
    still("right_gripper_l_finger_tip", "right_gripper_l_finger", "right_gripper_l_finger_tip", "0 0 0.08"),
)
CAMERA = (link("right_hand_camera"), still("right_hand_camera", "right_l5", "right_hand_camera", "0.04 0 0"))
GRIPPER_TIP = (link("right_gripper_tip"), still("right_gripper_tip", "right_gripper_base", "right_gripper_tip", "0 0 0.1"))


def yourdfpy_pose(path: Path, arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    other = yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=True)
    other.update_cfg(dict(zip(arm.joint_names, q, strict=True)))
    assert arm.chain is not None
    return np.asarray(other.get_transform(arm.chain.tip, arm.chain.base))


def test_a_finger_is_not_the_tip_and_the_candidates_are_asked_for(tmp_path: Path) -> None:
    """One finger moves and nothing else behind the flange: the finger's tip was taken, without a word."""
    path = sawyer(tmp_path, *HAND, *CAMERA, gripper=(*GRIPPER, *GRIPPER_TIP))
    with pytest.raises(ArmError) as caught:
        hf.Arm.from_urdf(path)
    assert "the arm could end at 'right_gripper_tip', 'right_hand_camera'; name one with --tip (tip= in" in str(caught.value)
    arm = hf.Arm.from_urdf(path, tip="right_hand")
    q = np.linspace(-0.7, 0.8, 7)
    np.testing.assert_allclose(arm.forward_kinematics(q), yourdfpy_pose(path, arm, q), atol=1e-12)


def test_the_body_that_carries_the_only_finger_is_the_tip(tmp_path: Path) -> None:
    path = sawyer(tmp_path, *HAND, gripper=GRIPPER)
    arm = hf.Arm.from_urdf(path)
    assert arm.chain == hf.model.arm.Chain("base", "right_gripper_base")
    assert arm.n == 7
    q = np.linspace(0.9, -0.4, 7)
    np.testing.assert_allclose(arm.forward_kinematics(q), yourdfpy_pose(path, arm, q), atol=1e-12)
    assert hf.Arm.from_urdf(path, tip="right_gripper_l_finger").n == 8  # who asks for a finger gets it


@pytest.mark.parametrize("names", [("slide", "bar"), ("gripper_joint", "bar")])
@pytest.mark.parametrize("kind", ["prismatic", "revolute"])
def test_what_may_be_a_finger_is_asked_about(tmp_path: Path, names: tuple[str, str], kind: str) -> None:
    """Neither a name nor a second one beside it tells that a joint moves a finger; the flange beside it is as good a tip."""
    moving = (link(names[1]), joint(names[0], "right_l6", names[1], kind))
    path = sawyer(tmp_path, *HAND, gripper=moving)
    sure = names[0] == "gripper_joint" and kind == "prismatic"
    if sure:
        assert hf.Arm.from_urdf(path).chain == hf.model.arm.Chain("base", "right_hand")
        return
    with pytest.raises(ArmError, match=r"the arm could end at 'bar', .*'right_hand'"):
        hf.Arm.from_urdf(path)


def test_two_that_slide_side_by_side_or_mimic_make_the_body_between_them_a_candidate(tmp_path: Path) -> None:
    pair = (link("l"), joint("l", "right_l6", "l", "prismatic", SLIDE), link("r"))
    for second in (SLIDE, f"{SLIDE}<mimic joint='l'/>"):
        path = sawyer(tmp_path, gripper=(*pair, joint("r", "right_l6", "r", "prismatic", second)))
        with pytest.raises(ArmError, match="the arm could end at 'l', 'r', 'right_l6'; name one"):
            hf.Arm.from_urdf(path)


def test_an_arm_that_is_all_fingers_asks(tmp_path: Path) -> None:
    parts = [link("palm"), link("a"), link("b"), joint("finger_1", "palm", "a"), joint("finger_2", "a", "b")]
    path = tmp_path / "finger.urdf"
    path.write_text(f"<robot name='finger'>{''.join(parts)}</robot>")
    with pytest.raises(
        ArmError, match=r"only the fingers of a gripper move on 'palm' \('a', 'b'\); name one with --tip"
    ) as caught:
        hf.Arm.from_urdf(path)
    assert caught.value.tip == "b"  # the command line shows it in an example
    assert hf.Arm.from_urdf(path, tip="b").n == 2


def test_a_pinky_is_a_finger_and_a_tip_on_independent_joints_is_suggested(tmp_path: Path) -> None:
    """Fingers of a hand often have other names, and their outer joints mimic the inner ones."""
    pinky = (link("pinky"), joint("pinky", "right_hand", "pinky"))
    assert hf.Arm.from_urdf(sawyer(tmp_path, *HAND, gripper=pinky)).chain == hf.model.arm.Chain("base", "right_hand")
    outer = joint("ring_2", "ring_1", "ring_tool", inside="<mimic joint='ring_1'/>")
    ring = (link("ring_1"), joint("ring_1", "right_hand", "ring_1"), link("ring_tool"), outer)
    with pytest.raises(ArmError, match="the arm could end at 'ring_tool', 'right_hand_camera'") as caught:
        hf.Arm.from_urdf(sawyer(tmp_path, *HAND, *CAMERA, gripper=ring))
    assert caught.value.tip == "right_hand_camera"


def test_a_panda_with_its_hand_ends_at_the_hand_s_frame() -> None:
    path = DATA_FOLDER.joinpath("panda.urdf")
    arm = hf.Arm.from_urdf(str(path))
    assert arm.chain == hf.model.arm.Chain("panda_link0", "panda_hand_tcp")
    model = pin.buildModelFromUrdf(str(path))
    q = np.array([0.1, -0.5, 0.3, -2.0, 0.2, 1.7, 0.6])
    data = model.createData()
    pin.framesForwardKinematics(model, data, np.concatenate([q, [0, 0]]))
    np.testing.assert_allclose(arm.forward_kinematics(q), data.oMf[model.getFrameId("panda_hand_tcp")].homogeneous, atol=1e-12)
