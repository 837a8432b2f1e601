"""Journal of a search, from which a stopped search resumes."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.files.output import guard_writing
from holdfast.core.sweeps.folder import describe_difference, relocate_stored_plan
from holdfast.core.sweeps.journal import ChecksumLines
from holdfast.core.typing import Rows

MEMORY_FILE = "search.journal"
Parts = Rows


class SearchMemory:
    """Parts of a search by name in a journal of JSON lines; the first line identifies the search and each other line holds a
    part.

    A part is on the disk before the search continues. Incomplete or damaged lines do not count. Numbers are restored bit for
    bit, so an interrupted search ends with the same result as an uninterrupted one.
    """

    def __init__(self, folder: str | Path, plan: dict[str, Any]) -> None:
        """Open the memory of a search in a folder, creating it if necessary.

        Args:
            folder: Folder for the results.
            plan: JSON data that defines the search.

        Raises:
            StoreError: The folder contains another search or other files, or cannot be written.
        """
        place = Path(folder)
        self._lines = ChecksumLines(place / MEMORY_FILE)
        self._plan: dict[str, Any] = json.loads(json.dumps(plan))
        self._parts: dict[str, Parts] = {}
        if reading.path_exists(self._lines.path):
            self._read_journal()
            return
        with guard_writing(place):
            occupied = place.exists() and any(place.iterdir())
            place.mkdir(parents=True, exist_ok=True)
        if occupied:
            raise StoreError(f"'{folder}' is not empty and holds no search; give a new or empty folder")
        self._add_journal_line({"search": self._plan})

    def recall_or_compute(self, name: str, make: Callable[[], Parts]) -> Parts:
        """Return arrays by name, from the journal or computed now and stored.

        Raises:
            StoreError: Writing failed; earlier parts are safe.
        """
        if name not in self._parts:
            self.store(name, make())
        return self._parts[name]

    def recall(self, name: str) -> Parts | None:
        """Return arrays by name, or None if they are not stored."""
        return self._parts.get(name)

    def store(self, name: str, arrays: Parts) -> None:
        """Store arrays that were computed elsewhere.

        Raises:
            StoreError: Writing failed; earlier parts are safe.
        """
        self._add_journal_line(
            {"part": name, "arrays": {key: [str(x.dtype), x.shape, x.ravel().tolist()] for key, x in arrays.items()}}
        )
        self._parts[name] = arrays

    def _read_journal(self) -> None:
        try:
            first, *lines = [json.loads(text) for text, sound in self._lines.read_lines() if sound]
            plan = relocate_stored_plan(self._plan, dict(first["search"]))
            for line in lines:
                self._parts[line["part"]] = {
                    key: _make_array(kind, values).reshape(shape) for key, (kind, shape, values) in line["arrays"].items()
                }
        except (ValueError, KeyError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
            raise StoreError(f"'{self._lines.path}' is damaged; remove it and start the search again") from error
        if other := describe_difference(plan, self._plan):
            raise StoreError(f"'{self._lines.path.parent}' holds another search: {other}; give another folder")

    def _add_journal_line(self, line: dict[str, Any]) -> None:
        self._lines.append(json.dumps(line).encode())


def _make_array(kind: str, values: Any) -> NDArray[Any]:
    if not re.fullmatch(r"bool|u?int\d+|float\d+", kind):
        raise ValueError(kind)
    with np.errstate(over="raise"):
        return np.array(values, dtype=kind)
