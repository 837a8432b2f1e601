"""``holdfast workspace``, ``convergence-map`` and ``compare-laws --best``: what they print and write."""

from __future__ import annotations

import json

import numpy as np
import pytest

FEW = ["--starts", "grid:5", "--configurations", "4", "--points", "2"]


def test_measures_of_a_planar_arm(cli, tmp_path):
    code, out, err = cli("workspace", "planar-3r", "--target", "1.5,1.5", *FEW, "--out", tmp_path)
    assert (code, err) == (0, "")
    assert "-24.30 to 114.30 deg" in out
    assert "Rsens" in out
    assert "undecided at the time limit" in out
    assert {"workspace.csv", "workspace.json", "reach.png", "finish.png", "report.html", "run"} == {
        p.name for p in tmp_path.iterdir()
    }
    data = json.loads((tmp_path / "workspace.json").read_text())
    assert data["method"] == "brute"
    assert data["starts"] == 13
    assert np.rad2deg(data["bounds_rad"]["joint2"][0]) == pytest.approx([-111.797, 111.797], abs=1e-3)


def test_maps_and_several_laws(cli, ask, tmp_path):
    few = ["--starts", "4", "--configurations", "2", "--time-limit", "60"]
    both = ask("compare-laws", "planar-3r", "--best", "--target", "1,1", *few, "--law", "pseudoinverse", "--law", "damped:0.1")
    assert len(both["maps"]) == 2
    assert both["best"] in both["laws"]
    assert both["maps"][0]["places"] == 4
    flat = ["convergence-map", "planar-3r", "--over", "targets", "--target", "grid:5", *few]
    code, out, _ = cli(*flat, "--out", tmp_path)
    assert code == 0
    assert "13 targets" in out
    assert {"map.csv", "map.json", "outcomes.png", "map.png", "report.html"} == {p.name for p in tmp_path.iterdir()}


def test_measures_by_sampling_come_with_intervals(cli, tmp_path):
    few = ["--method", "sampled", "--starts", "5", "--configurations", "2", "--points", "1"]
    code, out, err = cli("workspace", "planar-3r", "--target", "1.5,1.5", *few, "--out", tmp_path)
    assert (code, err) == (0, "")
    assert "95 % interval" in out
    assert "an upper bound" in out
    data = json.loads((tmp_path / "workspace.json").read_text())
    assert data["method"] == "sampled"
    low, high = data["mean_percent_95"]["Ravg"]["any"]
    assert low <= data["mean_percent"]["Ravg"]["any"] <= high


def test_points_over_targets_are_those_asked_for(ask):
    few = ["workspace", "planar-3r", "--over", "targets", "--target", "grid:3", "--starts", "3", "--configurations", "2"]
    counts = [np.sum(ask(*few, *more)["ends"]) for more in ((), ("--points", "2"), ("--points", "5"))]
    assert counts[0] == counts[1] < counts[2]


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["workspace", "--target", "1,2,3"], "needs 2, in m"),
        (["workspace", "--target", "1.5,1.5", "--method", "nothing"], "--method"),
        (["workspace", "--target", "9,9"], "within its reach"),
        (["convergence-map", "--target", "1.5,1.5", "--over", "nothing"], "--over"),
        (["compare-laws", "--best", "--target", "1.5,1.5", "--law", "damped:x"], "not a number"),
        (["compare-laws", "--best", "--target", "1.5,1.5", "--law", "pseudoinverse:2"], "takes no setting"),
        (["compare-laws", "--best", "--target", "1.5,1.5", "--law", "pseudoinverse"], "give two or more"),
    ],
)
def test_bad_input(cli, more, message):
    code, _, err = cli(more[0], "planar-3r", *more[1:])
    assert code == 2
    assert message in err
