"""The file of the records: its tables, and how it is made and opened."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path

from holdfast.errors import StoreError
from holdfast.files import reading
from holdfast.provenance import versions
from holdfast.teleop.protocol import protocol as protocols
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.digests import FORMAT, Chain

FILE, PROTOCOL = "records.sqlite", "protocol.yaml"
LOCK = "serve.lock"  # held by who writes the records of a whole folder
_UNFINISHED = FILE + ".new"  # the file while an experiment is being created
_JOURNAL = _UNFINISHED + "-journal"  # written by SQLite
_BEGUN = "1"  # format of a file without digests, which get their tables after the rest
_FORMATS = (_BEGUN, str(FORMAT))

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


def make(folder: Path, protocol: Protocol, about: Mapping[str, str]) -> None:
    """Write the files of an experiment that begins, again where this was interrupted.

    Args:
        folder: A new or empty folder.
        protocol: The protocol.
        about: Further entries of the table ``about``.

    Raises:
        StoreError: The folder is not empty, or cannot be written.
    """
    unfinished = folder / _UNFINISHED
    try:
        if reading.exists(folder) and (not folder.is_dir() or _is_occupied(folder, protocol)):
            raise StoreError(f"'{folder}' exists and is not an empty folder; give a new one, or open the experiment in it")
        folder.mkdir(parents=True, exist_ok=True)
        (folder / _JOURNAL).unlink(missing_ok=True)
        unfinished.write_bytes(b"")
        kept = protocols.read_protocol(protocol.write(folder / PROTOCOL))
        with closing(sqlite3.connect(unfinished, isolation_level=None)) as db:
            db.executescript(_SCHEMA)
            made_by = json.dumps(versions("holdfast", "numpy", "casadi", "llvmlite"))
            entries = {**about, "format": _BEGUN, "protocol": kept.text(), "versions": made_by, "began": now()}
            db.execute("BEGIN")
            db.executemany("INSERT INTO about VALUES (?, ?)", entries.items())
            Chain(db, folder, beside(kept)).prepare()
            db.execute("COMMIT")
        unfinished.rename(folder / FILE)  # a folder with this file is whole
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"cannot write to '{folder}': {error}; choose another folder") from error


def _is_occupied(folder: Path, protocol: Protocol) -> bool:
    """Return whether a folder holds anything but the files of an experiment whose creation was interrupted."""
    names = {file.name for file in folder.iterdir()}
    return bool(names - {_UNFINISHED, _JOURNAL, PROTOCOL, protocol.arm_spec}) or bool(names) > (_UNFINISHED in names)


def beside(protocol: Protocol) -> list[str]:
    """Names of the files beside the records that belong to the experiment."""
    return [PROTOCOL] if protocol.arm_file is None else [PROTOCOL, protocol.arm_spec]


def opened(file: Path) -> tuple[sqlite3.Connection, bool]:
    """The file, and whether it can only be read.

    Raises:
        StoreError: It can only be read, and not all of it is in it: it was copied, or made unwritable, while it was in use.
        sqlite3.Error: It is not a file of SQLite.
    """
    db = sqlite3.connect(file, isolation_level=None, timeout=30.0)
    try:
        db.execute("PRAGMA journal_mode = WAL")
        db.execute("PRAGMA synchronous = FULL")
        db.execute("PRAGMA foreign_keys = ON")
        db.execute("SELECT * FROM sqlite_master").fetchone()
    except sqlite3.Error as error:
        db.close()
        if error.sqlite_errorcode & 0xFF not in (sqlite3.SQLITE_READONLY, sqlite3.SQLITE_CANTOPEN):
            raise
        return _read_only(file), True
    except BaseException:
        db.close()
        raise
    return db, False


def _read_only(file: Path) -> sqlite3.Connection:
    """A file in a place that cannot be written, where SQLite cannot have the files that it keeps beside it."""
    log = file.with_name(file.name + "-wal")
    if log.is_file() and log.stat().st_size:
        raise StoreError(
            f"'{file.parent}' cannot be written, and the last changes are still in '{log.name}'; copy the whole folder to "
            "where you may write, and open the copy"
        )
    return sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro&immutable=1", uri=True, isolation_level=None)


def connect(folder: Path) -> tuple[sqlite3.Connection, Protocol, bool]:
    """The opened file, the protocol, and whether it can only be read.

    Raises:
        StoreError: There is none, it is damaged, or of another format.
    """
    file = folder / FILE
    if not file.is_file():
        raise StoreError(f"'{folder}' holds no experiment: there is no {FILE} in it; begin one in a new folder")
    try:
        db, read_only = opened(file)
    except (sqlite3.Error, ValueError) as error:  # names in a damaged file need not be UTF-8
        raise _damaged(file, error) from error
    try:
        return db, _checked(folder, db), read_only
    except BaseException:
        db.close()
        raise


def _checked(folder: Path, db: sqlite3.Connection) -> Protocol:
    """The protocol, after a look at the file."""
    file = folder / FILE
    try:
        about = dict(db.execute("SELECT key, value FROM about"))
        sound = db.execute("PRAGMA quick_check(1)").fetchone()[0]
    except (sqlite3.Error, ValueError) as error:
        raise _damaged(file, error) from error
    if sound != "ok" or not about.keys() >= {"format", "protocol", "versions"}:
        raise _damaged(file, sound)
    if about["format"] not in _FORMATS:
        raise StoreError(
            f"'{file}' has format {about['format']}; this holdfast reads {' and '.join(_FORMATS)}: use the one that wrote it"
        )
    protocol = protocols.read_protocol(folder / PROTOCOL)
    if protocol.text() != about["protocol"]:
        raise StoreError(
            f"'{folder / PROTOCOL}' is not the protocol that the experiment began with; undo the change, "
            "or begin a new experiment with it"
        )
    return protocol


def _damaged(file: Path, why: object) -> StoreError:
    return StoreError(f"'{file}' is damaged or not a file of records ({why}); restore it from a copy")


def place(folder: Path) -> tuple[int, int] | None:
    """Which file the records in a folder are, by device and number; None for none: a deleted one can be written to for ever."""
    try:
        found = (folder / FILE).stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """No server has the folder meanwhile, or no other: each knows nothing of what is done behind its back.

    Raises:
        StoreError: A server has it, or it cannot be written.
    """
    from holdfast.engine.folder import held

    with ExitStack() as held_:
        try:
            held_.enter_context(held(folder, LOCK))
        except StoreError as error:
            if not isinstance(error.__cause__, BlockingIOError):
                raise
            raise StoreError(f"'{folder}' is served by another program already; stop that one first") from error
        yield


def now() -> str:
    """UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
