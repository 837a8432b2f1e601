"""``holdfast simulate-logs``, ``calibrate`` and ``diagnose``, one after the other."""

from __future__ import annotations

import json

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.faults import Log


def test_from_records_to_a_page(cli, tmp_path):
    faults = hf.faults.FaultModel([hf.faults.locked("panda_joint4", onset=0.7)]).save(tmp_path / "faults.yaml")
    assert cli("simulate-logs", "panda", "--records", 3, "--duration", 2, "--out", tmp_path / "healthy")[0] == 0
    assert cli("simulate-logs", "panda", "--duration", 1, "--faults", faults, "--seed", 9, "--out", tmp_path / "run")[0] == 0
    logs, known, log = sorted((tmp_path / "healthy").glob("*.npz")), tmp_path / "bounds.json", tmp_path / "run" / "000000.npz"
    code, out, _ = cli("calibrate", *logs, "--arm", "panda", "--coulomb", 0.5, "--viscous", 0.3, "--out", known)
    assert code == 0
    assert "thresholds come from 3 logs" in out
    options = ("--arm", "panda", "--bounds", known)
    code, out, _ = cli("diagnose", log, *options, "--json")
    assert code == 3
    told = json.loads(out)
    assert (told["joint"], told["kind"]) == ("panda_joint4", "locked")
    code, out, _ = cli("diagnose", log, *options, "--out", tmp_path / "page")
    assert "panda_joint4 is locked" in out
    assert "does not prove that the arm has no fault" in (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    code, out, _ = cli("diagnose", logs[0], *options)
    assert code == 0
    assert "No fault was detected in 1.999 s." in out
    code, _, error = cli("diagnose", faults, *options)
    assert code == 2
    assert "it is not an .npz file of numbers" in error
    assert Log.load(log).n == 7


def test_a_lock_is_found_by_a_self_motion(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("identify", "panda", "--at", "0 -0.4 0.3 -2 0.2 1.8 0.5", "--csv", "probe.csv")
    assert code == 0
    assert "can identify a lock of 7 of 7 candidate joints" in out
    arm, (q, rate) = hf.arms.load("panda"), hf.diagnosis.read_motion(hf.arms.load("panda"), "probe.csv")
    assert rate == pytest.approx(100)
    code, out, _ = cli("predict-detection", "probe.csv", "--arm", "panda", "--json")
    assert json.loads(out)["not_shown"] == []
    fault = [hf.faults.FaultEvent("locked", "panda_joint6", 0.0)]
    motion = np.stack([np.interp(np.arange(1200) / 1000, np.arange(len(q)) / 100, column) for column in q.T], axis=1)
    hf.diagnosis.simulate_log(arm, motion=motion, faults=fault, seed=3).save("run.npz")
    code, out, _ = cli("identify", "panda", "--record", "run.npz", "--suspects", "2,panda_joint6")
    assert code == 3
    assert "anda_joint6 is locked; decided after" in out
    code, _, error = cli("identify", "panda")
    assert code == 2
    assert "give either --at, to plan a motion, or --record, to evaluate its log" in error
