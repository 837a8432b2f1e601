"""The URDF reader against Pinocchio and yourdfpy, on real arms and on random trees, and every sentence it refuses with."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import yourdfpy
from hypothesis import given, settings
from hypothesis import strategies as st

from holdfast.core.errors import ArmError
from holdfast.model.arm.model import Arm
from holdfast.model.arms.builtin import DATA_FOLDER

# name, base, tip; the tips are not those of the built-in arms only
REAL = [
    ("panda", "panda_link0", "panda_hand_tcp"),
    ("panda", "panda_link0", "panda_link8"),
    ("panda", "panda_link2", "panda_hand"),
    ("xarm7", None, None),
    ("iiwa14", None, None),
    ("ur5", None, "tool0"),
    ("ur5", None, "ee_link"),
    ("kinova-j2s6s200", None, "j2s6s200_end_effector"),
]


def data(name: str) -> str:
    return str(DATA_FOLDER.joinpath(f"{name}.urdf"))


class Oracle:
    """Pinocchio's model with everything beside the chain locked, seen from the arm's base link."""

    def __init__(self, path: str, arm: Arm, base: str, tip: str, held: dict[str, float]) -> None:
        full = pin.buildModelFromUrdf(path)
        reference = pin.neutral(full)
        for joint, value in held.items():
            self.put(full, reference, joint, value)
        lock = [i for i, name in enumerate(full.names) if i and name not in arm.joint_names]
        self.model = pin.buildReducedModel(full, lock, reference)
        self.data = self.model.createData()
        self.names = arm.joint_names
        self.base, self.tip = (self.model.getFrameId(x, pin.FrameType.BODY) for x in (base, tip))

    @staticmethod
    def put(model: pin.Model, q: np.ndarray, joint: str, value: float) -> None:
        j = model.joints[model.getJointId(joint)]
        q[j.idx_q : j.idx_q + j.nq] = value if j.nq == 1 else (np.cos(value), np.sin(value))

    def at(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pose of the tip and its Jacobian, both in the base link's frame."""
        q = pin.neutral(self.model)
        for joint, value in zip(self.names, values, strict=True):
            self.put(self.model, q, joint, value)
        pin.computeJointJacobians(self.model, self.data, q)
        pin.updateFramePlacements(self.model, self.data)
        base = self.data.oMf[self.base]
        full = pin.getFrameJacobian(self.model, self.data, self.tip, pin.LOCAL_WORLD_ALIGNED)
        columns = [self.model.joints[self.model.getJointId(x)].idx_v for x in self.names]
        turned = np.kron(np.eye(2), base.rotation.T) @ full[:, columns]
        return (base.inverse() * self.data.oMf[self.tip]).homogeneous, turned

    def body(self, joint: str) -> pin.Inertia:
        return self.model.inertias[self.model.getJointId(joint)]


def agree(arm: Arm, oracle: Oracle, rng: np.random.Generator, tolerance: float = 1e-10) -> None:
    qs = rng.uniform(-3, 3, (5, arm.n))
    poses, jacobians = arm.forward_kinematics(qs), arm.jacobian(qs)
    for q, pose, jacobian in zip(qs, poses, jacobians, strict=True):
        expected_pose, expected_jacobian = oracle.at(q)
        np.testing.assert_allclose(pose, expected_pose, atol=tolerance)
        np.testing.assert_allclose(jacobian, expected_jacobian, atol=tolerance)
    for joint, link in zip(arm.joint_names, arm.links, strict=True):
        expected = oracle.body(joint)
        if link is None:
            assert expected.mass == 0
            continue
        assert link.mass == pytest.approx(expected.mass, abs=1e-12)
        if link.mass > 0:
            np.testing.assert_allclose(link.com, expected.lever, atol=tolerance)
            np.testing.assert_allclose(link.inertia, expected.inertia, atol=tolerance)


@pytest.mark.parametrize(("name", "base", "tip"), REAL)
def test_real_arms_agree_with_pinocchio(name: str, base: str | None, tip: str | None) -> None:
    arm = Arm.from_urdf(data(name), base, tip)
    root = {"panda": "panda_link0", "xarm7": "world", "iiwa14": "lbr_iiwa_link_0", "ur5": "world"}.get(name, "base")
    end = {"xarm7": "link_eef", "iiwa14": "lbr_iiwa_link_7"}.get(name, "")
    agree(arm, Oracle(data(name), arm, base or root, tip or end, {}), np.random.default_rng(1))
    assert arm.source == f"{name}.urdf"
    assert np.array_equal(arm.base, np.eye(4))


