"""``holdfast rehearse``, ``calibrate`` and ``diagnose``, one after the other."""

from __future__ import annotations

import json

import holdfast as hf
from holdfast.faults import Log


def test_from_records_to_a_page(cli, tmp_path):
    faults = hf.faults.Faults([hf.faults.locked("panda_joint4", onset=0.7)]).save(tmp_path / "faults.yaml")
    assert cli("rehearse", "panda", "--records", 3, "--duration", 2, "--out", tmp_path / "healthy")[0] == 0
    assert cli("rehearse", "panda", "--duration", 1, "--faults", faults, "--seed", 9, "--out", tmp_path / "run")[0] == 0
    logs, known, log = sorted((tmp_path / "healthy").glob("*.npz")), tmp_path / "bounds.json", tmp_path / "run" / "000000.npz"
    code, out, _ = cli("calibrate", *logs, "--arm", "panda", "--coulomb", 0.5, "--viscous", 0.3, "--out", known)
    assert code == 0
    assert "bounds of 3 records" in out
    options = ("--arm", "panda", "--bounds", known)
    code, out, _ = cli("diagnose", log, *options, "--json")
    assert code == 3
    told = json.loads(out)
    assert (told["joint"], told["kind"]) == ("panda_joint4", "locked")
    code, out, _ = cli("diagnose", log, *options, "--out", tmp_path / "page")
    assert "panda_joint4 is locked" in out
    assert "does not prove that nothing is wrong" in (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    code, out, _ = cli("diagnose", logs[0], *options)
    assert code == 0
    assert out.startswith("no fault seen in 1.999 s")
    code, _, error = cli("diagnose", faults, *options)
    assert code == 2
    assert "it is no .npz file of numbers" in error
    assert Log.load(log).n == 7
