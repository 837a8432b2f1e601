"""A paper's statements beside ours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Claim:
    """One row of the comparison."""

    where: str
    paper: str
    ours: str
    why: str


def table(claims: Sequence[Claim]) -> list[str]:
    """The lines of a table in Markdown."""
    return [
        "| where | paper | ours | difference and why |",
        "|---|---|---|---|",
        *[f"| {c.where} | {c.paper} | {c.ours} | {c.why} |" for c in claims],
    ]
