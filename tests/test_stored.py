"""Folders that earlier versions stored are read, with the numbers that those versions had in memory when they wrote them.

``tests/stored/make.py`` wrote them. Names of classes and functions may change, what lies in folders may not.
"""

from __future__ import annotations

import importlib.util
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms, control
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.response.recovery import read_waypoints
from holdfast.studies import read_study_file
from holdfast.studies.study_files.results import read_assessment, read_convergence
from holdfast.teleop.records import Records
from holdfast.teleop.trials import End

STORED = Path(__file__).with_name("stored")
_spec = importlib.util.spec_from_file_location("make_stored", STORED / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)


@pytest.fixture(params=sorted(file.stem for file in STORED.glob("*.zip")))
def folder(request, tmp_path):
    """A copy of what a version stored."""
    with zipfile.ZipFile(STORED / f"{request.param}.zip") as pack:
        pack.extractall(tmp_path)
    return tmp_path


@pytest.fixture
def told(folder):
    """What the results were."""
    return json.loads((folder / "numbers.json").read_text())


def close(found, wanted):
    np.testing.assert_allclose(np.asarray(found, dtype=np.float64), np.asarray(wanted, dtype=np.float64), rtol=1e-12)


def unchanged(folder):
    """Every file with its bytes: what is resumed from here computes nothing."""
    return {f: f.read_bytes() for f in folder.rglob("*") if f.is_file() and not f.name.endswith(".lock")}


def test_an_assessment(folder, told):
    run, told = hf.load(folder / "assessment"), told["assessment"]
    assert run.complete
    assert run.distribution.reached == told["reached"]
    close([run.distribution.mean, run.optimised.mean], [told["mean"], told["best"]])
    assert (run.worst_counts.tolist(), run.survivors.tolist()) == (told["worst"], told["left"])
    np.testing.assert_array_equal(run.dataset["q"].values, told["q"])


def test_an_assessment_is_resumed(folder, told):
    before = unchanged(folder / "assessment" / "samples.zarr")
    run = hf.assess(arms.load("planar-3r"), make.region(), **make.ASSESSED, store=folder / "assessment")
    close(run.distribution.mean, told["assessment"]["mean"])
    assert unchanged(folder / "assessment" / "samples.zarr") == before


def test_a_study(folder, told):
    study, told = Study.open(folder / "study"), told["study"]
    assert (study.is_complete, study.digest, study.verify()) == (True, told["digest"], [])
    close(read_assessment(study, 0).plain.mean, told["mean"])
    close(read_convergence(study, 1).ends, told["ends"])


def test_a_study_is_resumed(folder):
    asked, study = read_study_file(folder / "small.yaml"), Study.open(folder / "study")
    before = unchanged(study.path)
    study.check_same(Study.create(folder / "again", asked.name, asked.seed, cells=asked.cells, source=asked.text))
    assert study.run(asked.cells, ThreadRunner(1)) == {}
    assert unchanged(study.path) == before


def test_a_workspace_is_resumed(folder, told):
    before = unchanged(folder / "workspace" / "samples.zarr")
    law = control.pseudoinverse(arms.load("planar-3r"), "planar")
    found, told = hf.workspace(law, **make.WORKSPACE, store=folder / "workspace"), told["workspace"]
    assert found.ends.tolist() == told.pop("ends")
    for name, values in told.items():
        close(found.measures[name], values)
    assert unchanged(folder / "workspace" / "samples.zarr") == before


def test_a_search_for_designs_is_resumed(folder, told):
    before = unchanged(folder / "design")
    found = hf.design(arms.load("planar-3r"), region=make.region(), **make.DESIGNED, store=folder / "design")
    assert found.to_dict()["best"]["values"] == told["design"]["best"]["values"]
    close([x["guaranteed"] for x in found.to_dict()["front"]], [x["guaranteed"] for x in told["design"]["front"]])
    assert unchanged(folder / "design") == before


def test_an_experiment(folder, told):
    told = told["experiment"]
    with Records.open(folder / "experiment") as records:
        entries = records.entries()
        trials = records.read_trials(entries)
        assert [s.code for s in records.subjects()] == told["subjects"]
        assert [End(e).name for e in trials.end] == told["ends"]
        assert [e.rating for e in entries] == told["ratings"]
        np.testing.assert_array_equal(trials.q_end, told["last"])


def test_a_route(folder, told):
    np.testing.assert_array_equal(read_waypoints(arms.load("planar-3r"), folder / "waypoints.csv"), told["waypoints"])


def test_what_was_stored_stays(folder):
    with pytest.raises(SystemExit, match="stays"):
        make.main(sorted(STORED.glob("*.zip"))[0].stem)
