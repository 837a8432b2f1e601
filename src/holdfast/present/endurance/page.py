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


def figures(e: Endurance) -> dict[str, Figure]:
    """Survival over time, beside that of other motions, and of a motion that was looked for the map of all configurations."""
    level = None if e.bound is None else (100 * e.bound, "no motion survives more, in the mean")
    mine = "most locks survived" if e.found is not None else "this motion"
    lines = [(mine, 100 * e.curve()), *((other.name, 100 * other.curve) for other in e.beside)]
    drawn = {"survival": lines_figure(e.time, lines, level, "if a joint locks now, survived, %")}
    return drawn if e.found is None else {**drawn, "map": _map(e, e.found)}


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
    for t, (nodes, survives) in enumerate(zip(found.nodes, found.survives, strict=True)):
        bins = np.clip(np.searchsorted(edges, place(nodes[:, most]), side="right") - 1, 0, _BINS - 1)
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


def save(e: Endurance, folder: Path, command: str = "") -> list[Path]:
    """endurance.json, motion.csv, survival.png, map.png of a motion that was looked for, and report.html."""
    (file,) = put(folder, {"endurance.json": json.dumps(e.to_dict(), indent=2) + "\n"})
    drawn = figures(e)
    pictures = [save_png(figure, folder / f"{name}.png", 150) for name, figure in drawn.items()]
    return [file, e.to_csv(folder / "motion.csv"), *pictures, results.write(e, folder / "report.html", command, drawn)]
