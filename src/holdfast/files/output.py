"""Files that are written as a whole or not at all."""

from __future__ import annotations

import csv
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import StoreError
from holdfast.files.spreadsheet import cell

_TEMPORARY = ".holdfast-{}.tmp"  # beside a file that is being written


@contextmanager
def guarded(place: str | Path, what: str = "to", advice: str = "choose another folder") -> Iterator[None]:
    """A block that writes; where the disk refuses, one sentence says so.

    Args:
        place: The file or folder that the sentence names.
        what: It is: ``report``, ``tables into``.
        advice: How the sentence ends.

    Raises:
        StoreError: The disk refused.
    """
    try:
        yield
    except OSError as error:
        named = f"{what} '{place}'".lstrip()
        raise StoreError(f"cannot write {named}: {error.strerror or error}; {advice}") from error


def made(folder: str | Path) -> Path:
    """The folder, made where need be.

    Raises:
        StoreError: It cannot be made.
    """
    place = Path(folder)
    with guarded(place):
        place.mkdir(parents=True, exist_ok=True)
    return place


def replaced(
    path: Path, content: str | bytes, what: str = "", advice: str = "choose another path", errors: str = "strict"
) -> None:
    """Write a file, all of it or nothing, with the permissions that every new file gets.

    Args:
        path: The file.
        content: Its content; text is written as UTF-8.
        what: It is, for the sentence where the disk refuses; see :func:`guarded`.
        advice: How that sentence ends.
        errors: What becomes of characters that UTF-8 does not have, as :meth:`str.encode` takes it.

    Raises:
        StoreError: The disk refuses; what was there is as it was.
    """
    with guarded(path, what, advice), _beside(path) as temporary:
        temporary.write_bytes(content.encode(errors=errors) if isinstance(content, str) else content)


def put(folder: str | Path, texts: Mapping[str, str]) -> list[Path]:
    """Files of text in a folder, which is made where need be; each as :func:`replaced`."""
    place = made(folder)
    for name, text in texts.items():
        replaced(place / name, text)
    return [place / name for name in texts]


def occupied(folder: Path) -> bool:
    """Whether a folder holds anything but what :func:`replaced` leaves there when the program is killed while it writes."""
    return not all(file.match(_TEMPORARY.format("*")) for file in folder.iterdir())


@contextmanager
def writing(path: Path, what: str = "") -> Iterator[TextIO]:
    """A file of text in UTF-8 to write into, line ends as given; it takes its place once the block ends, if nothing was wrong.

    Raises:
        StoreError: The disk refuses; what was there is as it was.
    """
    with (
        guarded(path, what, "choose another path"),
        _beside(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        yield file


def write_table(
    path: str | Path, what: str, header: Sequence[str], rows: NDArray[np.float64], form: str | Sequence[str] = "%.9g"
) -> Path:
    """Write numbers (N, columns) as CSV, each as ``form`` says; ``what`` they are is for the error.

    Raises:
        StoreError: It cannot be written.
    """
    file = Path(path)
    with writing(file, what) as stream:
        csv.writer(stream, lineterminator="\n").writerow(map(cell, header))
        np.savetxt(stream, rows, fmt=form, delimiter=",")
    return file


@contextmanager
def _beside(path: Path) -> Iterator[Path]:
    """A place for what a file will hold; it is on the disk before it replaces what was there."""
    if path.exists() and not path.is_file():  # a device or a pipe is written to, not replaced
        yield path
        return
    path = path.resolve()  # a link stays one
    # Not tempfile: its files are private, and results are for sharing.
    temporary = path.with_name(_TEMPORARY.format(f"{os.getpid()}-{secrets.token_hex(4)}"))
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
