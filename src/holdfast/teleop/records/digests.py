"""Digests of the records: a chain of SHA-256 for each session, so that any changed bit is detected.

``docs/reference/record-digests.md`` explains how to check them without holdfast. The digests reveal damage and changes by a
person who does not update them. A rewritten chain is revealed only by a digest that was noted elsewhere.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

RECORDS_FORMAT = 2  # format of records with digests

SESSIONS_TABLE = """CREATE TABLE IF NOT EXISTS sessions (
    subject TEXT PRIMARY KEY REFERENCES subjects(code) ON DELETE CASCADE, key BLOB NOT NULL UNIQUE, seq INTEGER NOT NULL,
    bytes INTEGER NOT NULL DEFAULT 0, digest BLOB
) WITHOUT ROWID"""
_DIGEST_TABLES = (
    """CREATE TABLE digests (
    id INTEGER PRIMARY KEY, subject TEXT REFERENCES subjects(code) ON DELETE CASCADE, kind TEXT NOT NULL, item INTEGER,
    content BLOB NOT NULL, digest BLOB NOT NULL
)""",
    "CREATE INDEX digests_of ON digests (subject)",
    "CREATE TABLE under_way (trial INTEGER PRIMARY KEY REFERENCES trials(id) ON DELETE CASCADE, content BLOB NOT NULL)",
)

# Content of each digest, in this order of the columns.
TRIAL_START_QUERY = "SELECT id, subject, kind, position, task, scenario, joint, q0, target, began FROM trials WHERE id = ?"
CYCLES_QUERY = "SELECT k, time, velocity, q FROM cycles WHERE trial = ? ORDER BY k"
TRIAL_END_QUERY = "SELECT ended, end FROM trials WHERE id = ?"
SESSION_QUERY = "SELECT subject, key, seq, bytes FROM sessions WHERE subject = ?"
_ROW_QUERIES = {
    "rating": "SELECT id, rating, answers FROM trials WHERE id = ?",
    "event": "SELECT id, trial, subject, k, at, kind, data FROM events WHERE id = ?",
    "subject": "SELECT code, number, row, kind, state, since, answers, note FROM subjects WHERE code = ?",
}
_ABOUT_QUERY = "SELECT key, value FROM about ORDER BY key"
_SCHEMA_QUERY = "SELECT type, name, sql FROM sqlite_master WHERE sql IS NOT NULL ORDER BY type, name"


def encode_sqlite_values(values: Iterable[Any]) -> bytes:
    """Pack values of SQLite as bytes that are unique for them: ``n``, ``i12;``, ``r`` and 8 bytes, ``t3:abc``, ``b2:..``."""
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


def digest_bytes(*parts: bytes) -> bytes:
    """Return the SHA-256 of bytes, one after another."""
    return hashlib.sha256(b"".join(parts)).digest()


def digest_cycles(previous_digest: bytes, rows: Iterable[Sequence[Any]]) -> bytes:
    """Return the running digest of a trial after some more cycles: ``k, time, velocity, q`` each."""
    for row in rows:
        previous_digest = digest_bytes(previous_digest, encode_sqlite_values(row))
    return previous_digest


def digest_trial(database: sqlite3.Connection, trial: int) -> bytes | None:
    """Return the running digest of a trial from its stored rows; None if there is no such trial."""
    start_row = database.execute(TRIAL_START_QUERY, (trial,)).fetchone()
    return (
        None
        if start_row is None
        else digest_cycles(digest_bytes(encode_sqlite_values(start_row)), database.execute(CYCLES_QUERY, (trial,)))
    )


def digest_content(database: sqlite3.Connection, kind: str, subject: str | None, item: int | None) -> bytes | None:
    """Return the digest of the stored content that a link of a chain covers; None if the content is missing."""
    if kind == "experiment":
        rows = [*database.execute(_ABOUT_QUERY).fetchall(), *database.execute(_SCHEMA_QUERY).fetchall()]
        return digest_bytes(*(encode_sqlite_values(row) for row in rows))
    if kind == "trial":
        running = digest_trial(database, item or 0)
        return (
            None
            if running is None
            else digest_bytes(running, encode_sqlite_values(database.execute(TRIAL_END_QUERY, (item,)).fetchone()))
        )
    row = database.execute(_ROW_QUERIES[kind], (subject if kind == "subject" else item,)).fetchone()
    return None if row is None else digest_bytes(encode_sqlite_values(row))


def digest_chain_link(
    previous_digest: bytes, number: int, subject: str | None, kind: str, item: int | None, content: bytes
) -> bytes:
    """Return the digest of a link of a chain; ``previous_digest`` is that of the preceding link, empty for the first."""
    return digest_bytes(previous_digest, encode_sqlite_values((number, subject, kind, item, content)))


def digest_session(row: Sequence[Any]) -> bytes:
    """Return the digest of a page's session: ``subject, key, seq, bytes``."""
    return digest_bytes(encode_sqlite_values(row))


