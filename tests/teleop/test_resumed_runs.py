"""A simulated experiment that is stopped anywhere and resumed ends with the same bytes as one that was not stopped."""

import shutil
import sqlite3
from contextlib import closing, suppress
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from holdfast.teleop import rehearsal
from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records import file, records
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.tables import export_tables
from holdfast.teleop.records.verification import verify_records
from holdfast.teleop.rehearsal import simulate_experiment
from holdfast.teleop.trials.operators import Person

OPERATORS = 5


@pytest.fixture(scope="module")
def protocol():
    whole = read_protocol()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 9])), ["a", "b"])
    return replace(few, substeps=1, training=Training(at_least=2, in_a_row=2, limit=47, most=5), subjects=2)


@pytest.fixture(scope="module", autouse=True)
def _clock():
    """Stop the clock, so that equal experiments have equal records."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (file, records):
            patch.setattr(module, "format_utc_now", lambda: "2026-11-29T00:00:00.000+00:00")
        patch.setattr(rehearsal, "OPERATORS_PER_BATCH", 3)
        patch.setenv("HOLDFAST_NOTICES", "on")
        yield


@pytest.fixture(scope="module")
def complete(protocol, tmp_path_factory):
    """The folder of an experiment that was not stopped, and its content."""
    folder = tmp_path_factory.mktemp("complete") / "experiment"
    return folder, run(protocol, folder)


@pytest.fixture
def copy(complete, tmp_path):
    return shutil.copytree(complete[0], tmp_path / "copy")


def run(protocol, folder):
    """Run or resume the experiment: all tables as SQL, and the bytes of the exported tables."""
    with simulate_experiment(folder, protocol, OPERATORS, seed=4) as finished:
        tables = {path.name: path.read_bytes() for path in export_tables(finished, folder.with_name(f"{folder.name} tables"))}
    assert verify_records(folder).damages == []
    with closing(sqlite3.connect(folder / "records.sqlite")) as db:
        return "\n".join(db.iterdump()), tables


def count_trials(folder):
    with Records.open(folder) as opened:
        return len(opened.entries())


@pytest.mark.parametrize(("method", "step"), [("add_subject", 3), ("begin_trial", 11), ("rate_trial", 13), ("set_state", 2)])
def test_a_stopped_experiment_ends_with_the_same_bytes(protocol, complete, tmp_path, monkeypatch, capfd, method, step):
    """Ctrl-C at a later call of a method that records in each round, until the experiment is complete."""
    folder, original, counts = tmp_path / "stopped", getattr(Records, method), []
    calls = limit = 0

    def stop(*args, **kwargs):
        nonlocal calls
        calls += 1
        if calls == limit:
            raise KeyboardInterrupt
        return original(*args, **kwargs)

    monkeypatch.setattr(Records, method, stop)
    while calls == limit:
        calls, limit = 0, limit + step
        with suppress(KeyboardInterrupt):
            content = run(protocol, folder)
        counts.append(count_trials(folder))
    assert content == complete[1]
    assert counts == sorted(counts)
    assert len(counts) > 1
    assert ("already contains" in capfd.readouterr().err) == (method != "add_subject")


def test_a_complete_experiment_stays_as_it_is(protocol, complete, copy, monkeypatch, capfd):
    monkeypatch.setattr(rehearsal, "_run_simulated_trials", None)
    assert run(protocol, copy) == complete[1]
    assert f"already contains 18 training tasks and the sessions of 3 of {OPERATORS} operators" in capfd.readouterr().err


def test_the_creation_of_an_experiment_is_resumed(protocol, complete, tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(file, "versions", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            run(protocol, tmp_path)
    assert {f.name for f in tmp_path.iterdir()} == {"protocol.yaml", "records.sqlite.new"}
    assert run(protocol, tmp_path) == complete[1]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"seed": 5}, "its seed is 4, but 5 was requested; give another folder"),
        ({"operators": 6}, "its number of operators is 5, but 6 was requested"),
        ({"operators": [Person()] * 5}, "another simulated experiment: its"),
        ({"rate": 7.0}, "its protocol is"),
    ],
)
def test_another_setting_is_refused(protocol, copy, changes, sentence):
    before = (copy / "records.sqlite").read_bytes()
    other = replace(protocol, rate=changes.get("rate", protocol.rate))
    with pytest.raises(hf.StoreError, match=sentence):
        simulate_experiment(copy, other, changes.get("operators", OPERATORS), seed=changes.get("seed", 4))
    assert (copy / "records.sqlite").read_bytes() == before


def test_other_folders_are_refused(protocol, copy, tmp_path):
    Records.create(tmp_path / "people", protocol).close()
    with pytest.raises(hf.StoreError, match="does not state how it was simulated"):
        simulate_experiment(tmp_path / "people", protocol, OPERATORS, seed=4)
    with Records.open(copy) as opened:
        opened.delete_subject("S02")
    with pytest.raises(hf.StoreError, match="were added or deleted"):
        simulate_experiment(copy, protocol, OPERATORS, seed=4)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "protocol.yaml").write_text("mine")
    with pytest.raises(hf.StoreError, match="not an empty folder"):
        simulate_experiment(tmp_path / "mine", protocol, OPERATORS, seed=4)
    assert (tmp_path / "mine" / "protocol.yaml").read_text() == "mine"


def test_two_programs_do_not_write_at_the_same_time(protocol, copy, tmp_path):
    with file.lock_records_folder(copy), pytest.raises(hf.StoreError, match="another program is writing"):
        simulate_experiment(copy, protocol, OPERATORS, seed=4)
