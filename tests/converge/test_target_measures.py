"""Measures over targets against one workspace analysis for each target."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import holdfast as hf
from holdfast.cli.app import main


def test_each_target_is_a_workspace_of_its_own(three, tmp_path):
    goals = np.array([[1.5, 1.5], [-0.7, 2.0], [4.0, 0.0]])
    starts = np.array([[2.0, -1.4], [0.7, 2.1], [-2.0, 0.5]])
    found = hf.target_measures(three, goals, starts, configurations=6, points=2, cells=40)
    for k in (0, 1):
        one = hf.workspace(three, goals[k], starts, 6, 2, cells=40)
        for name, values in one.measures.items():
            known = np.ma.masked_invalid(values)
            np.testing.assert_allclose(found.measures[name][k], known.mean(axis=0).filled(np.nan))
        np.testing.assert_array_equal(found.ends[k], one.ends.sum(axis=0))
    assert all(np.isnan(v[2]).all() for v in found.measures.values())
    assert found.describe()[0].count("2 of 3 targets") == 1
    files = found.save(tmp_path)
    rows = list(csv.DictReader(files[0].read_text(encoding="utf-8").splitlines()))
    assert float(rows[1]["Ravg_any_percent"]) == pytest.approx(found.measures["Ravg"][1, -1])
    assert rows[2]["Ravg_any_percent"] == ""


def test_on_the_command_line(tmp_path, monkeypatch, capsys):
    command = ["holdfast", "workspace", "planar-3r", "--target", "grid:3", "--starts", "4", "--configurations", "3"]
    monkeypatch.setattr("sys.argv", [*command, "--points", "1", "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit) as done:
        main()
    assert done.value.code == 0
    assert "targets within reach of motions from 4 starts" in capsys.readouterr().out
    assert {f.name for f in (tmp_path / "out").iterdir()} == {
        "targets.csv",
        "targets.json",
        "targets-reach.png",
        "targets-finish.png",
    }
