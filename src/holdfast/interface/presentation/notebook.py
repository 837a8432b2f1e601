"""Notebook view of a result: the answer, a table of its key numbers, and the main figure.

The view uses the colours of the notebook, light or dark; only figures have a white background.
"""

from __future__ import annotations

import base64
import io
from functools import partial
from html import escape
from typing import Any

from holdfast.interface import report
from holdfast.interface.presentation.printing import TextTable

_MAX_TABLE_ROWS = 12
_PIXEL_DENSITY = 1.5  # image pixels per screen pixel
_PIXELS_PER_INCH = 96  # px


def format_table(table: TextTable) -> str:
    """Format a table as HTML, with at most twelve rows."""
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


def embed_figure(figure: report.Figure, about: str) -> str:
    """Return the figure as an ``<img>`` at most as wide as its cell; ``about`` is the text alternative."""
    data, size = render_png(figure)
    style_text = f"width:{size['width']:.0f}px;max-width:100%;background:white;padding:.4em;box-sizing:border-box"
    return f'<img style="{style_text}" alt="{escape(about)}" src="data:image/png;base64,{base64.b64encode(data).decode()}">'


def render_png(figure: report.Figure) -> tuple[bytes, dict[str, Any]]:
    """Render the figure as PNG with its size in screen pixels, as IPython requires."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    data, original_dpi = io.BytesIO(), figure.dpi
    with report.style():
        figure.dpi = _PIXEL_DENSITY * _PIXELS_PER_INCH
        FigureCanvasAgg(figure).print_png(data)
        figure.dpi = original_dpi
    width, height = figure.get_size_inches()
    return data.getvalue(), {"width": float(_PIXELS_PER_INCH * width), "height": float(_PIXELS_PER_INCH * height)}


def show_once(figure: report.Figure) -> report.Figure:
    """Return the figure, prepared so that a notebook cell shows it once, with or without ``%matplotlib inline``."""
    vars(figure)["_repr_png_"] = partial(render_png, figure)
    return figure
