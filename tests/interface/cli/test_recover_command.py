"""``holdfast recover``: what it prints and writes, and with which exit code."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
import holdfast as hf
import oracles
from holdfast.response.recovery import read_waypoints
from wellformed import check

CALL = ["recover", "planar-3r", "--lock", "2", "--at", "20 40 60", "--degrees"]


def test_the_command_writes_what_it_found(cli, tmp_path):
    out = tmp_path / "home"
    code, text, err = cli(*CALL, "--goal", "pose:1.5,1.5,0", "--samples", "100", "--out", out, "--csv", tmp_path / "w.csv")
    assert (code, err) == (0, "")
    assert "With joint2 locked at 40 deg, the whole goal is met" in text
    assert {f.name for f in out.iterdir()} == {"recovery.json", "waypoints.csv", "motion.png", "left.png", "report.html"}
    page = (out / "report.html").read_text(encoding="utf-8")
    check(page)
    assert page.count("<svg") == 2
    data = json.loads((out / "recovery.json").read_text())
    arm = hf.arms.load("planar-3r")
    q = read_waypoints(arm, tmp_path / "w.csv")
    np.testing.assert_array_equal(q, data["waypoints"])
    np.testing.assert_allclose(oracles.forward(arm, q[-1:])[0, :2, 3], [1.5, 1.5], atol=3e-6)
    assert (data["ok"], data["ending"], data["check"]["ok"]) == (True, "goal_reached", True)
    code, text, err = cli("recover", "planar-3r", "--lock", "2=40", "--degrees", "--check", tmp_path / "w.csv")
    assert (code, err) == (0, "")
    assert "Limits and locks are respected" in text
    code, text, _ = cli("recover", "planar-3r", "--lock", "2=41", "--degrees", "--check", tmp_path / "w.csv", "--json")
    assert code == 3
    assert json.loads(text)["locks_moved"] == {"joint2": pytest.approx(np.deg2rad(1))}


@pytest.mark.parametrize("accelerations", ["2", "2,2,4", "joint1=2,3=4"])
def test_a_motion_is_timed_within_accelerations_and_its_file_is_checked(cli, tmp_path, accelerations):
    arm = tmp_path / "arm.urdf"
    joints = "".join(
        f'<link name="l{k}"/><joint name="joint{k}" type="revolute"><parent link="l{k - 1}"/><child link="l{k}"/>'
        f'<origin xyz="{int(k > 1)} 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>'
        for k in (1, 2, 3)
    )
    arm.write_text(f'<robot name="three"><link name="l0"/>{joints}</robot>')
    call = ["recover", arm, "--lock", "2", "--at", "0.1 0.3 0.2", "--goal", "q:1.1 0.3 0.5", "--samples", "0"]
    code, text, err = cli(*call, "--accelerations", accelerations, "--period", 0.02, "--out", tmp_path / "out")
    assert (code, err) == (0, "")
    assert "takes 1.5 s (1 s at the velocity limits alone)" in text
    assert (tmp_path / "out" / "timing.png").exists()
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    check(page)
    assert "Timing" in page
    file = tmp_path / "out" / "waypoints.csv"
    assert len(file.read_text().splitlines()) == 77
    data = json.loads((tmp_path / "out" / "recovery.json").read_text())["timed"]
    assert (data["duration_s"], data["rows"]) == (pytest.approx(1.5), 76)
    again = ["recover", arm, "--lock", "2=0.3", "--check", file]
    assert cli(*again, "--accelerations", accelerations)[0] == 0
    code, text, _ = cli(*again, "--accelerations", "1.9")
    assert code == 3
    assert "Joint1 accelerates too much: 2 (rad/s² or m/s²)" in text


@pytest.mark.parametrize(
    ("more", "ending"),
    [
        (["--goal", "pose:0.3,0.2,0"], "goal_reached_with_relaxed_rows"),
        (["--goal", "q:0 0 0"], "goal_reached_with_relaxed_rows"),
        (["--lock", "3=10"], "lock_mismatch"),
    ],
    ids=["rows", "joint", "elsewhere"],
)
def test_anything_less_than_the_whole_goal_is_exit_code_3(cli, more, ending):
    code, text, err = cli(*CALL, *more, "--samples", "0", "--json")
    assert (code, err) == (3, "")
    data = json.loads(text)
    assert (data["ok"], data["ending"]) == (False, ending)


def test_a_proof_says_whether_it_holds_within_what_may_be_missed(cli):
    code, text, _ = cli(*CALL, "--goal", "pose:4,0,0", "--samples", "0", "--tolerance", "1mm,0.5deg")
    assert code == 3
    assert "this also holds for misses of up to 1 mm and 0.5 deg" in text


def test_the_command_follows_the_rest_of_a_path(cli, tmp_path):
    arm = hf.arms.load("planar-3r")
    x, y, _ = arm.forward_kinematics(np.deg2rad([20, 40, 60]))[:3, 3]
    file = tmp_path / "rest.yaml"
    file.write_text(f"line: {{from: {{xyz: [{x:.12f}, {y:.12f}, 0]}}, to: {{xyz: [{x - 0.3:.12f}, {y - 0.2:.12f}, 0]}}}}\n")
    code, text, err = cli(*CALL, "--path", file, "--samples", "0", "--json")
    assert (code, err) == (0, "")
    data = json.loads(text)
    assert data["rest_of_path"]["finished"] is True
    assert [leg["name"] for leg in data["legs"]][-1] == "along the path"


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (["recover", "planar-3r", "--lock", "2"], "give --at"),
        (["recover", "planar-3r", "--at", "0 0 0"], "give --lock"),
        ([*CALL, "--goal", "1,2,0"], "could be joint values or a pose"),
        ([*CALL, "--goal", "sky:1"], "not known"),
        ([*CALL, "--lock", "joint2=3"], "twice"),
        ([*CALL, "--lock", "3=up"], "not joint=number"),
        ([*CALL, "--goal", "pose:1,1,0", "--task", "planar-pose"], "no orientation"),
        ([*CALL, "--margin", "0.1"], "--margin has no effect"),
        ([*CALL, "--accelerations", "quick"], "--accelerations"),
        ([*CALL, "--accelerations", "3=1"], "no limit for 'joint1'"),
        ([*CALL, "--tolerance", "1mm"], "a sequence of 2"),
        ([*CALL, "--tolerance", "1mm,x"], "--tolerance '1mm,x' is not a number"),
    ],
    ids=["at", "lock", "ambiguous", "kind", "twice", "word", "task", "margin", "accelerations", "missing", "one", "number"],
)
def test_the_command_refuses_in_one_sentence(refused, call, sentence):
    assert sentence in refused(*call)


CELL = """
name: bench
objects:
  post: {sphere: 0.2, pose: {xyz: [0.62, 2.32, 0]}}
  far: {box: [0.2, 0.2, 0.2], pose: {xyz: [-2, -2, 0]}}
