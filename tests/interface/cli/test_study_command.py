"""``holdfast study``: files, runs, folders, reports."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import yaml

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_percent
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.kernels import set_threads, shared_pool
from holdfast.kinematics.regions.region import Region, default_region
from holdfast.studies import read_study_file
from holdfast.studies.study_files.results import read_assessment
from sealing import read_unsealed, write_sealed

TEXT = """
name: small
seed: 3
poses: 40
chunk: 16
arms: [planar-3r]
assess: {indices: [relative-manipulability, condition-number], optimise: true, restarts: 10}
convergence: {laws: [pseudoinverse, "damped:0.2"], motions: 4, chunk: 2, time_limit: 10}
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "small.yaml"
    path.write_text(TEXT)
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A study that is computed."""
    place = tmp_path_factory.mktemp("study")
    path = place / "small.yaml"
    path.write_text(TEXT)
    asked = read_study_file(path)
    study = Study.create(place / "out", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    set_threads(2)
    try:
        assert study.run(asked.cells, ThreadRunner(2, shared_pool())) == {}
    finally:
        set_threads(None)
    return study.path


def bits(folder):
    study = Study.open(folder)
    return {(c["name"], n): e.digest for k, c in enumerate(study.cells) for n, e in study.cell_entries(k).items()}


def test_a_new_file_runs_and_says_what_it_would_do(cli, ask, refused, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("study", "new", "mine.yaml", "--arm", "planar-3r", "--poses", 20, "--chunk", 8, "--seed", 4)
    assert (code, out) == (0, "written: mine.yaml\n")
    text = Path("mine.yaml").read_text()
    assert text.count("#") > 15
    data = yaml.safe_load(text)
    assert (data["poses"], data["chunk"], data["seed"], data["arms"]) == (20, 8, 4, ["planar-3r"])
    told = ask("study", "run", "mine.yaml", "--dry-run")
    assert (told["chunks"], told["cells"][0]["rows"]) == (3, 20)
    assert told["thread_seconds"] > 0
    assert told["bytes"] > 20 * 3 * 8
    assert not Path("out").exists()
    done = ask("study", "run", "mine.yaml", "--out", "out")
    assert (done["complete"], done["chunks_done"]) == (True, 3)
    assert "exists" in refused("study", "new", "mine.yaml", "--arm", "planar-3r")
    assert "--poses is 0" in refused("study", "new", "b.yaml", "--arm", "planar-3r", "--poses", 0)
    assert "no-such" in refused("study", "new", "b.yaml", "--arm", "no-such")
    assert "index 'tolerance' is not known" in refused("study", "new", "b.yaml", "--arm", "planar-3r", "--index", "tolerance")
    assert not Path("b.yaml").exists()


def test_new_with_laws_and_an_arm_file_elsewhere(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("arms").mkdir()
    table = Path(__file__).parents[3] / "src/holdfast/model/arms/data/panda.urdf"
    Path("arms/p.urdf").write_bytes(table.read_bytes())
    Path("studies").mkdir()
    options = [
        "--arm",
        "arms/p.urdf",
        "--tip",
        "panda_link8",
        "--law",
        "pseudoinverse",
        "--law",
        "damped:0.1",
        "--index",
        "manipulability",
        "--optimise",
    ]
    code, _, err = cli("study", "new", "studies/s.yaml", *options)
    assert code == 0, err
    cells = read_study_file("studies/s.yaml").cells
    assert [c.labels.get("law", c.labels.get("index")) for c in cells] == ["manipulability", "pseudoinverse", "damped:0.1"]


def test_a_cell_is_the_assessment_of_the_same_options(folder, tmp_path):
    """Where chunks are whole blocks of 1024 poses, bit by bit."""
    path = tmp_path / "s.yaml"
    path.write_text("{poses: 1100, chunk: 1024, seed: 5, arms: [planar-3r], assess: {restarts: 5}}")
    asked = read_study_file(path)
    study = Study.create(tmp_path / "out", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    study.run(asked.cells, ThreadRunner(1))
    arm = hf.arms.load("planar-3r")
    run = hf.assess(arm, default_region(arm), task="planar", poses=1100, seed=5, restarts=5)
    found = hf.load(study.cell_folder(0))
    for name in run.dataset:
        assert found.dataset[name].values.tobytes() == run.dataset[name].values.tobytes(), name
    assert found.complete
    small = hf.load(folder / "cells" / "planar-3r-relative-manipulability")
    assert (small.distribution.samples, small.optimised.samples) == (40, 40)


@pytest.mark.parametrize("sampling", ["random", "sobol"])
def test_samples_do_not_depend_on_where_chunks_end(sampling):
    region = Region.box([0, 0, 1], 0.5, rpy_size=1.0)
    blocks = region.blocks(0, 7, sampling, count=3000)
    first, second = next(blocks), next(blocks)
    np.testing.assert_array_equal(region.samples(0, 1024, 0, seed=7, sampling=sampling, count=3000), first)
    np.testing.assert_array_equal(region.samples(1024, 1500, 1, seed=7, sampling=sampling, count=3000), second[:476])
    if sampling == "sobol":
        np.testing.assert_array_equal(region.samples(1000, 1024, 5, seed=7, sampling=sampling, count=3000), first[1000:])


@pytest.mark.parametrize("sampling", ["random", "sobol"])
def test_samples_of_a_box_may_be_of_many_blocks(sampling):
    region = Region.joints([-1, -2, 0], [1, 2, 0.5])
    blocks = region.blocks(2, 7, sampling, count=10**6)
    whole = np.concatenate([next(blocks), next(blocks)])
    start, place = 2 * region.block, np.full((region.block + 99, 3), np.nan)
    found = region.samples(start, start + len(place), 2, seed=7, sampling=sampling, count=10**6, out=place)
    np.testing.assert_array_equal(found, whole[: len(place)])
    np.testing.assert_array_equal(place, found)


def both_ways(folder, size, block):
    """What every cell of a study found when it keeps rows, and when it keeps counts."""
    found = []
    for keep in ("rows", "counts"):
        path = folder / f"{keep}.yaml"
        path.write_text(f"{{{size}, seed: 5, arms: [planar-3r], assess: {{{block}, keep: {keep}}}}}")
        asked = read_study_file(path)
        study = Study.create(folder / keep, asked.name, asked.seed, cells=asked.cells, source=asked.text)
        study.run(asked.cells, ThreadRunner(1))
        found.append([read_assessment(study, k) for k in range(len(asked.cells))])
    return found


@pytest.mark.parametrize("index", ["relative-manipulability", "minimum-singular-value"])
def test_counts_of_configurations_are_those_of_the_rows(index, tmp_path):
    (tmp_path / "joints.yaml").write_text("joints: {lower: [-3, -1, 0], upper: [3, 1, 0.2]}")
    [[rows], [counts]] = both_ways(tmp_path, "poses: 300000, chunk: 170000", f"indices: [{index}], regions: [joints.yaml]")
    assert rows.worst == counts.worst
    a, b = rows.plain, counts.plain
    assert (a.samples, a.singular, a.lowest, a.highest) == (b.samples, b.singular, b.lowest, b.highest) != (0, 0, 0, 0)
    np.testing.assert_array_equal(b.cdf(b.edges[1:-1:37]), a.cdf(b.edges[1:-1:37]))


def test_counts_are_those_of_the_rows(tmp_path):
    indices = "indices: [relative-manipulability, condition-number]"
    found = both_ways(tmp_path, "poses: 60, chunk: 25", f"optimise: true, {indices}")
    for rows, counts in zip(*found, strict=True):
        assert rows.worst == counts.worst
        for a, b in ((rows.plain, counts.plain), (rows.optimised, counts.optimised)):
            assert (a.samples, a.unreached, a.singular, a.infinite) == (b.samples, b.unreached, b.singular, b.infinite)
            assert (a.lowest, a.highest) == (b.lowest, b.highest)
            assert b.mean == pytest.approx(a.mean, rel=1e-12)
            some = b.edges[1:-1:37]
            np.testing.assert_array_equal(b.cdf(some), a.cdf(some))
            width = 0.012 * float(a.quantile(0.5)) + 2e-4
            assert float(b.quantile(0.5)) == pytest.approx(float(a.quantile(0.5)), abs=width)


# ---- folders -----------------------------------------------------------------------------------------------------------


def test_stopping_and_going_on_change_no_bit(cli, file, folder, tmp_path):
    """A program of its own: Ctrl-C after the first chunks, then kill -9, then to the end."""
    out = tmp_path / "out"
    command = [sys.executable, "-m", "holdfast", "study", "run", str(file), "--out", str(out), "--threads", "1"]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    for how, codes in ((signal.SIGINT, (130, 0)), (signal.SIGKILL, (-9, 0))):
        with subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            before = len(bits(out)) if out.exists() else 0
            while process.poll() is None and (not (out / "study.json").exists() or len(bits(out)) <= before):
                time.sleep(0.02)
            process.send_signal(how)
            _, err = process.communicate(timeout=60)
        assert process.returncode in codes, err
        assert "Traceback" not in err
    code, text, err = cli("study", "run", file, "--out", out, "--threads", 2)
    assert code == 0, err
    assert "complete" in text
    assert bits(out) == bits(folder)


def test_status_verify_and_a_damaged_chunk(cli, ask, file, folder, tmp_path):
    whole = tmp_path / "copy"
    assert cli("study", "merge", whole, folder)[0] == 0
    assert bits(whole) == bits(folder)
    told = ask("study", "status", whole)
    assert (told["complete"], told["chunks"], told["name"], told["seed"]) == (True, 10, "small", 3)
    code, out, _ = cli("study", "verify", whole)
    assert (code, out) == (0, f"{whole}: 10 chunks, all sound\n")
    bad = whole / "cells" / "planar-3r-pseudoinverse" / "samples.zarr" / "q0" / "c" / "1" / "0"
    bad.write_bytes(bad.read_bytes()[:-3])
    code, _, err = cli("study", "report", whole)
    assert code == 2
    assert "damaged" in err
    code, out, err = cli("study", "verify", whole)
    assert code == 2
    assert "chunk 2 of cell 'planar-3r-pseudoinverse' is damaged" in out
    assert "computes them again" in err
    assert not ask("study", "status", whole)["complete"]
    assert ask("study", "run", file, "--out", whole)["complete"]
    assert bits(whole) == bits(folder)
    assert ask("study", "verify", whole) == {"damaged": []}
    shutil.rmtree(whole / "cells" / "planar-3r-pseudoinverse")
    code, out, err = cli("study", "verify", whole)
    assert code == 2
    assert "cell 'planar-3r-pseudoinverse' is lost: it was begun, and nothing of it is left" in out
    code, out, _ = cli("study", "verify", whole)
    assert code == 0
    assert "are not computed\nnothing is computed of 1 cell: planar-3r-pseudoinverse" in out
    assert ask("study", "run", file, "--out", whole)["complete"]


def test_labels_of_a_damaged_study_are_named_and_mended(cli, ask, file, folder, tmp_path):
    whole = tmp_path / "copy"
    assert cli("study", "merge", whole, folder)[0] == 0
    study = whole / "study.json"
    data = read_unsealed(study)
    del data["cells"][0]["labels"]["arm"]
    write_sealed(study, data)
    code, _, err = cli("study", "report", whole)
    assert code == 2
    assert "has no label 'arm'" in err
    assert ask("study", "run", file, "--out", whole)["complete"]
    assert cli("study", "report", whole)[0] == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"poses: {2**62}\nchunk: 1\narms: [planar-3r]\nassess: {{}}\n", "rows in chunks of 1; a cell may have at most"),
        ("poses: 100000000\nchunk: 1\narms: [planar-3r]\nassess: {}\n", "give fewer rows or a larger chunk"),
    ],
)
def test_a_study_of_more_chunks_than_can_be_counted(refused, tmp_path, text, said):
    (tmp_path / "s.yaml").write_text(text)
    assert said in refused("study", "run", tmp_path / "s.yaml", "--out", tmp_path / "out")
    assert said in refused("study", "run", tmp_path / "s.yaml", "--dry-run")


def test_shares_and_merge(ask, refused, file, folder, tmp_path):
    for k in (1, 2):
        ask("study", "run", file, "--out", tmp_path / f"p{k}", "--part", f"{k}/2")
    told = ask("study", "merge", tmp_path / "whole", tmp_path / "p1", tmp_path / "p2")
    assert (told["added"], told["different"]) == (10, [])
    assert bits(tmp_path / "whole") == bits(folder)
    assert "nothing to merge" in refused("study", "merge", tmp_path / "p1")
    assert "is not a study" in refused("study", "merge", tmp_path / "whole", tmp_path)


def test_the_report_holds_what_was_found(ask, folder, tmp_path):
    to = tmp_path / "r.html"
    ask("study", "report", folder, "--to", to)
    text = to.read_text().replace("\u00a0", " ")
    for words in (
        "relative manipulability",
        "condition number",
        "damped:0.2",
        "seed 3",
        "numpy",
        "10 of 10 chunks",
        "poses: 40",
    ):
        assert words in text, words
    run = hf.load(folder / "cells" / "planar-3r-relative-manipulability")
    value = run.interval(at_least=run.default_threshold())
    assert f"{format_percent(value.value)} ({format_percent(value.low)} to {format_percent(value.high)}, 95 %)" in text
    assert "http" not in text.replace("http://www.w3.org", "")


def test_other_thresholds_need_no_new_chunk(ask, file, folder, tmp_path):
    """Thresholds and the name are not part of what is computed: the same folder reports on them."""
    whole = tmp_path / "copy"
    ask("study", "merge", whole, folder)
    data = yaml.safe_load(file.read_text())
    data["assess"]["thresholds"] = {"relative-manipulability": 0.123}
    file.write_text(yaml.safe_dump({**data, "name": "renamed"}))
    told = ask("study", "run", file, "--out", whole)
    assert (told["name"], told["complete"], bits(whole)) == ("renamed", True, bits(folder))
    ask("study", "report", whole)
    text = (whole / "report.html").read_text().replace("\u00a0", " ")
    assert "≥ 0.123" in text
    assert "<h1>renamed</h1>" in text
    assert "relative-manipulability: 0.123" in text


def test_an_unfinished_study_reports_what_is_there(ask, refused, file, tmp_path):
    asked = read_study_file(file)
    study = Study.create(tmp_path / "out", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    assert "nothing of" in refused("study", "report", study.path)
    study.run(asked.cells, ThreadRunner(1), stop=lambda: len(bits(study.path)) > 1)
    ask("study", "report", study.path)
    assert "Not complete" in (study.path / "report.html").read_text()


# ---- wrong -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"posse": 3}, "the key 'posse' is not known; the keys here are name, seed, poses"),
        ({"poses": 0}, "poses: 0 is wrong"),
        ({"poses": 2.5}, "poses: 2.5 is wrong"),
        ({"chunk": "many"}, "chunk: 'many' is wrong"),
        ({"seed": -1}, "seed: -1 is wrong"),
        ({"arms": []}, "arms: it has 0 entries"),
        ({"arms": ["no-such-arm"]}, "no-such-arm"),
        ({"arms": [{"file": "x.urdf", "tpi": "a"}]}, "the key 'tpi' is not known"),
        ({"assess": {"indices": ["nice"]}}, "index 'nice' is not known"),
        ({"assess": {"index": ["nice"]}}, "assess.index: the key 'index' is not known"),
        ({"assess": {"keep": "some"}}, "assess.keep: 'some' is not known"),
        ({"assess": {"tasks": ["world:vx"]}}, "assess.tasks: frame 'world'"),
        ({"assess": {"regions": ["none.yaml"]}}, "none.yaml': the file cannot be read"),
        ({"assess": {"thresholds": {"manipulability": 1}}}, "'manipulability' is not among the indices"),
        ({"assess": {"keep": "counts", "after_lock": True}}, "after_lock needs every pose"),
        ({"convergence": {"laws": ["wild"]}}, "wild"),
        ({"convergence": {"laws": ["damped:x"]}}, "'x' is not a number"),
        ({"workspace": {}}, "workspace.targets: it is missing"),
        ({"assess": None}, "there is nothing to compute"),
    ],
)
def test_a_wrong_study_file_is_a_sentence(change, words, tmp_path):
    data = {"poses": 4, "chunk": 2, "arms": ["planar-3r"], "assess": {}, **change}
    path = tmp_path / "s.yaml"
    path.write_text(yaml.safe_dump(data))
    with pytest.raises(InputError) as caught:
        read_study_file(path)
    message = str(caught.value)
    assert words in message
    assert str(path) in message
    assert "\n" not in message


def test_wrong_calls_are_sentences(refused, file, folder, tmp_path):
    assert "--out is missing" in refused("study", "run", file)
    assert "cannot be read" in refused("study", "run", tmp_path / "none.yaml", "--out", tmp_path / "o")
    assert "--part '3/2' is not a part" in refused("study", "run", file, "--out", tmp_path / "o", "--part", "3/2")
    assert "scheduler 'x' is not known" in refused("study", "run", file, "--out", tmp_path / "o", "--scheduler", "x")
    assert not (tmp_path / "o").exists()
    file.write_text(file.read_text().replace("seed: 3", "seed: 4"))
    assert "its seed is 3, but 4 was requested" in refused("study", "run", file, "--out", folder)
    for command in ("status", "verify", "report"):
        assert "is not a study" in refused("study", command, tmp_path)
    data = read_unsealed(folder / "study.json")
    copy = tmp_path / "copy"
    copy.mkdir()
    (copy / "study.json").write_text(json.dumps({**data, "seed": 8}))
    assert "it has no digest" in refused("study", "status", copy)