@pytest.mark.parametrize(("name", "base", "tip"), [case for case in REAL if case[2]])
def test_real_arms_agree_with_yourdfpy(name: str, base: str | None, tip: str) -> None:
    arm = Arm.from_urdf(data(name), base, tip)
    other = yourdfpy.URDF.load(data(name), load_meshes=False, build_scene_graph=True)
    q = np.random.default_rng(2).uniform(-3, 3, arm.n)
    values = dict(zip(arm.joint_names, q, strict=True))
    other.update_cfg({x: float(values.get(x, 0.0)) for x in other.actuated_joint_names})
    expected = other.get_transform(tip, base or other.base_link)
    np.testing.assert_allclose(arm.forward_kinematics(q), expected, atol=1e-9)


def test_held_fingers_move_the_hand_s_centre_of_mass() -> None:
    shut = Arm.from_urdf(data("panda"), tip="panda_hand")
    held = {"panda_finger_joint1": 0.03}
    ajar = Arm.from_urdf(data("panda"), tip="panda_hand", hold=held)
    # Without a word about finger 2, it mimics finger 1.
    oracle = Oracle(data("panda"), ajar, "panda_link0", "panda_hand", held | {"panda_finger_joint2": 0.03})
    agree(ajar, oracle, np.random.default_rng(3))
    assert not np.allclose(shut.links[-1].inertia, ajar.links[-1].inertia, atol=1e-9)
    apart = Arm.from_urdf(data("panda"), tip="panda_hand", hold=held | {"panda_finger_joint2": 0.0})
    assert not np.allclose(apart.links[-1].com, ajar.links[-1].com, atol=1e-9)


def test_the_chain_may_end_in_a_finger_once_the_other_is_frozen() -> None:
    arm = Arm.from_urdf(data("panda"), tip="panda_leftfinger", hold={"panda_finger_joint2": 0.01})
    oracle = Oracle(data("panda"), arm, "panda_link0", "panda_leftfinger", {"panda_finger_joint2": 0.01})
    agree(arm, oracle, np.random.default_rng(5))
    assert arm.n == 8


def test_a_cut_arm_carries_the_rest_of_itself() -> None:
    arm = Arm.from_urdf(data("iiwa14"), tip="lbr_iiwa_link_4")
    agree(arm, Oracle(data("iiwa14"), arm, "lbr_iiwa_link_0", "lbr_iiwa_link_4", {}), np.random.default_rng(4))
    assert arm.n == 4
    assert arm.links[-1].mass == pytest.approx(2.7 + 1.7 + 1.8 + 0.3)


# ---- random trees ------------------------------------------------------------------------------------------------


def vector(values: np.ndarray) -> str:
    return " ".join(repr(float(x)) for x in values)


