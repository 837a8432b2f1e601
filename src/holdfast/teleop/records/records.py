"""The records of an experiment: one SQLite file, written as things happen, that no crash can spoil.

What has been acknowledged, that is, what a method returned from, is on the disk: a killed program, or a power cut, loses at
most what came after. Subjects have codes, never names.
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
from numpy.typing import NDArray

from holdfast.errors import InputError, StoreError
from holdfast.teleop.protocol.order import next_row
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.digests import Chain
from holdfast.teleop.records.entries import ENTRY, SUBJECT, Entry, Kind, State, Subject, Who, blob, read_entry, read_subject
from holdfast.teleop.records.file import alone, beside, connect, make, now, place
from holdfast.teleop.trials.recordings import End, RecordedCycles, Trials
from holdfast.teleop.trials.scenarios import PointTasks

Array = NDArray[np.float64]

_OUTERMOST = ("BEGIN IMMEDIATE", "COMMIT", "ROLLBACK")
_NESTED = ("SAVEPOINT part", "RELEASE part", "ROLLBACK TO part", "RELEASE part")
_CODE = re.compile("[A-Za-z0-9][A-Za-z0-9_-]{0,39}")


class Records:
    """The records of one experiment in a folder: ``protocol.yaml`` and ``records.sqlite``.

    One connection, for one thread; several programs may have the same folder open. See :meth:`create` and :meth:`open`.

    Attributes:
        folder: The folder.
        protocol: The protocol as it was when the experiment began.
        read_only: Nothing can be changed, as the folder cannot be written.
    """

    def __init__(self, folder: Path, connection: sqlite3.Connection, protocol: Protocol, *, read_only: bool = False) -> None:
        self.folder, self._db, self.protocol, self.read_only = folder, connection, protocol, read_only
        self._chain = Chain(connection, folder, beside(protocol))
        self._depth, self._place = 0, place(folder)

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(cls, folder: str | Path, protocol: Protocol, simulation: Mapping[str, Any] | None = None) -> Records:
        """Begin an experiment in a new or empty folder.

        The protocol, and the arm's file if it has one, are copied into the folder.

        Args:
            folder: The folder.
            protocol: The protocol.
            simulation: JSON data that define the results where all subjects are simulated; see :attr:`simulation`.

        Raises:
            StoreError: The folder is not empty, or cannot be written.
        """
        make(Path(folder), protocol, {} if simulation is None else {"simulation": json.dumps(simulation)})
        return cls.open(folder)

    @classmethod
    def open(cls, folder: str | Path) -> Records:
        """Open the experiment in a folder; only to read where the folder cannot be written.

        Raises:
            StoreError: There is none, it is damaged, or of another format.
        """
        connection, protocol, read_only = connect(Path(folder))
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
        """What the experiment was begun with."""
        found: dict[str, str] = json.loads(self._value("SELECT value FROM about WHERE key = 'versions'"))
        return found

    @property
    def simulation(self) -> dict[str, Any] | None:
        """JSON data that define the results of a simulated experiment; None for an experiment with people."""
        row = self._db.execute("SELECT value FROM about WHERE key = 'simulation'").fetchone()
        return None if row is None else dict(json.loads(row[0]))

    # ---- subjects --------------------------------------------------------------------------------------------------

    def add_subject(self, code: str | None = None, kind: Who = Who.PERSON, answers: Mapping[str, Any] | None = None) -> Subject:
        """A new subject, with the row of the square that the fewest have completed.

        Args:
            code: As the laboratory calls the subject, no name; ``S01`` and so on if not given.
            kind: A person, or not.
            answers: To questions, as JSON takes them.

        Raises:
            InputError: A code that is taken or has other characters than it may have.
        """
        with self.together():
            taken = {row[0] for row in self._db.execute("SELECT code FROM subjects")}
            number = int(self._value("SELECT COALESCE(MAX(number) + 1, 0) FROM subjects"))
            number = max(number, int(self._value("SELECT COALESCE((SELECT value FROM about WHERE key = 'next'), 0)")))
            if code is None:
                code = next(c for k in range(number, number + len(taken) + 1) if (c := f"S{k + 1:02d}") not in taken)
            if not _CODE.fullmatch(code):
                raise InputError(
                    f"'{code}' cannot be a subject's code; use a letter or digit, then letters, digits, - and _, at most 40"
                )
            if code in taken:
                raise InputError(f"there is a subject {code} already; give another code")
            states = self._db.execute("SELECT row, state FROM subjects WHERE kind = ?", (kind,)).fetchall()
            completed, open_ = ([row for row, state in states if state == wanted] for wanted in (State.COMPLETED, State.OPEN))
            row = next_row(completed, open_, len(self.protocol.order()))
            self._db.execute(
                "INSERT INTO subjects (code, number, row, kind, state, since, answers) VALUES (?, ?, ?, ?, ?, ?, ?)",
                (code, number, row, kind, State.OPEN, now(), json.dumps(dict(answers or {}))),
            )
            # A number is never given twice, also where its subject was deleted.
            self._db.execute("INSERT OR REPLACE INTO about VALUES ('next', ?)", (str(number + 1),))
            self._chain.add("experiment")
            self._chain.add("subject", code)
        return self.subject(code)

    def subject(self, code: str) -> Subject:
        """The subject with this code.

        Raises:
            InputError: There is none.
        """
        row = self._db.execute(f"SELECT {SUBJECT} FROM subjects WHERE code = ?", (code,)).fetchone()
        if row is None:
            raise InputError(
                f"there is no subject {code}; there are {', '.join(s.code for s in self.subjects()) or 'none yet'}"
            )
        return read_subject(row)

    def subjects(self) -> list[Subject]:
        """All subjects, in the order in which they came."""
        return [read_subject(row) for row in self._db.execute(f"SELECT {SUBJECT} FROM subjects ORDER BY number")]

    def set_state(self, code: str, state: State) -> None:
        """A session is completed, dropped, or open again.

        Raises:
            InputError: There is no such subject.
        """
        self._on_subject(code, "state", state)

    def set_note(self, code: str, note: str) -> None:
        """The experimenter's note about a subject.

        Raises:
            InputError: There is no such subject.
        """
        self._on_subject(code, "note", note)

    def set_answers(self, code: str, answers: Mapping[str, Any]) -> None:
        """What a subject answered, in place of what was there.

        Raises:
            InputError: There is no such subject.
        """
        self._on_subject(code, "answers", json.dumps(dict(answers)))

    def delete_subject(self, code: str) -> None:
        """Delete a subject and everything that was recorded of him or her, for good: the space is overwritten.

        Raises:
            InputError: There is no such subject.
            StoreError: The folder is served, or cannot be written.
        """
        self.subject(code)
        with alone(self.folder):
            self._db.execute("PRAGMA secure_delete = ON")
            with self.together():
                self._chain.prepare()
                self._db.execute("DELETE FROM subjects WHERE code = ?", (code,))
            self._db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            self._db.execute("VACUUM")

    # ---- sessions of pages -----------------------------------------------------------------------------------------

    def give_key(self, code: str, key: str | None = None) -> str:
        """A new secret key to a subject's session, in place of an older one; only its hash is kept.

        Args:
            code: The subject.
            key: That the page made; one is made here if not given.

        Raises:
            InputError: There is no such subject.
        """
        self.subject(code)
        key = secrets.token_urlsafe(24) if key is None else key
        with self.together():
            self._chain.prepare()
            self._db.execute(
                "INSERT INTO sessions (subject, key, seq) VALUES (?, ?, 0) "
                "ON CONFLICT (subject) DO UPDATE SET key = excluded.key",
                (code, _hash(key)),
            )
            self._chain.session(code)
        return key

    def key_holder(self, key: str) -> str | None:
        """Code of the subject whose session has this key."""
        row = self._db.execute("SELECT subject FROM sessions WHERE key = ?", (_hash(key),)).fetchone()
        return None if row is None else str(row[0])

    def last_seq(self, code: str) -> int:
        """Number of the last message of a subject's page that is on record; 0 for none."""
        return int(self._value("SELECT COALESCE((SELECT seq FROM sessions WHERE subject = ?), 0)", code))

    def set_last_seq(self, code: str, seq: int, size: int = 0) -> None:
        """See :meth:`last_seq`, and :meth:`received` more bytes; for one transaction with what the message changes."""
        self._db.execute("UPDATE sessions SET seq = ?, bytes = bytes + ? WHERE subject = ?", (seq, size, code))
        self._chain.session(code)

    def received(self, code: str) -> int:
        """How many bytes of messages are on record of a subject's page."""
        return int(self._value("SELECT COALESCE((SELECT bytes FROM sessions WHERE subject = ?), 0)", code))

    def prepare(self) -> None:
        """Make what is missing in a folder of an older holdfast, before it is written to."""
        with self.together():
            self._chain.prepare()

    # ---- trials ----------------------------------------------------------------------------------------------------

    def begin_trial(self, subject: str, kind: Kind, position: int, *, scenario: int, tasks: PointTasks, task: int = -1) -> int:
        """A trial begins.

        Args:
            subject: Code.
            kind: What it is for.
            position: In the session, from 0.
            scenario: Index from 0.
            tasks: One task: start, target and joint.
            task: Its index from 0 in the protocol; -1 in training.

        Returns:
            The number of the trial in the records.

        Raises:
            InputError: There is no such subject or scenario, or not exactly one task.
        """
        self.subject(subject)
        if len(tasks) != 1 or not 0 <= scenario < len(self.protocol.scenarios):
            raise InputError(f"a trial has one task and one of {len(self.protocol.scenarios)} scenarios, counted from 0")
        with self.together():
            # What was left open is over now.
            for (left,) in self._db.execute("SELECT id FROM trials WHERE subject = ? AND end IS NULL", (subject,)).fetchall():
                self._db.execute("UPDATE trials SET end = ? WHERE id = ?", (int(End.BROKEN_OFF), left))
                self._chain.end(left, subject)
            cursor = self._db.execute(
                "INSERT INTO trials (subject, kind, position, task, scenario, joint, q0, target, began) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (subject, kind, position, task, scenario, int(tasks.joint[0]), blob(tasks.q0[0]), blob(tasks.target[0]), now()),
            )
            assert cursor.lastrowid is not None
            self._chain.begin(cursor.lastrowid, subject)
        return cursor.lastrowid

    def append(self, trial: int, first: int, time: Array, *, velocity: Array, q: Array) -> None:
        """Cycles of a trial; when this returns they are on the disk.

        Args:
            trial: Its number.
            first: Index from 0 of the first of them: the next one of the trial.
            time: (K,) s since the trial began, by the clock of who holds the stick; none before the one before it.
            velocity: (K, m) commands, m/cycle.
            q: (K, n) configurations when each cycle began, rad and m.

        Raises:
            InputError: There is no such trial, it has ended, a cycle is missing or there already, its time runs backwards, or
                the arrays do not fit.
        """
        n, m = self.protocol.arm.n, self.protocol.rows.m
        if velocity.shape != (len(time), m) or q.shape != (len(time), n):
            raise InputError(f"{len(time)} cycles need commands ({len(time)}, {m}) and configurations ({len(time)}, {n})")
        if not (np.isfinite(velocity).all() and np.isfinite(q).all() and np.isfinite(time).all()):
            raise InputError("a cycle holds NaN or infinity; nothing was recorded")
        # SQLite knows no -0.0.
        rows = [(trial, first + i, float(time[i]) + 0.0, blob(velocity[i]), blob(q[i])) for i in range(len(time))]
        with self.together():
            found = self._db.execute("SELECT end FROM trials WHERE id = ?", (trial,)).fetchone()
            if found is None or found[0] is not None:
                raise InputError(f"trial {trial} {'has ended' if found else 'does not exist'}; nothing was recorded")
            there = int(self._value("SELECT COALESCE(MAX(k) + 1, 0) FROM cycles WHERE trial = ?", trial))
            if first != there:
                raise InputError(f"trial {trial} continues with cycle {there}, not {first}; nothing was recorded")
            last = self._value("SELECT COALESCE((SELECT time FROM cycles WHERE trial = ? AND k = ?), 0)", trial, there - 1)
            if (np.diff(time, prepend=last) < 0).any():
                raise InputError("the times of the cycles run backwards, or begin before the trial; nothing was recorded")
            self._db.executemany("INSERT INTO cycles VALUES (?, ?, ?, ?, ?)", rows)
            self._chain.go_on(trial, [row[1:] for row in rows])

    def finish(self, trial: int, end: End, q_end: Array) -> None:
        """A trial is over: how, and in which configuration (n,) the arm is left.

        Raises:
            InputError: There is no such trial, or it has ended already.
        """
        with self.together():
            changed = self._db.execute(
                "UPDATE trials SET ended = ?, end = ? WHERE id = ? AND end IS NULL", (now(), int(end), trial)
            ).rowcount
            if changed != 1:
                raise InputError(f"trial {trial} does not exist or has ended already")
            count = int(self._value("SELECT COUNT(*) FROM cycles WHERE trial = ?", trial))
            # The last row has no command: it is where the arm is at the end.
            row = (count, -1.0, blob(np.zeros(self.protocol.rows.m)), blob(q_end))
            self._db.execute("INSERT INTO cycles VALUES (?, ?, ?, ?, ?)", (trial, *row))
            self._chain.go_on(trial, [row])
            self._chain.end(trial, self._value("SELECT subject FROM trials WHERE id = ?", trial))

    def rate(self, trial: int, rating: int, answers: Mapping[str, Any] | None = None) -> None:
        """The rating of a trial, a step from 0, and answers to further questions.

        Raises:
            InputError: There is no such trial, it is one of the training, or the rating has no such step.
        """
        if not 0 <= rating < len(self.protocol.rating):
            raise InputError(f"the rating is {rating}; it must be 0 to {len(self.protocol.rating) - 1}")
        with self.together():
            entry = self.entry(trial)
            if entry is None:
                raise InputError(f"trial {trial} does not exist")
            if entry.kind == Kind.TRAINING:
                raise InputError(f"trial {trial} is one of the training, which has no ratings; rate trials that count")
            said = json.dumps(dict(answers or {}))
            self._db.execute("UPDATE trials SET rating = ?, answers = ? WHERE id = ?", (rating, said, trial))
            self._chain.add("rating", entry.subject, trial)

    def event(
        self,
        kind: str,
        subject: str | None = None,
        trial: int | None = None,
        *,
        k: int | None = None,
        data: Mapping[str, Any] | None = None,
    ) -> None:
        """Something happened: a pause, a dropped frame, a lost connection, a note."""
        row = (trial, subject, k, now(), kind, json.dumps(dict(data or {})))
        with self.together():
            cursor = self._db.execute("INSERT INTO events (trial, subject, k, at, kind, data) VALUES (?, ?, ?, ?, ?, ?)", row)
            self._chain.add("event", subject, cursor.lastrowid)

    def events(self, kind: str | None = None) -> list[dict[str, Any]]:
        """All events, or those of one kind, in the order in which they came."""
        names = ("trial", "subject", "k", "at", "kind", "data")
        rows = self._db.execute(f"SELECT {', '.join(names)} FROM events WHERE ?1 IS NULL OR kind = ?1 ORDER BY id", (kind,))
        return [dict(zip(names, row, strict=True)) | {"data": json.loads(row[-1])} for row in rows]

    def entries(self, subject: str | None = None, kind: Kind | None = None) -> list[Entry]:
        """The trials, of one subject or of one kind, in the order in which they began."""
        where = "WHERE (?1 IS NULL OR subject = ?1) AND (?2 IS NULL OR kind = ?2)"
        return [read_entry(row) for row in self._db.execute(f"SELECT {ENTRY} FROM trials {where} ORDER BY id", (subject, kind))]

    def entry(self, trial: int) -> Entry | None:
        """A trial by its number."""
        row = self._db.execute(f"SELECT {ENTRY} FROM trials WHERE id = ?", (trial,)).fetchone()
        return None if row is None else read_entry(row)

    def latest(self, subject: str) -> Entry | None:
        """The trial that a subject began last."""
        row = self._db.execute(f"SELECT {ENTRY} FROM trials WHERE subject = ? ORDER BY id DESC LIMIT 1", (subject,)).fetchone()
        return None if row is None else read_entry(row)

    def count(self, entry: Entry) -> int:
        """Number of cycles of a trial."""
        return int(self._value("SELECT COUNT(*) FROM cycles WHERE trial = ? AND time >= 0", entry.id))

    def progress(self) -> dict[tuple[str, Kind], int]:
        """How many trials of each kind every subject has done; not those that were broken off."""
        query = "SELECT subject, kind, COUNT(DISTINCT position) FROM trials WHERE end != ? GROUP BY subject, kind"
        return {(code, Kind(kind)): count for code, kind, count in self._db.execute(query, (int(End.BROKEN_OFF),))}

    def tasks(self, entries: list[Entry]) -> PointTasks:
        """What was to be done in some trials."""
        n, m = self.protocol.arm.n, self.protocol.rows.m
        return PointTasks(
            np.array([e.q0 for e in entries]).reshape(-1, n),
            np.array([e.target for e in entries]).reshape(-1, m),
            np.array([e.joint for e in entries], dtype=np.int64),
        )

    def trials(self, entries: list[Entry]) -> Trials:
        """What was recorded of some trials.

        Commands and configurations come from the file; tool points and actual velocities follow from them.
        """
        recorded = self.recorded(entries)
        plant = self.protocol.plants
        ends = recorded.first[1:] - 1
        cycles = np.delete(np.arange(len(recorded.q)), ends)
        every_q, every_v = recorded.q[cycles], recorded.velocity[cycles]
        starts = recorded.first - np.arange(len(entries) + 1)
        of = np.repeat(np.arange(len(entries)), np.diff(starts))
        tasks = self.tasks(entries)
        scenario = np.array([e.scenario for e in entries], dtype=np.int64)
        failed = np.array([s.failed for s in self.protocol.scenarios], dtype=bool)[scenario]
        healthy = tasks.healthy(failed)
        actual = np.empty_like(every_v)
        for k, p in enumerate(plant):
            mine = np.flatnonzero(scenario[of] == k)
            if mine.size:
                actual[mine] = p.cycles(every_q[mine], every_v[mine], healthy[of[mine]])[1]
        return Trials(
            velocity=every_v,
            q=every_q,
            x=plant[0].position(every_q),
            actual=actual,
            first=starts,
            q_end=recorded.q[ends],
            x_end=plant[0].position(recorded.q[ends]),
            target=tasks.target,
            end=np.array([int(e.end) for e in entries], dtype=np.uint8),
        )

    def recorded(self, entries: list[Entry]) -> RecordedCycles:
        """What is in the file of some trials."""
        time: list[float] = []
        velocity, q, first = bytearray(), bytearray(), [0]
        for e in entries:
            # The last row is where the arm was at the end; of a trial that was broken off, that before the last command.
            rows = self._db.execute("SELECT time, velocity, q FROM cycles WHERE trial = ? ORDER BY k", (e.id,)).fetchall()
            times, velocities, configurations = zip(
                *(rows or [(np.nan, blob(np.zeros(self.protocol.rows.m)), blob(e.q0))]), strict=True
            )
            time += times
            velocity += b"".join(velocities)
            q += b"".join(configurations)
            first.append(len(time))
        found = RecordedCycles(
            time=np.array(time, dtype=np.float64),
            velocity=np.frombuffer(velocity).reshape(-1, self.protocol.rows.m),
            q=np.frombuffer(q).reshape(-1, self.protocol.arm.n),
            first=np.array(first),
        )
        ends = found.first[1:] - 1
        found.time[ends], found.velocity[ends] = np.nan, np.nan
        return found

    def times(self, entry: Entry) -> Array:
        """(K,) s since the trial began, of each cycle, by the clock of who held the stick."""
        rows = self._db.execute("SELECT time FROM cycles WHERE trial = ? AND time >= 0 ORDER BY k", (entry.id,))
        return np.array([r[0] for r in rows])

    # ---- the file --------------------------------------------------------------------------------------------------

    @contextmanager
    def together(self) -> Iterator[None]:
        """All changes made inside, or none; they are acknowledged when the block ends.

        Raises:
            StoreError: The folder cannot be written, or was deleted.
        """
        if self.read_only:
            raise StoreError(f"'{self.folder}' cannot be written; copy it to where you may write")
        # Part of a larger change: undone by itself where it fails, and kept if the larger one is.
        begin, keep, *undo = _NESTED if self._depth else _OUTERMOST
        self._db.execute(begin)
        self._depth += 1
        try:
            yield
            if self._depth == 1 and place(self.folder) != self._place:
                raise StoreError(f"the folder '{self.folder}' is not there any more, or is another one; nothing was recorded")
            self._db.execute(keep)
        except BaseException:
            for statement in undo if self._db.in_transaction else ():  # a full disk has ended it already
                self._db.execute(statement)
            self._chain.undone()
            raise
        finally:
            self._depth -= 1

    @contextmanager
    def reading(self) -> Iterator[None]:
        """All that is read inside is of one moment, while others go on writing; nothing may be changed inside."""
        self._db.execute("BEGIN")
        try:
            yield
        finally:
            self._db.execute("ROLLBACK")

    @property
    def changes(self) -> int:
        """How many rows were changed since the file was opened."""
        return self._db.total_changes

    def copy_to(self, target: sqlite3.Connection) -> None:
        """Copy the file as it is at one moment, while others may go on writing."""
        self._db.backup(target)

    def _value(self, query: str, *values: Any) -> Any:
        return self._db.execute(query, values).fetchone()[0]

    def _on_subject(self, code: str, column: str, value: str) -> None:
        with self.together():
            self.subject(code)
            self._db.execute(f"UPDATE subjects SET {column} = ? WHERE code = ?", (value, code))
            self._chain.add("subject", code)


def _hash(key: str) -> bytes:
    return hashlib.sha256(key.encode()).digest()
