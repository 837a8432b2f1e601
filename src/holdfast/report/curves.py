"""Figures of stationary points: their curves over a locked value, and the basins around them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, SOFT, WIDTH, finished, plain, style

Array = NDArray[np.float64]

# Colour, line width, line style and marker of each kind; sinks stand out.
KINDS: dict[str, tuple[str, float, Literal["-", "--", ":"], str]] = {
    "solution": (GREEN, 1.6, "-", "o"),
    "sink": (ORANGE, 3.0, "-", "v"),
    "saddle": (BLUE, 1.3, "-", "X"),
    "source": (PURPLE, 1.3, "--", "^"),
    "degenerate": (INK, 1.3, ":", "s"),
}
_REACHED = "#e3f1ec"
# Of basins: pale, and told apart by hue and by lightness.
_ARRIVES = ("#bfe3d6", "#7fb8a8", "#d9edf9", "#93c4e3", "#f3e3b3", "#dcc46f")
_STUCK = ("#f4c7ab", "#e39a6f", "#f7dccb", "#c98058")
_OTHER = {"moving": "#c9a3bb", "undecided": "#d4d9de", "target": "#bfe3d6", "stuck": "#f4c7ab"}


@dataclass(frozen=True)
class RestLine:
    """A stretch of stationary points of one kind.

    Attributes:
        kind: A key of :data:`KINDS`.
        x: (K,) the locked value.
        y: One (K,) per panel.
    """

    kind: str
    x: Array
    y: Sequence[Array]


def curves_over(
    lines: Sequence[RestLine],
    dots: Sequence[RestLine],
    ylabels: Sequence[str],
    xlabel: str,
    limits: tuple[float, float],
    reached: Sequence[tuple[float, float]],
    caption: str,
) -> Figure:
    """Curves of stationary points over the locked value, a panel for each quantity.

    Args:
        lines: Stretches of curves.
        dots: Points that make no curve.
        ylabels: One per panel.
        xlabel: The locked value.
        limits: Of the locked value.
        reached: Locked values at which the target can be reached, shaded.
        caption: One line below.
    """
    with style():
        figure = Figure(figsize=(WIDTH, 0.9 + 2.5 * len(ylabels)))
        panels = np.atleast_1d(figure.subplots(len(ylabels), 1, sharex=True))
        for p, (axes, ylabel) in enumerate(zip(panels, ylabels, strict=True)):
            for low, high in reached:
                axes.axvspan(low, high, color=_REACHED, linewidth=0, zorder=0)
            for line in lines:
                color, width, dashes, _ = KINDS[line.kind]
                axes.plot(*_broken(line.x, line.y[p]), color=color, linewidth=width, linestyle=dashes)
            for dot in dots:
                color, _, _, marker = KINDS[dot.kind]
                axes.plot(dot.x, dot.y[p], marker, color=color, markersize=2.5, linestyle="none", alpha=0.7)
            axes.set(ylabel=ylabel, xlim=limits)
            if p and ylabel.endswith("deg"):
                axes.set_ylim(-180, 180)
                axes.yaxis.set_major_locator(MultipleLocator(60))
        panels[-1].set_xlabel(xlabel)
        if xlabel.endswith("deg"):
            panels[-1].xaxis.set_major_locator(MultipleLocator(30))
        present = [k for k in KINDS if any(x.kind == k for x in (*lines, *dots))]
        handles: list[Line2D | Patch] = [
            Line2D([], [], color=KINDS[k][0], linewidth=KINDS[k][1], linestyle=KINDS[k][2], label=k) for k in present
        ]
        if reached:
            handles.append(Patch(color=_REACHED, label="target within reach"))
        figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)


def basin_map(
    cells: NDArray[np.int64],
    names: Sequence[str],
    extent: tuple[float, float, float, float],
    points: Sequence[tuple[str, float, float, str]],
    lines: Sequence[tuple[Array, Array]],
    labels: tuple[str, str],
    caption: str,
) -> Figure:
    """Basins over two joints: cells coloured by where their centre ends, with stationary points and basin boundaries.

    Args:
        cells: (A, B) index into ``names`` of each cell, first axis to the right.
        names: What starts end at; ``solution 1`` for example.
        extent: Of the cells: left, right, lower, upper.
        points: Kind, place and name of each stationary point.
        lines: Boundaries.
        labels: Of the axes.
        caption: One line below.
    """
    colors = _basin_colors(names)
    with style():
        figure = Figure(figsize=(7.4, 6.6))
        axes = figure.add_subplot()
        image = np.array([to_rgb(c) for c in colors])[cells.T]
        axes.imshow(image, origin="lower", extent=extent, aspect="auto", interpolation="nearest")
        for line in lines:
            axes.plot(*_broken(*line, extent[1] - extent[0]), color=INK, linewidth=0.9)
        for kind, x, y, name in points:
            color, _, _, marker = KINDS[kind]
            axes.plot([x], [y], marker, color=color, markersize=8, markeredgecolor="white", markeredgewidth=1.0)
            if name in names:
                axes.annotate(plain(name), (x, y), (7, 6), textcoords="offset points", fontsize=9, color=INK)
        axes.grid(visible=False)
        axes.set(xlabel=labels[0], ylabel=labels[1], xlim=extent[:2], ylim=extent[2:])
        handles: list[Line2D | Patch] = [Patch(color=c, label=plain(n)) for c, n in zip(colors, names, strict=True)]
        unnamed = sorted({kind for kind, _, _, name in points if name not in names})
        handles += [Line2D([], [], marker=KINDS[k][3], color=KINDS[k][0], linestyle="none", label=k) for k in unnamed]
        if lines:
            handles.append(Line2D([], [], color=INK, linewidth=0.9, label="into a saddle"))
        figure.legend(handles=handles, loc="outside upper center", ncols=min(len(handles), 5))
        for axis, label in zip((axes.xaxis, axes.yaxis), labels, strict=True):
            if label.endswith("deg"):
                axis.set_major_locator(MultipleLocator(60))
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)


def share_bars(names: Sequence[str], shares: Sequence[tuple[float, float, float]], caption: str) -> Figure:
    """Shares of starts, each ``(value, low, high)``, as bars with their confidence intervals."""
    with style():
        figure = Figure(figsize=(WIDTH * 0.8, 1.2 + 0.32 * len(names)))
        axes: Axes = figure.add_subplot()
        rows = np.arange(len(names))
        value, low, high = (100 * np.array(x) for x in zip(*shares, strict=True))
        axes.barh(rows, value, height=0.6, color=_basin_colors(names), edgecolor=FAINT)
        axes.errorbar(value, rows, xerr=[value - low, high - value], fmt="none", ecolor=INK, elinewidth=1.0, capsize=3)
        for row, v, top in zip(rows, value, high, strict=True):
            axes.annotate(f"{v:.1f} %", (top, row), (6, 0), textcoords="offset points", va="center", fontsize=9)
        axes.set_yticks(rows, [plain(n, 40) for n in names])
        axes.set(xlabel="fraction of starts, %", xlim=(0, 112), ylim=(len(names) - 0.45, -0.55))
        axes.grid(axis="y", visible=False)
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)


def _basin_colors(names: Sequence[str]) -> list[str]:
    good, bad = iter(_ARRIVES * 50), iter(_STUCK * 50)
    out = []
    for name in names:
        word = name.split()[0]
        out.append(next(good) if word == "solution" else _OTHER[word] if word in _OTHER else next(bad))
    return out


def _broken(x: Array, y: Array, turn: float = 360.0) -> tuple[Array, Array]:
    """Lines that do not run across the figure where a value comes round."""
    jumps = np.flatnonzero((np.abs(np.diff(x)) > 0.5 * turn) | (np.abs(np.diff(y)) > 0.5 * turn)) + 1
    return np.insert(x, jumps, np.nan), np.insert(y, jumps, np.nan)
