"""``holdfast teleop``: from tasks to report with a tiny protocol, and what it refuses."""

from __future__ import annotations

import csv
import json
import shutil
import sqlite3
from dataclasses import replace

import numpy as np
import pytest

from holdfast.interface.presentation.teleop.allocation import write_allocation
from holdfast.interface.presentation.teleop.bank import bank_figure
from holdfast.teleop.analysis import Analysis
from holdfast.teleop.bank.selection import bin_tasks
from holdfast.teleop.bank.tasks import make_task_bank
from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records.file import lock_records_folder
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.tables import bank_table, computer_table, tool_paths


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    whole = read_protocol()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 9, 21])), ["a", "b", "c"])
    few = replace(few, training=Training(at_least=2, in_a_row=2, limit=90, most=12), subjects=6, substeps=1)
    return few.write(tmp_path_factory.mktemp("protocol") / "tiny.yaml")


@pytest.fixture(scope="module")
def experiment(tiny, tmp_path_factory):
    """An experiment, made once; tests that change it take a copy."""
    from holdfast.teleop.rehearsal import simulate_experiment

    folder = tmp_path_factory.mktemp("made") / "experiment"
    simulate_experiment(folder, read_protocol(tiny), 3, seed=2).close()
    return folder


@pytest.fixture
def copy(experiment, tmp_path):
    return shutil.copytree(experiment, tmp_path / "copy")


def table(file):
    with file.open(newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))


# ---- tasks ---------------------------------------------------------------------------------------------------------------


def test_tasks_writes_a_bank_and_a_protocol_that_runs(cli, tmp_path):
    out = tmp_path / "bank"
    call = ["teleop", "tasks", "planar-3r", "--per-joint", "6", "--select", "4", "--seed", "3"]
    code, text, err = cli(*call, "--out", out)
    assert (code, err) == (0, "")
    assert "Arm planar-3r: 18 tasks in 4 scenarios" in text
    assert "Most disorienting of the other tasks" in text
    assert {f.name for f in out.iterdir()} == {"bank.csv", "bank.png", "protocol.yaml"}
    bank = table(out / "bank.csv")
    assert len(bank) == 18
    protocol = read_protocol(out / "protocol.yaml")
    data = json.loads(cli(*call, "--json")[1])
    special = [data["most_disorienting"], *([data["trapped"]] if data["trapped"] else [])]
    assert (data["trapped"] is None) == ("In no task of the bank" in text)
    assert len(data["chosen"]) == 4
    for k, number in enumerate([*data["chosen"], *special]):
        row = bank[number - 1]
        assert int(row["task"]) == number
        assert [float(row[j]) for j in ("joint1", "joint2", "joint3")] == protocol.tasks.q0[k].tolist()
        assert row["joint"] == protocol.arm.joint_names[protocol.tasks.joint[k]]
        assert protocol.notes[k].startswith(f"bank task {number},")
    machine = computer_table(protocol).set_index(["task", "scenario"])
    row = bank[data["chosen"][0] - 1]
    for k in range(1, 5):
        assert machine.loc[(1, k), "M6"] == float(row[f"M6_{k}"])


def test_tasks_of_an_arm_from_a_file(cli, tmp_path):
    links = "".join(f"  - {{name: axis{k}, a: 1.0, alpha: 0, d: 0}}\n" for k in (1, 2, 3))
    (tmp_path / "arm.yaml").write_text("name: three\nconvention: standard\nrows:\n" + links)
    out = tmp_path / "bank"
    call = ["teleop", "tasks", tmp_path / "arm.yaml", "--per-joint", "2", "--distance", "0.5", "--select", "3"]
    code, text, err = cli(*call, "--no-special", "--out", out)
    assert (code, err) == (0, "")
    assert "disorienting" not in text
    assert (out / "arm.yaml").exists()
    protocol = read_protocol(out / "protocol.yaml")
    assert (protocol.arm.name, protocol.rows.name, len(protocol.tasks)) == ("three", "planar", 3)


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        (["--distance", "9"], "give a smaller distance"),
        (["--distance", "nan"], "distance is nan"),
        (["--select", "90"], "90 tasks are requested"),
        (["--per-joint", "0"], "per-joint"),
        (["--task", "pose"], "a joystick commands"),
    ],
)
def test_tasks_refuses(refused, more, sentence):
    assert sentence in refused("teleop", "tasks", "--per-joint", "1", *more)


