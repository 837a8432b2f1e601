"""Maps over places and tables of means of every analysis of a workspace: in the plane of the task, or from two sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.measures import FINISH, REACH
from holdfast.convergence.places import Places, in_a_plane
from holdfast.present.printing import Rows, alike, number

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.arm.task import Task
    from holdfast.control.law import Law
    from holdfast.convergence.origins import Workspace
    from holdfast.convergence.targets import TargetMeasures

Array = NDArray[np.float64]

_BINS = 12  # cells along the longer edge
_VIEWS = {"-top": (0, 1), "-side": (0, 2)}


def panels(
    task: Task,
    places: Places,
    rows: Mapping[str, Array],
    columns: Sequence[str],
    label: str,
    caption: str,
    mark: Array | None = None,
    gathered: bool = True,
) -> dict[str, Figure]:
    """A figure for each view of the places: ``""``, the plane of the task; or ``-top`` and ``-side``, seen along z and y.

    ``rows`` are by title, (P, C) percentages, NaN where there are none; ``columns`` (C,) titles; ``label`` is of the colour
    bar; ``mark`` (3,) a target to show. Places in a plane that do not form a lattice are averaged in square
    cells if ``gathered``, as those of spatial arms always are; else each is a dot.
    """
    from holdfast.report.places import Plane, binned, place_maps
    from holdfast.report.views import View

    found = {}
    views = {"": None} if in_a_plane(task) else _VIEWS
    for name, axes in views.items():
        right, up = task.rows[:2, :3] if axes is None else np.eye(3)[list(axes)]
        view = View(right, up, name)
        where = None if mark is None else tuple(view.of(mark).tolist())
        points, told, shown = view.of(places.points), "", dict(rows)
        plane = Plane(points=points, labels=view.names, cells=places.cells, axes=places.axes, mark=where, mark_label="target")
        if places.cells is None and (gathered or axes is not None):
            pairs = {word: binned(points, v, _BINS) for word, v in rows.items()}
            first = next(iter(pairs.values()))[0]
            plane = replace(first, labels=view.names, mark=where, mark_label="target")
            shown = {word: v for word, (_, v) in pairs.items()}
            told = "\nmean over the places in a cell" + ("" if axes is None else ", whatever their depth")
        found[name] = place_maps(plane, shown, columns, label=label, caption=caption + told)
    return found


def mean_rows(found: Workspace | TargetMeasures, over: str, intervals: bool = True) -> Rows:
    """A row for each joint and ``any``, a column for the mean of each measure."""
    means, sure = found.means(), found.intervals()
    names = (*found.law.arm.joint_names, "any")
    columns = [
        [with_interval(v[k], *sure[m][k]) for k in range(len(names))] if intervals else alike(v) for m, v in means.items()
    ]
    rows = [list(row) for row in zip(names, *columns, strict=True)]
    return Rows(["joint", *means], rows, f"mean over {over}, percent" + " (and 95 % interval)" * intervals)


def with_interval(value: float, low: float, high: float) -> str:
    """A percentage over its interval."""
    return number(value) if np.isnan(value) else f"{value:.1f}\n{low:.1f} to {high:.1f}"


def measure_maps(
    law: Law, places: Places, measures: Mapping[str, Array], about: str, failures: str, mark: Array | None = None
) -> dict[str, Figure]:
    """Maps of R100, Ravg, Rsens and, where failures were looked at, of F100, Favg, Fsens, by name: ``reach``, ``finish-top``.

    ``failures`` says how many were simulated, empty if none; ``mark`` (3,) is the target, to be shown.
    """
    columns = [*law.arm.joint_names, "any joint"]
    told = {
        "reach": (
            REACH,
            "of the path, percent",
            "R: fraction of the path on which the joint may lock and the target stays in reach",
        )
    }
    if failures:
        told["finish"] = (
            FINISH,
            "percent",
            f"F: fraction of that part from which the failed arm reaches the target; {failures}",
        )
    found = {}
    for word, (names, label, second) in told.items():
        rows = {name: measures[name] for name in names}
        for view, figure in panels(law.task, places, rows, columns, label, f"{about}\n{second}", mark, False).items():
            found[word + view] = figure
    return found
