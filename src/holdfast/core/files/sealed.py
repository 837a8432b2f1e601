"""Read sealed JSON files, and files of earlier versions without a seal."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.files.digest import check_seal, is_sealed


def read_sealed(path: str | Path, sealed_format: int | None = None, own_digest: bool = False) -> Any:
    """Return the content of a JSON file without its digest, after comparing it with the digest.

    A file without a digest is read only if it does not state that it is sealed: earlier versions wrote none.

    Args:
        path: The file.
        sealed_format: Value of the key ``format`` that only sealed files have, if there is one.
        own_digest: Files of earlier versions have an entry ``digest`` with another meaning, which is returned.

    Raises:
        OSError: The file cannot be read.
        ValueError: It is not UTF-8, not JSON, or nested too deep.
        InputError: Its digest does not match.
    """
    content = reading.read_bytes(path).decode()  # exactly: a changed end of a line counts as well
    data = reading.read_json(path)
    if not isinstance(data, dict):
        raise InputError("it is not a JSON object")
    stated = "sealed" in data or data.get("format", "") == sealed_format or ("digest" in data and not own_digest)
    if stated or is_sealed(content):
        check_seal(content)
        del data["digest"]
    return data
