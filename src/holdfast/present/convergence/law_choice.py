"""The best law: numbers, the laws side by side, and the map of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.convergence.law_choice import LawChoice
from holdfast.present import results
from holdfast.present.convergence import maps
from holdfast.present.printing import Rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHORT = 24  # letters of a title


def to_dict(choice: LawChoice) -> dict[str, Any]:
    """The best law, and the map of each."""
    return {"best": choice.best, "laws": list(choice.names), "maps": [maps.to_dict(one) for one in choice.maps]}


def key_table(choice: LawChoice) -> Rows:
    """How often each law converges, the best first."""
    found = {name: choice.share(name) for name in choice.ranking}
    rows = [[name, f"{100 * s.value:.1f} % ({100 * s.low:.1f} to {100 * s.high:.1f})"] for name, s in found.items()]
    return Rows(["law", "converges after a lock, 95 %"], rows)


def next_steps(choice: LawChoice, name: str) -> list[str]:
    """How sure the ranking is."""
    sure = [f"{name}.difference(*{name}.ranking[:2])  # how sure that is"] if len(choice.names) > 1 else []
    return [*sure, f"{name}.map_of({name}.best)"]


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
