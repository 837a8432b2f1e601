"""--cell of simulate and follow: what is touched or kept clear of, in words, JSON, CSV and on the page."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

CALL = ["simulate", "planar-2r", "--start", "0 0.2", "--target", "1.2 1.2", "--lock", "1"]
CELL = "objects:\n  wall: {box: [4, 1, 1], pose: {xyz: [1, 1.3, 0]}}\n"
TIP = "links:\n  joint2: [{from: [1, 0, 0], radius: 0.05}]\n"
AT = np.arcsin(0.75)  # rad: the tip of 0.05 m at the wall's lower side, 0.8 m


@pytest.fixture
def around(tmp_path):
    cell, capsules = tmp_path / "cell.yaml", tmp_path / "tip.yaml"
    cell.write_text(CELL)
    capsules.write_text(TIP)
    return ["--cell", cell, "--capsules", capsules]


def test_a_run_says_what_it_touches(cli, ask, around, tmp_path):
    code, out, err = cli(*CALL, *around, "--csv", tmp_path / "run.csv", "--out", tmp_path / "run")
    assert (code, err) == (0, "")
    said = " ".join(out.split())
    assert "At 0.4377 s joint2 touches wall" in said
    data = ask(*CALL, *around)
    (contact,) = data["contacts"]
    assert (contact["link"], contact["object"]) == ("joint2", "wall")
    assert data["clearance"]["cell"]["objects"] == ["wall"]
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["clearance_m"], 0.8 - 0.05 - np.sin(table["joint2_rad"]), atol=1e-12)
    assert np.interp(contact["time_s"], table["time_s"], table["clearance_m"]) == pytest.approx(0, abs=1e-4)
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    check(page)
    assert "Contacts" in page
    assert "At 0.4377 s joint2 touches wall" in page
    plain = json.loads(cli(*CALL, "--json")[1])
    assert plain == {name: value for name, value in data.items() if name not in ("contacts", "clearance")}


def test_a_run_stops_at_its_contact(ask, around):
    data = ask(*CALL, *around, "--stop-at-contact")
    assert (data["outcome"], data["reason"]) == ("stuck", "contact")
    assert data["q_final"]["joint2"] == pytest.approx(AT, abs=1e-8)
    assert data["time_s"] == data["stopped_at_s"] == data["contacts"][0]["time_s"]


def test_what_has_nothing_to_touch_is_refused(refused, around, tmp_path):
    assert "--stop-at-contact needs objects to touch; add --cell" in refused(*CALL, "--stop-at-contact")
    assert "--capsules describes an arm that touches an environment" in refused(*CALL, *around[2:])
    assert "--radius describes an arm that touches" in refused(*CALL, "--radius", "0.1")
    assert "missing.yaml" in refused(*CALL, "--cell", tmp_path / "missing.yaml")


def test_a_path_is_followed_clear_of_a_cell(cli, refused, tmp_path):
    path, cell = tmp_path / "path.yaml", tmp_path / "cell.yaml"
    path.write_text("line: {from: {xyz: [1.9, -1.9, 0]}, to: {xyz: [0.9, -1.9, 0]}}\ntiming: {duration: 10}\n")
    cell.write_text("margin: 0.01\nobjects: {post: {cylinder: {radius: 0.1, length: 1}, pose: {xyz: [1.2, 0.1, 0]}}}\n")
    call = ["follow", "planar-3r", path, "--maximise", "relative-manipulability", "--method", "none", "--samples", "51"]
    start = ["--q", "-0.12,-0.91,-0.05"]
    code, out, err = cli(*call, "--cell", cell, "--csv", tmp_path / "motion.csv", "--out", tmp_path / "out")
    assert code == 0, err
    table = np.genfromtxt(tmp_path / "motion.csv", delimiter=",", names=True)
    assert table["clearance_m"].min() >= 0.01 - 1e-4
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    check(page)
    assert "Smallest distance over all pairs" in page
    assert "smallest clearance" in " ".join(out.split()).lower()
    assert "--margin has no effect" in refused(*call, *start, "--margin", "0.1")
