"""``holdfast follow``: what it prints, writes and refuses."""

from __future__ import annotations

import numpy as np
import pytest
from pyarrow import parquet

import holdfast as hf
from holdfast.kinematics.indices import susceptibility
from holdfast.kinematics.paths import TimedPath, Trapezoid, line

FIRST, LAST = [1.5, -1.6, 0.0], [0.8, -1.7, 0.0]
TEXT = "line: {from: {xyz: [1.5, -1.6, 0]}, to: {xyz: [0.8, -1.7, 0]}}\n"
WISH = ("--minimise", "torque:worst-case")


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "path.yaml"
    file.write_text(TEXT + "timing: {duration: 4}\n")
    return file


@pytest.fixture
def untimed(tmp_path):
    file = tmp_path / "untimed.yaml"
    file.write_text(TEXT)
    return file


@pytest.fixture(scope="module")
def expected():
    arm = hf.arms.load("planar-3r")
    torque = susceptibility.torque(arm, "worst-case")
    return hf.follow(arm, TimedPath(line(FIRST, LAST), Trapezoid(4.0)), minimise=torque, task="planar", samples=41)


def test_help_has_an_example(cli):
    code, out, _ = cli("follow", "--help")
    assert code == 0
    assert "Example: holdfast follow" in " ".join(out.split())


def test_json_is_the_library_s_answer(ask, path, expected):
    data = ask("follow", "planar-3r", path, *WISH, "--samples", 41, "--torque-bound", "2")
    assert data["tool_on_path"] is True
    assert data["task"] == "planar"
    assert data["value"]["start"] == expected.value[0]
    assert data["value"]["mean"] == expected.value.mean()
    assert list(data["q_end"].values()) == expected.q[-1].tolist()
    assert data["largest_rate_norm_per_s"] == expected.peak_rate
    assert data["time_scale"] == max(s.time_scale for s in expected.slowness(2.0))
    assert data["best_value"] is None
    assert data["events"] == []


def test_people_read_sentences_and_a_table(cli, path, expected):
    code, out, err = cli("follow", "planar-3r", path, *WISH, "--samples", 41, "--best", "--torque-bound", "2")
    assert (code, err) == (0, "")
    assert out.splitlines()[1].startswith("The end effector stays on its path (largest error ")
    assert "best of each pose" in out
    assert f"{expected.value.max():.4g}" in out
    assert " to keep all joint torques within 2 N m of the gravity torques: it must take at least " in out


def test_files(cli, untimed, tmp_path, expected):
    out, table, columns = tmp_path / "new" / "folder", tmp_path / "t.csv", tmp_path / "t.parquet"
    files = ("--out", out, "--csv", table, "--parquet", columns)
    code, said, _ = cli("follow", "planar-3r", untimed, *WISH, "--samples", 41, "--duration", 4, *files)
    assert code == 0
    assert said.count("written: ") == 4
    assert table.read_bytes() == (out / "trajectory.csv").read_bytes()
    rows = np.genfromtxt(table, delimiter=",", names=True)
    np.testing.assert_array_equal(rows["joint2_rad"], expected.q[:, 1])
    np.testing.assert_array_equal(parquet.read_table(columns)["joint2_rad"].to_numpy(), expected.q[:, 1])
    html = (out / "report.html").read_text(encoding="utf-8")
    assert "holdfast follow planar-3r" in html


def test_a_given_start_the_other_way_and_a_law(ask, path, expected):
    start = ",".join(f"{x:.12g}" for x in np.degrees(expected.q[0]))
    common = ("follow", "planar-3r", path, "--q", start, "--degrees", "--samples", 21)
    high = ask(*common, "--maximise", "torque:worst-case", "--rate-cap", 2)
    low = ask(*common, *WISH, "--rate-cap", 2)
    assert high["value"]["start"] == pytest.approx(low["value"]["start"])
    assert high["value"]["end"] > low["value"]["end"]
    assert high["better"] == "larger"
    assert high["largest_rate_norm_per_s"] <= 2 + 1e-9
    kept = ask(*common, *WISH, "--method", "augmented-jacobian", "--wanted", high["value"]["start"] * 1.2, "--gain", "10")
    assert kept["value"]["end"] == pytest.approx(high["value"]["start"] * 1.2, rel=1e-3)


def test_a_hand_off_its_path_is_said_first(cli, tmp_path):
    file = tmp_path / "p.yaml"
    file.write_text("line: {from: {xyz: [1.2, -0.1, 0]}, to: {xyz: [0.3, -0.1, 0]}}\n")
    call = ("follow", "planar-3r", file, "--minimise", "swing-angle:joint2", "--samples", 51, "--duration", 4)
    code, out, _ = cli(*call)
    assert code == 0
    assert out.splitlines()[1].startswith("The end effector leaves its path by up to ")
    assert "'joint3' is at its limit" in out
    code, out, _ = cli(*call, "--no-limits")
    assert out.splitlines()[1].startswith("The end effector stays on its path")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((), "give one of --minimise and --maximise"),
        ((*WISH, "--maximise", "torque"), "give one of --minimise and --maximise"),
        (("--minimise", "weight"), "objective 'weight' is not known"),
        ((*WISH, "--method", "fast"), "method 'fast' is not known"),
        ((*WISH, "--duration", "-1"), "duration is -1 s"),
        ((*WISH, "--samples", "1"), "samples is 1"),
        ((*WISH, "--q", "0,0"), "it must have 3"),
        ((*WISH, "--q", "0,0,0"), "from the first pose of the path"),
        ((*WISH, "--wanted", "1"), "for the augmented Jacobian"),
        ((*WISH, "--task", "pose"), "no self-motion to use"),
        ((*WISH, "--csv", "/nowhere/t.csv", "--samples", "5"), "cannot write motion"),
        ((*WISH, "--out", "/dev/null/x", "--samples", "5"), "cannot write to"),
        ((*WISH, "--torque-bound", "-1", "--samples", "5"), "bound"),
    ],
)
def test_what_is_wrong_is_one_sentence(cli, path, arguments, sentence):
    code, out, err = cli("follow", "planar-3r", path, *arguments)
    assert (code, out) == (2, "")
    assert sentence in err
    assert err.count("\n") == 1


def test_a_path_without_timing_needs_a_duration(cli, untimed, tmp_path):
    code, _, err = cli("follow", "planar-3r", untimed, *WISH)
    assert code == 2
    assert "give --duration 10" in err
    code, _, err = cli("follow", "planar-3r", tmp_path / "none.yaml", *WISH)
    assert code == 2
    assert "none.yaml" in err
