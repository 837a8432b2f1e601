"""Figures of motions: a chain of links at its start and end; over time, lines with levels to compare them to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, INK, ORANGE, SOFT, WIDTH, finished, plain, style
from holdfast.report.views import View

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """A chain of links over time.

    Attributes:
        chain: (F, K, 3) corners of the chain, base first and tool last, m.
        square: (K,) corners drawn as squares.
        path: (P, 3) where the tool was to be, m.
        marked: (K,) corners that are drawn filled at the end, or None.
        goal: (3,) a place marked by a ring, m, or None.
    """

    chain: Array
    square: NDArray[np.bool_]
    path: Array
    marked: NDArray[np.bool_] | None = None
    goal: Array | None = None


@dataclass(frozen=True)
class Panel:
    """One quantity over time.

    Attributes:
        time: (T,) s.
        values: (T,) the quantity.
        ylabel: What it is, with its unit.
        title: One line.
        level: A value to compare it to, drawn across, and what that is; None if there is none.
        moments: Times (s) and values of points picked out, each with a label.
        log: On a logarithmic scale.
    """

    time: Array
    values: Array
    ylabel: str
    title: str
    level: tuple[float, str] | None = None
    moments: tuple[tuple[float, float, str], ...] = ()
    log: bool = False


def motion_figure(panels: Sequence[Panel], caption: str, xlabel: str = "time since the failure, s") -> Figure:
    """Panels side by side over time, with one line of text below that says what was computed."""
    with style():
        figure = Figure(figsize=(WIDTH * len(panels) / 2.4, 3.7))
        for axes, panel in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
            draw_panel(axes, panel, xlabel)
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)


def draw_panel(axes: Axes, panel: Panel, xlabel: str) -> None:
    """One panel."""
    axes.plot(panel.time, panel.values, color=BLUE, linewidth=1.6)
    if panel.level is not None:
        axes.axhline(panel.level[0], color=INK, linewidth=1.0, linestyle=(0, (4.5, 2)), label=plain(panel.level[1]))
        axes.legend(loc="best")
    for t, value, label in panel.moments:
        axes.plot([t], [value], "o", color=ORANGE, markersize=5)
        axes.annotate(plain(label), (t, value), (6, 5), textcoords="offset points", fontsize=9, color=INK)
    axes.set(xlabel=xlabel, ylabel=panel.ylabel, title=plain(panel.title))
    axes.set_xlim(0, float(panel.time[-1]) or 1.0)
    if panel.log and (panel.values > 0).any():
        axes.set_yscale("log")
    axes.margins(y=0.12)


def drawn_motion(
    motion: Motion, views: Sequence[View], panel: Panel, caption: str, xlabel: str, *, wanted: str = "straight way"
) -> Figure:
    """A stick figure in projection, at its start (grey) and its end (black), beside one quantity over time.

    The path of the motion, dashed, is what the tool was ``wanted`` to do.
    """
    with style():
        figure = Figure(figsize=(WIDTH * (1.0 if len(views) == 1 else 1.4), 4.4))
        *left, right = figure.subplots(1, len(views) + 1)
        for axes, view in zip(left, views, strict=True):
            _draw_view(axes, motion, view, wanted)
        draw_panel(right, panel, xlabel)
        handles, labels = left[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=len(handles), columnspacing=2.0)
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)


def _draw_view(axes: Axes, motion: Motion, view: View, wanted: str) -> None:
    def flat(points: Array) -> Array:
        return view.of(points).T

    last = len(motion.chain) - 1
    marked = np.zeros(len(motion.square), dtype=bool) if motion.marked is None else motion.marked
    for k, color, width, label in ((0, "#b9c0c7", 2.4, "at the start"), (last, INK, 2.6, "at the end")):
        chain = flat(motion.chain[k])
        axes.plot(*chain, color=color, linewidth=width, solid_joinstyle="round", label=label, zorder=2 if k else 1.5)
        for shape, some in (("s", motion.square), ("o", ~motion.square)):
            inner = some.copy()
            inner[[0, -1]] = False
            for filled, chosen in ((ORANGE, inner & marked), ("white", inner & ~marked)):
                axes.plot(*chain[:, chosen], shape, color=filled, markeredgecolor=color, markersize=6, zorder=3 if k else 1.6)
        axes.plot(*chain[:, :1], "s", color=color, markersize=8, zorder=3)
    axes.plot(*flat(motion.chain[:, -1]), color=BLUE, linewidth=1.8, label="way of the tool", zorder=2.5)
    axes.plot(*flat(motion.path), color=ORANGE, linewidth=1.1, linestyle=(0, (4, 2)), label=wanted, zorder=2.4)
    axes.plot(*flat(motion.chain[last, -1:]), "D", color=ORANGE, markeredgecolor="white", markersize=7, zorder=3.2)
    if motion.goal is not None:
        axes.plot(*flat(motion.goal[None]), "o", fillstyle="none", color=ORANGE, markersize=12, label="target", zorder=3.3)
    if marked.any():
        axes.plot([], [], "o", color=ORANGE, markeredgecolor=INK, markersize=6, label="locked")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)
    axes.margins(0.08)
