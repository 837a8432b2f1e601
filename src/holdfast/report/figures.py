"""Figures in one quiet style, without pyplot: distributions and bars; as SVG text or PNG files.

Text that comes from files (names) goes through :func:`plain`, so that a dollar sign does not start a formula.
"""

from __future__ import annotations

import io
import itertools
import re
import threading
import warnings
from collections.abc import Iterator, Sequence
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
from numpy.typing import NDArray

from holdfast.files.output import replaced
from holdfast.notice import another
from holdfast.report.palette import AMBER as AMBER
from holdfast.report.palette import BLUE as BLUE
from holdfast.report.palette import FAINT as FAINT
from holdfast.report.palette import GREEN as GREEN
from holdfast.report.palette import INK as INK
from holdfast.report.palette import LIGHT_BLUE as LIGHT_BLUE
from holdfast.report.palette import ORANGE as ORANGE
from holdfast.report.palette import PALE as PALE
from holdfast.report.palette import PURPLE as PURPLE
from holdfast.report.palette import SKY as SKY
from holdfast.report.palette import SOFT as SOFT
from holdfast.words import on_one_line, percent

Array = NDArray[np.float64]

# Many curves at once: every pair differs in colour, line style or both, up to 28 of them.
COLORS = (BLUE, ORANGE, GREEN, PURPLE, INK, AMBER, LIGHT_BLUE)
_LINES = ("-", (0, (4.5, 2)), (0, (1.2, 1.4)), (0, (6, 1.8, 1.2, 1.8)))
WIDTH = 10.0  # inches: 960 px in a page

