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

_TEMPORARY_SUFFIX = ".holdfast-{}.tmp"  # next to a file that is being written


@contextmanager
def guard_writing(target: str | Path, content_name: str = "to", advice: str = "choose another folder") -> Iterator[None]:
    """Context of a block that writes; if the operating system reports an error, raise it as one sentence.

    Args:
        target: File or folder that the message names.
        content_name: Words before the name, such as ``report`` or ``tables into``.
        advice: End of the message.

    Raises:
        StoreError: Writing failed.
    """
    try:
        yield
    except OSError as error:
        target_text = f"{content_name} '{target}'".lstrip()
        raise StoreError(f"cannot write {target_text}: {error.strerror or error}; {advice}") from error


def make_folder(folder: str | Path) -> Path:
    """Return the folder after creating it if it does not exist.

    Raises:
        StoreError: The folder cannot be created.
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
        content_name: Name of the content in the error message; see :func:`guard_writing`.
        advice: End of the error message.
        errors: Treatment of characters that UTF-8 does not have, as for :meth:`str.encode`.

    Raises:
        StoreError: Writing failed; an existing file is unchanged.
    """
    with guard_writing(path, content_name, advice), _temporary_file(path) as temporary:
        temporary.write_bytes(content.encode(errors=errors) if isinstance(content, str) else content)


def write_files(folder: str | Path, texts: Mapping[str, str]) -> list[Path]:
    """Write text files into a folder, which is created if it does not exist."""
    folder_path = make_folder(folder)
    for name, text in texts.items():
        replace_file(folder_path / name, text)
    return [folder_path / name for name in texts]


def is_occupied(folder: Path) -> bool:
    """Return whether a folder contains anything except what an interrupted :func:`replace_file` leaves."""
    return not all(file.match(_TEMPORARY_SUFFIX.format("*")) for file in folder.iterdir())


@contextmanager
def open_replacement(path: Path, content_name: str = "") -> Iterator[TextIO]:
    """Open a UTF-8 text file that replaces ``path`` when the block ends without an error; line ends are written unchanged.

    Raises:
        StoreError: Writing failed; an existing file is unchanged.
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
    """Write numbers (N, columns) as CSV in ``number_format``; ``content_name`` is the name of the content in error messages.

    Raises:
        StoreError: The file cannot be written.
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
    path = path.resolve()  # a symbolic link stays a link
    # Not tempfile, because its files are private and results are meant to be shared.
    temporary = path.with_name(_TEMPORARY_SUFFIX.format(f"{os.getpid()}-{secrets.token_hex(4)}"))
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
