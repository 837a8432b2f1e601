"""Figures of motions: an arm as a stick figure at its start and end, and quantities over time with reference levels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.palette import BLUE, INK, ORANGE, SKY, SOFT
from holdfast.interface.report.timelines import LINE_COLORS
from holdfast.interface.report.views import View


@dataclass(frozen=True)
class StickMotion:
    """Chain of links over time.

    Attributes:
        chain: (F, K, 3) corners of the chain in each frame, base first and tool last, m.
        square_corners: (K,) flags of corners drawn as squares (prismatic joints).
        path: (P, 3) desired path of the tool, m.
        filled_corners: (K,) flags of corners drawn filled (locked joints); None if there are none.
        goal: (3,) position marked by a ring, m; None if there is none.
    """

    chain: FloatArray
    square_corners: NDArray[np.bool_]
    path: FloatArray
    filled_corners: NDArray[np.bool_] | None = None
    goal: FloatArray | None = None


@dataclass(frozen=True)
class TimePanel:
    """One quantity over time.

    Attributes:
        time: (T,) time, s.
        values: (T,) values of the quantity, or of several lines by name.
        ylabel: Label of the vertical axis, with the unit.
        title: Title of the panel.
        reference_level: Reference value, drawn as a horizontal line, and its label; None if there is none.
        moments: Time (s), value, and label of each marked point.
        log_scale: Use a logarithmic vertical axis.
        compared: Times and values of a second run, drawn as a thick line behind the first.
    """

    time: FloatArray
    values: FloatArray | Mapping[str, FloatArray]
    ylabel: str
    title: str
    reference_level: tuple[float, str] | None = None
    moments: tuple[tuple[float, float, str], ...] = ()
    log_scale: bool = False
    compared: tuple[FloatArray, FloatArray] | None = None


def motion_figure(
    panels: Sequence[TimePanel], caption: str, xlabel: str = "time since the failure, s", *, panel_width: float = WIDTH_IN / 2.4
) -> Figure:
    """Plot panels side by side over time, each ``panel_width`` inches wide, with one line of text below."""
    with styled_figure(panel_width * len(panels), 3.7) as figure:
        for axes, panel in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
            draw_panel(axes, panel, xlabel)
        figure.supxlabel(format_label(caption, 200), fontsize=9, color=SOFT)
    return figure


def draw_panel(axes: Axes, panel: TimePanel, xlabel: str) -> None:
    """Draw one panel."""
    if panel.compared is not None:
        axes.plot(*panel.compared, color=SKY, linewidth=4.5)
    lines = panel.values if isinstance(panel.values, Mapping) else {"": panel.values}
    colors = cycle(LINE_COLORS) if len(lines) > 1 else [BLUE]
    for color, (name, values) in zip(colors, lines.items(), strict=False):
        axes.plot(panel.time, values, color=color, linewidth=1.6 if len(lines) == 1 else 1.4, label=format_label(name) or None)
    if panel.reference_level is not None:
        axes.axhline(
            panel.reference_level[0],
            color=INK,
            linewidth=1.0,
            linestyle=(0, (4.5, 2)),
            label=format_label(panel.reference_level[1]),
        )
    if panel.reference_level is not None or any(lines):
        axes.legend(loc="best", fontsize=8 if len(lines) > 1 else None)
    for time, value, label in panel.moments:
        axes.plot([time], [value], "o", color=ORANGE, markersize=5)
        axes.annotate(format_label(label), (time, value), (6, 5), textcoords="offset points", fontsize=9, color=INK)
    axes.set(xlabel=xlabel, ylabel=panel.ylabel, title=format_label(panel.title))
    axes.set_xlim(0, float(panel.time[-1]) or 1.0)
    if panel.log_scale and any((values > 0).any() for values in lines.values()):
        axes.set_yscale("log")
    axes.margins(y=0.12)


def stick_motion_figure(
    motion: StickMotion,
    views: Sequence[View],
    panel: TimePanel,
    caption: str,
    xlabel: str,
    *,
    path_label: str = "straight path",
) -> Figure:
    """Plot a stick figure at the start (grey) and end (black) of a motion, next to one quantity over time.

    ``path_label`` is the legend entry of the desired path of the tool, which is drawn dashed.
    """
    with styled_figure(WIDTH_IN * (1.0 if len(views) == 1 else 1.4), 4.4) as figure:
        *view_axes, panel_axes = figure.subplots(1, len(views) + 1)
        for axes, view in zip(view_axes, views, strict=True):
            _draw_stick_figure(axes, motion, view, path_label)
        draw_panel(panel_axes, panel, xlabel)
        handles, labels = view_axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=len(handles), columnspacing=2.0)
        figure.supxlabel(format_label(caption, 200), fontsize=9, color=SOFT)
    return figure


def draw_chain(
    axes: Axes,
    chain: FloatArray,
    *,
    color: str = INK,
    linewidth: float = 2.6,
    squares: NDArray[np.bool_] | None = None,
    filled: NDArray[np.bool_] | None = None,
    node_size: float = 6.0,
    tool_color: str = ORANGE,
    zorder: float = 3.0,
    **line_options: Any,
) -> None:
    """Draw the projected corners (K, 2) of an arm: its base as a square, its joints as nodes, and its tool as a diamond.

    ``squares`` (K,) are flags of prismatic joints, and ``filled`` (K,) of locked joints. ``node_size`` 0 omits the nodes, and
    an empty ``tool_color`` the diamond. Widths and sizes are in points; further options are those of the lines.
    """
    axes.plot(*chain.T, color=color, linewidth=linewidth, solid_joinstyle="round", zorder=zorder, **line_options)
    is_square, is_filled = (np.zeros(len(chain), dtype=bool) if flags is None else flags for flags in (squares, filled))
    is_inner = np.r_[False, np.ones(len(chain) - 2, dtype=bool), False]
    for marker, corners in (("s", is_square), ("o", ~is_square)):
        for face, chosen in ((ORANGE, is_inner & corners & is_filled), ("white", is_inner & corners & ~is_filled)):
            if node_size and chosen.any():
                axes.plot(
                    *chain[chosen].T, marker, color=face, markeredgecolor=color, markersize=node_size, zorder=zorder + 0.2
                )
    axes.plot(*chain[0], "s", color=color, markersize=8, zorder=zorder + 0.3)
    if tool_color:
        axes.plot(*chain[-1], "D", color=tool_color, markeredgecolor="white", markersize=7, zorder=zorder + 0.5)


def show_view(axes: Axes, view: View, margin: float = 0.08) -> None:
    """Set the title and labels of a projection, with equal axes."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)
    axes.margins(margin)


def _draw_stick_figure(axes: Axes, motion: StickMotion, view: View, path_label: str) -> None:
    locked = motion.filled_corners
    for frame, color, label in ((0, "#b9c0c7", "at the start"), (-1, INK, "at the end")):
        draw_chain(
            axes,
            view.project(motion.chain[frame]),
            color=color,
            squares=motion.square_corners,
            filled=locked,
            tool_color=ORANGE if frame else "",
            zorder=3.0 if frame else 1.5,
            label=label,
        )
    axes.plot(*view.project(motion.chain[:, -1]).T, color=BLUE, linewidth=1.8, label="path of the tool", zorder=2.5)
    axes.plot(*view.project(motion.path).T, color=ORANGE, linewidth=1.1, linestyle=(0, (4, 2)), label=path_label, zorder=2.4)
    if motion.goal is not None:
        goal = view.project(motion.goal)
        axes.plot(*goal, "o", fillstyle="none", color=ORANGE, markersize=12, label="target", zorder=3.7)
    if locked is not None and locked.any():
        axes.plot([], [], "o", color=ORANGE, markeredgecolor=INK, markersize=6, label="locked")
    show_view(axes, view)
