"""What a search has done already, in a file, so that one that was stopped goes on where it was."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import StoreError

FILE = "search.jsonl"
Parts = dict[str, NDArray[Any]]


class Memory:
    """Parts of a search by name, in a file of JSON lines: the first says which search it is, each other holds a part.

    A part is on the disk before the search goes on; a last line that a crash cut short does not count. Numbers come back with
    the same bits, so a search that was stopped ends with the same result as one that was not.
    """

    def __init__(self, folder: str | Path, plan: dict[str, Any]) -> None:
        """The memory of a search in a folder, made if need be.

        Args:
            folder: Where results are kept.
            plan: JSON data that defines the search.

        Raises:
            StoreError: The folder holds another search or something else, or cannot be written.
        """
        self.path = Path(folder) / FILE
        self._plan: dict[str, Any] = json.loads(json.dumps(plan))
        self._parts: dict[str, Parts] = {}
        try:
            if self.path.exists():
                self._read()
                return
            if self.path.parent.exists() and any(self.path.parent.iterdir()):
                raise StoreError(f"'{folder}' is not empty and holds no search of designs; give a new or empty folder")
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._add({"search": self._plan})
        except OSError as error:
            raise self._refused(error) from error

    def part(self, name: str, make: Callable[[], Parts]) -> Parts:
        """Arrays by name: remembered, or made now and remembered.

        Raises:
            StoreError: The disk refuses; what was remembered before is safe.
        """
        if name not in self._parts:
            made = make()
            line = {"part": name, "arrays": {key: [str(x.dtype), x.shape, x.ravel().tolist()] for key, x in made.items()}}
            try:
                self._add(line)
            except OSError as error:
                raise self._refused(error) from error
            self._parts[name] = made
        return self._parts[name]

    def _read(self) -> None:
        whole, _, rest = self.path.read_bytes().rpartition(b"\n")
        try:
            first, *lines = [json.loads(x) for x in whole.split(b"\n") if x]
            plan = dict(first["search"])
            for line in lines:
                self._parts[line["part"]] = {
                    key: _array(kind, values).reshape(shape) for key, (kind, shape, values) in line["arrays"].items()
                }
        except (ValueError, KeyError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
            raise StoreError(f"'{self.path}' is damaged; remove it and start the search again") from error
        for key in {*plan, *self._plan}:
            if plan.get(key) != self._plan.get(key):
                held, asked = (_short(x.get(key)) for x in (plan, self._plan))
                raise StoreError(
                    f"'{self.path.parent}' holds another search: its {key} is {held}, asked for is {asked}; give another folder"
                )
        if rest:  # a line that was cut short
            os.truncate(self.path, len(whole) + 1)

    def _add(self, line: dict[str, Any]) -> None:
        with self.path.open("ab") as file:
            file.write(json.dumps(line).encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())

    def _refused(self, error: OSError) -> StoreError:
        return StoreError(
            f"cannot write to '{self.path.parent}': {error.strerror or error}; make room or give another folder, and run the "
            "same command again"
        )


def _array(kind: str, values: Any) -> NDArray[Any]:
    if not re.fullmatch(r"bool|u?int\d+|float\d+", kind):
        raise ValueError(kind)
    with np.errstate(over="raise"):
        return np.array(values, dtype=kind)


def _short(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else text[:57] + "..."