_STYLE: dict[str, Any] = {
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
    """The house style for figures made inside, whatever the caller's matplotlib settings are; they come back afterwards."""
    with _lock, matplotlib.style.context(["default", _STYLE]), warnings.catch_warnings():
        # A browser finds the letters of a name that the fonts here lack.
        warnings.filterwarnings("ignore", message="Glyph .* missing", category=UserWarning)
        yield


def plain(text: str, most: int = 60) -> str:
    """Text that matplotlib draws as it is, on one line, shortened to ``most`` characters."""
    return on_one_line(text, most).replace("$", r"\$")


# ---- out -----------------------------------------------------------------------------------------------------------------


def svg(figure: Figure, name: str, about: str) -> Markup:
    """The figure as an ``<svg>`` element to put in a page.

    Args:
        figure: The figure.
        name: Unique in the page; ids inside begin with it.
        about: What it shows, for people who cannot see it.
    """
    out = io.StringIO()
    with style():
        empty = dict.fromkeys(("Creator", "Date", "Format", "Type"))
        FigureCanvasSVG(figure).print_svg(out, metadata=empty)
    text = out.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<style type=\"text/css\">.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    old = re.findall(r'\bid="([^"]+)"', text)
    new = {x: f"{name}-{k}" for k, x in reversed(list(enumerate(old)))}  # equal ids have equal content: refer to the first
    numbers = itertools.count()
    text = re.sub(r'\bid="[^"]+"', lambda m: f'id="{name}-{next(numbers)}"', text)
    text = re.sub(r'(href="#|url\(#)([^")]+)', lambda m: m[1] + new.get(m[2], m[2]), text)
    another("figure")
    return Markup(text.replace("<svg ", f'<svg role="img" aria-label="{escape(about)}" ', 1).strip())


def frame(axes: Axes) -> dict[str, Any]:
    """Where the axes of a finished figure are in its ``<svg>``, for scripts that draw on it.

    Returns:
        ``box``: left, top, right and bottom in units of the SVG; ``x`` and ``y``: both ends; ``log``: the x axis is.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    box = axes.get_window_extent().transformed(figure.dpi_scale_trans.inverted())
    tall = 72 * figure.get_figheight()
    return {
        "box": [round(x, 2) for x in (72 * box.x0, tall - 72 * box.y1, 72 * box.x1, tall - 72 * box.y0)],
        "x": [float(x) for x in axes.get_xlim()],
        "y": [float(y) for y in axes.get_ylim()],
        "log": axes.get_xscale() == "log",
    }


def save_png(figure: Figure, path: str | Path, dpi: float = 100) -> Path:
    """Write the figure as PNG.

    Raises:
        StoreError: The file cannot be written.
    """
    file = Path(path)
    data, before = io.BytesIO(), figure.dpi
    with style():
        figure.dpi = dpi  # and not savefig, which would draw it once more, for its layout
        FigureCanvasAgg(figure).print_png(data)
        figure.dpi = before  # of what is rasterised if it is drawn as SVG next
    replaced(file, data.getvalue(), "picture")
    another("figure")
    return file


# ---- distributions -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Curve:
    """A cumulative distribution: ``share`` at ``x``, with a band of half width ``band`` if that is above 0."""

    x: Array
    share: Array
    label: str
    _: KW_ONLY
    second: bool = False
    band: float = 0.0


@dataclass(frozen=True)
class Mark:
    """A vertical line at ``x``: a threshold that is asked for, or a bound that cannot be passed."""

    x: float
    label: str
    kind: Literal["threshold", "bound"] = "threshold"


@dataclass(frozen=True)
class Bin:
    """A histogram: edges (B + 1,) and heights (B,)."""

    edges: Array
    heights: Array
    label: str
    _: KW_ONLY
    ylabel: str


def draw_cdf(
    axes: Axes, curves: Sequence[Curve], marks: Sequence[Mark], *, xlabel: str, ylabel: str, log: bool = False
) -> None:
    """Cumulative distributions with their bands, and marks."""
    for c in curves:
        color = ORANGE if c.second else BLUE
        if c.band > 0:
            low, high = np.clip(c.share - c.band, 0, 1), np.clip(c.share + c.band, 0, 1)
            axes.fill_between(c.x, low, high, color=color, alpha=0.16, linewidth=0)
        line = (0, (4.5, 2)) if c.second else "-"
        axes.plot(c.x, c.share, color=color, linewidth=1.5 if c.second else 1.9, linestyle=line, label=c.label)
    _marks(axes, marks)
    axes.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, 1.02))
    _x_axis(axes, curves[0].x, log)


def draw_histogram(axes: Axes, bins: Bin, marks: Sequence[Mark], xlabel: str, log: bool = False) -> None:
    """A histogram, and marks."""
    axes.stairs(bins.heights, bins.edges, fill=True, color=SKY, label=bins.label)
    axes.stairs(bins.heights, bins.edges, color=BLUE, linewidth=0.8)
    _marks(axes, marks)
    top = float(bins.heights.max(initial=0.0))
    axes.set(xlabel=xlabel, ylabel=bins.ylabel, ylim=(0, 1.05 * top if top > 0 else 1))
    _x_axis(axes, bins.edges, log)


def _x_axis(axes: Axes, x: Array, log: bool) -> None:
    if log:
        axes.set_xscale("log")
    axes.set_xlim(float(x[0]), float(x[-1]))
    axes.grid(axis="x", visible=False)


def _marks(axes: Axes, marks: Sequence[Mark]) -> None:
    for m in marks:
        line = (0, (1.2, 1.6)) if m.kind == "bound" else "-"
        axes.axvline(
            m.x,
            color=SOFT if m.kind == "bound" else INK,
            linewidth=1.3 if m.kind == "bound" else 1.0,
            linestyle=line,
            label=m.label,
        )


def cdf_figure(
    curves: Sequence[Curve],
    marks: Sequence[Mark],
    xlabel: str,
    *,
    ylabel: str,
    title: str = "",
    log: bool = False,
    width: float = 5.4,
) -> Figure:
    """Cumulative distributions alone."""
    with style():
        figure = Figure(figsize=(width, 3.9))
        axes = figure.add_subplot()
        draw_cdf(axes, curves, marks, xlabel=xlabel, ylabel=ylabel, log=log)
        axes.set_title(title)
        legend_below(figure, axes)
        return finished(figure)


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
    """A histogram on the left and cumulative distributions on the right, over the same axis."""
    with style():
        figure = Figure(figsize=(WIDTH, 3.9))
        left, right = figure.subplots(1, 2)
        draw_histogram(left, bins, marks, xlabel, log)
        draw_cdf(right, curves, marks, xlabel=xlabel, ylabel=ylabel, log=log)
        left.set_title(titles[0])
        right.set_title(titles[1])
        legend_below(figure, right)
        return finished(figure)


def compare_cdf_figure(
    panels: Sequence[tuple[str, Sequence[Curve]]],
    marks: Sequence[Mark],
    xlabel: str,
    *,
    ylabel: str,
    log: bool = False,
) -> Figure:
    """Many cumulative distributions without their bands, a panel per title.

    A curve looks the same in every panel that has its label.
    """
    labels = list(dict.fromkeys(c.label for _, curves in panels for c in curves))
    with style():
        rows = -(-(len(labels) + len(marks)) // 3)
        figure = Figure(figsize=(WIDTH if len(panels) > 1 else 0.75 * WIDTH, 3.9 + 0.2 * rows))
        every = figure.subplots(1, len(panels), squeeze=False)[0]
        for axes, (title, curves) in zip(every, panels, strict=True):
            for c in curves:
                k = labels.index(c.label)
                color, line = COLORS[k % len(COLORS)], _LINES[k % len(_LINES)]
                axes.plot(c.x, c.share, color=color, linestyle=line, linewidth=1.7, label=plain(c.label, 40))
            _marks(axes, marks)
            axes.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, 1.02), title=title)
            _x_axis(axes, curves[0].x, log)
        legend_below(figure, every[0], 3)
        return finished(figure)


def legend_below(figure: Figure, axes: Axes, columns: int = 2) -> None:
    """What the lines of the axes are, under the figure."""
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
    """Horizontal bars, first one on top, each with its count and share.

    Args:
        names: One per bar.
        counts: One per bar; sums of weights are written with four digits.
        xlabel: What is counted.
        total: What the shares are of; the sum of the counts if not given.
        stress: Which bar is drawn darker.
    """
    whole = sum(counts) if total is None else total
    most = max(counts, default=0) or 1
    dark = most if stress == "most" else min(counts)
    with style():
        figure = Figure(figsize=(WIDTH * 0.8, 0.75 + 0.27 * len(names)))
        axes = figure.add_subplot()
        rows = np.arange(len(names))
        axes.barh(rows, counts, height=0.64, color=[BLUE if c == dark else SKY for c in counts])
        for row, count in zip(rows, counts, strict=True):
            share = f" ({percent(count / whole)})" if whole else ""
            axes.annotate(
                f"{count:{',' if isinstance(count, int) else ',.4g'}}{share}",
                (count, row),
                (4, 0),
                textcoords="offset points",
                va="center",
                fontsize=9,
                color=INK,
            )
        axes.set_yticks(rows, [plain(n, 40) for n in names])
        axes.set(xlabel=xlabel, xlim=(0, most * 1.18), ylim=(len(names) - 0.45, -0.55))
        if all(isinstance(c, int) for c in counts):
            axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
            axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        return finished(figure)


def finished(figure: Figure) -> Figure:
    """With its layout settled and every tick made while the style holds."""
    FigureCanvasAgg(figure)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)  # drawing it would do the same, and then draw for nobody
    figure.set_layout_engine("none")  # it is settled: doing it again would double the time
    return figure
