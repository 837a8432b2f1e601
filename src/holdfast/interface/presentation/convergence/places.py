"""Maps over places, in the plane of the task or from two sides, and tables with one row for each place."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.places import Places, is_planar_position
from holdfast.core.files.csv_table import write_rows
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.report.views import View
from holdfast.model.arm.task import Task

_BIN_COUNT = 12  # cells along the longer edge
_VIEW_AXES = {"-top": (0, 1), "-side": (0, 2)}


def prepare_place_maps(
    task: Task,
    places: Places,
    percentages: Mapping[str, FloatArray],
    column_titles: Sequence[str],
    colorbar_label: str,
    caption: str,
    target: FloatArray | None = None,
    average_cells: bool = True,
) -> dict[str, Callable[[], report.Figure]]:
    """Prepare a figure for each view of the places: ``""``, the plane of the task; or ``-top`` and ``-side``, seen along z and
    y.

    ``percentages`` maps titles to arrays (P, C) of percentages, NaN where there is no value; ``column_titles`` are the C titles
    of the columns; ``target`` (3,) is a target to mark, m. Places in a plane that do not form a lattice are averaged in square
    cells if ``average_cells``, otherwise each is a dot. Places of spatial tasks are always averaged.
    """
    views = {"": None} if is_planar_position(task) else _VIEW_AXES

    def draw(name: str) -> report.Figure:
        axes = views[name]
        right_axis, up_axis = task.rows[:2, :3] if axes is None else np.eye(3)[list(axes)]
        view = View(right_axis, up_axis, name)
        target_point = None if target is None else tuple(view.project(target).tolist())
        points, remark, shown_values = view.project(places.points), "", dict(percentages)
        plane = report.Plane(
            points=points, labels=view.names, cells=places.cells, axes=places.axes, mark=target_point, mark_label="target"
        )
        if places.cells is None and (average_cells or axes is not None):
            binned_values = {title: report.bin_positions(points, values, _BIN_COUNT) for title, values in percentages.items()}
            first_plane = next(iter(binned_values.values()))[0]
            plane = replace(first_plane, labels=view.names, mark=target_point, mark_label="target")
            shown_values = {title: values for title, (_, values) in binned_values.items()}
            remark = "\nmean over the positions in a cell" + ("" if axes is None else ", at any depth")
        return report.place_maps(plane, shown_values, column_titles, label=colorbar_label, caption=caption + remark)

    return {name: partial(draw, name) for name in views}


def write_place_table(path: Path, places: Places, columns: Sequence[str], values: Sequence[ArrayLike]) -> None:
    """Write places and ``columns`` from values (P,) or (P, C) as CSV, empty where NaN."""
    rows = np.column_stack([places.points, *values])
    texts = (["" if np.isnan(value) else f"{value:.9g}" for value in row] for row in rows)
    write_rows(path, ["x_m", "y_m", "z_m", *columns], texts)
