"""Maps over a projection: the colour of each cell is the average value of its points, or the fraction of some of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, styled_figure
from holdfast.interface.report.palette import INK
from holdfast.interface.report.scenes import Scale, label_color_bar
from holdfast.interface.report.views import View


def map_figure(
    points: FloatArray,
    samples: Mapping[str, FloatArray],
    views: Sequence[View],
    *,
    log: bool,
    smaller_is_better: bool,
    label: str,
    bins: int = 6,
    weights: FloatArray | None = None,
) -> Figure:
    """Map a value over projections: each cell shows the mean or median of its points, and the number of points with a value.

    Args:
        points: (N, 3) points, m.
        samples: (N,) values of each sample, by name, NaN for a point without a value; each sample has a row of panels.
        views: Projection of each column of panels.
        log: Use a logarithmic colour scale.
        smaller_is_better: Reverse the colours, and show medians instead of means.
        label: Label of the colour bar.
        bins: Number of cells along the longer edge.
        weights: (N,) weights of the points, at least 0; equal weights if None.
    """
    lower, upper = points.min(axis=0), points.max(axis=0)
    grids = [
        [_average_cells(points, values, grid_view, lower, upper, bins, smaller_is_better, weights) for grid_view in views]
        for values in samples.values()
    ]
    averages = np.concatenate([grid[2].ravel() for grid_row in grids for grid in grid_row])
    has_missing = any(bool(np.isnan(values).any()) for values in samples.values())
    scale = replace(Scale.from_values(averages[~np.isnan(averages)], log, smaller_is_better), pale=True)
    aspect = max(float(height / view_width) for view_width, height in (view.project(upper - lower) for view in views))
    height = float(np.clip(4.0 * aspect, 1.6, 4.6)) + 0.8
    with styled_figure(WIDTH_IN if len(views) > 1 else 6.2, height * len(samples)) as figure:
        panels = figure.subplots(len(samples), len(views), squeeze=False)
        for name, axes_row, grid_row in zip(samples, panels, grids, strict=True):
            for axes, view, (x_edges, y_edges, mean, value_counts, point_counts) in zip(axes_row, views, grid_row, strict=True):
                _draw_cells(axes, x_edges, y_edges, mean, value_counts, point_counts, scale, has_missing)
                title = f"{view.title}, {name}" if len(samples) > 1 else view.title
                axes.set(xlabel=view.names[0], ylabel=view.names[1], title=title)
        colorbar = figure.colorbar(
            scale.mappable,
            ax=list(panels.ravel()),
            shrink=0.85,
            aspect=26 * len(samples),
            pad=0.015,
            extend=scale.extend(averages),
        )
        label_color_bar(colorbar, label, scale)
    return figure


def share_figure(
    points: FloatArray,
    panels: Sequence[tuple[str, NDArray[np.bool_]]],
    view: View,
    *,
    label: str,
    bins: int = 6,
    weights: FloatArray | None = None,
) -> Figure:
    """Map the fraction of points with a property over a projection, one panel per property, all on one scale from 0 to 1.

    Args:
        points: (N, 3) points, m.
        panels: Title and flags (N,) of the points with the property. A cell shows the fraction and its number of points.
        view: Projection.
        label: Label of the colour bar.
        bins: Number of cells along the longer edge.
        weights: (N,) weights of the points, at least 0; equal weights if None.
    """
    lower, upper = points.min(axis=0), points.max(axis=0)
    scale = Scale(0.0, 1.0, pale=True)
    view_width, view_height = view.project(upper - lower)
    aspect = float(view_height / view_width)
    with styled_figure(WIDTH_IN, float(np.clip(4.0 * aspect, 1.6, 4.6)) + 0.8) as figure:
        axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for panel_axes, (title, has_property) in zip(axes, panels, strict=True):
            x_edges, y_edges, fractions, point_counts, _ = _average_cells(
                points, has_property.astype(np.float64), view, lower, upper, bins, False, weights
            )
            _draw_cells(panel_axes, x_edges, y_edges, fractions, point_counts, point_counts, scale, False)
            panel_axes.set(xlabel=view.names[0], ylabel=view.names[1], title=title)
        label_color_bar(figure.colorbar(scale.mappable, ax=list(axes), shrink=0.85, aspect=26, pad=0.015), label, scale)
    return figure


def _average_cells(
    points: FloatArray,
    values: FloatArray,
    view: View,
    lower: FloatArray,
    upper: FloatArray,
    longest_cells: int,
    median: bool,
    weights: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    lower, size = view.project(lower), view.project(upper - lower)
    count = np.maximum(np.round(longest_cells * size / size.max()), 1).astype(int)
    x_edges, y_edges = (
        np.linspace(axis_start, axis_start + axis_size, axis_count + 1)
        for axis_start, axis_size, axis_count in zip(lower, size, count, strict=True)
    )

    def cell_index(located_points: FloatArray) -> NDArray[np.int64]:
        columns_rows = np.minimum(((view.project(located_points) - lower) / size * count).astype(np.int64), count - 1)
        return np.asarray(columns_rows[:, 1] * count[0] + columns_rows[:, 0])

    has_value = ~np.isnan(values)
    cells = cell_index(points)
    cell_count = int(count.prod())
    point_counts = np.bincount(cells, minlength=cell_count)
    cells = cells[has_value]
    value_counts = np.bincount(cells, minlength=cell_count)
    order = np.argsort(cells, kind="stable")
    ends = np.cumsum(value_counts)[:-1]
    groups = np.split(values[has_value][order], ends)
    if weights is None:
        average = np.array(
            [np.nan if not len(group) else float(np.median(group) if median else np.mean(group)) for group in groups]
        )
    else:
        weight_groups = np.split(weights[has_value][order], ends)
        average = np.array(
            [_weighted_average(group, weights, median) for group, weights in zip(groups, weight_groups, strict=True)]
        )
    shape = (count[1], count[0])
    return x_edges, y_edges, average.reshape(shape), value_counts.reshape(shape), point_counts.reshape(shape)


def _weighted_average(values: FloatArray, weights: FloatArray, median: bool) -> float:
    """Return the weighted mean, or the weighted median (smallest value with half of the weight at or below); NaN if empty."""
    if not weights.sum() > 0:
        return np.nan
    if not median:
        return float(np.average(values, weights=weights))
    order = np.argsort(values, kind="stable")
    cumulative_weights = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(cumulative_weights, cumulative_weights[-1] / 2)])


def _draw_cells(
    axes: Axes,
    x_edges: FloatArray,
    y_edges: FloatArray,
    mean: FloatArray,
    value_counts: FloatArray,
    point_counts: FloatArray,
    scale: Scale,
    has_missing: bool,
) -> None:
    colors = scale.colors(np.nan_to_num(mean, nan=scale.low, posinf=scale.high))
    colors[np.isnan(mean)] = (0.93, 0.94, 0.95, 1)
    axes.pcolormesh(x_edges, y_edges, colors, edgecolors="white", linewidth=1.2)
    axes.set_aspect("equal")
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_xticks(x_edges, [f"{round(edge, 2) + 0.0:.2f}".replace("-", "−") for edge in x_edges])
    axes.set_yticks(y_edges, [f"{round(edge, 2) + 0.0:.2f}".replace("-", "−") for edge in y_edges])
    axes.tick_params(length=0, pad=6)
    text_style: dict[str, Any] = {
        "textcoords": "offset points",
        "ha": "center",
        "va": "center",
        "annotation_clip": False,
        "in_layout": False,
    }
    for row, column in np.ndindex(mean.shape):
        middle = ((x_edges[column] + x_edges[column + 1]) / 2, (y_edges[row] + y_edges[row + 1]) / 2)
        luminance = float(colors[row, column, :3] ** 2.2 @ [0.2126, 0.7152, 0.0722])
        color = INK if luminance > 0.18 else "white"
        if not np.isnan(mean[row, column]):
            text = "∞" if np.isinf(mean[row, column]) else _format_cell_value(float(mean[row, column]))
            axes.annotate(text, middle, (0, 5), fontsize=9, color=color, **text_style)
        if point_counts[row, column]:
            text = f"{value_counts[row, column]}/{point_counts[row, column]}" if has_missing else f"{point_counts[row, column]}"
            axes.annotate(text, middle, (0, -6), fontsize=7, color=color, **text_style)


def _format_cell_value(value: float) -> str:
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
