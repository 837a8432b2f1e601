"""Digests of what is recorded: a chain of SHA-256 for each session, so that a changed bit does not go unseen.

``docs/files.md`` says how to check them without holdfast. They show damage, and a change by somebody who does not know of them;
whoever rewrites the whole chain is found out only by a digest that was written down elsewhere.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

FORMAT = 2  # of records with digests

SESSIONS = """CREATE TABLE IF NOT EXISTS sessions (
    subject TEXT PRIMARY KEY REFERENCES subjects(code) ON DELETE CASCADE, key BLOB NOT NULL UNIQUE, seq INTEGER NOT NULL,
    bytes INTEGER NOT NULL DEFAULT 0, digest BLOB
) WITHOUT ROWID"""
_TABLES = (
    """CREATE TABLE digests (
    id INTEGER PRIMARY KEY, subject TEXT REFERENCES subjects(code) ON DELETE CASCADE, kind TEXT NOT NULL, item INTEGER,
    content BLOB NOT NULL, digest BLOB NOT NULL
)""",
    "CREATE INDEX digests_of ON digests (subject)",
    "CREATE TABLE under_way (trial INTEGER PRIMARY KEY REFERENCES trials(id) ON DELETE CASCADE, content BLOB NOT NULL)",
)

# What each digest is of, in this order of the columns.
BEGUN = "SELECT id, subject, kind, position, task, scenario, joint, q0, target, began FROM trials WHERE id = ?"
CYCLES = "SELECT k, time, velocity, q FROM cycles WHERE trial = ? ORDER BY k"
ENDED = "SELECT ended, end FROM trials WHERE id = ?"
SESSION = "SELECT subject, key, seq, bytes FROM sessions WHERE subject = ?"
_ROWS = {
    "rating": "SELECT id, rating, answers FROM trials WHERE id = ?",
    "event": "SELECT id, trial, subject, k, at, kind, data FROM events WHERE id = ?",
    "subject": "SELECT code, number, row, kind, state, since, answers, note FROM subjects WHERE code = ?",
}
_ABOUT = "SELECT key, value FROM about ORDER BY key"
_SCHEMA = "SELECT type, name, sql FROM sqlite_master WHERE sql IS NOT NULL ORDER BY type, name"


def packed(values: Iterable[Any]) -> bytes:
    """Values of SQLite as bytes that no other values have: ``n``, ``i12;``, ``r`` and 8 bytes, ``t3:abc``, ``b2:..``."""
    parts = []
    for value in values:
        if value is None:
            parts.append(b"n")
        elif isinstance(value, float):
            parts.append(b"r" + struct.pack("<d", value))
        elif isinstance(value, str):
            text = value.encode("utf-8", "surrogateescape")
            parts.append(b"t%d:" % len(text) + text)
        elif isinstance(value, bytes):
            parts.append(b"b%d:" % len(value) + value)
        else:
            parts.append(b"i%d;" % value)
    return b"".join(parts)


def sha(*parts: bytes) -> bytes:
    """SHA-256 of bytes, one after another."""
    return hashlib.sha256(b"".join(parts)).digest()


def of_cycles(before: bytes, rows: Iterable[Sequence[Any]]) -> bytes:
    """The running digest of a trial after some more cycles: ``k, time, velocity, q`` each."""
    for row in rows:
        before = sha(before, packed(row))
    return before


def of_trial(db: sqlite3.Connection, trial: int) -> bytes | None:
    """The running digest of a trial, from what is stored of it; None if there is no such trial."""
    begun = db.execute(BEGUN, (trial,)).fetchone()
    return None if begun is None else of_cycles(sha(packed(begun)), db.execute(CYCLES, (trial,)))


def of_content(db: sqlite3.Connection, kind: str, subject: str | None, item: int | None) -> bytes | None:
    """The digest of what a link of a chain covers, from what is stored; None if it is not there."""
    if kind == "experiment":
        rows = [*db.execute(_ABOUT).fetchall(), *db.execute(_SCHEMA).fetchall()]
        return sha(*(packed(row) for row in rows))
    if kind == "trial":
        running = of_trial(db, item or 0)
        return None if running is None else sha(running, packed(db.execute(ENDED, (item,)).fetchone()))
    row = db.execute(_ROWS[kind], (subject if kind == "subject" else item,)).fetchone()
    return None if row is None else sha(packed(row))


def of_link(before: bytes, number: int, subject: str | None, kind: str, item: int | None, content: bytes) -> bytes:
    """The digest of a link of a chain; ``before`` is that of the link before it, empty for the first."""
    return sha(before, packed((number, subject, kind, item, content)))


def of_session(row: Sequence[Any]) -> bytes:
    """The digest of a page's session: ``subject, key, seq, bytes``."""
    return sha(packed(row))


