"""No line of a page ends between a number and its unit."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

from holdfast.interface.report import insert_nonbreaking_spaces

AS_THEY_ARE = (nodes.FixedTextElement, nodes.literal, nodes.math, nodes.math_block, nodes.raw, nodes.Invisible)


def hold(app: Sphinx, tree: nodes.document) -> None:
    """Texts for people; what is to be copied stays as it is."""
    for text in list(tree.findall(nodes.Text)):
        above = text.parent
        while above is not None and not isinstance(above, AS_THEY_ARE):
            above = above.parent
        held = insert_nonbreaking_spaces(str(text))
        if above is None and held != text:
            text.parent.replace(text, nodes.Text(held))


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("doctree-read", hold)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
