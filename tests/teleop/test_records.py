"""Records: what is written is read, what is acknowledged survives, and what is not right is refused and changes nothing."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from cards import check_card
from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records.check import replay_trials
from holdfast.teleop.records.entries import SubjectState, TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import Session, training_tasks
from holdfast.teleop.records.tables import computer_table, cycle_table, describe_columns, export_tables, trial_table
from holdfast.teleop.records.verification import verify_records
from holdfast.teleop.rehearsal import simulate_experiment
from holdfast.teleop.trials.performance import compute_measures
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import PointTasks

PROGRAM = Path(__file__).with_name("crashing.py")


@pytest.fixture(scope="module")
def protocol():
    whole = read_protocol()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 9, 21])), ["a", "b", "c"])
    return replace(few, substeps=1, training=Training(at_least=3, in_a_row=2, limit=80, most=12), subjects=6)


@pytest.fixture(scope="module")
def made(protocol, tmp_path_factory):
    with simulate_experiment(tmp_path_factory.mktemp("made") / "experiment", protocol, 6, seed=3) as records:
        yield records


@pytest.fixture
def records(protocol, tmp_path):
    with Records.create(tmp_path / "experiment", protocol) as opened:
        yield opened


def one_trial(records, code, cycles=7, end=End.ARRIVED, rng=None):
    session = Session(records, code)
    todo = session.next_trial()
    number = records.begin_trial(code, todo.kind, todo.position, scenario=todo.scenario, tasks=todo.tasks, task=todo.task)
    generator = np.random.default_rng(number) if rng is None else rng
    plant = records.protocol.plants[todo.scenario]
    mask = todo.tasks.healthy_mask(records.protocol.scenarios[todo.scenario].failed)[0]
    q, written = todo.tasks.q0[0], []
    for k in range(cycles):
        v = records.protocol.stick.limit_velocity(generator.normal(0, 0.03, 2))
        records.append_cycles(number, k, np.array([k / 6]), velocity=v[None], q=q[None])
        written.append((v, q))
        q, _ = plant.step_one(q, v, mask)
    if end is not None:
        records.finish_trial(number, end, q)
    return number, written, q


def test_what_is_written_is_read(records):
    code = records.add_subject().code
    for _ in range(3):  # the training, which has no ratings
        training, _, _ = one_trial(records, code, cycles=5)
    with pytest.raises(hf.InputError, match="is a training trial"):
        records.rate_trial(training, 2)
    number, written, last = one_trial(records, code)
    records.rate_trial(number, 2, {"comment": "slow"})
    with Records.open(records.folder) as again:
        (entry,) = again.entries(kind=TrialKind.TRIAL)
        trials = again.read_trials([entry])
        assert (entry.subject, entry.kind, entry.end, entry.rating, entry.answers) == (
            code,
            TrialKind.TRIAL,
            End.ARRIVED,
            2,
            {"comment": "slow"},
        )
        np.testing.assert_array_equal(trials.velocity, [v for v, _ in written])
        np.testing.assert_array_equal(trials.configurations(0), [*(q for _, q in written), last])
        np.testing.assert_allclose(trials.x[:, 0], np.cos(np.cumsum(trials.q, axis=1)).sum(axis=1), atol=1e-12)
        np.testing.assert_allclose(again.read_times(entry), np.arange(7) / 6)
        assert again.versions["holdfast"] == hf.__version__


def test_replay_gives_the_recorded_path(made):
    result = replay_trials(made)
    assert len(result.entries) > 6 * 12
    np.testing.assert_array_equal(result.difference, 0.0)
    check_card(result, False)


def test_replay_finds_a_changed_record(records):
    code = records.add_subject().code
    one_trial(records, code)
    number, _, _ = one_trial(records, code)
    with sqlite3.connect(records.folder / "records.sqlite") as db:
        db.execute("UPDATE cycles SET q = ? WHERE trial = ? AND k = 4", (np.array([0.1, 0.2, 0.3]).tobytes(), number))
    db.close()
    assert [e.id for e in replay_trials(records).differing_entries] == [number]


def test_replay_finds_a_trial_that_should_have_been_over(records):
    code, tasks = records.add_subject().code, records.protocol.tasks.take(np.array([0]))
    plant = records.protocol.plants[0]
    q = tasks.q0  # a target around the start, and a command to stand
    there = PointTasks(q, plant.position(q), tasks.joint)
    number = records.begin_trial(code, TrialKind.TRIAL, 0, scenario=0, tasks=there, task=0)
    records.append_cycles(number, 0, np.zeros(1), velocity=np.zeros((1, 2)), q=q)
    records.finish_trial(number, End.ABORTED, q[0])
    assert replay_trials(records).difference.tolist() == [np.inf]


def test_simulated_experiment_follows_the_protocol(made, protocol):
    subjects = made.subjects()
    assert {s.kind for s in subjects} == {"simulated"}
    assert sorted(s.row for s in subjects) == list(range(6))
    for s in subjects:
        assert s.state == SubjectState.COMPLETED
        session = protocol.session_order(s.row, s.number)
        entries = made.entries(s.code, TrialKind.TRIAL)
        assert [[e.task, e.scenario] for e in entries] == session.tolist()
        assert all(e.rating is not None for e in entries)
        training = made.entries(s.code, TrialKind.TRAINING)
        trials = made.read_trials(training)
        times = np.where(trials.is_completed, trials.cycles, np.nan).tolist()
        assert protocol.training.is_met_by(times)
        assert not protocol.training.is_met_by(times[:-1])
        np.testing.assert_array_equal(
            np.stack([e.q0 for e in training]), training_tasks(protocol, s.number).q0[: len(training)]
        )


def test_same_seed_same_records(made, protocol, tmp_path):
    with simulate_experiment(tmp_path / "again", protocol, 6, seed=3) as again:
        columns = ["subject", "task", "scenario", "end", "cycles", *(f"M{k}" for k in range(1, 13))]
        assert trial_table(again)[columns].equals(trial_table(made)[columns])


def test_tables_say_what_the_records_say(made, protocol, tmp_path):
    import pandas as pd

    table = trial_table(made)
    assert len(table) == 6 * 3 * 4
    entries = made.entries(kind=TrialKind.TRIAL)
    by_hand = compute_measures(made.read_trials(entries))
    np.testing.assert_array_equal(table[[f"M{k}" for k in range(1, 12)]].to_numpy(), by_hand)
    assert set(table["law"]) == {"pseudoinverse", "failure-tolerant"}
    files = export_tables(made, tmp_path / "csv")
    back = pd.read_csv(tmp_path / "csv" / "trials.csv", keep_default_na=False, na_values=[""])
    np.testing.assert_array_equal(back.query("task > 0")["M2"], table["M2"])  # CSV keeps every digit
    cycles = pd.read_csv(tmp_path / "csv" / "cycles.csv")
    assert len(cycles) == len(cycle_table(made)) == sum(made.read_trials(made.entries()).cycles + 1)
    about = describe_columns(protocol)
    for name in ("trials", "cycles"):
        columns = list(pd.read_csv(tmp_path / "csv" / f"{name}.csv", nrows=1).columns)
        assert columns == about.query("table == @name")["column"].tolist()
    assert {f.name for f in files} >= {"subjects.csv", "events.csv", "dictionary.csv", "protocol.yaml"}
    export_tables(made, tmp_path / "parquet", parquet=True)
    assert pd.read_parquet(tmp_path / "parquet" / "trials.parquet")["M1"].equals(pd.read_csv(files[0])["M1"])


def test_the_table_of_cycles_is_what_was_recorded(records, monkeypatch):
    """Row by row, also of trials that were broken off or never moved; nothing is driven again for it."""
    code = records.add_subject().code
    for end, cycles in ((End.ARRIVED, 5), (None, 4), (None, 0), (End.ABORTED, 0)):
        one_trial(records, code, end=end, cycles=cycles)
    monkeypatch.setattr(JoystickPlant, "step_batch", None)
    table, position = cycle_table(records), records.protocol.plants[0].position
    assert table.groupby("trial").size().tolist() == [6, 4, 1, 1]
    for e in records.entries():
        rows = table[table["trial"] == e.id]
        assert rows["k"].tolist() == list(range(len(rows)))
        kept = records._db.execute("SELECT time, velocity, q FROM cycles WHERE trial = ? ORDER BY k", (e.id,)).fetchall()
        kept = kept or [(np.nan, b"", e.q0.tobytes())]
        time, velocity, q = rows.iloc[:, 2].to_numpy(), rows.iloc[:, 3:5].to_numpy(), rows.iloc[:, 5:-2].to_numpy()
        np.testing.assert_array_equal(q, [np.frombuffer(row[2]) for row in kept])
        np.testing.assert_array_equal(rows.iloc[:, -2:], position(q))
        np.testing.assert_array_equal(time[:-1], [row[0] for row in kept[:-1]])
        np.testing.assert_array_equal(velocity[:-1], np.reshape([np.frombuffer(row[1]) for row in kept[:-1]], (-1, 2)))
        assert np.isnan([time[-1], *velocity[-1]]).all()


def test_computer_does_every_task(protocol):
    table = computer_table(protocol)
    assert len(table) == 12
    assert set(table["kind"]) == {"computer"}
    assert table["M12"].isna().all()
    assert (table.query("scenario == 1")["M1"].between(36, 42)).all()


def test_a_session_goes_on_where_it_stopped(records):
    code = records.add_subject().code
    for _ in range(3):
        one_trial(records, code, cycles=5)
    todo = Session(records, code).next_trial()
    assert (todo.kind, todo.position) == (TrialKind.TRIAL, 0)
    one_trial(records, code, end=None)  # broken off: done again
    assert Session(records, code).next_trial().position == 0
    one_trial(records, code)
    one_trial(records, code, end=End.ABORTED)  # given up: not done again
    todo = Session(records, code).next_trial()
    assert todo.position == 2
    order = records.protocol.session_order(0, 0)
    assert [todo.task, todo.scenario] == order[2].tolist()
    for _ in range(10):
        one_trial(records, code)
    assert Session(records, code).next_trial() is None
    assert records.subject(code).state == SubjectState.COMPLETED


def test_who_never_meets_the_criterion_is_sent_home(records):
    code = records.add_subject().code
    for _ in range(12):
        one_trial(records, code, cycles=3, end=End.ABORTED)
    assert Session(records, code).next_trial() is None
    assert records.subject(code).state == SubjectState.OPEN  # the experimenter decides


def test_drop_outs_are_replaced(records):
    codes = [records.add_subject().code for _ in range(6)]
    assert [records.subject(c).row for c in codes] == list(range(6))
    records.set_state(codes[4], SubjectState.DROPPED)
    records.set_state(codes[1], SubjectState.COMPLETED)
    assert records.add_subject().row == 4


def test_deleting_a_subject_leaves_nothing(records):
    keep, gone = records.add_subject("keep").code, records.add_subject("gone", answers={"age": "37-secret"}).code
    for code in (keep, gone):
        one_trial(records, code)
    records.add_event("note", subject=gone, data={"text": "remark-secret"})
    commands = records.read_trials(records.entries(gone)).velocity.copy()
    records.delete_subject(gone)
    assert [s.code for s in records.subjects()] == [keep]
    assert len(records.entries()) == 1
    assert records.events() == []
    for file in records.folder.iterdir():
        content = file.read_bytes()
        assert b"secret" not in content
        assert commands[2].tobytes() not in content
    assert records.add_subject().number == 2  # a number is never used again


def test_what_is_not_right_is_refused_and_changes_nothing(records):
    code = records.add_subject().code
    number, _, q = one_trial(records, code, end=None)
    v = np.zeros((1, 2))
    before = records.read_trials(records.entries()).q.copy()
    for trial, first, velocity, configuration, message in [
        (number, 9, v, q[None], "continues with cycle 7, not 9"),
        (number, 6, v, q[None], "continues with cycle 7, not 6"),
        (99, 0, v, q[None], "does not exist"),
        (number, 7, np.zeros((1, 3)), q[None], "need commands"),
        (number, 7, v, np.full((1, 3), np.nan), "NaN"),
    ]:
        with pytest.raises(hf.InputError, match=message):
            records.append_cycles(trial, first, np.zeros(1), velocity=velocity, q=configuration)
    for early in (np.array([5.9 / 6]), np.array([-1.0])):
        with pytest.raises(hf.InputError, match="run backwards"):
            records.append_cycles(number, 7, early, velocity=v, q=q[None])
    with pytest.raises(hf.InputError, match="run backwards"):
        records.append_cycles(number, 7, np.array([3.0, 2.9]), velocity=np.zeros((2, 2)), q=np.stack([q, q]))
    with pytest.raises(hf.InputError, match="rating is 4"):
        records.rate_trial(number, 4)
    with pytest.raises(hf.InputError, match="a subject S01 already"):
        records.add_subject("S01")
    with pytest.raises(hf.InputError, match="cannot be a subject's code"):
        records.add_subject("Ann Smith")
    with pytest.raises(hf.InputError, match="there is no subject nobody"):
        records.delete_subject("nobody")
    np.testing.assert_array_equal(records.read_trials(records.entries()).q, before)
    records.finish_trial(number, End.ARRIVED, q)
    with pytest.raises(hf.InputError, match="has ended"):
        records.append_cycles(number, 7, np.zeros(1), velocity=v, q=q[None])
    with pytest.raises(hf.InputError, match="already ended"):
        records.finish_trial(number, End.ARRIVED, q)


def test_folders_that_are_no_experiment(records, protocol, tmp_path):
    with pytest.raises(hf.StoreError, match="not an empty folder"):
        Records.create(records.folder, protocol)
    with pytest.raises(hf.StoreError, match="contains no experiment"):
        Records.open(tmp_path)
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad" / "records.sqlite").write_bytes(b"not a database" * 100)
    with pytest.raises(hf.StoreError, match="damaged"):
        Records.open(tmp_path / "bad")
    text = (records.folder / "protocol.yaml").read_text()
    (records.folder / "protocol.yaml").write_text(text.replace("rate: 6.0", "rate: 7.0"))
    with pytest.raises(hf.StoreError, match="not the protocol"):
        Records.open(records.folder)


def test_arm_files_travel_with_the_experiment(tmp_path):
    arm = tmp_path / "mine.yaml"
    rows = "".join(f"  - {{name: j{k}, a: {0.5 + 0.1 * k}, alpha: 0, d: 0}}\n" for k in range(3))
    arm.write_text("name: mine\nrows:\n" + rows)
    text = read_protocol().to_yaml().replace("arm: planar-3r", "arm: mine.yaml")
    for k in (1, 2, 3):
        text = text.replace(f"joint: joint{k}", f"joint: j{k - 1}")
    (tmp_path / "p.yaml").write_text(text)
    with Records.create(tmp_path / "experiment", read_protocol(tmp_path / "p.yaml")) as records:
        arm.unlink()
        with Records.open(records.folder) as again:
            assert again.protocol.arm.joint_names == ("j0", "j1", "j2")


@pytest.mark.parametrize("kills", [int(os.environ.get("HOLDFAST_KILLS", "4"))])
def test_killed_at_any_moment(tmp_path, kills):
    """After kill -9, all that was acknowledged is there, the file is sound, and the session goes on."""
    folder = tmp_path / "experiment"
    whole = read_protocol()
    quick = tuple(s for s in whole.scenarios if s.law == "pseudoinverse")
    Records.create(folder, replace(whole, substeps=1, scenarios=quick)).close()
    rng = np.random.default_rng()
    acknowledged: dict[tuple[int, int], str] = {}
    ended: set[int] = set()
    for _ in range(kills):
        with subprocess.Popen(
            [sys.executable, str(PROGRAM), str(folder), "P1", "20"],
            stdout=subprocess.PIPE,
            text=True,
        ) as program:
            lines = [program.stdout.readline()]
            until = time.monotonic() + rng.uniform(0, 0.4)
            while time.monotonic() < until:
                lines.append(program.stdout.readline())
            os.kill(program.pid, signal.SIGKILL)
            lines += program.stdout.read().splitlines()
        for line in lines:
            match line.split():
                case [number, "end"]:
                    ended.add(int(number))
                case [number, k, q] if len(q) == 48:
                    acknowledged[int(number), int(k)] = q
    assert len(acknowledged) > kills
    with Records.open(folder) as again:  # checks that the file is sound
        entries = again.entries("P1")
        trials = again.read_trials(entries)
        row = {e.id: i for i, e in enumerate(entries)}
        for (number, k), q in acknowledged.items():
            assert trials.configurations(row[number])[k].tobytes().hex() == q
        assert {e.id for e in entries if e.end == End.ARRIVED} >= ended
        assert replay_trials(again).differing_entries == []
        assert Session(again, "P1").next_trial() is not None or again.subject("P1").state == SubjectState.COMPLETED


@pytest.fixture
def archive(protocol):
    """A folder of records that nobody may write: for root too, who becomes nobody meanwhile."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "experiment"
        with Records.create(folder, protocol) as records:
            one_trial(records, records.add_subject().code)
        Path(place).chmod(0o755)
        folder.chmod(0o555)
        for file in folder.iterdir():
            file.chmod(0o444)
        if root := os.geteuid() == 0:
            os.seteuid(65534)
        try:
            yield folder
        finally:
            if root:
                os.seteuid(0)
            folder.chmod(0o755)


