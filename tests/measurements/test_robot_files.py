"""Files that are found, expanded, opened as their messages say, and compared; a wrong answer must not pass as equal."""

from dataclasses import replace

import gymnasium_robotics
import numpy as np
import pytest
from measurements.robot_files import compare, files, oracles
from measurements.robot_files.__main__ import write_files, write_results

JOINT = (
    "<joint name='j{k}' type='{type}'><parent link='l{k}'/><child link='l{n}'/>"
    "<origin xyz='0.1 0.2 0.3' rpy='0.4 1.570796327 0.1'/>"
    "<axis xyz='0 0.6 0.8'/><limit lower='-1' upper='2' effort='9' velocity='3'/></joint>"
)
LINK = (
    "<link name='l{k}'><inertial><origin xyz='0.1 0 0.2'/><mass value='1.{k}'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
)
MIMIC = (
    LINK.format(k=7) + "<joint name='m' type='prismatic'><parent link='l2'/><child link='l7'/><axis xyz='1 0 0'/>"
    "<limit lower='0.2' upper='1' effort='1' velocity='1'/><mimic joint='s' multiplier='-2' offset='0.3'/></joint>"
    + LINK.format(k=8)
    + "<joint name='s' type='prismatic'><parent link='l2'/><child link='l8'/><axis xyz='0 1 0'/>"
    "<limit lower='0.1' upper='1' effort='1' velocity='1'/></joint>"
)


def serial(types=("revolute", "prismatic", "continuous"), more=""):
    links = "".join(LINK.format(k=k) for k in range(len(types) + 1))
    joints = "".join(JOINT.format(k=k, n=k + 1, type=kind) for k, kind in enumerate(types))
    return f"<robot name='abb of ours'>{links}{joints}{more}</robot>"


@pytest.fixture
def folder(tmp_path):
    place = tmp_path / "robots" / "someone+arms"
    (place / "parts").mkdir(parents=True)
    (place / "LICENSE").write_text("MIT License\n\nPermission is hereby granted")
    (place / "package.xml").write_text("<package><name>arms</name></package>")
    (place / "a.urdf").write_text(serial())
    (place / "again.urdf").write_text(serial().replace("><", ">\n<"))
    (place / "hand.urdf").write_text(serial(more=MIMIC))
    (place / "floating.urdf").write_text(serial(("floating", *["revolute"] * 3)))
    (place / "prop.urdf").write_text(serial(["revolute"]))
    (place / "bad.urdf").write_text(serial(more="<joint name='x' type='screw'/>"))
    macro = "<xacro:macro name='arm'>" + serial(["revolute"] * 4).partition(">")[2].replace("</robot>", "</xacro:macro>")
    (place / "parts" / "arm.xacro").write_text(f"<robot xmlns:xacro='http://ros.org/wiki/xacro'>{macro}</robot>")
    top = "<xacro:include filename='$(find arms)/parts/arm.xacro'/><xacro:arm/>"
    (place / "b.urdf.xacro").write_text(f"<robot name='b' xmlns:xacro='http://ros.org/wiki/xacro'>{top}</robot>")
    return tmp_path / "robots"


def test_a_folder_becomes_a_table_in_which_every_file_is_equal_or_has_a_sentence(folder, tmp_path):
    pytest.importorskip("xacro")
    found = list(files.find_robot_files(folder, tmp_path / "expanded"))
    names = [file.label.rpartition("/")[2] for file in found]
    assert names == ["a.urdf", "b.urdf.xacro", "bad.urdf", "floating.urdf", "hand.urdf"]
    assert {file.licence for file in found} == {"MIT"}
    assert found[0].maker == "ABB"
    outcomes = {name: compare.examine(file) for name, file in zip(names, found, strict=True)}
    assert {name: outcome.state for name, outcome in outcomes.items()} == {
        **dict.fromkeys(names, "equal"),
        "bad.urdf": "sentence",
    }
    assert "screw" in outcomes["bad.urdf"].sentences[-1]
    assert [c.joints for c in outcomes["floating.urdf"].comparisons] == [3]  # behind the base that the message names
    assert "--base l1" in outcomes["floating.urdf"].sentences[0]
    assert {comparison.tip for comparison in outcomes["hand.urdf"].comparisons} == {"l3"}  # not the coupled fingers
    assert any("mimics" in sentence for sentence in outcomes["hand.urdf"].sentences)
    text = write_results(list(outcomes.values()), {"someone/arms": "abc 2026-01-01"})
    assert "**4 of 5 files** open" in text
    assert "| someone/arms | abc 2026-01-01 | MIT | 5 | 4 |" in text
    row = "| someone/arms/bad.urdf | ABB |  |  |  |  | bad.urdf: joint 'x' has type 'screw'"
    assert row in write_files(list(outcomes.values()))


@pytest.mark.parametrize("part", ["poses", "jacobians", "torques"])
def test_a_difference_is_seen(folder, tmp_path, monkeypatch, part):
    def wrong(*arguments, **options):
        answers = oracles.answer_with_pinocchio(*arguments, **options)
        return replace(answers, **{part: getattr(answers, part) + 1e-7})

    monkeypatch.setattr(compare, "answer_with_pinocchio", wrong)
    file = next(files.find_robot_files(folder, tmp_path / "expanded"))
    assert compare.examine(file).state == "different"


def test_angles_near_a_quarter_turn_are_told_apart_from_errors(folder, tmp_path):
    (folder / "someone+arms" / "a.urdf").write_text(serial(["revolute"] * 9).replace("1.570796327", "1.5707963277"))
    file = next(files.find_robot_files(folder, tmp_path / "expanded"))
    (comparison,) = compare.examine(file).comparisons
    assert comparison.rounded
    assert comparison.is_equal


def test_the_fetch_arm_of_gymnasium_robotics_equals_mujoco():
    assets = files.Path(gymnasium_robotics.__file__).parent / "envs" / "assets"
    path = assets / "fetch" / "reach.xml"
    file = files.RobotFile("fetch/reach.xml", path, "mjcf", files.name_maker("fetch"), files.find_licence(path, assets))
    outcome = compare.examine(file)
    assert outcome.state == "equal"
    assert max(comparison.joints for comparison in outcome.comparisons) >= 7
    assert np.isfinite([comparison.torque for comparison in outcome.comparisons]).all()
