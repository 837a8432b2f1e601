"""Sweeps of designs in study files: cells, rows against the library, the report, and what is refused."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.errors import InputError
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.kinematics.indices import by_name
from holdfast.studies import read_study_file
from holdfast.studies.designs import design_space
from holdfast.studies.designs.search import sample_comparison_poses
from holdfast.studies.study_files.results import read_design_sweep

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

TEXT = """
name: links
seed: 2
poses: 12
chunk: 6
arms:
  - planar-3r
  - {arm: planar-3r, vary: {a1: [0.6, 1.4], a2: 600..1400mm, lower2: [-180deg, -90deg]}, designs: 14, chunk: 6, level: 0.8}
assess: {tasks: [planar], regions: [bench.yaml], restarts: 20}
"""
REGION = "name: a bench\nbox: {center: [1.5, 0.6, 0], size: [0.8, 0.8, 0]}\n"


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    place = tmp_path_factory.mktemp("study")
    (place / "bench.yaml").write_text(REGION)
    (place / "links.yaml").write_text(TEXT)
    asked = read_study_file(place / "links.yaml")
    made = Study.create(place / "out", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    assert made.run(asked.cells, ThreadRunner(1)) == {}
    return made


def test_a_sweep_is_the_given_arm_and_designs_over_the_bounds(study):
    assert [c["labels"]["job"] for c in study.cells] == ["assess", "designs"]
    found = read_design_sweep(study, 1)
    space = design_space(arms.load("planar-3r"), {"a1": (0.6, 1.4), "a2": (0.6, 1.4), "lower2": (-np.pi, -np.pi / 2)})
    np.testing.assert_allclose(found.values, np.concatenate([space.start[None], space.draw(13, 2)]), atol=1e-15)
    assert found.start == 0
    np.testing.assert_allclose(found.reach, found.values[:, 0] + found.values[:, 1] + 1.0, atol=1e-9)


def test_rows_are_what_optimise_finds(study):
    """A design by itself, pose by pose, with the library's own optimiser."""
    found = read_design_sweep(study, 1)
    space = design_space(arms.load("planar-3r"), {"a1": (0.6, 1.4), "a2": (0.6, 1.4), "lower2": (-np.pi, -np.pi / 2)})
    poses, weights = sample_comparison_poses(hf.Region.from_dict(found.plan["region"]), 12, 2)
    assert weights is None
    k = 5
    arm = space.arm_of(found.values[k])
    best = hf.optimise(arm, poses, by_name("relative-manipulability", arm, "planar"))
    reached = best.status == hf.Status.OK
    value = np.sort(np.where(reached, best.value, 0.0))
    assert found.reached[k] == pytest.approx(reached.mean())
    assert found.guaranteed[k] == pytest.approx(value[2], abs=2e-5)  # the third of 12 is the 20 % quantile


def test_chunks_are_the_same_bits_however_they_are_computed(study, tmp_path):
    (tmp_path / "bench.yaml").write_text(REGION)
    (tmp_path / "links.yaml").write_text(TEXT)
    asked = read_study_file(tmp_path / "links.yaml")
    cell = asked.cells[1]
    cell.job.prepare(False)
    again = cell.job.run(cell.chunk_at(1, asked.seed))
    whole = read_design_sweep(study, 1)
    for name in ("guaranteed", "median", "reached", "reach"):
        assert np.array_equal(again[name], getattr(whole, name)[6:12])


def test_the_report_shows_the_sweep(study, tmp_path):
    page = study.report(tmp_path / "report.html").read_text().replace("\u00a0", " ")
    check(page)
    for words in ("Designs of planar-3r", "14 designs", "a bench", "rank correlation", "lower2, deg", "reach, m"):
        assert words in page, words


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("designs: 14", "designs: 0", "designs: 0 is wrong"),
        ("designs: 14, ", "", "designs: it is missing"),
        ("level: 0.8", "level: 1.5", "level: 1.5 is wrong"),
        ("level: 0.8", "levl: 0.8", "the key 'levl' is not known; the keys here are arm, base, tip, hold, vary, designs, "),
        ("a1: [0.6, 1.4]", "b1: [0.6, 1.4]", "vary 'b1' is not a parameter of an arm"),
        ("a1: [0.6, 1.4]", "a1: [1.4, 0.6]", "bounds of a1 are reversed"),
        ("a1: [0.6, 1.4]", "a1: 0.6", "a1 must have two bounds, as [0.2, 0.6] (m) or -90..90deg"),
        ("a1: [0.6, 1.4]", "a1: [0.6]", "a1 must have two bounds"),
        ("lower2: [-180deg, -90deg]", "lower2: [-180, -90]", "bounds of an angle need their unit"),
        ("vary: {a1: [0.6, 1.4], a2: 600..1400mm, lower2: [-180deg, -90deg]}", "vary: a1", "it must be names with their"),
        ("arm: planar-3r, ", "", "arm: it is missing"),
        ("restarts: 20}", "indices: [condition-number]}", "condition-number is better when smaller"),
        ("assess: {tasks: [planar], regions: [bench.yaml], restarts: 20}", "bank: {}", "there is no assess block for"),
        ("restarts: 20}", "restarts: 20}\nbank: {}", "designs of 'planar-3r' cannot be swept in bank"),
    ],
)  # fmt: skip
def test_refusals(tmp_path, old, new, words):
    assert old in TEXT
    (tmp_path / "bench.yaml").write_text(REGION)
    (tmp_path / "links.yaml").write_text(TEXT.replace(old, new))
    with pytest.raises(InputError) as error:
        read_study_file(tmp_path / "links.yaml")
    assert words in str(error.value)
    assert "\n" not in str(error.value)
