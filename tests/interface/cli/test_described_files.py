"""Arms from xacro files and from the package robot_descriptions."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.model.arms import robot_descriptions

LINK = (
    '<xacro:macro name="rod" params="name parent length"><link name="${name}"><visual><geometry>'
    '<mesh filename="package://parts/meshes/rod.stl"/></geometry></visual></link>'
    '<joint name="j_${name}" type="continuous"><parent link="${parent}"/><child link="${name}"/>'
    '<origin xyz="${length} 0 0"/><axis xyz="0 0 1"/></joint></xacro:macro>'
)
ARM = (
    '<robot name="made" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="length" default="0.5"/>'
    '<xacro:include filename="$(find parts)/rod.xacro"/><link name="base"/>'
    '<xacro:rod name="upper" parent="base" length="$(arg length)"/>'
    '<xacro:rod name="fore" parent="upper" length="0.25"/></robot>'
)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Packages ``arm`` with the robot and ``parts`` with a macro and a mesh, in one folder."""
    for package in ("arm", "parts"):
        (tmp_path / package / "meshes").mkdir(parents=True)
        (tmp_path / package / "package.xml").write_text(f"<package><name>{package}</name></package>")
    (tmp_path / "parts" / "rod.xacro").write_text(f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro">{LINK}</robot>')
    (tmp_path / "parts" / "meshes" / "rod.stl").write_bytes(b"")
    (tmp_path / "arm" / "arm.urdf.xacro").write_text(ARM)
    return tmp_path


def test_a_xacro_file_is_expanded_with_its_arguments_and_packages(workspace, ask):
    file = workspace / "arm" / "arm.urdf.xacro"
    for length, arm in ((0.5, hf.arms.load(file)), (2.0, hf.arms.load(file, xacro={"length": "2"}))):
        assert (arm.joint_names, arm.source, arm.name) == (("j_upper", "j_fore"), "arm.urdf.xacro", "made")
        np.testing.assert_allclose(
            arm.forward_kinematics([0.3, 0.2])[:3, 3], [length + 0.25 * np.cos(0.3), 0.25 * np.sin(0.3), 0]
        )
        assert str(workspace / "parts" / "meshes" / "rod.stl") in Path(arm.chain.file).read_text()
    assert len(ask("describe", str(file), "--xacro", "length=2")["joints"]) == 2


def test_a_package_elsewhere_is_named_or_missing(workspace, tmp_path_factory):
    far = tmp_path_factory.mktemp("far")
    file = far / "arm.xacro"
    file.write_text(ARM)
    with pytest.raises(hf.ArmError, match=r"arm.xacro: it needs the ROS package 'parts', which is in no"):
        hf.arms.load(file)
    assert hf.arms.load(file, packages=workspace).n == 2


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("<robot name='a' xmlns:xacro='x'>${1/0}</robot>", "xacro cannot expand this (division by zero"),
        ("<robot name='a' xmlns:xacro='x'><xacro:nothing/></robot>", "xacro cannot expand this (unknown macro name"),
        ("<robot name='a' xmlns:xacro='x'>$(arg side)</robot>", "give its arguments with xacro (--xacro NAME=VALUE)"),
        ("<robot name='a' xmlns:xacro='x'>${__import__('os').getcwd()}</robot>", "xacro cannot expand this ("),
        ("<robot", "xacro cannot expand this ("),
        ("<robot name='a' xmlns:xacro='x'/>", "the robot has no <link>"),
    ],
)
def test_a_broken_xacro_file_gets_one_sentence(tmp_path, text, sentence):
    file = tmp_path / "bad.xacro"
    file.write_text(text)
    with pytest.raises(hf.ArmError) as caught:
        hf.arms.load(file)
    assert str(caught.value).startswith("bad.xacro: ")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


# ---- robot_descriptions, with a package of the same form in its place ------------------------------------------------


@pytest.fixture
def descriptions(workspace, tmp_path_factory, monkeypatch):
    folder = tmp_path_factory.mktemp("site")
    package = folder / "robot_descriptions"
    package.mkdir()
    urdf, mjcf = workspace / "two.urdf", workspace / "two.xml"
    hf.arms.load("planar-2r").save(urdf)
    hf.arms.load("planar-3r").save(workspace / "three.urdf")
    mjcf.write_text(hf.arms.load("planar-2r").to_mujoco().to_xml())
    srdf = workspace / "states.srdf"
    srdf.write_text(
        '<robot name="two"><group_state name="up" group="arm"><joint name="joint1" value="1"/><joint name="joint2" value="2"/>'
        "</group_state></robot>"
    )
    modules = {
        "__init__": "",
        "two_description": f"print('cloning')\nURDF_PATH = {str(urdf)!r}\nSRDF_PATH = {str(srdf)!r}\n"
        f"URDF_PATH_THREE = {str(workspace / 'three.urdf')!r}",
        "both_mj_description": f"MJCF_PATH = {str(mjcf)!r}",
        "made_description": f"XACRO_PATH = {str(workspace / 'arm' / 'arm.urdf.xacro')!r}\nXACRO_ARGS = {{'length': '3'}}",
        "far_description": "raise OSError('Could not resolve host')",
    }
    for name, text in modules.items():
        (package / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(str(folder))
    for name in [name for name in sys.modules if name.partition(".")[0] == "robot_descriptions"]:
        monkeypatch.delitem(sys.modules, name)
    yield package
    for name in [name for name in sys.modules if name.partition(".")[0] == "robot_descriptions"]:
        del sys.modules[name]


def test_robots_of_robot_descriptions(descriptions, capsys, ask):
    arm = hf.arms.load("two_description")
    assert (arm.n, arm.source) == (2, "two_description")
    assert capsys.readouterr() == ("", "cloning\n")  # an answer in JSON stays one
    np.testing.assert_array_equal(arm.states["up"], [1, 2])
    assert hf.arms.load("robot_descriptions:two_description.three").n == 3
    assert hf.arms.load("both_mj_description", tip="tool").n == 2
    assert hf.arms.load("made_description").forward_kinematics([0, 0])[0, 3] == 3.25
    assert hf.arms.load("made_description", xacro={"length": "1"}).forward_kinematics([0, 0])[0, 3] == 1.25
    assert ask("describe", "two_description")["name"] == "planar-2r"


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("twoo_description", "robot_descriptions has no 'twoo_description'; did you mean 'two_description'?"),
        ("q_description", "give one of its 4 names, or a file"),
        ("robot_descriptions:two_description.four", "has no variant 'four' of 'two_description'; its variants are three"),
        ("robot_descriptions:both_mj_description.x", "no variant 'x' of 'both_mj_description'; its variants are none"),
        ("far_description", "cannot provide 'far_description' (Could not resolve host); it clones a repository when"),
        ("two", "robot_descriptions has 'two_description', which it clones when first used; "),
    ],
)
def test_a_description_that_cannot_be_had_gets_one_sentence(descriptions, name, sentence):
    with pytest.raises(hf.ArmError) as caught:
        hf.arms.load(name)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_nothing_is_imported_for_a_name_that_is_no_description(descriptions):
    with pytest.raises(hf.ArmError):
        hf.arms.load("far")
    assert not robot_descriptions.is_description("far")
    assert "robot_descriptions.far_description" not in sys.modules
