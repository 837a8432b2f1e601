"""Fig. 9: stationary curves of the three joints, and the determinant that tells sinks from others."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from holdfast.control.equilibria import Curves, EquilibriumCurve
from holdfast.interface.report import INK, KIND_STYLES, WIDTH_IN, save_png, settle_layout, style
from papers.goel2005 import drawing
from papers.goel2005.three_links import wrapped

Array = NDArray[np.float64]

SEEDS = (("S1", (125.0, -98.8754, 0.0)), ("S2", (106.8745, -52.4994, 180.0)))  # of joint 1, deg
BAND = 1e-2  # below it the scale of the determinant is linear


def figure_9(found: Sequence[Curves], path: Path) -> None:
    """Above the curves over the locked angle, below the determinant along them."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 7.4))
        upper, lower = figure.subplots(2, 3, height_ratios=(1.35, 1), sharex="col")
        for above, below, c, other in zip(upper, lower, found, (1, 0, 0), strict=True):
            for curve in c.curves:
                _stretches(above, curve, wrapped(np.degrees(curve.q[:, other])))
                if not curve.degenerate:
                    _stretches(below, curve, np.prod(curve.eigenvalues, axis=1).real)
            above.set(xlim=(0, 360), xticks=range(0, 361, 60))
            above.set(title=f"joint {c.joint + 1} locked", ylabel=f"joint {other + 1}, deg", ylim=(-180, 180))
            above.set_yticks(range(-180, 181, 60))
            below.set_yscale("symlog", linthresh=BAND)
            below.axhline(0, color=INK, linewidth=0.8)
            for side in (BAND, -BAND):
                below.axhline(side, color=INK, linewidth=0.8, linestyle=drawing.DASHED)
            below.set(xlabel=f"locked angle of joint {c.joint + 1}, deg", ylabel="determinant, Ke$^2$", ylim=(-300, 300))
        for name, q in SEEDS:
            upper[0].plot(q[0], q[1], "o", color="white", markeredgecolor=INK, markersize=6, zorder=6)
            upper[0].annotate(name, (q[0], q[1]), (6, 6), textcoords="offset points", zorder=7)
        words = ("sink", "saddle", "source", "degenerate")
        handles = [
            Line2D([], [], color=KIND_STYLES[k][0], linewidth=KIND_STYLES[k][1], linestyle=KIND_STYLES[k][2], label=k)
            for k in words
        ]
        figure.legend(handles=handles, loc="outside upper center", ncols=4)
        drawing.caption(
            figure,
            "Fig. 9, for all three joints, target (1.5, 1.5) m. Above: every curve of erroneous stationary points "
            "over the locked "
            "angle, by kind; S1, S2: seeds for joint 1. Below: determinant of the linearised motion of the two healthy joints "
            "(logarithmic outside the dashed lines); curves of degenerate points, on which it is 0, are left out.",
        )
        save_png(settle_layout(figure), path, dpi=110)


def _stretches(axes: Axes, curve: EquilibriumCurve, values: Array) -> None:
    """Values along a curve over the locked angle, drawn by kind, broken where an angle comes round."""
    x = np.degrees(curve.locked_values) % 360
    for s in curve.segments:
        rows = slice(s.first, s.last + 1)
        color, width, line, _ = KIND_STYLES[s.kind.word]
        a, b = x[rows].copy(), values[rows].copy()
        jumps = np.flatnonzero((np.abs(np.diff(a)) > 180) | (np.abs(np.diff(b)) > 180)) + 1
        axes.plot(np.insert(a, jumps, np.nan), np.insert(b, jumps, np.nan), color=color, linewidth=width, linestyle=line)
