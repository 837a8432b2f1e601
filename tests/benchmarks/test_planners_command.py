"""``python -m benchmarks.planners``: a run, its files and page, and the same again."""

from __future__ import annotations

import json
import sys

import pytest
from benchmarks.planners.__main__ import main

pytest.importorskip("fcl")


def test_a_run_is_told_and_resumed(tmp_path, capsys, monkeypatch):
    words = ["panda", "--cases", "3", "--task", "reach-position", "--seconds", "5"]
    words += ["--planner", "recover", "--planner", "rrt-connect", "--out", str(tmp_path / "fa")]

    def run(*more):
        monkeypatch.setattr(sys, "argv", ["planners", *words, *more])
        return main(), *capsys.readouterr()

    code, out, err = run()
    assert code == 0, err
    assert "reach-position" in out
    assert {p.name for p in (tmp_path / "fa").iterdir()} >= {"cases.jsonl", "scores.csv", "report.html", "study.json"}
    page = (tmp_path / "fa" / "report.html").read_text()
    assert "recover finishes 3 of 3 cases, and 100 % of the 3" in page.replace("\N{NO-BREAK SPACE}", " ")
    assert "python -m benchmarks.planners panda --cases 3" in page
    lines = [json.loads(x) for x in (tmp_path / "fa" / "cases.jsonl").read_text().splitlines()]
    assert len(lines) == 3
    code, again, _ = run("--json")
    assert code == 0
    scores = json.loads(again)["scores"]
    assert [s["planner"] for s in scores] == ["recover", "rrt-connect"]
    assert all(s["solved"] == s["cases"] == 3 and s["contradictions"] == 0 for s in scores)
    code, _, err = run("--task", "reach")
    assert code == 2
    assert "task 'reach' is not known" in err
