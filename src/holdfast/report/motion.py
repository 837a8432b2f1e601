"""Figures of motions over time: lines with levels to compare them to and moments picked out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, INK, ORANGE, SOFT, WIDTH, finished, plain, style

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Panel:
    """One quantity over time.

    Attributes:
        time: (T,) s.
        values: (T,) the quantity.
        ylabel: What it is, with its unit.
        title: One line.
        level: A value to compare it to, drawn across, and what that is; None if there is none.
        moments: Times (s) and values of points picked out, each with a label.
    """

    time: Array
    values: Array
    ylabel: str
    title: str
    level: tuple[float, str] | None = None
    moments: tuple[tuple[float, float, str], ...] = ()


def motion_figure(panels: Sequence[Panel], caption: str, xlabel: str = "time since the failure, s") -> Figure:
    """Panels side by side over time, with one line of text below that says what was computed."""
    with style():
        figure = Figure(figsize=(WIDTH * len(panels) / 2.4, 3.7))
        for axes, panel in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
            axes.plot(panel.time, panel.values, color=BLUE, linewidth=1.6)
            if panel.level is not None:
                axes.axhline(panel.level[0], color=INK, linewidth=1.0, linestyle=(0, (4.5, 2)), label=plain(panel.level[1]))
                axes.legend(loc="best")
            for t, value, label in panel.moments:
                axes.plot([t], [value], "o", color=ORANGE, markersize=5)
                axes.annotate(plain(label), (t, value), (6, 5), textcoords="offset points", fontsize=9, color=INK)
            axes.set(xlabel=xlabel, ylabel=panel.ylabel, title=plain(panel.title))
            axes.set_xlim(0, float(panel.time[-1]) or 1.0)
            axes.margins(y=0.12)
        figure.supxlabel(plain(caption, 200), fontsize=9, color=SOFT)
        return finished(figure)
