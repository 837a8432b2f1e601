"""A cell around the arms of a study: what hits it, against plane geometry; moved files; what is refused."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest

import cells
import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.studies import read_study_file
from holdfast.studies.study_files.results import read_convergence

AT, RADIUS, WIDTH = (0.9, 0.9), 0.3, 0.04
FILE = """
seed: 7
poses: 40
chunk: 20
arms: [planar-3r]
assess: {indices: [manipulability], regions: [front.yaml], clearance: false, cell: around/discs.yaml}
"""
DISCS = f"""
objects: {{post: {{sphere: {RADIUS}, pose: {{xyz: [{AT[0]}, {AT[1]}, 0]}}}}, scan: {{points: scan.npy, radius: 0.01}}}}
arm: {{shape: slim.yaml}}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "study" / "around").mkdir(parents=True)
    (tmp_path / "study" / "study.yaml").write_text(FILE)
    (tmp_path / "study" / "front.yaml").write_text("box: {center: [0.6, 1.0, 0], size: [2.4, 1.6, 0]}\n")
    (tmp_path / "study" / "around" / "discs.yaml").write_text(DISCS)
    (tmp_path / "study" / "around" / "slim.yaml").write_text(f"radius: {WIDTH}\n")
    np.save(tmp_path / "study" / "around" / "scan.npy", np.array([[9.0, 9.0, 9.0]]))
    return tmp_path


def test_a_study_counts_what_hits_its_cell_and_resumes_with_its_files_elsewhere(folder):
    asked = read_study_file(folder / "study" / "study.yaml")
    study = Study.create(folder / "results", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    assert study.run(asked.cells, ThreadRunner(1)) == {}
    store = study.cell_store(0)
    rows = [store.read_chunk(k, ("q", "from_each", "index")) for k in range(2)]
    q, hit, value = (np.concatenate([row[name] for row in rows]) for name in ("q", "from_each", "index"))
    reached = np.isfinite(value)
    gap = cells.from_disc([1, 1, 1], WIDTH, q[reached], AT, RADIUS).ravel()
    said = hit[reached][:, 0] < 0
    sure = (gap < 0) | (gap > 0.01)  # spheres that cover a capsule reach a little beyond it
    np.testing.assert_array_equal(said[sure], gap[sure] < 0)
    assert 0 < said.mean() < 1
    shutil.move(folder / "study", folder / "moved")
    again = read_study_file(folder / "moved" / "study.yaml")
    assert [cell.digest for cell in again.cells] == [cell.digest for cell in asked.cells]
    assert json.dumps(again.cells[0].plan) != json.dumps(asked.cells[0].plan)
    assert Study.open(folder / "results").run(again.cells, ThreadRunner(1)) == {}
    np.save(folder / "moved" / "around" / "scan.npy", np.array([[9.0, 9.0, 8.0]]))
    assert read_study_file(folder / "moved" / "study.yaml").cells[0].digest != asked.cells[0].digest


def test_motions_of_a_study_are_looked_at_in_its_cell(folder):
    """Runs sampled finely, and the distance of three segments from a disc in closed form."""
    file = folder / "study" / "study.yaml"
    block = "convergence: {laws: [pseudoinverse], tasks: [planar], time_limit: 30, cell: around/discs.yaml}"
    file.write_text(f"seed: 7\nposes: 4\nchunk: 2\narms: [planar-3r]\n{block}\n")
    asked = read_study_file(file)
    study = Study.create(folder / "results", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    assert study.run(asked.cells, ThreadRunner(1)) == {}
    rows = [study.cell_store(0).read_chunk(k, ("q0", "target", "touched", "code")) for k in range(2)]
    q0, target, touched, code = (np.concatenate([row[name] for row in rows]) for name in ("q0", "target", "touched", "code"))
    law, seen = hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar"), 0
    for p, k in np.ndindex(4, 4):
        run = hf.simulate(law, q0[p], target[p], locked=[k] if k < 3 else [], time_limit=30.0, tolerance=1e-8)
        gap = cells.from_disc([1, 1, 1], WIDTH, run.path(samples=1500).q, AT, RADIUS).min()
        if gap < -1e-3 or gap > 0.01:
            assert touched[p, k] == (gap < 0)
            seen += 1
    assert seen > 10
    assert 0 < touched.mean() < 1
    found = read_convergence(study, 0)
    assert found.touched == touched[:, :3].mean()
    shutil.move(folder / "study", folder / "moved")
    again = read_study_file(folder / "moved" / "study.yaml")
    assert again.cells[0].digest == asked.cells[0].digest
    file = folder / "moved" / "study.yaml"
    file.write_text(file.read_text().replace(", cell: around/discs.yaml", ""))
    plain = read_study_file(file)
    assert plain.cells[0].digest != asked.cells[0].digest
    other = Study.create(folder / "plain", plain.name, plain.seed, cells=plain.cells, source=plain.text)
    assert other.run(plain.cells, ThreadRunner(1)) == {}
    assert read_convergence(other, 0).touched is None
    store = other.cell_store(0)
    np.testing.assert_array_equal(np.concatenate([store.read_chunk(k, ("code",))["code"] for k in range(2)]), code)


def test_a_cell_that_cannot_be_used_is_said(folder):
    file = folder / "study" / "study.yaml"
    file.write_text(FILE.replace("discs.yaml", "none.yaml"))
    with pytest.raises(InputError, match=r"study file .*none\.yaml"):
        read_study_file(file)
    file.write_text(FILE.replace("[planar-3r]", "[{arm: planar-3r, vary: {a1: [0.6, 1.4]}, designs: 4}]"))
    with pytest.raises(InputError, match=r"assess\.cell: designs of 'planar-3r' are not checked in a cell"):
        read_study_file(file)
