"""A convergence map as files: figures, a table and a summary."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.converge.places_file import axis_label, save_places

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.converge.convergence_map import ConvergenceMap

_WORDS = ("converged", "stuck", "moving", "undecided", "in_reach", "trapped")
_BINS = 12
_VIEWS = {"top": (0, 1), "side": (0, 2)}


def summary(m: ConvergenceMap) -> dict[str, Any]:
    """Facts of a map as JSON types."""
    shares: dict[str, Any] = {}
    for word in _WORDS:
        shares[word] = {name: {"share": s.value, "low": s.low, "high": s.high} for name, s in m.shares(word).items()}
    return {
        "arm": m.law.arm.name,
        "law": m.law.describe(),
        "task": m.law.task.name,
        "over": m.over,
        "places": len(m.places),
        "places_with_motions": int(m.known.any(axis=1).sum()),
        "motions": int(m.known.sum()),
        "seed": m.seed,
        "confidence": 0.95,
        "limits_passed_share": dict(zip(m.columns, m.limits_passed[m.known].mean(axis=0).tolist(), strict=True)),
        "shares": shares,
    }


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
    from holdfast.report.place_maps import Plane, binned, place_maps

    task, told = m.law.task, _told(m)
    found = {"outcomes": outcomes_figure(m)}
    rows = {"arrives": 100 * m.values("converged"), "not there, in reach": 100 * m.values("trapped")}
    rows = {name: v[:, :-1] for name, v in rows.items()}
    target = m.target[m.known]
    alone = m.over == "starts" and len(np.unique(target[:, :3, 3], axis=0)) == 1
    views = {"map": None} if task.m == 2 and not task.angular else {f"map-{name}": axes for name, axes in _VIEWS.items()}
    for name, axes in views.items():
        across = task.rows[:, :3] if axes is None else np.eye(3)[list(axes)]
        words = axis_label(across[0]), axis_label(across[1])
        point = across @ target[0, :3, 3] if len(target) else np.zeros(2)
        mark = (float(point[0]), float(point[1])) if alone else None
        points = m.places.points @ across.T
        if m.places.cells is not None:
            plane, shown = Plane(points, words, m.places.cells, m.places.axes, mark, "target"), rows
            depth = ""
        else:
            pairs = {word: binned(points, v, _BINS) for word, v in rows.items()}
            first = next(iter(pairs.values()))[0]
            plane = replace(first, labels=words, mark=mark, mark_label="target")
            shown = {word: v for word, (_, v) in pairs.items()}
            depth = "; mean over the places in a cell" + ("" if axes is None else ", whatever their depth")
        found[name] = place_maps(
            plane, shown, m.columns[:-1], "of the motions, percent", f"{told}\nwhere the {m.over} are{depth}"
        )
    return found


def _told(m: ConvergenceMap) -> str:
    motions, places = int(m.known.sum()), len(m.places)
    return f"{m.law.arm.name}, {m.law.name}, task {m.law.task.name}: {motions} motions over {places} {m.over}, seed {m.seed}"


def _means(m: ConvergenceMap, word: str) -> list[Any]:
    """Shares of runs that ended so with the target out of reach."""
    from holdfast.converge.convergence_map import shared

    count = m.known.sum(axis=1)
    with np.errstate(invalid="ignore"):
        values = (m.happened(word) & ~m.in_reach).sum(axis=1) / np.where(count > 0, count, np.nan)[:, None]
    return [shared(values[:, k], int(m.known.sum()), 0.95) for k in range(values.shape[1])]
