"""What computed a study, and when: versions and processors by number, and its runs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from holdfast.engine.folder import SAFE
from holdfast.errors import InputError, StoreError
from holdfast.files.digest import seal_document
from holdfast.files.output import replaced
from holdfast.files.sealed import read_sealed

_FILE = "made.json"


class Made:
    """The file of a study's folder that says so; it is read at every question."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @property
    def makers(self) -> list[dict[str, Any]]:
        """Versions and processors, by their numbers in the journals."""
        return list(self._read()["makers"])

    @property
    def runs(self) -> list[dict[str, Any]]:
        """When it was run, on what, for how long; a run that was killed is not among them."""
        return list(self._read()["runs"])

    def number(self, maker: dict[str, Any]) -> int:
        """That of versions and a processor; new ones are written down first.

        Raises:
            StoreError: The disk refuses, or the file is damaged.
        """
        data = self._read()
        if maker not in data["makers"]:
            data["makers"].append(maker)
            self._write(data)
        return int(data["makers"].index(maker))

    def add(self, runs: Iterable[dict[str, Any]]) -> None:
        """More runs; those that are known already do not count again.

        Raises:
            StoreError: The disk refuses, or the file is damaged.
        """
        data = self._read()
        data["runs"] += [r for r in runs if r not in data["runs"]]
        self._write(data)

    def _read(self) -> dict[str, list[Any]]:
        file = self._folder / _FILE
        if not file.exists():
            return {"makers": [], "runs": []}
        try:
            data = read_sealed(file)
            return {"makers": list(data["makers"]), "runs": list(data["runs"])}
        except (OSError, ValueError, InputError, KeyError, TypeError) as error:
            raise StoreError(f"'{file}' is damaged ({error}); remove it if what made the rows need not be known") from error

    def _write(self, data: dict[str, list[Any]]) -> None:
        replaced(self._folder / _FILE, seal_document({**data, "sealed": True}), advice=SAFE)
