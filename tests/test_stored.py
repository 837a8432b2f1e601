"""Folders that earlier versions stored are converted and read, with the numbers that those versions had in memory.

``tests/stored/make.py`` wrote them. Names of classes and functions may change, what lies in folders may not.
"""

from __future__ import annotations

import contextlib
import importlib.util
import json
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms, control
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.response.recovery import read_waypoints
from holdfast.studies import convert_folder, read_study_file
from holdfast.studies.study_files.results import read_assessment, read_convergence
from holdfast.teleop.records import Records
from holdfast.teleop.trials import End

STORED = Path(__file__).with_name("stored")
_spec = importlib.util.spec_from_file_location("make_stored", STORED / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)


VERSIONS = sorted(file.stem for file in STORED.glob("*.zip"))
CONVERTED = ("assessment", "study", "workspace", "design")


def unpacked(version, folder):
    """A copy of what a version stored."""
    with zipfile.ZipFile(STORED / f"{version}.zip") as pack:
        pack.extractall(folder)
    return folder


def law():
    return control.pseudoinverse(arms.load("planar-3r"), "planar")


def converted(folder):
    for name in CONVERTED:
        assert convert_folder(folder / name, law=law() if name == "workspace" else None) == folder / name
    return folder


@pytest.fixture(params=VERSIONS)
def folder(request, tmp_path):
    """A converted copy of what a version stored."""
    return converted(unpacked(request.param, tmp_path))


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
    found, told = hf.workspace(law(), **make.WORKSPACE, store=folder / "workspace"), told["workspace"]
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


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """What this version stores."""
    folder = tmp_path_factory.mktemp("written")
    with contextlib.chdir(folder):
        make.write()
    return folder


def content(file):
    """What a file says about results: without times, versions and processors, and numbers apart from the rest."""
    if file.name == "done.journal":
        return sorted(int(line.split(b" ")[0]) for line in file.read_bytes().splitlines()), np.zeros(0)
    if file.suffix == ".json":
        data = {k: v for k, v in json.loads(file.read_text()).items() if k not in ("notes", "makers", "runs", "digest")}
        if "columns" in data:  # their last entry is a text for people
            data["columns"] = [column[:-1] for column in data["columns"]]
        data.get("attributes", {}).pop("long_name", None)
        return data, np.zeros(0)
    if file.suffix == ".journal":
        text = re.sub(rb" [0-9a-f]{8}$", b"", file.read_bytes(), flags=re.MULTILINE).decode()
        number = r"-?\d+\.\d+(?:e[-+]\d+)?"
        return re.sub(number, "#", text), np.array(re.findall(number, text), dtype=np.float64)
    return None, np.zeros(0)


@pytest.mark.parametrize("name", CONVERTED)
def test_a_converted_folder_equals_a_new_one(folder, written, name):
    def files(place):
        return {
            str(file.relative_to(place)): file
            for file in (place / name).rglob("*")
            if file.is_file() and file.suffix not in (".lock", ".html", ".csv", ".yaml")
        }

    old, new = files(folder), files(written)
    assert old.keys() == new.keys()
    for place, file in old.items():
        (text, numbers), (new_text, new_numbers) = content(file), content(new[place])
        assert text == new_text, place
        np.testing.assert_allclose(numbers, new_numbers, rtol=1e-9, atol=1e-12, err_msg=place)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_folder_that_is_not_converted_is_refused_with_the_way_to_convert_it(version, tmp_path):
    unpacked(version, tmp_path)
    for read, name in ((hf.load, "assessment"), (Study.open, "study"), (hf.load, "workspace")):
        with pytest.raises(hf.StoreError, match=r"holdfast\.studies\.convert_folder") as caught:
            read(tmp_path / name)
        assert "\n" not in str(caught.value)
    with pytest.raises(hf.StoreError, match="contains the law 'pseudoinverse, task planar"):
        convert_folder(tmp_path / "workspace")
    with pytest.raises(hf.StoreError, match="contains no study, run, or search"):
        convert_folder(tmp_path)


def test_a_converted_folder_stays_as_it_is(folder):
    for name in CONVERTED:
        before = unchanged(folder / name)
        convert_folder(folder / name)
        assert unchanged(folder / name) == before


@pytest.mark.parametrize("version", VERSIONS)
def test_a_stopped_run_of_other_digits_is_not_converted(version, tmp_path):
    file = unpacked(version, tmp_path) / "assessment" / "run.json"
    file.write_text(json.dumps(json.loads(file.read_text()) | {"done": []}))
    with pytest.raises(hf.StoreError, match="was stopped before it was complete"):
        convert_folder(tmp_path / "assessment")


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
