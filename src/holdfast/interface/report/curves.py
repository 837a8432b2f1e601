"""Figures of stationary points: their curves as functions of the locked value, and their basins."""

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

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.palette import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, SOFT

# Colour, line width, line style and marker of each kind; sinks stand out.
KIND_STYLES: dict[str, tuple[str, float, Literal["-", "--", ":"], str]] = {
    "solution": (GREEN, 1.6, "-", "o"),
    "sink": (ORANGE, 3.0, "-", "v"),
    "saddle": (BLUE, 1.3, "-", "X"),
    "source": (PURPLE, 1.3, "--", "^"),
    "degenerate": (INK, 1.3, ":", "s"),
}
_REACHABLE_COLOR = "#e3f1ec"
# Pale colours of basins, which differ in hue and lightness.
_SOLUTION_COLORS = ("#bfe3d6", "#7fb8a8", "#d9edf9", "#93c4e3", "#f3e3b3", "#dcc46f")
_STUCK_COLORS = ("#f4c7ab", "#e39a6f", "#f7dccb", "#c98058")
_OUTCOME_COLORS = {"moving": "#c9a3bb", "undecided": "#d4d9de", "target": "#bfe3d6", "stuck": "#f4c7ab"}


@dataclass(frozen=True)
class StationaryCurve:
    """Connected piece of a curve of stationary points of one kind.

    Attributes:
        kind: Kind of the stationary points, a key of :data:`KIND_STYLES`.
        locked_values: (K,) locked value of the joint, in the unit of the axis.
        panel_values: (K,) values of each panel.
    """

    kind: str
    locked_values: FloatArray
    panel_values: Sequence[FloatArray]


def stationary_curves_figure(
    curves: Sequence[StationaryCurve],
    isolated_points: Sequence[StationaryCurve],
    ylabels: Sequence[str],
    xlabel: str,
    limits: tuple[float, float],
    reachable_intervals: Sequence[tuple[float, float]],
    caption: str,
) -> Figure:
    """Plot the curves of stationary points as functions of the locked value, one panel for each quantity.

    Args:
        curves: Pieces of curves.
        isolated_points: Points that do not belong to a curve.
        ylabels: Label of the vertical axis of each panel, with the unit.
        xlabel: Label of the axis of the locked value, with the unit.
        limits: Lower and upper end of the axis of the locked value.
        reachable_intervals: Intervals of locked values for which the target is within reach; they are shaded.
        caption: Line below the figure.
    """
    with styled_figure(WIDTH_IN, 0.9 + 2.5 * len(ylabels)) as figure:
        panels = np.atleast_1d(figure.subplots(len(ylabels), 1, sharex=True))
        for panel, (axes, ylabel) in enumerate(zip(panels, ylabels, strict=True)):
            for lower, upper in reachable_intervals:
                axes.axvspan(lower, upper, color=_REACHABLE_COLOR, linewidth=0, zorder=0)
            for curve in curves:
                color, width, dashes, _ = KIND_STYLES[curve.kind]
                axes.plot(
                    *_break_at_angle_wraps(curve.locked_values, curve.panel_values[panel]),
                    color=color,
                    linewidth=width,
                    linestyle=dashes,
                )
            for point in isolated_points:
                color, _, _, marker = KIND_STYLES[point.kind]
                axes.plot(
                    point.locked_values,
                    point.panel_values[panel],
                    marker,
                    color=color,
                    markersize=2.5,
                    linestyle="none",
                    alpha=0.7,
                )
            axes.set(ylabel=ylabel, xlim=limits)
            if panel and ylabel.endswith("deg"):
                axes.set_ylim(-180, 180)
                axes.yaxis.set_major_locator(MultipleLocator(60))
        panels[-1].set_xlabel(xlabel)
        if xlabel.endswith("deg"):
            panels[-1].xaxis.set_major_locator(MultipleLocator(30))
        present_kinds = [kind for kind in KIND_STYLES if any(element.kind == kind for element in (*curves, *isolated_points))]
        handles: list[Line2D | Patch] = [
            Line2D(
                [], [], color=KIND_STYLES[kind][0], linewidth=KIND_STYLES[kind][1], linestyle=KIND_STYLES[kind][2], label=kind
            )
            for kind in present_kinds
        ]
        if reachable_intervals:
            handles.append(Patch(color=_REACHABLE_COLOR, label="target within reach"))
        figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
        figure.supxlabel(format_label(caption, 200), fontsize=9, color=SOFT)
    return figure