def digest_files(folder: Path, names: Iterable[str]) -> str:
    """Return the digests of files in the folder of the records, as JSON."""
    return json.dumps({name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names})


class DigestChain:
    """Writer of the digests of records; each digest is in one transaction with its content.

    Records without digests, from an earlier format, get the tables for them with the first change. Their existing content has
    no digest, and ``about`` states its extent.

    Args:
        db: Records of the experiment.
        folder: Folder of the records.
        files: Names of the other files in the folder that belong to the experiment.
    """

    def __init__(self, db: sqlite3.Connection, folder: Path, files: Sequence[str]) -> None:
        self._db, self._folder, self._files = db, folder, files
        self._ready = False

    def create_tables(self) -> None:
        """Create missing tables; must be called inside a transaction."""
        if self._ready:
            return
        database = self._db
        if database.execute("SELECT value FROM about WHERE key = 'format'").fetchone()[0] != str(RECORDS_FORMAT):
            for statement in (SESSIONS_TABLE, *_DIGEST_TABLES):
                database.execute(statement)
            columns = {row[1] for row in database.execute("PRAGMA table_info(sessions)")}
            for name, column_type in (("bytes", "INTEGER NOT NULL DEFAULT 0"), ("digest", "BLOB")):
                if name not in columns:
                    database.execute(f"ALTER TABLE sessions ADD COLUMN {name} {column_type}")
            last_ids = {
                table: database.execute(f"SELECT COALESCE(MAX(id), 0) FROM {table}").fetchone()[0]
                for table in ("trials", "events")
            }
            metadata = {
                "format": str(RECORDS_FORMAT),
                "without digests": json.dumps(last_ids),
                "files": digest_files(self._folder, self._files),
            }
            database.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", metadata.items())
            self._ready = True
            self.append_link("experiment")
            for (code,) in database.execute("SELECT code FROM subjects ORDER BY number").fetchall():
                self.append_link("subject", code)
            for (code,) in database.execute("SELECT subject FROM sessions").fetchall():
                self.update_session(code)
        self._ready = True

    def reset_after_rollback(self) -> None:
        """Forget that the tables exist, because the transaction that was rolled back may have created them."""
        self._ready = False

    def append_link(self, kind: str, subject: str | None = None, item: int | None = None, content: bytes | None = None) -> None:
        """Append a link to the chain of a subject's session or, without a subject, of the experiment."""
        self.create_tables()
        database = self._db
        if content is None:
            content = digest_content(database, kind, subject, item)
            assert content is not None
        last_digest = database.execute(
            "SELECT digest FROM digests WHERE subject IS ? ORDER BY id DESC LIMIT 1", (subject,)
        ).fetchone()
        number = database.execute("SELECT COALESCE(MAX(id), 0) + 1 FROM digests").fetchone()[0]
        digest = digest_chain_link(b"" if last_digest is None else last_digest[0], number, subject, kind, item, content)
        database.execute("INSERT INTO digests VALUES (?, ?, ?, ?, ?, ?)", (number, subject, kind, item, content, digest))

    def update_session(self, subject: str) -> None:
        """Update the digest of a page's session that has changed."""
        self.create_tables()
        row = self._db.execute(SESSION_QUERY, (subject,)).fetchone()
        if row is not None:
            self._db.execute("UPDATE sessions SET digest = ? WHERE subject = ?", (digest_session(row), subject))

    def begin_trial(self, trial: int, subject: str) -> None:
        """Record the beginning of a trial, and that it has no rating yet."""
        self.append_link("rating", subject, trial)
        self._db.execute("INSERT INTO under_way VALUES (?, ?)", (trial, digest_trial(self._db, trial)))

    def update_trial_digest(self, trial: int, rows: Iterable[Sequence[Any]]) -> None:
        """Update the running digest of a trial with its new cycles: ``k, time, velocity, q`` each."""
        before = self._read_running_digest(trial)
        if before is not None:
            self._db.execute("UPDATE under_way SET content = ? WHERE trial = ?", (digest_cycles(before, rows), trial))

    def end_trial(self, trial: int, subject: str) -> None:
        """Record the end of a trial."""
        running = self._read_running_digest(trial)
        content = None  # the trial began before the records had digests
        if running is not None:
            content = digest_bytes(running, encode_sqlite_values(self._db.execute(TRIAL_END_QUERY, (trial,)).fetchone()))
            self._db.execute("DELETE FROM under_way WHERE trial = ?", (trial,))
        self.append_link("trial", subject, trial, content)

    def _read_running_digest(self, trial: int) -> bytes | None:
        self.create_tables()
        row = self._db.execute("SELECT content FROM under_way WHERE trial = ?", (trial,)).fetchone()
        return None if row is None else bytes(row[0])
