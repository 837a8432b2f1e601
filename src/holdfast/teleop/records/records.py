"""Records of an experiment in one SQLite file, written immediately and safe against crashes.

Every change whose method has returned is on the disk, so a killed program, or a power cut, loses at most later changes.
Subjects have codes, never names.
"""

from __future__ import annotations

import hashlib
import json
import re
import secrets
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError, StoreError
from holdfast.core.typing import FloatArray
from holdfast.teleop.protocol.order import choose_next_row
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.digests import DigestChain
from holdfast.teleop.records.entries import (
    ENTRY_COLUMNS,
    SUBJECT_COLUMNS,
    Subject,
    SubjectKind,
    SubjectState,
    TrialKind,
    TrialRecord,
    pack_array,
    parse_subject_row,
    parse_trial_row,
)
from holdfast.teleop.records.file import (
    create_experiment,
    format_utc_now,
    get_file_identity,
    list_protocol_files,
    lock_records_folder,
    open_experiment,
)
from holdfast.teleop.trials.recordings import End, RecordedCycles, Trials
from holdfast.teleop.trials.scenarios import PointTasks

_OUTER_TRANSACTION = ("BEGIN IMMEDIATE", "COMMIT", "ROLLBACK")
_NESTED_TRANSACTION = ("SAVEPOINT part", "RELEASE part", "ROLLBACK TO part", "RELEASE part")
_CODE_PATTERN = re.compile("[A-Za-z0-9][A-Za-z0-9_-]{0,39}")


