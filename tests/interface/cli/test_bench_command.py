"""``holdfast bench``: a run, its files and page, and the same again."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("fcl")


def test_a_run_is_told_and_resumed(tmp_path, cli):
    words = ["bench", "fail-active", "panda", "--cases", "3", "--task", "reach-position", "--seconds", "5"]
    words += ["--planner", "recover", "--planner", "rrt-connect", "--out", str(tmp_path / "fa")]
    code, out, err = cli(*words)
    assert code == 0, err
    assert "reach-position" in out
    assert {p.name for p in (tmp_path / "fa").iterdir()} >= {"cases.jsonl", "scores.csv", "report.html", "study.json"}
    lines = [json.loads(x) for x in (tmp_path / "fa" / "cases.jsonl").read_text().splitlines()]
    assert len(lines) == 3
    code, again, _ = cli(*words, "--json")
    assert code == 0
    scores = json.loads(again)["scores"]
    assert [s["planner"] for s in scores] == ["recover", "rrt-connect"]
    assert all(s["solved"] == s["cases"] == 3 and s["contradictions"] == 0 for s in scores)
