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

from holdfast.engine.folder import SAFE, difference, digest, held, is_plain, shortened, taken_for, too_many
from holdfast.engine.journal import Entry, Journal
from holdfast.errors import InputError, StoreError
from holdfast.files import reading
from holdfast.files.digest import seal_document
from holdfast.files.output import guarded, made, occupied, replaced
from holdfast.files.sealed import read_sealed

if TYPE_CHECKING:
    import xarray as xr

_FORMAT = "holdfast-run"
_VERSION = 3  # of what computes the rows: last digits differ from those of 1, before LLVM, and of 2, by C functions
_RUN = "run.json"
_SAMPLES = "samples.zarr"
_LOCK = "run.lock"


@dataclass(frozen=True)
class Column:
    """One quantity per row.

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
    def fill(self) -> Any:
        """Value of rows not computed yet: NaN, or the largest value of an unsigned type, or -1."""
        kind = np.dtype(self.dtype)
        if kind.kind == "f":
            return np.nan
        return int(np.iinfo(kind).max) if kind.kind == "u" else -1


class Store:
    """A results folder opened for writing or reading; see :meth:`create`, :meth:`open`."""

    JOURNAL = "done.journal"

    def __init__(self, path: Path, run: dict[str, Any]) -> None:
        self.path = path
        self._run = run
        self._journal = Journal(path / self.JOURNAL) if run.get("journal") else None
        self._entries: dict[int, Entry] | None = None  # of the journal, once it is read
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
        """A new folder, or the existing one if it belongs to the same plan, ready to resume.

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
        if reading.exists(folder / _RUN):
            store = cls.open(folder)
            old = taken_for(plan, store.plan, formerly)
            if old != plan or store._run["rows"] != rows or store._run["chunk"] != chunk:
                sizes = f"it has {store.rows} rows in chunks of {store.shape[1]}, asked for are {rows} in chunks of {chunk}"
                raise StoreError(
                    f"'{folder}' holds another run: {difference(old, plan) or sizes}; "
                    "give another folder, or the same options to resume it"
                )
            if not store.complete:
                store.check_current()
            if not store.done:  # perhaps stopped while it was being made
                store._make_arrays(columns)
            return store
        if reading.exists(folder) and not folder.is_dir():
            raise StoreError(f"'{folder}' is a file; give a folder")
        if reading.exists(folder) and occupied(folder):
            raise StoreError(f"'{folder}' exists, is not empty and is not a holdfast run; give a new or empty folder")
        run = {
            "format": _FORMAT,
            "version": _VERSION,
            "sealed": True,
            "plan": plan,
            "rows": rows,
            "chunk": chunk,
            "done": [],
            "columns": [[c.name, c.dtype, [list(d) for d in c.dims], c.units, c.about] for c in columns],
            "notes": {},
            **({"journal": True} if journal else {}),
        }
        store = cls(folder, run)
        made(folder)
        # First, so that a stop before the arrays are there does not make the folder foreign.
        store._commit("", "choose another folder")
        store._make_arrays(columns)
        return store

    @classmethod
    def open(cls, path: str | Path) -> Store:
        """An existing folder.

        Raises:
            StoreError: There is no run, or ``run.json`` is damaged or of another version.
        """
        folder = Path(path)
        file = folder / _RUN
        if not reading.exists(file):
            raise StoreError(f"'{folder}' is not a holdfast run: it has no {_RUN}; give the folder that --out named")
        try:
            run = read_sealed(file)
        except (OSError, ValueError, InputError) as error:
            raise StoreError(
                f"'{file}' cannot be read ({error}); the run is damaged: start it again in a new folder"
            ) from error
        if not isinstance(run, dict) or run.get("format") != _FORMAT:
            raise StoreError(f"'{file}' was not written by holdfast; give the folder of a holdfast run")
        if run.get("version") not in range(1, _VERSION + 1):
            raise StoreError(
                f"'{folder}' was written in format {run.get('version')}; this holdfast reads formats up to {_VERSION}"
            )
        wrong = _wrong(run)
        if wrong:
            raise StoreError(f"'{file}' is damaged: its {wrong} is missing or wrong; start the run again in a new folder")
        return cls(folder, run)

    def check_current(self) -> None:
        """Refuse to add to rows that an earlier backend computed.

        Raises:
            StoreError: They are.
        """
        if self._run["version"] != _VERSION:
            raise StoreError(
                f"'{self.path}' was computed by an earlier holdfast, whose results differ in their last digits; it can be "
                "read, but not resumed or merged: start the run again in a new folder"
            )

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Hold the folder: a second program that tries is told so instead of spoiling the run."""
        with held(self.path, _LOCK):
            # Another program may have gone on with the run since it was opened.
            self._run = Store.open(self.path)._run
            self._entries = None
            yield

    # ---- what is there ---------------------------------------------------------------------------------------------

    @property
    def plan(self) -> dict[str, Any]:
        """What is computed."""
        plan: dict[str, Any] = self._run["plan"]
        return plan

    @property
    def notes(self) -> dict[str, Any]:
        """Facts about how it was computed (versions, times); they do not define the run."""
        notes: dict[str, Any] = self._run["notes"]
        return notes

    @property
    def columns(self) -> list[Column]:
        """What each row holds."""
        return [
            Column(name, dtype, tuple((d, n) for d, n in dims), units=units, about=about)
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
        return [self.span(k) for k in range(self.count)]

    @property
    def count(self) -> int:
        """Number of chunks."""
        return -(-self.rows // int(self._run["chunk"]))

    def span(self, chunk: int) -> tuple[int, int]:
        """First row and row after the last of a chunk."""
        size = int(self._run["chunk"])
        return chunk * size, min((chunk + 1) * size, self.rows)

    @property
    def done(self) -> list[int]:
        """Chunks that are committed."""
        return list(self._run["done"]) if self._journal is None else sorted(self.entries)

    @property
    def entries(self) -> dict[int, Entry]:
        """What the journal says of the chunks that are committed; empty without one.

        Raises:
            StoreError: It cannot be read.
        """
        if self._entries is None:
            found = {} if self._journal is None else self._journal.read()
            self._entries = {k: e for k, e in found.items() if 0 <= k < self.count}
        return self._entries

    @property
    def missing(self) -> list[int]:
        """Chunks still to compute."""
        done = set(self.done)
        return [k for k in range(self.count) if k not in done]

    @property
    def complete(self) -> bool:
        """True once every chunk is committed."""
        return not self.missing

    # ---- rows ------------------------------------------------------------------------------------------------------

    def write(self, chunk: int, columns: Mapping[str, NDArray[Any]], seconds: float = 0.0, *, maker: int = 0) -> None:
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

        start, stop = self.span(chunk)
        try:
            if self._journal is None or not self._arrays:
                group = zarr.open_group(self.path / _SAMPLES, mode="r+")
                self._arrays = {name: group[name] for name in columns}
            arrays = self._arrays
        except (OSError, KeyError, ValueError) as error:
            raise self._damaged(error) from error
        what = f"chunk {chunk + 1} to"
        with guarded(self.path, what, SAFE):
            for name, values in columns.items():
                arrays[name][start:stop] = values
            if self._journal is None:
                self._run["done"] = sorted({*self.done, chunk})
                self._commit(what)
            else:
                stored = {name: np.ascontiguousarray(values, arrays[name].dtype) for name, values in columns.items()}
                entry = Entry(digest(stored), self._settled(chunk), seconds, maker)
                self._journal.add(chunk, entry)
                self.entries[chunk] = entry

    def drop(self, chunks: Sequence[int]) -> None:
        """Chunks of a journal that are damaged: they are missing from now on.

        Raises:
            StoreError: The disk refuses, or there is no journal.
        """
        if self._journal is None:
            raise StoreError(f"'{self.path}' keeps no journal, so no chunk of it can be dropped; run it in a new folder")
        self._journal.drop(chunks)
        for k in chunks:
            self.entries.pop(k, None)

    def checked(self, chunk: int) -> dict[str, NDArray[Any]]:
        """All values of a committed chunk of a journal, compared with their checksum.

        Raises:
            StoreError: They cannot be read, or are not those that were written.
        """
        found = self.read(chunk, [name for name, *_ in self._run["columns"]])
        if digest(found) != self.entries[chunk].digest:
            raise StoreError("its values are not those that were written")
        return found

    def size(self, chunk: int) -> int:
        """Bytes of the files of a chunk; files of nothing but fill values are not written."""
        return sum(f.stat().st_size for f in self._files(chunk) if f.exists())

    def _settled(self, chunk: int) -> int:
        """Bytes of the files of a chunk, which are on the disk when this returns."""
        size = 0
        for file in self._files(chunk):
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

    def _files(self, chunk: int) -> list[Path]:
        return [
            self.path / _SAMPLES / name / "c" / "/".join([str(chunk), *["0"] * len(dims)])
            for name, _, dims, *_ in self._run["columns"]
        ]

    def note(self, **facts: Any) -> None:
        """Add facts about how the run went."""
        self._run["notes"].update(facts)
        self._commit()

    def read(self, chunk: int, names: Sequence[str]) -> dict[str, NDArray[Any]]:
        """Columns of one chunk, and nothing else in memory.

        Raises:
            StoreError: An array is missing or damaged.
        """
        import zarr

        start, stop = self.span(chunk)
        try:
            group = zarr.open_group(self.path / _SAMPLES, mode="r")
            found = {name: np.asarray(group[name][start:stop]) for name in names}
            for c in self.columns:
                shape = (stop - start, *(n for _, n in c.dims))
                if c.name in found and (found[c.name].shape != shape or found[c.name].dtype != c.dtype):
                    raise ValueError(f"'{c.name}' has another shape or type")
            return found
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self._damaged(error) from error

    def arrays(self) -> Mapping[str, Any]:
        """All rows by column, read when they are sliced; rows not computed yet hold fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
        """
        import zarr

        try:
            return dict(zarr.open_group(self.path / _SAMPLES, mode="r").arrays())
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self._damaged(error) from error

    def dataset(self) -> xr.Dataset:
        """All rows with names, units and attributes, read when they are used; rows not computed yet hold fill values.

        Raises:
            StoreError: The arrays are missing or damaged.
        """
        import xarray as xr

        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", category=UserWarning)
                data: xr.Dataset = xr.open_zarr(self.path / _SAMPLES, consolidated=False, mask_and_scale=False, chunks=None)
        except Exception as error:  # zarr and xarray raise many kinds for damaged files
            raise self._damaged(error) from error
        return data

    def _damaged(self, error: Exception) -> StoreError:
        reason = shortened(" ".join(str(error).split()) or type(error).__name__, 200)
        return StoreError(f"'{self.path / _SAMPLES}' is damaged ({reason}); start the run again in a new folder")

    # ---- files -----------------------------------------------------------------------------------------------------

    def _make_arrays(self, columns: list[Column]) -> None:
        import zarr

        with guarded(self.path):
            group = zarr.open_group(self.path / _SAMPLES, mode="w")
            group.attrs["plan"] = json.dumps(self.plan)
            for c in columns:
                lengths = [n for _, n in c.dims]
                array = group.create_array(
                    c.name,
                    shape=(self.rows, *lengths),
                    chunks=(min(int(self._run["chunk"]), max(self.rows, 1)), *[max(n, 1) for n in lengths]),
                    dtype=c.dtype,
                    fill_value=c.fill,
                    compressors=zarr.codecs.ZstdCodec(checksum=True),
                    dimension_names=["row", *[d for d, _ in c.dims]],
                )
                array.attrs.update({"units": c.units, "long_name": c.about})

    def _commit(self, what: str = "", advice: str = SAFE) -> None:
        replaced(self.path / _RUN, seal_document(self._run), what, advice)


def _wrong(run: Mapping[str, Any]) -> str | None:
    """The first entry of run.json that is missing or cannot be."""
    for key, kind in (("plan", dict), ("notes", dict), ("rows", int), ("chunk", int), ("done", list), ("columns", list)):
        if not isinstance(run.get(key), kind):
            return key
    if run["rows"] < 0 or run["chunk"] < 1 or too_many(run["rows"], run["chunk"]):
        return "rows" if run["rows"] < 0 else "chunk"
    count = -(-run["rows"] // run["chunk"])
    if not all(isinstance(k, int) and 0 <= k < count for k in run["done"]):
        return "done"
    return None if all(_is_column(c) for c in run["columns"]) else "columns"


def _is_column(given: Any) -> bool:
    try:
        name, dtype, dims, units, about = given
        lengths = [(d, n) for d, n in dims]
    except (TypeError, ValueError):
        return False
    texts = (name, dtype, units, about, *(d for d, _ in lengths))
    if not all(isinstance(x, str) for x in texts) or not all(isinstance(n, int) and n >= 0 for _, n in lengths):
        return False
    return _is_number(dtype) and is_plain(name)


def _is_number(dtype: str) -> bool:
    try:
        return not dtype.startswith("a") and np.dtype(dtype).kind in "fiu"  # 'a', bytes, is an alias that numpy warns of
    except (TypeError, ValueError):
        return False
