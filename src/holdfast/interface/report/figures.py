"""Figures of distributions and bars, in one style and without pyplot, as SVG text or PNG files.

Names from files must pass through :func:`format_label`, so that a dollar sign does not start a formula.
"""

from __future__ import annotations

import io
import itertools
import re
import threading
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import KW_ONLY, dataclass
from html import escape
from pathlib import Path
from typing import Any, Literal

import matplotlib.style
import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, StrMethodFormatter

from holdfast.core.files.output import replace_file
from holdfast.core.formatting import format_percent, shorten_to_one_line
from holdfast.core.progress import count_finished_part
from holdfast.core.typing import FloatArray
from holdfast.interface.report.palette import AMBER, BLUE, LIGHT_BLUE, SKY
from holdfast.interface.report.palette import GREEN as GREEN
from holdfast.interface.report.palette import INK as INK
from holdfast.interface.report.palette import ORANGE as ORANGE
from holdfast.interface.report.palette import PURPLE as PURPLE
from holdfast.interface.report.palette import SOFT as SOFT

# Up to 28 curves differ pairwise in colour, line style, or both.
CURVE_COLORS = (BLUE, ORANGE, GREEN, PURPLE, INK, AMBER, LIGHT_BLUE)
_CURVE_DASHES = ("-", (0, (4.5, 2)), (0, (1.2, 1.4)), (0, (6, 1.8, 1.2, 1.8)))
WIDTH_IN = 10.0  # inches: 960 px in a page

_FIGURE_STYLE: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["Arial", "Helvetica", "Liberation Sans", "DejaVu Sans"],
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlepad": 8.0,
    "axes.labelsize": 9.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": SOFT,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e6e9ec",
    "grid.linewidth": 0.7,
    "text.color": INK,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 9.0,
    "ytick.labelsize": 9.0,
    "legend.frameon": False,
    "legend.fontsize": 9.0,
    "figure.constrained_layout.use": True,
    "svg.fonttype": "none",
    "svg.hashsalt": "holdfast",
}
_lock = threading.RLock()


@contextmanager
def style() -> Iterator[None]:
    """Apply the figure style inside the block, regardless of the caller's matplotlib settings, which are restored after."""
    with _lock, matplotlib.style.context(["default", _FIGURE_STYLE]), warnings.catch_warnings():
        # The browser substitutes glyphs that the fonts on this machine lack.
        warnings.filterwarnings("ignore", message="Glyph .* missing", category=UserWarning)
        yield


@contextmanager
def styled_figure(width_in: float, height_in: float) -> Iterator[Figure]:
    """Create a figure of this width and height, inches, in the figure style, and settle its layout after the block."""
    with style():
        figure = Figure(figsize=(width_in, height_in))
        yield figure
        settle_layout(figure)


def format_label(text: str, max_letters: int = 60) -> str:
    """Return text that matplotlib draws literally: on one line, shortened to ``max_letters`` characters."""
    return shorten_to_one_line(text, max_letters).replace("$", r"\$")


# ---- output -----------------------------------------------------------------------------------------------------------------


