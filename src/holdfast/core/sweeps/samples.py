"""Zarr arrays with the rows of a results folder: one array for each column, one file for each chunk of it."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import StoreError
from holdfast.core.extras import import_extra, require_module
from holdfast.core.files.output import guard_writing
from holdfast.core.sweeps.folder import is_valid_folder_name, shorten
from holdfast.core.typing import Rows

if TYPE_CHECKING:
    import xarray as xr

SAMPLES_FOLDER = "samples.zarr"


@dataclass(frozen=True)
class Column:
    """Quantity with one value per row.

    Attributes:
        name: Name of the variable.
        dtype: NumPy name.
        dims: Names of the further dimensions, with their lengths.
        units: Unit as text, ``1`` if none.
        about: Meaning of the quantity.
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

    def to_stored(self) -> list[Any]:
        """Return the JSON data that :meth:`from_stored` reads."""
        return [self.name, self.dtype, [list(dimension) for dimension in self.dims], self.units, self.about]

    @classmethod
    def from_stored(cls, entry: Any) -> Column:
        """Return the column of ``entry``, a list of ``run.json``; raise TypeError or ValueError if the entry is damaged."""
        name, dtype, dims, units, about = entry
        lengths = tuple((dimension, length) for dimension, length in dims)
        is_text = all(isinstance(x, str) for x in (name, dtype, units, about, *(dimension for dimension, _ in lengths)))
        if not is_text or not all(isinstance(length, int) and length >= 0 for _, length in lengths):
            raise TypeError
        # 'a' (bytes) is an alias for which numpy warns
        if dtype.startswith("a") or np.dtype(dtype).kind not in "fiu" or not is_valid_folder_name(name):
            raise ValueError
        return cls(name, dtype, lengths, units=units, about=about)


class SampleArrays:
    """Zarr group of a results folder.

    Args:
        folder: The results folder.
        columns: Columns of each row.

    Raises:
        HoldfastError: Zarr is not installed.
    """

    def __init__(self, folder: Path, columns: Sequence[Column]) -> None:
        require_module("zarr", "a results folder")
        self.path = folder / SAMPLES_FOLDER
        self._columns = columns
        self._open_arrays: dict[str, Any] = {}  # open for writing

    def create(self, plan: Mapping[str, Any], rows: int, chunk: int) -> None:
        """Create the arrays, with fill values, in place of existing arrays.

        Raises:
            StoreError: Writing failed.
        """
        import zarr

        with guard_writing(self.path.parent):
            group = zarr.open_group(self.path, mode="w")
            group.attrs["plan"] = json.dumps(plan)
            for column in self._columns:
                lengths = [length for _, length in column.dims]
                array = group.create_array(
                    column.name,
                    shape=(rows, *lengths),
                    chunks=(min(chunk, max(rows, 1)), *[max(length, 1) for length in lengths]),
                    dtype=column.dtype,
                    fill_value=column.fill_value,
                    compressors=zarr.codecs.ZstdCodec(checksum=True),
                    dimension_names=["row", *[dimension for dimension, _ in column.dims]],
                )
                array.attrs.update({"units": column.units, "long_name": column.about})

    def write_rows(self, start: int, stop: int, columns: Mapping[str, NDArray[Any]]) -> Rows:
        """Write rows and return them with the types of the arrays.

        Raises:
            OSError: Writing failed.
            StoreError: An array is missing or damaged.
        """
        import zarr

        if not self._open_arrays:
            try:
                group = zarr.open_group(self.path, mode="r+")
                self._open_arrays = {column.name: group[column.name] for column in self._columns}
            except (OSError, KeyError, ValueError) as error:
                raise self.damage_error(error) from error
        for name, values in columns.items():
            self._open_arrays[name][start:stop] = values
        return {name: np.ascontiguousarray(values, self._open_arrays[name].dtype) for name, values in columns.items()}

    def read_rows(self, start: int, stop: int, names: Sequence[str]) -> Rows:
        """Return rows of some columns; zarr raises many kinds of errors for damaged files."""
        import zarr

        group = zarr.open_group(self.path, mode="r")
        columns = {name: np.asarray(group[name][start:stop]) for name in names}
        for column in self._columns:
            values = columns.get(column.name)
            shape = (stop - start, *(length for _, length in column.dims))
            if values is not None and (values.shape != shape or values.dtype != column.dtype):
                raise ValueError(f"'{column.name}' has another shape or type")
        return columns

    def open(self) -> Mapping[str, Any]:
        """Return all rows by column, read when they are sliced; see :meth:`holdfast.core.sweeps.Store.arrays`."""
        import zarr

        try:
            return dict(zarr.open_group(self.path, mode="r").arrays())
        except Exception as error:  # zarr raises many kinds for damaged files
            raise self.damage_error(error) from error

    def open_dataset(self) -> xr.Dataset:
        """Return all rows as a dataset; see :meth:`holdfast.core.sweeps.Store.dataset`."""
        xr = import_extra("xarray", "xarray")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", category=UserWarning)
                data = xr.open_zarr(self.path, consolidated=False, mask_and_scale=False, chunks=None)
        except Exception as error:  # zarr and xarray raise many kinds for damaged files
            raise self.damage_error(error) from error
        return data

    def measure_chunk(self, chunk: int, flush: bool = False) -> int:
        """Return the size of the files of a chunk in bytes, after flushing them to the disk if ``flush``.

        Files that contain only fill values are not written.
        """
        size = 0
        for column in self._columns:
            file = self.path / column.name / "c" / "/".join([str(chunk), *["0"] * len(column.dims)])
            try:
                handle = os.open(file, os.O_RDWR if flush else os.O_RDONLY)
            except FileNotFoundError:
                continue
            try:
                if flush:
                    os.fsync(handle)
                size += os.fstat(handle).st_size
            finally:
                os.close(handle)
        return size

    def damage_error(self, error: Exception) -> StoreError:
        """Return the error for arrays that cannot be opened."""
        return StoreError(f"'{self.path}' is damaged ({describe_error(error)}); start the run again in a new folder")


def describe_error(error: Exception) -> str:
    """Return the text of an error of zarr, shortened to one line."""
    return shorten(" ".join(str(error).split()) or type(error).__name__, 200)
