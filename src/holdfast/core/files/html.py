"""HTML page in memory, shown in a notebook or written to a file."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path

from holdfast.core.files.output import replace_file


@dataclass(frozen=True)
class Html:
    """Self-contained page that needs no server, network, or other file.

    Attributes:
        text: The page.
        height: Height of the frame in a notebook, pixels.
    """

    text: str
    height: int = 700

    def to_html(self) -> str:
        """Return the text of the page."""
        return self.text

    def save(self, file: str | Path) -> Path:
        """Write the page to ``file`` and return its path.

        Raises:
            StoreError: The file cannot be written; an existing file is unchanged.
        """
        path = Path(file)
        replace_file(path, self.text, "page")
        return path

    def _repr_html_(self) -> str:
        """Return the page in its own frame, so that it takes nothing from the notebook except whether the notebook is dark."""
        # A page in a frame does not see its surroundings. The script tells it whether their text is light, now and on changes.
        script = " ".join(Path(__file__).with_name("page_background.js").read_text(encoding="utf-8").splitlines())
        return (
            f'<iframe srcdoc="{escape(self.text, quote=True)}" title="holdfast" sandbox="allow-scripts" '
            f'onload="{escape(script, quote=True)}" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Html({len(self.text):,} letters; .save(file) writes it)"