def svg(figure: Figure, name: str, about: str) -> Markup:
    """Convert the figure to an ``<svg>`` element for an HTML page.

    Args:
        figure: Figure to convert.
        name: Name that is unique in the page; all ids inside begin with it.
        about: Text alternative of the figure.
    """
    buffer = io.StringIO()
    with style():
        no_metadata = dict.fromkeys(("Creator", "Date", "Format", "Type"))
        FigureCanvasSVG(figure).print_svg(buffer, metadata=no_metadata)
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<style type=\"text/css\">.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    old_ids = re.findall(r'\bid="([^"]+)"', text)
    # Elements with equal ids have equal content, so references use the first one.
    new_ids = {old_id: f"{name}-{number}" for number, old_id in reversed(list(enumerate(old_ids)))}
    numbers = itertools.count()
    text = re.sub(r'\bid="[^"]+"', lambda m: f'id="{name}-{next(numbers)}"', text)
    text = re.sub(r'(href="#|url\(#)([^")]+)', lambda m: m[1] + new_ids.get(m[2], m[2]), text)
    count_finished_part("figure")
    return Markup(text.replace("<svg ", f'<svg role="img" aria-label="{escape(about)}" ', 1).strip())


def locate_axes(axes: Axes) -> dict[str, Any]:
    """Locate the axes of a finished figure in its ``<svg>``, for scripts that draw on it.

    Returns:
        ``box``: left, top, right and bottom in units of the SVG; ``x`` and ``y``: limits of the axes; ``log``: True if the x
        axis is logarithmic.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    box = axes.get_window_extent().transformed(figure.dpi_scale_trans.inverted())
    figure_height = 72 * figure.get_figheight()
    return {
        "box": [
            round(edge, 2) for edge in (72 * box.x0, figure_height - 72 * box.y1, 72 * box.x1, figure_height - 72 * box.y0)
        ],
        "x": [float(edge) for edge in axes.get_xlim()],
        "y": [float(limit) for limit in axes.get_ylim()],
        "log": axes.get_xscale() == "log",
    }


def save_png(figure: Figure, path: str | Path, dpi: float = 100) -> Path:
    """Write the figure as a PNG file with ``dpi`` dots per inch, and return its path.

    Raises:
        StoreError: The file cannot be written.
    """
    file = Path(path)
    data, previous_dpi = io.BytesIO(), figure.dpi
    with style():
        figure.dpi = dpi  # savefig would draw the figure twice to compute its layout
        FigureCanvasAgg(figure).print_png(data)
        figure.dpi = previous_dpi  # resolution of rasterised parts if the figure is converted to SVG next
    replace_file(file, data.getvalue(), "picture")
    count_finished_part("figure")
    return file


# ---- distributions -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Curve:
    """Cumulative distribution: ``share`` (K,) at ``x`` (K,), and a band of half width ``band`` if that is above 0."""

    x: FloatArray
    share: FloatArray
    label: str
    _: KW_ONLY
    second: bool = False
    band: float = 0.0


@dataclass(frozen=True)
class Mark:
    """Vertical line at ``x`` that marks a threshold, or an upper bound of the index."""

    x: float
    label: str
    kind: Literal["threshold", "bound"] = "threshold"


@dataclass(frozen=True)
class Bin:
    """Histogram with edges (B + 1,) and heights (B,)."""

    edges: FloatArray
    heights: FloatArray
    ylabel: str


def draw_quantile_bands(axes: Axes, x: FloatArray, quantiles: FloatArray) -> None:
    """Draw the 5, 25, 50, 75 and 95 % quantiles (5, N) over ``x`` (N,) as two bands and the line of the median."""
    q05, q25, q50, q75, q95 = quantiles
    axes.fill_between(x, q05, q95, color=SKY, alpha=0.4, linewidth=0, label="5 to 95 %")
    axes.fill_between(x, q25, q75, color=SKY, linewidth=0, label="25 to 75 %")
    axes.plot(x, q50, color=BLUE, linewidth=1.9, label="median")


def draw_cdf(
    axes: Axes, curves: Sequence[Curve], marks: Sequence[Mark], *, xlabel: str, ylabel: str, log: bool = False
) -> None:
    """Draw cumulative distributions with their bands, and vertical marks, into axes; ``log`` makes the x axis logarithmic."""
    for curve in curves:
        color = ORANGE if curve.second else BLUE
        if curve.band > 0:
            lower, upper = np.clip(curve.share - curve.band, 0, 1), np.clip(curve.share + curve.band, 0, 1)
            axes.fill_between(curve.x, lower, upper, color=color, alpha=0.16, linewidth=0)
        dashes = (0, (4.5, 2)) if curve.second else "-"
        axes.plot(
            curve.x, curve.share, color=color, linewidth=1.5 if curve.second else 1.9, linestyle=dashes, label=curve.label
        )
    _draw_marks(axes, marks)
    axes.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, 1.02))
    _set_x_axis(axes, curves[0].x, log)


def draw_histogram(axes: Axes, histogram: Bin, marks: Sequence[Mark], xlabel: str, log: bool = False) -> None:
    """Draw a histogram, and vertical marks, into axes."""
    axes.stairs(histogram.heights, histogram.edges, fill=True, color=SKY)
    axes.stairs(histogram.heights, histogram.edges, color=BLUE, linewidth=0.8)
    _draw_marks(axes, marks)
    max_height = float(histogram.heights.max(initial=0.0))
    axes.set(xlabel=xlabel, ylabel=histogram.ylabel, ylim=(0, 1.05 * max_height if max_height > 0 else 1))
    _set_x_axis(axes, histogram.edges, log)


def _set_x_axis(axes: Axes, x: FloatArray, log: bool) -> None:
    if log:
        axes.set_xscale("log")
    axes.set_xlim(float(x[0]), float(x[-1]))
    axes.grid(axis="x", visible=False)


def _draw_marks(axes: Axes, marks: Sequence[Mark]) -> None:
    for mark in marks:
        dashes = (0, (1.2, 1.6)) if mark.kind == "bound" else "-"
        axes.axvline(
            mark.x,
            color=SOFT if mark.kind == "bound" else INK,
            linewidth=1.3 if mark.kind == "bound" else 1.0,
            linestyle=dashes,
            label=mark.label,
        )


def cdf_figure(curves: Sequence[Curve], marks: Sequence[Mark], xlabel: str, *, ylabel: str) -> Figure:
    """Plot cumulative distributions in one panel."""
    with styled_figure(0.8 * WIDTH_IN, 3.9) as figure:
        axes = figure.add_subplot()
        draw_cdf(axes, curves, marks, xlabel=xlabel, ylabel=ylabel)
        legend_below(figure, axes)
    return figure


def distribution_figure(
    bins: Bin,
    curves: Sequence[Curve],
    marks: Sequence[Mark],
    *,
    xlabel: str,
    ylabel: str,
    titles: tuple[str, str],
    log: bool = False,
) -> Figure:
    """Plot a histogram on the left and cumulative distributions on the right, over the same axis."""
    with styled_figure(WIDTH_IN, 3.9) as figure:
        histogram_axes, cdf_axes = figure.subplots(1, 2)
        draw_histogram(histogram_axes, bins, marks, xlabel, log)
        draw_cdf(cdf_axes, curves, marks, xlabel=xlabel, ylabel=ylabel, log=log)
        histogram_axes.set_title(titles[0])
        cdf_axes.set_title(titles[1])
        legend_below(figure, cdf_axes)
    return figure


def compare_cdf_figure(
    panels: Sequence[tuple[str, Sequence[Curve]]], marks: Sequence[Mark], xlabel: str, *, ylabel: str, log: bool = False
) -> Figure:
    """Plot many cumulative distributions without bands, one panel for each title; equal labels have the same line style."""
    labels = list(dict.fromkeys(curve.label for _, curves in panels for curve in curves))
    legend_rows = -(-(len(labels) + len(marks)) // 3)
    with styled_figure(WIDTH_IN if len(panels) > 1 else 0.75 * WIDTH_IN, 3.9 + 0.2 * legend_rows) as figure:
        all_axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for axes, (title, curves) in zip(all_axes, panels, strict=True):
            for curve in curves:
                style_index = labels.index(curve.label)
                color, dashes = CURVE_COLORS[style_index % len(CURVE_COLORS)], _CURVE_DASHES[style_index % len(_CURVE_DASHES)]
                axes.plot(
                    curve.x, curve.share, color=color, linestyle=dashes, linewidth=1.7, label=format_label(curve.label, 40)
                )
            _draw_marks(axes, marks)
            axes.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, 1.02), title=title)
            _set_x_axis(axes, curves[0].x, log)
        legend_below(figure, all_axes[0], 3)
    return figure


def legend_below(figure: Figure, axes: Axes, columns: int = 2) -> None:
    """Draw the legend of the axes below the figure, in ``columns`` columns."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=columns, columnspacing=2.5)


# ---- bars ----------------------------------------------------------------------------------------------------------------


def bar_figure(
    names: Sequence[str],
    counts: Sequence[float],
    xlabel: str,
    *,
    total: float | None = None,
    stress: Literal["most", "least"] = "most",
) -> Figure:
    """Plot horizontal bars, the first one on top, each with its count and its fraction of ``total``, by default their sum.

    The longest bar (``most``) or the shortest one (``least``) is darker. Counts that are not integers (sums of weights) are
    printed with four digits.
    """
    denominator = sum(counts) if total is None else total
    max_count = max(counts, default=0) or 1
    stressed_count = max_count if stress == "most" else min(counts)
    with styled_figure(WIDTH_IN * 0.8, 0.75 + 0.27 * len(names)) as figure:
        axes = figure.add_subplot()
        colors = [BLUE if bar_count == stressed_count else SKY for bar_count in counts]
        axes.barh(range(len(names)), counts, height=0.64, color=colors)
        texts = [f"{count:{',' if isinstance(count, int) else ',.4g'}}" for count in counts]
        fractions = [f" ({format_percent(count / denominator)})" if denominator else "" for count in counts]
        label_bars(axes, names, counts, texts=map(str.__add__, texts, fractions))
        axes.set(xlabel=xlabel, xlim=(0, max_count * 1.18))
        if all(isinstance(bar_count, int) for bar_count in counts):
            axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
            axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.spines["left"].set_visible(False)
    return figure


def label_bars(axes: Axes, names: Sequence[str], ends: Iterable[float], *, texts: Iterable[str], max_letters: int = 40) -> None:
    """Write the names next to horizontal bars, the first one on top, and a text at the end of each."""
    for position, (end, text) in enumerate(zip(ends, texts, strict=True)):
        axes.annotate(text, (end, position), (4, 0), textcoords="offset points", va="center", fontsize=9)
    axes.set_yticks(range(len(names)), [format_label(name, max_letters) for name in names])
    axes.set_ylim(len(names) - 0.45, -0.55)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)


def settle_layout(figure: Figure) -> Figure:
    """Compute the layout and the ticks of a figure while the figure style is active, and return the figure."""
    FigureCanvasAgg(figure)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)  # avoids drawing the figure, which would also compute the layout
    figure.set_layout_engine("none")  # computing the layout again would double the time
    return figure
