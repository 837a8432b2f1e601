"""MJCF files against MuJoCo itself: kinematics, statics, inertia; and every sentence they are refused with."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import dynamics
import holdfast as hf
from holdfast import arms


def text(values) -> str:
    return " ".join(repr(float(x)) for x in values)


class Forest:
    """Random MJCF: a chain of bodies with no, one or two joints, anchors and refs anywhere, and branches beside it."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng, self.joints, self.chain, self.beside = rng, 0, [], []
        inner = f"<site name='hand' pos='{text(rng.normal(size=3))}' quat='{text(rng.normal(size=4))}'/>"
        for k in reversed(range(int(rng.integers(2, 5)))):
            branch = self.body(f"branch{k}", self.made(self.beside, 1), "") if rng.uniform() < 0.6 else ""
            inner = self.body(f"b{k}", self.made(self.chain, int(rng.integers(1, 3))), branch + inner)
            if rng.uniform() < 0.4:
                inner = self.body(f"plate{k}", "", inner)
        option = f"<compiler angle='radian'/><option gravity='{text(rng.normal(size=3) * 5)}'/>"
        foot = self.body("foot", "", inner)
        self.text = f"<mujoco model='forest'>{option}<worldbody>{foot}</worldbody></mujoco>"

    def made(self, names: list[str], count: int) -> str:
        lines = []
        for _ in range(count):
            rng, name = self.rng, f"j{self.joints}"
            self.joints += 1
            kind = ("hinge", "hinge", "slide")[int(rng.integers(3))]
            limit = f"range='{text(np.sort(rng.uniform(-2, 2, 2)))}'" if rng.uniform() < 0.5 else ""
            lines.append(
                f"<joint name='{name}' type='{kind}' axis='{text(rng.normal(size=3))}' pos='{text(rng.normal(size=3) * 0.3)}' "
                f"ref='{rng.normal()!r}' damping='{rng.uniform()!r}' armature='{rng.uniform()!r}' {limit}/>"
            )
            names.append(name)
        # The chain is written from its end, and a body's joints from its first.
        names[len(names) - count :] = names[len(names) - count :][::-1]
        return "".join(lines)

    def body(self, name: str, joints: str, inside: str) -> str:
        rng = self.rng
        heavy = f"<geom type='box' size='{text(rng.uniform(0.05, 0.2, 3))}' pos='{text(rng.normal(size=3) * 0.2)}'/>"
        where = f"pos='{text(rng.normal(size=3) * 0.5)}' quat='{text(rng.normal(size=4))}'"
        return f"<body name='{name}' {where}>{joints}{heavy}{inside}</body>"


def write(tmp_path, inside: str, more: str = "", name: str = "arm.xml"):
    path = tmp_path / name
    path.write_text(f"<mujoco>{more}<worldbody>{inside}</worldbody></mujoco>")
    return path


def hinge(name: str = "j", more: str = "axis='0 1 0'") -> str:
    return f"<joint name='{name}' {more}/>"


BALL = "<geom size='.1' pos='.3 0 0'/>"
ONE = f"<body name='a'>{hinge()}{BALL}</body>"


