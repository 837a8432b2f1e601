"""Arms from model objects, texts, and names: numbers against the library that the object belongs to, and every refusal."""

from __future__ import annotations

import subprocess
import sys
import warnings

import mujoco
import numpy as np
import pinocchio
import pytest
import yourdfpy
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast.model.arm.formats.pinocchio_model import read_pinocchio_model
from holdfast.model.arms.builtin import DATA_FOLDER

with warnings.catch_warnings():  # of the toolbox's own escape sequences
    warnings.simplefilter("ignore")
    import roboticstoolbox
    from spatialmath import SE3

PANDA = DATA_FOLDER.joinpath("panda.urdf")
TWO_LINKS = (
    '<robot name="two"><link name="base"/><link name="arm"/><link name="hand"/>'
    '<joint name="a" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>'
    '<limit lower="-1" upper="1" velocity="1" effort="1"/></joint>'
    '<joint name="b" type="continuous"><parent link="arm"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>'
    "</robot>"
)
MODEL = (
    '<mujoco model="tilted"><compiler angle="radian"/><option gravity="1 -2 -9"/><worldbody>'
    '<body name="foot" pos=".1 .2 .3" euler=".3 .2 .1">'
    '<joint name="turn" axis="0 1 1" pos=".1 0 .05" range="-2 2" ref=".3"/><joint name="slide" type="slide" axis="1 0 0"/>'
    '<geom size=".1"/><body name="fore" pos="0 .2 .4" euler="1 0 0"><joint name="roll" axis="0 0 1" armature=".1" damping="2"/>'
    '<geom size=".1 .2" type="capsule" pos="0 0 .1"/><site name="hand" pos=".1 .1 .1" euler="0 1 0"/></body></body>'
    "</worldbody></mujoco>"
)


# ---- Pinocchio -----------------------------------------------------------------------------------------------------


def random_model(rng: np.random.Generator) -> pinocchio.Model:
    """A tree with a floating root, unaligned and unlimited joints, a branch, and frames that turn."""
    model = pinocchio.Model()
    model.name, model.gravity = "made", pinocchio.Motion(rng.normal(size=3) * 5, np.zeros(3))
    axis = [part / np.linalg.norm(part) for part in rng.normal(size=(4, 3))]
    chain = [
        pinocchio.JointModelFreeFlyer(),
        pinocchio.JointModelRevoluteUnaligned(axis[0]),
        pinocchio.JointModelRUBX(),
        pinocchio.JointModelPrismaticUnaligned(axis[1]),
        pinocchio.JointModelRUBZ(),
        pinocchio.JointModelRY(),
    ]
    parent = 0
    for number, kind in enumerate(chain):
        parent = model.addJoint(parent, kind, pinocchio.SE3.Random(), f"j{number}")
        frame = model.addJointFrame(parent)
        model.appendBodyToJoint(parent, pinocchio.Inertia.Random(), pinocchio.SE3.Random())
        model.addBodyFrame(f"body{number}", parent, pinocchio.SE3.Identity() if number % 2 else pinocchio.SE3.Random(), frame)
    branch = model.addJoint(3, pinocchio.JointModelRX(), pinocchio.SE3.Random(), "beside")
    model.addJointFrame(branch)
    model.appendBodyToJoint(branch, pinocchio.Inertia.Random(), pinocchio.SE3.Random())
    model.addBodyFrame("cable", branch, pinocchio.SE3.Identity(), -1)
    frame = pinocchio.Frame("hand", parent, model.getFrameId("body5"), pinocchio.SE3.Random(), pinocchio.FrameType.OP_FRAME)
    model.addFrame(frame)
    return model


