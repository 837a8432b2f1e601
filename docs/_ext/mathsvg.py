"""Equations as inline SVG, drawn by matplotlib while the pages are built.

They need no network, no script and no font on the reader's side. (MathML was tried: where a browser finds no font with
an OpenType MATH table it draws the root of a fraction over its numerator only, which is another formula.)
"""

from __future__ import annotations

import html
import re
from functools import cache
from typing import Any

import matplotlib as mpl
from docutils import nodes
from matplotlib.path import Path
from matplotlib.textpath import TextToPath
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.math import get_node_equation_number

SIZE = 100.0  # units of the drawing per em
# TeX that matplotlib spells otherwise.
SPELLING = ((r"\\text\{", r"\\mathrm{"), (r"\\le(?![a-z])", r"\\leq"), (r"\\ge(?![a-z])", r"\\geq"))
LETTERS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C", Path.CLOSEPOLY: "Z"}


@cache
def draw(latex: str, block: bool) -> str:
    """One equation as an SVG element whose baseline is that of the text around it."""
    text = " ".join(latex.split())
    for pattern, replacement in SPELLING:
        text = re.sub(pattern, replacement, text)
    if block:
        text = re.sub(r"\\frac(?![a-z])", r"\\dfrac", text)
    with mpl.rc_context({"mathtext.fontset": "cm", "svg.fonttype": "path"}):
        font = mpl.font_manager.FontProperties(size=SIZE)
        writer = TextToPath()
        writer.FONT_SCALE = SIZE
        try:
            width, height, depth = writer.get_text_width_height_descent(f"${text}$", font, ismath=True)
            vertices, codes = writer.get_text_path(font, f"${text}$", ismath=True)
        except ValueError as error:
            raise ExtensionError(f"the equation '{latex}' cannot be drawn: {error}") from error
    pieces = []
    for points, code in Path(vertices, codes).iter_segments(simplify=False, curves=True):
        pairs = " ".join(f"{x:.1f} {height - depth - y:.1f}" for x, y in points.reshape(-1, 2))
        pieces.append(LETTERS[code] + ("" if code == Path.CLOSEPOLY else pairs))
    label = html.escape(latex, quote=True)
    em = "{:.3f}em".format
    return (
        f'<svg class="equation" role="img" aria-label="{label}" viewBox="-2 -2 {width + 4:.1f} {height + 4:.1f}" '
        f'style="width:{em((width + 4) / SIZE)};height:{em((height + 4) / SIZE)};vertical-align:-{em((depth + 2) / SIZE)}">'
        f'<title>{label}</title><path d="{"".join(pieces)}"/></svg>'
    )


def inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(f'<span class="math">{draw(node.astext(), False)}</span>')
    raise nodes.SkipNode


def display(translator: Any, node: nodes.math_block) -> None:
    translator.body.append(translator.starttag(node, "div", CLASS="math-block"))
    translator.body.append(f"<span>{draw(node.astext(), True)}</span>")
    if node["number"]:
        translator.body.append(f'<span class="eqno">({get_node_equation_number(translator, node)})</span>')
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_html_math_renderer("svg", inline_renderers=(inline, None), block_renderers=(display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
