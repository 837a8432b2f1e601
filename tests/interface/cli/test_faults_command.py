"""``holdfast faults``."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from cells import placed

CALL = ["simulate", "panda", "--start", "0 0 0 -1.5 0 1.5 0", "--target", "0.3,0.4,0.6", "--task", "position"]
CALL += ["--law", "damped:0.02", "--gain", "2", "--speed-limit", "0.25"]


def test_the_command_prints_what_the_library_draws(cli, tmp_path):
    path = hf.faults.FaultModel([hf.faults.weak(gain=(0.2, 0.7), probability=0.5)], seed=1).save(tmp_path / "faults.yaml")
    arguments = ["faults", "draw", str(path), "--arm", "planar-3r", "--episodes", "4", "--seed", "9"]
    shown = json.loads(cli(*arguments, "--json")[1])
    batch = hf.faults.load(path).with_seed(9).batch(hf.arms.load("planar-3r"), episodes=4)
    assert [one["id"] for one in shown["episodes"]] == [events.id for events in batch.episodes]
    assert batch.describe()[0] in cli(*arguments)[1]


def test_the_whole_chain_by_one_command(ask, refused, tmp_path, monkeypatch):
    """A fault happens, bounds notice it, the page says when and what was done."""
    pytest.importorskip("mujoco")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "faults.yaml").write_text("faults: [{kind: locked, joints: [panda_joint4], onset: 0.4}]\n", encoding="utf-8")
    panda = hf.arms.load("panda")
    friction = {"coulomb": [0.5] * 7, "viscous": [0.3] * 7}
    hf.diagnosis.calibrate(panda, [hf.diagnosis.simulate_log(panda, 1.0, robot=0)], factor=3, **friction).to_json("bounds.json")
    found = ask(*CALL, "--physics", "--faults", "faults.yaml", "--monitor", "bounds.json", "--out", "chain")
    assert (found["ok"], found["react"], list(found["braked"])) == (True, "chain", ["panda_joint4"])
    assert found["noticed_s"] > 0.4
    ask(*CALL, "--physics", "--faults", "faults.yaml", "--monitor", "bounds.json", "--csv", "motion.csv")
    motion = np.genfromtxt("motion.csv", delimiter=",", names=True)
    k = np.searchsorted(motion["time_s"], 1.2)  # the brake is at 0.5 s, the end at 2 s and more
    hf.Cell([hf.cell.Sphere("lamp", 0.03, pose=placed(*(motion[f"tool_{axis}_m"][k] for axis in "xyz")))]).save("cell.yaml")
    clear = ask(
        *CALL, "--physics", "--faults", "faults.yaml", "--monitor", "bounds.json", "--cell", "cell.yaml", "--out", "cell"
    )
    assert (clear["ok"], clear["contacts"]) == (True, [])
    page = (tmp_path / "cell" / "report.html").read_text(encoding="utf-8")
    assert "or touch the cell" in page
    assert "lamp" in page
    assert {a["what"] for a in clear["actions"]} & {"detour", "plan"}
    page = (tmp_path / "chain" / "report.html").read_text(encoding="utf-8")
    assert "not a certified safety function" in page
    assert (tmp_path / "chain" / "chain.png").stat().st_size > 10_000
    assert "--monitor needs bodies, motors and sensors; add --physics" in refused(*CALL, "--monitor", "bounds.json")
    assert "--stop-at-contact does not go with" in refused(*CALL, "--physics", "--record", "run.npz", "--stop-at-contact")
    assert "--record needs bodies" in refused(*CALL, "--record", "run.npz")
    assert "--lock does not go with --faults" in refused(*CALL, "--physics", "--lock", "1", "--faults", "faults.yaml")


def test_bounds_of_its_own_loop(ask, cli, tmp_path, monkeypatch):
    """Records of healthy runs calibrate what watches the next; bounds too narrow alarm, and the run says that it is false."""
    pytest.importorskip("mujoco")
    monkeypatch.chdir(tmp_path)
    for side, name in (("0.4", "left.npz"), ("-0.4", "right.csv")):
        assert ask(*CALL[:5], f"0.3,{side},0.6", *CALL[6:], "--physics", "--record", name)["alarms"] == []
    alike = hf.faults.Log.load("left.npz"), hf.faults.Log.load("right.csv")
    assert [log.q.shape[1] for log in alike] == [7, 7]
    cli("calibrate", "left.npz", "right.csv", "--arm", "panda", "--out", "bounds.json")
    assert ask(*CALL, "--physics", "--monitor", "bounds.json")["noticed_s"] is None
    bounds = hf.diagnosis.load("bounds.json")
    replace(bounds, torque=bounds.torque / 4).to_json("narrow.json")
    found = cli(*CALL, "--physics", "--monitor", "narrow.json")[1]
    assert "This episode has no fault." in found
    assert "The first alarm is false, because no fault had begun" in found


def test_without_physics_faults_are_locks(ask, refused, tmp_path):
    path = tmp_path / "faults.yaml"
    path.write_text("faults: [{kind: locked, joints: [joint2], onset: 0.5}]\n", encoding="utf-8")
    call = ["simulate", "planar-3r", "--start", "20 40 60", "--degrees", "--target", "1.5,1.5"]
    assert ask(*call, "--faults", path) == ask(*call, "--lock", "2@0.5")
    path.write_text("faults: [{kind: limp, joints: [joint2], onset: 0.5}]\n", encoding="utf-8")
    assert "it needs bodies and motors; add --physics" in refused(*call, "--faults", path)
