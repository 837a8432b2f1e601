"""``holdfast compare-laws``: what it prints and writes, against the library."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.cli.laws import read_law

CALL = ["compare-laws", "planar-3r", "--law", "pseudoinverse", "--law", "damped:0.3", "--time-limit", "100"]


def test_random_motions_are_those_of_the_library(ask):
    data = ask(*CALL, "--motions", "8", "--seed", "3", "--distance", "0.5,2.5")
    arm = hf.arms.load("planar-3r")
    drawn = hf.point_to_point(arm, 8, seed=3, distance=(0.5, 2.5))
    laws = [hf.control.pseudoinverse(arm, "planar"), hf.control.damped(arm, 0.3, "planar")]
    found = hf.compare_laws(laws, drawn.q0, drawn.target, time_limit=100.0)
    assert data["motions"] == 8
    assert list(data["laws"]) == ["pseudoinverse", "damped:0.3"]
    for row, expected in zip(data["outcomes"], found.table, strict=True):
        assert row == pytest.approx(expected, nan_ok=True)
    assert [g["failure"] for g in data["gains"]] == ["joint1", "joint2", "joint3", "any joint"]
    assert data["gains"][-1]["gain"] == pytest.approx(found.gain("damped:0.3").value)
    assert len(data["healthy"]) == 2


def test_a_table_for_people_and_a_folder(cli, tmp_path):
    out = tmp_path / "laws"
    code, said, err = cli(*CALL, "--motions", "8", "--failures", "joint2; 3", "--out", out)
    assert (code, err) == (0, "")
    assert "After an undetected lock of one joint" in said
    assert "joint2" in said
    assert "joint1" not in said
    assert "limits are not enforced" in said
    assert {f.name for f in out.iterdir()} == {"outcomes.csv", "gains.csv", "healthy.csv", "runs.csv", "report.html"}
    with (out / "runs.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 2 * 3 * 8
    assert {r["outcome"] for r in rows} <= {"converged", "stuck", "moving", "undecided"}
    assert "holdfast compare-laws planar-3r" in (out / "report.html").read_text(encoding="utf-8")


def test_one_motion_of_ones_own(ask):
    data = ask(*CALL, "--start", "20 40 60", "--degrees", "--target", "1.5,1.5", "--failures", "none")
    assert data["motions"] == 1
    assert [r["failure"] for r in data["outcomes"]] == ["healthy", "healthy"]
    assert "gains" not in data
    start = hf.arms.load("planar-3r").forward_kinematics(np.deg2rad([20, 40, 60]))[:2, 3]
    near = 1e-3 * 4  # of the arm's own length: three links of 1 m, rounded to a power of two
    expected = np.log(np.linalg.norm(start - 1.5) / near)
    assert data["healthy"][0]["time_50"] == pytest.approx(expected, abs=1e-4)


def test_laws_with_their_settings():
    arm = hf.arms.load("planar-3r")
    for text in ("weighted:1,2,3", "damped:0.1", "failure-tolerant:0.25", "pseudoinverse"):
        assert read_law(text, arm, "planar", gain=2.0).label == text
    assert read_law("failure-tolerant", arm, "planar").label == "failure-tolerant:0.5"
    assert read_law("weighted:1,2,3", arm, "planar", gain=2.0).describe().endswith("weights 1, 2, 3, gain 2/s")
    assert hf.control.weighted(arm, np.eye(3) + 0.1, "planar").label == "weighted"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--law", "magic"], "control law 'magic' is not known"),
        (["--law", "pseudoinverse:1"], "takes no setting"),
        (["--law", "damped:1,2"], "has 2 numbers for damping; give one"),
        (["--law", "damped"], "needs damping"),
        (["--start", "0,0,0"], "--start and --target go together"),
        (["--start", "0,0,0", "--target", "1,1", "--motions", "3"], "leave out --start and --target"),
        (["--failures", "2"], "failure 'joint1+joint2' locks several joints at once"),
        (["--failures", "elbow"], "elbow"),
        (["--failures", "joint1; 7"], "joints 1 to 3"),
        (["--reachable-after", "joint1+joint2"], "failure 'joint1+joint2' locks several joints at once"),
        (["--distance", "1"], "--distance has 1 number"),
        (["--motions", "0"], "count is 0"),
    ],
)
def test_wrong_input_is_one_sentence(refused, arguments, words):
    assert words in refused("compare-laws", "planar-3r", *arguments)


def test_it_says_what_it_is_not(cli):
    _, said, _ = cli("compare-laws", "--help")
    assert "holdfast assess A B C" in said
    _, said, _ = cli("assess", "--help")
    assert "holdfast compare-laws" in said
