"""Journal of finished chunks: appended lines with their own checksums, so that a commit takes the same time at any length.

A line that a crash cut short does not count and is removed before the next line is added. Results folders keep one line for
each chunk: a later line of a chunk replaces an earlier one, and a line with ``-`` states that the chunk is lost. Searches keep
the values themselves in the lines; see :mod:`holdfast.core.sweeps.memory`.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.files.output import guard_writing
from holdfast.core.sweeps.folder import RESUME_ADVICE

_LARGEST_FILE_BYTES = 1 << 30  # bytes: ten million lines
_LOST_MARK = "-"


class ChecksumLines:
    """Lines of bytes with checksums in a file, which need not exist yet."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def read_lines(self) -> Iterator[tuple[bytes, bool]]:
        """Yield every complete line without its checksum, and whether the checksum matches.

        Raises:
            StoreError: The file cannot be read.
        """
        if not reading.path_exists(self.path):
            return
        with reading.guard_reading(f"'{self.path}'", error_type=StoreError):
            *lines, _ = reading.read_bytes(self.path, _LARGEST_FILE_BYTES).split(b"\n")
        for line in lines:
            text, _, check = line.rpartition(b" ")
            is_sound = check == b"%08x" % zlib.crc32(text)
            yield (text if is_sound else line), is_sound

    def append(self, *texts: bytes) -> None:
        """Append lines, which are on the disk when this method returns.

        Raises:
            StoreError: Writing failed; the file is unchanged.
        """
        data = b"".join(text + b" %08x\n" % zlib.crc32(text) for text in texts)
        with guard_writing(self.path, advice=RESUME_ADVICE):
            handle = os.open(self.path, os.O_CREAT | os.O_RDWR | getattr(os, "O_BINARY", 0), 0o644)
            try:
                end = _complete_lines_size(handle)
                try:
                    os.ftruncate(handle, end)
                    os.lseek(handle, end, os.SEEK_SET)
                    unwritten = memoryview(data)
                    while unwritten:
                        unwritten = unwritten[os.write(handle, unwritten) :]
                    os.fsync(handle)
                except OSError:  # after Ctrl-C a complete line counts, and the next call removes an incomplete one
                    os.ftruncate(handle, end)
                    raise
            finally:
                os.close(handle)


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """Journal entry of a finished chunk.

    Attributes:
        digest: Checksum of the values.
        size: Size of the files, bytes.
        seconds: Computation time, s.
        maker: Number of the machine and versions that computed the chunk.
    """

    digest: str
    size: int
    seconds: float
    maker: int


class Journal:
    """File with the finished chunks."""

    def __init__(self, path: Path) -> None:
        self._lines = ChecksumLines(path)
        self.path = path

    def read_entries(self) -> dict[int, JournalEntry]:
        """Read the finished chunks by number; damaged lines do not count.

        Raises:
            StoreError: The file cannot be read.
        """
        entries: dict[int, JournalEntry] = {}
        for text in (text for text, sound in self._lines.read_lines() if sound):
            try:
                chunk, digest, size, seconds, maker = text.decode().split(" ")
                if digest == _LOST_MARK:
                    entries.pop(int(chunk), None)
                else:
                    entries[int(chunk)] = JournalEntry(digest, int(size), float(seconds), int(maker))
            except ValueError:  # a line of another kind
                continue
        return entries

    def add(self, chunk: int, entry: JournalEntry) -> None:
        """Append a finished chunk, which is on the disk when this method returns.

        Raises:
            StoreError: Writing failed; the journal is unchanged.
        """
        self._lines.append(_entry_line(chunk, entry))

    def drop(self, chunks: Iterable[int]) -> None:
        """Mark chunks as lost.

        Raises:
            StoreError: Writing failed; the journal is unchanged.
        """
        self._lines.append(*(_entry_line(chunk, JournalEntry(_LOST_MARK, 0, 0.0, 0)) for chunk in chunks))


def _entry_line(chunk: int, entry: JournalEntry) -> bytes:
    return f"{chunk} {entry.digest} {entry.size} {entry.seconds:.6g} {entry.maker}".encode()


def _complete_lines_size(handle: int) -> int:
    """Return the number of bytes up to the end of the last complete line."""
    size = os.lseek(handle, 0, os.SEEK_END)
    step = 4096
    while size:
        start = max(size - step, 0)
        os.lseek(handle, start, os.SEEK_SET)
        tail = os.read(handle, size - start)
        line_end = tail.rfind(b"\n")
        if line_end >= 0:
            return start + line_end + 1
        size = start
    return 0
