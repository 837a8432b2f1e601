"""Single-bit changes of a folder of records, and another program's reading of it, to compare with what verify says."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records.entries import TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import Session
from holdfast.teleop.records.verification import verify_records
from holdfast.teleop.trials.recordings import End


@dataclass
class Seen:
    """What came of the changes.

    Attributes:
        touched: How many changed what another program reads.
        missed: Those that were not seen: file, byte, new value.
    """

    touched: int = 0
    missed: list[tuple[str, int, int]] = field(default_factory=list)


def trial(records: Records, code: str, rng: np.random.Generator, cycles: int = 60, end: End | None = End.ABORTED) -> int:
    """The next trial of a subject, given up; its number."""
    todo = Session(records, code).next_trial()
    assert todo is not None
    number = records.begin_trial(code, todo.kind, todo.position, scenario=todo.scenario, tasks=todo.tasks, task=todo.task)
    q, time = rng.normal(size=(cycles + 1, 3)), np.arange(cycles) / 6
    records.append_cycles(number, 0, time, velocity=rng.normal(size=(cycles, 2)), q=q[:-1])
    if end is not None:
        records.finish_trial(number, end, q[-1])
        if todo.kind == TrialKind.TRIAL:
            records.rate_trial(number, 2, {"why": "slow"})
    return number


def experiment(folder: Path) -> None:
    """Records with some of everything: six trials that are over, and one that is not."""
    whole = read_protocol()
    tasks = whole.with_tasks(whole.tasks.take(np.array([0, 9])), ["a", "b"])
    training = Training(at_least=1, in_a_row=1, limit=80.0, most=3)
    rng = np.random.default_rng(1)
    with Records.create(folder, replace(tasks, substeps=1, training=training, scenarios=whole.scenarios[:2])) as records:
        codes = [records.add_subject(answers={"age": "30"}).code for _ in range(2)]
        records.give_key(codes[0])
        for _ in range(2):
            trial(records, codes[0], rng)
        trial(records, codes[0], rng, end=End.ARRIVED)
        trial(records, codes[0], rng, cycles=150)
        records.add_event("dropped-frames", codes[0], 1, k=3, data={"count": 3})
        records.add_event("paused", data={"by": "experimenter"})
        records.set_last_seq(codes[0], 41, 4711)
        trial(records, codes[1], rng, end=None)  # broken off by the next
        trial(records, codes[1], rng)
        records.set_note(codes[1], "telephone")
        trial(records, codes[1], rng, end=None)


def older(folder: Path) -> None:
    """Records as they were before there were digests."""
    with closing(sqlite3.connect(folder / "records.sqlite", isolation_level=None)) as db:
        for table in ("digests", "under_way", "sessions"):
            db.execute(f"DROP TABLE {table}")
        db.execute("DELETE FROM about WHERE key IN ('files', 'without digests')")
        db.execute("UPDATE about SET value = '1' WHERE key = 'format'")


def copied(source: Path, target: Path) -> None:
    """A fresh copy of a folder."""
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(source, target)


def content(folder: Path) -> object:
    """All that another program reads in a folder: every table as bytes, and the other files; what it says if it cannot."""
    try:
        with closing(sqlite3.connect(f"{(folder / 'records.sqlite').as_uri()}?mode=ro&immutable=1", uri=True)) as db:
            db.text_factory = bytes
            names = [row[0] for row in db.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]
            tables = {
                n: sorted(map(repr, db.execute(f'SELECT * FROM "{n.decode("utf-8", "replace")}"').fetchall())) for n in names
            }
            schema = db.execute("SELECT sql FROM sqlite_master ORDER BY name").fetchall()
    except (sqlite3.Error, ValueError, OverflowError, MemoryError) as error:
        return repr(error)
    return tables, schema, (folder / "protocol.yaml").read_bytes()


def flipped(source: Path, copy: Path, count: int, rng: np.random.Generator, read: Callable[[], object] = lambda: None) -> Seen:
    """Change single bits of a copy, one at a time, and ask verify; ``read`` is called where the change touched data."""
    return changed(source, copy, change_bits, count, rng, read=read)


def change_bits(data: bytes, count: int, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Choose bytes of the data, and each with another value for one of its bits."""
    places = (divmod(place, 8) for place in rng.choice(8 * len(data), count, replace=8 * len(data) < count).tolist())
    return [(byte, data[byte] ^ 1 << bit) for byte, bit in places]


def change_digits(data: bytes, count: int, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Choose bytes of the data that are decimal digits, and for each another digit."""
    digits = np.flatnonzero((np.frombuffer(data, np.uint8) >= ord("0")) & (np.frombuffer(data, np.uint8) <= ord("9")))
    return [(byte, 48 + (data[byte] - 48 + int(rng.integers(1, 10))) % 10) for byte in rng.choice(digits, count).tolist()]


def is_damaged(folder: Path) -> bool:
    """Return whether verify finds damage."""
    return bool(verify_records(folder).damages)


def changed(
    source: Path,
    copy: Path,
    change: Callable[[bytes, int, np.random.Generator], list[tuple[int, int]]],
    count: int,
    rng: np.random.Generator,
    *,
    is_seen: Callable[[Path], bool] = is_damaged,
    read: Callable[[], object] = lambda: None,
) -> Seen:
    """Change single bytes of a copy, one at a time.

    Args:
        source: The folder of an experiment.
        copy: Where the changes are made.
        change: Chooses bytes and their new values.
        count: How many changes.
        rng: Of the choices.
        is_seen: Is asked of the copy after each change of data.
        read: Is called after each change of data.
    """
    copied(source, copy)
    before, seen = content(source), Seen()
    files = [copy / "records.sqlite", copy / "protocol.yaml"]
    size = files[0].stat().st_size
    assert sorted(f.name for f in copy.iterdir()) == sorted(f.name for f in files)
    for place, value in change(b"".join(f.read_bytes() for f in files), count, rng):
        which, byte = int(place >= size), place - size * (place >= size)
        original = files[which].read_bytes()
        files[which].write_bytes(original[:byte] + bytes([value]) + original[byte + 1 :])
        touched = content(copy) != before
        seen.touched += touched
        if touched and not is_seen(copy):
            seen.missed.append((files[which].name, byte, value))
        if touched:
            read_protocol()
        for left in copy.glob("records.sqlite-*"):
            left.unlink()
        files[which].write_bytes(original)
    return seen