def test_figure_names_what_has_no_place(rng):
    from holdfast import arms

    bank = make_task_bank(arms.load("planar-3r"), 6, seed=1)
    lost = replace(bank, cpm=bank.cpm.copy(), end=bank.end.copy())
    lost.cpm[2, 4], lost.end[2, 4] = np.nan, 1
    figure = bank_figure(lost, bin_tasks(lost), np.array([0, 9]), special=np.array([11, 4]))
    axes = figure.axes[0]
    assert {t.get_text() for t in axes.texts} >= {"1", "2", "3"}
    assert "4" not in {t.get_text() for t in axes.texts}
    assert "task 4 among them" in axes.get_title(loc="left")
    assert bank_table(lost, arms.load("planar-3r"))["cpm_3"].isna().sum() == 1


# ---- an experiment -------------------------------------------------------------------------------------------------------


def test_from_run_to_report(cli, tiny, tmp_path):
    out = tmp_path / "experiment"
    code, text, err = cli("teleop", "run", "--simulated", "--operators", "6", "--seed", "1", "--protocol", tiny, "--out", out)
    assert (code, err) == (0, "")
    assert "6 of 6 simulated operators" in text
    code, text, err = cli("teleop", "analyse", out)
    assert (code, err) == (0, "")
    assert "law x difficulty" in text
    assert "simulated" in (out / "report.html").read_text(encoding="utf-8").lower()
    assert {"anova.csv", "cells.csv", "trials.csv"} <= {f.name for f in out.iterdir()}
    code, text, err = cli("teleop", "replay", out)
    assert (code, err) == (0, "")
    assert ", 0 differ" in text
    code, text, err = cli("teleop", "export", out)
    assert (code, err) == (0, "")
    assert {f.stem for f in (out / "export").iterdir()} == {"trials", "cycles", "subjects", "events", "dictionary", "protocol"}
    assert len([r for r in table(out / "export" / "trials.csv") if r["task"] != "0"]) == 6 * 12


def test_replay_ends_with_3_where_a_record_was_changed(cli, copy):
    with sqlite3.connect(copy / "records.sqlite") as db:
        db.execute("UPDATE cycles SET q = ? WHERE trial = 5 AND k = 4", (np.array([0.1, 0.2, 0.3]).tobytes(),))
    db.close()
    code, text, _ = cli("teleop", "replay", copy)
    assert code == 3
    assert ", 1 differ" in text
    assert "trial 5: subject S03" in text


def test_subjects_are_listed_dropped_and_deleted(cli, refused, copy, monkeypatch):
    code, text, _ = cli("teleop", "subjects", copy)
    assert (code, text.count("completed")) == (0, 3)
    assert "12 of 12 trials" in text
    code, text, _ = cli("teleop", "subjects", copy, "--drop", "S02")
    assert (code, text.count("dropped")) == (0, 2)
    monkeypatch.setattr(Analysis, "save", lambda self, folder, *_: [folder / "report.html"])  # drawing takes most of the time
    code, text, _ = cli("teleop", "analyse", copy, "--difficulty", "computer", "--groups", "2")
    assert code == 0
    assert "2 simulated subjects" in text
    assert "dropped out, and not included: S02" in text
    with lock_records_folder(copy):
        assert "is already served by another program" in refused("teleop", "subjects", copy, "--delete", "S01")
    code, text, _ = cli("teleop", "subjects", copy, "--delete", "S01")
    assert code == 0
    assert "deleted: subject S01 and" in text
    with Records.open(copy) as records:
        assert [s.code for s in records.subjects()] == ["S02", "S03"]
        assert {e.subject for e in records.entries()} == {"S02", "S03"}
    assert "no subject S01" in refused("teleop", "subjects", copy, "--delete", "S01")
    assert "not both" in refused("teleop", "subjects", copy, "--delete", "S02", "--drop", "S02")


def test_paths_are_those_of_the_records(experiment):
    with Records.open(experiment) as records:
        path = tool_paths(records)
        entry = next(e for e in records.entries("S02") if e.task == 2 and e.scenario == 3)
        np.testing.assert_array_equal(path("S02", 3, 4), records.read_trials([entry]).path(0))
        machine = path(None, 3, 4)
        assert len(machine) - 1 == computer_table(records.protocol).query("task == 3 and scenario == 4")["M1"].item()
        assert path("S02", 9, 1) is None


