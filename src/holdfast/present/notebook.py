"""How a notebook shows a thing: the answer, a table of its key numbers, the main figure, and what to ask next.

Colours are those of the notebook, light or dark; only a figure brings its own white ground.
"""

from __future__ import annotations

import base64
import io
import sys
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any

from holdfast.present.printing import Rows
from holdfast.result import Shown
from holdfast.words import together

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SENTENCES, _ROWS, _LETTERS = 3, 12, 80  # at most; of a line of code
_SHARPER = 1.5  # dots for each of the screen's
_INCH = 96  # px


def card(thing: Shown) -> str:
    """It as HTML without scripts and styles of its own, for the end of a cell."""
    name = _called(thing)
    first, *others = thing._presented("sentences")
    parts = [f"<p><strong>{escape(first)}</strong></p>"]
    parts += [f"<p>{escape(line)}</p>" for line in others[: _SENTENCES - 1]]
    parts.append(_table(thing._presented("key_table")))
    parts.append(thing._presented("picture", first))
    if steps := thing._presented("next_steps", name):
        code = escape("\n".join(map(_lines, steps)), quote=False)
        parts.append(f'<p style="margin-bottom:0">What to ask next:</p><pre><code>{code}</code></pre>')
    return f'<div class="holdfast" style="max-width:60em">{together("".join(parts), html=True)}</div>'


def _called(thing: Shown) -> str:
    """The variable that holds it, so that what is suggested runs as it is; else ``_``, the last output of a notebook."""
    return next((name for name, value in variables() if value is thing), "_")


def variables() -> list[tuple[str, Any]]:
    """Those of the notebook, with what they hold."""
    return [(name, value) for name, value in list(vars(sys.modules["__main__"]).items()) if not name.startswith("_")]


def _lines(step: str) -> str:
    """Code with what it is for, which comes before it where a line would be too long."""
    code, _, about = step.partition("  # ")
    return step if len(step) <= _LETTERS or not about else f"# {about}\n{code}"


def _table(table: Rows) -> str:
    if not table.rows:
        return ""
    head = "".join(f'<th style="text-align:left">{_cell(x)}</th>' for x in table.head) if any(table.head) else ""
    rows = ["".join(f'<td style="text-align:left">{_cell(x)}</td>' for x in row) for row in table.rows[:_ROWS]]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    title = f'<caption style="text-align:left">{_cell(table.title)}</caption>' if table.title else ""
    rest = len(table.rows) - _ROWS
    more = f"<p>and {rest:,} more</p>" if rest > 0 else ""
    return (
        f'<table style="margin-left:0">{title}{head and f"<thead><tr>{head}</tr></thead>"}<tbody>{body}</tbody></table>{more}'
    )


def _cell(text: str) -> str:
    return escape(text).replace("\n", "<br>")


def image(figure: Figure, about: str) -> str:
    """The figure as an ``<img>`` as wide as its cell at most; ``about`` is for people who cannot see it."""
    data, size = png(figure)
    look = f"width:{size['width']:.0f}px;max-width:100%;background:white;padding:.4em;box-sizing:border-box"
    return f'<img style="{look}" alt="{escape(about)}" src="data:image/png;base64,{base64.b64encode(data).decode()}">'


def png(figure: Figure) -> tuple[bytes, dict[str, Any]]:
    """The figure as PNG with its size in pixels of the screen, as IPython asks for it."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from holdfast.report.figures import style

    data, before = io.BytesIO(), figure.dpi
    with style():
        figure.dpi = _SHARPER * _INCH
        FigureCanvasAgg(figure).print_png(data)
        figure.dpi = before
    width, height = figure.get_size_inches()
    return data.getvalue(), {"width": float(_INCH * width), "height": float(_INCH * height)}


def shown_alone(figure: Figure) -> Figure:
    """The figure, which a cell that ends with it shows once: with ``%matplotlib inline`` as that does, else by itself."""
    vars(figure)["_repr_png_"] = partial(png, figure)
    return figure
