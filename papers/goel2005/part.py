"""What a part of the paper comes to."""

from __future__ import annotations

from dataclasses import dataclass, field

from papers.claims import Claim


@dataclass(frozen=True)
class Part:
    """Statements, sections of RESULTS.md (lines of Markdown) with numbers to reproduce, and figures: file name and title."""

    claims: list[Claim]
    sections: list[str] = field(default_factory=list)
    figures: dict[str, str] = field(default_factory=dict)
