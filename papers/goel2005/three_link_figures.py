"""Figs. 5 to 7, made again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report import BLUE, FAINT, INK, WIDTH_IN, save_png, settle_layout, style
from papers.goel2005 import drawing

Array = NDArray[np.float64]


def figure_5_6(found: Sequence[hf.Runs], title: str, path: Path) -> None:
    """Both elbows of a start."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.82, 4.7))
        for axes, run in zip(figure.subplots(1, 2, sharey=True), found, strict=True):
            time = _draw(axes, run, 30.0)
            axes.set_title(f"{run.outcome}, error {run.error:.4f} m" if run.error > 1e-4 else str(run.outcome))
        drawing.caption(
            figure,
            f"{title} (filled). Poses at the start (grey), on the way (light) and at the end (black) after {time:.1f}/Ke; "
            "blue: the end effector; cross: the target. One panel for each elbow.",
            100,
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_7(turning: hf.Runs, resting: hf.Runs, path: Path) -> None:
    """An arm that never rests, and one just beyond the angle from which on it does."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.82, 7.6))
        upper, lower = figure.subplots(2, 2, height_ratios=(1.5, 1))
        for axes, below, run, name in zip(upper, lower, (turning, resting), ("30", "44"), strict=True):
            _draw(axes, run, 12.0)
            axes.set_title(f"joint 3 locked at {name} deg: {run.outcome}")
            way = run.path(0, 2001, until=40.0)
            below.plot(way.time, np.degrees(way.q[:, 0]), color=BLUE)
            below.set(xlabel="time, 1/Ke", ylabel="joint 1, deg (not wrapped)", xlim=(0, 40))
        drawing.caption(
            figure,
            "Fig. 7. Above: start (grey), poses on the way (light), the last one (black) after 12/Ke, path of the end "
            "effector (blue), "
            "target (cross), locked joint (filled). Below: joint 1 over time.",
            100,
        )
        save_png(settle_layout(figure), path, dpi=110)


def _draw(axes: Axes, run: hf.Runs, until: float) -> float:
    way = run.path(0, 3001, until=until)
    locked = int(np.argmin(run.lock_time))
    travelled = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way.x, axis=0), axis=1))])
    for share in np.linspace(0, 1, 7)[1:-1]:
        k = int(np.searchsorted(travelled, share * travelled[-1]))
        axes.plot(*drawing.joints(way.q[k]).T, "-", color=FAINT, linewidth=1.4, zorder=1)
    axes.plot(*way.x[:, :2].T, color=BLUE, linewidth=1.8, zorder=2)
    drawing.arm(axes, way.q[0], locked, color="#8b949e")
    drawing.arm(axes, way.q[-1], locked, color=INK)
    drawing.target(axes, run.target)
    drawing.plane(axes, 3.05)
    return float(way.time[-1])
