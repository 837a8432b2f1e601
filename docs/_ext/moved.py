"""Old addresses go on: ``moved`` in the configuration says where each page that has moved is now."""

from __future__ import annotations

import html
import os
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

PAGE = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>Moved</title>
<meta http-equiv="refresh" content="0; url={0}"><link rel="canonical" href="{0}">
<script>location.replace("{0}" + location.hash)</script>
<p>This page has moved to <a href="{0}">{0}</a>.</p>
</html>
"""


def write(app: Sphinx, exception: Exception | None) -> None:
    if exception is not None or app.builder.format != "html":
        return
    for old, new in app.config.moved.items():
        if new not in app.env.found_docs or old in app.env.found_docs:
            raise ExtensionError(f"'{old}' cannot lead to '{new}': the one must be gone, the other there")
        path = Path(app.outdir) / f"{old}.html"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(PAGE.format(html.escape(os.path.relpath(f"{new}.html", Path(old).parent))), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_config_value("moved", {}, "html", dict)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
