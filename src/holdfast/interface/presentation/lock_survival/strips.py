"""Maps over the time of a motion: a strip of values at every time, and the motion as a line through them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import INK, SOFT, WIDTH_IN, format_label, legend_below, settle_layout, style
from holdfast.interface.report.palette import EMPTY_COLOR
from holdfast.interface.report.scenes import Scale, label_color_bar
from holdfast.interface.report.timelines import LINE_COLORS


@dataclass(frozen=True)
class StripPanel:
    """Values over time and joint position.

    Attributes:
        values: (T, B) in each of B bins, NaN where there is nothing.
        title: One line.
    """

    values: FloatArray
    title: str


def draw_strips(
    time: FloatArray,
    edges: FloatArray,
    panels: Sequence[StripPanel],
    path: FloatArray,
    *,
    scale: Scale,
    label: str,
    ylabel: str,
) -> Figure:
    """Draw maps in a grid, on one scale.

    Args:
        time: (T,) s.
        edges: (B + 1,) of the bins.
        panels: The maps.
        path: (T,) where the motion is.
        scale: Of the colours.
        label: Of the colour bar.
        ylabel: Of the places.
    """
    column_count = min(4, len(panels))
    row_count = -(-len(panels) // column_count)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.2 * row_count + 1.1))
        axes = figure.subplots(row_count, column_count, squeeze=False, sharex=True, sharey=True)
        for panel_axes in axes.ravel()[len(panels) :]:
            panel_axes.set_visible(False)
        for index, (panel_axes, panel) in enumerate(zip(axes.ravel(), panels, strict=False)):
            _draw_strip(panel_axes, time, edges, panel, path, scale)
            if index % column_count == 0:
                panel_axes.set_ylabel(ylabel)
            if index >= len(panels) - column_count:
                panel_axes.set_xlabel("time, s")
                panel_axes.tick_params(labelbottom=True)
        label_color_bar(
            figure.colorbar(scale.mappable, ax=list(axes.ravel()), shrink=0.8, aspect=14 * row_count, pad=0.015), label, scale
        )
        return settle_layout(figure)


def _draw_strip(axes: Axes, time: FloatArray, edges: FloatArray, panel: StripPanel, path: FloatArray, scale: Scale) -> None:
    half_steps = np.diff(time) / 2
    time_edges = np.concatenate([[time[0]], time[:-1] + half_steps, [time[-1]]])
    mappable = scale.mappable
    axes.set_facecolor(EMPTY_COLOR)
    axes.pcolormesh(
        time_edges, edges, mappable.to_rgba(panel.values.T) * np.isfinite(panel.values.T)[..., None], rasterized=True
    )
    axes.plot(time, path, color="white", linewidth=2.6)
    axes.plot(time, path, color=INK, linewidth=1.3)
    axes.set_title(format_label(panel.title), fontsize=9)
    axes.grid(visible=False)
    axes.set_xlim(time[0], time[-1])


def draw_lines(
    time: FloatArray,
    lines: Sequence[tuple[str, FloatArray]],
    ylabel: str,
    *,
    level: tuple[float, str] | None = None,
    percents: bool,
) -> Figure:
    """Draw lines over one time (T,), s, with their names below: percentages as steps with the first one bold, or
    smooth curves.
    """
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.6))
        axes = figure.subplots()
        for index, (name, values) in enumerate(lines):
            line_width, layer = (1.2, 2.0) if index or not percents else (2.2, 2.5)
            line_style = {
                "color": LINE_COLORS[index % len(LINE_COLORS)],
                "linestyle": ("-", "--", ":")[index // len(LINE_COLORS) % 3],
            }
            draw_style = "steps-mid" if percents else "default"
            axes.plot(
                time, values, drawstyle=draw_style, label=format_label(name), linewidth=line_width, zorder=layer, **line_style
            )
        if level is not None:
            axes.axhline(level[0], color=SOFT, linewidth=1.2, linestyle=(0, (1.2, 1.6)), label=format_label(level[1]))
        axes.set(xlabel="time, s", ylabel=ylabel)
        axes.set_ylim(*((-2, 102) if percents else (0, None)))
        axes.set_xlim(0, float(time[-1]))
        legend_below(figure, axes, 2)
        return settle_layout(figure)
