"""Which part of a file the arm is: every answer says it, and each of several arms has its own."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

import numpy as np
import pytest
import yourdfpy

import holdfast as hf
from holdfast.model.arms.builtin import DATA_FOLDER
from holdfast.model.arms.spec import ArmSpec, arm_specs_from_options

IIWA, PANDA = str(DATA_FOLDER.joinpath("iiwa14.urdf")), str(DATA_FOLDER.joinpath("panda.urdf"))
Q7 = "0.1 0.5 -0.2 -1.1 0.4 1.2 0.3"


@pytest.mark.parametrize(
    "command",
    [
        ("describe",),
        ("index", "--q", Q7, "--task", "position"),
        ("susceptibility", "--q", Q7),
        ("optimise", "--at", Q7, "--task", "position", "--maximise", "manipulability", "--starts", 2, "--no-clearance"),
        ("recover", "--lock", 2, "--at", Q7, "--goal", "q:" + Q7.replace("0.3", "0.31"), "--samples", 0, "--task", "position"),
    ],
    ids=lambda command: command[0],
)
def test_answers_say_base_and_tip(cli, ask, command):
    line = (command[0], IIWA, *command[1:], "--tip", "lbr_iiwa_link_6") if command[0] == "describe" else command
    line = line if command[0] == "describe" else (command[0], IIWA, *command[1:])
    tip = "lbr_iiwa_link_6" if command[0] == "describe" else "lbr_iiwa_link_7"
    code, out, err = cli(*line)
    assert code == 0, err
    assert f"(base 'lbr_iiwa_link_0', tip '{tip}')" in out
    answer = ask(*line)
    assert (answer["base"], answer["tip"], answer["held"]) == ("lbr_iiwa_link_0", tip, {})


def test_reports_say_base_and_tip_and_the_command_that_makes_them_again(cli, tmp_path):
    options = ["--tip", "panda_link8", "--hold", "panda_joint1=0.5", "--task", "position"]
    code, _, err = cli("assess", PANDA, *options, "--poses", 20, "--out", tmp_path / "run")
    assert code == 0, err
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8").replace("<wbr>", "")
    assert "panda.urdf; base &#39;panda_link0&#39;, tip &#39;panda_link8&#39;, &#39;panda_joint1&#39; held at 0.5" in page
    command = " ".join(page.split("holdfast assess ")[1].split("<")[0].replace("\\\n", " ").split())
    assert command.startswith("panda.urdf --base panda_link0 --tip panda_link8 --hold panda_joint1=0.5 ")
    again = hf.load(tmp_path / "run").arm
    assert again.chain == hf.model.arm.Chain("panda_link0", "panda_link8", (("panda_joint1", 0.5),))


def test_a_held_axis_stands_where_it_was_put(ask):
    """Oracle: yourdfpy with all seven joints of the file, the first one at the value held."""
    arm = hf.arms.load(PANDA, tip="panda_link8", hold={"panda_joint1": 0.5})
    q = np.array([-0.4, 0.2, -1.9, 0.3, 1.5, 0.8])
    other = yourdfpy.URDF.load(PANDA, load_meshes=False, build_scene_graph=True)
    other.update_cfg({"panda_joint1": 0.5, **dict(zip(arm.joint_names, q, strict=True))})
    np.testing.assert_allclose(arm.forward_kinematics(q), other.get_transform("panda_link8", "panda_link0"), atol=1e-12)
    answer = ask("describe", PANDA, "--tip", "panda_link8", "--hold", "panda_joint1=0.5")
    assert (len(answer["joints"]), answer["held"]) == (6, {"panda_joint1": 0.5})


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("panda", "--hold", "panda_joint1=0"), "hold cannot be chosen for 'panda', which is a built-in arm; leave it out"),
        (
            (PANDA, "--hold", "elbow=0"),
            "hold names 'elbow', which is not a moving joint of this file; those are 'panda_joint1', ",
        ),
        ((PANDA, "--hold", "elbow"), "--hold 'elbow' is not joint=number; write for example --hold finger_joint1=0.04"),
        ((PANDA, "--hold", "a=1", "--hold", "a=2"), "--hold gives joint 'a' twice; give each joint once"),
        ((PANDA, "--hold", "panda_joint1=9"), "hold puts joint 'panda_joint1' at 9; it must be a finite number within"),
        ((PANDA, "--tip", "panda_lnk8"), "there is no tip link 'panda_lnk8'; did you mean 'panda_link8'? the arm could end at"),
        ((PANDA, "--base", "x"), "there is no base link 'x'; an arm could be mounted on 'panda_link0', 'panda_link1', "),
        (
            (PANDA, "--base", "panda_hand", "--tip", "panda_link3"),
            "choose a base on the way from the root to the tip, which is 'panda_link0', 'panda_link1', 'panda_link2'",
        ),
        (("robot.urdf.xacro",), "robot.urdf.xacro: the file cannot be read (no such file); give the path of a xacro file"),
        ((PANDA, "--xacro", "a"), "--xacro 'a' is not NAME=VALUE; write for example --xacro ur_type=ur5e"),
        ((PANDA, "--xacro", "a=b"), "xacro cannot be chosen for "),
        ((PANDA, "--group", "arm"), "there is no group 'arm'; its groups are none"),
    ],
)
def test_refusals_say_what_there_is(cli, arguments, sentence):
    code, out, err = cli("describe", *arguments)
    assert (code, out) == (2, "")
    assert sentence in err


def test_a_file_with_several_ends_is_refused_with_a_command_that_works(cli, tmp_path):
    """The gripper's base, not the finger that a mimic makes doubtful nor the camera, though the finger is farther off."""
    links = "".join(f'<link name="{x}"/>' for x in ("base", "arm", "camera", "gripper_base", "gripper_rod"))
    moving = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'
    joints = (
        f'<joint name="turn" type="revolute">{moving}<parent link="base"/><child link="arm"/></joint>'
        '<joint name="eye" type="fixed"><parent link="arm"/><child link="camera"/></joint>'
        '<joint name="hand" type="fixed"><parent link="arm"/><child link="gripper_base"/></joint>'
        f'<joint name="gripper_rod" type="revolute">{moving}<parent link="gripper_base"/><child link="gripper_rod"/></joint>'
    )
    file = tmp_path / "my robot.urdf"
    file.write_text(f'<robot name="r">{links}{joints}</robot>')
    code, out, err = cli("describe", file, "--json")
    assert (code, out) == (2, "")
    command = err.split(", for example: holdfast ")[1]
    assert shlex.split(command)[2:4] == ["--tip", "gripper_base"]
    assert cli(*shlex.split(command))[0] == 0
    assert "for example" not in cli("assess", file, file)[2]  # one tip would not do for two


