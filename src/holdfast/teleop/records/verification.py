"""Verification of the records: every digest is recomputed from the stored data, and none is trusted."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from holdfast.core.errors import HoldfastError, StoreError
from holdfast.core.progress import reports_progress
from holdfast.teleop.records import digests
from holdfast.teleop.records.file import RECORDS_FILE, open_database
from holdfast.teleop.records.records import Records

_STATE_KINDS = ("experiment", "subject", "rating")  # content that changes: only the last digest of each covers the present one
# Errors of SQLite, and of the code that reads damaged data.
_OF_DAMAGE = (sqlite3.Error, ValueError, TypeError, AttributeError, LookupError, OverflowError, MemoryError)
_ITEM_QUERIES = {  # items that must have a digest: number, subject, and name for the user
    "trial": "SELECT id, subject, 'trial ' || id FROM trials WHERE end IS NOT NULL AND id > ? ORDER BY id",
    "rating": "SELECT id, subject, 'the rating of trial ' || id FROM trials WHERE id > ? ORDER BY id",
    "event": "SELECT id, subject, 'event ' || id FROM events WHERE id > ? ORDER BY id",
}


@dataclass
class VerificationReport:
    """Report of a verification.

    Attributes:
        trials: Number of trials that are over.
        links: Number of digests.
        damages: Differences from the written content, one sentence each; trials first, in the order in which they ended.
        trials_without_digest: Trials that were recorded before there were digests.
        overall_digest: SHA-256 of the last digest of every session, hexadecimal. A copy of it, noted elsewhere, reveals a
            rewritten chain.
    """

    trials: int = 0
    links: int = 0
    damages: list[str] = field(default_factory=list)
    trials_without_digest: list[int] = field(default_factory=list)
    overall_digest: str = ""

    def describe(self) -> list[str]:
        """Describe the missing digests in a line and the first 20 damages in a line each, or state that all is sound."""
        lines = []
        if self.trials_without_digest:
            lines.append(
                f"{len(self.trials_without_digest)} trials have no digest, because they were recorded before digests existed: "
                f"{', '.join(map(str, self.trials_without_digest))}"
            )
        lines += [f"damaged: {sentence}" for sentence in self.damages[:20]]
        if len(self.damages) > 20:
            lines.append(f"damaged: {len(self.damages) - 20} more")
        if not self.damages:
            lines.append(f"sound: {self.trials} trials, {self.links} digests; all together {self.overall_digest or 'none'}")
        return lines


@reports_progress("comparing the records with their digests")
def verify_records(folder: str | Path) -> VerificationReport:
    """Compare all stored data with their digests; nothing is changed.

    Args:
        folder: Folder of the experiment, which may be served at the same time.

    Raises:
        StoreError: There is no experiment, or it cannot be read in this place.
    """
    path = Path(folder)
    file = path / RECORDS_FILE
    if not file.is_file():
        raise StoreError(f"'{path}' contains no experiment, because it has no {RECORDS_FILE}; give the folder of one")
    report = VerificationReport()
    try:
        database, _ = open_database(file)
        with closing(database):
            # A damaged name or answer may not be text.
            database.text_factory = lambda data: data.decode("utf-8", "surrogateescape")
            database.execute("BEGIN")
            _DigestCheck(path, database, report).run()
    # Errors of SQLite for a damaged file, and of data that are inconsistent.
    except _OF_DAMAGE as error:
        report.damages.append(f"'{file}' is damaged: {error}")
    # A damaged name may contain characters that no terminal accepts.
    report.damages = [
        "".join(character if character.isprintable() else "?" for character in sentence) for sentence in report.damages
    ]
    return report


@contextmanager
def open_undamaged_records(folder: Path) -> Iterator[Records]:
    """Open the records; if damage makes them unreadable, the error message names the damage.

    Raises:
        StoreError: There is no experiment, or it is damaged.
    """
    try:
        with Records.open(folder) as records:
            yield records
    except HoldfastError:
        raise
    except _OF_DAMAGE as error:
        require_undamaged_records(folder)
        raise StoreError(
            f"'{folder}' is damaged: it contains other data than records ({error}); restore it from a backup"
        ) from error


def require_undamaged_records(folder: Path) -> None:
    """Compare everything that is stored with its digests before it is used.

    Raises:
        StoreError: Some content differs from the written one.
    """
    if damaged := verify_records(folder).damages:
        raise StoreError(f"'{folder}' is damaged: {damaged[0]}; restore it from a backup")


class _DigestCheck:
    """One check of everything in the records.

    Args:
        folder: Folder of the experiment.
        database: Records at one moment.
        report: Report that is filled.
    """

    def __init__(self, folder: Path, database: sqlite3.Connection, report: VerificationReport) -> None:
        self._folder, self._db, self._report = folder, database, report
        self._other_damage: list[str] = []

    def run(self) -> None:
        """Fill in the report, trials first."""
        first_error: Exception | None = None
        for check in (self._check_digests, self._check_sqlite_integrity):
            try:
                check()
            except _OF_DAMAGE as error:
                first_error = first_error or error
        self._report.damages += self._other_damage
        if first_error is not None:
            raise first_error

    def _check_sqlite_integrity(self) -> None:
        for (line,) in self._db.execute("PRAGMA integrity_check(5)"):
            if line != "ok":
                self._other_damage.append(f"the file {RECORDS_FILE}: {line}")
        for table, row, parent, _ in self._db.execute("PRAGMA foreign_key_check"):
            self._other_damage.append(f"a row ({row}) of the table {table} belongs to nothing in {parent}")

    def _check_digests(self) -> None:
        database, report = self._db, self._report
        table_names = {row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        ended_trials = [row[0] for row in database.execute("SELECT id FROM trials WHERE end IS NOT NULL ORDER BY id")]
        report.trials = len(ended_trials)
        metadata = dict(database.execute("SELECT key, value FROM about"))
        if metadata["format"] == "1" and "digests" not in table_names:
            report.trials_without_digest = ended_trials
            return
        last_without_digest: dict[str, int] = json.loads(metadata["without digests"])
        for name, expected in json.loads(metadata["files"]).items():
            self._check_protocol_file(name, expected)
        covered = self._check_chains()
        self._find_undigested_items(covered, last_without_digest)
        self._check_running_trials()
        self._check_sessions()
        report.trials_without_digest = [
            trial for trial in ended_trials if trial <= last_without_digest["trials"] and ("trial", trial) not in covered
        ]

    def _check_protocol_file(self, name: str, expected: str) -> None:
        try:
            content = (self._folder / name).read_bytes()
        except OSError as error:
            self._other_damage.append(f"the file {name}: {error.strerror or error}")
        else:
            if hashlib.sha256(content).hexdigest() != expected:
                self._other_damage.append(f"the file {name} is not as it was when the experiment began")

    def _check_chains(self) -> set[tuple[str, int | str | None]]:
        """Check the chains link by link, and return the items that have a digest."""
        rows = self._db.execute("SELECT id, subject, kind, item, content, digest FROM digests ORDER BY id").fetchall()
        self._report.links = len(rows)
        last_numbers = {(kind, subject if kind == "subject" else item): number for number, subject, kind, item, _, _ in rows}
        previous: dict[str | None, bytes] = {}
        for number, subject, kind, item, content, digest in rows:
            name = _name_item(kind, subject, item)
            if digests.digest_chain_link(previous.get(subject, b""), number, subject, kind, item, content) != digest:
                self._add_damage(kind, f"{name}: digest {number} does not follow from the one before it")
            previous[subject] = digest
            is_state = kind in _STATE_KINDS
            if is_state and last_numbers[kind, subject if kind == "subject" else item] != number:
                continue
            current = digests.digest_content(self._db, kind, subject, item)
            if current != content:
                self._add_damage(kind, f"{name} {'is missing' if current is None else 'is not as it was written'}")
        self._report.overall_digest = digests.digest_bytes(
            *(previous[code] for code in sorted(previous, key=lambda code: code or ""))
        ).hex()
        return set(last_numbers)

    def _find_undigested_items(self, covered: set[tuple[str, int | str | None]], last_without_digest: dict[str, int]) -> None:
        for kind, query in _ITEM_QUERIES.items():
            last_id = last_without_digest["events" if kind == "event" else "trials"]
            for number, subject, name in self._db.execute(query, (last_id,)):
                if (kind, number) not in covered:
                    self._add_damage(kind, f"{name} of {subject} has no digest, and should have one")
        for (code,) in self._db.execute("SELECT code FROM subjects"):
            if ("subject", code) not in covered:
                self._other_damage.append(f"subject {code} has no digest, and should have one")
        if ("experiment", None) not in covered:
            self._other_damage.append("the metadata of the experiment have no digest, and should have one")
        for (trial,) in self._db.execute("SELECT DISTINCT trial FROM cycles WHERE trial NOT IN (SELECT id FROM trials)"):
            self._add_damage("trial", f"trial {trial} is missing, but its cycles are present")

    def _check_running_trials(self) -> None:
        query = (
            "SELECT id, content, under_way.trial FROM trials LEFT JOIN under_way ON trial = id WHERE end IS NULL ORDER BY id"
        )
        last_id = json.loads(self._db.execute("SELECT value FROM about WHERE key = 'without digests'").fetchone()[0])["trials"]
        for trial, content, stored_trial in self._db.execute(query).fetchall():
            if stored_trial is None and trial <= last_id:
                continue
            if content != digests.digest_trial(self._db, trial):
                self._add_damage("trial", f"trial {trial}, which is not over, is not as it was written")
        query = "SELECT trial FROM under_way WHERE trial NOT IN (SELECT id FROM trials WHERE end IS NULL)"
        for (trial,) in self._db.execute(query):
            self._add_damage("trial", f"trial {trial} was not over, and is")

    def _check_sessions(self) -> None:
        for *row, digest in self._db.execute("SELECT subject, key, seq, bytes, digest FROM sessions").fetchall():
            if digests.digest_session(row) != digest:
                self._other_damage.append(f"the session of the page of {row[0]} is not as it was written")

    def _add_damage(self, kind: str, sentence: str) -> None:
        (self._report.damages if kind == "trial" else self._other_damage).append(sentence)


def _name_item(kind: str, subject: str | None, item: int | None) -> str:
    suffix = "" if subject is None else f" of {subject}"
    match kind:
        case "experiment":
            return "the metadata of the experiment"
        case "subject":
            return f"subject {subject}"
        case "rating":
            return f"the rating of trial {item}{suffix}"
        case _:
            return f"{kind} {item}{suffix}"
