"""Maps over places of the end effector in a plane: one panel for each quantity and case, all on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import INK, ORANGE, PALE, SOFT, WIDTH, finished, plain, style
from holdfast.report.scenes import Scale, finish_bar

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Plane:
    """Places in a plane.

    Attributes:
        points: (P, 2) m.
        labels: Of the two axes, with units.
        cells: (P, 2) column and row in a lattice; None: the places are drawn as dots.
        axes: Coordinates of columns and rows; None likewise.
        mark: A place picked out, m; None: none.
        mark_label: What it is.
    """

    points: Array
    labels: tuple[str, str]
    cells: NDArray[np.intp] | None = None
    axes: tuple[Array, Array] | None = None
    mark: tuple[float, float] | None = None
    mark_label: str = ""


def place_maps(
    plane: Plane, rows: Mapping[str, Array], columns: Sequence[str], *, label: str, caption: str, most: float = 100.0
) -> Figure:
    """A panel for each row and column over the same places.

    Args:
        plane: The places.
        rows: By title, (P, C) values from 0 to ``most``, NaN where there are none.
        columns: (C,) titles.
        label: Of the colour bar.
        caption: What was computed, one or two lines.
        most: Upper end of the scale.
    """
    scale = Scale(0.0, most)
    with style():
        across, down = len(columns), len(rows)
        edge = min(2.5, max(1.7, WIDTH / across))
        figure = Figure(figsize=(edge * across + 1.4, (edge + 0.15) * down + 0.9))
        panels = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
        for i, (name, values) in enumerate(rows.items()):
            for j, column in enumerate(columns):
                axes = panels[i, j]
                _draw(axes, plane, values[:, j], scale)
                if i == 0:
                    axes.set_title(plain(column, 22))
                if i == down - 1:
                    axes.set_xlabel(plane.labels[0])
                if j == 0:
                    axes.set_ylabel(f"{plain(name)}\n{plane.labels[1]}")
        bar = figure.colorbar(scale.mappable, ax=list(panels.ravel()), shrink=0.9, aspect=14 * down, pad=0.015)
        finish_bar(bar, label, scale)
        figure.supxlabel("\n".join(plain(line, 160) for line in caption.splitlines()), fontsize=9, color=SOFT)
        if plane.mark is not None:  # room for the titles, too
            handles, labels = panels[0, 0].get_legend_handles_labels()
            figure.legend(handles, labels, loc="outside upper right")
        return finished(figure)


def _draw(axes: Axes, plane: Plane, values: Array, scale: Scale) -> None:
    known = ~np.isnan(values)
    if plane.cells is not None and plane.axes is not None:
        x, y = plane.axes
        picture = np.full((len(y), len(x), 4), 0.0)
        picture[plane.cells[:, 1], plane.cells[:, 0]] = to_rgba(PALE)
        picture[plane.cells[known, 1], plane.cells[known, 0]] = scale.colors(values[known])
        # Cells of a single row or column are as wide as the others are high; a single one is 10 cm.
        steps = [float(a[1] - a[0]) for a in (x, y) if len(a) > 1] or [0.1]
        half = steps[0] / 2, steps[-1] / 2
        extent = (x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1])
        axes.imshow(picture, origin="lower", extent=extent, interpolation="nearest")
    else:
        x, y = plane.points.T
        axes.scatter(x[~known], y[~known], s=9, color=PALE, linewidths=0)
        axes.scatter(x[known], y[known], s=11, c=scale.colors(values[known]), linewidths=0)
        axes.set_aspect("equal")
    if plane.mark is not None:
        axes.plot(*plane.mark, "x", color="white", markersize=8, markeredgewidth=3.4)
        axes.plot(*plane.mark, "x", color=ORANGE, markersize=7, markeredgewidth=1.8, label=plain(plane.mark_label))
    axes.grid(visible=False)
    axes.tick_params(colors=INK, length=2)


def binned(points: Array, values: Array, bins: int) -> tuple[Plane, Array]:
    """Places gathered in square cells, ``bins`` of them along the longer edge, and the means (B, C) of their values (P, C).

    Args:
        points: (P, 2) m.
        values: (P, C), NaN where there are none.
        bins: Cells.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = max(float((high - low).max()), 1e-9) / bins
    count = np.maximum(np.ceil((high - low) / size - 1e-9), 1).astype(int)
    place = np.minimum(((points - low) / size).astype(int), count - 1)
    number, inverse = np.unique(place[:, 1] * count[0] + place[:, 0], return_inverse=True)
    means = np.full((len(number), values.shape[1]), np.nan)
    for j, column in enumerate(values.T):
        known = ~np.isnan(column)
        total = np.bincount(inverse[known], minlength=len(number))
        sums = np.bincount(inverse[known], column[known], len(number))
        means[total > 0, j] = sums[total > 0] / total[total > 0]
    cells = np.stack([number % count[0], number // count[0]], axis=1)
    axes = tuple(low[k] + size * (np.arange(count[k]) + 0.5) for k in range(2))
    centres = np.stack([axes[0][cells[:, 0]], axes[1][cells[:, 1]]], axis=1)
    return Plane(points=centres, labels=("", ""), cells=cells, axes=(axes[0], axes[1])), means
