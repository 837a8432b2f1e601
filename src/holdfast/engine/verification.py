"""Whether the chunks of studies are as they were written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from holdfast.engine.state import Damage
from holdfast.engine.study import Study
from holdfast.engine.work import Progress
from holdfast.errors import StoreError
from holdfast.result import Result
from holdfast.words import counted


@dataclass(frozen=True, kw_only=True)
class Verification(Result):
    """What verifying found.

    Attributes:
        studies: Those that were read, as they are now.
        damage: What is damaged of each.
    """

    studies: tuple[Study, ...]
    damage: tuple[tuple[Damage, ...], ...]

    def describe(self) -> list[str]:
        """For each study what is damaged; or that it is sound, and what was not there to be read."""
        lines = []
        for study, found in zip(self.studies, self.damage, strict=True):
            lines += [f"{study.path}: {_sentence(d)}" for d in found] or _sound(study)
        return lines

    def to_dict(self) -> dict[str, Any]:
        """What is damaged; chunks from 1."""
        return {
            "damaged": [
                {"folder": str(study.path), "cell": d.cell, "chunk": None if d.chunk is None else d.chunk + 1, "what": d.what}
                for study, found in zip(self.studies, self.damage, strict=True)
                for d in found
            ]
        }

    def require_ok(self) -> Self:
        """Itself, if nothing is damaged.

        Raises:
            StoreError: Something is.
        """
        count = sum(map(len, self.damage))
        if count:
            raise StoreError(
                f"{counted(count, 'damaged chunk')}, missing from now on; 'holdfast study run' computes them again"
            )
        return self


def verify(folders: Sequence[str | Path], progress: Progress | None = None) -> Verification:
    """:meth:`Study.verify` of each folder.

    Args:
        folders: Of the studies.
        progress: Called after every chunk.

    Raises:
        StoreError: A folder is no study, another program is at work in it, or it is not writable.
    """
    studies = tuple(Study.open(folder) for folder in folders)
    return Verification(studies=studies, damage=tuple(tuple(study.verify(progress)) for study in studies))


def _sentence(d: Damage) -> str:
    which = f"cell '{d.cell}' is lost" if d.chunk is None else f"chunk {d.chunk + 1} of cell '{d.cell}' is damaged"
    return f"{which}: {d.what}"


def _sound(study: Study) -> list[str]:
    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    rest = "" if done == total else f"; {total - done} of {total} are not computed"
    empty = [s.name for s in cells if not s.chunks_done]
    more = f" and {len(empty) - 3} more" if len(empty) > 3 else ""
    nothing = f"nothing is computed of {counted(len(empty), 'cell')}: {', '.join(empty[:3])}{more}"
    return [f"{study.path}: {done} chunks, all sound{rest}", *([nothing] if empty else [])]
