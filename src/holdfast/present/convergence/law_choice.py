"""The best law: numbers, the laws side by side, and the map of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.convergence.law_choice import LawChoice
from holdfast.present import results
from holdfast.present.convergence import maps

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHORT = 24  # letters of a title


def to_dict(choice: LawChoice) -> dict[str, Any]:
    """The best law, and the map of each."""
    return {"best": choice.best, "laws": list(choice.names), "maps": [maps.to_dict(one) for one in choice.maps]}


def figures(choice: LawChoice) -> dict[str, Figure]:
    """``laws``: how the motions ended with each joint locked, law by law."""
    titles = [name if len(name) <= _SHORT else one.law.label for name, one in zip(choice.names, choice.maps, strict=True)]
    return {"laws": maps.outcomes_figure(choice.maps, titles)}


def save(choice: LawChoice, folder: Path, command: str = "") -> list[Path]:
    """The figure and the page, and a folder with the map of each law."""
    files = results.save(choice, folder, command, dpi=130)
    for k, one in enumerate(choice.maps):
        files += maps.save(one, folder / f"{k + 1}-{one.law.slug}")
    return files
