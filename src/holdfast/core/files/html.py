"""HTML page in memory, shown in a notebook or written to a file."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path

from holdfast.core.files.output import replace_file

# A page in a frame cannot see where it lies: it is told whether the text around it is light, now and when that changes.
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
        height: Of its frame in a notebook, pixels.
    """

    text: str
    height: int = 700

    def to_html(self) -> str:
        """Return the text of the page."""
        return self.text

    def save(self, file: str | Path) -> Path:
        """Write the page.

        Raises:
            StoreError: It cannot be written; what was there is as it was.
        """
        path = Path(file)
        replace_file(path, self.text, "page")
        return path

    def _repr_html_(self) -> str:
        """The page in a frame of its own, so that it takes nothing from a notebook but whether it is dark."""
        return (
            f'<iframe srcdoc="{escape(self.text, quote=True)}" title="holdfast" sandbox="allow-scripts" '
            f'onload="{escape(_PAGE_BACKGROUND, quote=True)}" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Html({len(self.text):,} letters; .save(file) writes it)"
