"""``holdfast simulate --physics``: the run in MuJoCo beside the kinematic one."""

from __future__ import annotations

import matplotlib.image
import numpy as np
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
    assert "distance between the tool paths" in out
    assert matplotlib.image.imread(figure).shape[1] > 1000


def test_cycles_have_no_physics(refused):
    assert "leave out --cycles" in refused(*CALL, "--cycles")
    assert "bandwidth of the servos is 0" in refused(*CALL, "--servo-bandwidth", "0")


@pytest.fixture
def recovered(cli, tmp_path):
    at = "0.3 0.2 0.1 -2 0.1 2 0.5"
    call = ["recover", "panda", "--lock", "4=-2", "--at", at, "--goal", "q:0.6 0.4 0.1 -2 0.1 2.2 0.5", "--samples", "0"]
    assert cli(*call, "--accelerations", "5", "--out", tmp_path / "rec")[0] == 0
    return tmp_path / "rec"


def test_a_planned_motion_is_played_with_a_lock_on_the_way(cli, ask, refused, recovered, tmp_path):
    played = ["simulate", "panda", "--motion"]
    data = ask(*played, recovered, "--lock", "2@0.2", "--error-limit", "2deg")
    table = np.loadtxt(recovered / "waypoints.csv", delimiter=",", skiprows=1)
    assert data["lock_time_s"] == {"panda_joint2": 0.2}
    assert data["exceeded"]["joint"] == "panda_joint2"
    stays = np.interp(0.2, table[:, 0], table[:, 2])  # nearly: it lags a little when it locks
    late = table[np.abs(table[:, 2] - stays) > np.deg2rad(2.0), 0]
    assert data["exceeded"]["time_s"] == pytest.approx(late[late > 0.2][0], abs=0.03)
    assert data["following_error"]["panda_joint2"] == pytest.approx(abs(0.4 - data["q_final"]["panda_joint2"]), abs=1e-9)
    code, text, _ = cli(*played, recovered / "waypoints.csv", "--error-limit", "0.05rad,1mm", "--csv", tmp_path / "run.csv")
    assert code == 0
    assert "The following error stays within its limit in every joint." in text
    assert "mm and" in text
    assert (tmp_path / "run.csv").is_file()
    assert "has a number without a unit" in refused(*played, recovered, "--error-limit", "2")
    assert "--target does not go with --motion" in refused(*played, recovered, "--target", "0,0,1")
    assert "cannot be read" in refused(*played, tmp_path / "none.csv")
    assert "add --motion" in refused(*CALL, "--error-limit", "2deg")
    assert "--target is missing" in refused("simulate", "panda", "--start", "0 0 0 0 0 0 0")