@pytest.mark.interpreted
@pytest.mark.parametrize("case", range(8))
def test_random_trees_agree_with_mujoco(rng, tmp_path, case):
    forest = Forest(rng)
    path = tmp_path / "forest.xml"
    path.write_text(forest.text)
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    arm = hf.Arm.from_mjcf(path, tip="hand", base="foot" if case % 2 else None)
    assert arm.joint_names == tuple(reversed(forest.chain))
    index = [int(model.joint(x).qposadr[0]) for x in arm.joint_names]
    for name in forest.beside:  # these stand at their reference, or at the limit nearest to it
        j = model.joint(name)
        at = float(j.qpos0[0])
        data.qpos[j.qposadr[0]] = np.clip(at, *j.range) if model.jnt_limited[j.id] else at
    q = rng.normal(size=arm.n)
    data.qpos[index] = q
    mujoco.mj_forward(model, data)
    pose = arm.forward_kinematics(q)
    np.testing.assert_allclose(pose[:3, 3], data.site("hand").xpos, atol=1e-10)
    np.testing.assert_allclose(pose[:3, :3], data.site("hand").xmat.reshape(3, 3), atol=1e-10)
    np.testing.assert_allclose(dynamics.gravity_torque(arm, q), data.qfrc_bias[index], rtol=1e-8, atol=1e-8)
    matrix, column = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
    for k in range(model.nv):
        mujoco.mj_mulM(model, data, column, np.eye(model.nv)[k])
        matrix[k] = column
    np.testing.assert_allclose(dynamics.mass_matrix(arm, q), matrix[np.ix_(index, index)], rtol=1e-8, atol=1e-8)
    for joint in arm.joints:
        j = model.joint(joint.name)
        limited = bool(model.jnt_limited[j.id])
        assert (joint.lower, joint.upper) == (tuple(j.range) if limited else (-np.inf, np.inf))
        assert (joint.friction, joint.armature) == (model.dof_damping[j.dofadr[0]], model.dof_armature[j.dofadr[0]])
        assert joint.type == ("prismatic" if j.type[0] == 2 else "revolute" if limited else "continuous")
    assert arm.name == "forest"
    assert arm.source == "forest.xml"


def spelled(arm: hf.Arm) -> str:
    """An arm as MJCF text."""
    out, end, frame = "", "", arm.base
    for joint, link in zip(arm.joints, arm.links, strict=True):
        pose, i = frame @ joint.origin, link.inertia
        quaternion = Rotation.from_matrix(pose[:3, :3]).as_quat(scalar_first=True)
        limit = f"range='{joint.lower!r} {joint.upper!r}'" if np.isfinite(joint.lower) else ""
        out += (
            f"<body pos='{text(pose[:3, 3])}' quat='{text(quaternion)}'><joint name='{joint.name}' axis='{text(joint.axis)}' "
            f"damping='{joint.friction!r}' actuatorfrcrange='{-joint.effort!r} {joint.effort!r}' {limit}/>"
            f"<inertial pos='{text(link.com)}' mass='{link.mass!r}' "
            f"fullinertia='{text([i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])}'/>"
        )
        end, frame = "</body>" + end, np.eye(4)
    quaternion = Rotation.from_matrix(arm.tool[:3, :3]).as_quat(scalar_first=True)
    tool = f"<site name='tool' pos='{text(arm.tool[:3, 3])}' quat='{text(quaternion)}'/>"
    return f"<mujoco><compiler angle='radian'/><worldbody>{out}{tool}{end}</worldbody></mujoco>"


@pytest.mark.parametrize("name", ["xarm7", "panda"])
def test_a_built_in_arm_spelled_as_mjcf_comes_back(name, rng, tmp_path):
    arm = arms.load(name)
    path = tmp_path / "same.mjcf"
    path.write_text(spelled(arm))
    back = hf.Arm.from_mjcf(path, tip="tool")
    assert back.joint_names == arm.joint_names
    assert [j.effort for j in back.joints] == [j.effort for j in arm.joints]
    np.testing.assert_array_equal((back.lower, back.upper), (arm.lower, arm.upper))
    q = rng.uniform(-2, 2, arm.n)
    np.testing.assert_allclose(back.forward_kinematics(q), arm.forward_kinematics(q), atol=1e-12)
    np.testing.assert_allclose(dynamics.gravity_torque(back, q), dynamics.gravity_torque(arm, q), atol=1e-9)
    np.testing.assert_allclose(dynamics.mass_matrix(back, q), dynamics.mass_matrix(arm, q), atol=1e-9)
    friction = hf.Friction(coulomb=0.1, viscous=3.0)
    fall, expected = (hf.power_loss(x, q, friction=friction, stops=False, duration=0.3) for x in (back, arm))
    np.testing.assert_allclose(fall.q_final, expected.q_final, atol=1e-9)


