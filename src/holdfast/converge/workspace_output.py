"""A workspace analysis as files: figures, a table and a summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.converge.places_file import axis_label, save_places

if TYPE_CHECKING:
    from holdfast.converge.workspace import Workspace

Array = NDArray[np.float64]


def summary(w: Workspace) -> dict[str, Any]:
    """Facts of an analysis as JSON types; NaN is None."""
    from holdfast.converge.workspace import ENDS

    columns = w.columns
    reached = w.configurations > 0
    return {
        "arm": w.law.arm.name,
        "law": w.law.describe(),
        "task": w.law.task.name,
        "target": w.target.tolist(),
        "starts": len(w.places),
        "starts_in_reach": int(reached.sum()),
        "configurations": int(w.configurations.sum()),
        "lost_at_singular_configurations": int(w.lost.sum()),
        "method": w.method,
        "relative_to": w.relative_to,
        "bounds_rad": {name: [list(arc) for arc in arcs] for name, arcs in zip(columns[:-1], w.bounds, strict=True)},
        "ends": dict(zip(ENDS, w.ends.sum(axis=0).tolist(), strict=True)),
        "undecided_share": _number(w.undecided),
        "not_simulated_share": _number(w.saved),
        "mean_percent": {name: dict(zip(columns, map(_number, v), strict=True)) for name, v in w.means().items()},
        "starts_with_R100_full": _counts(w, w.reach.full >= 100 - 1e-9),
        "starts_with_R100_none": _counts(w, w.reach.full == 0),
    }


def save(w: Workspace, folder: str | Path) -> list[Path]:
    """Write ``workspace.csv``, ``workspace.json``, ``reach.png`` and, if failures were looked at, ``finish.png``.

    Raises:
        StoreError: The folder cannot be written.
    """
    from holdfast.converge.workspace import ENDS
    from holdfast.report.figures import save_png

    columns = ["configurations", "lost", *ENDS, *(f"{name}_{column}_percent" for name in w.measures for column in w.columns)]
    values = [w.configurations, w.lost, w.ends, *w.measures.values()]
    files = save_places(folder, "workspace", w.places, columns, values, summary(w))
    for name, figure in figures(w).items():
        files.append(save_png(figure, Path(folder) / f"{name}.png", 130))
    return files


def figures(w: Workspace) -> dict[str, Any]:
    """The maps of Fig. 10 by file name: ``reach``, and ``finish`` if failures were looked at."""
    found = {"reach": _figure(w, ("R100", "Ravg", "Rsens"), "of the way, percent")}
    if w.ends.sum():
        found["finish"] = _figure(w, ("F100", "Favg", "Fsens"), "percent")
    return found


def _figure(w: Workspace, names: tuple[str, ...], label: str) -> Any:
    from holdfast.report.place_maps import Plane, place_maps

    arm, task = w.law.arm, w.law.task
    columns = [*arm.joint_names, "any joint"]
    flat = task.m == 2 and not task.angular
    rows = task.rows[:, :3] if flat else np.eye(3)[[0, 2]]
    words = axis_label(rows[0]), axis_label(rows[1])
    point = rows @ w.target[:3, 3]
    target = (float(point[0]), float(point[1]))
    plane = Plane(w.places.points @ rows.T, words, w.places.cells, w.places.axes, target, "target")
    first = f"{arm.name}, {w.law.name}: {len(w.places)} starts, {int(w.configurations.sum())} configurations; grey: no value"
    second = "R: share of the way on which the joint may lock and the target stays in reach"
    if names[0] == "F100":
        done = f"{w.simulated} failures simulated, {100 * w.undecided:.2f} % undecided at the time limit"
        skipped = f", {int(w.ends[:, -1].sum())} locked where no sink is" if w.method == "procedure" else ""
        second = f"F: share of that part from which the failed arm arrives; {done}{skipped}"
    return place_maps(plane, {name: w.measures[name] for name in names}, columns, label, f"{first}\n{second}")


def _counts(w: Workspace, flags: NDArray[np.bool_]) -> dict[str, int]:
    return dict(zip(w.columns, flags.sum(axis=0).tolist(), strict=True))


def _number(value: Any) -> float | None:
    return None if np.isnan(value) else float(value)
