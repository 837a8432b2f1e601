"""A journal of what is done: one line per chunk, added to the end, so that a commit costs the same at any length.

A line ends with its own checksum. A line that a crash cut short does not count, and is taken away before the next is
added; later lines of a chunk replace earlier ones, and one with ``-`` says that the chunk is lost.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from holdfast.files import reading

_LARGEST = 1 << 30  # bytes: ten million lines
_LOST = "-"


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
    """The journal in a file, which need not exist yet."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def read(self) -> dict[int, Entry]:
        """What is done, by number of the chunk; lines that are not whole do not count.

        Raises:
            OSError: The file cannot be read.
        """
        try:
            lines = reading.raw(self.path, _LARGEST).split(b"\n")
        except FileNotFoundError:
            return {}
        found: dict[int, Entry] = {}
        crc = zlib.crc32
        for line in lines:
            text, _, check = line.rpartition(b" ")
            try:
                if int(check, 16) != crc(text):
                    continue
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
            OSError: The disk refuses; the journal is as it was.
        """
        self._append(line(chunk, entry))

    def drop(self, chunks: Iterable[int]) -> None:
        """These chunks are lost.

        Raises:
            OSError: The disk refuses; the journal is as it was.
        """
        self._append(b"".join(line(k, Entry(_LOST, 0, 0.0, 0)) for k in chunks))

    def _append(self, data: bytes) -> None:
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


def line(chunk: int, entry: Entry) -> bytes:
    """What stands in the file for a chunk."""
    text = f"{chunk} {entry.digest} {entry.size} {entry.seconds:.6g} {entry.maker}".encode()
    return text + b" %08x\n" % zlib.crc32(text)