def check_against_pinocchio(arm: hf.Arm, model: pinocchio.Model, rng: np.random.Generator) -> None:
    data, frame = model.createData(), model.getFrameId(arm.chain.tip)
    columns = [model.joints[model.getJointId(name)].idx_v for name in arm.joint_names]
    for _ in range(25):
        velocity = np.zeros(model.nv)
        velocity[columns] = x = rng.uniform(-2, 2, arm.n)
        q = pinocchio.integrate(model, pinocchio.neutral(model), velocity)
        pinocchio.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(arm.forward_kinematics(x), data.oMf[frame].homogeneous, atol=1e-13)
        jacobian = pinocchio.computeFrameJacobian(model, data, q, frame, pinocchio.LOCAL_WORLD_ALIGNED)
        np.testing.assert_allclose(arm.jacobian(x), jacobian[:, columns], atol=1e-13)
        torque = pinocchio.computeGeneralizedGravity(model, data, q)[columns]
        np.testing.assert_allclose(arm.gravity_torque(x), torque, atol=1e-12 * np.abs(torque).max())


@pytest.mark.parametrize("seed", range(4))
def test_a_pinocchio_model_is_the_same_arm(seed):
    rng = np.random.default_rng(seed)
    pinocchio.seed(seed)
    model = random_model(rng)
    arm = hf.arms.load(model, base="j0 (link)", tip="hand", name="mine")
    assert (arm.name, arm.source, arm.joint_names) == ("mine", "Pinocchio model 'made'", ("j1", "j2", "j3", "j4", "j5"))
    assert [joint.type for joint in arm.joints][1::2] == ["continuous", "continuous"]
    check_against_pinocchio(arm, model, rng)


@pytest.mark.parametrize("mimic", [False, True])
def test_a_pinocchio_model_of_a_file(mimic):
    model = pinocchio.buildModelFromUrdf(str(PANDA), mimic=mimic)
    model.referenceConfigurations["up"] = np.arange(float(model.nq))
    arm, file = hf.arms.load(model, tip="panda_hand_tcp"), hf.arms.load(PANDA, tip="panda_hand_tcp")
    check_against_pinocchio(arm, model, np.random.default_rng(1))
    assert arm.joint_names == file.joint_names
    for name in ("lower", "upper"):
        assert np.array_equal(getattr(arm, name), getattr(file, name))
    for name in ("velocity", "effort", "friction", "armature"):
        assert [getattr(joint, name) for joint in arm.joints] == [getattr(joint, name) for joint in file.joints]
    np.testing.assert_array_equal(arm.states["up"], range(7))


def test_a_mimic_joint_of_pinocchio_follows_a_held_master():
    model = pinocchio.buildModelFromXML(
        TWO_LINKS.replace(
            "</robot>",
            '<link name="f"/><link name="g"/><joint name="A" type="revolute"><parent link="base"/><child link="f"/>'
            '<axis xyz="1 0 0"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint><joint name="g" type="prismatic">'
            '<parent link="arm"/><child link="g"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/>'
            '<mimic joint="A" multiplier="-0.5" offset="0.2"/></joint></robot>',
        ),
        mimic=True,
    )
    for value in (0.0, 0.4):
        arm = hf.arms.load(model, tip="g", hold={"A": value, "g": 0.2 - 0.5 * value})
        via_mimic = read_pinocchio_model(model, tip="g", hold={"A": value})
        np.testing.assert_allclose(via_mimic.tool, arm.tool, atol=1e-12)


# ---- MuJoCo and texts ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["spec", "model", "text", "file"])
def test_a_mujoco_object_is_the_same_arm(kind, tmp_path):
    spec = mujoco.MjSpec.from_string(MODEL)
    model = mujoco.MjSpec.from_string(MODEL).compile()
    (tmp_path / "a.xml").write_text(MODEL)
    arm = hf.arms.load({"spec": spec, "model": model, "text": f"\n {MODEL}", "file": tmp_path / "a.xml"}[kind], tip="hand")
    data = mujoco.MjData(model)
    assert arm.source == {"text": "MJCF text", "file": "a.xml"}.get(kind, "MuJoCo model 'tilted'")
    for q in np.random.default_rng(2).uniform(-2, 2, (20, 3)):
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        np.testing.assert_allclose(arm.forward_kinematics(q)[:3, 3], data.site("hand").xpos, atol=1e-14)
        np.testing.assert_allclose(arm.forward_kinematics(q)[:3, :3], data.site("hand").xmat.reshape(3, 3), atol=1e-14)
        np.testing.assert_allclose(arm.gravity_torque(q), data.qfrc_bias, atol=1e-12 * np.abs(data.qfrc_bias).max())
    shapes = hf.model.shapes.reading.read_pieces(arm, "collision")
    assert [piece.kind for piece in shapes[0]] == ["sphere", "capsule"]
    assert spec.compile().nq == 3  # the caller's spec still works


