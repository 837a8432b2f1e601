"""Pages that the build writes from the code."""

from collections.abc import Mapping
from pathlib import Path


def keep(folder: Path, pages: Mapping[str, str]) -> None:
    """Write the pages by name, those alone that have changed, and remove those of before."""
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.rst"):
        if old.stem not in pages:
            old.unlink()
    for name, text in pages.items():
        path = folder / f"{name}.rst"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
