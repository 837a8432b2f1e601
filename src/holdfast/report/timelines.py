"""Figures of quantities over the time of a motion: panels below each other, and small ones side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, INK, ORANGE, SOFT, WIDTH, finished, legend_below, plain, style

Array = NDArray[np.float64]
Look = Literal["first", "second", "third", "compared", "level"]

# After Okabe and Ito, darkened for thin lines; dashes tell apart what prints alike.
COLORS = (BLUE, ORANGE, "#1b7f5c", "#8a3d82", "#8f6a00", "#2a93c0", SOFT, "#a32638", INK)
DASHES: tuple[tuple[int, tuple[float, ...]], ...] = ((0, ()), (0, (5, 1.5)), (0, (1.5, 1.2)))
_LOOKS: dict[Look, dict[str, object]] = {
    "first": {"color": BLUE, "linewidth": 1.6},
    "second": {"color": ORANGE, "linewidth": 1.4, "linestyle": (0, (5, 1.5))},
    "third": {"color": "#1b7f5c", "linewidth": 1.4, "linestyle": (0, (1.5, 1.2))},
    "compared": {"color": INK, "linewidth": 1.2, "linestyle": (0, (4.5, 2))},
    "level": {"color": SOFT, "linewidth": 1.1, "linestyle": (0, (1.2, 1.6))},
}


@dataclass(frozen=True)
class Line:
    """One quantity over time: values (T,), what it is, and how it looks; without a look it has a colour of its own."""

    values: Array
    label: str
    look: Look | None = None


@dataclass(frozen=True)
class Timeline:
    """Lines over one axis of time.

    Attributes:
        lines: What is drawn.
        ylabel: What it is, with its unit.
        title: One line.
        moments: Times, s, that are marked by a line across.
        scale: Of the values: ``linear``, ``log``, or ``symlog`` with what is below ``small`` in size drawn linearly.
        small: See scale.
    """

    lines: Sequence[Line]
    ylabel: str
    title: str
    moments: Sequence[float] = ()
    scale: Literal["linear", "log", "symlog"] = "linear"
    small: float = 1.0


def _draw(axes: Axes, time: Array, panel: Timeline) -> None:
    for k, line in enumerate(panel.lines):
        own = {
            "color": COLORS[k % len(COLORS)],
            "linewidth": 1.4,
            "linestyle": DASHES[(k // 3) % len(DASHES)],
        }
        axes.plot(time, line.values, label=plain(line.label), **(own if line.look is None else _LOOKS[line.look]))  # type: ignore[arg-type]
    for number, t in enumerate(panel.moments):
        axes.axvline(t, color=ORANGE, linewidth=1.0, alpha=0.8, label="algorithmic singularity" if not number else None)
    axes.set(title=plain(panel.title, 90))
    axes.set_xlim(float(time[0]), float(time[-1]))
    if panel.scale == "symlog":
        axes.set_yscale("symlog", linthresh=panel.small)
    elif panel.scale == "log" and any((line.values > 0).any() for line in panel.lines):
        axes.set_yscale("log", nonpositive="mask")
    else:
        axes.margins(y=0.1)


def timeline_figure(time: Array, panels: Sequence[Timeline]) -> Figure:
    """Panels below each other over one time (T,), s, each with a legend to its right if it has several lines."""
    with style():
        figure = Figure(figsize=(WIDTH, 2.5 * len(panels) + 0.4))
        column = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, panel in zip(column, panels, strict=True):
            _draw(axes, time, panel)
            axes.set_ylabel(panel.ylabel)
            if len(panel.lines) > 1 or panel.moments:
                axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
        column[-1].set_xlabel("time, s")
        return finished(figure)


def small_multiples(time: Array, panels: Sequence[Timeline], xlabel: str = "time, s") -> Figure:
    """Small panels, three in a row, over one time (T,); the lines of the one with most are named below."""
    across = min(3, len(panels))
    down = -(-len(panels) // across)
    with style():
        figure = Figure(figsize=(WIDTH, 2.1 * down + 0.8))
        grid = figure.subplots(down, across, sharex=True, squeeze=False)
        for k, axes in enumerate(grid.flat):
            if k >= len(panels):
                axes.set_axis_off()
                continue
            _draw(axes, time, panels[k])
            if k % across == 0 or panels[k].ylabel != panels[k - 1].ylabel:
                axes.set_ylabel(panels[k].ylabel)
            if k >= len(panels) - across:
                axes.set_xlabel(xlabel)
                axes.tick_params(labelbottom=True)
        legend_below(figure, max(grid.flat, key=lambda axes: len(axes.get_lines())), 5)
        return finished(figure)
