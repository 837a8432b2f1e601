"""The file of the records: its tables, and how it is made and opened."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

from holdfast.errors import StoreError
from holdfast.teleop import protocol as protocols
from holdfast.teleop.protocol import Protocol
from holdfast.versions import versions

FILE, PROTOCOL = "records.sqlite", "protocol.yaml"
_FORMAT = 1

_SCHEMA = """
CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE subjects (
    code TEXT PRIMARY KEY, number INTEGER NOT NULL UNIQUE, row INTEGER NOT NULL, kind TEXT NOT NULL, state TEXT NOT NULL,
    since TEXT NOT NULL, answers TEXT NOT NULL DEFAULT '{}', note TEXT NOT NULL DEFAULT ''
) WITHOUT ROWID;
CREATE TABLE trials (
    id INTEGER PRIMARY KEY, subject TEXT NOT NULL REFERENCES subjects(code) ON DELETE CASCADE, kind TEXT NOT NULL,
    position INTEGER NOT NULL, task INTEGER NOT NULL, scenario INTEGER NOT NULL, joint INTEGER NOT NULL, q0 BLOB NOT NULL,
    target BLOB NOT NULL, began TEXT NOT NULL, ended TEXT, end INTEGER, rating INTEGER, answers TEXT NOT NULL DEFAULT '{}'
);
CREATE INDEX trials_of ON trials (subject, kind, position);
CREATE TABLE cycles (
    trial INTEGER NOT NULL REFERENCES trials(id) ON DELETE CASCADE, k INTEGER NOT NULL, time REAL NOT NULL,
    velocity BLOB NOT NULL, q BLOB NOT NULL, PRIMARY KEY (trial, k)
) WITHOUT ROWID;
CREATE TABLE events (
    id INTEGER PRIMARY KEY, trial INTEGER REFERENCES trials(id) ON DELETE CASCADE,
    subject TEXT REFERENCES subjects(code) ON DELETE CASCADE, k INTEGER, at TEXT NOT NULL, kind TEXT NOT NULL,
    data TEXT NOT NULL DEFAULT '{}'
);
CREATE INDEX events_of ON events (trial);
"""

# Of format 1 too: folders from before there were pages get it when they are opened, and older holdfasts do not mind it.
_SESSIONS = """
CREATE TABLE IF NOT EXISTS sessions (
    subject TEXT PRIMARY KEY REFERENCES subjects(code) ON DELETE CASCADE, key BLOB NOT NULL UNIQUE, seq INTEGER NOT NULL
) WITHOUT ROWID
"""


def make(folder: Path, protocol: Protocol) -> None:
    """Write the files of an experiment that begins.

    Raises:
        StoreError: The folder is not empty, or cannot be written.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise StoreError(f"'{folder}' exists and is not an empty folder; give a new one, or open the experiment in it")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        kept = protocols.read(protocol.write(folder / PROTOCOL))
        with closing(sqlite3.connect(folder / (FILE + ".new"), isolation_level=None)) as db:
            db.executescript(_SCHEMA + _SESSIONS)
            made_by = json.dumps(versions("holdfast", "numpy", "casadi", "llvmlite"))
            about = {"format": str(_FORMAT), "protocol": kept.text(), "versions": made_by, "began": now()}
            db.executemany("INSERT INTO about VALUES (?, ?)", about.items())
        (folder / (FILE + ".new")).rename(folder / FILE)  # a folder with this file is whole
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"cannot write to '{folder}': {error}; choose another folder") from error


def connect(folder: Path) -> tuple[sqlite3.Connection, Protocol]:
    """The opened file, and the protocol.

    Raises:
        StoreError: There is none, it is damaged, or of another format.
    """
    file = folder / FILE
    if not file.is_file():
        raise StoreError(f"'{folder}' holds no experiment: there is no {FILE} in it; begin one in a new folder")
    try:
        db = sqlite3.connect(file, isolation_level=None, timeout=30.0)
        db.execute("PRAGMA journal_mode = WAL")
        db.execute("PRAGMA synchronous = FULL")
        db.execute("PRAGMA foreign_keys = ON")
        about = dict(db.execute("SELECT key, value FROM about"))
        sound = db.execute("PRAGMA quick_check(1)").fetchone()[0]
    except sqlite3.Error as error:
        raise StoreError(f"'{file}' is damaged or not a file of records ({error}); restore it from a copy") from error
    if sound != "ok":
        raise StoreError(f"'{file}' is damaged ({sound}); restore it from a copy")
    if about.get("format") != str(_FORMAT):
        raise StoreError(f"'{file}' has format {about.get('format')}; this holdfast reads {_FORMAT}: use the one that wrote it")
    protocol = protocols.read(folder / PROTOCOL)
    if protocol.text() != about["protocol"]:
        raise StoreError(
            f"'{folder / PROTOCOL}' is not the protocol that the experiment began with; undo the change, "
            "or begin a new experiment with it"
        )
    try:
        db.execute(_SESSIONS)
    except sqlite3.Error as error:
        raise StoreError(f"cannot write to '{file}': {error}; give yourself the right to") from error
    return db, protocol


def now() -> str:
    """UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
