"""``holdfast simulate``: what it prints, writes and draws."""

from __future__ import annotations

import json

import matplotlib.image
import numpy as np
import pytest

CALL = ["simulate", "planar-2r", "--start", "0 -30", "--degrees", "--lock", "1"]


def test_json_is_the_published_case_c(cli):
    code, out, err = cli(*CALL, "--target", "0,1.7320508", "--json")
    assert (code, err) == (0, "")
    data = json.loads(out)
    assert data["outcome"] == "stuck"
    assert data["reason"] == "none"
    assert data["error"] == pytest.approx(1.133893, abs=1e-5)
    assert data["least_error"] == pytest.approx(1, abs=1e-6)
    assert len(data["locked"]) == 1
    assert list(data["locked"].values()) == [0]
    assert np.rad2deg(list(data["q_final"].values())[1]) == pytest.approx(-261.7868, abs=1e-3)


def test_a_motion_is_printed_written_and_drawn(cli, tmp_path):
    table, figure = tmp_path / "run.csv", tmp_path / "run.png"
    code, out, err = cli(*CALL, "--target", "1.7071068 0.7071068", "--csv", table, "--plot", figure)
    assert (code, err) == (0, "")
    assert "arrives" in out
    assert "locked" in out
    assert "-315 deg" in out
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    assert table.read_text().startswith("time_s,")
    assert rows.shape == (1001, 7)
    assert rows[-1, -1] < 1e-5
    assert (rows[:, 1] == 0).all()
    assert matplotlib.image.imread(figure).shape[1] > 600


def test_cycles_and_a_lock_on_the_way(cli):
    code, out, _ = cli(
        "simulate",
        "planar-3r",
        "--start",
        "0.3,0.7,1",
        "--target",
        "-0.5,1",
        "--lock",
        "2@5",
        "--cycles",
        "--speed-limit",
        "0.05",
    )
    assert code == 0
    assert "cycles" in out
    assert "at 5 cycles" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--target", "1"], "--target has 1 numbers; task 'planar' needs 2"),
        (["--target", "1,1", "--lock", "2@x"], "'x' is not a number"),
        (["--target", "1,1", "--lock", "7"], "joints 1 to 2"),
        (["--target", "1,1", "--law", "magic"], "control law 'magic' is not known"),
        (["--target", "1,1", "--task", "planar-pose"], "3 rows"),
    ],
)
def test_wrong_input_is_one_sentence(cli, arguments, words):
    code, out, err = cli(*CALL, *arguments)
    assert code == 2
    assert out == ""
    assert words in err
    assert "Traceback" not in err
