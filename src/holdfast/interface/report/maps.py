"""Maps over a projection: the colour of each cell is the average value of its points, or the fraction of some of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
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
    rows, median = [], smaller_is_better
    for name, values in samples.items():
        titles = [f"{view.title}, {name}" if len(samples) > 1 else view.title for view in views]
        titled_views = zip(titles, views, strict=True)
        rows.append([_average_cells(title, points, values, view, bins, median, weights) for title, view in titled_views])
    averages = np.concatenate([cell_map.averages.ravel() for row in rows for cell_map in row])
    scale = replace(Scale.from_values(averages[~np.isnan(averages)], log, smaller_is_better), pale=True)
    has_missing = any(bool(np.isnan(values).any()) for values in samples.values())
    return _draw_maps(rows, WIDTH_IN if len(views) > 1 else 6.2, scale, label, has_missing)


def share_figure(
    points: FloatArray,
    panels: Sequence[tuple[str, NDArray[np.bool_]]],
    view: View,
    *,
    label: str,
    bins: int = 6,
    weights: FloatArray | None = None,
) -> Figure:
    """Map the fraction of points (N, 3), m, with a property over a projection, all panels on one scale from 0 to 1.

    Each panel has a title and the flags (N,) of the points with the property. A cell shows the fraction and its number of
    points; there are ``bins`` cells along the longer edge. Points count by ``weights`` (N,), which are equal if None.
    """
    cell_maps = [_average_cells(title, points, flags.astype(float), view, bins, False, weights) for title, flags in panels]
    return _draw_maps([cell_maps], WIDTH_IN, Scale(0.0, 1.0, pale=True), label, False)


@dataclass(frozen=True)
class _CellMap:
    """Averages over the cells of a projection (Y, X), with the numbers of points with a value and of all points."""

    title: str
    view: View
    x_edges: FloatArray
    y_edges: FloatArray
    averages: FloatArray
    value_counts: NDArray[np.int64]
    point_counts: NDArray[np.int64]


def _average_cells(
    title: str, points: FloatArray, values: FloatArray, view: View, bins: int, median: bool, weights: FloatArray | None
) -> _CellMap:
    lower, size = view.project(points.min(axis=0)), view.project(np.ptp(points, axis=0))
    count = np.maximum(np.round(bins * size / size.max()), 1).astype(int)
    x_edges, y_edges = (
        np.linspace(axis_start, axis_start + axis_size, axis_count + 1)
        for axis_start, axis_size, axis_count in zip(lower, size, count, strict=True)
    )
    columns_rows = np.minimum(((view.project(points) - lower) / size * count).astype(np.int64), count - 1)
    cells = columns_rows[:, 1] * count[0] + columns_rows[:, 0]
    has_value = ~np.isnan(values)
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
    counts = value_counts.reshape(shape), point_counts.reshape(shape)
    return _CellMap(title, view, x_edges, y_edges, average.reshape(shape), *counts)


def _weighted_average(values: FloatArray, weights: FloatArray, median: bool) -> float:
    """Return the weighted mean, or the weighted median (smallest value with half of the weight at or below); NaN if empty."""
    if not weights.sum() > 0:
        return np.nan
    if not median:
        return float(np.average(values, weights=weights))
    order = np.argsort(values, kind="stable")
    cumulative_weights = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(cumulative_weights, cumulative_weights[-1] / 2)])


def _draw_maps(rows: Sequence[Sequence[_CellMap]], width: float, scale: Scale, label: str, has_missing: bool) -> Figure:
    """Draw rows of maps, ``width`` inches wide, on one colour scale."""
    averages = np.concatenate([cell_map.averages.ravel() for row in rows for cell_map in row])
    aspect = max(float(np.ptp(cell_map.y_edges) / np.ptp(cell_map.x_edges)) for cell_map in rows[0])
    with styled_figure(width, (float(np.clip(4.0 * aspect, 1.6, 4.6)) + 0.8) * len(rows)) as figure:
        panels = figure.subplots(len(rows), len(rows[0]), squeeze=False)
        for axes, cell_map in zip(panels.ravel(), chain(*rows), strict=True):
            _draw_cells(axes, cell_map, scale, has_missing)
            axes.set(xlabel=cell_map.view.names[0], ylabel=cell_map.view.names[1], title=cell_map.title)
        style = {"shrink": 0.85, "aspect": 26 * len(rows), "pad": 0.015, "extend": scale.extend(averages)}
        label_color_bar(figure.colorbar(scale.mappable, ax=list(panels.ravel()), **style), label, scale)
    return figure


def _draw_cells(axes: Axes, cell_map: _CellMap, scale: Scale, has_missing: bool) -> None:
    x_edges, y_edges, averages = cell_map.x_edges, cell_map.y_edges, cell_map.averages
    colors = scale.colors(np.nan_to_num(averages, nan=scale.low, posinf=scale.high))
    colors[np.isnan(averages)] = (0.93, 0.94, 0.95, 1)
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
    for row, column in np.ndindex(averages.shape):
        middle = ((x_edges[column] + x_edges[column + 1]) / 2, (y_edges[row] + y_edges[row + 1]) / 2)
        luminance = float(colors[row, column, :3] ** 2.2 @ [0.2126, 0.7152, 0.0722])
        color = INK if luminance > 0.18 else "white"
        if not np.isnan(averages[row, column]):
            text = _format_cell_value(float(averages[row, column]))
            axes.annotate(text, middle, (0, 5), fontsize=9, color=color, **text_style)
        if point_count := cell_map.point_counts[row, column]:
            text = f"{cell_map.value_counts[row, column]}/{point_count}" if has_missing else f"{point_count}"
            axes.annotate(text, middle, (0, -6), fontsize=7, color=color, **text_style)


def _format_cell_value(value: float) -> str:
    if np.isinf(value):
        return "∞"
    if abs(value) < 1e-9:
        return "0"
    if abs(value) < 10:
        return f"{value:.2g}" if abs(value) < 0.01 else f"{value:.2f}"
    return f"{value:.0f}" if abs(value) < 1e4 else f"{value:.0e}"