class Forest:
    """Random URDF text: a chain of moving and fixed joints with branches of both kinds anywhere."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng, self.links, self.joints = rng, ["  <link name='root'/>"], []
        self.held: dict[str, float] = {}
        self.named: list[str] = []
        here = "root"
        for k in range(int(rng.integers(2, 6))):
            for _ in range(int(rng.integers(0, 3))):
                here = self.grow(here, "fixed")
            here = self.grow(here, ("revolute", "continuous", "prismatic")[int(rng.integers(3))], chain=True, heavy=k != 1)
            for _ in range(int(rng.integers(0, 3))):
                self.branch(here)
        for _ in range(int(rng.integers(0, 3))):
            here = self.grow(here, "fixed")
        self.tip = here

    def branch(self, link: str) -> None:
        for _ in range(int(self.rng.integers(1, 4))):
            link = self.grow(link, ("fixed", "revolute", "prismatic", "continuous")[int(self.rng.integers(4))])

    def grow(self, parent: str, kind: str, chain: bool = False, heavy: bool = True) -> str:
        rng, k = self.rng, len(self.links)
        origin = f"<origin xyz='{vector(rng.normal(size=3))}' rpy='{vector(rng.uniform(-7, 7, 3))}'/>"
        # A solid of random points has a physically possible inertia.
        points = rng.normal(size=(3, 6))
        spread = points @ points.T * 0.01
        i = np.trace(spread) * np.eye(3) - spread
        inertial = (
            f"<inertial><origin xyz='{vector(rng.normal(size=3))}' rpy='{vector(rng.uniform(-7, 7, 3))}'/>"
            f"<mass value='{rng.uniform(0.1, 5)!r}'/><inertia ixx='{i[0, 0]}' iyy='{i[1, 1]}' izz='{i[2, 2]}' "
            f"ixy='{i[0, 1]}' ixz='{i[0, 2]}' iyz='{i[1, 2]}'/></inertial>"
        )
        self.links.append(f"  <link name='link{k}'>{inertial if heavy and rng.uniform() < 0.8 else ''}</link>")
        lower, width = rng.uniform(-3, 1), rng.uniform(0.1, 3)
        limit = f"<limit lower='{lower!r}' upper='{lower + width!r}' velocity='{rng.uniform()!r}' effort='{rng.uniform()!r}'/>"
        moving = f"<axis xyz='{vector(rng.normal(size=3))}'/>{limit}" if kind != "fixed" else ""
        self.joints.append(
            f"  <joint name='joint{k}' type='{kind}'><parent link='{parent}'/><child link='link{k}'/>{origin}{moving}</joint>"
        )
        if kind != "fixed" and not chain:
            bounds = (-np.pi, np.pi) if kind == "continuous" else (lower, lower + width)
            named = rng.uniform() < 0.5
            self.held[f"joint{k}"] = float(rng.uniform(*bounds) if named else np.clip(0.0, *bounds))
            if named:
                self.named.append(f"joint{k}")
        return f"link{k}"

    def text(self) -> str:
        lines = self.links + self.joints
        return "\n".join(["<robot name='forest'>", *(lines[i] for i in self.rng.permutation(len(lines))), "</robot>"])


@pytest.mark.interpreted
@settings(max_examples=40)
@given(seed=st.integers(0, 2**32 - 1))
def test_random_trees_agree_with_pinocchio(tmp_path_factory: pytest.TempPathFactory, seed: int) -> None:
    rng = np.random.default_rng(seed)
    forest = Forest(rng)
    path = tmp_path_factory.mktemp("forest") / "forest.urdf"
    path.write_text(forest.text())
    arm = Arm.from_urdf(path, tip=forest.tip, hold={x: forest.held[x] for x in forest.named})
    agree(arm, Oracle(str(path), arm, "root", forest.tip, forest.held), rng, tolerance=1e-8)


# ---- small files -------------------------------------------------------------------------------------------------


def link(name: str, inside: str = "") -> str:
    return f"<link name='{name}'>{inside}</link>"


def joint(name: str, parent: str, child: str, kind: str = "revolute", inside: str | None = None) -> str:
    if inside is None:
        inside = "" if kind == "fixed" else "<axis xyz='0 0 1'/><limit lower='-1' upper='1' velocity='2' effort='3'/>"
    return f"<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{inside}</joint>"


def heavy(mass: str = "1") -> str:
    return (
        f"<inertial><origin xyz='1 0 0'/><mass value='{mass}'/>"
        "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    )


def write(tmp_path: Path, *parts: str, name: str = "bot") -> Path:
    path = tmp_path / "bot.urdf"
    path.write_text(f"<?xml version='1.0'?><robot name='{name}'>{''.join(parts)}</robot>")
    return path


AB = link("a") + link("b")
J = joint("j", "a", "b")


def test_joint_data(tmp_path: Path) -> None:
    limits = "<limit lower='-1' upper='2' velocity='0' effort='0'/><dynamics damping='0.7' friction='9'/><axis xyz='0 0 5'/>"
    full = "<limit upper='2' velocity='4' effort='5'/>"
    arm = Arm.from_urdf(
        write(
            tmp_path,
            AB,
            link("c"),
            link("d"),
            joint("j", "a", "b", inside=limits),
            joint("k", "b", "c", "prismatic", full),
            joint("l", "c", "d", "continuous", "<limit lower='-1' upper='1' velocity='6' effort='7'/>"),
        ),
        name="mine",
        gravity=(0, -9.81, 0),
    )
    j, k, c = arm.joints
    assert (j.lower, j.upper, j.velocity, j.effort, j.friction) == (-1, 2, np.inf, np.inf, 0.7)
    assert j.axis.tolist() == [0, 0, 1]
    assert (k.type, k.lower, k.upper, k.velocity, k.effort) == ("prismatic", 0, 2, 4, 5)
    assert k.axis.tolist() == [1, 0, 0]
    assert (c.type, c.lower, c.upper, c.velocity, c.effort) == ("continuous", -np.inf, np.inf, 6, 7)
    assert arm.name == "mine"
    assert arm.gravity.tolist() == [0, -9.81, 0]
    assert arm.links == (None, None, None)


def test_zero_mass_is_kept_and_missing_inertia_is_none_unless_something_hangs_on_it(tmp_path: Path) -> None:
    massless = Arm.from_urdf(write(tmp_path, link("a"), link("b", heavy("0")), joint("j", "a", "b")))
    assert massless.links[0].mass == 0
    assert massless.links[0].com.tolist() == [1, 0, 0]
    parts = [AB, link("c", heavy()), joint("j", "a", "b"), joint("k", "b", "c", "fixed", "<origin xyz='0 2 0'/>")]
    hanging = Arm.from_urdf(write(tmp_path, *parts))
    assert hanging.links[0].name == "b"
    np.testing.assert_allclose(hanging.links[0].com, [1, 2, 0])


def test_floating_and_planar_side_branches_stand_at_zero(tmp_path: Path) -> None:
    parts = [AB, link("c", heavy()), joint("j", "a", "b"), joint("k", "b", "c", "floating", "<origin xyz='0 3 0'/>")]
    arm = Arm.from_urdf(write(tmp_path, *parts), tip="b")
    np.testing.assert_allclose(arm.links[0].com, [1, 3, 0])


def test_mimic_follows_with_multiplier_and_offset(tmp_path: Path) -> None:
    def slide(name: str, child: str, extra: str = "") -> str:
        return joint(name, "b", child, "prismatic", f"<axis xyz='0 1 0'/><limit lower='-9' upper='9'/>{extra}")

    parts = [AB, link("c"), link("d", heavy()), joint("j", "a", "b"), slide("k", "c")]
    path = write(tmp_path, *parts, slide("m", "d", "<mimic joint='k' multiplier='-2' offset='0.5'/>"))
    np.testing.assert_allclose(Arm.from_urdf(path, tip="b").links[0].com, [1, 0.5, 0])
    np.testing.assert_allclose(Arm.from_urdf(path, tip="b", hold={"k": 1}).links[0].com, [1, -1.5, 0])
    np.testing.assert_allclose(Arm.from_urdf(path, tip="b", hold={"m": 4}).links[0].com, [1, 4, 0])


def test_faults_far_from_the_chain_do_no_harm(tmp_path: Path) -> None:
    """Big robots' files are often sloppy about wheels and fingers; an arm of theirs can still be used."""
    parts = [
        AB,
        link("w", heavy()),
        link("m"),
        J,
        joint("wheel", "b", "w", inside=""),
        joint("n", "a", "m", inside="<mimic joint='x'/>"),
    ]
    arm = Arm.from_urdf(write(tmp_path, *parts), tip="b")
    np.testing.assert_allclose(arm.links[0].com, [1, 0, 0])


