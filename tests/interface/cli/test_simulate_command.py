"""``holdfast simulate``: what it prints, writes and draws."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
import holdfast as hf
from wellformed import check

CALL = ["simulate", "planar-2r", "--start", "0 -30", "--degrees", "--lock", "1"]


def test_json_is_the_published_case_c(cli):
    code, out, err = cli(*CALL, "--target", "0,1.7320508", "--json")
    assert (code, err) == (0, "")
    data = json.loads(out)
    assert data["outcome"] == "stuck"
    assert data["reason"] == "none"
    assert data["error"] == pytest.approx(1.133893, abs=1e-5)
    assert data["position_error_m"]["end"] == pytest.approx(1.133893, abs=1e-5)
    assert data["least_error"] == pytest.approx(1, abs=1e-6)
    assert len(data["locked"]) == 1
    assert list(data["locked"].values()) == [0]
    assert np.rad2deg(list(data["q_final"].values())[1]) == pytest.approx(-261.7868, abs=1e-3)


def test_a_motion_is_printed_written_and_drawn(cli, tmp_path):
    table, figure = tmp_path / "run.csv", tmp_path / "run.png"
    code, out, err = cli(*CALL, "--target", "1.7071068 0.7071068", "--csv", table, "--plot", figure)
    assert (code, err) == (0, "")
    assert "reaches its target" in out
    assert "locked" in out
    assert "-315 deg" in out
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    assert table.read_text().startswith("time_s,")
    assert rows.shape == (1001, 7)
    assert rows[-1, -1] < 1e-2  # mm
    assert (rows[:, 1] == 0).all()
    assert matplotlib.image.imread(figure).shape[1] > 600


def test_a_run_with_its_lock_is_a_page_with_the_arm_moving(cli, tmp_path):
    out = tmp_path / "run"
    code, said, err = cli(*CALL, "--target", "0,1.7320508", "--out", out)
    assert (code, err) == (0, "")
    assert all(str(out / name) in said for name in ("run.csv", "run.png", "report.html"))
    page = (out / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    check(page)
    assert "After an undetected lock of joint1 at the start, the arm stops 1,134 mm off its target" in page
    assert "locked: joint1" in page
    data = json.loads(re.search(r'<script type="application/json">(.*?)</script>', page)[1])
    assert data["locked"] == [0, None]
    assert "holdfast simulate planar-2r" in page
    assert matplotlib.image.imread(out / "run.png").shape[1] > 900
    assert np.loadtxt(out / "run.csv", delimiter=",", skiprows=1)[-1, -1] == pytest.approx(1133.893, abs=1e-2)


PAST = ["simulate", "panda", "--task", "position", "--start", "0 -45 0 -135 0 90 45", "--degrees", "--lock", "4"]
FAR = "--target=-0.217,0.028,0.034"  # reached by the law, through what the limits of joints 2 and 6 forbid


def test_reaching_the_target_and_keeping_the_limits_are_two_facts(cli, tmp_path):
    code, said, _ = cli(*PAST, FAR, "--out", tmp_path)
    assert code == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    table = np.loadtxt(tmp_path / "run.csv", delimiter=",", skiprows=1)
    low, high = (np.degrees(f(table[:, 1:8], axis=0)) for f in (np.min, np.max))
    # Limits of the manufacturer's data sheet, degrees.
    limits = np.array([[-166, 166], [-101, 101], [-166, 166], [-176, -4], [-166, 166], [-1, 215], [-166, 166]])
    past = np.flatnonzero((low < limits[:, 0] - 1) | (high > limits[:, 1] + 1))
    assert past.tolist() == [1, 5]
    for text in (" ".join(said.split()), page):
        assert "the arm reaches its target after" in text
        assert "On the way panda_joint2 goes to -188.9 deg (limit -101" in text
        assert "and panda_joint6 goes to -24.27 deg (limit -1" in text
        assert "a real arm would stop there" in text
    assert low[[1, 5]] == pytest.approx([-188.9, -24.27], abs=0.05)
    data = json.loads(cli(*PAST, FAR, "--json")[1])
    assert data["outcome"] == "converged"
    assert data["limits_passed"] == ["panda_joint2", "panda_joint6"]
    assert np.degrees(data["limits"]["panda_joint2"]) == pytest.approx(limits[1], abs=1)


def test_a_motion_within_the_limits_says_so(cli):
    code, said, _ = cli(*PAST, "--target", "0.598,-0.104,0.241")
    assert code == 0
    assert "All joints stay within their limits." in said


def test_without_limits_there_is_nothing_to_keep():
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0)] * 3)
    runs = hf.simulate(hf.control.pseudoinverse(arm, "planar"), [[0.3, 0.7, 1.0]] * 2, [1.0, 1.2])
    assert runs.limits_sentence(1) == ""


def test_a_lock_on_the_way_is_marked_from_then_on(cli, tmp_path):
    out = tmp_path / "run"
    code, _, _ = cli("simulate", "planar-3r", "--start", "0.3 0.7 1", "--target", "-0.5,1", "--lock", "2@0.5", "--out", out)
    assert code == 0
    page = (out / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    data = json.loads(re.search(r'<script type="application/json">(.*?)</script>', page)[1])
    assert data["locked"] == [None, 0.5, None]
    assert "locked" not in data["readings"][0]
    assert data["readings"][-1].endswith("locked: joint2")
    assert "joint2 locks" in page


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
        (["--target", "1"], "--target has 1 number; task 'planar' needs 2"),
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


def test_a_target_by_angles_is_that_by_a_quaternion(cli):
    """SciPy converts; degrees, in the order of URDF."""
    angles = [170.0, 10.0, 40.0]
    quaternion = Rotation.from_euler("xyz", angles, degrees=True).as_quat()
    words = ["simulate", "panda", "--start", "0 -45 0 -135 0 90 45", "--degrees", "--lock", "4", "--time-limit", "20", "--json"]
    finals = []
    for numbers in (angles, quaternion):
        code, out, err = cli(*words, f"--target=0.45,0.1,0.5,{','.join(repr(float(x)) for x in numbers)}")
        assert (code, err) == (0, "")
        finals.append(list(json.loads(out)["q_final"].values()))
    np.testing.assert_allclose(*finals, atol=1e-7)


def test_a_lock_with_bounds_is_a_fault_of_the_robot(cli, monkeypatch, tmp_path):
    """With --physics and --record or --monitor, --lock is a locked fault, as a faults file would have it."""
    asked = {}

    class StoppedError(Exception):
        pass

    def simulate_faults(*_, **options):
        asked.update(options)
        raise StoppedError

    monkeypatch.setattr(hf, "simulate_faults", simulate_faults)
    with pytest.raises(StoppedError):
        cli(*CALL, "--target", "1.5,0.5", "--lock", "2@0.8", "--physics", "--record", tmp_path / "a.npz")
    assert [(e.kind, e.joint, e.onset) for e in asked["faults"]] == [("locked", "joint1", 0.0), ("locked", "joint2", 0.8)]
