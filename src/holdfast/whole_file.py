"""Files that are written as a whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
from pathlib import Path


def replaced(path: Path, text: str, errors: str = "strict") -> None:
    """Write a file, all of it or nothing, with the permissions that every new file gets.

    Args:
        path: The file.
        text: Its content, written as UTF-8.
        errors: What becomes of characters that UTF-8 does not have, as :meth:`str.encode` takes it.

    Raises:
        OSError: The disk refuses; what was there is as it was.
    """
    if not path.name:
        raise OSError(errno.EISDIR, "this is no name of a file")
    temporary = path.with_name(f".holdfast-{os.getpid()}-{secrets.token_hex(4)}.tmp")
    try:
        # Not tempfile: its files are private, and results are for sharing.
        with temporary.open("x", encoding="utf-8", errors=errors, newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