def test_a_urdf_text_and_a_yourdfpy_object_are_the_arm_of_the_file():
    file = hf.arms.load(PANDA, tip="panda_hand_tcp")
    robot = yourdfpy.URDF.load(str(PANDA), load_meshes=False, build_scene_graph=False)
    for source, label in ((PANDA.read_text(), "URDF text"), (robot, "yourdfpy model 'panda'")):
        arm = hf.arms.load(source, tip="panda_hand_tcp")
        assert (arm.fingerprint, arm.source, arm.name) == (file.fingerprint, label, "panda")


def test_an_arm_and_a_built_in_name_are_themselves():
    arm = hf.arms.load("panda")
    assert hf.arms.load(arm) is arm
    assert hf.arms.load("panda") is arm
    assert hf.arms.load("panda", name="left").name == "left"


def test_a_group_of_an_srdf_file_gives_base_and_tip(tmp_path):
    file = tmp_path / "two.urdf"
    file.write_text(TWO_LINKS)
    file.with_suffix(".srdf").write_text(
        '<robot name="two"><group name="upper"><chain base_link="arm" tip_link="hand"/></group>'
        '<group name="hand"><link name="hand"/></group></robot>'
    )
    arm = hf.arms.load(file, group="upper")
    assert (arm.chain.base, arm.chain.tip, arm.joint_names) == ("arm", "hand", ("b",))
    assert hf.arms.load(file, group="upper", base="base").n == 2
    with pytest.raises(hf.ArmError, match="group 'hand' is a list of joints or links and has no <chain>; name base and tip"):
        hf.arms.load(file, group="hand")
    with pytest.raises(hf.ArmError, match="there is no group 'x'; its groups are 'upper', 'hand'"):
        hf.arms.load(file, group="x")
    with pytest.raises(hf.ArmError, match="group 'x' stands in an SRDF file, and there is none beside the URDF file"):
        hf.arms.load(TWO_LINKS, group="x")


# ---- Robotics Toolbox ----------------------------------------------------------------------------------------------


def random_table(rng: np.random.Generator) -> roboticstoolbox.DHRobot:
    modified = rng.uniform() < 0.5
    revolute = roboticstoolbox.RevoluteMDH if modified else roboticstoolbox.RevoluteDH
    prismatic = roboticstoolbox.PrismaticMDH if modified else roboticstoolbox.PrismaticDH
    links = []
    for _ in range(int(rng.integers(2, 6))):
        a, alpha, d, offset, mass, motor, damping = rng.normal(size=7)
        body = {"m": abs(mass), "r": rng.normal(size=3), "I": np.diag(rng.uniform(1, 2, 3)), "G": 3.0}
        common = {"a": a, "alpha": alpha, "offset": offset, "flip": rng.uniform() < 0.5, "Jm": abs(motor), "B": abs(damping)}
        links.append(
            prismatic(theta=d, qlim=[0, 1], **common, **body)
            if rng.uniform() < 0.3
            else revolute(d=d, qlim=[-1, 2], **common, **body)
        )
    base, tool = (SE3.Rt(Rotation.random(random_state=rng).as_matrix(), rng.normal(size=3)) for _ in range(2))
    return roboticstoolbox.DHRobot(links, name="table", base=base, tool=tool, gravity=rng.normal(size=3) * 5)


