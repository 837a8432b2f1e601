"""A page that is held in memory: what a notebook shows, and what is written into a file."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path

from holdfast.files.output import replaced


@dataclass(frozen=True)
class Html:
    """One page that needs nothing else: no server, no network, no other file.

    Attributes:
        text: The page.
        height: Of its frame in a notebook, pixels.
    """

    text: str
    height: int = 700

    def to_html(self) -> str:
        """The page as text."""
        return self.text

    def save(self, file: str | Path) -> Path:
        """Write the page.

        Raises:
            StoreError: It cannot be written; what was there is as it was.
        """
        path = Path(file)
        replaced(path, self.text, "page")
        return path

    def _repr_html_(self) -> str:
        """The page in a frame of its own, so that it takes nothing from a notebook and gives nothing to it."""
        return (
            f'<iframe srcdoc="{escape(self.text, quote=True)}" title="holdfast" sandbox="allow-scripts" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Html({len(self.text):,} letters; .save(file) writes it)"
