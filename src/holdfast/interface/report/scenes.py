"""Projections of an arm with numbered joints, and of coloured points around it."""

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

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, styled_figure
from holdfast.interface.report.motions import draw_chain
from holdfast.interface.report.palette import INK, ORANGE, SOFT
from holdfast.interface.report.views import View


@dataclass(frozen=True)
class Scale:
    """Colour scale of values: dark is bad, bright is good, and infinite values have the colour of the end of the scale."""

    low: float
    high: float
    log: bool = False
    _: KW_ONLY
    smaller_is_better: bool = False
    pale: bool = False  # for maps with text on top

    @classmethod
    def from_values(cls, values: FloatArray, log: bool = False, smaller_is_better: bool = False) -> Scale:
        """Fit the scale to the range between the 1 % and 99 % quantiles of the finite values."""
        finite = values[np.isfinite(values)]
        lower, upper = np.quantile(finite, [0.01, 0.99]).tolist() if finite.size else (0.0, 1.0)
        log = log and lower > 0 and upper > 10 * lower
        if upper - lower <= 1e-9 * max(abs(upper), 1e-3):
            lower, upper = (lower / 2, lower * 2) if log else (lower, lower + max(abs(lower), 1.0))
        return cls(low=lower, high=upper, log=log, smaller_is_better=smaller_is_better)

    @property
    def mappable(self) -> ScalarMappable:
        """Matplotlib mappable of the scale, for colour bars and colours."""
        colors = mpl.colormaps["viridis_r" if self.smaller_is_better else "viridis"](np.linspace(0, 1, 256))
        if self.pale:
            colors = 0.68 * colors + 0.32
        colormap = ListedColormap(colors)
        norm = LogNorm(self.low, self.high) if self.log else Normalize(self.low, self.high)
        return ScalarMappable(norm, colormap)

    def colors(self, values: FloatArray) -> FloatArray:
        """Return the RGBA colours (N, 4) of values."""
        return np.asarray(self.mappable.to_rgba(np.clip(values, self.low, self.high)))

    def extend(self, values: FloatArray) -> Literal["neither", "min", "max", "both"]:
        """Return the ends of the colour bar (matplotlib's ``extend``) that some values exceed."""
        has_below, has_above = bool((values < self.low * (1 - 1e-9)).any()), bool((values > self.high * (1 + 1e-9)).any())
        return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[
            has_below, has_above
        ]  # type: ignore[return-value]


@dataclass(frozen=True)
class Scene:
    """Points, values, and a chain in space, m.

    Attributes:
        points: (N, 3) points with a value.
        values: (N,) values of the points, which determine their colours.
        missing: (M, 3) points without a value.
        chain: (K, 3) base, joints, and tool of the arm; empty if there is no arm.
        square: (K - 2,) flags of joints that are drawn as squares instead of circles.
        box: (2, 3) opposite corners of a box; None if there is none.
    """

    points: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    values: FloatArray = field(default_factory=lambda: np.zeros(0))
    missing: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    _: KW_ONLY
    chain: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    square: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    box: FloatArray | None = None

    @property
    def extent(self) -> FloatArray:
        """Lowest and highest coordinates (2, 3) of all elements."""
        everything = np.concatenate([self.points, self.missing, self.chain, *([] if self.box is None else [self.box])])
        if not len(everything):
            return np.array([[-0.5] * 3, [0.5] * 3])
        return np.array([everything.min(axis=0), everything.max(axis=0)])


