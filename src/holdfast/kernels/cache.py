"""Object code on disk, so that the second start of a program does not compile again.

A file is: a line that names the format, the SHA-256 of everything that follows, and the object code. Its name is the key: the
program, the level, the processor, the text of the translation. The folder belongs to the user alone: a folder or file that
somebody else owns or may write is not read, nor is anything but a regular file. Above 1 GiB what was not used for
longest goes. ``HOLDFAST_CACHE`` names another folder, or switches the cache off when it is ``off``.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import tempfile
from functools import lru_cache
from pathlib import Path

from holdfast.kernels.llvm import machine_code

_MAGIC = b"holdfast kernel 1\n"
_LARGEST_FILE, _LARGEST_FOLDER = 1 << 28, 1 << 30  # bytes
_written: dict[Path, int] = {}  # bytes that this process added to each folder since it last looked at all of it


def folder() -> Path | None:
    """The cache folder, created private to the user, or None if the cache is off or the folder is not ours alone."""
    setting = os.environ.get("HOLDFAST_CACHE")
    if setting == "off":
        return None
    try:
        base = Path(setting) if setting else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "holdfast"
        path = base / "kernels"
        path.mkdir(parents=True, exist_ok=True, mode=0o700)
        return path if _ours(path.stat()) else None
    except (OSError, RuntimeError):  # no home at all
        return None


def _ours(found: os.stat_result) -> bool:
    """True if nobody else may write it."""
    return not hasattr(os, "getuid") or (found.st_uid == os.getuid() and not found.st_mode & 0o022)


@lru_cache(maxsize=1)
def _machine() -> str:
    here = machine_code.host()
    # A kernel made by other code is another kernel.
    sources = [file for folder in ("llvm", "gpu") for file in sorted(Path(__file__).with_name(folder).glob("*.py"))]
    code = hashlib.sha256(b"".join(file.read_bytes() for file in sources)).hexdigest()
    return "|".join([code, machine_code.version(), here.cpu, here.features, repr(here.machine)])


def key(digest: str, *what: object) -> str:
    """File name of a program's code, or of anything else that depends on the machine and the translation."""
    return hashlib.sha256("|".join([digest, *map(str, what), _machine()]).encode()).hexdigest()


def load(name: str) -> bytes | None:
    """What was stored, or None if it is not there, damaged, or not ours alone."""
    path = folder()
    if path is None:
        return None
    try:
        # A pipe would wait forever; a link may lead anywhere.
        handle = os.open(path / name, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return None
    with os.fdopen(handle, "rb") as file:
        try:
            found = os.fstat(handle)
            if not stat.S_ISREG(found.st_mode) or not _ours(found) or found.st_size > _LARGEST_FILE:
                return None
            data = file.read()
        except OSError:
            return None
    head = len(_MAGIC) + 32
    if data[: len(_MAGIC)] != _MAGIC or hashlib.sha256(data[head:]).digest() != data[len(_MAGIC) : head]:
        return None
    with contextlib.suppress(OSError):
        os.utime(path / name)
    return data[head:]


def store(name: str, body: bytes) -> None:
    """Write whole or not at all; a full disk or a read-only home only costs the next start some time."""
    path = folder()
    if path is None:
        return
    with contextlib.suppress(OSError):
        handle, temporary = tempfile.mkstemp(dir=path, prefix=".new-")  # mode 600
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_MAGIC + hashlib.sha256(body).digest() + body)
            Path(temporary).replace(path / name)
        except OSError:
            Path(temporary).unlink()
        # To look at thousands of files takes longer than to write one.
        _written[path] = _written.get(path, _LARGEST_FOLDER) + len(body)
        if _written[path] > _LARGEST_FOLDER >> 5:
            _written[path] = 0
            _trim(path)


def _trim(path: Path) -> None:
    """Remove what was not used for longest until the folder is small enough."""
    with os.scandir(path) as entries:
        files = [(f.stat(follow_symlinks=False), f.path) for f in entries]
    size = sum(found.st_size for found, _ in files)
    for found, name in sorted(files, key=lambda f: f[0].st_mtime):
        if size <= _LARGEST_FOLDER:
            return
        Path(name).unlink(missing_ok=True)
        size -= found.st_size
