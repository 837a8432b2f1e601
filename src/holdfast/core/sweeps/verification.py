"""Check that the chunks of studies and results folders are unchanged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.formatting import format_count
from holdfast.core.result import Result
from holdfast.core.sweeps.folder import STUDY_FILE
from holdfast.core.sweeps.job import DamagedChunk
from holdfast.core.sweeps.store import RUN_FILE, Store
from holdfast.core.sweeps.study import Study
from holdfast.core.sweeps.work import Progress


@dataclass(frozen=True, kw_only=True)
class StudyVerification(Result):
    """Result of the verification of studies and results folders.

    Attributes:
        studies: Folders that were read, in their present state.
        damage: Damaged chunks of each folder.
    """

    studies: tuple[Study | Store, ...]
    damage: tuple[tuple[DamagedChunk, ...], ...]

    def describe(self) -> list[str]:
        """Return for each study its damage, or that it is sound and which chunks are missing."""
        lines = []
        for study, damage in zip(self.studies, self.damage, strict=True):
            lines += [f"{study.path}: {_describe_damage(d)}" for d in damage] or _describe_undamaged(study)
        return lines

    def to_dict(self) -> dict[str, Any]:
        """Return the damage, with chunks counted from 1."""
        return {
            "damaged": [
                {"folder": str(study.path), "cell": d.cell, "chunk": None if d.chunk is None else d.chunk + 1, "what": d.what}
                for study, damage in zip(self.studies, self.damage, strict=True)
                for d in damage
            ]
        }

    def require_ok(self) -> Self:
        """Return the object itself, or raise an error if anything is damaged.

        Raises:
            StoreError: A chunk is damaged.
        """
        count = sum(map(len, self.damage))
        if count:
            raise StoreError(
                f"{format_count(count, 'damaged chunk')}, missing from now on; the command that wrote the folder computes them "
                "again"
            )
        return self


def verify_studies(folders: Sequence[str | Path], progress: Progress | None = None) -> StudyVerification:
    """Read every committed chunk of studies and results folders and compare its checksum; see :meth:`Study.verify`.

    Args:
        folders: Folders of studies, or results folders such as those of :func:`holdfast.assess`.
        progress: Called after every chunk with the chunks read, the total, and None.

    Raises:
        StoreError: A folder is neither, another program is working in it, or it is not writable.
    """
    studies = tuple(map(_open_folder, folders))
    return StudyVerification(studies=studies, damage=tuple(tuple(study.verify(progress)) for study in studies))


def _open_folder(folder: str | Path) -> Study | Store:
    is_run = reading.path_exists(Path(folder) / RUN_FILE) and not reading.path_exists(Path(folder) / STUDY_FILE)
    return Store.open(folder) if is_run else Study.open(folder)


def _describe_damage(d: DamagedChunk) -> str:
    if d.chunk is None:
        return f"cell '{d.cell}' is lost: {d.what}"
    cell = "" if d.cell is None else f" of cell '{d.cell}'"
    return f"chunk {d.chunk + 1}{cell} is damaged: {d.what}"


def _describe_undamaged(study: Study | Store) -> list[str]:
    if isinstance(study, Store):
        done, total, empty_cells = len(study.committed_chunks), study.count, []
    else:
        cells = study.status()
        done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
        empty_cells = [s.name for s in cells if not s.chunks_done]
    missing_text = "" if done == total else f"; {total - done} of {total} are not computed"
    more_text = f" and {len(empty_cells) - 3} more" if len(empty_cells) > 3 else ""
    nothing = f"nothing is computed of {format_count(len(empty_cells), 'cell')}: {', '.join(empty_cells[:3])}{more_text}"
    return [f"{study.path}: {done} chunks, all sound{missing_text}", *([nothing] if empty_cells else [])]
