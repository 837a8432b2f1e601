"""Write files completely or not at all."""

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

from holdfast.core.errors import StoreError
from holdfast.core.files.spreadsheet import escape_formula

_TEMPORARY_SUFFIX = ".holdfast-{}.tmp"  # beside a file that is being written


@contextmanager
def guard_writing(target: str | Path, content_name: str = "to", advice: str = "choose another folder") -> Iterator[None]:
    """Context of a block that writes; if the disk refuses, the error states it in one sentence.

    Args:
        target: The file or folder that the sentence names.
        content_name: It is: ``report``, ``tables into``.
        advice: How the sentence ends.

    Raises:
        StoreError: The disk refused.
    """
    try:
        yield
    except OSError as error:
        target_text = f"{content_name} '{target}'".lstrip()
        raise StoreError(f"cannot write {target_text}: {error.strerror or error}; {advice}") from error


def make_folder(folder: str | Path) -> Path:
    """Return the folder, after creating it where needed.

    Raises:
        StoreError: It cannot be made.
    """
    path = Path(folder)
    with guard_writing(path):
        path.mkdir(parents=True, exist_ok=True)
    return path


def replace_file(
    path: Path, content: str | bytes, content_name: str = "", advice: str = "choose another path", errors: str = "strict"
) -> None:
    """Write a file completely or not at all, with the permissions of a new file.

    Args:
        path: The file.
        content: Its content; text is written as UTF-8.
        content_name: It is, for the sentence where the disk refuses; see :func:`guard_writing`.
        advice: How that sentence ends.
        errors: What becomes of characters that UTF-8 does not have, as :meth:`str.encode` takes it.

    Raises:
        StoreError: The disk refuses; what was there is as it was.
    """
    with guard_writing(path, content_name, advice), _temporary_file(path) as temporary:
        temporary.write_bytes(content.encode(errors=errors) if isinstance(content, str) else content)


def write_files(folder: str | Path, texts: Mapping[str, str]) -> list[Path]:
    """Write text files into a folder, which is created where needed."""
    folder_path = make_folder(folder)
    for name, text in texts.items():
        replace_file(folder_path / name, text)
    return [folder_path / name for name in texts]


def is_occupied(folder: Path) -> bool:
    """Return whether a folder contains anything except what an interrupted :func:`replace_file` leaves."""
    return not all(file.match(_TEMPORARY_SUFFIX.format("*")) for file in folder.iterdir())


@contextmanager
def open_replacement(path: Path, content_name: str = "") -> Iterator[TextIO]:
    """Open a UTF-8 text file that takes its place when the block ends without an error; line ends are written as given.

    Raises:
        StoreError: The disk refuses; what was there is as it was.
    """
    with (
        guard_writing(path, content_name, "choose another path"),
        _temporary_file(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        yield file


def write_table(
    path: str | Path,
    content_name: str,
    header: Sequence[str],
    rows: NDArray[np.float64],
    number_format: str | Sequence[str] = "%.9g",
) -> Path:
    """Write numbers (N, columns) as CSV, each as ``number_format`` says; ``content_name`` they are is for the error.

    Raises:
        StoreError: It cannot be written.
    """
    file = Path(path)
    with open_replacement(file, content_name) as stream:
        csv.writer(stream, lineterminator="\n").writerow(map(escape_formula, header))
        np.savetxt(stream, rows, fmt=number_format, delimiter=",")
    return file


@contextmanager
def _temporary_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path; its file is flushed to the disk before it replaces the target."""
    if path.exists() and not path.is_file():  # a device or a pipe is written to, not replaced
        yield path
        return
    path = path.resolve()  # a link stays one
    # Not tempfile: its files are private, and results are for sharing.
    temporary = path.with_name(_TEMPORARY_SUFFIX.format(f"{os.getpid()}-{secrets.token_hex(4)}"))
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