def test_the_computer_covers_the_same_way_at_any_cycle_rate():
    """Ten times as many cycles a second make ten times as many cycles, and otherwise the same trials."""
    few = [p.with_tasks(p.tasks.take(np.array([0, 9, 23]))) for p in (read_protocol(), read_protocol("goel2003-smooth"))]
    coarse, fine = (computer_table(p) for p in few)
    assert (coarse["end"] == fine["end"]).all()
    arrived = coarse["end"] == "arrived"
    np.testing.assert_allclose(fine["M1"][arrived], 10 * coarse["M1"][arrived], rtol=0.1)
    np.testing.assert_allclose(fine["M2"][arrived], coarse["M2"][arrived], rtol=0.05)


# ---- protocol and allocation -----------------------------------------------------------------------------------------------


def test_protocol_is_described_and_copied(cli, refused, tmp_path):
    code, text, err = cli("teleop", "protocol", "goel2003-smooth", "--write", tmp_path / "mine.yaml")
    assert (code, err) == (0, "")
    assert "60 cycles/s" in text
    assert "0.3 m/s" in text
    assert read_protocol(tmp_path / "mine.yaml").to_yaml() == read_protocol("goel2003-smooth").to_yaml()
    assert "exists already" in refused("teleop", "protocol", "--write", tmp_path / "mine.yaml")


def test_allocation_is_that_of_the_sessions(cli, tiny, tmp_path):
    protocol = read_protocol(tiny)
    code, text, _ = cli("teleop", "allocation", tiny, "--subjects", "2")
    assert code == 0
    line = text.splitlines()[2].split()
    assert [w.split(":")[0] for w in line[2:]] == [str(t + 1) for t in protocol.task_order()[1]]
    said = [int(s) for w in line[2:] for s in w.split(":")[1].split("/")]
    assert said == (protocol.session_order(1, 1)[:, 1] + 1).tolist()
    code, text, _ = cli("teleop", "allocation", tiny, "--out", tmp_path / "sheet.html")
    assert code == 0
    page = (tmp_path / "sheet.html").read_text(encoding="utf-8")
    assert page.count('class="sheet"') == 6
    assert write_allocation(protocol, tmp_path / "two.html", 2).read_text(encoding="utf-8").count('class="sheet"') == 2


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (["run", "--out", "new"], "for people in a browser"),
        (["run", "--simulated"], "--out"),
        (["run", "--simulated", "--operators", "0", "--out", "new"], "operators"),
        (["run", "--simulated", "--out", "new", "--protocol", "none.yaml"], "none.yaml"),
        (["analyse", "none"], "contains no experiment"),
        (["replay", "none"], "contains no experiment"),
        (["export", "none"], "contains no experiment"),
        (["subjects", "none"], "contains no experiment"),
        (["protocol", "none.yaml"], "none.yaml"),
        (["allocation", "none.yaml"], "none.yaml"),
        (["allocation", "--subjects", "0"], "subjects"),
        (["allocation", "--out", "none/sheet.html"], "cannot write"),
        (["serve"], "--data"),
    ],
    ids=lambda v: " ".join(v) if isinstance(v, list) else "",
)
def test_bad_calls_get_one_sentence(refused, tmp_path, monkeypatch, call, sentence):
    monkeypatch.chdir(tmp_path)
    assert sentence in refused("teleop", *call)
    assert not list(tmp_path.iterdir())


def test_bad_options_of_an_analysis(refused, experiment):
    assert "missing is 'drop'" in refused("teleop", "analyse", experiment, "--missing", "drop")
    assert "difficulty is 'me'" in refused("teleop", "analyse", experiment, "--difficulty", "me")
    assert "groups" in refused("teleop", "analyse", experiment, "--groups", "9")
    assert not (experiment / "report.html").exists()


def test_a_used_folder_is_refused(refused, tiny, experiment):
    before = (experiment / "records.sqlite").read_bytes()
    call = ["teleop", "run", "--simulated", "--protocol", tiny, "--operators", "3", "--out", experiment]
    assert "its seed is 2, but 1 was requested; give another folder" in refused(*call, "--seed", "1")
    assert "not an empty folder" in refused(*call[:-1], experiment.parent)
    assert (experiment / "records.sqlite").read_bytes() == before
