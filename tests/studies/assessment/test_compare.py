"""Several assessments side by side: what the table says, what may be compared, and the page."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.formatting import format_interval, format_percent, insert_nonbreaking_spaces
from holdfast.interface.presentation.renderers import build_page, present
from holdfast.interface.report.page import render
from holdfast.model.arms.tool import format_tool_pose, tool_pose_from_numbers
from holdfast.studies.assessment import load_comparison

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

PANDA, SEVEN = hf.arms.load("panda"), hf.arms.load("pa10-7dof")
CELL = hf.Region.box([0.45, 0, 0.45], 0.2, [0, 0, np.pi], np.pi / 4, name="cell")
SIDE = PANDA.with_tool(tool_pose_from_numbers([0.05, 0, 0.1, 90, 0, 0]))


@pytest.fixture(scope="module")
def runs():
    return [
        hf.assess(PANDA, CELL, poses=30, seed=1, restarts=20, optimise=True, after_lock=True),
        hf.assess(SIDE, CELL, poses=30, seed=1, restarts=20, optimise=True),
        hf.assess(SEVEN, CELL, poses=30, seed=1, restarts=20),
        hf.assess(PANDA, CELL, poses=30, seed=1, restarts=20, task="position"),
    ]


@pytest.fixture(scope="module")
def comparison(runs):
    return hf.compare_assessments(runs, ["straight", "side", "pa10", "position"], 0.05)


def test_the_table_is_that_of_the_runs(runs, comparison):
    assert [r["name"] for r in comparison.table] == ["straight", "side", "pa10", "position"]
    for r, a in zip(comparison.table, runs, strict=True):
        values = a.dataset["index"].values
        reached = values[np.isfinite(values)]
        assert (r["arm"], r["task"], r["poses"]) == (a.arm.name, a.index.task.name, 30)
        assert r["redundancy"] == a.arm.n - a.index.task.m
        assert r["reached"] == len(reached) / 30
        assert r["reached_low"] <= r["reached"] <= r["reached_high"]
        assert r["probability"] == (reached >= 0.05).sum() / 30
        p = a.interval(at_least=0.05)
        assert (r["probability_low"], r["probability_high"]) == (p.low, p.high)
        assert r["median"] == np.sort(reached)[int(np.ceil(len(reached) / 2)) - 1]
        counts = np.bincount(a.dataset["worst"].values[np.isfinite(values)], minlength=7)
        assert r["worst_joint"] == a.arm.joint_names[counts.argmax()]
        assert r["worst_fraction"] == counts.max() / counts.sum()
        u = a.upgrades(0.05)[0]
        assert (r["upgrade"], r["upgrade_gain"]) == (u.joint if u.gain else None, u.gain)
    straight, _, pa10, position = comparison.table
    left = runs[0].dataset["survives"].values == 1
    assert straight["expected_survival"] == pytest.approx(left.mean())
    best = runs[0].dataset["optimised_index"].values
    assert straight["optimised_probability"] == np.mean(np.nan_to_num(best) >= 0.05)
    assert straight["optimised_gap"] < straight["gap"]
    assert pa10["optimised_probability"] is None is pa10["expected_survival"]
    assert pa10["single_points_of_failure"] == ["joint4"]
    assert position["single_points_of_failure"] == []


def test_the_best(comparison, runs):
    assert comparison.best() == comparison.ranking()[0] == "position"
    assert comparison.ranking("pose")[-1] == "pa10"
    two = hf.compare_assessments(runs[:2], ["straight", "side"], 0.05)
    rows = {r["name"]: r for r in two.table}
    best = max(rows, key=lambda n: (rows[n]["optimised_probability"], rows[n]["optimised_median"]))
    assert two.best(optimised=True) == best
    with pytest.raises(hf.InputError, match=r"no candidate has task 'planar'; use pose, position"):
        comparison.best("planar")
    with pytest.raises(hf.InputError, match="not optimised"):
        comparison.best(optimised=True)
    with pytest.raises(hf.InputError, match="candidate 'x' is not known"):
        comparison.upgrades("x")


def test_what_differs_is_said(comparison, runs):
    text = " ".join(comparison.notes)
    assert "The tasks differ (pose, position)" in text
    assert "Only some candidates were optimised" in text
    assert hf.compare_assessments(runs[:2], ["a", "b"]).notes == []
    other = hf.assess(PANDA, CELL, hf.indices.relative_manipulability(PANDA, failures=[[1]]), poses=30, seed=2, restarts=5)
    text = " ".join(hf.compare_assessments([runs[0], other], ["a", "b"]).notes)
    assert "a: each joint alone; b: panda_joint2" in text
    assert "Seeds" in text
    assert "restarts" in text


def test_default_names_and_threshold(runs):
    assert hf.compare_assessments([runs[0], runs[2]]).names == ("panda", "pa10-7dof")
    both = hf.compare_assessments([runs[0], runs[3]])
    assert both.names == ("panda, pose", "panda, position")
    assert both.threshold == 0.19  # half of sqrt(1/7), the smaller bound
    assert not both.chosen


def test_what_cannot_be_compared(runs):
    few = hf.assess(PANDA, CELL, poses=10)
    moved = hf.assess(PANDA, hf.Region.box([0.4, 0, 0.45], 0.2), poses=30)
    other = hf.assess(PANDA, CELL, "manipulability", poses=30)
    first = runs[0]
    for pair, words in (
        ([first], "needs two"),
        ([first, moved], "'b' was assessed over another region than 'a'"),
        ([first, few], "'b' has 10 computed poses, 'a' has 30"),
        ([first, other], "'b' has the manipulability, 'a' the relative manipulability"),
    ):
        with pytest.raises(hf.InputError, match=words):
            hf.compare_assessments(pair, list("ab")[: len(pair)])
    with pytest.raises(hf.InputError, match="two candidates have the name 'x'"):
        hf.compare_assessments(runs[:2], ["x", "x"])
    with pytest.raises(hf.InputError, match="1 names for 2"):
        hf.compare_assessments(runs[:2], ["x"])
    with pytest.raises(hf.InputError, match="threshold is inf"):
        hf.compare_assessments(runs[:2], ["x", "y"], np.inf)


def test_an_empty_headline_says_who_is_nearest_and_why(runs):
    two = hf.compare_assessments([runs[0], runs[2]], ["straight", "pa10"], 0.99)
    line = present(two).answer
    assert "No candidate keeps" in line
    straight = two.table[0]
    assert f"straight has the best median. A lock of {straight['worst_joint']} is the worst failure" in line
    assert f"The median of the reached poses is {straight['median']:.3f}" in line
    assert f"at the best configuration of each pose it is {straight['optimised_median']:.3f}" in line


@pytest.mark.parametrize("some", [slice(3), slice(4)])
def test_the_threshold_of_the_page_has_the_answers_that_python_gives(runs, some):
    names = ["straight", "side", "pa10", "position"][some]
    html = render(build_page(present(hf.compare_assessments(runs[some], names, 0.05))))
    box = re.search(r'<div[^>]* data-extra="threshold".*?<script[^>]*>(.*?)</script>', html, re.DOTALL)
    labels = re.findall(r"<dt>(.*?)</dt>", box[0])
    data = json.loads(box[1])
    assert len(data["values"]) > 50
    assert 0.05 in data["values"]
    answers = dict(zip(labels, data["answers"], strict=True))
    for name, run in zip(names, runs[some], strict=True):
        assert answers.pop(name) == [
            insert_nonbreaking_spaces(format_interval(run.interval(at_least=x))) for x in data["values"]
        ]
        if run.optimised is not None:
            told = [
                insert_nonbreaking_spaces(format_interval(run.interval(at_least=x, optimised=True))) for x in data["values"]
            ]
            assert answers.pop(f"{name}, best configurations") == told
    # Who leads is said only of candidates with one task.
    assert list(answers) == ["Largest probability"] * (some.stop == 3)
    for x, text in zip(data["values"], answers.get("Largest probability", []), strict=False):
        each = sorted((run.interval(at_least=x) for run in runs[some]), key=lambda p: -p.value)
        if each[0].value == each[-1].value:
            assert text == "all equal"
        elif each[0].value == each[1].value:
            assert text.endswith(", equal")
        else:
            best = max(names, key=lambda name: runs[names.index(name)].interval(at_least=x).value)
            assert text == best + ("; its interval overlaps with that of the next" if each[1].high >= each[0].low else "")


def test_the_page(comparison, runs, tmp_path):
    html = comparison.report(tmp_path / "r.html").read_text(encoding="utf-8")
    check(html)
    words = re.sub(r"<svg.*?</svg>", "", html, flags=re.DOTALL).replace("\u00a0", " ")
    assert "nan" not in words.lower()
    assert "The tasks differ" in words
    assert words.index("Distribution of the index") < words.index("Numbers")
    for r in comparison.table:
        assert format_percent(r["probability"]) in words
    u = comparison.upgrades("straight")[0]
    assert u.joint in words
    assert "--tool tool=0.05,0,0.1,90,0,0" in words
    loose = [hf.assess(PANDA, CELL, "condition-number", poses=8, keep=False) for _ in range(2)]
    html = hf.compare_assessments(loose, ["<a>", "$b$"]).report(tmp_path / "s.html").read_text(encoding="utf-8")
    check(html)
    assert "were not stored" in html
    nothing = hf.Region.box([5, 0, 0], 0.1)
    lost = [hf.assess(arm, nothing, poses=4, restarts=1) for arm in (PANDA, SEVEN)]
    html = hf.compare_assessments(lost).report(tmp_path / "t.html").read_text(encoding="utf-8")
    check(html)
    assert "No candidate keeps a relative manipulability" in html


def test_a_folder_of_it(runs, tmp_path):
    two = hf.compare_assessments(runs[:2], ["straight", "side"], 0.05, tools=[None, "bent"])
    out = tmp_path / "cell"
    assert two.save(out) == [out / "comparison.json", out / "report.html"]
    assert sorted(p.name for p in out.iterdir()) == ["comparison.json", "report.html", "side", "straight"]
    back = load_comparison(out, 0.05)
    assert (back.names, back.tools, back.table, back.notes) == (two.names, two.tools, two.table, two.notes)
    assert hf.load(out / "side").arm.fingerprint == SIDE.fingerprint
    with pytest.raises(hf.InputError, match="candidate 'a/b' is not a valid folder name"):
        hf.compare_assessments(runs[:2], ["a/b", "c"]).save(tmp_path / "other")
    assert not (tmp_path / "other").exists()
    with pytest.raises(hf.InputError, match="there are 1 tools for 2 assessments"):
        hf.compare_assessments(runs[:2], ["a", "b"], tools=["x"])


def test_what_it_says_in_sentences(comparison):
    answer, notes = comparison.describe()
    assert f"pose, {comparison.best('pose')} with {format_interval(comparison.interval(comparison.best('pose')))}; " in answer
    assert f"position, position with {format_interval(comparison.interval('position'))}." in answer
    assert notes == f"Before you compare: {' '.join(comparison.notes)}"


def test_six_numbers_of_a_tool(rng):
    """Against the definition Rz(yaw) Ry(pitch) Rx(roll), and there and back."""
    from scipy.spatial.transform import Rotation

    for arm in (PANDA, SEVEN):
        x = np.r_[rng.uniform(-1, 1, 3), rng.uniform(-80, 80, 3)]
        pose = tool_pose_from_numbers(x)
        np.testing.assert_allclose(pose[:3, :3], Rotation.from_euler("xyz", x[3:], degrees=True).as_matrix(), atol=1e-12)
        np.testing.assert_array_equal(pose[:3, 3], x[:3])
        again = [float(v) for v in format_tool_pose(arm.with_tool(pose)).split(",")]
        np.testing.assert_allclose(again, x, atol=1e-9)