@pytest.mark.parametrize(("lower", "upper", "stands_at"), [(1, 0, 0), (3, 1, 1), (-1, -3, -1)])
def test_reversed_limits_beside_the_chain_hold_the_joint_at_the_nearest_one(
    tmp_path: Path, lower: float, upper: float, stands_at: float
) -> None:
    slide = f"<axis xyz='0 1 0'/><limit lower='{lower}' upper='{upper}'/>"
    path = write(tmp_path, AB, link("w", heavy()), J, joint("finger", "b", "w", "prismatic", slide))
    np.testing.assert_allclose(Arm.from_urdf(path, tip="b").links[0].com, [1, stands_at, 0])
    np.testing.assert_allclose(Arm.from_urdf(path, tip="b", hold={"finger": lower}).links[0].com, [1, lower, 0])
    with pytest.raises(ArmError, match="limits of joint 'finger' are reversed"):
        Arm.from_urdf(path, tip="w")
    with pytest.raises(ArmError, match="within its limits"):
        Arm.from_urdf(path, tip="b", hold={"finger": 9.0})


def test_long_lists_are_cut(tmp_path: Path) -> None:
    many = [link(f"c{k}") + joint(f"k{k}", "b", f"c{k}") for k in range(70)]
    with pytest.raises(ArmError, match=r"the arm could end at 'c0', .* 'c59' and 10 more; name one with --tip \(tip= in"):
        Arm.from_urdf(write(tmp_path, AB, J, *many))


def test_the_only_end_is_found(tmp_path: Path) -> None:
    # A dead branch on the base does not count, and the fixed frame behind the last joint is the tip.
    parts = [AB, link("c"), link("stand"), joint("j", "a", "b"), joint("f", "b", "c", "fixed", "<origin xyz='0 0 4'/>")]
    arm = Arm.from_urdf(write(tmp_path, *parts, joint("s", "a", "stand", "fixed")))
    np.testing.assert_allclose(arm.tool[:3, 3], [0, 0, 4])


# ---- refusals ----------------------------------------------------------------------------------------------------