def test_each_of_several_arms_has_its_own_ends_and_name(ask, tmp_path):
    data = ask(
        *("assess", IIWA, PANDA, "panda", "--tip", "lbr_iiwa_link_6", "--tip", "panda_link8", "--tip", "-"),
        *("--hold", "-", "--hold", "panda_joint7=0.1", "--hold", "-", "--name", "kuka", "--name", "franka", "--name", "-"),
        *("--poses", 10, "--task", "position", "--region", _region(tmp_path)),
    )
    assert [(c["name"], c["arm"], c["tip"], c["held"]) for c in data["candidates"]] == [
        ("kuka", "kuka", "lbr_iiwa_link_6", {}),
        ("franka", "franka", "panda_link8", {"panda_joint7": 0.1}),
        ("panda", "panda", "panda_hand_tcp", {}),
    ]


def _region(tmp_path: Path) -> Path:
    file = tmp_path / "region.yaml"
    file.write_text("box: {center: [0.4, 0, 0.5], size: 0.1}\n")
    return file


def test_once_for_all_or_once_for_each():
    assert arm_specs_from_options(["a", "b"], ["x"], None, None, None) == [ArmSpec("a", "x"), ArmSpec("b", "x")]
    assert arm_specs_from_options(["a"], None, None, ["i=1", "j=2,k=3"], ["n"]) == [
        ArmSpec("a", None, None, {"i": 1, "j": 2, "k": 3}, "n")
    ]
    with pytest.raises(
        hf.InputError, match="--tip is given 3 times and there are 2 arms; give it once for all, or once for each"
    ):
        arm_specs_from_options(["a", "b"], None, ["x", "y", "z"], None, None)
    with pytest.raises(hf.InputError, match="--name is given 1 times and there are 2 arms; give it once for each"):
        arm_specs_from_options(["a", "b"], None, None, None, ["x"])


def test_a_study_keeps_what_was_chosen_of_each_file(cli, tmp_path):
    file = tmp_path / "study.yaml"
    ends = ["--tip", "panda_link8", "--tip", "-"]
    options = [*ends, "--hold", "panda_finger_joint1=0.04", "--hold", "-", "--name", "cut", "--name", "-"]
    code, _, err = cli("study", "new", file, "--arm", PANDA, "--arm", "iiwa14", *options, "--poses", 10, "--chunk", 10)
    assert code == 0, err
    assert "tip: panda_link8" in file.read_text()
    from holdfast.studies.study_files.study_file import read_study_file

    cut, whole = read_study_file(file).cells
    assert cut.labels["arm"] == "cut"
    assert cut.plan["arm"]["chain"] == ["panda_link0", "panda_link8", {"panda_finger_joint1": 0.04}]
    assert whole.labels["arm"] == "iiwa14"
    assert json.dumps(cut.plan["arm"])


