"""HTML page in memory, shown in a notebook or written to a file."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path

from holdfast.core.files.output import replace_file

# A page in a frame does not see its surroundings. This script tells it whether their text is light, now and on changes.
_PAGE_BACKGROUND = """
const told = () => {
  const [r, g, b] = getComputedStyle(this).color.match(/[\\d.]+/g).map(Number);
  this.contentWindow?.postMessage({ dark: r + g + b > 384 }, '*');
};
const changed = new MutationObserver(told);
for (const node of [document.documentElement, document.body]) changed.observe(node, { attributes: true });
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', told);
told();
""".replace("\n", " ").strip()


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
        return (
            f'<iframe srcdoc="{escape(self.text, quote=True)}" title="holdfast" sandbox="allow-scripts" '
            f'onload="{escape(_PAGE_BACKGROUND, quote=True)}" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Html({len(self.text):,} letters; .save(file) writes it)"
