"""Things in space, in projection: a chain with numbered nodes and coloured points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from itertools import pairwise
from typing import Any, Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogFormatter, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from holdfast.report.figures import INK, ORANGE, SOFT, WIDTH, finished, style
from holdfast.report.views import View

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Scale:
    """Colours of values: dark is bad, bright is good, infinite values take the colour of the end."""

    low: float
    high: float
    log: bool = False
    _: KW_ONLY
    smaller_is_better: bool = False
    pale: bool = False  # for text on top

    @classmethod
    def of(cls, values: Array, log: bool = False, smaller_is_better: bool = False) -> Scale:
        """The range of the finite values, without the outermost 1 % at either end."""
        finite = values[np.isfinite(values)]
        low, high = np.quantile(finite, [0.01, 0.99]).tolist() if finite.size else (0.0, 1.0)
        log = log and low > 0 and high > 10 * low
        if high - low <= 1e-9 * max(abs(high), 1e-3):
            low, high = (low / 2, low * 2) if log else (low, low + max(abs(low), 1.0))
        return cls(low=low, high=high, log=log, smaller_is_better=smaller_is_better)

    @property
    def mappable(self) -> ScalarMappable:
        """For colour bars and colours."""
        colors = mpl.colormaps["viridis_r" if self.smaller_is_better else "viridis"](np.linspace(0, 1, 256))
        if self.pale:
            colors = 0.68 * colors + 0.32
        cmap = ListedColormap(colors)
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
    _: KW_ONLY
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
    if len(scene.missing):
        x, y = view.of(scene.missing).T
        axes.scatter(x, y, s=size * 1.3, marker="x", c="#9aa1a8", linewidths=0.7, rasterized=True, zorder=2)
    if len(scene.points):
        x, y = view.of(scene.points).T
        axes.scatter(x, y, s=size, c=scale.colors(scene.values), linewidths=0, alpha=0.85, rasterized=True, zorder=2.1)
    if scene.box is not None:
        (x0, y0), (x1, y1) = view.of(scene.box)
        axes.add_patch(
            Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=SOFT, linewidth=0.9, linestyle=(0, (4, 2)), zorder=2.2)
        )
    _draw_chain(axes, scene, view, 72 * width / spans[0])
    middle = view.of(scene.extent.mean(axis=0))
    axes.set_xlim(middle[0] - spans[0] / 2, middle[0] + spans[0] / 2)
    axes.set_ylim(middle[1] - spans[1] / 2, middle[1] + spans[1] / 2)
    axes.set_aspect("equal")
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))


def _draw_chain(axes: Axes, scene: Scene, view: View, scale: float) -> None:
    """The polyline with numbered nodes; ``scale`` is points per metre."""
    if not len(scene.chain):
        return
    line = view.of(scene.chain)
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
    nodes = view.of(scene.nodes)
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


def view_figure(scene: Scene, views: Sequence[View], scale: Scale, *, label: str, legend: Sequence[tuple[str, str]]) -> Figure:
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
            color_bar(figure, scene, scale, list(panels), label)
        figure.legend(
            handles=[_key(k, t) for k, t in legend], loc="outside lower center", ncols=min(len(legend), 4), columnspacing=2.0
        )
        return finished(figure)


def color_bar(figure: Figure, scene: Scene, scale: Scale, axes: list[Axes], label: str) -> None:
    """A colour bar to the right of the axes."""
    b = figure.colorbar(scale.mappable, ax=axes, extend=scale.extend(scene.values), shrink=0.85, aspect=26, pad=0.015)
    finish_bar(b, label, scale)


def finish_bar(b: Colorbar, label: str, scale: Scale) -> None:
    """Label and ticks of a colour bar."""
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
    sizes = [np.ptp(view.of(dots), axis=0) * scale * 72 for view in views]
    area = min(max(across, 12.0) * max(upward, 12.0) for across, upward in sizes)
    return float(np.clip(0.85 * area / len(dots), 1.2, 28))


def view_spans(
    scene: Scene, views: Sequence[View], width: float, least: float, most: float
) -> tuple[tuple[float, float], float]:
    """Lengths of the axes, m, that hold the scene in every view, and the height of a panel, inches."""
    across, upward = 1.2 * np.max([np.ptp(view.of(scene.extent), axis=0) for view in views], axis=0)
    across, upward = max(across, 0.1 * upward, 1e-6), max(upward, 0.1 * across, 1e-6)
    height = float(np.clip(width * upward / across, least, most))
    if height / width < upward / across:
        across = upward * width / height
    else:
        upward = across * height / width
    return (across, upward), height


def _key(kind: str, text: str) -> Any:
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
