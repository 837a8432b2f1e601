"""Cache object code on disk, so that a second start of a program need not compile it again.

A file contains a line that names the format, the SHA-256 of the rest, and the object code. Its name is the key: a digest of the
program, the optimisation level, the processor, and the source of the translation. The folder is private: a folder or file that
another user owns or may write is not read, and only regular files are read. Above 1 GiB the least recently used files are
deleted. ``HOLDFAST_CACHE`` names another folder, or switches the cache off if it is ``off``.
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

_FILE_HEADER = b"holdfast kernel 1\n"
# _MAX_FILE_BYTES and _MAX_FOLDER_BYTES: bytes
_MAX_FILE_BYTES = 1 << 28
_MAX_FOLDER_BYTES = 1 << 30
_written: dict[Path, int] = {}  # bytes that this process added to each folder since the last scan of the folder


def cache_folder() -> Path | None:
    """Return the cache folder, created private to the user, or None if the cache is off or other users may write the folder."""
    setting = os.environ.get("HOLDFAST_CACHE")
    if setting == "off":
        return None
    try:
        base = Path(setting) if setting else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "holdfast"
        path = base / "kernels"
        path.mkdir(parents=True, exist_ok=True, mode=0o700)
        return path if _is_private(path.stat()) else None
    except (OSError, RuntimeError):  # no home folder
        return None


def _is_private(file_status: os.stat_result) -> bool:
    """Return whether only the user may write the file."""
    return not hasattr(os, "getuid") or (file_status.st_uid == os.getuid() and not file_status.st_mode & 0o022)


@lru_cache(maxsize=1)
def _machine_digest() -> str:
    processor = machine_code.detect_processor()
    # Kernels of another version of this code must not be found.
    sources = [file for folder in ("llvm", "gpu") for file in sorted(Path(__file__).with_name(folder).glob("*.py"))]
    code = hashlib.sha256(b"".join(file.read_bytes() for file in sources)).hexdigest()
    return "|".join([code, machine_code.llvm_version(), processor.cpu, processor.features, repr(processor.machine)])


def cache_key(digest: str, *parts: object) -> str:
    """Return the file name for a program's code, or for other data that depend on the machine and the translation."""
    return hashlib.sha256("|".join([digest, *map(str, parts), _machine_digest()]).encode()).hexdigest()


def load_entry(name: str) -> bytes | None:
    """Return the stored content, or None if it is missing, damaged, or not private."""
    path = cache_folder()
    if path is None:
        return None
    try:
        # Opening a pipe would wait forever, and a link may lead anywhere.
        handle = os.open(path / name, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return None
    with os.fdopen(handle, "rb") as file:
        try:
            file_status = os.fstat(handle)
            if not stat.S_ISREG(file_status.st_mode) or not _is_private(file_status) or file_status.st_size > _MAX_FILE_BYTES:
                return None
            data = file.read()
        except OSError:
            return None
    header_size = len(_FILE_HEADER) + 32
    if (
        data[: len(_FILE_HEADER)] != _FILE_HEADER
        or hashlib.sha256(data[header_size:]).digest() != data[len(_FILE_HEADER) : header_size]
    ):
        return None
    with contextlib.suppress(OSError):
        os.utime(path / name)
    return data[header_size:]


def store_entry(name: str, body: bytes) -> None:
    """Write an entry completely or not at all; if the disk is full or read-only, only the next start takes longer."""
    path = cache_folder()
    if path is None:
        return
    with contextlib.suppress(OSError):
        handle, temporary = tempfile.mkstemp(dir=path, prefix=".new-")  # mode 600
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_FILE_HEADER + hashlib.sha256(body).digest() + body)
            Path(temporary).replace(path / name)
        except OSError:
            Path(temporary).unlink()
        # A scan of thousands of files takes longer than writing one.
        _written[path] = _written.get(path, _MAX_FOLDER_BYTES) + len(body)
        if _written[path] > _MAX_FOLDER_BYTES >> 5:
            _written[path] = 0
            _delete_oldest_entries(path)


def _delete_oldest_entries(path: Path) -> None:
    """Delete the least recently used entries until the folder is small enough."""
    with os.scandir(path) as entries:
        files = [(entry.stat(follow_symlinks=False), entry.path) for entry in entries]
    size = sum(status.st_size for status, _ in files)
    for status, name in sorted(files, key=lambda entry: entry[0].st_mtime):
        if size <= _MAX_FOLDER_BYTES:
            return
        Path(name).unlink(missing_ok=True)
        size -= status.st_size
