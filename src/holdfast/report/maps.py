"""Maps over a projection: cells coloured by the average, or the share, of the points in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import INK, WIDTH, finished, style
from holdfast.report.scenes import Scale, finish_bar
from holdfast.report.views import View

Array = NDArray[np.float64]


def map_figure(
    points: Array,
    samples: Mapping[str, Array],
    views: Sequence[View],
    *,
    log: bool,
    smaller_is_better: bool,
    label: str,
    bins: int = 6,
    weights: Array | None = None,
) -> Figure:
    """The value over a projection: per cell the mean (the median if smaller is better), and how many points have one.

    Args:
        points: (N, 3) m.
        samples: (N,) values of each sample by its name, NaN where a point has none: a row of panels each, all in the same
            colours.
        views: One panel each.
        log: Colours on a log scale.
        smaller_is_better: Reverses the colours; medians instead of means.
        label: Of the colour bar.
        bins: Cells along the longer edge.
        weights: (N,) of the points, 0 or more; all count alike if not given.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    grids = [
        [_grid(points, values, v, low, high, bins, smaller_is_better, weights) for v in views] for values in samples.values()
    ]
    cells = np.concatenate([g[2].ravel() for row in grids for g in row])
    lost = any(bool(np.isnan(values).any()) for values in samples.values())
    scale = replace(Scale.of(cells[~np.isnan(cells)], log, smaller_is_better), pale=True)
    with style():
        tall = max(float(up / right) for right, up in (view.of(high - low) for view in views))
        height = float(np.clip(4.0 * tall, 1.6, 4.6)) + 0.8
        figure = Figure(figsize=(WIDTH if len(views) > 1 else 6.2, height * len(samples)))
        panels = figure.subplots(len(samples), len(views), squeeze=False)
        for name, line, row in zip(samples, panels, grids, strict=True):
            for axes, view, (x, y, mean, reached, drawn) in zip(line, views, row, strict=True):
                _draw_cells(axes, x, y, mean, reached, drawn, scale, lost)
                title = f"{view.title}, {name}" if len(samples) > 1 else view.title
                axes.set(xlabel=view.names[0], ylabel=view.names[1], title=title)
        b = figure.colorbar(
            scale.mappable,
            ax=list(panels.ravel()),
            shrink=0.85,
            aspect=26 * len(samples),
            pad=0.015,
            extend=scale.extend(cells),
        )
        finish_bar(b, label, scale)
        return finished(figure)


def share_figure(
    points: Array,
    panels: Sequence[tuple[str, NDArray[np.bool_]]],
    view: View,
    *,
    label: str,
    bins: int = 6,
    weights: Array | None = None,
) -> Figure:
    """The fraction of points with a property over one projection, a panel for each property, all on one scale from 0 to 1.

    Args:
        points: (N, 3) m.
        panels: Title and, (N,), which points have the property. A cell says the share and, below it, of how many points.
        view: The projection.
        label: Of the colour bar.
        bins: Cells along the longer edge.
        weights: (N,) of the points, 0 or more; all count alike if not given.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    scale = Scale(0.0, 1.0, pale=True)
    with style():
        right, up = view.of(high - low)
        tall = float(up / right)
        figure = Figure(figsize=(WIDTH, float(np.clip(4.0 * tall, 1.6, 4.6)) + 0.8))
        axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for a, (title, having) in zip(axes, panels, strict=True):
            x, y, share, count, _ = _grid(points, having.astype(np.float64), view, low, high, bins, False, weights)
            _draw_cells(a, x, y, share, count, count, scale, False)
            a.set(xlabel=view.names[0], ylabel=view.names[1], title=title)
        finish_bar(figure.colorbar(scale.mappable, ax=list(axes), shrink=0.85, aspect=26, pad=0.015), label, scale)
        return finished(figure)


def _grid(
    points: Array, values: Array, view: View, low: Array, high: Array, bins: int, median: bool, weights: Array | None = None
) -> tuple[Array, Array, Array, Array, Array]:
    low, size = view.of(low), view.of(high - low)
    count = np.maximum(np.round(bins * size / size.max()), 1).astype(int)
    x, y = (np.linspace(a, a + s, n + 1) for a, s, n in zip(low, size, count, strict=True))

    def place(p: Array) -> NDArray[np.int64]:
        at = np.minimum(((view.of(p) - low) / size * count).astype(np.int64), count - 1)
        return np.asarray(at[:, 1] * count[0] + at[:, 0])

    there = ~np.isnan(values)
    cell = place(points)
    total = int(count.prod())
    drawn = np.bincount(cell, minlength=total)
    cell = cell[there]
    reached = np.bincount(cell, minlength=total)
    order = np.argsort(cell, kind="stable")
    ends = np.cumsum(reached)[:-1]
    groups = np.split(values[there][order], ends)
    if weights is None:
        average = np.array([np.nan if not len(g) else float(np.median(g) if median else np.mean(g)) for g in groups])
    else:
        shares = np.split(weights[there][order], ends)
        average = np.array([_weighted(g, w, median) for g, w in zip(groups, shares, strict=True)])
    shape = (count[1], count[0])
    return x, y, average.reshape(shape), reached.reshape(shape), drawn.reshape(shape)


def _weighted(values: Array, weights: Array, median: bool) -> float:
    """The mean, or the smallest value up to which lies half of the weight; NaN where nothing has weight."""
    if not weights.sum() > 0:
        return np.nan
    if not median:
        return float(np.average(values, weights=weights))
    order = np.argsort(values, kind="stable")
    below = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(below, below[-1] / 2)])


def _draw_cells(axes: Axes, x: Array, y: Array, mean: Array, reached: Array, drawn: Array, scale: Scale, lost: bool) -> None:
    colors = scale.colors(np.nan_to_num(mean, nan=scale.low, posinf=scale.high))
    colors[np.isnan(mean)] = (0.93, 0.94, 0.95, 1)
    axes.pcolormesh(x, y, colors, edgecolors="white", linewidth=1.2)
    axes.set_aspect("equal")
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_xticks(x, [f"{round(v, 2) + 0.0:.2f}".replace("-", "−") for v in x])
    axes.set_yticks(y, [f"{round(v, 2) + 0.0:.2f}".replace("-", "−") for v in y])
    axes.tick_params(length=0, pad=6)
    inside: dict[str, Any] = {
        "textcoords": "offset points",
        "ha": "center",
        "va": "center",
        "annotation_clip": False,
        "in_layout": False,
    }
    for i, j in np.ndindex(mean.shape):
        middle = ((x[j] + x[j + 1]) / 2, (y[i] + y[i + 1]) / 2)
        luminance = float(colors[i, j, :3] ** 2.2 @ [0.2126, 0.7152, 0.0722])
        color = INK if luminance > 0.18 else "white"
        if not np.isnan(mean[i, j]):
            text = "∞" if np.isinf(mean[i, j]) else _short(float(mean[i, j]))
            axes.annotate(text, middle, (0, 5), fontsize=9, color=color, **inside)
        if drawn[i, j]:
            text = f"{reached[i, j]}/{drawn[i, j]}" if lost else f"{drawn[i, j]}"
            axes.annotate(text, middle, (0, -6), fontsize=7, color=color, **inside)


def _short(value: float) -> str:
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