class Records:
    """Records of one experiment in a folder: ``protocol.yaml`` and ``records.sqlite``; see :meth:`create` and :meth:`open`.

    An object has one ``connection`` to the file, for one thread. Several programs may open the same folder at once.

    Attributes:
        folder: Folder of the experiment.
        protocol: Protocol at the beginning of the experiment.
        read_only: True if the folder cannot be written, so that nothing can be changed.
    """

    def __init__(self, folder: Path, connection: sqlite3.Connection, protocol: Protocol, *, read_only: bool = False) -> None:
        self.folder, self._db, self.protocol, self.read_only = folder, connection, protocol, read_only
        self._chain = DigestChain(connection, folder, list_protocol_files(protocol))
        self._depth, self._file_identity = 0, get_file_identity(folder)

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(cls, folder: str | Path, protocol: Protocol, simulation: Mapping[str, Any] | None = None) -> Records:
        """Create an experiment in a new or empty folder.

        The protocol, and the arm's file if it has one, are copied into the folder.

        Args:
            folder: New or empty folder.
            protocol: Protocol of the experiment.
            simulation: JSON data that determine the results if all subjects are simulated; see :attr:`simulation`.

        Raises:
            StoreError: The folder is not empty, or cannot be written.
        """
        create_experiment(Path(folder), protocol, {} if simulation is None else {"simulation": json.dumps(simulation)})
        return cls.open(folder)

    @classmethod
    def open(cls, folder: str | Path) -> Records:
        """Open the experiment in ``folder``; read-only if the folder cannot be written.

        Raises:
            StoreError: There is no experiment, or it is damaged or of another format.
        """
        connection, protocol, read_only = open_experiment(Path(folder))
        return cls(Path(folder), connection, protocol, read_only=read_only)

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    def __enter__(self) -> Records:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def versions(self) -> dict[str, str]:
        """Versions of holdfast and its libraries with which the experiment began."""
        stored_versions: dict[str, str] = json.loads(self._query_value("SELECT value FROM about WHERE key = 'versions'"))
        return stored_versions

    @property
    def simulation(self) -> dict[str, Any] | None:
        """JSON data that determine the results of a simulated experiment; None for an experiment with people."""
        row = self._db.execute("SELECT value FROM about WHERE key = 'simulation'").fetchone()
        return None if row is None else dict(json.loads(row[0]))

    # ---- subjects --------------------------------------------------------------------------------------------------

    def add_subject(
        self, code: str | None = None, kind: SubjectKind = SubjectKind.PERSON, answers: Mapping[str, Any] | None = None
    ) -> Subject:
        """Add a subject, with the row of the square that was completed by the fewest subjects.

        Args:
            code: Code of the subject, not a name. Default: ``S01`` and so on.
            kind: Person, simulated person, or computer.
            answers: Answers to questions, as JSON data.

        Raises:
            InputError: The code is taken or has invalid characters.
        """
        with self.transaction():
            used_codes = {row[0] for row in self._db.execute("SELECT code FROM subjects")}
            number = int(self._query_value("SELECT COALESCE(MAX(number) + 1, 0) FROM subjects"))
            number = max(number, int(self._query_value("SELECT COALESCE((SELECT value FROM about WHERE key = 'next'), 0)")))
            if code is None:
                code = next(
                    candidate
                    for index in range(number, number + len(used_codes) + 1)
                    if (candidate := f"S{index + 1:02d}") not in used_codes
                )
            if not _CODE_PATTERN.fullmatch(code):
                raise InputError(
                    f"'{code}' cannot be a subject's code; use a letter or digit, then letters, digits, - and _, at most 40"
                )
            if code in used_codes:
                raise InputError(f"there is a subject {code} already; give another code")
            states = self._db.execute("SELECT row, state FROM subjects WHERE kind = ?", (kind,)).fetchall()
            completed, in_progress = (
                [row for row, state in states if state == required_state]
                for required_state in (SubjectState.COMPLETED, SubjectState.OPEN)
            )
            row = choose_next_row(completed, in_progress, len(self.protocol.task_order()))
            self._db.execute(
                "INSERT INTO subjects (code, number, row, kind, state, since, answers) VALUES (?, ?, ?, ?, ?, ?, ?)",
                (code, number, row, kind, SubjectState.OPEN, format_utc_now(), json.dumps(dict(answers or {}))),
            )
            # A number is never used twice, even if its subject was deleted.
            self._db.execute("INSERT OR REPLACE INTO about VALUES ('next', ?)", (str(number + 1),))
            self._chain.append_link("experiment")
            self._chain.append_link("subject", code)
        return self.subject(code)

    def subject(self, code: str) -> Subject:
        """Return the subject with the code ``code``.

        Raises:
            InputError: There is no such subject.
        """
        row = self._db.execute(f"SELECT {SUBJECT_COLUMNS} FROM subjects WHERE code = ?", (code,)).fetchone()
        if row is None:
            raise InputError(
                f"there is no subject {code}; there are {', '.join(subject.code for subject in self.subjects()) or 'none yet'}"
            )
        return parse_subject_row(row)

    def subjects(self) -> list[Subject]:
        """Return all subjects, in the order in which they were added."""
        return [parse_subject_row(row) for row in self._db.execute(f"SELECT {SUBJECT_COLUMNS} FROM subjects ORDER BY number")]

    def set_state(self, code: str, state: SubjectState) -> None:
        """Set the session of the subject ``code`` to a ``state``: completed, dropped, or open again.

        Raises:
            InputError: There is no such subject.
        """
        self._update_subject(code, "state", state)

    def set_note(self, code: str, note: str) -> None:
        """Replace the experimenter's ``note`` about the subject ``code``.

        Raises:
            InputError: There is no such subject.
        """
        self._update_subject(code, "note", note)

    def set_answers(self, code: str, answers: Mapping[str, Any]) -> None:
        """Replace the ``answers`` (JSON data) of the subject ``code``.

        Raises:
            InputError: There is no such subject.
        """
        self._update_subject(code, "answers", json.dumps(dict(answers)))

    def delete_subject(self, code: str) -> None:
        """Delete the subject ``code`` and all of his or her records permanently: the space is overwritten.

        Raises:
            InputError: There is no such subject.
            StoreError: The folder is served, or cannot be written.
        """
        self.subject(code)
        with lock_records_folder(self.folder):
            self._db.execute("PRAGMA secure_delete = ON")
            with self.transaction():
                self._chain.create_tables()
                self._db.execute("DELETE FROM subjects WHERE code = ?", (code,))
            self._db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            self._db.execute("VACUUM")

    # ---- sessions of pages -----------------------------------------------------------------------------------------

    def give_key(self, code: str, key: str | None = None) -> str:
        """Give a subject's session a new secret key, which replaces an older one; only its hash is stored.

        Args:
            code: Code of the subject.
            key: Key from the page. Default: a new one.

        Raises:
            InputError: There is no such subject.
        """
        self.subject(code)
        key = secrets.token_urlsafe(24) if key is None else key
        with self.transaction():
            self._chain.create_tables()
            self._db.execute(
                "INSERT INTO sessions (subject, key, seq) VALUES (?, ?, 0) "
                "ON CONFLICT (subject) DO UPDATE SET key = excluded.key",
                (code, _hash_key(key)),
            )
            self._chain.update_session(code)
        return key

    def key_holder(self, key: str) -> str | None:
        """Return the code of the subject whose session has the key ``key``; None if there is none."""
        row = self._db.execute("SELECT subject FROM sessions WHERE key = ?", (_hash_key(key),)).fetchone()
        return None if row is None else str(row[0])

    def last_seq(self, code: str) -> int:
        """Return the number of the last recorded message from the page of the subject ``code``; 0 for none."""
        return int(self._query_value("SELECT COALESCE((SELECT seq FROM sessions WHERE subject = ?), 0)", code))

    def set_last_seq(self, code: str, seq: int, size: int = 0) -> None:
        """Set :meth:`last_seq` of the subject ``code`` to ``seq``, and add ``size`` bytes to :meth:`received_bytes`.

        This belongs in the transaction with the changes of the message.
        """
        self._db.execute("UPDATE sessions SET seq = ?, bytes = bytes + ? WHERE subject = ?", (seq, size, code))
        self._chain.update_session(code)

    def received_bytes(self, code: str) -> int:
        """Return the number of recorded message bytes from the page of the subject ``code``."""
        return int(self._query_value("SELECT COALESCE((SELECT bytes FROM sessions WHERE subject = ?), 0)", code))

    def upgrade_tables(self) -> None:
        """Create missing tables in a folder of an older version, before the first write."""
        with self.transaction():
            self._chain.create_tables()

    # ---- trials ----------------------------------------------------------------------------------------------------

    def begin_trial(
        self, subject: str, kind: TrialKind, position: int, *, scenario: int, tasks: PointTasks, task: int = -1
    ) -> int:
        """Begin a trial, and return its number.

        Args:
            subject: Code of the subject.
            kind: Purpose of the trial.
            position: Position in the session, from 0.
            scenario: Index of the scenario, from 0.
            tasks: Exactly one task, with start, target and joint.
            task: Index of the task in the protocol, from 0; -1 in training.

        Returns:
            The number of the trial in the records.

        Raises:
            InputError: The subject or scenario does not exist, or ``tasks`` has not exactly one task.
        """
        self.subject(subject)
        if len(tasks) != 1 or not 0 <= scenario < len(self.protocol.scenarios):
            raise InputError(f"a trial has one task and one of {len(self.protocol.scenarios)} scenarios, counted from 0")
        with self.transaction():
            # A trial that is still open is over now.
            for (open_trial,) in self._db.execute(
                "SELECT id FROM trials WHERE subject = ? AND end IS NULL", (subject,)
            ).fetchall():
                self._db.execute("UPDATE trials SET end = ? WHERE id = ?", (int(End.BROKEN_OFF), open_trial))
                self._chain.end_trial(open_trial, subject)
            cursor = self._db.execute(
                "INSERT INTO trials (subject, kind, position, task, scenario, joint, q0, target, began) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (
                    subject,
                    kind,
                    position,
                    task,
                    scenario,
                    int(tasks.joint[0]),
                    pack_array(tasks.q0[0]),
                    pack_array(tasks.target[0]),
                    format_utc_now(),
                ),
            )
            assert cursor.lastrowid is not None
            self._chain.begin_trial(cursor.lastrowid, subject)
        return cursor.lastrowid

    def append_cycles(self, trial: int, first: int, time: FloatArray, *, velocity: FloatArray, q: FloatArray) -> None:
        """Append cycles to a trial; they are on the disk when this method returns.

        Args:
            trial: Number of the trial.
            first: Index of the first of these cycles, from 0, which must be the next one of the trial.
            time: (K,) times since the trial began, s, by the clock of the operator's device; they must not decrease.
            velocity: (K, m) commands, m/cycle.
            q: (K, n) configurations at the beginning of each cycle, rad and m.

        Raises:
            InputError: The trial does not exist or has ended, a cycle is missing or already there, time decreases, or the
                shapes do not match.
        """
        n, m = self.protocol.arm.n, self.protocol.rows.m
        if velocity.shape != (len(time), m) or q.shape != (len(time), n):
            raise InputError(f"{len(time)} cycles need commands ({len(time)}, {m}) and configurations ({len(time)}, {n})")
        if not (np.isfinite(velocity).all() and np.isfinite(q).all() and np.isfinite(time).all()):
            raise InputError("a cycle contains NaN or infinity; nothing was recorded")
        # SQLite does not store -0.0.
        rows = [(trial, first + k, float(time[k]) + 0.0, pack_array(velocity[k]), pack_array(q[k])) for k in range(len(time))]
        with self.transaction():
            trial_row = self._db.execute("SELECT end FROM trials WHERE id = ?", (trial,)).fetchone()
            if trial_row is None or trial_row[0] is not None:
                raise InputError(f"trial {trial} {'has ended' if trial_row else 'does not exist'}; nothing was recorded")
            cycle_count = int(self._query_value("SELECT COALESCE(MAX(k) + 1, 0) FROM cycles WHERE trial = ?", trial))
            if first != cycle_count:
                raise InputError(f"trial {trial} continues with cycle {cycle_count}, not {first}; nothing was recorded")
            last_time = self._query_value(
                "SELECT COALESCE((SELECT time FROM cycles WHERE trial = ? AND k = ?), 0)", trial, cycle_count - 1
            )
            if (np.diff(time, prepend=last_time) < 0).any():
                raise InputError("the times of the cycles run backwards, or begin before the trial; nothing was recorded")
            self._db.executemany("INSERT INTO cycles VALUES (?, ?, ?, ?, ?)", rows)
            self._chain.update_trial_digest(trial, [row[1:] for row in rows])

    def finish_trial(self, trial: int, end: End, q_end: FloatArray) -> None:
        """Finish the trial with the number ``trial`` by its ``end`` and the final configuration ``q_end`` (n,), rad and m.

        Raises:
            InputError: The trial does not exist, or has already ended.
        """
        with self.transaction():
            changed = self._db.execute(
                "UPDATE trials SET ended = ?, end = ? WHERE id = ? AND end IS NULL", (format_utc_now(), int(end), trial)
            ).rowcount
            if changed != 1:
                raise InputError(f"trial {trial} does not exist or has already ended")
            cycle_count = int(self._query_value("SELECT COUNT(*) FROM cycles WHERE trial = ?", trial))
            # The last row has no command; it contains the final configuration.
            row = (cycle_count, -1.0, pack_array(np.zeros(self.protocol.rows.m)), pack_array(q_end))
            self._db.execute("INSERT INTO cycles VALUES (?, ?, ?, ?, ?)", (trial, *row))
            self._chain.update_trial_digest(trial, [row])
            self._chain.end_trial(trial, self._query_value("SELECT subject FROM trials WHERE id = ?", trial))

    def rate_trial(self, trial: int, rating: int, answers: Mapping[str, Any] | None = None) -> None:
        """Store the ``rating``, a step from 0, of the trial with the number ``trial``, and ``answers`` as JSON data.

        Raises:
            InputError: The trial does not exist or is a training trial, or the rating has no such step.
        """
        if not 0 <= rating < len(self.protocol.rating):
            raise InputError(f"the rating is {rating}; it must be 0 to {len(self.protocol.rating) - 1}")
        with self.transaction():
            entry = self.entry(trial)
            if entry is None:
                raise InputError(f"trial {trial} does not exist")
            if entry.kind == TrialKind.TRAINING:
                raise InputError(f"trial {trial} is a training trial, which has no rating; rate trials that count")
            answers_json = json.dumps(dict(answers or {}))
            self._db.execute("UPDATE trials SET rating = ?, answers = ? WHERE id = ?", (rating, answers_json, trial))
            self._chain.append_link("rating", entry.subject, trial)

    def add_event(
        self,
        kind: str,
        subject: str | None = None,
        trial: int | None = None,
        *,
        k: int | None = None,
        data: Mapping[str, Any] | None = None,
    ) -> None:
        """Record an event, such as a pause, a dropped frame, a lost connection, or a note.

        Args:
            kind: Name of the event.
            subject: Code of the subject; None for the whole experiment.
            trial: Number of the trial, if the event belongs to one.
            k: Index of the cycle, if the event belongs to one.
            data: Details, as JSON data.
        """
        row = (trial, subject, k, format_utc_now(), kind, json.dumps(dict(data or {})))
        with self.transaction():
            cursor = self._db.execute("INSERT INTO events (trial, subject, k, at, kind, data) VALUES (?, ?, ?, ?, ?, ?)", row)
            self._chain.append_link("event", subject, cursor.lastrowid)

    def events(self, kind: str | None = None) -> list[dict[str, Any]]:
        """Return all events, or those of the given ``kind``, in the order of their recording."""
        names = ("trial", "subject", "k", "at", "kind", "data")
        query = f"SELECT {', '.join(names)} FROM events WHERE :kind IS NULL OR kind = :kind ORDER BY id"
        rows = self._db.execute(query, {"kind": kind})
        return [dict(zip(names, row, strict=True)) | {"data": json.loads(row[-1])} for row in rows]

    def entries(self, subject: str | None = None, kind: TrialKind | None = None) -> list[TrialRecord]:
        """Return all trials, or those of one ``subject`` (code) or one ``kind``, in the order in which they began."""
        condition = "WHERE (:subject IS NULL OR subject = :subject) AND (:kind IS NULL OR kind = :kind)"
        query = f"SELECT {ENTRY_COLUMNS} FROM trials {condition} ORDER BY id"
        return [parse_trial_row(row) for row in self._db.execute(query, {"subject": subject, "kind": kind})]

    def entry(self, trial: int) -> TrialRecord | None:
        """Return the trial with the number ``trial``; None if there is no such trial."""
        row = self._db.execute(f"SELECT {ENTRY_COLUMNS} FROM trials WHERE id = ?", (trial,)).fetchone()
        return None if row is None else parse_trial_row(row)

    def latest_trial(self, subject: str) -> TrialRecord | None:
        """Return the trial that ``subject`` (code) began last; None if there is none."""
        row = self._db.execute(
            f"SELECT {ENTRY_COLUMNS} FROM trials WHERE subject = ? ORDER BY id DESC LIMIT 1", (subject,)
        ).fetchone()
        return None if row is None else parse_trial_row(row)

    def count_cycles(self, entry: TrialRecord) -> int:
        """Return the number of cycles of the trial ``entry``."""
        return int(self._query_value("SELECT COUNT(*) FROM cycles WHERE trial = ? AND time >= 0", entry.id))

    def count_trials(self) -> dict[tuple[str, TrialKind], int]:
        """Return the number of completed trials of each kind for every subject; trials that were broken off do not count."""
        query = "SELECT subject, kind, COUNT(DISTINCT position) FROM trials WHERE end != ? GROUP BY subject, kind"
        return {(code, TrialKind(kind)): count for code, kind, count in self._db.execute(query, (int(End.BROKEN_OFF),))}

    def read_tasks(self, entries: list[TrialRecord]) -> PointTasks:
        """Return the tasks of the trials ``entries``."""
        n, m = self.protocol.arm.n, self.protocol.rows.m
        return PointTasks(
            np.array([entry.q0 for entry in entries]).reshape(-1, n),
            np.array([entry.target for entry in entries]).reshape(-1, m),
            np.array([entry.joint for entry in entries], dtype=np.int64),
        )

    def read_trials(self, entries: list[TrialRecord]) -> Trials:
        """Return the recorded motions of the trials ``entries``.

        Commands and configurations are from the file; tool points and actual velocities are computed from them.
        """
        recorded = self.read_cycles(entries)
        plants = self.protocol.plants
        end_rows = recorded.first[1:] - 1
        cycles = np.delete(np.arange(len(recorded.q)), end_rows)
        every_q, every_v = recorded.q[cycles], recorded.velocity[cycles]
        starts = recorded.first - np.arange(len(entries) + 1)
        trial_of_cycle = np.repeat(np.arange(len(entries)), np.diff(starts))
        tasks = self.read_tasks(entries)
        scenario = np.array([entry.scenario for entry in entries], dtype=np.int64)
        failed = np.array([condition.failed for condition in self.protocol.scenarios], dtype=bool)[scenario]
        healthy = tasks.healthy_mask(failed)
        actual = np.empty_like(every_v)
        for index, plant in enumerate(plants):
            selected = np.flatnonzero(scenario[trial_of_cycle] == index)
            if selected.size:
                actual[selected] = plant.step_batch(every_q[selected], every_v[selected], healthy[trial_of_cycle[selected]])[1]
        return Trials(
            velocity=every_v,
            q=every_q,
            x=plants[0].position(every_q),
            actual=actual,
            first=starts,
            q_end=recorded.q[end_rows],
            x_end=plants[0].position(recorded.q[end_rows]),
            target=tasks.target,
            end=np.array([int(entry.end) for entry in entries], dtype=np.uint8),
        )

    def read_cycles(self, entries: list[TrialRecord]) -> RecordedCycles:
        """Return the stored rows of the trials ``entries``."""
        all_times: list[float] = []
        velocity, q, first = bytearray(), bytearray(), [0]
        for entry in entries:
            # The last row is the final configuration; for a trial that was broken off, the one before the last command.
            rows = self._db.execute("SELECT time, velocity, q FROM cycles WHERE trial = ? ORDER BY k", (entry.id,)).fetchall()
            times, velocities, configurations = zip(
                *(rows or [(np.nan, pack_array(np.zeros(self.protocol.rows.m)), pack_array(entry.q0))]), strict=True
            )
            all_times += times
            velocity += b"".join(velocities)
            q += b"".join(configurations)
            first.append(len(all_times))
        result = RecordedCycles(
            time=np.array(all_times, dtype=np.float64),
            velocity=np.frombuffer(velocity).reshape(-1, self.protocol.rows.m),
            q=np.frombuffer(q).reshape(-1, self.protocol.arm.n),
            first=np.array(first),
        )
        end_rows = result.first[1:] - 1
        result.time[end_rows], result.velocity[end_rows] = np.nan, np.nan
        return result

    def read_times(self, entry: TrialRecord) -> FloatArray:
        """Return the time (K,) of each cycle of ``entry``, s since the trial began, by the clock of the operator's page."""
        rows = self._db.execute("SELECT time FROM cycles WHERE trial = ? AND time >= 0 ORDER BY k", (entry.id,))
        return np.array([row[0] for row in rows])

    # ---- the file --------------------------------------------------------------------------------------------------

    @contextmanager
    def transaction(self) -> Iterator[None]:
        """Apply all changes in a ``with`` block, or none; they are on the disk when the block ends.

        Raises:
            StoreError: The folder cannot be written, or was deleted.
        """
        if self.read_only:
            raise StoreError(f"'{self.folder}' cannot be written; copy it to a folder that can be written")
        # Part of a larger change: undone separately if it fails, and kept if the larger one is.
        begin_statement, commit_statement, *undo_statements = _NESTED_TRANSACTION if self._depth else _OUTER_TRANSACTION
        self._db.execute(begin_statement)
        self._depth += 1
        try:
            yield
            if self._depth == 1 and get_file_identity(self.folder) != self._file_identity:
                raise StoreError(f"the folder '{self.folder}' no longer exists, or was replaced; nothing was recorded")
            self._db.execute(commit_statement)
        except BaseException:
            for statement in undo_statements if self._db.in_transaction else ():  # a full disk has already ended it
                self._db.execute(statement)
            self._chain.reset_after_rollback()
            raise
        finally:
            self._depth -= 1

    @contextmanager
    def read_snapshot(self) -> Iterator[None]:
        """Read one state of the records in a ``with`` block, while others may write; nothing may be changed inside."""
        self._db.execute("BEGIN")
        try:
            yield
        finally:
            self._db.execute("ROLLBACK")

    @property
    def changes(self) -> int:
        """Number of rows changed since the file was opened."""
        return self._db.total_changes

    def copy_to(self, target: sqlite3.Connection) -> None:
        """Copy the file as it is at one moment to the open database ``target``, while others may continue to write."""
        self._db.backup(target)

    def _query_value(self, query: str, *values: Any) -> Any:
        return self._db.execute(query, values).fetchone()[0]

    def _update_subject(self, code: str, column: str, value: str) -> None:
        with self.transaction():
            self.subject(code)
            self._db.execute(f"UPDATE subjects SET {column} = ? WHERE code = ?", (value, code))
            self._chain.append_link("subject", code)


def _hash_key(key: str) -> bytes:
    return hashlib.sha256(key.encode()).digest()