def of_files(folder: Path, names: Iterable[str]) -> str:
    """The digests of files beside the records, as JSON."""
    return json.dumps({name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names})


class Chain:
    """Writes the digests of records; each is of one transaction with what it is of.

    Records from before there were digests get the tables for them with the first change. What was there already has no
    digest, and ``about`` says up to where.

    Args:
        db: The records.
        folder: Where they lie.
        files: Names of the files beside them that belong to the experiment.
    """

    def __init__(self, db: sqlite3.Connection, folder: Path, files: Sequence[str]) -> None:
        self._db, self._folder, self._files = db, folder, files
        self._ready = False

    def prepare(self) -> None:
        """Make the tables where there are none; inside a transaction."""
        if self._ready:
            return
        db = self._db
        if db.execute("SELECT value FROM about WHERE key = 'format'").fetchone()[0] != str(FORMAT):
            for statement in (SESSIONS, *_TABLES):
                db.execute(statement)
            columns = {row[1] for row in db.execute("PRAGMA table_info(sessions)")}
            for name, of in (("bytes", "INTEGER NOT NULL DEFAULT 0"), ("digest", "BLOB")):
                if name not in columns:
                    db.execute(f"ALTER TABLE sessions ADD COLUMN {name} {of}")
            last = {t: db.execute(f"SELECT COALESCE(MAX(id), 0) FROM {t}").fetchone()[0] for t in ("trials", "events")}
            about = {
                "format": str(FORMAT),
                "without digests": json.dumps(last),
                "files": of_files(self._folder, self._files),
            }
            db.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", about.items())
            self._ready = True
            self.add("experiment")
            for (code,) in db.execute("SELECT code FROM subjects ORDER BY number").fetchall():
                self.add("subject", code)
            for (code,) in db.execute("SELECT subject FROM sessions").fetchall():
                self.session(code)
        self._ready = True

    def undone(self) -> None:
        """A transaction was rolled back, perhaps the one that made the tables."""
        self._ready = False

    def add(self, kind: str, subject: str | None = None, item: int | None = None, content: bytes | None = None) -> None:
        """A link at the end of the chain of a subject's session, or, without one, of the experiment."""
        self.prepare()
        db = self._db
        if content is None:
            content = of_content(db, kind, subject, item)
            assert content is not None
        last = db.execute("SELECT digest FROM digests WHERE subject IS ? ORDER BY id DESC LIMIT 1", (subject,)).fetchone()
        number = db.execute("SELECT COALESCE(MAX(id), 0) + 1 FROM digests").fetchone()[0]
        digest = of_link(b"" if last is None else last[0], number, subject, kind, item, content)
        db.execute("INSERT INTO digests VALUES (?, ?, ?, ?, ?, ?)", (number, subject, kind, item, content, digest))

    def session(self, subject: str) -> None:
        """A page's session was changed."""
        self.prepare()
        row = self._db.execute(SESSION, (subject,)).fetchone()
        if row is not None:
            self._db.execute("UPDATE sessions SET digest = ? WHERE subject = ?", (of_session(row), subject))

    def begin(self, trial: int, subject: str) -> None:
        """A trial begins; that it has no rating is on record as well."""
        self.add("rating", subject, trial)
        self._db.execute("INSERT INTO under_way VALUES (?, ?)", (trial, of_trial(self._db, trial)))

    def go_on(self, trial: int, rows: Iterable[Sequence[Any]]) -> None:
        """Cycles of a trial were written: ``k, time, velocity, q`` each."""
        before = self._running(trial)
        if before is not None:
            self._db.execute("UPDATE under_way SET content = ? WHERE trial = ?", (of_cycles(before, rows), trial))

    def end(self, trial: int, subject: str) -> None:
        """A trial is over."""
        running = self._running(trial)
        content = None  # it began before there were digests
        if running is not None:
            content = sha(running, packed(self._db.execute(ENDED, (trial,)).fetchone()))
            self._db.execute("DELETE FROM under_way WHERE trial = ?", (trial,))
        self.add("trial", subject, trial, content)

    def _running(self, trial: int) -> bytes | None:
        self.prepare()
        row = self._db.execute("SELECT content FROM under_way WHERE trial = ?", (trial,)).fetchone()
        return None if row is None else bytes(row[0])