"""


def test_the_command_keeps_clear_of_a_cell_and_a_replay_sees_it(cli, tmp_path):
    cell, ways = tmp_path / "bench.yaml", [tmp_path / "through.csv", tmp_path / "round.csv"]
    cell.write_text(CELL)
    call = ["recover", "planar-3r", "--lock", "2", "--at", "10 30 40", "--degrees", "--goal", "q:70 30 40", "--samples", "0"]
    assert cli(*call, "--csv", ways[0])[0] == 0
    locked = (
        "recover",
        "planar-3r",
        "--lock",
        "2=30",
        "--degrees",
        "--cell",
        cell,
        "--radius",
        0.03,
        "--no-clearance",
        "--check",
    )
    code, text, _ = cli(*locked, ways[0])
    assert code == 3
    assert "& post, margin 0 m): VIOLATED" in text
    code, text, err = cli(*call, "--cell", cell, "--radius", 0.03, "--no-clearance", "--csv", ways[1], "--json")
    assert (code, err) == (0, "")
    data = json.loads(text)
    assert data["clearance"]["cell"] == {
        "name": "bench",
        "sha256": hf.Cell.load(cell).digest,
        "objects": ["post", "far"],
        "margin_m": 0.0,
        "distances": "bound",
    }
    assert data["check"]["closest"].endswith("& post")
    assert data["check"]["least_room_m"] >= 0
    code, text, _ = cli(*locked, ways[1])
    assert (code, "respected" in text) == (0, True)
    assert len(read_waypoints(hf.arms.load("planar-3r"), ways[1])) > 2


def test_a_failure_file_says_more_than_locks(cli, tmp_path):
    file = tmp_path / "failure.yaml"
    file.write_text("locked: [joint2]\nrange: {joint1: [0, 1.4]}\n")
    call = [
        "recover",
        "planar-3r",
        "--failure",
        file,
        "--at",
        "20 40 60",
        "--degrees",
        "--goal",
        "pose:1.5,1.5,0",
        "--samples",
        "0",
    ]
    code, text, err = cli(*call, "--json", "--csv", tmp_path / "w.csv")
    assert (code, err) == (0, "")
    data = json.loads(text)
    assert data["degraded"] == {"locked": {"joint2": pytest.approx(np.deg2rad(40))}, "range": {"joint1": [0, 1.4]}}
    assert all(0 <= q[0] <= 1.4 for q in data["waypoints"])
    code, text, _ = cli("recover", "planar-3r", "--failure", file, "--check", tmp_path / "w.csv")
    assert (code, "limits and locks are respected" in text.lower()) == (0, True)
    code, _, err = cli(*call, "--lock", "1")
    assert code == 2
    assert "--failure and --lock both define the failure" in err
    code, text, _ = cli("basins", "planar-3r", "--target", "1.5,1.5", "--failure", file)
    assert code == 2


def test_simulate_and_stationary_points_read_a_failure_file(cli, tmp_path):
    file = tmp_path / "failure.yaml"
    file.write_text("locked: {joint2: 0.7}\n")
    same = ["--target", "1.5,1.5", "--json"]
    for call in (["stationary-points", "planar-3r"], ["simulate", "planar-3r", "--start", "0.3 0.7 1"]):
        lock = ["--lock", "2=0.7"] if call[0] == "stationary-points" else ["--lock", "2"]
        found, plain = (json.loads(cli(*call, *same, *how)[1]) for how in (["--failure", file], lock))
        for data in (found, plain):
            data.pop("command", None)
        assert found == plain


def test_what_is_kept_on_the_way(cli, tmp_path):
    call = [
        "recover",
        "planar-3r",
        "--lock",
        "joint3=0",
        "--at",
        "0.9 -1.2 0",
        "--goal",
        "pose:1.5323,0.1923,0",
        "--samples",
        "0",
    ]
    code, text, err = cli(*call, "--task", "planar", "--keep", "plane:0,1,0", "--json")
    assert (code, err) == (0, "")
    data = json.loads(text)
    tool = oracles.forward(hf.arms.load("planar-3r"), np.array(data["waypoints"]))[:, :3, 3]
    assert np.abs(tool[:, 1] - tool[0, 1]).max() < 1e-4
    assert data["keep"][0]["name"] == "plane"
    assert data["verified"]["kept"][0]["off"] <= 1e-3
    file = tmp_path / "w.csv"
    file.write_text("joint1_rad,joint2_rad,joint3_rad\n0.9,-1.2,0\n1.1,-1.2,0\n")
    checked = ["recover", "planar-3r", "--lock", "joint3=0", "--check", file, "--keep"]
    code, text, _ = cli(*checked, "plane:0,1,0")
    assert code == 3
    assert "m off the plane" in text
    code, text, _ = cli(*checked, "upright:5deg", "--keep", "plane:0,0,1", "--json")
    assert (code, json.loads(text)["kept"]) == (3, [False, True])  # its z axis points up
    code, _, err = cli(*call, "--keep", "upwards:3")
    assert code == 2
    assert "use one of upright, rail, plane" in err


def test_a_goal_in_a_cone_is_met_by_an_arm_that_cannot_turn_its_tool(cli):
    call = ["recover", "panda", "--lock", "4=-2", "--at", "0.3 0.2 0.1 -2 0.1 2 0.5", "--samples", "0", "--goal"]
    goal = "pose:0.4,0.3,0.5,150,20,40"
    code, text, _ = cli(*call, goal, "--within", "30deg", "--json")
    found = json.loads(text)
    assert (code, found["ok"], found["within"]) == (0, True, pytest.approx(np.deg2rad(30)))
    end = oracles.forward(hf.arms.load("panda"), np.array(found["waypoints"])[-1:])[0]
    from scipy.spatial.transform import Rotation

    axis = Rotation.from_euler("xyz", [150, 20, 40], degrees=True).apply([0, 0, 1])
    np.testing.assert_allclose(end[:3, 3], [0.4, 0.3, 0.5], atol=1e-6)
    assert np.rad2deg(np.arccos(end[:3, 2] @ axis)) <= 30
    for wrong, sentence in (("30", "no unit"), ("1deg,2deg", "2 numbers"), ("300deg", "below pi")):
        code, _, error = cli(*call, goal, "--within", wrong)
        assert (code, sentence in error) == (2, True), error
    code, _, error = cli(*call, "pose:0.4,0.3,0.5", "--within", "30deg")
    assert (code, "no orientation" in error) == (2, True)


def test_without_rerun_the_command_stops_before_it_plans(cli, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    code, out, err = cli("recover", "panda", "--lock", "4", "--at", "0 0 0 -2 0 2 0", "--rrd", tmp_path / "home.rrd")
    assert (code, out) == (2, "")
    assert "rerun-sdk is needed here and is not installed" in err
