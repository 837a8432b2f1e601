"""Log of the runs of a study, with the versions and processors that computed it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import replace_file
from holdfast.core.files.sealed import read_sealed
from holdfast.core.sweeps.folder import RESUME_ADVICE

_RUN_LOG_FILE = "made.json"


class RunLog:
    """File in a study's folder that records its runs; it is read again at each query."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @property
    def makers(self) -> list[dict[str, Any]]:
        """Versions and processors by their numbers in the journals."""
        return list(self._read_file()["makers"])

    @property
    def runs(self) -> list[dict[str, Any]]:
        """Start, machine, and duration of each run, except runs that were killed."""
        return list(self._read_file()["runs"])

    def machine_number(self, maker: dict[str, Any]) -> int:
        """Return the number of a combination of versions and processor, recording a new combination first.

        Raises:
            StoreError: Writing failed, or the file is damaged.
        """
        data = self._read_file()
        if maker not in data["makers"]:
            data["makers"].append(maker)
            self._write_file(data)
        return int(data["makers"].index(maker))

    def add_runs(self, runs: Iterable[dict[str, Any]]) -> None:
        """Add runs; known runs are not added again.

        Raises:
            StoreError: Writing failed, or the file is damaged.
        """
        data = self._read_file()
        data["runs"] += [run for run in runs if run not in data["runs"]]
        self._write_file(data)

    def _read_file(self) -> dict[str, list[Any]]:
        file = self._folder / _RUN_LOG_FILE
        if not file.exists():
            return {"makers": [], "runs": []}
        try:
            data = read_sealed(file)
            return {"makers": list(data["makers"]), "runs": list(data["runs"])}
        except (OSError, ValueError, InputError, KeyError, TypeError) as error:
            advice = "remove it if you do not need to know which machines computed the rows"
            raise StoreError(f"'{file}' is damaged ({error}); {advice}") from error

    def _write_file(self, data: dict[str, list[Any]]) -> None:
        replace_file(self._folder / _RUN_LOG_FILE, seal_document(data), advice=RESUME_ADVICE)