def basin_map_figure(
    cells: NDArray[np.int64],
    names: Sequence[str],
    extent: tuple[float, float, float, float],
    points: Sequence[tuple[str, float, float, str]],
    lines: Sequence[tuple[FloatArray, FloatArray]],
    labels: tuple[str, str],
    caption: str,
) -> Figure:
    """Plot the basins over two joints: the colour of a cell is the outcome of a motion that starts at its centre.

    Args:
        cells: (A, B) index into ``names`` of the outcome of each cell; the first axis points to the right.
        names: Names of the outcomes, for example ``solution 1``.
        extent: Left, right, lower, and upper edge of the cells, in the units of the axes.
        points: Kind, coordinates, and name of each stationary point.
        lines: Coordinates (K,) and (K,) of each basin boundary.
        labels: Labels of the axes, with units.
        caption: Line below the figure.
    """
    colors = _choose_basin_colors(names)
    with styled_figure(7.4, 6.6) as figure:
        axes = figure.add_subplot()
        image = np.array([to_rgb(cell_color) for cell_color in colors])[cells.T]
        axes.imshow(image, origin="lower", extent=extent, aspect="auto", interpolation="nearest")
        for boundary in lines:
            axes.plot(*_break_at_angle_wraps(*boundary, extent[1] - extent[0]), color=INK, linewidth=0.9)
        for kind, x, y, name in points:
            color, _, _, marker = KIND_STYLES[kind]
            axes.plot([x], [y], marker, color=color, markersize=8, markeredgecolor="white", markeredgewidth=1.0)
            if name in names:
                axes.annotate(format_label(name), (x, y), (7, 6), textcoords="offset points", fontsize=9, color=INK)
        axes.grid(visible=False)
        axes.set(xlabel=labels[0], ylabel=labels[1], xlim=extent[:2], ylim=extent[2:])
        handles: list[Line2D | Patch] = [
            Patch(color=cell_color, label=format_label(basin)) for cell_color, basin in zip(colors, names, strict=True)
        ]
        unnamed = sorted({kind for kind, _, _, name in points if name not in names})
        handles += [
            Line2D([], [], marker=KIND_STYLES[kind][3], color=KIND_STYLES[kind][0], linestyle="none", label=kind)
            for kind in unnamed
        ]
        if lines:
            handles.append(Line2D([], [], color=INK, linewidth=0.9, label="basin boundary (into a saddle)"))
        figure.legend(handles=handles, loc="outside upper center", ncols=min(len(handles), 5))
        for axis, label in zip((axes.xaxis, axes.yaxis), labels, strict=True):
            if label.endswith("deg"):
                axis.set_major_locator(MultipleLocator(60))
        figure.supxlabel(format_label(caption, 200), fontsize=9, color=SOFT)
    return figure


def basin_fraction_figure(names: Sequence[str], fractions: Sequence[tuple[float, float, float]], caption: str) -> Figure:
    """Plot fractions of initial configurations, each ``(value, low, high)``, as bars with their confidence intervals."""
    with styled_figure(WIDTH_IN * 0.8, 1.2 + 0.32 * len(names)) as figure:
        axes: Axes = figure.add_subplot()
        positions = np.arange(len(names))
        percentages, lower, upper = (100 * np.array(column) for column in zip(*fractions, strict=True))
        axes.barh(positions, percentages, height=0.6, color=_choose_basin_colors(names), edgecolor=FAINT)
        axes.errorbar(
            percentages,
            positions,
            xerr=[percentages - lower, upper - percentages],
            fmt="none",
            ecolor=INK,
            elinewidth=1.0,
            capsize=3,
        )
        for position, percentage, bar_end in zip(positions, percentages, upper, strict=True):
            axes.annotate(
                f"{percentage:.1f} %", (bar_end, position), (6, 0), textcoords="offset points", va="center", fontsize=9
            )
        axes.set_yticks(positions, [format_label(name, 40) for name in names])
        axes.set(xlabel="fraction of start configurations, %", xlim=(0, 112), ylim=(len(names) - 0.45, -0.55))
        axes.grid(axis="y", visible=False)
        figure.supxlabel(format_label(caption, 200), fontsize=9, color=SOFT)
    return figure


def _choose_basin_colors(names: Sequence[str]) -> list[str]:
    solution_colors, stuck_colors = iter(_SOLUTION_COLORS * 50), iter(_STUCK_COLORS * 50)
    colors = []
    for name in names:
        outcome = name.split()[0]
        colors.append(
            next(solution_colors)
            if outcome == "solution"
            else _OUTCOME_COLORS[outcome]
            if outcome in _OUTCOME_COLORS
            else next(stuck_colors)
        )
    return colors


def _break_at_angle_wraps(x: FloatArray, y: FloatArray, period: float = 360.0) -> tuple[FloatArray, FloatArray]:
    """Insert NaN where a value wraps around, so that no line crosses the figure."""
    jumps = np.flatnonzero((np.abs(np.diff(x)) > 0.5 * period) | (np.abs(np.diff(y)) > 0.5 * period)) + 1
    return np.insert(x, jumps, np.nan), np.insert(y, jumps, np.nan)
