"""Read files that users name: only regular files up to a size, so that a device, pipe, or disk image is rejected at once."""

from __future__ import annotations

import errno
import json
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from holdfast.core.errors import HoldfastError, InputError

LARGEST_FILE_BYTES = 256 << 20
LARGEST_INTEGER = 1 << 63  # for parsed text
MAX_INTEGER_DIGITS = 80  # of a whole number, with its base and separators


@contextmanager
def guard_reading(
    file_name: str = "the file", advice: str = "", error_type: type[HoldfastError] = InputError
) -> Iterator[None]:
    """Context of a block that reads; if the operating system reports an error, raise it as one sentence.

    Args:
        file_name: Name of the file in the message.
        advice: End of the message.
        error_type: Type of the error that is raised.
    """
    try:
        yield
    except OSError as error:
        ending = f"; {advice}" if advice else ""
        raise error_type(f"{file_name} cannot be read ({error.strerror or error}){ending}") from error


def read_bytes(path: str | Path, max_bytes: int = LARGEST_FILE_BYTES) -> bytes:
    """Read the content of a file as bytes.

    Args:
        path: The file.
        max_bytes: Maximum size of the file, bytes.

    Raises:
        OSError: The file cannot be read, is not a regular file, or is too large; ``strerror`` gives the reason.
    """
    try:
        state = Path(path).stat()
    except ValueError as error:
        raise OSError(errno.EINVAL, "its name holds a null character", str(path)) from error
    if stat.S_ISDIR(state.st_mode):
        raise OSError(errno.EISDIR, "it is a folder, not a file", str(path))
    if not stat.S_ISREG(state.st_mode):  # opening a pipe waits, and reading a device may never end
        raise OSError(errno.EINVAL, "it is a device, pipe or socket, not a regular file", str(path))
    content = b""
    if state.st_size <= max_bytes:
        with Path(path).open("rb") as file:
            content = file.read(max_bytes + 1)  # not the stated size, because files of /proc have none
    if max(state.st_size, len(content)) > max_bytes:
        raise OSError(errno.EFBIG, f"it is larger than {max_bytes / (1 << 20):.4g} MiB", str(path))
    return content


def read_text(path: str | Path, max_bytes: int = LARGEST_FILE_BYTES) -> str:
    """Read a UTF-8 file without its byte order mark; its lines end with line feeds.

    Args:
        path: The file.
        max_bytes: Maximum size of the file, bytes.

    Raises:
        OSError: As :func:`read_bytes`.
        UnicodeDecodeError: The file is not UTF-8.
    """
    return read_bytes(path, max_bytes).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def read_json(path: str | Path) -> Any:
    """Read the content of a JSON file.

    Raises:
        OSError: As :func:`read_bytes`.
        ValueError: The text is not UTF-8, not JSON, nested too deep, or has a whole number beyond 2^63 or half a surrogate
            pair.
    """
    return parse_json(read_text(path))


def parse_json(content: str) -> Any:
    """Return the content of a JSON text.

    Raises:
        ValueError: The text is not JSON, nested too deep, or has a whole number beyond 2^63 or half a surrogate pair.
    """
    try:
        data = json.loads(content, parse_int=_parse_integer)
    except RecursionError as error:
        raise ValueError("it is nested too deep") from error
    if "\\u" in content and not is_unicode(json.dumps(data, ensure_ascii=False)):
        raise ValueError("a text in it holds half of a surrogate pair")
    return data


def _parse_integer(digits: str) -> int:
    if len(digits) > MAX_INTEGER_DIGITS or abs(int(digits)) > LARGEST_INTEGER:
        raise ValueError(f"the whole number {digits[:20]}... is beyond 2^63")
    return int(digits)


def is_unicode(text: str) -> bool:
    """Return whether a text can be written as UTF-8, which excludes half of a surrogate pair."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def path_exists(path: str | Path) -> bool:
    """Return whether a file or folder of this name exists; False for a name that no file can have."""
    try:
        Path(path).stat()
    except (OSError, ValueError):
        return False
    return True
