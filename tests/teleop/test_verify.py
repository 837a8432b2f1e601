"""Check digests by an independent implementation of docs/reference/record-digests.md, on changed bits and old folders."""

import hashlib
import json
import sqlite3
import struct
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

import flips
import holdfast as hf
from holdfast.teleop.protocol.protocol import read_protocol
from holdfast.teleop.records.entries import TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.verification import verify_records
from holdfast.teleop.trials.recordings import End


@pytest.fixture(scope="module")
def experiment(tmp_path_factory):
    """A folder with all that records have."""
    folder = tmp_path_factory.mktemp("verified") / "experiment"
    flips.experiment(folder)
    return folder


@pytest.fixture
def changed(experiment, tmp_path):
    """``changed(sql, ...)``: a copy of the records in which something was changed by hand, and what is found then."""

    def change(*statements):
        flips.copied(experiment, tmp_path / "copy")
        with closing(sqlite3.connect(tmp_path / "copy" / "records.sqlite")) as db, db:
            for statement in statements:
                assert db.execute(statement).rowcount == 1
        return verify_records(tmp_path / "copy")

    return change


def test_what_was_written_is_sound(experiment):
    found = verify_records(experiment)
    assert found.damages == []
    assert found.trials_without_digest == []
    assert found.trials == 6
    assert len(found.overall_digest) == 64


def by_hand(folder):
    """The last digest of each chain, as docs/reference/record-digests.md says, without a line of holdfast."""

    def packed(row):
        out = b""
        for value in row:
            match value:
                case None:
                    out += b"n"
                case float():
                    out += b"r" + struct.pack("<d", value)
                case int():
                    out += f"i{value};".encode()
                case str():
                    out += f"t{len(value.encode())}:".encode() + value.encode()
                case bytes():
                    out += f"b{len(value)}:".encode() + value
        return out

    def sha(data):
        return hashlib.sha256(data).digest()

    chains = {}
    with closing(sqlite3.connect(folder / "records.sqlite")) as db:
        last = {}
        for number, subject, kind, item, *_ in db.execute("SELECT * FROM digests ORDER BY id"):
            last[kind, subject if kind == "subject" else item] = number
        for number, subject, kind, item, content, digest in db.execute("SELECT * FROM digests ORDER BY id").fetchall():
            if kind == "trial":
                names = "id, subject, kind, position, task, scenario, joint, q0, target, began"
                now = sha(packed(db.execute(f"SELECT {names} FROM trials WHERE id = {item}").fetchone()))
                for row in db.execute(f"SELECT k, time, velocity, q FROM cycles WHERE trial = {item} ORDER BY k"):
                    now = sha(now + packed(row))
                now = sha(now + packed(db.execute(f"SELECT ended, end FROM trials WHERE id = {item}").fetchone()))
                assert now == content
            elif kind == "rating" and last[kind, item] == number:
                assert content == sha(
                    packed(db.execute(f"SELECT id, rating, answers FROM trials WHERE id = {item}").fetchone())
                )
            elif kind == "event":
                names = "id, trial, subject, k, at, kind, data"
                assert content == sha(packed(db.execute(f"SELECT {names} FROM events WHERE id = {item}").fetchone()))
            elif kind == "subject" and last[kind, subject] == number:
                names = "code, number, row, kind, state, since, answers, note"
                assert content == sha(packed(db.execute(f"SELECT {names} FROM subjects WHERE code = ?", (subject,)).fetchone()))
            elif kind == "experiment" and last[kind, item] == number:
                rows = db.execute("SELECT key, value FROM about ORDER BY key").fetchall()
                rows += db.execute(
                    "SELECT type, name, sql FROM sqlite_master WHERE sql NOT NULL ORDER BY type, name"
                ).fetchall()
                assert content == sha(b"".join(map(packed, rows)))
            assert digest == sha(chains.get(subject, b"") + packed((number, subject, kind, item, content)))
            chains[subject] = digest
        for *row, digest in db.execute("SELECT subject, key, seq, bytes, digest FROM sessions"):
            assert digest == sha(packed(row))
        files = json.loads(db.execute("SELECT value FROM about WHERE key = 'files'").fetchone()[0])
    for name, wanted in files.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == wanted
    return chains