def draw_view(
    axes: Axes,
    scene: Scene,
    view: View,
    scale: Scale,
    dot_area: float,
    spans: tuple[float, float],
    width: float,
    center: FloatArray | None = None,
) -> None:
    """Draw a scene in projection, with equal axes.

    The axes have the lengths ``spans``, m, and the point ``center`` (3,), m, in their middle, by default that of the scene. The
    panel is about ``width`` inches wide, and ``dot_area`` is in square points (1/72 inch).
    """
    if len(scene.missing):
        x, y = view.project(scene.missing).T
        axes.scatter(x, y, s=dot_area * 1.3, marker="x", c="#9aa1a8", linewidths=0.7, rasterized=True, zorder=2)
    if len(scene.points):
        x, y = view.project(scene.points).T
        axes.scatter(x, y, s=dot_area, c=scale.colors(scene.values), linewidths=0, alpha=0.85, rasterized=True, zorder=2.1)
    if scene.box is not None:
        (box_left, box_bottom), (box_right, box_top) = view.project(scene.box)
        axes.add_patch(
            Rectangle(
                (box_left, box_bottom),
                box_right - box_left,
                box_top - box_bottom,
                fill=False,
                edgecolor=SOFT,
                linewidth=0.9,
                linestyle=(0, (4, 2)),
                zorder=2.2,
            )
        )
    _draw_chain(axes, scene, view, 72 * width / spans[0])
    middle = view.project(scene.extent.mean(axis=0) if center is None else center)
    axes.set_xlim(middle[0] - spans[0] / 2, middle[0] + spans[0] / 2)
    axes.set_ylim(middle[1] - spans[1] / 2, middle[1] + spans[1] / 2)
    axes.set_aspect("equal")
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))


