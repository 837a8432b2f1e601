"""SQLite file of the records: its tables, and how to create and open it."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.provenance import versions
from holdfast.teleop.protocol import protocol as protocols
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.digests import RECORDS_FORMAT, DigestChain

RECORDS_FILE = "records.sqlite"
PROTOCOL_FILE = "protocol.yaml"
LOCK_FILE = "serve.lock"  # lock of the program that writes the records of a whole folder
_UNFINISHED_FILE = RECORDS_FILE + ".new"  # the file while an experiment is being created
_JOURNAL_FILE = _UNFINISHED_FILE + "-journal"  # written by SQLite
_INITIAL_FORMAT = "1"  # format of a file without digests, whose tables are created after the others
_KNOWN_FORMATS = (_INITIAL_FORMAT, str(RECORDS_FORMAT))


def create_experiment(folder: Path, protocol: Protocol, metadata: Mapping[str, str]) -> None:
    """Write the files of a new experiment.

    Args:
        folder: New or empty folder.
        protocol: Protocol of the experiment.
        metadata: Further entries of the table ``about``.

    Raises:
        StoreError: The folder is not empty, or cannot be written.
    """
    unfinished = folder / _UNFINISHED_FILE
    try:
        if reading.path_exists(folder) and (not folder.is_dir() or _has_foreign_files(folder, protocol)):
            raise StoreError(f"'{folder}' exists and is not an empty folder; give a new one, or open the experiment in it")
        folder.mkdir(parents=True, exist_ok=True)
        (folder / _JOURNAL_FILE).unlink(missing_ok=True)
        unfinished.write_bytes(b"")
        stored_protocol = protocols.read_protocol(protocol.write(folder / PROTOCOL_FILE))
        with closing(sqlite3.connect(unfinished, isolation_level=None)) as database:
            database.executescript(Path(__file__).with_name("tables.sql").read_text(encoding="utf-8"))
            package_versions = json.dumps(versions("holdfast", "numpy", "casadi", "llvmlite"))
            entries = {
                **metadata,
                "format": _INITIAL_FORMAT,
                "protocol": stored_protocol.to_yaml(),
                "versions": package_versions,
                "began": format_utc_now(),
            }
            database.execute("BEGIN")
            database.executemany("INSERT INTO about VALUES (?, ?)", entries.items())
            DigestChain(database, folder, list_protocol_files(stored_protocol)).create_tables()
            database.execute("COMMIT")
        unfinished.rename(folder / RECORDS_FILE)  # a folder with this file is complete
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"cannot write to '{folder}': {error}; choose another folder") from error


def _has_foreign_files(folder: Path, protocol: Protocol) -> bool:
    """Return True if a folder contains other files than those of an experiment whose creation was interrupted."""
    names = {file.name for file in folder.iterdir()}
    return bool(names - {_UNFINISHED_FILE, _JOURNAL_FILE, PROTOCOL_FILE, protocol.arm_spec}) or bool(names) > (
        _UNFINISHED_FILE in names
    )


def list_protocol_files(protocol: Protocol) -> list[str]:
    """Return the names of the files in the folder that belong to the experiment in addition to the records."""
    return [PROTOCOL_FILE] if protocol.arm_file is None else [PROTOCOL_FILE, protocol.arm_spec]


def open_database(file: Path) -> tuple[sqlite3.Connection, bool]:
    """Open the file, and return the connection, and True if it is read-only.

    Raises:
        StoreError: The file can only be read, and lacks the last changes, because it was copied or made read-only while in use.
        sqlite3.Error: The file is not an SQLite file.
    """
    database = sqlite3.connect(file, isolation_level=None, timeout=30.0)
    try:
        database.execute("PRAGMA journal_mode = WAL")
        database.execute("PRAGMA synchronous = FULL")
        database.execute("PRAGMA foreign_keys = ON")
        database.execute("SELECT * FROM sqlite_master").fetchone()
    except sqlite3.Error as error:
        database.close()
        if error.sqlite_errorcode & 0xFF not in (sqlite3.SQLITE_READONLY, sqlite3.SQLITE_CANTOPEN):
            raise
        return _open_read_only(file), True
    except BaseException:
        database.close()
        raise
    return database, False


def _open_read_only(file: Path) -> sqlite3.Connection:
    """Open a file in a folder that cannot be written, where SQLite cannot have its auxiliary files."""
    wal_file = file.with_name(file.name + "-wal")
    if wal_file.is_file() and wal_file.stat().st_size:
        raise StoreError(
            f"'{file.parent}' cannot be written, and the last changes are still in '{wal_file.name}'; copy the whole folder to "
            "a folder that can be written, and open the copy"
        )
    return sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro&immutable=1", uri=True, isolation_level=None)


def open_experiment(folder: Path) -> tuple[sqlite3.Connection, Protocol, bool]:
    """Open the experiment in a folder, and return the connection, the protocol, and True if the file is read-only.

    Raises:
        StoreError: There is no experiment, or it is damaged or of another format.
    """
    file = folder / RECORDS_FILE
    if not file.is_file():
        raise StoreError(f"'{folder}' contains no experiment, because it has no {RECORDS_FILE}; begin one in a new folder")
    try:
        database, read_only = open_database(file)
    except (sqlite3.Error, ValueError) as error:  # names in a damaged file need not be UTF-8
        raise _make_damage_error(file, error) from error
    try:
        return database, _check_database(folder, database), read_only
    except BaseException:
        database.close()
        raise


def _check_database(folder: Path, database: sqlite3.Connection) -> Protocol:
    """Check the file, and return its protocol."""
    file = folder / RECORDS_FILE
    try:
        metadata = dict(database.execute("SELECT key, value FROM about"))
        check_result = database.execute("PRAGMA quick_check(1)").fetchone()[0]
    except (sqlite3.Error, ValueError) as error:
        raise _make_damage_error(file, error) from error
    if check_result != "ok" or not metadata.keys() >= {"format", "protocol", "versions"}:
        raise _make_damage_error(file, check_result)
    if metadata["format"] not in _KNOWN_FORMATS:
        raise StoreError(
            f"'{file}' has format {metadata['format']}; this version reads {' and '.join(_KNOWN_FORMATS)}, so use the version "
            f"that wrote it"
        )
    protocol = protocols.read_protocol(folder / PROTOCOL_FILE)
    if protocol.to_yaml() != metadata["protocol"]:
        raise StoreError(
            f"'{folder / PROTOCOL_FILE}' is not the protocol that the experiment began with; undo the change, "
            "or begin a new experiment with it"
        )
    return protocol


def _make_damage_error(file: Path, cause: object) -> StoreError:
    return StoreError(f"'{file}' is damaged or not a file of records ({cause}); restore it from a copy")


def get_file_identity(folder: Path) -> tuple[int, int] | None:
    """Return the device and index number of the records' file, None without one; a deleted and re-created file differs."""
    try:
        status = (folder / RECORDS_FILE).stat()
    except OSError:
        return None
    return status.st_dev, status.st_ino


@contextmanager
def lock_records_folder(folder: Path) -> Iterator[None]:
    """Lock the folder against another server, because two servers do not see each other's changes.

    Raises:
        StoreError: A server holds the lock, or the folder cannot be written.
    """
    from holdfast.core.sweeps.folder import lock_folder

    with ExitStack() as locks:
        try:
            locks.enter_context(lock_folder(folder, LOCK_FILE))
        except StoreError as error:
            if not isinstance(error.__cause__, BlockingIOError):
                raise
            raise StoreError(f"'{folder}' is already served by another program; stop that one first") from error
        yield


def format_utc_now() -> str:
    """Return the current time in UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