def test_a_stranger_gets_the_same_digests(experiment):
    chains = by_hand(experiment)
    assert set(chains) == {None, "S01", "S02"}
    together = b"".join(chains[s] for s in (None, "S01", "S02"))
    assert hashlib.sha256(together).hexdigest() == verify_records(experiment).overall_digest


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("UPDATE cycles SET time = time + 1e-9 WHERE trial = 4 AND k = 3", "trial 4 of S01 is not as it was written"),
        ("DELETE FROM cycles WHERE trial = 4 AND k = 5", "trial 4 of S01 is not"),
        ("UPDATE trials SET scenario = 1 - scenario WHERE id = 4", "trial 4 of S01 is not"),
        ("UPDATE trials SET rating = 0 WHERE id = 4", "the rating of trial 4 of S01 is not"),
        ("UPDATE trials SET answers = '{ }' WHERE id = 1", "the rating of trial 1 of S01 is not"),
        ("UPDATE trials SET rating = 2 WHERE id = 7", "the rating of trial 7 of S02 is not"),
        ("DELETE FROM trials WHERE id = 4", "trial 4 of S01 is missing"),
        ("DELETE FROM digests WHERE kind = 'trial' AND item = 4", "trial 4 of S01 has no digest"),
        ("UPDATE subjects SET note = 'left' WHERE code = 'S02'", "subject S02 is not as it was written"),
        ("UPDATE events SET data = '{}' WHERE id = 1", "event 1 of S01 is not"),
        ("UPDATE sessions SET seq = 7 WHERE subject = 'S01'", "the session of the page of S01"),
        ("UPDATE about SET value = '2020' WHERE key = 'began'", "the metadata of the experiment"),
        ("UPDATE cycles SET q = zeroblob(24) WHERE trial = 7 AND k = 2", "trial 7, which is not over, is not"),
    ],
)
def test_a_change_by_hand_is_named(changed, statement, said):
    found = changed(statement)
    assert any(sentence.startswith(said) for sentence in found.damages), found.damages


def test_the_first_damaged_trial_comes_first(changed):
    found = changed(
        "UPDATE subjects SET note = 'x' WHERE code = 'S01'",
        "UPDATE cycles SET time = 9 WHERE trial = 5 AND k = 1",
        "UPDATE cycles SET time = 9 WHERE trial = 3 AND k = 1",
    )
    assert [s.split()[:2] for s in found.damages] == [["trial", "3"], ["trial", "5"], ["subject", "S01"]]


def test_a_changed_protocol_is_found(experiment, tmp_path):
    flips.copied(experiment, tmp_path / "copy")
    with (tmp_path / "copy" / "protocol.yaml").open("a") as file:
        file.write("# nothing\n")
    assert verify_records(tmp_path / "copy").damages == ["the file protocol.yaml is not as it was when the experiment began"]


def test_an_older_folder_is_read_and_goes_on_with_digests(experiment, tmp_path):
    folder = tmp_path / "copy"
    flips.copied(experiment, folder)
    flips.older(folder)
    before = (folder / "records.sqlite").read_bytes()
    assert verify_records(folder).trials_without_digest == [1, 2, 3, 4, 5, 6]
    with Records.open(folder) as records:
        assert len(records.entries()) == 7
    assert verify_records(folder).damages == []
    assert (folder / "records.sqlite").read_bytes() == before  # reading adds nothing
    with Records.open(folder) as records:
        records.set_note("S01", "seen")
        flips.trial(records, "S02", np.random.default_rng(1))
    found = verify_records(folder)
    assert (found.damages, found.trials_without_digest, found.trials) == ([], [1, 2, 3, 4, 5, 6], 8)
    by_hand(folder)


def test_what_is_not_an_experiment(tmp_path):
    with pytest.raises(hf.StoreError, match="contains no experiment"):
        verify_records(tmp_path)


def test_a_deleted_subject_leaves_sound_records(experiment, tmp_path):
    flips.copied(experiment, tmp_path / "copy")
    with Records.open(tmp_path / "copy") as records:
        records.delete_subject("S01")
    found = verify_records(tmp_path / "copy")
    assert (found.damages, found.trials) == ([], 2)
    with Records.open(tmp_path / "copy") as records:
        records.add_subject()
        flips.trial(records, "S03", np.random.default_rng(1))
    assert verify_records(tmp_path / "copy").damages == []


def test_a_rolled_back_change_leaves_no_digest(tmp_path):
    protocol = replace(read_protocol(), substeps=1)
    with Records.create(tmp_path / "experiment", protocol) as records:

        def fails():
            with records.transaction():
                flips.trial(records, records.add_subject().code, np.random.default_rng(0))
                raise ZeroDivisionError

        with pytest.raises(ZeroDivisionError):
            fails()
        records.add_subject()
    assert verify_records(tmp_path / "experiment").damages == []
    with Records.open(tmp_path / "experiment") as records:
        assert records.entries(kind=TrialKind.TRIAL) == []
        assert End.ABORTED not in [e.end for e in records.entries()]
