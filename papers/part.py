"""What a part of a paper comes to, and RESULTS.md made of the parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from papers.claims import Claim, table


@dataclass(frozen=True)
class Part:
    """Statements, sections of RESULTS.md (lines of Markdown) with numbers to reproduce, and figures: file name and title."""

    claims: list[Claim]
    sections: list[str] = field(default_factory=list)
    figures: dict[str, str] = field(default_factory=dict)


def write(folder: Path, title: str, parts: Sequence[Part]) -> None:
    """Write RESULTS.md into a paper's folder, and print it."""
    lines = [
        f"# {title}",
        "",
        f"Written by `python -m papers.{folder.name}`. Ours are measured, the paper's are cited. The specification is our own, "
        "worked out by other routes before holdfast was written; its numbers stand in for those that the paper does not print.",
        "",
        *table([claim for part in parts for claim in part.claims]),
        "",
        *[line for part in parts for line in ([*part.sections, ""] if part.sections else [])],
        *[f"![{title}](figures/{name}.png)" for part in parts for name, title in part.figures.items()],
        "",
    ]
    (folder / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))