# ---- units ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ("index", "panda", "--q", "0 -45 0 -135 0 90 45"),
            "--q: joint 'panda_joint2' is at -45 rad, far beyond its limits, -1.763 to 1.763 rad; give radians, or degrees "
            "with --degrees",
        ),
        (("index", "panda", "--q", "0 -1000 0 0 0 0 0", "--degrees"), "--q: joint 'panda_joint2' is at -1000 deg, far beyond"),
        (
            ("index", "ur5-rail", "--q", "1000 0 0 0 0 0 0"),
            "--q: joint 'rail' is at 1000 m, far beyond its limits, 0 to 2 m;",
        ),
        (
            ("index", "kinova-j2s6s200", "--q", "275 3 3 240 85 75", "--task", "position"),
            "joint 'j2s6s200_joint_1' is at 275 rad, far beyond a turn; give radians, or degrees with --degrees",
        ),
        (
            ("simulate", "panda", "--start", Q7, "--target", "500,0,400", "--task", "position"),
            "--target: a position is 640.3 m from the base of 'panda', which is at most 1.423 m long; give metres",
        ),
        (
            ("basins", "planar-3r", "--target", "1.5,1.5", "--lock", "1=100"),
            "--lock: joint 'joint1' is at 100 rad, far beyond its limits, -3.142 to 3.142 rad; give radians, or degrees with "
            "--degrees",
        ),
        (
            ("stationary-points", "planar-3r", "--target", "1.5,1.5", "--lock", "3", "--lock", "2=5000", "--degrees"),
            "--lock: joint 'joint2' is at 5000 deg, far beyond",
        ),
        (("recover", "panda", "--lock", "4=-120", "--at", Q7), "--lock: joint 'panda_joint4' is at -120 rad, far beyond"),
        (
            ("optimise", "panda", "--pose", "500,0,400,0,0,0", "--minimise", "torque"),
            "--pose: a position is 640.3 m from the base",
        ),
        (("self-motion", "planar-3r", "--target", "nan,0.2"), "--target contains NaN or infinity;"),
        (
            ("stationary-points", "planar-3r", "--target", "inf,1", "--lock", "2"),
            "--target contains NaN or infinity; give finite numbers",
        ),
    ],
)
def test_the_wrong_unit_is_named_with_its_option(cli, arguments, sentence):
    code, out, err = cli(*arguments)
    assert (code, out) == (2, "")
    assert sentence in err


def test_a_turn_too_many_is_no_wrong_unit(ask):
    """An angle and the same a turn further on mean one configuration."""
    near, far = (ask("index", "planar-3r", "--q", f"0.3 0.4 {x}") for x in (0.5, 0.5 - 2 * np.pi))
    assert near["value"] == pytest.approx(far["value"], rel=1e-9)


# ---- home ----------------------------------------------------------------------------------------------------------

SRDF = """<robot name="x" xmlns:moveit="urn:x"><group_state name="home" group="arm">{home}</group_state>
<group_state name="half" group="arm"><joint name="a1" value="1"/></group_state>
<group_state name="ready" group="arm">{ready}</group_state></robot>"""


def crane(tmp_path: Path, lower: float = -2.0) -> Path:
    parts = ["<link name='l0'/>"]
    for k in range(1, 4):
        parts.append(f"<link name='l{k}'/><joint name='a{k}' type='revolute'><parent link='l{k - 1}'/><child link='l{k}'/>")
        parts.append(
            f"<origin xyz='1 0 0'/><axis xyz='0 0 1'/><limit lower='{lower}' upper='2' velocity='1' effort='1'/></joint>"
        )
    file = tmp_path / "crane.urdf"
    file.write_text(f"<robot name='crane'>{''.join(parts)}</robot>")
    return file


def test_home_is_a_named_state_or_zero_where_limits_allow_and_is_said(ask, cli, tmp_path):
    at = ("recover", crane(tmp_path), "--lock", "2", "--at", "0.2 0 0.4", "--samples", "0", "--task", "planar")
    assert ask(*at)["goal"] == "the end effector's pose at all joints at 0"
    limited = crane(tmp_path, lower=0.1)
    assert ask(at[0], limited, *at[2:5], "0.2 0.1 0.4", *at[6:])["goal"].endswith(
        "at all joints at 0, a1, a2, a3 at the limit nearest to it"
    )
    crane(tmp_path)
    values = {"home": (0.1, 0, 0.3), "ready": (0.3, 0, 0.3)}
    texts = {name: "".join(f"<joint name='a{k + 1}' value='{x}'/>" for k, x in enumerate(q)) for name, q in values.items()}
    (tmp_path / "crane.srdf").write_text(SRDF.format(**texts))
    assert ask(*at)["goal"] == "the end effector's pose at home"
    assert ask(*at, "--goal", "ready")["goal"] == "the end effector's pose at ready"
    code, _, err = cli(*at, "--goal", "half")
    assert code == 2
    assert "--goal 'half' is not known; write home, ready, 'q:...' with 3 joint values, or 'pose:...'" in err
    arm = hf.arms.load(str(at[1]))
    np.testing.assert_array_equal(arm.states["home"], [0.1, 0, 0.3])
    np.testing.assert_array_equal(hf.arms.load("panda").states["home"], hf.arms.about("panda").home)