GRIPPER = AB + link("c") + link("d") + J + joint("k", "b", "c") + joint("l", "b", "d")
REFUSED = [
    ("", {}, "the robot has no <link>; it needs at least two links and a joint"),
    (
        AB + joint("j", "a", "x"),
        {},
        "joint 'j' names the child link 'x', which the file does not define; correct the name or add the link",
    ),
    (AB + joint("j", "x", "b"), {}, "joint 'j' names the parent link 'x', which the file does not define"),
    (AB + J + joint("k", "a", "b"), {}, "link 'b' is the child of both 'j' and 'k'; a tree gives each link one parent"),
    (AB + link("c") + J, {}, "the links 'a', 'c' have no parent; a tree has one root, so connect them with joints"),
    (AB + J + joint("k", "b", "a"), {}, "the links 'a', 'b' are joined in a loop; a URDF must be a tree"),
    (
        AB + J + link("c") + link("d") + joint("k", "c", "d") + joint("l", "d", "c"),
        {},
        "the links 'c', 'd' are joined in a loop; a URDF must be a tree",
    ),
    (AB + link("a") + J, {}, "the link name 'a' is used more than once; names must be unique"),
    (AB + link("c") + J + joint("j", "b", "c"), {}, "the joint name 'j' is used more than once; names must be unique"),
    ("<link/>", {}, "a <link> has no attribute 'name'; the format requires it"),
    (AB + "<joint name='j'/>", {}, "joint 'j' has no attribute 'type'; the format requires it"),
    (
        AB + joint("j", "a", "b", "ball"),
        {},
        "joint 'j' has type 'ball'; URDF knows revolute, continuous, prismatic, fixed, floating, planar",
    ),
    (AB + "<joint name='j' type='fixed'/>", {}, "joint 'j' has no <parent>; it needs <parent link=\"...\"/>"),
    (
        AB + "<joint name='j' type='fixed'><parent link='a'/><child/></joint>",
        {},
        "joint 'j': <child> has no attribute 'link'; the format requires it",
    ),
    (
        AB + joint("j", "a", "b", "continuous", "<axis xyz='0 0 0'/>"),
        {},
        "joint 'j' has the axis 0 0 0; give the direction about or along which it moves",
    ),
    (AB + joint("j", "a", "b", inside="<axis xyz='0 1'/>"), {}, "joint 'j': axis is '0 1'; it must be 3 finite numbers"),
    (AB + joint("j", "a", "b", inside="<axis/>"), {}, "joint 'j': <axis> has no attribute 'xyz'; the format requires it"),
    (
        AB + joint("j", "a", "b", "continuous", "<origin xyz='0 0 one'/>"),
        {},
        "joint 'j': origin xyz is '0 0 one'; it must be 3 finite numbers",
    ),
    (
        AB + joint("j", "a", "b", "fixed", "<origin rpy='0 0 nan'/>"),
        {},
        "joint 'j': origin rpy is '0 0 nan'; it must be 3 finite numbers",
    ),
    (
        AB + joint("j", "a", "b", inside="<limit lower='a' upper='1'/>"),
        {},
        "joint 'j': lower is 'a'; it must be a finite number",
    ),
    (
        AB + joint("j", "a", "b", inside="<limit lower='1' upper='-1'/>"),
        {},
        "limits of joint 'j' are reversed: lower 1 is above upper -1; swap them",
    ),
    (
        AB + joint("j", "a", "b", inside=""),
        {},
        "joint 'j' is revolute and has no <limit> with lower and upper; give them; "
        "if it has no limits, continuous is the right type",
    ),
    (
        AB + joint("j", "a", "b", "prismatic", ""),
        {},
        "joint 'j' is prismatic and has no <limit> with lower and upper; give them",
    ),
    (
        AB + joint("j", "a", "b", inside="<limit effort='3'/>"),
        {},
        "joint 'j' is revolute and has no <limit> with lower and upper; give them",
    ),
    (
        AB + joint("j", "a", "b", inside="<limit lower='0' upper='1' effort='-3'/>"),
        {},
        "joint 'j': effort is -3; it must be 0 or more",
    ),
    (
        AB + joint("j", "a", "b", "continuous", "<dynamics damping='-1'/>"),
        {},
        "joint 'j': damping is -1; it must be 0 or more",
    ),
    (
        AB + joint("j", "a", "b", "fixed"),
        {"tip": "b"},
        "no moving joint lies between 'a' and 'b'; choose a base and tip with joints in between that are not held",
    ),
    (
        AB + link("c") + joint("j", "a", "b", "fixed") + joint("k", "a", "c", "fixed"),
        {},
        "no moving joint hangs on 'a'; an arm needs at least one",
    ),
    (AB + J, {"tip": "a"}, "no moving joint lies between 'a' and 'a'; .*, such as the tip 'b'"),
    (AB + J, {"base": "x"}, "there is no base link 'x'; an arm could be mounted on 'a'"),
    (AB + J, {"tip": "x"}, "there is no tip link 'x'; the arm could end at 'b'"),
    (
        AB + J,
        {"base": "b", "tip": "a"},
        "tip link 'a' does not hang on base link 'b'; choose a base on the way from the root to the tip",
    ),
    (GRIPPER, {}, "the arm could end at 'c', 'd'; name one with --tip (tip= in Python)"),
    (
        AB + link("c") + link("d") + J + joint("k", "b", "c", "fixed") + joint("l", "b", "d", "fixed"),
        {},
        "the arm could end at 'c', 'd'; name one with --tip (tip= in Python)",
    ),
    (
        AB + joint("j", "a", "b", "floating"),
        {},
        "joint 'j' on the chain is floating; a serial arm needs revolute, continuous, prismatic",
    ),
    (
        AB + joint("j", "a", "b", "planar"),
        {},
        "joint 'j' on the chain is planar; a serial arm needs revolute, continuous, prismatic",
    ),
    (
        AB + link("c") + J + joint("k", "b", "c", "continuous", "<mimic joint='j'/>"),
        {"tip": "c"},
        "joint 'k' on the chain mimics 'j', so it is not a degree of freedom; "
        "choose a base and tip with independent joints in between",
    ),
    (
        AB + link("c") + J + joint("k", "b", "c", "continuous", "<mimic joint='j'/>"),
        {"tip": "b"},
        "joint 'k' mimics 'j', which moves on the chain, so it cannot be held still; "
        "choose another tip, or freeze it all the same: --hold k=0",
    ),
    (
        AB + link("c") + J + joint("k", "b", "c", "continuous", "<mimic joint='x'/>"),
        {"tip": "b"},
        "joint 'k' mimics 'x', which the file does not define; correct the name, or freeze the joint: --hold k=0",
    ),
    (
        AB + joint("j", "a", "b", "continuous", "<mimic joint='j' multiplier='two'/>"),
        {},
        "joint 'j': multiplier is 'two'; it must be a finite number",
    ),
    (
        AB
        + link("c")
        + link("d")
        + J
        + joint("k", "b", "c", "continuous", "<mimic joint='l'/>")
        + joint("l", "b", "d", "continuous", "<mimic joint='k'/>"),
        {"tip": "b"},
        "mimic each other in a circle; one of them must be independent",
    ),
    (
        GRIPPER,
        {"tip": "c", "hold": {"x": 0.0}},
        "hold names 'x', which is not a moving joint of this file; those are 'j', 'k', 'l'",
    ),
    (AB + J, {"hold": {"j": 0.0}}, "no moving joint lies between 'a' and 'b'; choose a base and tip with joints in between"),
    (
        GRIPPER,
        {"tip": "c", "hold": {"l": 2.0}},
        "hold puts joint 'l' at 2; it must be a finite number within its limits -1 to 1",
    ),
    (
        AB + link("c") + J + joint("k", "b", "c", "continuous"),
        {"tip": "b", "hold": {"k": np.inf}},
        "hold puts joint 'k' at inf; it must be a finite number within its limits -inf to inf",
    ),
    (
        GRIPPER,
        {"tip": "c", "hold": {"l": np.nan}},
        "hold puts joint 'l' at nan; it must be a finite number within its limits -1 to 1",
    ),
    (
        link("a") + link("b", "<inertial><inertia/></inertial>") + J,
        {},
        "link 'b': its <inertial> has no <mass>; it needs both",
    ),
    (
        link("a") + link("b", "<inertial><mass value='1'/></inertial>") + J,
        {},
        "link 'b': its <inertial> has no <inertia>; it needs both",
    ),
    (
        link("a") + link("b", heavy().replace("iyz='0'", "")) + J,
        {},
        "link 'b': <inertia> has no attribute 'iyz'; the format requires it",
    ),
    (link("a") + link("b", heavy("heavy")) + J, {}, "link 'b': mass is 'heavy'; it must be a finite number"),
    (link("a") + link("b", heavy("-1")) + J, {}, "link 'b': mass is -1 kg; it must be 0 or more"),
    (AB + J, {"gravity": (0, 1)}, "gravity must be 3 finite numbers"),
]


