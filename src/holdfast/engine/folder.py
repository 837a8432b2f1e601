"""What every folder of results needs: a lock, checksums, and bounds for what is written in it."""

from __future__ import annotations

import hashlib
import importlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import StoreError
from holdfast.files.output import guarded

SAFE = "what was committed is safe: make room and run the same command again"
MOST_ROWS, MOST_CHUNKS = 10**15, 10**7


def too_many(rows: int, chunk: int) -> bool:
    """Whether so many rows, in chunks of so many, are more than a program can count in a sensible time."""
    return rows > MOST_ROWS or -(-rows // chunk) > MOST_CHUNKS


def is_plain(name: object) -> bool:
    """Whether something is the name of a folder right here, on every system."""
    return (
        isinstance(name, str)
        and name not in ("", ".", "..")
        and not set(name) & set("/\\\0")
        and len(name.encode(errors="replace")) < 256
    )


def taken_for(plan: Mapping[str, Any], old: Mapping[str, Any], formerly: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """The plan that a folder holds, as this version writes it.

    Args:
        plan: What is asked for.
        old: What the folder holds.
        formerly: Entries of ``plan`` as earlier versions wrote them, None for those that they did not have.
    """
    wanted = by_content(plan)
    old = {**old, **{key: plan[key] for key, value in by_content(old).items() if value == wanted.get(key)}}
    if formerly is None or any(old.get(key) != value for key, value in formerly.items()):
        return old
    return {**old, **{key: plan[key] for key in formerly}}


def by_content(plan: Mapping[str, Any]) -> dict[str, Any]:
    """What defines the results of a plan: of an entry with a ``sha256`` that alone, not where its files lie."""
    return {key: x["sha256"] if isinstance(x, dict) and "sha256" in x else x for key, x in plan.items()}


def difference(old: Mapping[str, Any], new: Mapping[str, Any]) -> str:
    """The first entry in which the plan of a folder and the one asked for differ, for a sentence; empty if none."""
    if old.get("index") == new.get("index") and old.get("index_digest") != new.get("index_digest"):
        return f"the function of its index '{new.get('index')}' has changed since"
    for key in sorted({*old, *new}):
        if old.get(key) != new.get(key):
            a, b = (shortened(json.dumps(x.get(key))) for x in (old, new))
            return f"its {key} is {a}, asked for is {b}"
    return ""


def shortened(text: str, most: int = 60) -> str:
    """A text, its end left out where it is too long for a sentence."""
    return text if len(text) <= most else text[: most - 3] + "..."


@contextmanager
def held(folder: Path, name: str) -> Iterator[None]:
    """Hold a folder by a lock on the file ``name`` in it, which ends with this program.

    Raises:
        StoreError: Another program holds it, or the folder is not writable.
    """
    with guarded(folder):
        handle = os.open(folder / name, os.O_CREAT | os.O_RDWR, 0o644)
    try:
        try:
            _lock(handle)
        except OSError as error:
            raise StoreError(f"another program is writing to '{folder}'; wait for it or stop it") from error
        yield
    finally:
        os.close(handle)


def _lock(handle: int) -> None:
    """Lock an open file for this program until it is closed; raise OSError where another program holds the lock."""
    try:
        import fcntl
    except ImportError:  # Windows
        msvcrt = importlib.import_module("msvcrt")
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
    else:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def digest(columns: Mapping[str, NDArray[Any]]) -> str:
    """Checksum of values: of their names, types, shapes and bits."""
    found = hashlib.blake2b(digest_size=16)
    for name in sorted(columns):
        values = np.ascontiguousarray(columns[name])
        found.update(f"{name} {values.dtype.str} {values.shape}".encode())
        found.update(values.view(np.uint8).data if values.size else b"")
    return found.hexdigest()