def test_names_defaults_and_the_one_end(tmp_path):
    path = write(tmp_path, f"<body><joint/>{BALL}<body name='end' pos='1 0 0'><joint type='slide'/>{BALL}</body></body>")
    arm = hf.Arm.from_mjcf(path)
    assert arm.joint_names == ("joint1", "joint2")
    assert [x.name for x in arm.links] == ["body1", "end"]
    assert arm.gravity.tolist() == [0, 0, -9.81]
    assert arm.name == "arm"
    np.testing.assert_allclose(arm.forward_kinematics([0.0, 0.5])[:3, 3], [1, 0, 0.5])
    assert hf.Arm.from_mjcf(path, name="mine").name == "mine"


def test_hold_moves_what_hangs_beside_the_chain(tmp_path):
    finger = f"<body name='finger'><joint name='f' type='slide' axis='1 0 0' range='0 .5'/>{BALL}</body>"
    path = write(tmp_path, f"<body name='a'>{hinge()}{BALL}{finger}</body>")
    still, held = hf.Arm.from_mjcf(path, tip="a"), hf.Arm.from_mjcf(path, tip="a", hold={"f": 0.4})
    assert held.links[0].com[0] == pytest.approx(still.links[0].com[0] + 0.2)
    with pytest.raises(hf.ArmError, match="hold puts joint 'f' at 2"):
        hf.Arm.from_mjcf(path, tip="a", hold={"f": 2.0})


@pytest.mark.parametrize(
    ("actuators", "effort"),
    [
        ("<motor joint='j' gear='3' ctrlrange='-2 2'/>", 6.0),
        ("<position joint='j' forcerange='-7 5'/>", 7.0),
        ("<motor joint='j' ctrlrange='-2 2'/><motor joint='j' ctrlrange='-1 1'/>", 3.0),
        ("<motor joint='j'/>", np.inf),
        ("", np.inf),
    ],
)
def test_effort_is_what_the_actuators_can_do(tmp_path, actuators, effort):
    path = tmp_path / "arm.xml"
    path.write_text(f"<mujoco><worldbody>{ONE}</worldbody><actuator>{actuators}</actuator></mujoco>")
    assert hf.Arm.from_mjcf(path).joints[0].effort == effort


def test_gravity_switched_off_is_none(tmp_path):
    path = write(tmp_path, ONE, "<option><flag gravity='disable'/></option>")
    assert hf.Arm.from_mjcf(path).gravity.tolist() == [0, 0, 0]


PAIR = f"<body name='a'>{hinge()}{BALL}<body name='b' pos='1 0 0'>{hinge('k')}{BALL}</body></body>"
TWO_FINGERS = PAIR.replace(
    "</body></body>",
    f"<body name='l'>{hinge('fl')}{BALL}</body><body name='r'>{hinge('fr')}{BALL}</body></body></body>",
)


def ties(tmp_path, inside: str, more: str):
    path = tmp_path / "arm.xml"
    path.write_text(f"<mujoco><worldbody>{inside}</worldbody>{more}</mujoco>")
    return path


@pytest.mark.parametrize(
    ("inside", "more", "sentence"),
    [
        (PAIR, "<equality><joint name='e' joint1='j' joint2='k'/></equality>", "equality 'e' ties joint 'j', 'k' of the chain"),
        (PAIR, "<equality><connect body1='b' anchor='0 0 0'/></equality>", "equality '1' ties the bodies 'b', 'world'.*loop"),
        (PAIR, "<equality><weld name='w' body1='a' body2='b'/></equality>", "equality 'w' ties the bodies 'a', 'b'"),
        (
            PAIR,
            "<tendon><fixed name='t'><joint joint='j' coef='1'/><joint joint='k' coef='1'/></fixed></tendon>",
            "tendon 't' ties joint 'j', 'k'",
        ),
        (
            PAIR.replace("<body name='b'", "<site name='s'/><body name='b'").replace(
                "</body></body>", "<site name='e'/></body></body>"
            ),
            "<tendon><spatial name='t'><site site='s'/><site site='e'/></spatial></tendon>",
            "tendon 't' ties the bodies 'a', 'b'",
        ),
    ],
)
def test_loops_and_tendons_over_the_chain_are_refused(tmp_path, inside, more, sentence):
    with pytest.raises(hf.ArmError, match=sentence):
        hf.Arm.from_mjcf(ties(tmp_path, inside, more), tip="b")


