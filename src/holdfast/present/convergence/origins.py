"""A workspace analysis as files: figures, a table and a summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.table import save_places
from holdfast.notice import says
from holdfast.present.convergence.places import measure_maps

if TYPE_CHECKING:
    from holdfast.convergence.origins import Workspace

Array = NDArray[np.float64]


def summary(w: Workspace) -> dict[str, Any]:
    """Facts of an analysis as JSON types; NaN is None."""
    from holdfast.convergence.analysis import ENDS

    columns = w.columns
    reached = w.configurations > 0
    return {
        **w.law.arm.entry(),
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
        "mean_percent_95": {
            name: {column: [_number(x) for x in ends] for column, ends in zip(columns, v, strict=True)}
            for name, v in w.intervals().items()
        },
        "starts_with_R100_full": _counts(w, w.reach.full >= 100 - 1e-9),
        "starts_with_R100_none": _counts(w, w.reach.full == 0),
    }


@says("writing the results")
def save(w: Workspace, folder: str | Path) -> list[Path]:
    """Write ``workspace.csv``, ``workspace.json`` and the :func:`figures`: ``reach.png``, ``finish.png``.

    Raises:
        StoreError: The folder cannot be written.
    """
    from holdfast.convergence.analysis import ENDS
    from holdfast.report.figures import save_png

    columns = ["configurations", "lost", *ENDS, *(f"{name}_{column}_percent" for name in w.measures for column in w.columns)]
    values = [w.configurations, w.lost, w.ends, *w.measures.values()]
    files = save_places(folder, "workspace", w.places, columns, values, summary(w))
    for name, figure in figures(w).items():
        files.append(save_png(figure, Path(folder) / f"{name}.png", 130))
    return files


def figures(w: Workspace) -> dict[str, Any]:
    """The maps of Fig. 10 by file name: ``reach``, and ``finish`` if failures were looked at.

    For tasks that are not in a plane ``reach-top`` and ``reach-side``, seen along z and along y, and ``finish`` likewise.
    """
    about = (
        f"{w.law.arm.name}, {w.law.name}: {len(w.places)} starts, {int(w.configurations.sum())} configurations; grey: no value"
    )
    failures = ""
    if w.ends.sum():
        failures = f"{w.simulated} failures simulated, {100 * w.undecided:.2f} % undecided at the time limit"
        if w.method == "procedure":
            failures += f", {int(w.ends[:, -1].sum())} locked where no sink is"
    return measure_maps(w.law, w.places, w.measures, about, failures, w.target[:3, 3])


def _counts(w: Workspace, flags: NDArray[np.bool_]) -> dict[str, int]:
    return dict(zip(w.columns, flags.sum(axis=0).tolist(), strict=True))


def _number(value: Any) -> float | None:
    return None if np.isnan(value) else float(value)