@pytest.mark.parametrize(("parts", "options", "sentence"), REFUSED, ids=[case[2][:60] for case in REFUSED])
def test_refusals(tmp_path: Path, parts: str, options: dict, sentence: str) -> None:
    with pytest.raises(ArmError) as caught:
        Arm.from_urdf(write(tmp_path, parts), **options)
    assert str(caught.value).startswith("bot.urdf: ")
    assert sentence in str(caught.value) or re.search(sentence, str(caught.value))


RAW = [
    (b"<robot", r"this is not valid XML \(.*line 1.*\); correct it there, or give another URDF file"),
    (b"", "this is not valid XML"),
    (b"<?xml version='1.0' encoding='klingon'?><robot/>", "this is not valid XML"),
    (b"<sdf/>", "the outermost element is <sdf>; a URDF file has <robot>"),
    (
        b"<robot xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:include filename='x'/></robot>",
        r"xacro macros that are not expanded \(<xacro:include>\); expand it first: xacro bot.urdf > bot.expanded.urdf",
    ),
    (b"<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name='&a;'/>", "the file has a DOCTYPE"),
    (b"<!DOCTYPE robot SYSTEM 'file:///etc/hostname'><robot/>", "the file has a DOCTYPE"),
]


@pytest.mark.parametrize(("content", "sentence"), RAW)
def test_broken_files(tmp_path: Path, content: bytes, sentence: str) -> None:
    path = tmp_path / "bot.urdf"
    path.write_bytes(content)
    with pytest.raises(ArmError, match=sentence):
        Arm.from_urdf(path)


