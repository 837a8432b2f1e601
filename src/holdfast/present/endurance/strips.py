"""Maps over the time of a motion: at every time a strip of values, with the motion as a line through them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import INK, SOFT, WIDTH, finished, legend_below, plain, style
from holdfast.report.palette import PALE
from holdfast.report.scenes import Scale, finish_bar
from holdfast.report.timelines import COLORS

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Strips:
    """Values over time and place.

    Attributes:
        values: (T, B) in each of B bins, NaN where there is nothing.
        title: One line.
    """

    values: Array
    title: str


def strip_figure(
    time: Array, edges: Array, panels: Sequence[Strips], way: Array, *, scale: Scale, label: str, ylabel: str
) -> Figure:
    """Maps beside and below each other, on one scale.

    Args:
        time: (T,) s.
        edges: (B + 1,) of the bins.
        panels: The maps.
        way: (T,) where the motion is.
        scale: Of the colours.
        label: Of the colour bar.
        ylabel: Of the places.
    """
    across = min(4, len(panels))
    down = -(-len(panels) // across)
    with style():
        figure = Figure(figsize=(WIDTH, 2.2 * down + 1.1))
        axes = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
        for a in axes.ravel()[len(panels) :]:
            a.set_visible(False)
        for k, (a, panel) in enumerate(zip(axes.ravel(), panels, strict=False)):
            _draw(a, time, edges, panel, way, scale)
            if k % across == 0:
                a.set_ylabel(ylabel)
            if k >= len(panels) - across:
                a.set_xlabel("time, s")
                a.tick_params(labelbottom=True)
        finish_bar(
            figure.colorbar(scale.mappable, ax=list(axes.ravel()), shrink=0.8, aspect=14 * down, pad=0.015), label, scale
        )
        return finished(figure)


def _draw(axes: Axes, time: Array, edges: Array, panel: Strips, way: Array, scale: Scale) -> None:
    half = np.diff(time) / 2
    between = np.concatenate([[time[0]], time[:-1] + half, [time[-1]]])
    shown = scale.mappable
    axes.set_facecolor(PALE)
    axes.pcolormesh(between, edges, shown.to_rgba(panel.values.T) * np.isfinite(panel.values.T)[..., None], rasterized=True)
    axes.plot(time, way, color="white", linewidth=2.6)
    axes.plot(time, way, color=INK, linewidth=1.3)
    axes.set_title(plain(panel.title), fontsize=9)
    axes.grid(visible=False)
    axes.set_xlim(time[0], time[-1])


def lines_figure(
    time: Array, lines: Sequence[tuple[str, Array]], ylabel: str, *, level: tuple[float, str] | None = None, percents: bool
) -> Figure:
    """Lines over one time (T,), s, with their names below: percentages that jump, the first one strong, or what is smooth."""
    with style():
        figure = Figure(figsize=(WIDTH, 3.6))
        axes = figure.subplots()
        for k, (name, values) in enumerate(lines):
            wide, above = (1.2, 2.0) if k or not percents else (2.2, 2.5)
            look = {"color": COLORS[k % len(COLORS)], "linestyle": ("-", "--", ":")[k // len(COLORS) % 3]}
            steps = "steps-mid" if percents else "default"
            axes.plot(time, values, drawstyle=steps, label=plain(name), linewidth=wide, zorder=above, **look)
        if level is not None:
            axes.axhline(level[0], color=SOFT, linewidth=1.2, linestyle=(0, (1.2, 1.6)), label=plain(level[1]))
        axes.set(xlabel="time, s", ylabel=ylabel)
        axes.set_ylim(*((-2, 102) if percents else (0, None)))
        axes.set_xlim(0, float(time[-1]))
        legend_below(figure, axes, 2)
        return finished(figure)