@pytest.mark.parametrize("seed", range(8))
def test_a_table_of_the_robotics_toolbox_is_the_same_arm(seed):
    rng = np.random.default_rng(seed)
    robot = random_table(rng)
    arm = hf.arms.load(robot)
    assert arm.n == robot.n
    assert np.array_equal([arm.lower, arm.upper], robot.qlim)
    assert [joint.armature for joint in arm.joints] == pytest.approx([9 * link.Jm for link in robot.links])
    assert [joint.friction for joint in arm.joints] == pytest.approx([9 * link.B for link in robot.links])

    def potential_energy(q):
        poses = robot.fkine_all(q)[1:]
        return -sum(link.m * robot.gravity @ (pose * link.r).ravel() for link, pose in zip(robot.links, poses, strict=True))

    for q in rng.uniform(-2, 2, (5, arm.n)):
        np.testing.assert_allclose(arm.forward_kinematics(q), robot.fkine(q).A, atol=1e-13)
        np.testing.assert_allclose(arm.jacobian(q), robot.jacob0(q), atol=1e-12)
        # gravload of the toolbox has the wrong sign for joints that are flipped, so the oracle is the energy.
        steps = 1e-5 * np.eye(arm.n)
        torque = [(potential_energy(q + step) - potential_energy(q - step)) / 2e-5 for step in steps]
        np.testing.assert_allclose(arm.gravity_torque(q), torque, atol=1e-7 * max(1, np.abs(torque).max()))


@pytest.mark.parametrize("name", ["DH.Puma560", "DH.Stanford", "DH.Jaco", "ETS.Panda", "ETS.Puma560"])
def test_robots_that_the_toolbox_ships(name):
    family, _, model = name.partition(".")
    robot = getattr(getattr(roboticstoolbox.models, family), model)()
    arm = hf.arms.load(robot)
    for q in np.random.default_rng(3).uniform(-1, 1, (5, robot.n)):
        np.testing.assert_allclose(arm.forward_kinematics(q), robot.fkine(q).A, atol=1e-13)


# ---- the way out ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", hf.arms.names())
def test_built_in_arms_survive_the_way_out_and_in(name):
    arm = hf.arms.load(name)
    q = np.random.default_rng(4).uniform(-1, 1, (20, arm.n))
    copies = {"urdf": hf.arms.load(arm.to_urdf()), "pinocchio": hf.arms.load(arm.to_pinocchio(), tip="tool")}
    if all(arm.links):
        copies["mujoco"] = hf.arms.load(arm.to_mujoco(), tip="tool")
        spec = arm.to_mujoco().compile()
        np.testing.assert_allclose(spec.jnt_range[spec.jnt_limited == 1, 0], arm.lower[np.isfinite(arm.lower)])
    else:
        with pytest.raises(hf.ArmError, match="has no inertial data"):
            arm.to_mujoco()
    for kind, copy in copies.items():
        assert copy.joint_names == arm.joint_names
        assert np.array_equal([copy.lower, copy.upper], [arm.lower, arm.upper])
        np.testing.assert_allclose(copy.forward_kinematics(q), arm.forward_kinematics(q), atol=1e-15)
        if all(arm.links) and (kind != "urdf" or name[:6] != "planar"):  # a URDF file has no gravity
            np.testing.assert_allclose(copy.gravity_torque(q), arm.gravity_torque(q), atol=1e-13)
        if kind != "urdf":
            np.testing.assert_array_equal(copy.states["home"], arm.states["home"])
    with_load = arm.with_payload(hf.Link(2.0, [0, 0, 0.1], 0.01 * np.eye(3)))
    if all(arm.links):
        for spec in (with_load.to_pinocchio(), with_load.to_mujoco()):
            np.testing.assert_allclose(
                hf.arms.load(spec, tip="tool").gravity_torque(q), with_load.gravity_torque(q), atol=1e-13
            )


# ---- what is not imported, and refusals ----------------------------------------------------------------------------


def test_loading_a_built_in_arm_imports_no_other_library():
    libraries = (
        "mujoco",
        "pinocchio",
        "yourdfpy",
        "roboticstoolbox",
        "xacro",
        "robot_descriptions",
        "pyarrow",
        "rosbags",
        "mcap",
    )
    code = f"import sys, holdfast as hf; hf.arms.load('panda'); print([x for x in {libraries} if x in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "[]"


def pinocchio_model(kind) -> pinocchio.Model:
    model = pinocchio.Model()
    model.name = "six"
    joint = model.addJoint(0, kind, pinocchio.SE3.Identity(), "j")
    model.addJointFrame(joint)
    model.addBodyFrame("tip", joint, pinocchio.SE3.Identity(), -1)
    return model


