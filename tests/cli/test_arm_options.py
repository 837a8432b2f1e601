"""Which part of a file the arm is: every answer says it, and each of several arms has its own."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import yourdfpy

import holdfast as hf
from holdfast.arm.builtin import DATA
from holdfast.written import ArmSpec, each_arm

IIWA, PANDA = str(DATA.joinpath("iiwa14.urdf")), str(DATA.joinpath("panda.urdf"))
Q7 = "0.1 0.5 -0.2 -1.1 0.4 1.2 0.3"


@pytest.mark.parametrize(
    "command",
    [
        ("describe",),
        ("index", "--q", Q7, "--task", "position"),
        ("susceptibility", "--q", Q7),
        ("configure", "--at", Q7, "--task", "position", "--maximise", "manipulability", "--starts", 2, "--no-clearance"),
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
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "panda.urdf; base &#39;panda_link0&#39;, tip &#39;panda_link8&#39;, &#39;panda_joint1&#39; held at 0.5" in page
    command = " ".join(page.split("holdfast assess ")[1].split("<")[0].replace("\\\n", " ").split())
    assert command.startswith("panda.urdf --base panda_link0 --tip panda_link8 --hold panda_joint1=0.5 ")
    again = hf.load(tmp_path / "run").arm
    assert again.chain == hf.arm.Chain("panda_link0", "panda_link8", (("panda_joint1", 0.5),))


def test_a_held_axis_stands_where_it_was_put(ask):
    """Oracle: yourdfpy with all seven joints of the file, the first one at the value held."""
    arm = hf.arms.resolve(PANDA, tip="panda_link8", hold={"panda_joint1": 0.5})
    q = np.array([-0.4, 0.2, -1.9, 0.3, 1.5, 0.8])
    other = yourdfpy.URDF.load(PANDA, load_meshes=False, build_scene_graph=True)
    other.update_cfg({"panda_joint1": 0.5, **dict(zip(arm.joint_names, q, strict=True))})
    np.testing.assert_allclose(arm.forward_kinematics(q), other.get_transform("panda_link8", "panda_link0"), atol=1e-12)
    answer = ask("describe", PANDA, "--tip", "panda_link8", "--hold", "panda_joint1=0.5")
    assert (len(answer["joints"]), answer["held"]) == (6, {"panda_joint1": 0.5})


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("panda", "--hold", "panda_joint1=0"), "'panda' is not a URDF or MJCF file, so it has no links or joints to choose"),
        ((PANDA, "--hold", "elbow=0"), "hold names 'elbow', which is no moving joint of this file; those are 'panda_joint1', "),
        ((PANDA, "--hold", "elbow"), "--hold 'elbow' is not joint=number; write for example --hold finger_joint1=0.04"),
        ((PANDA, "--hold", "a=1", "--hold", "a=2"), "--hold gives joint 'a' twice; give each joint once"),
        ((PANDA, "--hold", "panda_joint1=9"), "hold puts joint 'panda_joint1' at 9; it must be a finite number within"),
        ((PANDA, "--tip", "panda_lnk8"), "there is no tip link 'panda_lnk8'; did you mean 'panda_link8'? the arm could end at"),
        ((PANDA, "--base", "x"), "there is no base link 'x'; an arm could stand on 'panda_link0', 'panda_link1', "),
        (
            (PANDA, "--base", "panda_hand", "--tip", "panda_link3"),
            "choose a base on the way from the root to the tip, which is 'panda_link0', 'panda_link1', 'panda_link2'",
        ),
        (("robot.urdf.xacro",), "'robot.urdf.xacro' is a xacro file; expand it first: xacro robot.urdf.xacro > robot.urdf"),
    ],
)
def test_refusals_say_what_there_is(cli, arguments, sentence):
    code, out, err = cli("describe", *arguments)
    assert (code, out) == (2, "")
    assert sentence in err


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
    assert each_arm(["a", "b"], ["x"], None, None, None) == [ArmSpec("a", "x"), ArmSpec("b", "x")]
    assert each_arm(["a"], None, None, ["i=1", "j=2,k=3"], ["n"]) == [ArmSpec("a", None, None, {"i": 1, "j": 2, "k": 3}, "n")]
    with pytest.raises(
        hf.InputError, match="--tip is given 3 times and there are 2 arms; give it once for all, or once for each"
    ):
        each_arm(["a", "b"], None, ["x", "y", "z"], None, None)
    with pytest.raises(hf.InputError, match="--name is given 1 times and there are 2 arms; give it once for each"):
        each_arm(["a", "b"], None, None, None, ["x"])


def test_a_study_keeps_what_was_chosen_of_each_file(cli, tmp_path):
    file = tmp_path / "study.yaml"
    ends = ["--tip", "panda_link8", "--tip", "-"]
    options = [*ends, "--hold", "panda_finger_joint1=0.04", "--hold", "-", "--name", "cut", "--name", "-"]
    code, _, err = cli("study", "new", file, "--arm", PANDA, "--arm", "iiwa14", *options, "--poses", 10, "--chunk", 10)
    assert code == 0, err
    assert "tip: panda_link8" in file.read_text()
    from holdfast.studies.study_file import read

    cut, whole = read(file).cells
    assert cut.labels["arm"] == "cut"
    assert cut.plan["arm"]["chain"] == ["panda_link0", "panda_link8", {"panda_finger_joint1": 0.04}]
    assert whole.labels["arm"] == "iiwa14"
    assert json.dumps(cut.plan["arm"])
