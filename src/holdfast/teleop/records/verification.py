"""Are records as they were written? Every digest again, from what is stored; nothing is taken for granted."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from holdfast.errors import HoldfastError, StoreError
from holdfast.notice import says
from holdfast.teleop.records import digests
from holdfast.teleop.records.file import FILE, opened
from holdfast.teleop.records.records import Records

_STATES = ("experiment", "subject", "rating")  # change: only the last digest of each is of what is there now
# What damaged data make SQLite and the code that reads them raise.
_OF_DAMAGE = (sqlite3.Error, ValueError, TypeError, AttributeError, LookupError, OverflowError, MemoryError)
_ITEMS = {  # what must have a digest: number, subject, and what a person calls it
    "trial": "SELECT id, subject, 'trial ' || id FROM trials WHERE end IS NOT NULL AND id > ? ORDER BY id",
    "rating": "SELECT id, subject, 'the rating of trial ' || id FROM trials WHERE id > ? ORDER BY id",
    "event": "SELECT id, subject, 'event ' || id FROM events WHERE id > ? ORDER BY id",
}


@dataclass
class Verified:
    """What verifying showed.

    Attributes:
        trials: How many trials there are that are over.
        links: How many digests.
        damaged: What is not as it was written, trials first, in the order in which they ended: a sentence for each.
        without: Trials that have no digest: they are from before there were any.
        whole: SHA-256 of the last digest of every session, hexadecimal: written down elsewhere, it shows a chain that was
            made anew.
    """

    trials: int = 0
    links: int = 0
    damaged: list[str] = field(default_factory=list)
    without: list[int] = field(default_factory=list)
    whole: str = ""

    def describe(self) -> list[str]:
        """A line for what has no digest, a line for each of the first 20 that are damaged, or that all is sound."""
        lines = []
        if self.without:
            lines.append(
                f"{len(self.without)} trials have no digest, as they were recorded before there were any: "
                f"{', '.join(map(str, self.without))}"
            )
        lines += [f"damaged: {sentence}" for sentence in self.damaged[:20]]
        if len(self.damaged) > 20:
            lines.append(f"damaged: {len(self.damaged) - 20} more")
        if not self.damaged:
            lines.append(f"sound: {self.trials} trials, {self.links} digests; all together {self.whole or 'none'}")
        return lines


@says("comparing the records with their digests")
def verify(folder: str | Path) -> Verified:
    """Compare everything that is stored with its digests. Nothing is changed.

    Args:
        folder: Of the experiment; it may be served at the same time.

    Raises:
        StoreError: There is no experiment, or it cannot be read in this place.
    """
    path = Path(folder)
    file = path / FILE
    if not file.is_file():
        raise StoreError(f"'{path}' holds no experiment: there is no {FILE} in it; give the folder of one")
    found = Verified()
    try:
        db, _ = opened(file)
        with closing(db):
            # A damaged name or answer need not be text.
            db.text_factory = lambda data: data.decode("utf-8", "surrogateescape")
            db.execute("BEGIN")
            _Check(path, db, found).run()
    # What a damaged file may make SQLite say, and what does not fit together any more.
    except _OF_DAMAGE as error:
        found.damaged.append(f"'{file}' is damaged: {error}")
    # A damaged name may hold what no terminal takes.
    found.damaged = ["".join(c if c.isprintable() else "?" for c in sentence) for sentence in found.damaged]
    return found


@contextmanager
def readable(folder: Path) -> Iterator[Records]:
    """The records, open; where damage makes them impossible to read, a sentence says what is damaged.

    Raises:
        StoreError: There is no experiment, or it is damaged.
    """
    try:
        with Records.open(folder) as records:
            yield records
    except HoldfastError:
        raise
    except _OF_DAMAGE as error:
        refuse_damage(folder)
        raise StoreError(
            f"'{folder}' is damaged: it holds other data than records ({error}); restore it from a backup"
        ) from error


def refuse_damage(folder: Path) -> None:
    """Compare everything that is stored with its digests before it is used.

    Raises:
        StoreError: Something is not as it was written.
    """
    if damaged := verify(folder).damaged:
        raise StoreError(f"'{folder}' is damaged: {damaged[0]}; restore it from a backup")


class _Check:
    """One look at everything.

    Args:
        folder: Of the experiment.
        db: The records, at one moment.
        found: Is filled.
    """

    def __init__(self, folder: Path, db: sqlite3.Connection, found: Verified) -> None:
        self._folder, self._db, self._found = folder, db, found
        self._others: list[str] = []

    def run(self) -> None:
        """Fill in what was found, trials first."""
        trouble: Exception | None = None
        for check in (self._with_digests, self._file):
            try:
                check()
            except _OF_DAMAGE as error:
                trouble = trouble or error
        self._found.damaged += self._others
        if trouble is not None:
            raise trouble

    def _file(self) -> None:
        for (line,) in self._db.execute("PRAGMA integrity_check(5)"):
            if line != "ok":
                self._others.append(f"the file {FILE}: {line}")
        for table, row, parent, _ in self._db.execute("PRAGMA foreign_key_check"):
            self._others.append(f"a row ({row}) of the table {table} belongs to nothing in {parent}")

    def _with_digests(self) -> None:
        db, found = self._db, self._found
        names = {row[0] for row in db.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        ended = [row[0] for row in db.execute("SELECT id FROM trials WHERE end IS NOT NULL ORDER BY id")]
        found.trials = len(ended)
        about = dict(db.execute("SELECT key, value FROM about"))
        if about["format"] == "1" and "digests" not in names:
            found.without = ended
            return
        since: dict[str, int] = json.loads(about["without digests"])
        for name, wanted in json.loads(about["files"]).items():
            self._beside(name, wanted)
        there = self._chains()
        self._all_there(there, since)
        self._under_way()
        self._sessions()
        found.without = [k for k in ended if k <= since["trials"] and ("trial", k) not in there]

    def _beside(self, name: str, wanted: str) -> None:
        try:
            content = (self._folder / name).read_bytes()
        except OSError as error:
            self._others.append(f"the file {name}: {error.strerror or error}")
        else:
            if hashlib.sha256(content).hexdigest() != wanted:
                self._others.append(f"the file {name} is not as it was when the experiment began")

    def _chains(self) -> set[tuple[str, int | str | None]]:
        """Go along the chains; what has a digest."""
        rows = self._db.execute("SELECT id, subject, kind, item, content, digest FROM digests ORDER BY id").fetchall()
        self._found.links = len(rows)
        last = {(kind, subject if kind == "subject" else item): number for number, subject, kind, item, _, _ in rows}
        before: dict[str | None, bytes] = {}
        for number, subject, kind, item, content, digest in rows:
            name = _name(kind, subject, item)
            if digests.of_link(before.get(subject, b""), number, subject, kind, item, content) != digest:
                self._damaged(kind, f"{name}: digest {number} does not follow from the one before it")
            before[subject] = digest
            state = kind in _STATES
            if state and last[kind, subject if kind == "subject" else item] != number:
                continue
            now = digests.of_content(self._db, kind, subject, item)
            if now != content:
                self._damaged(kind, f"{name} {'is missing' if now is None else 'is not as it was written'}")
        self._found.whole = digests.sha(*(before[s] for s in sorted(before, key=lambda s: s or ""))).hex()
        return set(last)

    def _all_there(self, there: set[tuple[str, int | str | None]], since: dict[str, int]) -> None:
        for kind, query in _ITEMS.items():
            after = since["events" if kind == "event" else "trials"]
            for number, subject, name in self._db.execute(query, (after,)):
                if (kind, number) not in there:
                    self._damaged(kind, f"{name} of {subject} has no digest, and should have one")
        for (code,) in self._db.execute("SELECT code FROM subjects"):
            if ("subject", code) not in there:
                self._others.append(f"subject {code} has no digest, and should have one")
        if ("experiment", None) not in there:
            self._others.append("what is said about the experiment has no digest, and should have one")
        for (trial,) in self._db.execute("SELECT DISTINCT trial FROM cycles WHERE trial NOT IN (SELECT id FROM trials)"):
            self._damaged("trial", f"trial {trial} is missing, and its cycles are there")

    def _under_way(self) -> None:
        query = (
            "SELECT id, content, under_way.trial FROM trials LEFT JOIN under_way ON trial = id WHERE end IS NULL ORDER BY id"
        )
        last = json.loads(self._db.execute("SELECT value FROM about WHERE key = 'without digests'").fetchone()[0])["trials"]
        for trial, content, known in self._db.execute(query).fetchall():
            if known is None and trial <= last:
                continue
            if content != digests.of_trial(self._db, trial):
                self._damaged("trial", f"trial {trial}, which is not over, is not as it was written")
        query = "SELECT trial FROM under_way WHERE trial NOT IN (SELECT id FROM trials WHERE end IS NULL)"
        for (trial,) in self._db.execute(query):
            self._damaged("trial", f"trial {trial} was not over, and is")

    def _sessions(self) -> None:
        for *row, digest in self._db.execute("SELECT subject, key, seq, bytes, digest FROM sessions").fetchall():
            if digests.of_session(row) != digest:
                self._others.append(f"the session of the page of {row[0]} is not as it was written")

    def _damaged(self, kind: str, sentence: str) -> None:
        (self._found.damaged if kind == "trial" else self._others).append(sentence)


def _name(kind: str, subject: str | None, item: int | None) -> str:
    of = "" if subject is None else f" of {subject}"
    match kind:
        case "experiment":
            return "what is said about the experiment"
        case "subject":
            return f"subject {subject}"
        case "rating":
            return f"the rating of trial {item}{of}"
        case _:
            return f"{kind} {item}{of}"
