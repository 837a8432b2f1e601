"""Check that the chunks of studies are unchanged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from holdfast.core.errors import StoreError
from holdfast.core.formatting import format_count
from holdfast.core.result import Result
from holdfast.core.sweeps.state import DamagedChunk
from holdfast.core.sweeps.study import Study
from holdfast.core.sweeps.work import Progress


@dataclass(frozen=True, kw_only=True)
class StudyVerification(Result):
    """Result of the verification of studies.

    Attributes:
        studies: Those that were read, as they are now.
        damage: What is damaged of each.
    """

    studies: tuple[Study, ...]
    damage: tuple[tuple[DamagedChunk, ...], ...]

    def describe(self) -> list[str]:
        """Return for each study its damage, or that it is sound and which chunks are missing."""
        lines = []
        for study, damage in zip(self.studies, self.damage, strict=True):
            lines += [f"{study.path}: {_describe_damage(d)}" for d in damage] or _describe_undamaged_study(study)
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
            StoreError: Something is.
        """
        count = sum(map(len, self.damage))
        if count:
            raise StoreError(
                f"{format_count(count, 'damaged chunk')}, missing from now on; 'holdfast study run' computes them again"
            )
        return self


def verify_studies(folders: Sequence[str | Path], progress: Progress | None = None) -> StudyVerification:
    """Call :meth:`Study.verify` for each folder.

    Args:
        folders: Of the studies.
        progress: Called after every chunk.

    Raises:
        StoreError: A folder is no study, another program is at work in it, or it is not writable.
    """
    studies = tuple(Study.open(folder) for folder in folders)
    return StudyVerification(studies=studies, damage=tuple(tuple(study.verify(progress)) for study in studies))


def _describe_damage(d: DamagedChunk) -> str:
    which = f"cell '{d.cell}' is lost" if d.chunk is None else f"chunk {d.chunk + 1} of cell '{d.cell}' is damaged"
    return f"{which}: {d.what}"


def _describe_undamaged_study(study: Study) -> list[str]:
    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    missing_text = "" if done == total else f"; {total - done} of {total} are not computed"
    empty_cells = [s.name for s in cells if not s.chunks_done]
    more_text = f" and {len(empty_cells) - 3} more" if len(empty_cells) > 3 else ""
    nothing = f"nothing is computed of {format_count(len(empty_cells), 'cell')}: {', '.join(empty_cells[:3])}{more_text}"
    return [f"{study.path}: {done} chunks, all sound{missing_text}", *([nothing] if empty_cells else [])]
