"""What a search has done already, in a file, so that one that was stopped is resumed where it was."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.engine.folder import difference, taken_for
from holdfast.engine.journal import Lines
from holdfast.errors import StoreError
from holdfast.files import reading
from holdfast.files.output import guarded

FILE = "search.journal"
BEFORE = "search.jsonl"  # of holdfast 0.1, whose lines have no checksums; it is resumed in the same file
Parts = dict[str, NDArray[Any]]


class Memory:
    """Parts of a search by name, in a journal of JSON lines: the first says which search it is, each other holds a part.

    A part is on the disk before the search continues; lines that are cut short or not sound do not count. Numbers come back
    with the same bits, so a search that was stopped ends with the same result as one that was not.
    """

    def __init__(self, folder: str | Path, plan: dict[str, Any], formerly: Mapping[str, Any] | None = None) -> None:
        """The memory of a search in a folder, made if need be.

        Args:
            folder: Where results are kept.
            plan: JSON data that defines the search.
            formerly: Entries of it as earlier versions wrote them; see :meth:`holdfast.engine.Store.create`.

        Raises:
            StoreError: The folder holds another search or something else, or cannot be written.
        """
        place = Path(folder)
        self._before = reading.exists(place / BEFORE)
        self._lines = Lines(place / (BEFORE if self._before else FILE))
        self._plan: dict[str, Any] = json.loads(json.dumps(plan))
        self._parts: dict[str, Parts] = {}
        if reading.exists(self._lines.path):
            self._read(formerly)
            return
        with guarded(place):
            occupied = place.exists() and any(place.iterdir())
            place.mkdir(parents=True, exist_ok=True)
        if occupied:
            raise StoreError(f"'{folder}' is not empty and holds no search; give a new or empty folder")
        self._add({"search": self._plan})

    def part(self, name: str, make: Callable[[], Parts]) -> Parts:
        """Arrays by name: remembered, or made now and remembered.

        Raises:
            StoreError: The disk refuses; what was remembered before is safe.
        """
        if name not in self._parts:
            self.keep(name, make())
        return self._parts[name]

    def known(self, name: str) -> Parts | None:
        """Arrays by name, if they are remembered."""
        return self._parts.get(name)

    def keep(self, name: str, made: Parts) -> None:
        """Remember arrays, made elsewhere.

        Raises:
            StoreError: The disk refuses; what was remembered before is safe.
        """
        self._add({"part": name, "arrays": {key: [str(x.dtype), x.shape, x.ravel().tolist()] for key, x in made.items()}})
        self._parts[name] = made

    def _read(self, formerly: Mapping[str, Any] | None) -> None:
        try:
            first, *lines = [json.loads(text) for text, sound in self._lines.read() if sound or self._before]
            plan = taken_for(self._plan, dict(first["search"]), formerly)
            for line in lines:
                self._parts[line["part"]] = {
                    key: _array(kind, values).reshape(shape) for key, (kind, shape, values) in line["arrays"].items()
                }
        except (ValueError, KeyError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
            raise StoreError(f"'{self._lines.path}' is damaged; remove it and start the search again") from error
        if other := difference(plan, self._plan):
            raise StoreError(f"'{self._lines.path.parent}' holds another search: {other}; give another folder")

    def _add(self, line: dict[str, Any]) -> None:
        self._lines.add(json.dumps(line).encode())


def _array(kind: str, values: Any) -> NDArray[Any]:
    if not re.fullmatch(r"bool|u?int\d+|float\d+", kind):
        raise ValueError(kind)
    with np.errstate(over="raise"):
        return np.array(values, dtype=kind)
