"""Merge folders of one study that different machines computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.sweeps.folder import lock_folder
from holdfast.core.sweeps.store import Store
from holdfast.core.sweeps.study import STUDY_LOCK_FILE, Study
from holdfast.core.sweeps.work import Progress


@dataclass(frozen=True, kw_only=True)
class MergeReport(Result):
    """Result of a merge.

    Attributes:
        study: Study into which the chunks were merged.
        added: Number of chunks that were copied.
        both: Number of chunks that already existed with the same bits.
        close: Number of chunks that already existed and agree to 1e-12.
        apart: Cell names and numbers of chunks that already existed with other values; the existing values are kept.
    """

    study: Study
    added: int
    both: int
    close: int
    apart: tuple[tuple[str, int], ...]

    def to_dict(self) -> dict[str, Any]:
        """Return the number of chunks of each kind and the machines that computed them."""
        apart = [{"cell": c, "chunk": k + 1} for c, k in self.apart]
        counts = {"added": self.added, "same": self.both, "within_1e-12": self.close}
        return {**counts, "different": apart, "made_by": self.study.makers}


@reports_progress("joining the studies")
def merge_studies(path: str | Path, folders: Sequence[str | Path], progress: Progress | None = None) -> MergeReport:
    """Copy the chunks that other folders of a study have and this folder lacks.

    Chunks computed by the same versions on the same kind of processor have the same bits; otherwise values agree to 1e-12,
    which is checked for the chunks that several folders have.

    Args:
        path: Folder to merge into; it is created if it does not exist.
        folders: Folders to copy from.
        progress: Called after every chunk with the chunks done, the total, and None.

    Raises:
        StoreError: A folder belongs to another study, a chunk is damaged, or another program is working in a folder.
    """
    others = [Study.open(folder) for folder in folders]
    if not others:
        raise StoreError("there is nothing to merge; name the folder to merge into and one or more to take from")
    study = Study.open(path) if reading.path_exists(Path(path)) else None
    for other in others:
        (study or others[0]).check_same(other)
    study = study or others[0].copy(path)
    with lock_folder(study.path, STUDY_LOCK_FILE):
        merging = _Merging(study, sum(s.chunks_done for o in others for s in o.status()), progress)
        for other in others:
            merging.copy_chunks_from(other)
        study.made.add_runs(r for o in others for r in o.runs)
    return MergeReport(study=study, added=merging.added, both=merging.both, close=merging.close, apart=tuple(merging.apart))


class _Merging:
    """Merge in progress; its counts are those of :class:`MergeReport`."""

    def __init__(self, study: Study, total: int, progress: Progress | None) -> None:
        self._study, self._total, self._progress = study, total, progress
        self.added = self.both = self.close = self._at = 0
        self.apart: list[tuple[str, int]] = []

    def copy_chunks_from(self, other: Study) -> None:
        """Copy the chunks of another folder."""
        numbers = [self._study.made.machine_number(machine) for machine in other.makers]
        for number, cell in enumerate(other.cells):
            if not other.cell_entries(number):
                continue
            source = other.cell_store(number)
            rows, chunk = source.shape
            mine = Store.create(self._study.cell_folder(number), source.plan, source.columns, rows=rows, chunk=chunk)
            if source.committed_chunks and number not in self._study.begun_cells:
                self._study.record_begun(number)
            for part in source.committed_chunks:
                self._copy_chunk(cell["name"], part, source, mine, numbers)
                self._at += 1
                if self._progress is not None:
                    self._progress(self._at, self._total, None)

    def _copy_chunk(self, cell: str, chunk: int, source: Store, target: Store, machine_numbers: list[int]) -> None:
        entry, own_entry = source.entries[chunk], target.entries.get(chunk)
        if own_entry is not None and own_entry.digest == entry.digest:
            self.both += 1
            return
        values = source.read_checked(chunk)
        if own_entry is None:
            maker = machine_numbers[entry.maker] if entry.maker < len(machine_numbers) else 0
            target.commit_chunk(chunk, values, entry.seconds, maker=maker)
            self.added += 1
        elif _are_columns_close(target.read_chunk(chunk, list(values)), values):
            self.close += 1
        else:
            self.apart.append((cell, chunk))


def _are_columns_close(a: Mapping[str, NDArray[Any]], b: Mapping[str, NDArray[Any]]) -> bool:
    for name, x in a.items():
        y = b[name]
        if x.dtype.kind != "f":
            if not np.array_equal(x, y):
                return False
        elif not np.allclose(x, y, rtol=1e-12, atol=1e-12, equal_nan=True):
            return False
    return True
