"""Compiled kernels on disk, so that the second start of a program does not compile again.

A kernel pickles with its machine code. The folder belongs to the user alone and is never exchanged: entries are
bound to the expression, the versions and the processor, and carry a checksum; a damaged one is compiled anew.
``HOLDFAST_CACHE`` names another folder, or switches the cache off when it is ``off``.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import platform
import sys
import tempfile
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

_TRANSLATION = ("heyoka_backend.py", "trigonometry.py")  # a kernel made by other code is another kernel


def folder() -> Path | None:
    """The cache folder, created private to the user, or None if the cache is off or the folder is not ours."""
    setting = os.environ.get("HOLDFAST_CACHE")
    if setting == "off":
        return None
    base = Path(setting) if setting else Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "holdfast"
    path = base / "kernels"
    try:
        path.mkdir(parents=True, exist_ok=True, mode=0o700)
        if hasattr(os, "getuid") and path.stat().st_uid != os.getuid():
            return None
    except OSError:
        return None
    return path


@lru_cache(maxsize=1)
def _machine() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        cpu = next((x for x in lines if x.startswith("model name")), "") + next((x for x in lines if x.startswith("flags")), "")
    except OSError:
        cpu = platform.processor() + platform.machine()
    code = hashlib.sha256(b"".join(Path(__file__).with_name(name).read_bytes() for name in _TRANSLATION)).hexdigest()
    return "|".join([code, version("heyoka"), sys.version, platform.platform(), cpu])


def key(digest: str, lanes: int) -> str:
    """File name of a kernel: expression, versions, processor and width."""
    return hashlib.sha256(f"{digest}|{lanes}|{_machine()}".encode()).hexdigest()


def load(name: str) -> Any | None:
    """The stored kernel, or None if there is none or it is damaged."""
    path = folder()
    if path is None:
        return None
    try:
        data = (path / name).read_bytes()
        if hashlib.sha256(data[32:]).digest() != data[:32]:
            return None
        return pickle.loads(data[32:])
    except (OSError, pickle.UnpicklingError, AttributeError, ImportError, EOFError):
        return None


def store(name: str, compiled: Any) -> None:
    """Write atomically; a full disk or a read-only home only costs the next start some time."""
    path = folder()
    if path is None:
        return
    body = pickle.dumps(compiled)
    try:
        handle, temporary = tempfile.mkstemp(dir=path, prefix=".new-")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.sha256(body).digest() + body)
            Path(temporary).replace(path / name)
        except OSError:
            Path(temporary).unlink()
    except OSError:
        return
