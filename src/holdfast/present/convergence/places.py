"""Maps over places and tables of means of every analysis of a workspace: in the plane of the task, or from two sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.measures import FINISH, REACH
from holdfast.convergence.places import Places, in_a_plane
from holdfast.present.printing import Rows, alike, number
from holdfast.words import percent

if TYPE_CHECKING:
    from holdfast.arm.task import Task
    from holdfast.control.law import Law
    from holdfast.convergence.origins import Workspace
    from holdfast.convergence.targets import TargetMeasures
    from holdfast.present.results import Drawings

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
) -> Drawings:
    """A figure for each view of the places: ``""``, the plane of the task; or ``-top`` and ``-side``, seen along z and y.

    ``rows`` are by title, (P, C) percentages, NaN where there are none; ``columns`` (C,) titles; ``label`` is of the colour
    bar; ``mark`` (3,) a target to show. Places in a plane that do not form a lattice are averaged in square
    cells if ``gathered``, as those of spatial arms always are; else each is a dot.
    """
    from holdfast.report.places import Plane, binned, place_maps
    from holdfast.report.views import View

    found: Drawings = {}
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
        found[name] = partial(place_maps, plane, shown, columns, label=label, caption=caption + told)
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
) -> Drawings:
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
    found: Drawings = {}
    for word, (names, label, second) in told.items():
        rows = {name: measures[name] for name in names}
        for view, draw in panels(law.task, places, rows, columns, label, f"{about}\n{second}", mark, False).items():
            found[word + view] = draw
    return found


MEASURES = (
    "R: part of the way on which the joint may lock and the target stays within reach; F: part of that from which the failed "
    "arm reaches it. 100: fraction of the configurations for which that is all of the way; avg: mean; sens: greatest minus "
    "least"
)


def answer(found: Workspace | TargetMeasures, nothing: str) -> tuple[str, list[tuple[str, str]]]:
    """What the means say, and in numbers: how much stays within reach whichever joint locks, and is reached."""
    means, names = found.means(), found.law.arm.joint_names
    reach, finish = means["Ravg"], means["Favg"]
    if np.isnan(reach[-1]):
        return nothing, []
    worst, best = (int(f(reach[:-1])) for f in (np.nanargmin, np.nanargmax))
    facts = (
        [(percent(reach[-1] / 100), "of the way keeps the target within reach whichever joint locks there")]
        if reach[-1]
        else []
    )
    if reach[-1]:
        text = (
            f"Whichever joint locks, the target stays within reach on {percent(reach[-1] / 100)} "
            f"of the way, mean over all motions"
        )
    else:
        text = "There is no part of the way on which any joint may lock and the target stays within reach"
    if reach[worst] < reach[best]:
        text += f"; a lock of {names[worst]} takes most, it leaves {percent(reach[worst] / 100) if reach[worst] else 'nothing'}"
        facts += [(percent(reach[worst] / 100), f"if it is {names[worst]}, the worst of them")] if reach[worst] else []
        facts += [(percent(reach[best] / 100), f"if it is {names[best]}, the best of them")]
    if not found.ends.sum():
        return f"{text}. No failure was simulated.", facts
    if np.isfinite(finish[:-1]).any():
        least = int(np.nanargmin(finish[:-1]))
        mean = float(np.nanmean(finish[:-1])) / 100
        after = {0.0: "never gets there after a failure", 1.0: "gets there after every failure that was tried"}
        often = after.get(mean, f"gets there after {percent(mean)} of the failures")
        text += f". Where it is within reach, the failed arm {often}"
        if mean and finish[least] < np.nanmax(finish[:-1]):
            text += f", least often once {names[least]} has locked ({percent(finish[least] / 100)})"
        facts += (
            [(percent(mean), "of the failures that leave the target within reach do not keep the arm from it")] if mean else []
        )
    return f"{text}.", facts


def figure_words(where: str) -> dict[str, tuple[str, str]]:
    """Of the maps that :func:`measure_maps` draws the titles and what they show."""
    told = {
        "reach": (
            "Where the target stays within reach",
            f"R of each of the {where}, for each joint that locks on the way and for any of them.",
        ),
        "finish": (
            "Where the failed arm reaches the target",
            f"F of each of the {where}: of the way on which the target stays within reach.",
        ),
    }
    return {f"{word}{view}": words for word, words in told.items() for view in ("", *_VIEWS)}
