"""Read sealed JSON files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.digest import check_seal


def read_sealed(path: str | Path) -> Any:
    """Return the content of a JSON file without its digest, after checking the digest.

    Raises:
        OSError: The file cannot be read.
        ValueError: The file is not UTF-8, not JSON, or nested too deep.
        InputError: The digest is missing or does not match.
    """
    content = reading.read_bytes(path).decode()  # exact bytes, so that a changed line end counts as a change
    data = reading.read_json(path)
    if not isinstance(data, dict):
        raise InputError("it is not a JSON object")
    check_seal(content)
    del data["digest"]
    return data
