"""Tools of every results folder: a lock, checksums, and limits on its size."""

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

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.output import guard_writing
from holdfast.core.files.sealed import read_sealed

RESUME_ADVICE = "what was committed is safe: make room and run the same command again"
STUDY_FILE = "study.json"
MAX_ROWS = 10**15
MAX_CHUNKS = 10**7


def has_too_many_rows(rows: int, chunk: int) -> bool:
    """Return whether there are too many rows, in chunks of this size, to process in a sensible time."""
    return rows > MAX_ROWS or -(-rows // chunk) > MAX_CHUNKS


def is_valid_folder_name(name: object) -> bool:
    """Return whether a name is a valid folder name, without a path, on every system."""
    return (
        isinstance(name, str)
        and name not in ("", ".", "..")
        and not set(name) & set("/\\\0")
        and len(name.encode(errors="replace")) < 256
    )


def read_run_file(file: Path, format_name: str, version: int, *, kind: str, advice: str) -> dict[str, Any]:
    """Read the file that identifies a folder of this ``kind`` ("a study"), and check its digest, format and version.

    Raises:
        StoreError: The file cannot be read, or it has another format or version. The message ends with ``advice``.
    """
    convert = "convert a folder of an early version with holdfast.studies.convert_folder"
    try:
        data: dict[str, Any] = read_sealed(file)
    except (OSError, ValueError, InputError) as error:
        raise StoreError(f"'{file}' cannot be read ({error}); {advice}, or {convert}") from error
    if data.get("format") != format_name:
        raise StoreError(f"'{file}' was not written by holdfast; give the folder of {kind}")
    if data.get("version") != version:
        raise StoreError(
            f"'{file.parent}' was written in format {data.get('version')}; this holdfast reads format {version}, and "
            "holdfast.studies.convert_folder converts earlier formats"
        )
    return data


def own_study_folder(cell_folder: Path) -> Path | None:
    """Return the folder of the study to which a results folder belongs, or None for a results folder outside a study."""
    parents = cell_folder.resolve().parents
    return parents[1] if len(parents) > 1 and (parents[1] / STUDY_FILE).exists() else None


def relocate_stored_plan(plan: Mapping[str, Any], stored_plan: Mapping[str, Any]) -> dict[str, Any]:
    """Return a stored plan with the file locations of the requested plan where the content of the files is the same."""
    content, stored_content = plan_content(plan), plan_content(stored_plan)
    return {key: plan[key] if key in plan and content[key] == stored_content[key] else x for key, x in stored_plan.items()}


def plan_content(plan: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entries of a plan that define its results; a file counts by its ``sha256``, not by its location."""
    return {key: x["sha256"] if isinstance(x, dict) and "sha256" in x else x for key, x in plan.items()}


def describe_difference(old: Mapping[str, Any], new: Mapping[str, Any]) -> str:
    """Return the first entry in which the plan of a folder differs from the requested plan, as text; empty if none."""
    if old.get("index") == new.get("index") and old.get("index_digest") != new.get("index_digest"):
        return f"the function of its index '{new.get('index')}' has changed since the run began"
    for key in sorted({*old, *new}):
        if old.get(key) != new.get(key):
            a, b = (shorten(json.dumps(x.get(key))) for x in (old, new))
            return f"its {key} is {a}, but {b} was requested"
    return ""


def shorten(text: str, most: int = 60) -> str:
    """Return a text, shortened if it is too long for a message."""
    return text if len(text) <= most else text[: most - 3] + "..."


@contextmanager
def lock_folder(folder: Path, name: str) -> Iterator[None]:
    """Lock a folder through the file ``name`` in it until the block or this program ends.

    Raises:
        StoreError: Another program holds the lock, or the folder is not writable.
    """
    with guard_writing(folder):
        handle = os.open(folder / name, os.O_CREAT | os.O_RDWR, 0o644)
    try:
        try:
            _lock_file(handle)
        except OSError as error:
            raise StoreError(f"another program is writing to '{folder}'; wait for it or stop it") from error
        yield
    finally:
        os.close(handle)


def _lock_file(handle: int) -> None:
    """Lock an open file for this program until it is closed; raise OSError where another program holds the lock."""
    try:
        import fcntl
    except ImportError:  # Windows
        msvcrt = importlib.import_module("msvcrt")
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
    else:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def digest_columns(columns: Mapping[str, NDArray[Any]]) -> str:
    """Return the checksum of values: of their names, types, shapes, and bits."""
    digest = hashlib.blake2b(digest_size=16)
    for name in sorted(columns):
        values = np.ascontiguousarray(columns[name])
        digest.update(f"{name} {values.dtype.str} {values.shape}".encode())
        digest.update(values.view(np.uint8).data if values.size else b"")
    return digest.hexdigest()