def test_a_read_only_archive_is_read(archive):
    with Records.open(archive) as records:
        assert records.read_only
        (entry,) = records.entries()
        assert records.read_trials([entry]).cycles.tolist() == [7]
        with pytest.raises(hf.StoreError, match="cannot be written; copy it"):
            records.add_subject()
    assert verify_records(archive).damages == []
    assert sorted(f.name for f in archive.iterdir()) == ["protocol.yaml", "records.sqlite"]


def test_an_archive_that_was_copied_in_mid_write_says_what_to_do(archive):
    os.seteuid(os.getuid())
    archive.chmod(0o755)
    (archive / "records.sqlite-wal").write_bytes(b"x" * 100)
    archive.chmod(0o555)
    if os.getuid() == 0:
        os.seteuid(65534)
    with pytest.raises(hf.StoreError, match="copy the whole folder"):
        Records.open(archive)


def test_a_folder_that_is_deleted_or_replaced_takes_nothing_more(records, protocol):
    code = records.add_subject().code
    records.folder.rename(records.folder.with_name("moved"))
    with pytest.raises(hf.StoreError, match="no longer exists"):
        records.set_note(code, "lost")
    Records.create(records.folder, protocol).close()
    with pytest.raises(hf.StoreError, match="no longer exists"):
        records.set_note(code, "lost")
    with Records.open(records.folder.with_name("moved")) as moved:
        assert moved.subject(code).note == ""


def test_events_are_exported_as_json_and_text_is_no_formula(records, tmp_path):
    import pandas as pd

    code = records.add_subject(answers={"job": '=HYPERLINK("http://127.0.0.1")', "age": 30, "hand": "-"}).code
    records.set_note(code, "@SUM(1)")
    data = {"count": 3, "why": "it's \u00fc", "ok": True}
    records.add_event("dropped-frames", code, data=data)
    export_tables(records, tmp_path / "csv")
    events = pd.read_csv(tmp_path / "csv" / "events.csv")
    assert json.loads(events["data"][0]) == data
    (subject,) = pd.read_csv(tmp_path / "csv" / "subjects.csv").to_dict("records")
    assert (subject["answer job"], subject["note"]) == ('\'=HYPERLINK("http://127.0.0.1")', "'@SUM(1)")
    assert (subject["answer hand"], subject["answer age"]) == ("'-", 30)
