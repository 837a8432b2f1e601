"""``holdfast simulate --physics``: the run in MuJoCo beside the kinematic one."""

from __future__ import annotations

import matplotlib.image
import pytest

CALL = ["simulate", "planar-2r", "--start", "0 -30", "--degrees", "--lock", "1", "--target", "0,1.7320508"]
CALL += ["--gain", "5", "--physics"]


def test_both_outcomes_and_how_far_they_are_apart(ask):
    data = ask(*CALL, "--servo-bandwidth", 20)
    told = data["physics"]
    assert (data["outcome"], told["outcome"], told["agrees"]) == ("stuck", "stuck", True)
    assert told["error"] == pytest.approx(data["error"], abs=1e-5)
    assert told["terminal_distance_m"] < 1e-4
    assert 0 < told["path_distance_m"] < 0.1
    assert set(told["stiffness"]) == set(data["q_final"])


def test_they_are_printed_and_drawn(cli, tmp_path):
    figure = tmp_path / "both.png"
    code, out, err = cli(*CALL, "--plot", figure)
    assert (code, err) == (0, "")
    assert "kinematic" in out
    assert "tool paths apart" in out
    assert matplotlib.image.imread(figure).shape[1] > 1000


def test_cycles_have_no_physics(refused):
    assert "leave out --cycles" in refused(*CALL, "--cycles")
    assert "bandwidth of the servos is 0" in refused(*CALL, "--servo-bandwidth", "0")