REFUSALS = {
    "a number": (3.5, {}, "no arm can be made of a builtins.float; give a built-in name, a file"),
    "none": (None, {}, "no arm can be made of a builtins.NoneType; give"),
    "bytes": (b"<robot/>", {}, "no arm can be made of a builtins.bytes; give"),
    "a null character": ("a\0b", {}, "no arm can be made of 'a"),
    "a folder": (DATA_FOLDER, {}, "is not a file of a known kind; give a built-in name"),
    "no such file": ("none.urdf", {}, "none.urdf: the file cannot be read"),
    "no such name": ("pnda", {}, "there is no built-in arm or file 'pnda'; did you mean 'panda'"),
    "a cut text": ("<robot", {}, "URDF text: this is not valid XML"),
    "another text": ("<sdf/>", {}, "URDF text: the outermost element is <sdf>; a URDF file has <robot>"),
    "an empty robot": ("<robot name='a'/>", {}, "URDF text: the robot has no <link>"),
    "a broken MJCF text": ("<mujoco><worldbody><body/></worldbody></mujoco>", {}, "MJCF text: the model has no joint"),
    "a text with an include": ("<mujoco><include file='x.xml'/></mujoco>", {}, "MJCF text: "),
    "tip of a built-in arm": ("panda", {"tip": "x"}, "tip cannot be chosen for 'panda', which is a built-in arm; leave it out"),
    "base of an arm": (hf.arms.load("panda"), {"base": "x"}, "base cannot be chosen for 'panda', which is an arm already"),
    "xacro of a text": (TWO_LINKS, {"xacro": {"a": "b"}}, "xacro cannot be chosen for the text"),
    "srdf of MJCF": (
        MODEL,
        {"srdf": "a", "group": "b"},
        "group, srdf cannot be chosen for the text, which is",
    ),
    "tip of a text": (TWO_LINKS, {"tip": "hnd"}, "URDF text: there is no tip link 'hnd'; did you mean 'hand'"),
    "hold of a text": (TWO_LINKS, {"hold": {"x": 1}}, "URDF text: hold names 'x', which is not a moving joint"),
    "a part of MuJoCo": (mujoco.MjOption(), {}, "no arm can be made of a mujoco.MjOption; give its MjModel or MjSpec"),
    "a part of Pinocchio": (pinocchio.SE3.Identity(), {}, "no arm can be made of a pinocchio.SE3; give its Model"),
    "a part of the toolbox": (roboticstoolbox.ET.Rx(), {}, "no arm can be made of a roboticstoolbox.ET; give a robot"),
    "a site that is missing": (
        mujoco.MjModel.from_xml_string(MODEL),
        {"tip": "hnd"},
        "MuJoCo model 'tilted': there is no tip link 'hnd'",
    ),
    "MuJoCo without joints": (mujoco.MjSpec(), {}, "MuJoCo model '': the model has no joint"),
    "a ball": (pinocchio_model(pinocchio.JointModelSpherical()), {}, "joint 'j' on the chain is spherical; a serial arm needs"),
    "a floating base": (pinocchio_model(pinocchio.JointModelFreeFlyer()), {}, "joint 'j' on the chain is floating; a serial"),
    "a plane": (pinocchio_model(pinocchio.JointModelPlanar()), {}, "Pinocchio model 'six': joint 'j' on the chain is planar"),
    "a screw": (pinocchio_model(pinocchio.JointModelHX(0.1)), {}, "joint 'j' on the chain is helical; a serial arm needs"),
    "two axes": (pinocchio_model(pinocchio.JointModelUniversal(1, 0, 0, 0, 1, 0)), {}, "joint 'j' on the chain is universal"),
    "an empty model": (pinocchio.Model(), {}, "no moving joint hangs on 'universe'; an arm needs at least one"),
    "a mimic joint": (
        pinocchio.buildModelFromUrdf(str(PANDA), mimic=True),
        {"tip": "panda_rightfinger"},
        "joint 'panda_finger_joint2' on the chain mimics 'panda_finger_joint1', so it is not a degree of freedom",
    ),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_a_source_without_an_arm_gets_one_sentence(case):
    source, options, sentence = REFUSALS[case]
    with pytest.raises(hf.HoldfastError) as caught:
        hf.arms.load(source, **options)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)
