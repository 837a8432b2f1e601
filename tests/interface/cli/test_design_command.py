"""``holdfast design``: answer, files, going on after a stop, and what it refuses."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.sweeps.memory import MEMORY_FILE

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

REGION = "name: a bench\nbox: {center: [1.5, 0.6, 0], size: [0.8, 0.8, 0]}\n"
SEARCH = ("planar-3r", "--vary", "a1=0.6..1.4", "--vary", "a3=0.6..1.4m", "--vary", "upper2=90..180deg", "--task", "planar",
          "--poses", "12", "--designs", "6", "--local-searches", "1", "--check-poses", "60", "--seed", "5")  # fmt: skip


@pytest.fixture(scope="module")
def region(tmp_path_factory):
    path = tmp_path_factory.mktemp("region") / "bench.yaml"
    path.write_text(REGION)
    return path


def test_a_search_and_its_files(cli, ask, region, tmp_path):
    out = tmp_path / "tool"
    found = ask("design", *SEARCH, "--region", region, "--out", out)
    assert set(found["best"]["values"]) == {"a1", "a3", "upper2"}
    assert found["given"]["values"] == {"a1": 1.0, "a3": 1.0, "upper2": pytest.approx(np.pi)}
    assert found["best"]["guaranteed_in_search"] >= found["given"]["guaranteed_in_search"]
    assert found["best"]["guaranteed"]["low"] <= found["best"]["guaranteed"]["value"] <= found["best"]["guaranteed"]["high"]
    assert found["bound"] == pytest.approx(np.sqrt(1 / 3))
    assert (found["fresh_poses"], found["level"], found["region"]) == (60, 0.95, "a bench")
    reaches = [d["reach"] for d in found["front"]]
    values = [d["guaranteed"] for d in found["front"]]
    assert reaches == sorted(reaches)
    assert values == sorted(values, reverse=True)
    assert {f.name for f in out.iterdir()} == {"report.html", "best-arm.yaml", "designs.csv", "region.yaml", MEMORY_FILE}

    best = arms.load(str(out / "best-arm.yaml"))
    q = np.random.default_rng(1).uniform(-1, 1, (5, 3))
    design = found["best"]["values"]
    turn = np.cumsum(q, axis=1)
    x = (np.array([design["a1"], 1.0, design["a3"]]) * np.cos(turn)).sum(axis=1)
    np.testing.assert_allclose(best.forward_kinematics(q)[:, 0, 3], x, atol=1e-12)
    assert best.upper[1] == pytest.approx(design["upper2"], abs=1e-12)
    assert hf.Region.load(out / "region.yaml").describe() == hf.Region.load(region).describe()
    rows = list(csv.DictReader((out / "designs.csv").read_text().splitlines()))
    assert len(rows) == found["designs"]
    assert float(rows[0]["a1 (m)"]) == 1.0
    assert sum(int(r["on the front"]) for r in rows) == len(found["front"])

    # The report says what was found, and the command in it is one that the program takes.
    page = (out / "report.html").read_text().replace("\u00a0", " ")
    check(page)
    for words in ("Best design", "a bench", "planar-3r-design", "--vary a1=0.6..1.4m", "--check-poses 60"):
        assert words in page, words
    # A search that lost its last parts makes only those, with the same bits; one that is complete is not made again.
    memory = out / MEMORY_FILE
    before = memory.read_bytes()
    memory.write_bytes(b"\n".join(before.splitlines()[:-2]) + b"\n" + before.splitlines()[-2][:30])
    assert ask("design", *SEARCH, "--region", region, "--out", out)["best"] == found["best"]
    assert memory.read_bytes() == before
    code, _, err = cli("design", *SEARCH[:-1], "6", "--region", region, "--out", out)
    assert code == 2
    assert "holds another search: its seed is 5, but 6 was requested" in err
    code, told, err = cli("design", *SEARCH, "--region", region, "--out", out)
    assert (code, err) == (0, "")
    assert "whichever joint locks" in told or "the best design keeps" in told
    assert "best-arm.yaml" in told
    assert memory.read_bytes() == before


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ((), "--vary"),
        (("--vary", "b3=0..1"), "'b3' is not a parameter of an arm"),
        (("--vary", "a3=1.4..0.6"), "bounds of a3 are reversed: 1.4 m is above 0.6 m"),
        (("--vary", "theta3=-90..90"), "bounds of an angle need their unit; write theta3=-90..90deg"),
        (("--vary", "a3=0.1..0.5"), "a3 of 'planar-3r' is 1 m, outside the bounds 0.1 m to 0.5 m"),
        (("--vary", "a4=0..1"), "'planar-3r' has no row 4"),
        (("--vary", "lower3=-180..190deg"), "the limits of joint 'joint3' can cross"),
        (("--vary", "a3=0.5..2", "--level", "1"), "level is 1; it must be between 0 and 1"),
        (("--vary", "a3=0.5..2", "--local-searches", "-1"), "local_searches is -1; it must be 0 or more"),
        (("--vary", "a3=0.5..2", "--maximise", "condition-number"), "better when smaller"),
        (("--vary", "a3=0.5..2", "--maximise", "dexterity"), "dexterity"),
        (("--vary", "alpha1=-10..10deg"), "alpha1 would move 'planar-3r' out of the plane of its task"),
        (("--vary", "a3=0.5..2", "--region", "none.yaml"), "none.yaml"),
        (("--vary", "a3=0.5..2", "--out", "/proc/none"), "cannot write to"),
    ],
)  # fmt: skip
def test_refusals(refused, options, words):
    assert words in refused("design", "planar-3r", *options, "--poses", "8", "--designs", "4")


def test_a_search_for_convergence(cli, ask, tmp_path):
    options = ("planar-3r", "--vary", "a2=0.6..1.4", "--vary", "a3=0.6..1.4", "--designs", "2", "--local-searches", "0")
    found = ask(
        "design", *options, "--maximise", "convergence", "--law", "damped:0.1", "--keep-reach", "--out", tmp_path / "new"
    )
    assert (found["exact"], found["law"]) == (True, "damped:0.1")
    assert sum(found["best"]["values"].values()) == pytest.approx(2.0)
    assert {f.name for f in (tmp_path / "new").iterdir()} == {"designs.csv", "best-arm.yaml", "report.html"}


def test_a_law_without_convergence_is_refused(refused):
    assert "convergence" in refused("design", "planar-3r", "--vary", "a2=0.6..1.4", "--law", "damped:0.1")
