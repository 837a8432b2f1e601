"""A results folder: chunks of rows in Zarr, each committed as a whole, so that a stopped run can resume.

Knows no robots: rows have named columns. The folder holds ``samples.zarr``, readable with ``xarray.open_zarr``, and
``run.json``, which says what is computed and which chunks are done. A chunk counts only once ``run.json`` names it,
and ``run.json`` is replaced in one step; whatever a crash leaves behind is computed again. A folder of very many chunks,
as those of a study, names them in a journal instead, each with the checksum of its values.
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError, StoreError
from holdfast.core.extras import import_extra
from holdfast.core.files import reading
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import guard_writing, is_occupied, make_folder, replace_file
from holdfast.core.files.sealed import read_sealed
from holdfast.core.sweeps.folder import (
    RESUME_ADVICE,
    describe_difference,
    digest_columns,
    has_too_many_rows,
    is_valid_folder_name,
    lock_folder,
    shorten,
    upgrade_stored_plan,
)
from holdfast.core.sweeps.journal import Journal, JournalEntry

if TYPE_CHECKING:
    import xarray as xr

_FORMAT_NAME = "holdfast-run"
_FORMAT_VERSION = 3  # of what computes the rows: last digits differ from those of 1, before LLVM, and of 2, by C functions
_RUN_FILE = "run.json"
_SAMPLES_FOLDER = "samples.zarr"
_LOCK_FILE = "run.lock"


@dataclass(frozen=True)
class Column:
    """Quantity with one value per row.

    Attributes:
        name: Of the variable.
        dtype: NumPy name.
        dims: Names of the further dimensions, with their lengths.
        units: Text for people, ``1`` if none.
        about: What it is.
    """

    name: str
    dtype: str
    dims: tuple[tuple[str, int], ...] = ()
    _: KW_ONLY
    units: str = "1"
    about: str = ""

    @property
    def fill_value(self) -> Any:
        """Value of rows that are not computed yet: NaN, the largest value of an unsigned type, or -1."""
        kind = np.dtype(self.dtype)
        if kind.kind == "f":
            return np.nan
        return int(np.iinfo(kind).max) if kind.kind == "u" else -1


class Store:
    """Results folder that is open for writing or reading; see :meth:`create` and :meth:`open`."""

    JOURNAL = "done.journal"

    def __init__(self, path: Path, run: dict[str, Any]) -> None:
        self.path = path
        self._run = run
        self._journal = Journal(path / self.JOURNAL) if run.get("journal") else None
        self._entries: dict[int, JournalEntry] | None = None  # of the journal, once it is read
        self._arrays: dict[str, Any] = {}  # open for writing

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(
        cls,
        path: str | Path,
        plan: Mapping[str, Any],
        columns: list[Column],
        *,
        rows: int,
        chunk: int,
        journal: bool = False,
        formerly: Mapping[str, Any] | None = None,
    ) -> Store:
        """Create a folder, or open the existing folder of the same plan to resume it.

        Args:
            path: The folder; its parent must exist or be creatable.
            plan: JSON data that defines the results; two runs with equal plans are the same run.
            columns: What each row holds.
            rows: Number of rows.
            chunk: Rows per chunk.
            journal: Name chunks that are done in a journal, with checksums, instead of in ``run.json``.
            formerly: Entries of the plan as earlier versions wrote them, None for those that they did not have; a folder with
                these is of the same run.

        Raises:
            StoreError: Not writable, not a results folder, or a folder of another plan; the message names the difference.
        """
        folder = Path(path)
        plan = json.loads(json.dumps(plan))
        if reading.path_exists(folder / _RUN_FILE):
            store = cls.open(folder)
            old_plan = upgrade_stored_plan(plan, store.plan, formerly)
            if old_plan != plan or store._run["rows"] != rows or store._run["chunk"] != chunk:
                sizes = f"it has {store.rows} rows in chunks of {store.shape[1]}, asked for are {rows} in chunks of {chunk}"
                raise StoreError(
                    f"'{folder}' holds another run: {describe_difference(old_plan, plan) or sizes}; "
                    "give another folder, or the same options to resume it"
                )
            if not store.is_complete:
                store.check_current()
            if not store.committed_chunks:  # perhaps stopped while it was being made
                store._make_arrays(columns)
            return store
        if reading.path_exists(folder) and not folder.is_dir():
            raise StoreError(f"'{folder}' is a file; give a folder")
        if reading.path_exists(folder) and is_occupied(folder):
            raise StoreError(f"'{folder}' exists, is not empty and is not a holdfast run; give a new or empty folder")
        run = {
            "format": _FORMAT_NAME,
            "version": _FORMAT_VERSION,
            "sealed": True,
            "plan": plan,
            "rows": rows,
            "chunk": chunk,
            "done": [],
            "columns": [
                [column.name, column.dtype, [list(dimension) for dimension in column.dims], column.units, column.about]
                for column in columns
            ],
            "notes": {},
            **({"journal": True} if journal else {}),
        }
        store = cls(folder, run)
        make_folder(folder)
        # First, so that a stop before the arrays are there does not make the folder foreign.
        store._write_run_file("", "choose another folder")
        store._make_arrays(columns)
        return store

    @classmethod
    def open(cls, path: str | Path) -> Store:
        """Open an existing folder.

        Raises:
            StoreError: There is no run, or ``run.json`` is damaged or of another version.
        """
        folder = Path(path)
        file = folder / _RUN_FILE
        if not reading.path_exists(file):
            raise StoreError(f"'{folder}' is not a holdfast run: it has no {_RUN_FILE}; give the folder that --out named")
        try:
            run = read_sealed(file)
        except (OSError, ValueError, InputError) as error:
            raise StoreError(
                f"'{file}' cannot be read ({error}); the run is damaged: start it again in a new folder"
            ) from error
        if not isinstance(run, dict) or run.get("format") != _FORMAT_NAME:
            raise StoreError(f"'{file}' was not written by holdfast; give the folder of a holdfast run")
        if run.get("version") not in range(1, _FORMAT_VERSION + 1):
            raise StoreError(
                f"'{folder}' was written in format {run.get('version')}; this holdfast reads formats up to {_FORMAT_VERSION}"
            )
        invalid_entry = _find_invalid_entry(run)
        if invalid_entry:
            raise StoreError(
                f"'{file}' is damaged: its {invalid_entry} is missing or wrong; start the run again in a new folder"
            )
        return cls(folder, run)

    def check_current(self) -> None:
        """Reject additions to rows that an earlier backend computed.

        Raises:
            StoreError: They are.
        """
        if self._run["version"] != _FORMAT_VERSION:
            raise StoreError(
                f"'{self.path}' was computed by an earlier holdfast, whose results differ in their last digits; it can be "
                "read, but not resumed or merged: start the run again in a new folder"
            )

    @contextmanager
    def lock_for_writing(self) -> Iterator[None]:
        """Lock the folder, so that a second program that tries to write gets an error instead of damaging the run."""
        with lock_folder(self.path, _LOCK_FILE):
            # Another program may have gone on with the run since it was opened.
            self._run = Store.open(self.path)._run
            self._entries = None
            yield

    # ---- what is there ---------------------------------------------------------------------------------------------

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
    def columns(self) -> list[Column]:
        """Columns of each row."""
        return [
            Column(name, dtype, tuple((dimension, length) for dimension, length in dims), units=units, about=about)
            for name, dtype, dims, units, about in self._run["columns"]
        ]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows of the finished run, and of a chunk."""
        return self.rows, int(self._run["chunk"])

    @property
    def rows(self) -> int:
        """Number of rows of the finished run."""
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
        """Return the first row of a chunk and the row after its last."""
        size = int(self._run["chunk"])
        return chunk * size, min((chunk + 1) * size, self.rows)

    @property
    def committed_chunks(self) -> list[int]:
        """Chunks that are committed."""
        return list(self._run["done"]) if self._journal is None else sorted(self.entries)

    @property
    def entries(self) -> dict[int, JournalEntry]:
        """Journal entries of the committed chunks; empty without a journal.

        Raises:
            StoreError: It cannot be read.
        """
        if self._entries is None:
            entries = {} if self._journal is None else self._journal.read_entries()
            self._entries = {chunk: entry for chunk, entry in entries.items() if 0 <= chunk < self.count}
        return self._entries

    @property
    def missing_chunks(self) -> list[int]:
        """Chunks that are not computed yet."""
        done = set(self.committed_chunks)
        return [chunk for chunk in range(self.count) if chunk not in done]

    @property
    def is_complete(self) -> bool:
        """True once every chunk is committed."""
        return not self.missing_chunks

    # ---- rows ------------------------------------------------------------------------------------------------------

    def commit_chunk(self, chunk: int, columns: Mapping[str, NDArray[Any]], seconds: float = 0.0, *, maker: int = 0) -> None:
        """Write all columns of a chunk, then commit it.

        Args:
            chunk: Its number.
            columns: Its values.
            seconds: For the journal: time it took.
            maker: For the journal: number of what made it.

        Raises:
            StoreError: The disk refuses; chunks committed before stay valid.
        """
        import zarr

        start, end = self.chunk_span(chunk)
        try:
            if self._journal is None or not self._arrays:
                group = zarr.open_group(self.path / _SAMPLES_FOLDER, mode="r+")
                self._arrays = {name: group[name] for name in columns}
            arrays = self._arrays
        except (OSError, KeyError, ValueError) as error:
            raise self._damage_error(error) from error
        chunk_text = f"chunk {chunk + 1} to"
        with guard_writing(self.path, chunk_text, RESUME_ADVICE):
            for name, values in columns.items():
                arrays[name][start:end] = values
            if self._journal is None:
                self._run["done"] = sorted({*self.committed_chunks, chunk})
                self._write_run_file(chunk_text)
            else:
                stored = {name: np.ascontiguousarray(values, arrays[name].dtype) for name, values in columns.items()}
                entry = JournalEntry(digest_columns(stored), self._sync_chunk(chunk), seconds, maker)
                self._journal.add(chunk, entry)
                self.entries[chunk] = entry

    def drop_chunks(self, chunks: Sequence[int]) -> None:
        """Mark damaged chunks of a journal as missing.

        Raises:
            StoreError: The disk refuses, or there is no journal.
        """
        if self._journal is None:
            raise StoreError(f"'{self.path}' keeps no journal, so no chunk of it can be dropped; run it in a new folder")
        self._journal.drop(chunks)
        for chunk in chunks:
            self.entries.pop(chunk, None)

    def read_checked(self, chunk: int) -> dict[str, NDArray[Any]]:
        """Return all values of a committed chunk of a journal after comparing their checksum.

        Raises:
            StoreError: They cannot be read, or are not those that were written.
        """
        columns = self.read_chunk(chunk, [name for name, *_ in self._run["columns"]])
        if digest_columns(columns) != self.entries[chunk].digest:
            raise StoreError("its values are not those that were written")
        return columns

    def chunk_size(self, chunk: int) -> int:
        """Bytes of the files of a chunk; files of nothing but fill values are not written."""
        return sum(file.stat().st_size for file in self._chunk_files(chunk) if file.exists())

    def _sync_chunk(self, chunk: int) -> int:
        """Flush the files of a chunk to the disk and return their size in bytes."""
        size = 0
        for file in self._chunk_files(chunk):
            try:
                handle = os.open(file, os.O_RDONLY)
            except FileNotFoundError:
                continue
            try:
                os.fsync(handle)
                size += os.fstat(handle).st_size
            finally:
                os.close(handle)
        return size

    def _chunk_files(self, chunk: int) -> list[Path]:
        return [
            self.path / _SAMPLES_FOLDER / name / "c" / "/".join([str(chunk), *["0"] * len(dims)])
            for name, _, dims, *_ in self._run["columns"]
        ]

    def add_notes(self, **facts: Any) -> None:
        """Add facts about how the run went."""
        self._run["notes"].update(facts)
        self._write_run_file()

    def read_chunk(self, chunk: int, names: Sequence[str]) -> dict[str, NDArray[Any]]:
        """Return columns of one chunk without loading anything else.

        Raises:
            StoreError: An array is missing or damaged.
        """
        import zarr

        start, stop = self.chunk_span(chunk)
        try:
            group = zarr.open_group(self.path / _SAMPLES_FOLDER, mode="r")
            columns = {name: np.asarray(group[name][start:stop]) for name in names}
            for column in self.columns:
                shape = (stop - start, *(n for _, n in column.dims))
                if column.name in columns and (
                    columns[column.name].shape != shape or columns[column.name].dtype != column.dtype
                ):
                    raise ValueError(f"'{column.name}' has another shape or type")
            return columns
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self._damage_error(error) from error

    def arrays(self) -> Mapping[str, Any]:
        """All rows by column, read when they are sliced; rows not computed yet hold fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
        """
        import zarr

        try:
            return dict(zarr.open_group(self.path / _SAMPLES_FOLDER, mode="r").arrays())
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self._damage_error(error) from error

    def dataset(self) -> xr.Dataset:
        """All rows with names, units and attributes, read when they are used; rows not computed yet hold fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
            HoldfastError: xarray is not installed (extra ``xarray``).
        """
        xr = import_extra("xarray", "xarray")

        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", category=UserWarning)
                data = xr.open_zarr(self.path / _SAMPLES_FOLDER, consolidated=False, mask_and_scale=False, chunks=None)
        except Exception as error:  # zarr and xarray raise many kinds for damaged files
            raise self._damage_error(error) from error
        return data

    def _damage_error(self, error: Exception) -> StoreError:
        reason = shorten(" ".join(str(error).split()) or type(error).__name__, 200)
        return StoreError(f"'{self.path / _SAMPLES_FOLDER}' is damaged ({reason}); start the run again in a new folder")

    # ---- files -----------------------------------------------------------------------------------------------------

    def _make_arrays(self, columns: list[Column]) -> None:
        import zarr

        with guard_writing(self.path):
            group = zarr.open_group(self.path / _SAMPLES_FOLDER, mode="w")
            group.attrs["plan"] = json.dumps(self.plan)
            for column in columns:
                lengths = [length for _, length in column.dims]
                array = group.create_array(
                    column.name,
                    shape=(self.rows, *lengths),
                    chunks=(min(int(self._run["chunk"]), max(self.rows, 1)), *[max(length, 1) for length in lengths]),
                    dtype=column.dtype,
                    fill_value=column.fill_value,
                    compressors=zarr.codecs.ZstdCodec(checksum=True),
                    dimension_names=["row", *[dimension for dimension, _ in column.dims]],
                )
                array.attrs.update({"units": column.units, "long_name": column.about})

    def _write_run_file(self, error_subject: str = "", retry_advice: str = RESUME_ADVICE) -> None:
        replace_file(self.path / _RUN_FILE, seal_document(self._run), error_subject, retry_advice)