def test_a_tendon_over_one_joint_carries_its_motor_and_ties_nothing(tmp_path):
    more = "<tendon><fixed name='t'><joint joint='k' coef='0.8'/></fixed></tendon><actuator><motor tendon='t'/></actuator>"
    assert hf.Arm.from_mjcf(ties(tmp_path, PAIR, more), tip="b").joint_names == ("j", "k")


@pytest.mark.parametrize(
    "more",
    [
        "<equality><joint joint1='fl' joint2='fr'/></equality>",
        "<tendon><fixed><joint joint='fl' coef='1'/><joint joint='fr' coef='1'/></fixed></tendon>",
        "<equality><weld body1='l' body2='r'/></equality>",
        "<equality><joint joint1='j' joint2='k' active='false'/></equality>",
    ],
)
def test_ties_beside_the_chain_do_no_harm(tmp_path, more):
    assert hf.Arm.from_mjcf(ties(tmp_path, TWO_FINGERS, more), tip="b").n == 2


def test_unnamed_bodies_and_joints_get_names_that_the_file_does_not_use(tmp_path):
    inside = f"<body name='body2'>{hinge('joint2')}{BALL}<body><joint/>{BALL}</body></body>"
    arm = hf.Arm.from_mjcf(ties(tmp_path, inside, ""))
    assert arm.joint_names == ("joint2", "joint2_")
    assert arm.chain.tip == "body2_"


def test_an_actuator_with_several_controls_does_not_shift_the_efforts_of_others(tmp_path):
    """MuJoCo 4 has more controls than actuators if one of them drives an orientation."""
    ball = f"<body name='ball'><joint name='s' type='ball'/>{BALL}</body>"
    drive = "<orientation joint='s' kp='1' forcerange='0 9'/>" if hasattr(mujoco.MjModel, "actuator_ctrladr") else ""
    motors = "<motor joint='j' gear='2' ctrlrange='-3 3'/><motor joint='k' gear='5' ctrlrange='-7 7'/>"
    more = f"<compiler autolimits='true'/><actuator>{drive}{motors}</actuator>"
    arm = hf.Arm.from_mjcf(ties(tmp_path, PAIR + ball, more), tip="b")
    assert [joint.effort for joint in arm.joints] == [6, 35]


def test_a_mocap_body_that_pulls_the_arm_is_no_loop(tmp_path):
    more = "<equality><weld body1='pull' body2='b'/></equality>"
    assert hf.Arm.from_mjcf(ties(tmp_path, PAIR + "<body name='pull' mocap='true'/>", more), tip="b").joint_names == ("j", "k")
    with pytest.raises(hf.ArmError, match="closes a loop"):
        hf.Arm.from_mjcf(ties(tmp_path, PAIR + "<body name='pull'/>", more), tip="b")


def test_a_gripper_of_closed_loops_ends_the_arm_at_its_base(tmp_path):
    """Four bars on each side, as in many grippers: rods whose ends meet, and no name that says finger."""
    side = (
        "<body name='{0}1'>{1}" + BALL + "<body name='{0}2' pos='0 0 1'>{2}" + BALL + "</body></body>"
        "<body name='{0}3' pos='0 1 0'>{3}" + BALL + "</body>"
    )
    bars = "".join(side.format(x, *(hinge(f"{x}{k}") for k in (1, 2, 3))) for x in "lr")
    inside = PAIR.replace("</body></body>", f"<body name='palm'>{BALL}{bars}</body></body></body>")
    more = "<equality><connect body1='l2' body2='l3' anchor='0 1 0'/><connect body1='r2' body2='r3' anchor='0 1 0'/></equality>"
    with pytest.raises(hf.ArmError, match=r"the arm could end at .*'palm'") as caught:
        hf.Arm.from_mjcf(ties(tmp_path, inside, more))
    assert caught.value.tip == "palm"
    assert hf.Arm.from_mjcf(ties(tmp_path, inside, more), tip="palm").joint_names == ("j", "k")


