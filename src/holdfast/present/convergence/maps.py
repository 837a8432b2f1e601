"""A convergence map as files: figures, a table and a summary."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.convergence.table import save_places
from holdfast.notice import says
from holdfast.present.convergence.places import panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.convergence.maps import ConvergenceMap

_WORDS = ("converged", "stuck", "moving", "undecided", "in_reach", "trapped")


def summary(m: ConvergenceMap) -> dict[str, Any]:
    """Facts of a map as JSON types."""
    shares: dict[str, Any] = {}
    for word in _WORDS:
        shares[word] = {name: {"share": s.value, "low": s.low, "high": s.high} for name, s in m.shares(word).items()}
    return {
        **m.law.arm.entry(),
        "law": m.law.describe(),
        "task": m.law.task.name,
        "over": m.over,
        "places": len(m.places),
        "places_with_motions": int(m.known.any(axis=1).sum()),
        "motions": int(m.known.sum()),
        "seed": m.seed,
        "undecided_runs": m.undecided(),
        "confidence": 0.95,
        "limits_passed_share": dict(zip(m.columns, m.limits_passed[m.known].mean(axis=0).tolist(), strict=True)),
        "shares": shares,
    }


@says("writing the results")
def save(m: ConvergenceMap, folder: str | Path) -> list[Path]:
    """Write ``map.csv`` (a line for each place), ``map.json``, ``outcomes.png`` and the maps ``map-*.png``.

    Raises:
        StoreError: The folder cannot be written.
    """
    from holdfast.report.figures import save_png

    columns = ["motions", *(f"{word}_{name}" for word in _WORDS for name in m.columns)]
    values = [m.known.sum(axis=1), *(m.values(word) for word in _WORDS)]
    files = save_places(folder, "map", m.places, columns, values, summary(m))
    for name, figure in figures(m).items():
        files.append(save_png(figure, Path(folder) / f"{name}.png", 130))
    return files


def outcomes_figure(m: ConvergenceMap) -> Figure:
    """A bar for each locked joint: how the motions ended."""
    from holdfast.report.outcomes import Stack, stack_figure

    arrived = m.shares("converged")
    values = {word: np.array([s.value for s in m.shares(word).values()]) for word in _WORDS}
    trapped = values["trapped"]
    stuck_far = np.array([s.value for s in _means(m, "stuck")])
    moving_far = np.array([s.value for s in _means(m, "moving")])
    parts = {
        "arrives": values["converged"],
        "not there, target in reach": trapped,
        "stuck, target out of reach": stuck_far,
        "keeps moving, target out of reach": moving_far,
        "undecided, target out of reach": 1 - values["converged"] - trapped - stuck_far - moving_far,
    }
    low, high = (np.array([getattr(s, end) for s in arrived.values()]) for end in ("low", "high"))
    names = [f"{name} locked" for name in m.columns[:-1]] + ["no joint locked"]
    bars = Stack("", names, np.column_stack(list(parts.values())), low, high)
    return stack_figure([bars], list(parts), "share of the motions", caption=_told(m))


def figures(m: ConvergenceMap) -> dict[str, Figure]:
    """By file name: ``outcomes``, bars for each joint; ``map-top`` and ``map-side``, or ``map`` for a task in a plane."""
    rows = {"arrives": 100 * m.values("converged"), "not there, in reach": 100 * m.values("trapped")}
    rows = {name: v[:, :-1] for name, v in rows.items()}
    target = m.target[m.known][:, :3, 3]
    alone = m.over == "starts" and len(np.unique(target, axis=0)) == 1
    maps = panels(
        m.law.task,
        m.places,
        rows,
        m.columns[:-1],
        "of the motions, percent",
        f"{_told(m)}\nwhere the {m.over} are",
        target[0] if alone else None,
    )
    return {"outcomes": outcomes_figure(m), **{f"map{view}": figure for view, figure in maps.items()}}


def _told(m: ConvergenceMap) -> str:
    motions, places = int(m.known.sum()), len(m.places)
    return f"{m.law.arm.name}, {m.law.name}, task {m.law.task.name}: {motions} motions over {places} {m.over}, seed {m.seed}"


def _means(m: ConvergenceMap, word: str) -> list[Any]:
    """Shares of runs that ended so with the target out of reach."""
    from holdfast.convergence.maps import shared

    count = m.known.sum(axis=1)
    with np.errstate(invalid="ignore"):
        values = (m.happened(word) & ~m.in_reach).sum(axis=1) / np.where(count > 0, count, np.nan)[:, None]
    return [shared(values[:, k], int(count.max()), 0.95) for k in range(values.shape[1])]
