"""``holdfast free-swing``: what it prints, writes and draws."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

import holdfast as hf

CALL = ["free-swing", "planar-3r", "--q", "10 20 30", "--degrees", "--joint", "2", "--damping", "8"]
Q = np.radians([10.0, 20, 30])


def test_help_has_an_example(cli):
    code, out, _ = cli("free-swing", "--help")
    assert code == 0
    assert "Example: holdfast free-swing" in " ".join(out.split())


def test_json_is_the_library_s_answer(cli):
    code, out, err = cli(*CALL, "--brake", "50", "--brake", "150", "--json")
    assert (code, err) == (0, "")
    data = json.loads(out)
    expected = hf.free_swing(hf.arms.load("planar-3r"), Q, 1, damping=8.0, brake_after=(50, 150))
    assert data["joint"] == "joint2"
    assert data["rest_rad"] == expected.rest_angle
    assert data["initial_acceleration_rad_s2"] == expected.initial_acceleration
    assert [d["brake_after_ms"] for d in data["drops"]] == [50, 150]
    assert [d["tool_drop_m"] for d in data["drops"]] == [d.drop for d in expected.drops]
    assert (data["outcome"], data["settled"]) == ("rest", True)


def test_people_read_degrees_and_millimetres(cli):
    code, out, err = cli(*CALL)
    assert (code, err) == (0, "")
    swing = hf.free_swing(hf.arms.load("planar-3r"), Q, 1, damping=8.0)
    assert f"{swing.rest_angle:.4g} rad ({np.degrees(swing.rest_angle):.4g} deg)" in out
    assert all(f"{t} ms" in out for t in (50, 100, 200))
    assert f"{1000 * swing.drops[0].drop:.4g} mm" in out


def test_a_motion_that_does_not_end_is_said_to_move_and_null_in_json(cli):
    call = (*CALL, "--duration", "0.3")
    assert "still moving" in cli(*call)[1]
    assert json.loads(cli(*call, "--json")[1])["rest_rad"] is None


def test_a_sliding_joint_is_told_in_metres(cli):
    code, out, _ = cli("free-swing", "ur5-rail", "--q", "1 0 -90 90 -45 -90 0", "--degrees", "--joint", "rail")
    assert code == 0
    assert "does not move" in out
    assert "0 m/s^2" in out


def test_the_motion_goes_to_a_file_and_a_picture(cli, tmp_path):
    table, picture = tmp_path / "motion.csv", tmp_path / "motion.png"
    code, out, _ = cli(*CALL, "--csv", table, "--plot", picture)
    assert code == 0
    assert str(table) in out.replace("\n", "")
    rows = np.genfromtxt(table, delimiter=",", names=True)
    swing = hf.free_swing(hf.arms.load("planar-3r"), Q, 1, damping=8.0)
    np.testing.assert_allclose(rows["moved_rad"], swing.angle, atol=1e-8)
    np.testing.assert_allclose(rows["tool_y_m"], swing.tool_position[:, 1], atol=1e-8)
    pixels = matplotlib.image.imread(picture)
    assert pixels.shape[1] > 900
    assert pixels[..., :3].std() > 0.05


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["free-swing", "pa10-7dof", "--q", "0 0 0 0 0 0 0", "--joint", "4"], "it has no inertial data"),
        (["free-swing", "planar-3r", "--q", "0 0 0", "--joint", "4"], "joint 4 is out of range"),
        (["free-swing", "planar-3r", "--q", "0 0", "--joint", "1"], "it must have 3"),
        ([*CALL, "--brake", "-1"], "brake_after holds -1"),
        ([*CALL, "--duration", "-1"], "duration is -1 s"),
        ([*CALL, "--csv", "/nowhere/motion.csv"], "cannot write motion"),
        ([*CALL, "--plot", "/nowhere/motion.png"], "cannot write picture"),
    ],
)
def test_what_is_wrong_is_one_sentence(cli, arguments, sentence):
    code, out, err = cli(*arguments)
    assert (code, out) == (2, "")
    assert sentence in err
    assert err.count("\n") == 1


def test_the_page_says_and_shows_what_happened(tmp_path):
    swing = hf.free_swing(hf.arms.load("planar-3r"), Q, 1, damping=8.0)
    files = swing.save(tmp_path / "out", command="holdfast free-swing")
    assert [file.name for file in files] == ["swing.png", "report.html"]
    page = files[1].read_text(encoding="utf-8").replace("\u00a0", " ")
    check(page)
    assert "<h1>A free-swinging joint2 of planar-3r</h1>" in page
    assert f"joint2 swings by up to {np.rad2deg(swing.peak):.4g} deg" in page
    assert page.count("<svg") == 2  # of the view one
