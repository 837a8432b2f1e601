"""Study: a folder of cells, each with its chunks, that outlives the program, the worker, and the machine."""

from __future__ import annotations

import itertools
import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from holdfast.core.errors import HoldfastError, StoreError
from holdfast.core.files import reading
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import guard_writing, is_occupied, replace_file
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.sweeps.folder import STUDY_FILE, has_too_many_rows, is_valid_folder_name, lock_folder, read_run_file
from holdfast.core.sweeps.job import CellStatus, DamagedChunk, SweepCell
from holdfast.core.sweeps.journal import Journal, JournalEntry
from holdfast.core.sweeps.run_log import RunLog
from holdfast.core.sweeps.runner import Runner, Stop
from holdfast.core.sweeps.store import Store
from holdfast.core.sweeps.work import Progress, StudyRun

_STUDY_FORMAT = "holdfast-study"
_STUDY_VERSION = 1
STUDY_LOCK_FILE = "study.lock"
_CELLS_FOLDER = "cells"
_BEGUN_FILE = "begun.journal"
_KINDS_BY_KEY = {"name": str, "seed": int, "source": str, "cells": list}


class Study(Result):
    """Folder of a study with the content ``data`` of its study file; see :meth:`create` and :meth:`open`.

    Attributes:
        path: The folder.
        made: Log of the runs and of the machines that computed the study.
    """

    def __init__(self, path: Path, data: dict[str, Any]) -> None:
        self.path = path
        self.made = RunLog(path)
        self._data = data
        self._begun = Journal(path / _BEGUN_FILE)

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(cls, path: str | Path, name: str, seed: int, *, cells: Sequence[SweepCell], source: str = "") -> Study:
        """Create a folder, or open the existing folder of the same study with the new name, source, and labels.

        Args:
            path: The folder.
            name: Name of the study.
            seed: Seed of all chunks.
            cells: Cells to compute.
            source: Text of the study file, kept for people and for reports.

        Raises:
            StoreError: The folder is not writable, not the folder of a study, or belongs to another study.
        """
        folder = Path(path)
        data = study_document(name, seed, cells, source)
        if reading.path_exists(folder / STUDY_FILE):
            study = cls.open(folder)
            if study.digest != _study_digest(data):
                raise StoreError(
                    f"'{folder}' holds another study ({study._describe_difference(data)}); give another folder, or the same "
                    "study file to resume it"
                )
            if study._data != data:
                study._write_study_file(data)
            return study
        if reading.path_exists(folder) and not folder.is_dir():
            raise StoreError(f"'{folder}' is a file; give a folder")
        with guard_writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
            foreign = is_occupied(folder)
        if foreign:
            raise StoreError(f"'{folder}' exists, is not empty and is not a holdfast study; give a new or empty folder")
        study = cls(folder, data)
        study._write_study_file(data)
        return study

    @classmethod
    def open(cls, path: str | Path) -> Study:
        """Open the study in the folder ``path``.

        Raises:
            StoreError: There is no study, or it is damaged or of another version.
        """
        folder = Path(path)
        file = folder / STUDY_FILE
        if not reading.path_exists(file):
            raise StoreError(
                f"'{folder}' is not a study: it has no {STUDY_FILE}; give the folder that 'holdfast study run --out' named"
            )
        advice = "run the study file again with a new folder"
        data = read_run_file(file, _STUDY_FORMAT, _STUDY_VERSION, kind="a study", advice=advice)
        wrong = next((k for k, kind in _KINDS_BY_KEY.items() if not isinstance(data.get(k), kind)), None)
        wrong = wrong or next((f"cell {k + 1}" for k, c in enumerate(data["cells"]) if not _is_cell(c)), None)
        wrong = wrong or ("cells" if len({c["name"] for c in data["cells"]}) < len(data["cells"]) else None)
        if wrong:
            raise StoreError(f"'{file}' is damaged: its {wrong} is missing or wrong; {advice}")
        return cls(folder, data)

    def copy(self, path: str | Path) -> Study:
        """Create the folder ``path`` for this study, without results.

        Raises:
            StoreError: The folder exists, or cannot be written.
        """
        folder = Path(path)
        with guard_writing(folder):
            folder.mkdir(parents=True)
        study = Study(folder, self._data)
        study._write_study_file(self._data)
        return study

    def _write_study_file(self, data: dict[str, Any]) -> None:
        replace_file(self.path / STUDY_FILE, seal_document(data))
        self._data = data

    def check_same(self, other: Study) -> None:
        """Reject ``other`` if it is the folder of another study.

        Raises:
            StoreError: It is another study; the message states the difference.
        """
        if other.digest != self.digest:
            raise StoreError(
                f"'{other.path}' and '{self.path}' are not parts of one study ({self._describe_difference(other._data)}); "
                "merge folders of one study file"
            )

    def _describe_difference(self, other: Mapping[str, Any]) -> str:
        if self.seed != other["seed"]:
            return f"its seed is {self.seed}, but {other['seed']} was requested"
        mine, theirs = ({c["name"]: c for c in d["cells"]} for d in (self._data, other))
        for name in [*mine, *theirs]:
            if name not in theirs or name not in mine:
                return f"cell '{name}' is {'not requested' if name not in theirs else 'not in it'}"
            for key in ("rows", "chunk"):
                if mine[name][key] != theirs[name][key]:
                    return f"cell '{name}' has {key} {mine[name][key]}, but {theirs[name][key]} was requested"
        return next(f"cell '{n}' has other settings, or a file that it reads has changed" for n in mine if mine[n] != theirs[n])

    # ---- content ---------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """Name of the study."""
        return str(self._data["name"])

    @property
    def seed(self) -> int:
        """Seed of all chunks."""
        return int(self._data["seed"])

    @property
    def digest(self) -> str:
        """Digest of everything that defines the values of the study; folders with the same digest belong together."""
        return _study_digest(self._data)

    @property
    def source(self) -> str:
        """Text of the study file."""
        return str(self._data["source"])

    @property
    def cells(self) -> list[dict[str, Any]]:
        """Name, labels, rows, chunk and digest of each cell."""
        return list(self._data["cells"])

    def cell_folder(self, cell: int) -> Path:
        """Return the path of cell number ``cell`` (from 0)."""
        return self.path / _CELLS_FOLDER / str(self._data["cells"][cell]["name"])

    def cell_store(self, cell: int) -> Store:
        """Return the stored rows of cell number ``cell`` (from 0).

        Raises:
            StoreError: No chunk of the cell is computed, or the cell is damaged.
        """
        if not reading.path_exists(self.cell_folder(cell)):
            raise StoreError(f"cell '{self.cells[cell]['name']}' of '{self.path}' is not begun; run the study first")
        return Store.open(self.cell_folder(cell))

    def record_begun(self, cell: int) -> None:
        """Record that cell number ``cell`` (from 0) has rows, so that a loss of the cell is detected.

        Raises:
            StoreError: Writing failed.
        """
        self._begun.add(cell, JournalEntry("begun", 0, 0.0, 0))

    @property
    def begun_cells(self) -> frozenset[int]:
        """Numbers of the cells that have had rows, from 0; folders of early versions do not record them.

        Raises:
            StoreError: The record cannot be read.
        """
        return frozenset(self._begun.read_entries())

    def cell_entries(self, cell: int) -> dict[int, JournalEntry]:
        """Return the finished chunks of cell number ``cell`` (from 0) by number.

        Raises:
            StoreError: The journal cannot be read.
        """
        return Journal(self.cell_folder(cell) / Store.JOURNAL).read_entries()

    def status(self) -> list[CellStatus]:
        """Return the progress of each cell, read from the journals.

        Raises:
            StoreError: A journal cannot be read.
        """
        states = []
        for number, cell in enumerate(self._data["cells"]):
            entries = self.cell_entries(number)
            count, last_rows = -(-cell["rows"] // cell["chunk"]), cell["rows"] % cell["chunk"]
            done = [e for n, e in entries.items() if n < count]
            missing_rows = cell["chunk"] - last_rows if last_rows and count - 1 in entries else 0
            states.append(
                CellStatus(
                    name=cell["name"],
                    labels=cell["labels"],
                    chunks=count,
                    rows=cell["rows"],
                    chunks_done=len(done),
                    rows_done=len(done) * cell["chunk"] - missing_rows,
                    seconds=sum(e.seconds for e in done),
                    makers=tuple(sorted({e.maker for e in done})),
                )
            )
        return states

    @property
    def is_complete(self) -> bool:
        """True if every cell is complete."""
        return all(s.is_complete for s in self.status())

    @property
    def makers(self) -> list[dict[str, Any]]:
        """Versions and processors that computed the study, by their numbers in the journals."""
        return self.made.makers

    @property
    def runs(self) -> list[dict[str, Any]]:
        """Start, machine, and duration of each run, except runs that were killed."""
        return self.made.runs

    # ---- computing -------------------------------------------------------------------------------------------------

    @reports_progress("computing the study")
    def run(
        self,
        cells: Sequence[SweepCell],
        runner: Runner,
        progress: Progress | None = None,
        *,
        stop: Stop = lambda: False,
        part: tuple[int, int] = (1, 1),
    ) -> dict[str, HoldfastError]:
        """Compute and commit the missing chunks.

        Args:
            cells: Cells with which the study was created.
            runner: Threads or cluster that computes the chunks.
            progress: Called after every chunk with the chunks done, the total, and the remaining seconds.
            stop: Called now and then; once it returns True, chunks in progress are committed, and no new one is begun.
            part: ``(1, 3)`` computes only the first of three parts, for machines without a common folder; see
                :func:`holdfast.core.sweeps.merge_studies`.

        Returns:
            Errors of the cells that could not be computed, by cell name.

        Raises:
            StoreError: The folder belongs to other cells, another program is working in it, the disk is full, or the cluster is
                lost. Committed chunks are safe.
        """
        if _study_digest(study_document(self.name, self.seed, cells, "")) != self.digest:
            raise StoreError(f"'{self.path}' holds another study; give another folder")
        with lock_folder(self.path, STUDY_LOCK_FILE):
            return StudyRun(self, cells, progress).run(runner, stop, part)

    # ---- checking and joining --------------------------------------------------------------------------------------

    @reports_progress("reading the study")
    def verify(self, progress: Progress | None = None) -> list[DamagedChunk]:
        """Read every committed chunk and compare its checksum; ``progress`` is called after each, as in :meth:`run`.

        Damaged chunks count as missing, so that the next run computes them. A lost cell that was begun is reported as well.

        Raises:
            StoreError: Another program is working in the folder, or it is not writable.
        """
        damaged: list[DamagedChunk] = []
        with lock_folder(self.path, STUDY_LOCK_FILE):
            total, position = sum(s.chunks_done for s in self.status()), itertools.count(1)
            begun = self.begun_cells

            def report() -> None:
                if progress is not None:
                    progress(next(position), total, None)

            for number, cell in enumerate(self._data["cells"]):
                if number in begun and not self.cell_entries(number):
                    damaged.append(DamagedChunk(cell["name"], None, "it was begun, and nothing of it is left"))
                    self._begun.drop([number])
                if not reading.path_exists(self.cell_folder(number)):
                    continue
                store = self.cell_store(number)
                found = store.drop_damaged_chunks(cell["name"], report)
                damaged += found
                if found and not store.committed_chunks:
                    self._begun.drop([number])
        return damaged


def study_document(name: str, seed: int, cells: Sequence[SweepCell], source: str) -> dict[str, Any]:
    """Return the content of the study file."""
    return {
        "format": _STUDY_FORMAT,
        "version": _STUDY_VERSION,
        "name": name,
        "seed": seed,
        "source": source,
        "cells": [
            {"name": cell.name, "labels": dict(cell.labels)}
            | {key: getattr(cell, key) for key in ("rows", "chunk", "summed", "digest")}
            for cell in cells
        ],
    }


def _is_cell(data: Any) -> bool:
    kinds = {"labels": dict, "rows": int, "chunk": int, "digest": str}
    if not isinstance(data, dict) or not all(isinstance(data.get(k), kind) for k, kind in kinds.items()):
        return False
    return (
        is_valid_folder_name(data.get("name"))
        and data["rows"] >= 0
        and data["chunk"] >= 1
        and not has_too_many_rows(data["rows"], data["chunk"])
    )


def _study_digest(data: Mapping[str, Any]) -> str:
    """Return the digest of everything that defines the values of a study."""
    text = json.dumps([data["seed"], [[c["name"], c["rows"], c["chunk"], c["digest"]] for c in data["cells"]]])
    return sha256(text.encode()).hexdigest()[:16]
