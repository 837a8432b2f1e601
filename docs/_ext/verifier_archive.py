"""The verifier's files as one archive that Python runs: ``python verifier.zip FILE``."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_MAIN = "import sys\n\nfrom verifier import main\n\nif __name__ == '__main__':\n    sys.exit(main())\n"


def zipped(file: Path) -> Path:
    """Write the archive, the same bytes from the same files."""
    source = Path(__file__).parents[2] / "src" / "holdfast" / "certificates"
    parts = [source / "verifier.py", *sorted((source / "verifier_parts").glob("*.py"))]
    texts = {str(part.relative_to(source)): part.read_text(encoding="utf-8") for part in parts} | {"__main__.py": _MAIN}
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in texts.items():
            archive.writestr(zipfile.ZipInfo(name), text, zipfile.ZIP_DEFLATED)
    return file


def write(app: Sphinx) -> None:
    """Beside the page that offers it."""
    zipped(Path(app.srcdir) / "verifier.zip")


def setup(app: Sphinx) -> dict[str, Any]:
    """Written before pages are read."""
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True}
