"""Figures in one quiet style, without pyplot: distributions, bars, projected views, maps; as SVG text or PNG files.

Text that comes from files (names) goes through :func:`plain`, so that a dollar sign does not start a formula.
"""

from __future__ import annotations

import io
import re
import threading
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from html import escape
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import matplotlib.style
import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Colormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogFormatter, MaxNLocator, NullFormatter, StrMethodFormatter
from numpy.typing import NDArray

from holdfast.errors import StoreError
from holdfast.report.words import percent

Array = NDArray[np.float64]

INK, SOFT, FAINT = "#1b1f24", "#59636e", "#d4d9de"
BLUE, ORANGE, SKY = "#0a5c9e", "#c8500a", "#a9cbe6"  # after Okabe and Ito, darkened for thin lines
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
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return (line if len(line) <= most else line[: most - 1] + "…").replace("$", r"\$")


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
        FigureCanvasSVG(figure).print_svg(out, metadata=empty)  # type: ignore[no-untyped-call]
    text = out.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<style type=\"text/css\">.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    new = {old: f"{name}-{k}" for k, old in enumerate(dict.fromkeys(re.findall(r'\bid="([^"]+)"', text)))}
    text = re.sub(r'\bid="([^"]+)"', lambda m: f'id="{new[m[1]]}"', text)
    text = re.sub(r'(href="#|url\(#)([^")]+)', lambda m: m[1] + new.get(m[2], m[2]), text)
    return Markup(text.replace("<svg ", f'<svg role="img" aria-label="{escape(about)}" ', 1).strip())


def save_png(figure: Figure, path: str | Path, dpi: float = 100) -> Path:
    """Write the figure as PNG.

    Raises:
        StoreError: The file cannot be written.
    """
    file = Path(path)
    data = io.BytesIO()
    with style():
        FigureCanvasAgg(figure)
        figure.savefig(data, format="png", dpi=dpi)
    try:
        file.write_bytes(data.getvalue())
    except OSError as error:
        raise StoreError(f"cannot write picture '{file}': {error.strerror or error}; choose another path") from error
    return file


# ---- distributions -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Curve:
    """A cumulative distribution: ``share`` at ``x``, with a band of half width ``band`` if that is above 0."""

    x: Array
    share: Array
    label: str
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
    ylabel: str


def draw_cdf(axes: Axes, curves: Sequence[Curve], marks: Sequence[Mark], xlabel: str, ylabel: str, log: bool = False) -> None:
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
    ylabel: str,
    title: str = "",
    log: bool = False,
    width: float = 5.4,
) -> Figure:
    """Cumulative distributions alone."""
    with style():
        figure = Figure(figsize=(width, 3.9))
        axes = figure.add_subplot()
        draw_cdf(axes, curves, marks, xlabel, ylabel, log)
        axes.set_title(title)
        legend_below(figure, axes)
        return finished(figure)


def distribution_figure(
    bins: Bin,
    curves: Sequence[Curve],
    marks: Sequence[Mark],
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
        draw_cdf(right, curves, marks, xlabel, ylabel, log)
        left.set_title(titles[0])
        right.set_title(titles[1])
        legend_below(figure, right)
        return finished(figure)


def legend_below(figure: Figure, axes: Axes, columns: int = 2) -> None:
    """What the lines of the axes are, under the figure."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=columns, columnspacing=2.5)


# ---- bars ----------------------------------------------------------------------------------------------------------------


def bar_figure(names: Sequence[str], counts: Sequence[int], xlabel: str, total: int | None = None) -> Figure:
    """Horizontal bars, first one on top, each with its count and share.

    Args:
        names: One per bar.
        counts: One per bar.
        xlabel: What is counted.
        total: What the shares are of; the sum of the counts if not given.
    """
    whole = sum(counts) if total is None else total
    most = max([1, *counts])
    with style():
        figure = Figure(figsize=(WIDTH * 0.8, 0.75 + 0.27 * len(names)))
        axes = figure.add_subplot()
        rows = np.arange(len(names))
        axes.barh(rows, counts, height=0.64, color=[BLUE if c == most else SKY for c in counts])
        for row, count in zip(rows, counts, strict=True):
            share = f" ({percent(count / whole)})" if whole else ""
            axes.annotate(
                f"{count:,}{share}", (count, row), (4, 0), textcoords="offset points", va="center", fontsize=9, color=INK
            )
        axes.set_yticks(rows, [plain(n, 40) for n in names])
        axes.set(xlabel=xlabel, xlim=(0, most * 1.18), ylim=(len(names) - 0.45, -0.55))
        axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        return finished(figure)


# ---- views and maps --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Scale:
    """Colours of values: dark is bad, bright is good, infinite values take the colour of the end."""

    low: float
    high: float
    log: bool = False
    smaller_is_better: bool = False

    @classmethod
    def of(cls, values: Array, log: bool = False, smaller_is_better: bool = False) -> Scale:
        """The range of the finite values, without the outermost 1 % at either end."""
        finite = values[np.isfinite(values)]
        low, high = np.quantile(finite, [0.01, 0.99]).tolist() if finite.size else (0.0, 1.0)
        log = log and low > 0 and high > 10 * low
        if high - low <= 1e-9 * max(abs(high), 1e-3):
            low, high = (low / 2, low * 2) if log else (low, low + max(abs(low), 1.0))
        return cls(low, high, log, smaller_is_better)

    @property
    def mappable(self) -> ScalarMappable:
        """For colour bars and colours."""
        name = "viridis_r" if self.smaller_is_better else "viridis"
        cmap: Colormap = matplotlib.colormaps[name]
        norm = LogNorm(self.low, self.high) if self.log else Normalize(self.low, self.high)
        return ScalarMappable(norm, cmap)

    def colors(self, values: Array) -> Array:
        """(N, 4) RGBA."""
        return np.asarray(self.mappable.to_rgba(np.clip(values, self.low, self.high)))

    def extend(self, values: Array) -> Literal["neither", "min", "max", "both"]:
        """Which ends of a colour bar have values beyond."""
        below, above = bool((values < self.low * (1 - 1e-9)).any()), bool((values > self.high * (1 + 1e-9)).any())
        return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[below, above]  # type: ignore[return-value]


@dataclass(frozen=True)
class View:
    """A projection: which of x, y, z (0, 1, 2) go to the right and up, and its title."""

    right: int
    up: int
    title: str


@dataclass(frozen=True)
class Scene:
    """Things in space, m.

    Attributes:
        points: (N, 3) with a value each.
        values: (N,)
        missing: (M, 3) points without a value.
        chain: (K, 3) corners of a polyline, or empty.
        nodes: (J, 3) marked and numbered from 1.
        square: (J,) nodes drawn as squares instead of circles.
        box: (2, 3) opposite corners, or None.
    """

    points: Array
    values: Array
    missing: Array
    chain: Array = field(default_factory=lambda: np.zeros((0, 3)))
    nodes: Array = field(default_factory=lambda: np.zeros((0, 3)))
    square: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    box: Array | None = None

    @property
    def extent(self) -> Array:
        """(2, 3) lowest and highest coordinates of everything."""
        parts = [self.points, self.missing, self.chain, self.nodes, *([] if self.box is None else [self.box])]
        everything = np.concatenate(parts)
        if not len(everything):
            return np.array([[-0.5] * 3, [0.5] * 3])
        return np.array([everything.min(axis=0), everything.max(axis=0)])


_AXES = "xyz"


def draw_view(
    axes: Axes, scene: Scene, view: View, scale: Scale, size: float, spans: tuple[float, float], width: float
) -> None:
    """A scene in projection, axes equal.

    Args:
        axes: Where to draw.
        scene: What.
        view: From where.
        scale: Colours of the values.
        size: Of a dot, points squared.
        spans: Lengths of the two axes, m.
        width: Of the panel, inches, about.
    """
    pick = [view.right, view.up]
    if len(scene.missing):
        x, y = scene.missing[:, pick].T
        axes.scatter(x, y, s=size * 1.3, marker="x", c="#9aa1a8", linewidths=0.7, rasterized=True, zorder=2)
    if len(scene.points):
        x, y = scene.points[:, pick].T
        axes.scatter(x, y, s=size, c=scale.colors(scene.values), linewidths=0, alpha=0.85, rasterized=True, zorder=2.1)  # type: ignore[arg-type]
    if scene.box is not None:
        (x0, y0), (x1, y1) = scene.box[:, pick]
        axes.add_patch(
            Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=SOFT, linewidth=0.9, linestyle=(0, (4, 2)), zorder=2.2)
        )
    _draw_chain(axes, scene, pick, 72 * width / spans[0])
    middle = scene.extent.mean(axis=0)[pick]
    axes.set_xlim(middle[0] - spans[0] / 2, middle[0] + spans[0] / 2)
    axes.set_ylim(middle[1] - spans[1] / 2, middle[1] + spans[1] / 2)
    axes.set_aspect("equal")
    axes.set(xlabel=f"{_AXES[view.right]}, m", ylabel=f"{_AXES[view.up]}, m", title=view.title)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))


def _draw_chain(axes: Axes, scene: Scene, pick: list[int], scale: float) -> None:
    """The polyline with numbered nodes; ``scale`` is points per metre."""
    if not len(scene.chain):
        return
    line = scene.chain[:, pick]
    halo = [withStroke(linewidth=5.4, foreground="white")]
    axes.plot(
        line[:, 0],
        line[:, 1],
        color=INK,
        linewidth=2.8,
        solid_capstyle="round",
        solid_joinstyle="round",
        zorder=3,
        path_effects=halo,
    )
    axes.plot(*line[0], marker="s", color=INK, markersize=8.5, zorder=3.1)
    axes.plot(*line[-1], marker="D", color=ORANGE, markeredgecolor="white", markersize=6, zorder=3.5)
    nodes = scene.nodes[:, pick]
    for shape, chosen in (("o", ~scene.square), ("s", scene.square)):
        axes.plot(
            nodes[chosen, 0],
            nodes[chosen, 1],
            shape,
            color="white",
            markeredgecolor=INK,
            markeredgewidth=1.4,
            markersize=6,
            zorder=3.2,
        )
    taken = np.zeros((0, 2))
    for numbers, place in _clusters(nodes * scale, 6.0):
        text = _ranges(numbers)
        offset = _aside(line * scale, taken, place, text)
        taken = np.vstack([taken, place + offset])
        axes.annotate(
            text,
            tuple(place / scale),
            tuple(offset),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=9,
            color=INK,
            zorder=4,
            bbox={"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8},
        )


def _clusters(nodes: Array, near: float) -> list[tuple[list[int], Array]]:
    """Numbers from 1 of nodes that fall together, and where."""
    found: list[tuple[list[int], Array]] = []
    for k, p in enumerate(nodes):
        for numbers, place in found:
            if np.linalg.norm(p - place) < near:
                numbers.append(k + 1)
                break
        else:
            found.append(([k + 1], p))
    return found


def _ranges(numbers: list[int]) -> str:
    """``[1, 2, 3, 5]`` as ``1-3, 5``."""
    parts: list[list[int]] = []
    for k in numbers:
        if parts and k == parts[-1][-1] + 1:
            parts[-1].append(k)
        else:
            parts.append([k])
    return ", ".join(str(p[0]) if len(p) == 1 else f"{p[0]}{', ' if len(p) == 2 else '–'}{p[-1]}" for p in parts)


def _aside(line: Array, taken: Array, place: Array, text: str) -> Array:
    """Offset, points, of a text next to a place: of sixteen directions the one with most room, above rather than below."""
    steps = np.linspace(0, 1, 41)[:, None]
    ink = np.concatenate([a + steps * (b - a) for a, b in pairwise(line)]) if len(line) > 1 else line
    half = np.array([2.6 * len(text) + 1, 5.0])
    best, offset = -np.inf, np.zeros(2)
    for angle in np.arange(16) * np.pi / 8 + np.pi / 2:
        towards = np.array([np.cos(angle), np.sin(angle)])
        # Far enough for the box of the text to clear the node.
        reach = 7.0 + float(np.abs(towards * half).max() if len(text) < 2 else np.abs(towards) @ half)
        at = place + reach * towards
        gap = np.maximum(np.abs(ink - at) - half, 0)
        room = min(float(np.hypot(*gap.T).min()), 6.0)
        if len(taken):
            room = min(room, float(np.maximum(np.abs(taken - at) - 2 * half, 0).sum(axis=1).min()))
        score = room + 0.3 * towards[1] - 0.02 * reach
        if score > best:
            best, offset = score, reach * towards
    return offset


def view_figure(scene: Scene, views: Sequence[View], scale: Scale, label: str, legend: Sequence[tuple[str, str]]) -> Figure:
    """Projections side by side, all to one scale, with a colour bar if there are values.

    Args:
        scene: What is seen.
        views: One panel each.
        scale: Colours of the values.
        label: Of the colour bar.
        legend: Pairs of a kind (``dot``, ``cross``, ``box``, ``joint``, ``slide``, ``tool``, ``base``) and its text.
    """
    with style():
        panel = 4.1 if len(views) > 1 else 5.0
        spans, height = view_spans(scene, views, panel, 2.0, 4.6 if len(views) > 1 else 5.0)
        figure = Figure(figsize=(WIDTH if len(views) > 1 else panel + 2.2, height + 1.5))
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        for axes, view in zip(panels, views, strict=True):
            draw_view(axes, scene, view, scale, dot_size(scene, views, panel / spans[0]), spans, panel)
        if np.isfinite(scene.values).any():
            bar(figure, scene, scale, list(panels), label)
        figure.legend(
            handles=[_key(k, t) for k, t in legend], loc="outside lower center", ncols=min(len(legend), 4), columnspacing=2.0
        )
        return finished(figure)


def bar(figure: Figure, scene: Scene, scale: Scale, axes: list[Axes], label: str) -> None:
    """A colour bar to the right of the axes."""
    b = figure.colorbar(scale.mappable, ax=axes, extend=scale.extend(scene.values), shrink=0.85, aspect=26, pad=0.015)
    _finish_bar(b, label, scale)


def _finish_bar(b: Colorbar, label: str, scale: Scale) -> None:
    b.set_label(label)
    b.outline.set_visible(False)
    if scale.log:
        b.ax.yaxis.set_major_formatter(LogFormatter())
        b.ax.yaxis.set_minor_formatter(NullFormatter())


def dot_size(scene: Scene, views: Sequence[View], scale: float) -> float:
    """Area of a dot, points squared, so that dots cover about two thirds of where they are.

    Args:
        scene: With the dots.
        views: All of them.
        scale: Inches per metre.
    """
    dots = np.concatenate([scene.points, scene.missing])
    if len(dots) < 2:
        return 28.0
    size = np.ptp(dots, axis=0) * scale * 72
    area = min(max(size[v.right], 12.0) * max(size[v.up], 12.0) for v in views)
    return float(np.clip(0.85 * area / len(dots), 1.2, 28))


def view_spans(
    scene: Scene, views: Sequence[View], width: float, least: float, most: float
) -> tuple[tuple[float, float], float]:
    """Lengths of the axes, m, that hold the scene in every view, and the height of a panel, inches."""
    size = np.diff(scene.extent, axis=0)[0]
    across = max(float(size[v.right]) for v in views) * 1.2
    upward = max(float(size[v.up]) for v in views) * 1.2
    across, upward = max(across, 0.1 * upward, 1e-6), max(upward, 0.1 * across, 1e-6)
    height = float(np.clip(width * upward / across, least, most))
    if height / width < upward / across:
        across = upward * width / height
    else:
        upward = across * height / width
    return (across, upward), height


def _key(kind: str, text: str) -> Any:
    from matplotlib.lines import Line2D

    looks: dict[str, dict[str, Any]] = {
        "dot": {"marker": "o", "color": "#21918c", "linestyle": "", "markersize": 5},
        "cross": {"marker": "x", "color": "#9aa1a8", "linestyle": "", "markersize": 5},
        "box": {"color": SOFT, "linewidth": 0.9, "linestyle": (0, (4, 2))},
        "joint": {
            "marker": "o",
            "color": INK,
            "markerfacecolor": "white",
            "markeredgewidth": 1.4,
            "markersize": 6,
            "linewidth": 2.8,
        },
        "slide": {
            "marker": "s",
            "color": INK,
            "markerfacecolor": "white",
            "markeredgewidth": 1.4,
            "markersize": 6,
            "linewidth": 2.8,
        },
        "tool": {"marker": "D", "color": ORANGE, "linestyle": "", "markeredgecolor": "white", "markersize": 6.5},
        "base": {"marker": "s", "color": INK, "linestyle": "", "markersize": 7.5},
    }
    return Line2D([], [], label=text, **looks[kind])


def map_figure(
    points: Array,
    values: Array,
    missing: Array,
    views: Sequence[View],
    log: bool,
    smaller_is_better: bool,
    label: str,
    bins: int = 6,
) -> Figure:
    """The value over a projection: per cell the mean (the median if smaller is better), and how many points have one.

    Args:
        points: (N, 3) with a value each, m.
        values: (N,)
        missing: (M, 3) points without a value.
        views: One panel each.
        log: Colours on a log scale.
        smaller_is_better: Reverses the colours; medians instead of means.
        label: Of the colour bar.
        bins: Cells along the longer edge.
    """
    everything = np.concatenate([points, missing])
    low, high = everything.min(axis=0), everything.max(axis=0)
    grids = [_grid(points, values, missing, v, low, high, bins, smaller_is_better) for v in views]
    cells = np.concatenate([g[2].ravel() for g in grids])
    scale = Scale.of(cells[~np.isnan(cells)], log, smaller_is_better)
    with style():
        tall = max(float((high - low)[v.up] / (high - low)[v.right]) for v in views)
        figure = Figure(figsize=(WIDTH if len(views) > 1 else 6.2, float(np.clip(4.0 * tall, 1.6, 4.6)) + 0.8))
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        for axes, view, (x, y, mean, reached, drawn) in zip(panels, views, grids, strict=True):
            _draw_cells(axes, x, y, mean, reached, drawn, scale, len(missing) > 0)
            axes.set(xlabel=f"{_AXES[view.right]}, m", ylabel=f"{_AXES[view.up]}, m", title=view.title)
        b = figure.colorbar(scale.mappable, ax=list(panels), shrink=0.85, aspect=26, pad=0.015, extend=scale.extend(cells))
        _finish_bar(b, label, scale)
        return finished(figure)


def _grid(
    points: Array, values: Array, missing: Array, view: View, low: Array, high: Array, bins: int, median: bool
) -> tuple[Array, Array, Array, Array, Array]:
    pick = [view.right, view.up]
    size = (high - low)[pick]
    count = np.maximum(np.round(bins * size / size.max()), 1).astype(int)
    x, y = (np.linspace(low[a], high[a], n + 1) for a, n in zip(pick, count, strict=True))

    def place(p: Array) -> NDArray[np.int64]:
        at = np.minimum(((p[:, pick] - low[pick]) / size * count).astype(np.int64), count - 1)
        return np.asarray(at[:, 1] * count[0] + at[:, 0])

    cell, lost = place(points), place(missing)
    total = int(count.prod())
    reached = np.bincount(cell, minlength=total)
    drawn = reached + np.bincount(lost, minlength=total)
    order = np.argsort(cell, kind="stable")
    groups = np.split(values[order], np.cumsum(reached)[:-1])
    average = np.array([np.nan if not len(g) else float(np.median(g) if median else np.mean(g)) for g in groups])
    shape = (count[1], count[0])
    return x, y, average.reshape(shape), reached.reshape(shape), drawn.reshape(shape)


def _draw_cells(axes: Axes, x: Array, y: Array, mean: Array, reached: Array, drawn: Array, scale: Scale, lost: bool) -> None:
    colors = scale.colors(np.nan_to_num(mean, nan=scale.low, posinf=scale.high))
    colors[np.isnan(mean)] = (0.93, 0.94, 0.95, 1)
    axes.pcolormesh(x, y, colors, edgecolors="white", linewidth=1.2)  # type: ignore[arg-type]
    axes.set_aspect("equal")
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_xticks(x, [f"{round(v, 2) + 0.0:.2f}".replace("-", "−") for v in x])
    axes.set_yticks(y, [f"{round(v, 2) + 0.0:.2f}".replace("-", "−") for v in y])
    axes.tick_params(length=0, pad=6)
    for i, j in np.ndindex(mean.shape):
        middle = ((x[j] + x[j + 1]) / 2, (y[i] + y[i + 1]) / 2)
        luminance = float(colors[i, j, :3] ** 2.2 @ [0.2126, 0.7152, 0.0722])
        color = INK if luminance > 0.18 else "white"
        if not np.isnan(mean[i, j]):
            text = "∞" if np.isinf(mean[i, j]) else _short(float(mean[i, j]))
            axes.annotate(text, middle, (0, 5), textcoords="offset points", ha="center", va="center", fontsize=9, color=color)
        if drawn[i, j]:
            text = f"{reached[i, j]}/{drawn[i, j]}" if lost else f"{drawn[i, j]}"
            axes.annotate(text, middle, (0, -6), textcoords="offset points", ha="center", va="center", fontsize=7, color=color)


def _short(value: float) -> str:
    if abs(value) < 1e-9:
        return "0"
    return (
        f"{value:.2f}"
        if 0.01 <= abs(value) < 10
        else f"{value:.2g}"
        if abs(value) < 0.01
        else f"{value:.0f}"
        if abs(value) < 1e4
        else f"{value:.0e}"
    )


def finished(figure: Figure) -> Figure:
    """With its layout settled and every tick made while the style holds."""
    FigureCanvasAgg(figure)
    figure.draw_without_rendering()
    return figure
