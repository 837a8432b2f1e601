"""Journals of what is done: lines added to the end, each with its own checksum, so that a commit costs the same at any length.

A line that a crash cut short does not count, and is taken away before the next is added. Studies keep one line for each chunk
in them: later lines of a chunk replace earlier ones, and one with ``-`` says that the chunk is lost. Searches for designs keep
their parts themselves; see :mod:`holdfast.engine.memory`.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from holdfast.engine.folder import SAFE
from holdfast.errors import StoreError
from holdfast.files import reading
from holdfast.files.output import guarded

_LARGEST = 1 << 30  # bytes: ten million lines
_LOST = "-"


class Lines:
    """Lines of bytes in a file, which need not exist yet."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def read(self) -> Iterator[tuple[bytes, bool]]:
        """Every line that was not cut short, and True if its checksum, which is then left out, is that of the line.

        Raises:
            StoreError: The file cannot be read.
        """
        if not reading.exists(self.path):
            return
        with reading.guarded(f"'{self.path}'", kind=StoreError):
            *lines, _ = reading.raw(self.path, _LARGEST).split(b"\n")
        for line in lines:
            text, _, check = line.rpartition(b" ")
            sound = check == b"%08x" % zlib.crc32(text)
            yield (text if sound else line), sound

    def add(self, *texts: bytes) -> None:
        """More lines: on the disk when this returns.

        Raises:
            StoreError: The disk refuses; the file is as it was.
        """
        data = b"".join(text + b" %08x\n" % zlib.crc32(text) for text in texts)
        with guarded(self.path, advice=SAFE):
            handle = os.open(self.path, os.O_CREAT | os.O_RDWR, 0o644)
            try:
                end = _whole(handle)
                try:
                    os.ftruncate(handle, end)
                    os.lseek(handle, end, os.SEEK_SET)
                    rest = memoryview(data)
                    while rest:
                        rest = rest[os.write(handle, rest) :]
                    os.fsync(handle)
                except BaseException:
                    os.ftruncate(handle, end)
                    raise
            finally:
                os.close(handle)


@dataclass(frozen=True, slots=True)
class Entry:
    """A chunk that is done.

    Attributes:
        digest: Checksum of its values.
        size: Bytes of its files.
        seconds: Time it took.
        maker: Number of the machine and versions that made it.
    """

    digest: str
    size: int
    seconds: float
    maker: int


class Journal:
    """The chunks that are done, in a file."""

    def __init__(self, path: Path) -> None:
        self._lines = Lines(path)
        self.path = path

    def read(self) -> dict[int, Entry]:
        """What is done, by number of the chunk; lines that are not sound do not count.

        Raises:
            StoreError: The file cannot be read.
        """
        found: dict[int, Entry] = {}
        for text in (text for text, sound in self._lines.read() if sound):
            try:
                chunk, digest, size, seconds, maker = text.decode().split(" ")
                if digest == _LOST:
                    found.pop(int(chunk), None)
                else:
                    found[int(chunk)] = Entry(digest, int(size), float(seconds), int(maker))
            except ValueError:  # a line of something else
                continue
        return found

    def add(self, chunk: int, entry: Entry) -> None:
        """One more chunk is done: on the disk when this returns.

        Raises:
            StoreError: The disk refuses; the journal is as it was.
        """
        self._lines.add(_text(chunk, entry))

    def drop(self, chunks: Iterable[int]) -> None:
        """These chunks are lost.

        Raises:
            StoreError: The disk refuses; the journal is as it was.
        """
        self._lines.add(*(_text(k, Entry(_LOST, 0, 0.0, 0)) for k in chunks))


def _text(chunk: int, entry: Entry) -> bytes:
    return f"{chunk} {entry.digest} {entry.size} {entry.seconds:.6g} {entry.maker}".encode()


def _whole(handle: int) -> int:
    """Bytes up to the end of the last whole line."""
    size = os.lseek(handle, 0, os.SEEK_END)
    step = 4096
    while size:
        start = max(size - step, 0)
        os.lseek(handle, start, os.SEEK_SET)
        tail = os.read(handle, size - start)
        at = tail.rfind(b"\n")
        if at >= 0:
            return start + at + 1
        size = start
    return 0
