"""Pictures and page of what a motion survives."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.files.output import put
from holdfast.present import results
from holdfast.present.endurance.strips import Strips, lines_figure, strip_figure
from holdfast.report.figures import save_png
from holdfast.report.scenes import Scale
from holdfast.solvers import joint_space

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.endurance.endurance import Endurance, Found

Array = NDArray[np.float64]

_BINS = 64
_FINER = 8  # places in a piece between two nodes


def figures(e: Endurance) -> dict[str, Figure]:
    """Survival over time, beside that of other motions, the map of all configurations if it was looked for, velocity jumps."""
    level = None if e.bound is None else (100 * e.bound, "no motion survives more, in the mean")
    mine = "most locks survived" if e.found is not None else "this motion"
    lines = [(mine, 100 * e.curve()), *((other.name, 100 * other.curve) for other in e.beside)]
    drawn = {"survival": lines_figure(e.time, lines, "if a joint locks now, survived, %", level=level, percents=True)}
    if e.found is not None:
        drawn["map"] = _map(e, e.found)
    jumps = list(zip(e.arm.joint_names, e.jump.linear.T, strict=True))
    drawn["jump"] = lines_figure(e.time, jumps, "tool velocity lost, m/s", percents=False)
    return drawn


def _map(e: Endurance, found: Found) -> Figure:
    """Which locks are survivable at every node, over the joint that the self-motion moves most."""
    most = int(found.moved.argmax())
    factor, unit = e.arm.joints[most].shown
    turning = joint_space.turning(e.arm)[most]

    def place(q: Array) -> Array:
        return np.asarray(factor * (np.arctan2(np.sin(q), np.cos(q)) if turning else q))

    every = place(np.concatenate(found.nodes)[:, most])
    low, high = every.min(), every.max()
    edges = np.linspace(low, high + 1e-9 * (high - low + 1), _BINS + 1)
    share = e.rates.each / e.rates.total
    values = np.full((e.arm.n + 1, len(e.time), _BINS), np.nan)
    for t in range(len(e.time)):
        where, survives = _along(found, t, most)
        bins = np.clip(np.searchsorted(edges, place(where), side="right") - 1, 0, _BINS - 1)
        best = np.argsort(survives @ share, kind="stable")  # what is written last stays
        values[0, t, bins[best]] = 100 * (survives @ share)[best]
        values[1:, t, bins[best]] = 100.0 * survives[best].T
    way = place(e.q[:, most])
    way[1:][np.abs(np.diff(way)) > (high - low) / 2] = np.nan  # round by way of pi
    panels = [
        Strips(values[0], "all locks"),
        *(Strips(v, f"lock of {n}") for v, n in zip(values[1:], e.arm.joint_names, strict=True)),
    ]
    label, ylabel = "survivable, %", f"{e.arm.joint_names[most]}, {unit}"
    return strip_figure(e.time, edges, panels, way, scale=Scale(0.0, 100.0), label=label, ylabel=ylabel)


def _along(found: Found, t: int, joint: int) -> tuple[Array, Array]:
    """Values (N,) of a joint along the curves of a pose, finer than its nodes, with the verdicts (N, n) of the nearer node."""
    values, beside = found.nodes[t][:, joint], np.diff(found.curve[t]) == 0
    k = np.flatnonzero(beside)
    share = np.linspace(0, 1, _FINER, endpoint=False)[:, None]
    between = values[k] + share * (values[k + 1] - values[k])
    nearer = np.where(share < 0.5, k, k + 1)
    order = np.concatenate([np.arange(len(values)), nearer.ravel()])
    return np.concatenate([values, between.ravel()]), found.survives[t][order]


def save(e: Endurance, folder: Path, command: str = "") -> list[Path]:
    """endurance.json, motion.csv, survival.png, jump.png, map.png of a motion that was looked for, and report.html."""
    (file,) = put(folder, {"endurance.json": json.dumps(e.to_dict(), indent=2) + "\n"})
    drawn = figures(e)
    pictures = [save_png(figure, folder / f"{name}.png", 150) for name, figure in drawn.items()]
    return [file, e.to_csv(folder / "motion.csv"), *pictures, results.write(e, folder / "report.html", command, drawn)]
