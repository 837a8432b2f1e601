"""Maps over places and tables of means for workspace analyses: in the plane of the task, or from two sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from holdfast.control.convergence.measures import FINISH_NAMES, REACH_NAMES
from holdfast.control.convergence.places import Places, is_planar_position
from holdfast.core.formatting import format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.printing import TextTable, format_column, format_significant

if TYPE_CHECKING:
    from holdfast.control.convergence.start_workspace import Workspace
    from holdfast.control.convergence.targets import TargetMeasures
    from holdfast.control.laws.law import Law
    from holdfast.interface.presentation.results import Drawings
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
) -> Drawings:
    """Prepare a figure for each view of the places: ``""``, the plane of the task; or ``-top`` and ``-side``, seen along z and
    y.

    ``percentages`` are by title, (P, C) percentages, NaN where there are none; ``column_titles`` (C,) titles;
    ``colorbar_label`` is of the colour bar; ``target`` (3,) a target to show. Places in a plane that do not form a lattice are
    averaged in square
    cells if ``average_cells``, as those of spatial arms always are; else each is a dot.
    """
    from holdfast.interface.report.places import Plane, bin_positions, place_maps
    from holdfast.interface.report.views import View

    functions: Drawings = {}
    views = {"": None} if is_planar_position(task) else _VIEW_AXES
    for name, axes in views.items():
        right_axis, up_axis = task.rows[:2, :3] if axes is None else np.eye(3)[list(axes)]
        view = View(right_axis, up_axis, name)
        target_point = None if target is None else tuple(view.project(target).tolist())
        points, remark, shown_values = view.project(places.points), "", dict(percentages)
        plane = Plane(
            points=points, labels=view.names, cells=places.cells, axes=places.axes, mark=target_point, mark_label="target"
        )
        if places.cells is None and (average_cells or axes is not None):
            binned_values = {title: bin_positions(points, values, _BIN_COUNT) for title, values in percentages.items()}
            first_plane = next(iter(binned_values.values()))[0]
            plane = replace(first_plane, labels=view.names, mark=target_point, mark_label="target")
            shown_values = {title: values for title, (_, values) in binned_values.items()}
            remark = "\nmean over the places in a cell" + ("" if axes is None else ", whatever their depth")
        functions[name] = partial(
            place_maps, plane, shown_values, column_titles, label=colorbar_label, caption=caption + remark
        )
    return functions


def tabulate_means(analysis: Workspace | TargetMeasures, place_noun: str, intervals: bool = True) -> TextTable:
    """Build a table with a row for each joint and ``any``, and a column for the mean of each measure."""
    means, mean_intervals = analysis.means(), analysis.intervals()
    row_names = (*analysis.law.arm.joint_names, "any")
    columns = [
        [format_with_interval(values[index], *mean_intervals[measure][index]) for index in range(len(row_names))]
        if intervals
        else format_column(values)
        for measure, values in means.items()
    ]
    table_rows = [list(row) for row in zip(row_names, *columns, strict=True)]
    return TextTable(["joint", *means], table_rows, f"mean over {place_noun}, percent" + " (and 95 % interval)" * intervals)


def format_with_interval(value: float, lower: float, upper: float) -> str:
    """Format a percentage above its interval."""
    return format_significant(value) if np.isnan(value) else f"{value:.1f}\n{lower:.1f} to {upper:.1f}"


def prepare_measure_maps(
    law: Law,
    places: Places,
    measures: Mapping[str, FloatArray],
    about: str,
    failure_text: str,
    target: FloatArray | None = None,
) -> Drawings:
    """Prepare maps of R100, Ravg, Rsens and, if failures were simulated, of F100, Favg, Fsens, by name: ``reach``,
    ``finish-top``.

    ``failure_text`` says how many were simulated, empty if none; ``target`` (3,) is the target, to be shown.
    """
    columns = [*law.arm.joint_names, "any joint"]
    map_kinds = {
        "reach": (
            REACH_NAMES,
            "of the path, percent",
            "R: fraction of the path on which the joint may lock and the target stays in reach",
        )
    }
    if failure_text:
        map_kinds["finish"] = (
            FINISH_NAMES,
            "percent",
            f"F: fraction of that part from which the failed arm reaches the target; {failure_text}",
        )
    functions: Drawings = {}
    for kind, (names, label, explanation) in map_kinds.items():
        percentages = {name: measures[name] for name in names}
        for view, draw_view in prepare_place_maps(
            law.task, places, percentages, columns, label, f"{about}\n{explanation}", target, False
        ).items():
            functions[kind + view] = draw_view
    return functions


MEASURE_DEFINITIONS = (
    "R: part of the way on which the joint may lock and the target stays within reach; F: part of that from which the failed "
    "arm reaches it. 100: fraction of the configurations for which that is all of the way; avg: mean; sens: greatest minus "
    "least"
)


def compose_answer(analysis: Workspace | TargetMeasures, fallback: str) -> tuple[str, list[tuple[str, str]]]:
    """Compose the answer and its facts: the part of the path with the target within reach for any lock, and how often it is
    reached.
    """
    means, joints = analysis.means(), analysis.law.arm.joint_names
    reach, finish = means["Ravg"], means["Favg"]
    if np.isnan(reach[-1]):
        return fallback, []
    worst_joint, best_joint = (int(arg_extreme(reach[:-1])) for arg_extreme in (np.nanargmin, np.nanargmax))
    facts = (
        [(format_percent(reach[-1] / 100), "of the way keeps the target within reach whichever joint locks there")]
        if reach[-1]
        else []
    )
    if reach[-1]:
        text = (
            f"Whichever joint locks, the target stays within reach on {format_percent(reach[-1] / 100)} "
            f"of the way, mean over all motions"
        )
    else:
        text = "There is no part of the way on which any joint may lock and the target stays within reach"
    if reach[worst_joint] < reach[best_joint]:
        text += (
            f"; a lock of {joints[worst_joint]} takes most, it leaves "
            f"{format_percent(reach[worst_joint] / 100) if reach[worst_joint] else 'nothing'}"
        )
        facts += (
            [(format_percent(reach[worst_joint] / 100), f"if it is {joints[worst_joint]}, the worst of them")]
            if reach[worst_joint]
            else []
        )
        facts += [(format_percent(reach[best_joint] / 100), f"if it is {joints[best_joint]}, the best of them")]
    if not analysis.ends.sum():
        return f"{text}. No failure was simulated.", facts
    if np.isfinite(finish[:-1]).any():
        rarest = int(np.nanargmin(finish[:-1]))
        mean_finish = float(np.nanmean(finish[:-1])) / 100
        phrases = {0.0: "never gets there after a failure", 1.0: "gets there after every failure that was tried"}
        frequency = phrases.get(mean_finish, f"gets there after {format_percent(mean_finish)} of the failures")
        text += f". Where it is within reach, the failed arm {frequency}"
        if mean_finish and finish[rarest] < np.nanmax(finish[:-1]):
            text += f", least often once {joints[rarest]} has locked ({format_percent(finish[rarest] / 100)})"
        facts += (
            [(format_percent(mean_finish), "of the failures that leave the target within reach do not keep the arm from it")]
            if mean_finish
            else []
        )
    return f"{text}.", facts


def describe_measure_maps(place_noun: str) -> dict[str, tuple[str, str]]:
    """Return the titles and the explanations of the maps that :func:`prepare_measure_maps` draws."""
    descriptions = {
        "reach": (
            "Where the target stays within reach",
            f"R of each of the {place_noun}, for each joint that locks on the way and for any of them.",
        ),
        "finish": (
            "Where the failed arm reaches the target",
            f"F of each of the {place_noun}: of the way on which the target stays within reach.",
        ),
    }
    return {f"{kind}{view}": description for kind, description in descriptions.items() for view in ("", *_VIEW_AXES)}
