"""The sidebar, written directly: two levels, and below them only what leads to the page shown.

The theme would write every page into every page and read it again with an HTML parser, which is more than half of the time
that writing takes when each class has a page.
"""

from __future__ import annotations

import html
from collections.abc import Iterator
from itertools import count
from typing import Any

from sphinx import addnodes
from sphinx.application import Sphinx

LEVELS = 2
TOGGLE = (
    '<input aria-label="Toggle navigation of {1}" class="toctree-checkbox" id="toctree-checkbox-{0}" '
    'name="toctree-checkbox-{0}" role="switch" type="checkbox"{2}/><label for="toctree-checkbox-{0}"><span class="icon"><svg>'
    '<use href="#svg-arrow-right"></use></svg></span></label>'
)


def branch(app: Sphinx, page: str, shown: str, current: set[str], level: int, number: Iterator[int]) -> str:
    """The pages below a page as a list of links, with the theme's toggles."""
    items = []
    for toctree in app.env.tocs[page].findall(addnodes.toctree):
        for title, child in toctree["entries"]:
            name = html.escape(title or app.env.titles[child].astext())
            link = html.escape(app.builder.get_relative_uri(shown, child) or "#")
            classes = [f"toctree-l{level}", *["current"] * (child in current), *["current-page"] * (child == shown)]
            below = branch(app, child, shown, current, level + 1, number) if level < LEVELS or child in current else ""
            if below:
                classes.append("has-children")
                below = TOGGLE.format(next(number), name, ' checked=""' if child in current else "") + below
            anchor = f'<a class="{"current " if child == shown else ""}reference internal" href="{link}">{name}</a>'
            items.append(f'<li class="{" ".join(classes)}">{anchor}{below}</li>')
    return f"<ul>{''.join(items)}</ul>" if items else ""


def before(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """The theme's own way finds nothing to do."""
    context["toctree"] = lambda **_: ""


def after(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    parents = {child: above for above, below in app.env.toctree_includes.items() for child in below}
    current, at = {page}, page
    while (at := parents.get(at, "")) and at not in current:
        current.add(at)
    context["furo_navigation_tree"] = branch(app, app.config.root_doc, page, current, 1, count(1))


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("html-page-context", before, priority=100)
    app.connect("html-page-context", after, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