def _draw_chain(axes: Axes, scene: Scene, view: View, scale: float) -> None:
    """Draw the polyline with numbered nodes; ``scale`` is in points per metre."""
    if not len(scene.chain):
        return
    projected_chain = view.project(scene.chain)
    halo = [withStroke(linewidth=5.4, foreground="white")]
    draw_chain(axes, projected_chain, linewidth=2.8, node_size=0.0, solid_capstyle="round", path_effects=halo)
    nodes = projected_chain[1:-1]
    for marker, chosen in (("o", ~scene.square), ("s", scene.square)):
        axes.plot(*nodes[chosen].T, marker, color="white", markeredgecolor=INK, markeredgewidth=1.4, markersize=6, zorder=3.2)
    occupied = np.zeros((0, 2))
    for numbers, position in _group_near_nodes(nodes * scale, 6.0):
        text = _format_ranges(numbers)
        offset = _place_label(projected_chain * scale, occupied, position, text)
        occupied = np.vstack([occupied, position + offset])
        axes.annotate(
            text,
            tuple(position / scale),
            tuple(offset),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=9,
            color=INK,
            zorder=4,
            bbox={"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8},
        )


def _group_near_nodes(nodes: FloatArray, max_distance: float) -> list[tuple[list[int], FloatArray]]:
    """Group nodes that are close together; return their numbers from 1 and their positions."""
    clusters: list[tuple[list[int], FloatArray]] = []
    for index, node in enumerate(nodes):
        for numbers, position in clusters:
            if np.linalg.norm(node - position) < max_distance:
                numbers.append(index + 1)
                break
        else:
            clusters.append(([index + 1], node))
    return clusters


def _format_ranges(numbers: list[int]) -> str:
    """Format ``[1, 2, 3, 5]`` as ``1-3, 5``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(str(run[0]) if len(run) == 1 else f"{run[0]}{', ' if len(run) == 2 else '–'}{run[-1]}" for run in runs)


def _place_label(line: FloatArray, occupied: FloatArray, position: FloatArray, text: str) -> FloatArray:
    """Choose the offset of a label from a position, in points: the direction of sixteen with most space, preferably above."""
    steps = np.linspace(0, 1, 41)[:, None]
    line_points = np.concatenate([start + steps * (end - start) for start, end in pairwise(line)]) if len(line) > 1 else line
    half_size = np.array([2.6 * len(text) + 1, 5.0])
    best_score, offset = -np.inf, np.zeros(2)
    for angle in np.arange(16) * np.pi / 8 + np.pi / 2:
        direction = np.array([np.cos(angle), np.sin(angle)])
        # The distance must be large enough that the label does not cover the node.
        distance = 7.0 + float(np.abs(direction * half_size).max() if len(text) < 2 else np.abs(direction) @ half_size)
        label_center = position + distance * direction
        gap = np.maximum(np.abs(line_points - label_center) - half_size, 0)
        free_distance = min(float(np.hypot(*gap.T).min()), 6.0)
        if len(occupied):
            free_distance = min(
                free_distance, float(np.maximum(np.abs(occupied - label_center) - 2 * half_size, 0).sum(axis=1).min())
            )
        score = free_distance + 0.3 * direction[1] - 0.02 * distance
        if score > best_score:
            best_score, offset = score, distance * direction
    return offset


def view_figure(scene: Scene, views: Sequence[View], scale: Scale, *, label: str, legend: Sequence[tuple[str, str]]) -> Figure:
    """Plot projections side by side, all on one scale, with a colour bar if there are values.

    The legend has a kind (``dot``, ``cross``, ``box``, ``joint``, ``slide``, ``tool``, ``base``) and a text for each entry.
    """
    panel_width = 4.1 if len(views) > 1 else 5.0
    spans, height = fit_view_spans(scene.extent, views, panel_width, 2.0, 4.6 if len(views) > 1 else 5.0)
    with styled_figure(WIDTH_IN if len(views) > 1 else panel_width + 2.2, height + 1.5) as figure:
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        for axes, view in zip(panels, views, strict=True):
            draw_view(axes, scene, view, scale, choose_dot_area(scene, views, panel_width / spans[0]), spans, panel_width)
        if np.isfinite(scene.values).any():
            add_color_bar(figure, scene, scale, list(panels), label)
        figure.legend(
            handles=[_legend_entry(kind, legend_text) for kind, legend_text in legend],
            loc="outside lower center",
            ncols=min(len(legend), 4),
            columnspacing=2.0,
        )
    return figure


def add_color_bar(figure: Figure, scene: Scene, scale: Scale, axes: list[Axes], label: str) -> None:
    """Add a colour bar to the right of the axes."""
    colorbar = figure.colorbar(scale.mappable, ax=axes, extend=scale.extend(scene.values), shrink=0.85, aspect=26, pad=0.015)
    label_color_bar(colorbar, label, scale)


def label_color_bar(colorbar: Colorbar, label: str, scale: Scale) -> None:
    """Set the label and ticks of a colour bar."""
    colorbar.set_label(label)
    colorbar.outline.set_visible(False)
    if scale.log:
        colorbar.ax.yaxis.set_major_formatter(LogFormatter())
        colorbar.ax.yaxis.set_minor_formatter(NullFormatter())


def choose_dot_area(scene: Scene, views: Sequence[View], scale: float) -> float:
    """Choose the area of a dot, in square points, so that the dots cover about two thirds of their region.

    ``scale`` is the scale of the figure, inches per metre.
    """
    dots = np.concatenate([scene.points, scene.missing])
    if len(dots) < 2:
        return 28.0
    sizes = [np.ptp(view.project(dots), axis=0) * scale * 72 for view in views]
    area = min(max(across, 12.0) * max(upward, 12.0) for across, upward in sizes)
    return float(np.clip(0.85 * area / len(dots), 1.2, 28))


def fit_view_spans(
    extent: FloatArray, views: Sequence[View], width: float, min_height: float, max_height: float
) -> tuple[tuple[float, float], float]:
    """Return the lengths of the axes, m, that contain an extent (2, 3) in every view, and the height of a panel, inches."""
    across, upward = 1.2 * np.max([np.ptp(view.project(extent), axis=0) for view in views], axis=0)
    across, upward = max(across, 0.1 * upward, 1e-6), max(upward, 0.1 * across, 1e-6)
    height = float(np.clip(width * upward / across, min_height, max_height))
    if height / width < upward / across:
        across = upward * width / height
    else:
        upward = across * height / width
    return (across, upward), height


def _legend_entry(kind: str, text: str) -> Any:
    node_style = {"color": INK, "markerfacecolor": "white", "markeredgewidth": 1.4, "markersize": 6, "linewidth": 2.8}
    entry_styles: dict[str, dict[str, Any]] = {
        "dot": {"marker": "o", "color": "#21918c", "linestyle": "", "markersize": 5},
        "cross": {"marker": "x", "color": "#9aa1a8", "linestyle": "", "markersize": 5},
        "box": {"color": SOFT, "linewidth": 0.9, "linestyle": (0, (4, 2))},
        "joint": {"marker": "o", **node_style},
        "slide": {"marker": "s", **node_style},
        "tool": {"marker": "D", "color": ORANGE, "linestyle": "", "markeredgecolor": "white", "markersize": 6.5},
        "base": {"marker": "s", "color": INK, "linestyle": "", "markersize": 7.5},
    }
    return Line2D([], [], label=text, **entry_styles[kind])