def _find_invalid_entry(run: Mapping[str, Any]) -> str | None:
    """Return the first entry of run.json that is missing or invalid."""
    for key, kind in (("plan", dict), ("notes", dict), ("rows", int), ("chunk", int), ("done", list), ("columns", list)):
        if not isinstance(run.get(key), kind):
            return key
    if run["rows"] < 0 or run["chunk"] < 1 or has_too_many_rows(run["rows"], run["chunk"]):
        return "rows" if run["rows"] < 0 else "chunk"
    count = -(-run["rows"] // run["chunk"])
    if not all(isinstance(k, int) and 0 <= k < count for k in run["done"]):
        return "done"
    return None if all(_is_column(c) for c in run["columns"]) else "columns"


def _is_column(entry: Any) -> bool:
    try:
        name, dtype, dims, units, about = entry
        lengths = [(d, n) for d, n in dims]
    except (TypeError, ValueError):
        return False
    texts = (name, dtype, units, about, *(d for d, _ in lengths))
    if not all(isinstance(x, str) for x in texts) or not all(isinstance(n, int) and n >= 0 for _, n in lengths):
        return False
    return _is_numeric_type(dtype) and is_valid_folder_name(name)


def _is_numeric_type(dtype: str) -> bool:
    try:
        return not dtype.startswith("a") and np.dtype(dtype).kind in "fiu"  # 'a', bytes, is an alias that numpy warns of
    except (TypeError, ValueError):
        return False
