"""A study: a folder of cells, each with its chunks, that outlives the program, the worker and the machine."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from holdfast.engine.folder import held, is_plain, too_many
from holdfast.engine.job import Cell
from holdfast.engine.journal import Entry, Journal
from holdfast.engine.makers import Made
from holdfast.engine.runner import Runner, Stop
from holdfast.engine.state import CellStatus, Damage
from holdfast.engine.store import Store
from holdfast.engine.work import Progress, Work
from holdfast.errors import HoldfastError, InputError, StoreError
from holdfast.files import reading
from holdfast.files.digest import seal_document
from holdfast.files.output import guarded, occupied, replaced
from holdfast.files.sealed import read_sealed
from holdfast.notice import says
from holdfast.result import Result
from holdfast.words import duration

_FORMAT, _VERSION = "holdfast-study", 1
STUDY_FILE, LOCK, _CELLS, _BEGUN = "study.json", "study.lock", "cells", "begun.journal"
_KEYS = {"name": str, "seed": int, "digest": str, "source": str, "cells": list}


class Study(Result):
    """A study's folder; see :meth:`create` and :meth:`open`.

    Attributes:
        path: The folder.
        made: What computed it.
    """

    def __init__(self, path: Path, data: dict[str, Any]) -> None:
        self.path = path
        self.made = Made(path)
        self._data = data
        self._begun = Journal(path / _BEGUN)

    # ---- opening ---------------------------------------------------------------------------------------------------

    @classmethod
    def create(cls, path: str | Path, name: str, seed: int, *, cells: Sequence[Cell], source: str = "") -> Study:
        """A new folder, or the existing one of the same study; it takes over a new name, source and labels.

        Args:
            path: The folder.
            name: Of the study.
            seed: Of all its chunks.
            cells: What is computed.
            source: The study file, kept for people and for reports.

        Raises:
            StoreError: Not writable, not a study's folder, or that of another study.
        """
        folder = Path(path)
        data = described(name, seed, cells, source)
        if reading.exists(folder / STUDY_FILE):
            study = cls.open(folder)
            if study.digest != data["digest"]:
                raise StoreError(
                    f"'{folder}' holds another study ({study._unlike(data)}); give another folder, or the same study file to "
                    "resume it"
                )
            if study._data != data:
                study._write(data)
            return study
        if reading.exists(folder) and not folder.is_dir():
            raise StoreError(f"'{folder}' is a file; give a folder")
        with guarded(folder):
            folder.mkdir(parents=True, exist_ok=True)
            foreign = occupied(folder)
        if foreign:
            raise StoreError(f"'{folder}' exists, is not empty and is not a holdfast study; give a new or empty folder")
        study = cls(folder, data)
        study._write(data)
        return study

    @classmethod
    def open(cls, path: str | Path) -> Study:
        """The study in a folder.

        Raises:
            StoreError: There is none, or it is damaged or of another version.
        """
        folder = Path(path)
        file = folder / STUDY_FILE
        if not reading.exists(file):
            raise StoreError(
                f"'{folder}' is not a study: it has no {STUDY_FILE}; give the folder that 'holdfast study run --out' named"
            )
        try:
            data = read_sealed(file, own_digest=True)
            if data.pop("sealed", False):
                data["digest"] = _digest(data)
        except (OSError, ValueError, InputError) as error:
            raise StoreError(f"'{file}' cannot be read ({error}); run the study file again with a new folder") from error
        if not isinstance(data, dict) or data.get("format") != _FORMAT:
            raise StoreError(f"'{file}' was not written by holdfast; give the folder of a study")
        if data.get("version") != _VERSION:
            raise StoreError(f"'{folder}' was written in format {data.get('version')}; this holdfast reads format {_VERSION}")
        wrong = next((k for k, kind in _KEYS.items() if not isinstance(data.get(k), kind)), None)
        wrong = wrong or next((f"cell {k + 1}" for k, c in enumerate(data["cells"]) if not _is_cell(c)), None)
        wrong = wrong or ("cells" if len({c["name"] for c in data["cells"]}) < len(data["cells"]) else None)
        wrong = wrong or ("digest" if _digest(data) != data["digest"] else None)
        if wrong:
            raise StoreError(
                f"'{file}' is damaged: its {wrong} is missing or wrong; run the study file again with a new folder"
            )
        return cls(folder, data)

    def copy(self, path: str | Path) -> Study:
        """A new folder of this study, with nothing computed.

        Raises:
            StoreError: It exists, or cannot be written.
        """
        folder = Path(path)
        with guarded(folder):
            folder.mkdir(parents=True)
        study = Study(folder, self._data)
        study._write(self._data)
        return study

    def _write(self, data: dict[str, Any]) -> None:
        entries = {key: value for key, value in data.items() if key != "digest"}
        replaced(self.path / STUDY_FILE, seal_document({**entries, "sealed": True}))
        self._data = data

    def check_same(self, other: Study) -> None:
        """Refuse a folder that is not of this study.

        Raises:
            StoreError: It is not; the message names the difference.
        """
        if other.digest != self.digest:
            raise StoreError(
                f"'{other.path}' and '{self.path}' are not parts of one study ({self._unlike(other._data)}); merge folders of "
                "one study file"
            )

    def _unlike(self, other: Mapping[str, Any]) -> str:
        if self.seed != other["seed"]:
            return f"its seed is {self.seed}, asked for is {other['seed']}"
        mine, new = ({c["name"]: c for c in d["cells"]} for d in (self._data, other))
        for name in [*mine, *new]:
            if name not in new or name not in mine:
                return f"cell '{name}' is {'not asked for' if name not in new else 'not in it'}"
            for what in ("rows", "chunk"):
                if mine[name][what] != new[name][what]:
                    return f"cell '{name}' has {what} {mine[name][what]}, asked for is {new[name][what]}"
        return next(f"cell '{n}' has other settings, or a file that it reads has changed" for n in mine if mine[n] != new[n])

    # ---- what is there ---------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """Of the study."""
        return str(self._data["name"])

    @property
    def seed(self) -> int:
        """Of all chunks."""
        return int(self._data["seed"])

    @property
    def digest(self) -> str:
        """Of all that defines its values: folders with the same one belong together."""
        return str(self._data["digest"])

    @property
    def source(self) -> str:
        """The study file."""
        return str(self._data["source"])

    @property
    def cells(self) -> list[dict[str, Any]]:
        """Name, labels, rows, chunk and digest of each cell."""
        return list(self._data["cells"])

    def folder(self, cell: int) -> Path:
        """Where a cell is."""
        return self.path / _CELLS / str(self._data["cells"][cell]["name"])

    def store(self, cell: int) -> Store:
        """The rows of a cell.

        Raises:
            StoreError: None of it is computed, or it is damaged.
        """
        if not reading.exists(self.folder(cell)):
            raise StoreError(f"cell '{self.cells[cell]['name']}' of '{self.path}' is not begun; run the study first")
        return Store.open(self.folder(cell))

    def note_begun(self, cell: int) -> None:
        """Write down that a cell has rows, so that it is missed when it is gone.

        Raises:
            StoreError: The disk refuses.
        """
        self._begun.add(cell, Entry("begun", 0, 0.0, 0))

    @property
    def begun(self) -> frozenset[int]:
        """Cells that had rows once, from 0; folders from before holdfast kept count do not say.

        Raises:
            StoreError: It cannot be read.
        """
        return frozenset(self._begun.read())

    def entries(self, cell: int) -> dict[int, Entry]:
        """What is done of a cell, by number of the chunk.

        Raises:
            StoreError: Its journal cannot be read.
        """
        return Journal(self.folder(cell) / Store.JOURNAL).read()

    def status(self) -> list[CellStatus]:
        """How far each cell is, from the journals alone.

        Raises:
            StoreError: A journal cannot be read.
        """
        found = []
        for k, c in enumerate(self._data["cells"]):
            entries = self.entries(k)
            count, rest = -(-c["rows"] // c["chunk"]), c["rows"] % c["chunk"]
            done = [e for n, e in entries.items() if n < count]
            short = c["chunk"] - rest if rest and count - 1 in entries else 0
            found.append(
                CellStatus(
                    name=c["name"],
                    labels=c["labels"],
                    chunks=count,
                    rows=c["rows"],
                    chunks_done=len(done),
                    rows_done=len(done) * c["chunk"] - short,
                    seconds=sum(e.seconds for e in done),
                    makers=tuple(sorted({e.maker for e in done})),
                )
            )
        return found

    @property
    def complete(self) -> bool:
        """Every cell is."""
        return all(s.complete for s in self.status())

    @property
    def makers(self) -> list[dict[str, Any]]:
        """Versions and processors that computed it, by their numbers in the journals."""
        return self.made.makers

    @property
    def runs(self) -> list[dict[str, Any]]:
        """When it was run, on what, for how long; a run that was killed is not among them."""
        return self.made.runs

    def describe(self) -> list[str]:
        """How far it is, in a sentence."""
        cells = self.status()
        done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
        word = "complete" if done == total else f"{100 * done / total:.1f} %" if total else "empty"
        spent = duration(sum(s.seconds for s in cells))
        return [f"{self.name} ({self.path}): {done:,} of {total:,} chunks, {word}, {spent} of processor time to compute"]

    # ---- computing -------------------------------------------------------------------------------------------------

    @says("computing the study")
    def run(
        self,
        cells: Sequence[Cell],
        runner: Runner,
        progress: Progress | None = None,
        *,
        stop: Stop = lambda: False,
        part: tuple[int, int] = (1, 1),
    ) -> dict[str, HoldfastError]:
        """Compute and commit what is missing.

        Args:
            cells: Those it was created with.
            runner: Who computes.
            progress: Called after every chunk.
            stop: Asked now and then; once it says True, what is at work is finished and committed, and no more begun.
            part: ``(1, 3)``: only the first of three shares, for machines that never see each other; see
                :func:`holdfast.engine.merge`.

        Returns:
            Cells that could not be computed, by name, and why.

        Raises:
            StoreError: The folder belongs to other cells, another program is at work in it, the disk is full, or the cluster
                is gone. What was committed is safe.
        """
        if described(self.name, self.seed, cells, "")["digest"] != self.digest:
            raise StoreError(f"'{self.path}' holds another study; give another folder")
        with held(self.path, LOCK):
            return Work(self, cells, progress).run(runner, stop, part)

    # ---- checking and joining --------------------------------------------------------------------------------------

    @says("reading the study")
    def verify(self, progress: Progress | None = None) -> list[Damage]:
        """Read every committed chunk and compare its checksum; damaged ones are missing from then on, to be run again.

        A cell that was begun and of which nothing is left counts too.

        Raises:
            StoreError: Another program is at work in the folder, or it is not writable.
        """
        found: list[Damage] = []
        with held(self.path, LOCK):
            total, at = sum(s.chunks_done for s in self.status()), 0
            begun = self.begun
            for k, c in enumerate(self._data["cells"]):
                if k in begun and not self.entries(k):
                    found.append(Damage(c["name"], None, "it was begun, and nothing of it is left"))
                    self._begun.drop([k])
                if not reading.exists(self.folder(k)):
                    continue
                store = self.store(k)
                bad = []
                for chunk in store.done:
                    try:
                        store.checked(chunk)
                    except StoreError as error:
                        bad.append(chunk)
                        found.append(Damage(c["name"], chunk, str(error)))
                    at += 1
                    if progress is not None:
                        progress(at, total, None)
                if bad:
                    store.drop(bad)
                    if not store.done:
                        self._begun.drop([k])
        return found


def described(name: str, seed: int, cells: Sequence[Cell], source: str) -> dict[str, Any]:
    """The file of a study."""
    data: dict[str, Any] = {
        "format": _FORMAT,
        "version": _VERSION,
        "name": name,
        "seed": seed,
        "source": source,
        "cells": [
            {"name": c.name, "labels": dict(c.labels)} | {k: getattr(c, k) for k in ("rows", "chunk", "summed", "digest")}
            for c in cells
        ],
    }
    return {**data, "digest": _digest(data)}


def _is_cell(data: Any) -> bool:
    kinds = {"labels": dict, "rows": int, "chunk": int, "digest": str}
    if not isinstance(data, dict) or not all(isinstance(data.get(k), kind) for k, kind in kinds.items()):
        return False
    return is_plain(data.get("name")) and data["rows"] >= 0 and data["chunk"] >= 1 and not too_many(data["rows"], data["chunk"])


def _digest(data: Mapping[str, Any]) -> str:
    try:
        text = json.dumps([data["seed"], [[c["name"], c["rows"], c["chunk"], c["digest"]] for c in data["cells"]]])
    except (KeyError, TypeError):
        return ""
    return sha256(text.encode()).hexdigest()[:16]
