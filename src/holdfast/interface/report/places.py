"""Maps over end-effector positions in a plane, with one panel for each quantity and case, all on one colour scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.palette import EMPTY_COLOR, INK, ORANGE, SOFT
from holdfast.interface.report.scenes import Scale, label_color_bar


@dataclass(frozen=True, kw_only=True)
class Plane:
    """Positions in a plane.

    Attributes:
        points: (P, 2) positions, m.
        labels: Labels of the two axes, with units.
        cells: (P, 2) column and row of each position in a grid; None if the positions are drawn as dots.
        axes: Coordinates of the columns and of the rows, m; None if the positions are drawn as dots.
        mark: Position that is marked, m; None if there is none.
        mark_label: Label of the marked position.
    """

    points: FloatArray
    labels: tuple[str, str]
    cells: NDArray[np.intp] | None = None
    axes: tuple[FloatArray, FloatArray] | None = None
    mark: tuple[float, float] | None = None
    mark_label: str = ""


def place_maps(
    plane: Plane, rows: Mapping[str, FloatArray], columns: Sequence[str], *, label: str, caption: str, most: float = 100.0
) -> Figure:
    """Plot maps over the same positions, one panel for each row and column.

    Args:
        plane: Positions.
        rows: (P, C) values of each row of panels, from 0 to ``most``, by title; NaN for a position without a value.
        columns: (C,) titles of the columns of panels, or titles of all panels, row by row;
            panels without a title are hidden.
        label: Label of the colour bar.
        caption: One or two lines below the figure.
        most: Upper end of the colour scale.
    """
    scale = Scale(0.0, most)
    column_count, row_count = next(iter(rows.values())).shape[1], len(rows)
    panel_edge = min(2.5, max(1.7, WIDTH_IN / column_count))
    with styled_figure(panel_edge * column_count + 1.4, (panel_edge + 0.15) * row_count + 0.9) as figure:
        panels = figure.subplots(row_count, column_count, squeeze=False, sharex=True, sharey=True)
        for row, (name, values) in enumerate(rows.items()):
            for column_index in range(column_count):
                axes = panels[row, column_index]
                panel = row * column_count + column_index
                if panel < len(columns):
                    axes.set_title(format_label(columns[panel], 22))
                elif len(columns) > column_count:
                    axes.set_visible(False)
                _draw_position_map(axes, plane, values[:, column_index], scale)
                if row == row_count - 1:
                    axes.set_xlabel(plane.labels[0])
                if column_index == 0:
                    axes.set_ylabel(f"{format_label(name)}\n{plane.labels[1]}")
        colorbar = figure.colorbar(scale.mappable, ax=list(panels.ravel()), shrink=0.9, aspect=14 * row_count, pad=0.015)
        label_color_bar(colorbar, label, scale)
        figure.supxlabel("\n".join(format_label(line, 160) for line in caption.splitlines()), fontsize=9, color=SOFT)
        if plane.mark is not None:  # the legend must not cover the titles
            handles, labels = panels[0, 0].get_legend_handles_labels()
            figure.legend(handles, labels, loc="outside upper right")
    return figure


def _draw_position_map(axes: Axes, plane: Plane, values: FloatArray, scale: Scale) -> None:
    has_value = ~np.isnan(values)
    if plane.cells is not None and plane.axes is not None:
        x_coordinates, y_coordinates = plane.axes
        image = np.full((len(y_coordinates), len(x_coordinates), 4), 0.0)
        image[plane.cells[:, 1], plane.cells[:, 0]] = to_rgba(EMPTY_COLOR)
        image[plane.cells[has_value, 1], plane.cells[has_value, 0]] = scale.colors(values[has_value])
        # The cells of a single row or column are square; a single cell is 10 cm wide.
        steps = [
            float(coordinates[1] - coordinates[0]) for coordinates in (x_coordinates, y_coordinates) if len(coordinates) > 1
        ] or [0.1]
        half_steps = steps[0] / 2, steps[-1] / 2
        extent = (
            x_coordinates[0] - half_steps[0],
            x_coordinates[-1] + half_steps[0],
            y_coordinates[0] - half_steps[1],
            y_coordinates[-1] + half_steps[1],
        )
        axes.imshow(image, origin="lower", extent=extent, interpolation="nearest")
    else:
        x_coordinates, y_coordinates = plane.points.T
        axes.scatter(x_coordinates[~has_value], y_coordinates[~has_value], s=9, color=EMPTY_COLOR, linewidths=0)
        axes.scatter(x_coordinates[has_value], y_coordinates[has_value], s=11, c=scale.colors(values[has_value]), linewidths=0)
        axes.set_aspect("equal")
    if plane.mark is not None:
        axes.plot(*plane.mark, "x", color="white", markersize=8, markeredgewidth=3.4)
        axes.plot(*plane.mark, "x", color=ORANGE, markersize=7, markeredgewidth=1.8, label=format_label(plane.mark_label))
    axes.grid(visible=False)
    axes.tick_params(colors=INK, length=2)


def bin_positions(points: FloatArray, values: FloatArray, bins: int) -> tuple[Plane, FloatArray]:
    """Group positions (P, 2), m, into square cells, ``bins`` along the longer edge.

    Returns the plane of the cells, and the mean values (B, C) of each cell; values (P, C) are NaN where a position has none.
    """
    lower, upper = points.min(axis=0), points.max(axis=0)
    cell_size = max(float((upper - lower).max()), 1e-9) / bins
    axis_counts = np.maximum(np.ceil((upper - lower) / cell_size - 1e-9), 1).astype(int)
    columns_rows = np.minimum(((points - lower) / cell_size).astype(int), axis_counts - 1)
    cell_numbers, inverse = np.unique(columns_rows[:, 1] * axis_counts[0] + columns_rows[:, 0], return_inverse=True)
    means = np.full((len(cell_numbers), values.shape[1]), np.nan)
    for value_column, column in enumerate(values.T):
        has_value = ~np.isnan(column)
        counts = np.bincount(inverse[has_value], minlength=len(cell_numbers))
        sums = np.bincount(inverse[has_value], column[has_value], len(cell_numbers))
        means[counts > 0, value_column] = sums[counts > 0] / counts[counts > 0]
    cells = np.stack([cell_numbers % axis_counts[0], cell_numbers // axis_counts[0]], axis=1)
    axes = tuple(lower[axis] + cell_size * (np.arange(axis_counts[axis]) + 0.5) for axis in range(2))
    centers = np.stack([axes[0][cells[:, 0]], axes[1][cells[:, 1]]], axis=1)
    return Plane(points=centers, labels=("", ""), cells=cells, axes=(axes[0], axes[1])), means
