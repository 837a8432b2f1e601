"""Notebook view of a result: the answer, a table of its key numbers, the main figure, and suggested next calls.

Colours are those of the notebook, light or dark; only a figure brings its own white ground.
"""

from __future__ import annotations

import base64
import io
import sys
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import insert_nonbreaking_spaces
from holdfast.core.result import Presentable
from holdfast.interface.presentation import call_presenter
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# _MAX_SENTENCES, _MAX_TABLE_ROWS and _MAX_LINE_LETTERS: at most; of a line of code
_MAX_SENTENCES = 3
_MAX_TABLE_ROWS = 12
_MAX_LINE_LETTERS = 80
_PIXEL_DENSITY = 1.5  # dots for each of the screen's
_PIXELS_PER_INCH = 96  # px


def build_card(result: Presentable) -> str:
    """Return the notebook view of a result as HTML without scripts and style sheets, for the end of a cell."""
    name = _variable_name(result)
    headline, *remarks = call_presenter(result, "sentences")
    parts = [f"<p><strong>{escape(headline)}</strong></p>"]
    parts += [f"<p>{escape(remark)}</p>" for remark in remarks[: _MAX_SENTENCES - 1]]
    parts.append(_format_table(call_presenter(result, "key_table")))
    parts.append(call_presenter(result, "picture", headline))
    if next_calls := call_presenter(result, "next_steps", name):
        code = escape("\n".join(map(_format_step, next_calls)), quote=False)
        parts.append(f'<p style="margin-bottom:0">What to ask next:</p><pre><code>{code}</code></pre>')
    return f'<div class="holdfast" style="max-width:60em">{insert_nonbreaking_spaces("".join(parts), html=True)}</div>'


def _variable_name(result: Presentable) -> str:
    """Return the notebook variable that holds the result, so that suggested code runs as it is; else ``_``, the last output."""
    return next((name for name, value in list_variables() if value is result), "_")


def list_variables() -> list[tuple[str, Any]]:
    """List the public variables of the notebook with their values."""
    return [(name, value) for name, value in list(vars(sys.modules["__main__"]).items()) if not name.startswith("_")]


def _format_step(step: str) -> str:
    """Format a suggested call; its comment goes before the code where the line would be too long."""
    code, _, comment = step.partition("  # ")
    return step if len(step) <= _MAX_LINE_LETTERS or not comment else f"# {comment}\n{code}"


def _format_table(table: TextTable) -> str:
    if not table.rows:
        return ""
    header = "".join(f'<th style="text-align:left">{_escape_cell(text)}</th>' for text in table.head) if any(table.head) else ""
    rows = [
        "".join(f'<td style="text-align:left">{_escape_cell(text)}</td>' for text in row)
        for row in table.rows[:_MAX_TABLE_ROWS]
    ]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    title = f'<caption style="text-align:left">{_escape_cell(table.title)}</caption>' if table.title else ""
    omitted_rows = len(table.rows) - _MAX_TABLE_ROWS
    omission_note = f"<p>and {omitted_rows:,} more</p>" if omitted_rows > 0 else ""
    head = header and f"<thead><tr>{header}</tr></thead>"
    return f'<table style="margin-left:0">{title}{head}<tbody>{body}</tbody></table>{omission_note}'


def _escape_cell(text: str) -> str:
    return escape(text).replace("\n", "<br>")


def embed_figure(figure: Figure, about: str) -> str:
    """Return the figure as an ``<img>`` at most as wide as its cell; ``about`` is the text alternative."""
    data, size = render_png(figure)
    style_text = f"width:{size['width']:.0f}px;max-width:100%;background:white;padding:.4em;box-sizing:border-box"
    return f'<img style="{style_text}" alt="{escape(about)}" src="data:image/png;base64,{base64.b64encode(data).decode()}">'


def render_png(figure: Figure) -> tuple[bytes, dict[str, Any]]:
    """Render the figure as PNG with its size in screen pixels, as IPython requires."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from holdfast.interface.report.figures import style

    data, original_dpi = io.BytesIO(), figure.dpi
    with style():
        figure.dpi = _PIXEL_DENSITY * _PIXELS_PER_INCH
        FigureCanvasAgg(figure).print_png(data)
        figure.dpi = original_dpi
    width, height = figure.get_size_inches()
    return data.getvalue(), {"width": float(_PIXELS_PER_INCH * width), "height": float(_PIXELS_PER_INCH * height)}


def show_once(figure: Figure) -> Figure:
    """Return the figure so that a cell that ends with it shows it once, with ``%matplotlib inline`` or without."""
    vars(figure)["_repr_png_"] = partial(render_png, figure)
    return figure
