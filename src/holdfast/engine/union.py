"""Folders of one study from machines that never saw each other become one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.engine.folder import held
from holdfast.engine.store import Store
from holdfast.engine.study import LOCK, Study
from holdfast.engine.work import Progress
from holdfast.errors import StoreError
from holdfast.files import reading
from holdfast.notice import says
from holdfast.result import Result


@dataclass(frozen=True, kw_only=True)
class Merged(Result):
    """What a merge did.

    Attributes:
        study: That was merged into.
        added: Chunks taken over.
        both: Chunks that were there already, with the same bits.
        close: Chunks that were there already, alike to 1e-12.
        apart: Chunks that were there already with other values; those that were there stay.
    """

    study: Study
    added: int
    both: int
    close: int
    apart: tuple[tuple[str, int], ...]

    def describe(self) -> list[str]:
        """What was added and what was there, who computed it, and how far the study is now."""
        lines = [f"{self.study.path}: {self.added} chunks added, {self.both} were there already, bit for bit the same"]
        if self.close:
            lines.append(f"{self.close} chunks were there already, alike to 1e-12")
        if self.apart:
            cell, k = self.apart[0]
            lines.append(
                f"{len(self.apart)} chunks were there already with other values (first: chunk {k + 1} of '{cell}'); those of "
                f"'{self.study.path}' are kept"
            )
        for maker in self.study.makers:
            packages = ", ".join(f"{name} {version}" for name, version in maker["versions"].items())
            lines.append(f"computed on {maker['processor']}: Python {maker['python']}, {packages}")
        if len(self.study.makers) > 1:
            lines.append(
                "versions or processors differ: the same study computed on one of them alone agrees to 1e-12, not in every bit"
            )
        return [*lines, *self.study.describe()]

    def to_dict(self) -> dict[str, Any]:
        """How many chunks of each kind, and who computed them."""
        apart = [{"cell": c, "chunk": k + 1} for c, k in self.apart]
        counts = {"added": self.added, "same": self.both, "within_1e-12": self.close}
        return {**counts, "different": apart, "made_by": self.study.makers}


@says("joining the studies")
def merge(path: str | Path, folders: Sequence[str | Path], progress: Progress | None = None) -> Merged:
    """Take over what other folders of a study have and this one lacks.

    Chunks computed by the same versions on the same kind of processor have the same bits; otherwise values agree to 1e-12,
    which is checked for the chunks that several folders have.

    Args:
        path: The folder to merge into; it is made if it does not exist.
        folders: Where to take from.
        progress: Called after every chunk.

    Raises:
        StoreError: A folder of another study, a damaged chunk, or another program at work.
    """
    others = [Study.open(folder) for folder in folders]
    if not others:
        raise StoreError("there is nothing to merge; name the folder to merge into and one or more to take from")
    study = Study.open(path) if reading.exists(Path(path)) else None
    for other in others:
        (study or others[0]).check_same(other)
    study = study or others[0].copy(path)
    with held(study.path, LOCK):
        work = _Merge(study, sum(s.chunks_done for o in others for s in o.status()), progress)
        for other in others:
            work.take(other)
        study.made.add(r for o in others for r in o.runs)
    return Merged(study=study, added=work.added, both=work.both, close=work.close, apart=tuple(work.apart))


class _Merge:
    """A merge at work; its counts are those of :class:`Merged`."""

    def __init__(self, study: Study, total: int, progress: Progress | None) -> None:
        self._study, self._total, self._progress = study, total, progress
        self.added = self.both = self.close = self._at = 0
        self.apart: list[tuple[str, int]] = []

    def take(self, other: Study) -> None:
        """What another folder has."""
        numbers = [self._study.made.number(m) for m in other.makers]
        for k, cell in enumerate(other.cells):
            if not other.entries(k):
                continue
            source = other.store(k)
            source.check_current()
            rows, chunk = source.shape
            mine = Store.create(self._study.folder(k), source.plan, source.columns, rows=rows, chunk=chunk, journal=True)
            if source.done and k not in self._study.begun:
                self._study.note_begun(k)
            for part in source.done:
                self._chunk(cell["name"], part, source, mine, numbers)
                self._at += 1
                if self._progress is not None:
                    self._progress(self._at, self._total, None)

    def _chunk(self, cell: str, chunk: int, source: Store, mine: Store, numbers: list[int]) -> None:
        entry, have = source.entries[chunk], mine.entries.get(chunk)
        if have is not None and have.digest == entry.digest:
            self.both += 1
            return
        try:
            values = source.checked(chunk)
        except StoreError as error:
            raise StoreError(
                f"chunk {chunk + 1} of cell '{cell}' in '{source.path}' is damaged ({error}); give 'holdfast study verify' "
                "with that folder, then compute it again"
            ) from error
        if have is None:
            maker = numbers[entry.maker] if entry.maker < len(numbers) else 0
            mine.write(chunk, values, entry.seconds, maker=maker)
            self.added += 1
        elif _alike(mine.read(chunk, list(values)), values):
            self.close += 1
        else:
            self.apart.append((cell, chunk))


def _alike(a: Mapping[str, NDArray[Any]], b: Mapping[str, NDArray[Any]]) -> bool:
    for name, x in a.items():
        y = b[name]
        if x.dtype.kind != "f":
            if not np.array_equal(x, y):
                return False
        elif not np.allclose(x, y, rtol=1e-12, atol=1e-12, equal_nan=True):
            return False
    return True
