"""``holdfast optimise``: the library's optimum, and objectives as text."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast import susceptibility as sus
from holdfast.interface.cli.values import read_objective
from holdfast.kinematics.indices import relative_manipulability

HOME = "0 -45 0 -135 0 90 45"
IN_RADIANS = "0 -0.8 0 -2.4 0 1.6 0.8"
URDF = Path(hf.__file__).parent / "model" / "arms" / "data" / "xarm7.urdf"


def same(a, b, q):
    np.testing.assert_allclose(a(q), b(q), rtol=1e-12)
    assert a.better == b.better


# ---- objectives as text --------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def panda():
    return arms.load("panda")


def test_objectives_as_text(panda, rng, tmp_path):
    q = oracles.inside(panda, rng, 4)
    weights = rng.uniform(0, 2, 7).round(3)
    numbers = ",".join(map(str, weights.tolist()))
    file = tmp_path / "w.csv"
    file.write_text(numbers + "\n")
    second, third = np.eye(7)[1], np.eye(7)[2]
    rho = relative_manipulability(panda, "position")
    for text, expected in {
        "torque": sus.torque(panda),
        " acceleration ": sus.acceleration(panda),
        "swing-angle": sus.swing_angle(panda),
        "torque:effort": sus.torque(panda, "effort"),
        "torque : worst-case": sus.torque(panda, "worst-case"),
        "torque:joint2": sus.torque(panda, second),
        "swing-angle:panda_joint3": sus.swing_angle(panda, third),
        f"torque:{numbers}": sus.torque(panda, weights),
        f"torque:{numbers.replace(',', ' , ')}": sus.torque(panda, weights),
        f"acceleration:{file}": sus.acceleration(panda, weights),
        "0.5*torque:effort + 0.1*swing-angle": 0.5 * sus.torque(panda, "effort") + 0.1 * sus.swing_angle(panda),
        "1e-2*torque:joint2+.5 * swing-angle:worst": None,
        "torque - 20*relative-manipulability": sus.torque(panda) - 20 * rho,
        "-3 * relative-manipulability+torque:joint3": -3 * rho + sus.torque(panda, third),
        "2.*torque": 2 * sus.torque(panda),
    }.items():
        if expected is None:
            with pytest.raises(hf.InputError, match="weights 'worst' of swing-angle are not known"):
                read_objective(panda, "--minimise", text, "position")
        else:
            same(read_objective(panda, "--minimise", text, "position"), expected, q)
    same(read_objective(panda, "--maximise", "relative-manipulability", "position"), rho, q)


def test_a_joint_by_its_name_before_its_number(rng):
    """An arm that counts its joints from 0 in their names: names win."""
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR"), rng)
    joints = tuple(
        hf.Joint(name, j.type, j.origin, axis=j.axis)
        for name, j in zip(("joint0", "joint1", "left-elbow", "tip"), arm.joints, strict=True)
    )
    arm = hf.Arm(name="named", joints=joints, links=arm.links)
    q = oracles.inside(arm, rng, 3)
    for text, joint in (("joint1", 1), ("joint2", 1), ("left-elbow", 2), ("joint4", 3), ("tip", 3)):
        same(read_objective(arm, "--minimise", f"torque:{text}", "position"), sus.torque(arm, np.eye(4)[joint]), q)


def test_the_wrong_way_on_purpose(panda, rng):
    """The worst configuration: the same number, wanted the other way."""
    q = oracles.inside(panda, rng, 3)
    rho = relative_manipulability(panda, "position")
    worst = read_objective(panda, "--minimise", "relative-manipulability", "position")
    np.testing.assert_array_equal(worst(q), rho(q))
    assert worst.better == "smaller"
    assert read_objective(panda, "--maximise", "torque", "pose").better == "larger"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "--minimise: '' cannot be read; write torque, torque:effort"),
        ("3", "'3' cannot be read"),
        ("torque acceleration", "'acceleration' cannot be read"),
        ("torque + ", "'+' cannot be read"),
        ("torque: + acceleration", "': + acceleration' cannot be read"),
        (
            "torques",
            "objective 'torques' is not known; did you mean torque? Or use one of torque, acceleration",
        ),
        ("Torque", "objective 'Torque' is not known"),
        (
            "relative-manipulability:effort",
            "index 'relative-manipulability' takes no setting",
        ),
        ("acceleration:effort", "weights 'effort' are of torques"),
        ("torque:joint8", "joint 8 is out of range; 'panda' has joints 1 to 7"),
        ("torque:elbow", "weights 'elbow' of torque are not known"),
        ("torque:2", "torque has 1 weights and 'panda' has 7 joints"),
        ("torque:1,1,1,1,1,1,-1", "not positive semidefinite"),
        ("torque:nowhere.csv", "'nowhere.csv' cannot be read"),
        ("0*torque", "the weight of torque susceptibility is 0"),
        ("torque + relative-manipulability", "change the sign of one of them"),
    ],
)
def test_what_is_wrong_with_an_objective(text, words, panda):
    with pytest.raises(hf.HoldfastError) as error:
        read_objective(panda, "--minimise", text, "position")
    assert words in str(error.value)


# ---- the command ---------------------------------------------------------------------------------------------------


def test_it_is_the_library(ask, panda):
    q = np.radians([float(x) for x in HOME.split()])
    data = ask("optimise", "panda", "--at", HOME, "--degrees", "--minimise", "torque:effort", "--starts", 20, "--seed", 3)
    torque = sus.torque(panda, "effort")
    expected = hf.optimise(panda, panda.forward_kinematics(q), torque, seed=3, starts=20, initial=q)
    (row,) = data["poses"]
    assert (data["arm"], data["task"], data["better"], data["before"]) == ("panda", "pose", "smaller", "given")
    assert list(row["q"]) == list(panda.joint_names)
    found = np.array(list(row["q"].values()))
    np.testing.assert_array_equal(found, expected.q)
    assert row["value"] == expected.value < row["value_before"] == torque(q)
    np.testing.assert_allclose(panda.forward_kinematics(found), panda.forward_kinematics(q), atol=1e-6)
    np.testing.assert_array_equal([x["after"] for x in row["measures"]["torque"].values()], torque.by_joint(found))
    np.testing.assert_array_equal([x["before"] for x in row["measures"]["torque"].values()], torque.by_joint(q))
    assert (row["starts"], row["agreeing"], row["status"]) == (expected.starts, expected.agreeing, "ok")
    clear = hf.collision.Clearance.by_default(panda)
    same = hf.optimise(panda, panda.forward_kinematics(q), torque, seed=3, starts=20, clearance=clear, initial=q)
    assert json.loads(json.dumps(same.to_dict())) == data
    assert f"from {torque(q):.4g} to {float(same.value):.4g}" in same.describe()[0]


def test_a_pose_of_a_urdf_file_as_numbers(ask):
    """Roll, pitch and yaw as URDF counts them, in degrees; and the worst configuration on purpose."""
    arm = hf.Arm.from_urdf(URDF)
    pose = oracles.pose(Rotation.from_euler("ZYX", [30, -20, 170], degrees=True).as_matrix(), [0.4, 0.1, 0.3])
    found = []
    for text, wish in (("0.4,0.1,0.3,170,-20,30", "--minimise"), ("0.4 0.1 0.3 170 -20 30", "--maximise")):
        data = ask("optimise", URDF, "--pose", text, wish, "torque:joint2", "--starts", 8)
        (row,) = data["poses"]
        np.testing.assert_allclose(row["pose"], pose, atol=1e-15)
        np.testing.assert_allclose(arm.forward_kinematics(list(row["q"].values())), pose, atol=1e-5)
        assert data["before"] == "found"
        found.append(row)
    assert found[0]["value"] <= found[0]["value_before"] == found[1]["value_before"] <= found[1]["value"]
    assert found[0]["value"] < found[1]["value"]


def test_poses_from_a_file_and_results_to_one(ask, cli, tmp_path, panda, rng):
    q = oracles.inside(panda, rng, 3)
    poses = panda.forward_kinematics(q)
    file, out = tmp_path / "poses.csv", tmp_path / "out.csv"
    quaternions = Rotation.from_matrix(poses[:, :3, :3]).as_quat()
    rows = [*np.concatenate([poses[:, :3, 3], quaternions], axis=1), np.array([9.0, 0, 0, 0, 0, 0, 1])]
    file.write_text("x,y,z,qx,qy,qz,qw\n" + "".join(",".join(map(repr, row.tolist())) + "\n" for row in rows))
    arguments = ("optimise", "panda", "--poses", file, "--minimise", "0.1*swing-angle + torque:joint4", "--starts", 8)
    data = ask(*arguments, "--csv", out)
    assert [row["status"] for row in data["poses"]] == ["ok", "ok", "ok", "not_found"]
    assert data["poses"][3]["value"] is None
    assert set(data["poses"][3]["q_before"].values()) == {None}
    assert list(data["poses"][0]["measures"]) == ["swing-angle", "torque"]
    with out.open(newline="") as stream:
        table = list(csv.DictReader(stream))
    assert [row["pose"] for row in table] == ["1", "2", "3", "4"]
    for row, told in zip(table[:3], data["poses"], strict=False):
        np.testing.assert_allclose(
            [float(row[f"{name}_rad"]) for name in panda.joint_names], list(told["q"].values()), rtol=1e-11
        )
        assert float(row["value"]) == pytest.approx(told["value"], rel=1e-11)
    code, text, err = cli(*arguments)
    words = " ".join(text.split())
    assert (code, err) == (0, "")
    for part in ("pose before best same optimum of searches", "not found: no solution was found", "first configuration found"):
        assert part in words, part


def test_configurations_to_compare_with_are_as_many_as_poses(panda):
    poses = panda.forward_kinematics(np.zeros((2, 7)))
    for wrong in (np.zeros(7), np.zeros((3, 7))):
        with pytest.raises(hf.InputError, match="give one configuration of each pose"):
            hf.optimise(panda, poses, sus.torque(panda), starts=1, initial=wrong)


def test_a_person_reads_joints_in_rad_and_degrees(cli):
    code, out, err = cli(
        "optimise", "planar-3r", "--at", "0.3 1 -0.7", "--maximise", "relative-manipulability", "--mount", "wall"
    )
    words = " ".join(out.split())
    assert (code, err) == (0, "")
    for part in (
        "Maximise relative-manipulability",
        "(the configuration given)",
        "0.3000 rad (17.19 deg)",
        "searches that found this optimum",
    ):
        assert part in words, part
    assert "position error" in words


def test_the_best_of_all_poses(ask, cli):
    given = ("optimise", "planar-3r", "--maximise", "relative-manipulability", "--any-pose", "--starts", "50")
    (row,) = ask(*given)["poses"]
    assert row["value"] == pytest.approx(1 / np.sqrt(3), abs=1e-6)
    words = " ".join(cli(*given)[1].split())
    assert "(the best random configuration)" in words
    assert "completed local searches 50" in words
    assert "position error" not in words


def test_positions_need_no_orientation(ask):
    arm = arms.load("planar-3r")
    data = ask("optimise", "planar-3r", "--pose", "0.9 1.1 0", "--minimise", "torque:worst-case", "--starts", 4)
    found = arm.forward_kinematics(list(data["poses"][0]["q"].values()))
    np.testing.assert_allclose(found[:3, 3], [0.9, 1.1, 0], atol=1e-5)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--at", IN_RADIANS], "give one of --minimise and --maximise"),
        (["--at", IN_RADIANS, "--minimise", "torque", "--maximise", "torque"], "give one of --minimise and --maximise"),
        (["--minimise", "torque"], "give one of --pose"),
        (["--minimise", "torque", "--at", IN_RADIANS, "--pose", "1,0,0"], "give one of --pose"),
        (["--minimise", "torque", "--at", IN_RADIANS, "--any-pose"], "give one of --pose"),
        (["--minimise", "torque", "--at", "1 2"], "has 2 values per configuration"),
        (["--minimise", "torque", "--at", "1 2 3 4 5 6 nan"], "--at contains NaN"),
        (["--minimise", "torque", "--pose", "1,2"], "--pose has 2 numbers; give x,y,z,roll,pitch,yaw"),
        (["--minimise", "torque", "--pose", "1,2,x"], "--pose: 'x' is not a number"),
        (["--minimise", "torque", "--pose", "1,2,inf"], "--pose contains NaN or infinity"),
        (["--minimise", "torque", "--pose", "0.5,0,0.5"], "task 'pose' needs one"),
        (
            ["--minimise", "torque", "--starts", "1", "--pose", "5,0,0,0,0,0"],
            "no configuration of the pose: no solution was found",
        ),
        (["--minimise", "torque", "--poses", "nowhere.csv"], "--poses: 'nowhere.csv' cannot be read"),
        (["--minimise", "weight", "--at", IN_RADIANS], "objective 'weight' is not known"),
        (["--minimise", "torque", "--at", IN_RADIANS, "--starts", "0"], "starts is 0"),
        (["--minimise", "torque", "--at", IN_RADIANS, "--seed", "-1"], "--seed"),
        (
            ["--minimise", "torque", "--at", IN_RADIANS, "--starts", "1", "--csv", "/nowhere/x.csv"],
            "cannot write configurations",
        ),
    ],
)
def test_bad_input_is_one_sentence(arguments, words, refused):
    assert words in refused("optimise", "panda", *arguments)


def test_a_file_without_poses(refused, tmp_path):
    file = tmp_path / "poses.csv"
    file.write_text("x,y,z\n")
    assert "contains no poses" in refused("optimise", "panda", "--poses", file, "--minimise", "torque")
    file.write_text("x,y,z,qx,qy,qz,qw\n0,0,1,0,0,0,2\n")
    assert "line 2: the quaternion" in refused("optimise", "panda", "--poses", file, "--minimise", "torque")


def test_failures_restrict_what_may_fail(ask, panda):
    q = np.array([float(x) for x in IN_RADIANS.split()])
    arguments = ["panda", "--at", IN_RADIANS, "--maximise", "relative-manipulability", "--failures", "1; 2; 3"]
    said = ask("optimise", *arguments)
    index = relative_manipulability(panda, failures=[[0], [1], [2]])
    found = hf.optimise(panda, panda.forward_kinematics(q), index, initial=q, clearance=True)
    assert said["failures"] == "1; 2; 3"
    (row,) = said["poses"]
    best = np.array(list(row["q"].values()))
    assert row["value"] == pytest.approx(index(best))
    assert row["value"] >= 0.9 * found.value
    after = [row["measures"]["relative-manipulability"][name]["after"] for name in panda.joint_names]
    np.testing.assert_allclose(after, relative_manipulability(panda).by_joint(best))


def test_failures_of_a_torque_are_refused(refused):
    words = refused("optimise", "panda", "--at", IN_RADIANS, "--minimise", "torque", "--failures", "1; 2")
    assert "--failures is for an index, not for torque" in words