def test_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(ArmError, match=r"none.urdf: the file cannot be read \(No such file or directory\); give the path"):
        Arm.from_urdf(tmp_path / "none.urdf")
    with pytest.raises(ArmError, match="the file cannot be read"):
        Arm.from_urdf(tmp_path)


def test_a_bomb_of_entities_does_not_go_off(tmp_path: Path) -> None:
    entities = "".join(f"<!ENTITY x{k + 1} '{f'&x{k};' * 10}'>" for k in range(12))
    path = tmp_path / "bot.urdf"
    path.write_text(f"<!DOCTYPE robot [<!ENTITY x0 'ha'>{entities}]><robot name='&x12;'/>")
    with pytest.raises(ArmError, match="DOCTYPE"):
        Arm.from_urdf(path)


# ---- what other readers take ---------------------------------------------------------------------------------------


def test_prefixes_need_no_declaration_and_leftover_definitions_do_no_harm(tmp_path: Path) -> None:
    """As in files that xacro and Gazebo leave behind; yourdfpy reads the same chain."""
    leftovers = (
        "<xacro:property name='width' value='${0.1 * 2}'/><xacro:arg name='x' default='1'/>"
        "<xacro:macro name='wheel' params='p'><link name='${p}'/></xacro:macro>"
        "<gazebo reference='b'><sensor:ray update='$(arg x)'/></gazebo>"
    )
    parts = AB + joint("j", "a", "b", inside="<origin xyz='0.3 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='1'/><ros:x/>")
    path = write(tmp_path, leftovers, parts)
    np.testing.assert_allclose(Arm.from_urdf(path).forward_kinematics([0.2])[:3, 3], [0.3, 0, 0])
    plain = tmp_path / "plain.urdf"
    plain.write_text(f"<robot name='bot'>{AB}{J}</robot>".replace("<axis", "<origin xyz='0.3 0 0'/><axis"))
    other = yourdfpy.URDF.load(str(plain), load_meshes=False, build_scene_graph=True)
    other.update_cfg({"j": 0.2})
    np.testing.assert_allclose(Arm.from_urdf(path).forward_kinematics([0.2]), other.get_transform("b", "a"), atol=1e-12)


def test_blanks_before_the_declaration_and_unexpanded_mesh_names_do_no_harm(tmp_path: Path) -> None:
    mesh = "<visual><geometry><mesh filename='file://$(find arm)/a.stl'/></geometry></visual>"
    plain, path = Arm.from_urdf(write(tmp_path, AB, J)), tmp_path / "bot.urdf"
    path.write_text(f"\n<?xml version='1.0'?><robot name='bot'>{link('a', mesh)}{link('b')}{J}</robot>")
    assert Arm.from_urdf(path).fingerprint == plain.fingerprint


