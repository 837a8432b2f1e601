"""Results folder: chunks of rows in Zarr, each committed as a whole, so that a stopped run can resume.

Rows have named columns; this module contains nothing about robots. The folder contains ``samples.zarr``, which
``xarray.open_zarr`` reads, ``run.json``, which defines the rows, and a journal of the committed chunks with the checksum of
the values of each. A chunk counts only if the journal contains it, so the next run recomputes a chunk that a crash cut short.
"""

from __future__ import annotations

import itertools
import json
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import guard_writing, is_occupied, make_folder, replace_file
from holdfast.core.sweeps.folder import (
    RESUME_ADVICE,
    describe_difference,
    digest_columns,
    has_too_many_rows,
    lock_folder,
    own_study_folder,
    read_run_file,
    relocate_stored_plan,
)
from holdfast.core.sweeps.job import DamagedChunk
from holdfast.core.sweeps.journal import Journal, JournalEntry
from holdfast.core.sweeps.samples import Column, SampleArrays, describe_error
from holdfast.core.typing import Rows

if TYPE_CHECKING:
    import xarray as xr

_FORMAT_NAME = "holdfast-run"
FORMAT_VERSION = 4
RUN_FILE = "run.json"
_LOCK_FILE = "run.lock"


class Store:
    """Results folder ``path`` with the content ``run`` of its run.json; see :meth:`create` and :meth:`open`."""

    JOURNAL = "done.journal"

    def __init__(self, path: Path, run: dict[str, Any]) -> None:
        self.path = path
        self.columns = [Column.from_stored(entry) for entry in run["columns"]]
        self._run = run
        self._journal = Journal(path / self.JOURNAL)
        self._entries: dict[int, JournalEntry] | None = None  # of the journal, once it is read
        self._samples = SampleArrays(path, self.columns)

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(cls, path: str | Path, plan: Mapping[str, Any], columns: list[Column], *, rows: int, chunk: int) -> Store:
        """Create a folder, or open the existing folder of the same plan to resume it.

        Args:
            path: The folder; its parent must exist or be creatable.
            plan: JSON data that defines the results; two runs with equal plans are the same run.
            columns: Columns of each row.
            rows: Number of rows.
            chunk: Number of rows in a chunk.

        Raises:
            StoreError: The folder is not writable, no results folder, or of another plan; the message states the difference.
        """
        folder = Path(path)
        plan = json.loads(json.dumps(plan))
        if reading.path_exists(folder / RUN_FILE):
            store = cls.open(folder)
            old_plan = relocate_stored_plan(plan, store.plan)
            if old_plan != plan or store._run["rows"] != rows or store._run["chunk"] != chunk:
                sizes = f"it has {store.rows} rows in chunks of {store.shape[1]}, but {rows} in chunks of {chunk} were wanted"
                raise StoreError(
                    f"'{folder}' holds another run: {describe_difference(old_plan, plan) or sizes}; "
                    "give another folder, or the same options to resume it"
                )
            if not store.committed_chunks:  # perhaps stopped during creation
                store._samples.create(plan, rows, chunk)
            return store
        if reading.path_exists(folder) and not folder.is_dir():
            raise StoreError(f"'{folder}' is a file; give a folder")
        if reading.path_exists(folder) and is_occupied(folder):
            raise StoreError(f"'{folder}' exists, is not empty and is not a holdfast run; give a new or empty folder")
        run = {
            "format": _FORMAT_NAME,
            "version": FORMAT_VERSION,
            "plan": plan,
            "rows": rows,
            "chunk": chunk,
            "columns": [column.to_stored() for column in columns],
            "notes": {},
        }
        store = cls(folder, run)
        make_folder(folder)
        # Written first, so that a run that stops before the arrays exist still leaves a folder that can be resumed.
        store._write_run_file("choose another folder")
        store._samples.create(plan, rows, chunk)
        return store

    @classmethod
    def open(cls, path: str | Path) -> Store:
        """Open the existing results folder ``path``.

        Raises:
            StoreError: There is no run, or ``run.json`` is damaged or of another version.
        """
        folder = Path(path)
        file = folder / RUN_FILE
        if not reading.path_exists(file):
            raise StoreError(f"'{folder}' is not a holdfast run: it has no {RUN_FILE}; give the folder that --out named")
        advice = "start the run again in a new folder"
        run = read_run_file(file, _FORMAT_NAME, FORMAT_VERSION, kind="a holdfast run", advice=advice)
        invalid_entry = _find_invalid_entry(run)
        if invalid_entry:
            raise StoreError(f"'{file}' is damaged: its {invalid_entry} is missing or wrong; {advice}")
        return cls(folder, run)

    @contextmanager
    def lock_for_writing(self) -> Iterator[None]:
        """Lock the folder, so that a second program that tries to write gets an error instead of damaging the run.

        Chunks with lost or incomplete files count as missing from then on.
        """
        with lock_folder(self.path, _LOCK_FILE):
            # Another program may have continued the run since it was opened.
            self._run = Store.open(self.path)._run
            self._entries = None
            self.drop_incomplete_chunks()
            yield

    # ---- content ---------------------------------------------------------------------------------------------

    @property
    def plan(self) -> dict[str, Any]:
        """Plan of the computation."""
        plan: dict[str, Any] = self._run["plan"]
        return plan

    @property
    def notes(self) -> dict[str, Any]:
        """Facts about the computation (versions, times) that do not define its result."""
        notes: dict[str, Any] = self._run["notes"]
        return notes

    @property
    def shape(self) -> tuple[int, int]:
        """Total number of rows, and number of rows in a chunk."""
        return self.rows, int(self._run["chunk"])

    @property
    def rows(self) -> int:
        """Total number of rows."""
        return int(self._run["rows"])

    @property
    def chunks(self) -> list[tuple[int, int]]:
        """First row and row after the last of every chunk."""
        return [self.chunk_span(k) for k in range(self.count)]

    @property
    def count(self) -> int:
        """Number of chunks."""
        return -(-self.rows // int(self._run["chunk"]))

    def chunk_span(self, chunk: int) -> tuple[int, int]:
        """Return the first row of chunk number ``chunk`` (from 0) and the row after its last."""
        size = int(self._run["chunk"])
        return chunk * size, min((chunk + 1) * size, self.rows)

    @property
    def committed_chunks(self) -> list[int]:
        """Numbers of the committed chunks."""
        return sorted(self.entries)

    @property
    def entries(self) -> dict[int, JournalEntry]:
        """Journal entries of the committed chunks.

        Raises:
            StoreError: The journal cannot be read.
        """
        if self._entries is None:
            entries = self._journal.read_entries()
            self._entries = {chunk: entry for chunk, entry in entries.items() if 0 <= chunk < self.count}
        return self._entries

    @property
    def missing_chunks(self) -> list[int]:
        """Numbers of the chunks that are not computed yet."""
        return [chunk for chunk in range(self.count) if chunk not in self.entries]

    @property
    def is_complete(self) -> bool:
        """True if every chunk is committed."""
        return not self.missing_chunks

    # ---- rows ------------------------------------------------------------------------------------------------------

    def commit_chunk(self, chunk: int, columns: Mapping[str, NDArray[Any]], seconds: float = 0.0, *, maker: int = 0) -> None:
        """Write all columns of a chunk, then commit it.

        Args:
            chunk: Number of the chunk, from 0.
            columns: Values by column.
            seconds: Computation time, s.
            maker: Number of the machine and versions that computed the chunk.

        Raises:
            StoreError: Writing failed; chunks committed before stay valid.
        """
        with guard_writing(self.path, f"chunk {chunk + 1} to", RESUME_ADVICE):
            stored = self._samples.write_rows(*self.chunk_span(chunk), columns)
            entry = JournalEntry(digest_columns(stored), self._samples.measure_chunk(chunk, flush=True), seconds, maker)
            self._journal.add(chunk, entry)
            self.entries[chunk] = entry

    def commit_missing(
        self,
        compute: Callable[[list[int]], Iterable[tuple[int, Mapping[str, NDArray[Any]]]]],
        progress: Callable[[int, int], None] | None = None,
    ) -> None:
        """Compute the missing chunks and commit each as it finishes; the folder must be locked.

        Args:
            compute: Called with the numbers of the missing chunks; yields each number with its columns.
            progress: Called with the number of rows done and the total number of rows.

        Raises:
            StoreError: See :meth:`commit_chunk`.
        """
        missing = self.missing_chunks
        finished, begin = self.rows - sum(stop - start for start, stop in map(self.chunk_span, missing)), time.monotonic()
        if progress is not None:
            progress(finished, self.rows)
        for chunk, columns in compute(missing):
            start, stop = self.chunk_span(chunk)
            self.commit_chunk(chunk, columns, time.monotonic() - begin)
            finished, begin = finished + stop - start, time.monotonic()
            if progress is not None:
                progress(finished, self.rows)

    def drop_chunks(self, chunks: Sequence[int]) -> None:
        """Mark the damaged chunks with the numbers ``chunks`` (from 0) as missing.

        Raises:
            StoreError: Writing failed.
        """
        self._journal.drop(chunks)
        for chunk in chunks:
            self.entries.pop(chunk, None)

    def drop_damaged_chunks(self, cell: str | None = None, report: Callable[[], None] = lambda: None) -> list[DamagedChunk]:
        """Read every committed chunk, and mark the damaged chunks as missing; the folder must be locked.

        Args:
            cell: Name of the cell, for the result.
            report: Called after every chunk.

        Raises:
            StoreError: Writing failed.
        """
        damaged = []
        for chunk in self.committed_chunks:
            try:
                self._read_sound(chunk)
            except StoreError as error:
                damaged.append(DamagedChunk(cell, chunk, str(error)))
            report()
        if damaged:
            self.drop_chunks([entry.chunk for entry in damaged if entry.chunk is not None])
        return damaged

    def verify(self, progress: Callable[[int, int, float | None], None] | None = None) -> list[DamagedChunk]:
        """Compare all checksums and mark damaged chunks as missing; ``progress`` is called with (chunks read, total, None).

        Raises:
            StoreError: Another program is working in the folder, it is not writable, or it belongs to a study.
        """
        if study := own_study_folder(self.path):
            raise StoreError(f"'{self.path}' is a cell of a study; give the folder of the study, '{study}'")
        with lock_folder(self.path, _LOCK_FILE):
            total, position = len(self.entries), itertools.count(1)
            return self.drop_damaged_chunks(report=lambda: None if progress is None else progress(next(position), total, None))

    def drop_incomplete_chunks(self) -> None:
        """Mark chunks as missing whose files are lost or do not have the size that the journal states.

        Raises:
            StoreError: Writing failed.
        """
        incomplete = [number for number, entry in self.entries.items() if self._samples.measure_chunk(number) != entry.size]
        if incomplete:
            self.drop_chunks(incomplete)

    def read_checked(self, chunk: int) -> Rows:
        """Return all values of the committed chunk number ``chunk`` (from 0) after comparing their checksum.

        Raises:
            StoreError: The values cannot be read, or differ from those that were written.
        """
        try:
            return self._read_sound(chunk)
        except StoreError as error:
            folder = own_study_folder(self.path) or self.path
            advice = f"give 'holdfast study verify {folder}', then the same run again"
            raise StoreError(f"chunk {chunk + 1} of '{self.path}' is damaged ({error}); {advice}") from error

    def _read_sound(self, chunk: int) -> Rows:
        try:
            columns = self._samples.read_rows(*self.chunk_span(chunk), [column.name for column in self.columns])
        except Exception as error:  # zarr raises many kinds for damaged files
            raise StoreError(describe_error(error)) from error
        if digest_columns(columns) != self.entries[chunk].digest:
            raise StoreError("its values differ from those that were written")
        return columns

    def read_all_checked(self) -> Iterator[Rows]:
        """Yield the values of every committed chunk after comparing their checksum.

        Raises:
            StoreError: See :meth:`read_checked`.
        """
        yield from map(self.read_checked, self.committed_chunks)

    def add_notes(self, **facts: Any) -> None:
        """Add ``facts`` about how the run went, by name, to :attr:`notes`."""
        self._run["notes"].update(facts)
        self._write_run_file()

    def read_chunk(self, chunk: int, names: Sequence[str]) -> Rows:
        """Return the columns ``names`` of chunk number ``chunk`` (from 0) without loading other columns.

        Raises:
            StoreError: An array is missing or damaged.
        """
        try:
            return self._samples.read_rows(*self.chunk_span(chunk), names)
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self._samples.damage_error(error) from error

    def arrays(self) -> Mapping[str, Any]:
        """Return all rows by column, read when they are sliced; rows not computed yet contain fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
        """
        return self._samples.open()

    def dataset(self) -> xr.Dataset:
        """Return all rows with names, units and attributes, read when they are used; rows not computed yet contain fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
            HoldfastError: xarray is not installed (extra ``xarray``).
        """
        return self._samples.open_dataset()

    def _write_run_file(self, retry_advice: str = RESUME_ADVICE) -> None:
        replace_file(self.path / RUN_FILE, seal_document(self._run), advice=retry_advice)


def _find_invalid_entry(run: Mapping[str, Any]) -> str | None:
    """Return the first entry of run.json that is missing or invalid."""
    for key, kind in (("plan", dict), ("notes", dict), ("rows", int), ("chunk", int), ("columns", list)):
        if not isinstance(run.get(key), kind):
            return key
    if run["rows"] < 0 or run["chunk"] < 1 or has_too_many_rows(run["rows"], run["chunk"]):
        return "rows" if run["rows"] < 0 else "chunk"
    try:
        list(map(Column.from_stored, run["columns"]))
    except (TypeError, ValueError):
        return "columns"
    return None
