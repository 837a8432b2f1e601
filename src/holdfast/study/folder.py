"""What every folder of results needs: a lock, and checksums."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import StoreError


@contextmanager
def held(folder: Path, name: str) -> Iterator[None]:
    """Hold a folder by a lock on the file ``name`` in it, which dies with this program.

    Raises:
        StoreError: Another program holds it, or the folder is not writable.
    """
    try:
        handle = os.open(folder / name, os.O_CREAT | os.O_RDWR, 0o644)
    except OSError as error:
        raise StoreError(f"cannot write to '{folder}': {error.strerror}; choose another folder") from error
    try:
        try:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except ImportError:  # no such locks on this system
            pass
        except OSError as error:
            raise StoreError(f"another program is writing to '{folder}'; wait for it or stop it") from error
        yield
    finally:
        os.close(handle)


def digest(columns: Mapping[str, NDArray[Any]]) -> str:
    """Checksum of values: of their names, types, shapes and bits."""
    found = hashlib.blake2b(digest_size=16)
    for name in sorted(columns):
        values = np.ascontiguousarray(columns[name])
        found.update(f"{name} {values.dtype.str} {values.shape}".encode())
        found.update(values.view(np.uint8).data if values.size else b"")
    return found.hexdigest()