@pytest.mark.parametrize("call", ["<xacro:arm name='x'/>", "<x:arm/>", "<link name='${side}_hand'/>"])
def test_macros_that_make_something_are_named_with_the_command_that_expands_them(tmp_path: Path, call: str) -> None:
    path = tmp_path / "bot.urdf.xacro"
    path.write_text(f"<robot name='b' xmlns:x='http://ros.org/wiki/xacro'>{AB}{J}{call}</robot>")
    with pytest.raises(ArmError, match=r"not expanded .*; expand it first: xacro bot.urdf.xacro > bot.urdf "):
        Arm.from_urdf(path)


def test_a_joint_that_mimics_a_fixed_one_stands_at_its_offset(tmp_path: Path) -> None:
    """Its value is multiplier times 0 plus offset, on the chain as beside it."""
    slide = "<axis xyz='0 1 0'/><limit lower='-9' upper='9'/>"
    parts = [AB, link("c"), link("d"), joint("f", "a", "b", "fixed")]
    parts.append(joint("m", "b", "c", "prismatic", f"{slide}<mimic joint='f' multiplier='-2' offset='0.5'/>"))
    arm = Arm.from_urdf(write(tmp_path, *parts, joint("j", "c", "d")))
    assert arm.joint_names == ("j",)
    np.testing.assert_allclose(arm.forward_kinematics([0.0])[:3, 3], [0, 0.5, 0])
    held = Arm.from_urdf(write(tmp_path, *parts, joint("j", "c", "d")), hold={"m": 2.0})
    np.testing.assert_allclose(held.forward_kinematics([0.0])[:3, 3], [0, 2, 0])


SIDE = """<robot name="side"><link name="trunk"/>
<joint name="bracket" type="fixed"><parent link="trunk"/><child link="s0"/><origin xyz="0 0.2 0.6" rpy="{rpy}"/></joint>
<link name="s0"/>{links}</robot>"""


def side_arm(folder: Path, rpy: str) -> Path:
    """A file whose arm hangs on a turned bracket."""
    links = ""
    for k, axis in enumerate(("0 0 1", "0 1 0", "1 0 0"), start=1):
        links += (
            f'<link name="s{k}"><inertial><origin xyz="0.01 0 0.08"/><mass value="{2 - 0.2 * k}"/>'
            '<inertia ixx="0.02" iyy="0.03" izz="0.015" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="j{k}" type="revolute"><parent link="s{k - 1}"/><child link="s{k}"/><origin xyz="0.05 0 0.2"/>'
            f'<axis xyz="{axis}"/><limit lower="-2" upper="2" velocity="2" effort="50"/></joint>'
        )
    file = folder / "side.urdf"
    file.write_text(SIDE.format(rpy=rpy, links=links), encoding="utf-8")
    return file


@pytest.mark.parametrize("rpy", ["0 0 0", "1.5707963267948966 0 0", "0.3 -1.1 2.5"])
def test_gravity_stays_that_of_the_root_whatever_the_base(tmp_path: Path, rng: np.random.Generator, rpy: str) -> None:
    """Pinocchio computes the gravity torques of the whole file."""
    pinocchio = pytest.importorskip("pinocchio")
    file = side_arm(tmp_path, rpy)
    model = pinocchio.buildModelFromUrdf(str(file))
    q = rng.uniform(-2, 2, 3)
    expected = pinocchio.computeGeneralizedGravity(model, model.createData(), q)
    for base in (None, "s0"):
        assert Arm.from_urdf(file, base=base).gravity_torque(q) == pytest.approx(expected, abs=1e-12)
    given = Arm.from_urdf(file, base="s0", gravity=(0, 0, -1.62))
    assert given.gravity.tolist() == [0, 0, -1.62]


def test_all_rods_beside_the_chain_are_named_at_once_with_what_to_type(tmp_path: Path) -> None:
    rods = J + "".join(
        link(name) + joint(f"{name}_pin", "b", name, "continuous", "<mimic joint='j' multiplier='-0.4'/>") for name in "rs"
    )
    file = write(tmp_path, AB + rods)
    with pytest.raises(
        ArmError, match=r"joint 'r_pin' mimics 'j', joint 's_pin' mimics 'j', .*: --hold r_pin=0 --hold s_pin=0 "
    ):
        Arm.from_urdf(file, tip="b")
    assert Arm.from_urdf(file, tip="b", hold={"r_pin": 0.0, "s_pin": 0.0}).n == 1


def test_a_floating_base_names_the_link_to_mount_the_arm_on(tmp_path: Path) -> None:
    file = write(tmp_path, AB + link("map") + joint("afloat", "map", "a", "floating") + J)
    with pytest.raises(ArmError, match=r"joint 'afloat' on the chain is floating; .*: --base a$"):
        Arm.from_urdf(file)
    assert Arm.from_urdf(file, base="a").n == 1