@pytest.mark.parametrize("objects", [1, 3])
def test_free_objects_beside_the_arm_are_no_ends_of_it(tmp_path, objects):
    beside = "".join(f"<body name='cube{k}' pos='1 {k} 1'><freejoint/>{BALL}</body>" for k in range(objects))
    alone, scene = (hf.Arm.from_mjcf(write(tmp_path, text)) for text in (ONE, beside + ONE))
    assert scene.joint_names == alone.joint_names
    np.testing.assert_array_equal(scene.forward_kinematics([0.3]), alone.forward_kinematics([0.3]))
    car = f"<body name='car'><freejoint name='wheels'/>{BALL}{ONE}</body>"
    with pytest.raises(hf.ArmError, match=r"joint 'wheels' .* is free; .*--base car"):
        hf.Arm.from_mjcf(write(tmp_path, beside + car))
    assert hf.Arm.from_mjcf(write(tmp_path, beside + car), base="car").n == 1


@pytest.mark.parametrize(
    ("inside", "options", "sentence"),
    [
        (f"<body name='a'><joint name='j' type='ball'/>{BALL}</body>", {}, "joint 'j' on the chain is ball"),
        (f"<body name='a'><freejoint name='f'/>{BALL}<body name='b'>{hinge()}{BALL}</body></body>", {}, "joint 'f' .* is free"),
        (ONE, {"tip": "hand"}, "there is no tip link 'hand'"),
        (ONE, {"base": "foot"}, "there is no base link 'foot'"),
        (ONE, {"base": "a", "tip": "a"}, "no moving joint lies between"),
        (PAIR, {"base": "b", "tip": "a"}, "tip link 'a' does not hang on base link 'b'"),
        (TWO_FINGERS, {}, "the arm could end at 'l', 'r'; name one"),
        ("<geom size='1'/>", {}, "the model has no joint"),
        ("<body><joint/></body>", {}, "MuJoCo cannot read this .*mass"),
        ("<nonsense/>", {}, "MuJoCo cannot read this .*nonsense"),
    ],
)
def test_what_is_no_serial_arm_is_refused_with_a_sentence(tmp_path, inside, options, sentence):
    with pytest.raises(hf.ArmError, match=sentence) as caught:
        hf.Arm.from_mjcf(write(tmp_path, inside), **options)
    assert str(caught.value).startswith("arm.xml: ")
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(hf.ArmError, match=r"nowhere\.xml: the file cannot be read"):
        hf.Arm.from_mjcf(tmp_path / "nowhere.xml")


def test_the_outermost_element_of_an_xml_file_tells_what_it_is(tmp_path):
    assert arms.load(str(write(tmp_path, ONE))).joint_names == ("j",)
    assert arms.load(str(write(tmp_path, ONE, name="arm.mjcf"))).joint_names == ("j",)
    assert arms.load(str(write(tmp_path, PAIR)), tip="a").n == 1
    urdf = tmp_path / "urdf.xml"
    joint = "<joint name='u' type='continuous'><parent link='a'/><child link='b'/></joint>"
    urdf.write_text(f"<robot name='r'><link name='a'/><link name='b'/>{joint}</robot>")
    assert arms.load(str(urdf)).joint_names == ("u",)
    urdf.write_text("this is not XML")
    with pytest.raises(hf.ArmError, match="not valid XML"):
        arms.load(str(urdf))
