"""The residuals of a record over time, with bounds and alarm."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.diagnosis.answer import Diagnosis
from holdfast.report import figures as style

_POINTS = 2000  # of a line: the largest of what lies between
_LEAST = 1e-2
_TITLES = {
    "torque": "Torque that the model does not know",
    "tracking": "Joint sensors behind their references",
    "tool": "Measured tool beside that of the joints",
}


def figures(found: Diagnosis) -> dict[str, Figure]:
    """A panel for each level that is watched."""
    names, v = [name for name in _TITLES if name in found.signals.levels], found.verdict
    joints = found.arm.joint_names
    with style.style():
        drawn = Figure(figsize=(1.25 * style.WIDTH, 0.6 + 1.9 * len(names)))
        panels = np.atleast_1d(drawn.subplots(len(names), 1, sharex=True))
        for name, axes in zip(names, panels, strict=True):
            values = getattr(found.scaled, name).reshape(len(found.log.t), -1)
            for k, column in enumerate(values.T):
                blamed = name != "tool" and joints[k] == v.joint
                colour = style.ORANGE if blamed else style.BLUE if name == "tool" else style.SKY
                t, y = _thinned(found.log.t, column)
                label = joints[k] if blamed else None
                axes.plot(
                    t, np.maximum(y, _LEAST), color=colour, linewidth=1.6 if blamed else 0.9, label=label, zorder=2 + blamed
                )
            for gap in found.gaps:
                axes.axvspan(*gap, color=style.PALE, linewidth=0, zorder=4)  # over the lines that lead across
            axes.axhline(1.0, color=style.INK, linewidth=1.0, linestyle="--")
            if v.alarm:
                axes.axvline(v.time, color=style.INK, linewidth=1.0)
                if axes is panels[0]:
                    axes.text(v.time, 1.02, f" alarm, {v.time:.3f} s", transform=axes.get_xaxis_transform(), fontsize=8)
            axes.set(title=_TITLES[name], ylabel="of the bound", yscale="log", ylim=(_LEAST, None))
            if v.joint is not None and name != "tool":
                axes.legend(loc="lower left", fontsize=8)
        panels[-1].set(xlabel="time, s", xlim=(found.log.t[0], found.log.t[-1]))
        return {"residuals": style.finished(drawn)}


def _thinned(t: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As many points as a figure shows; of each stretch the largest."""
    there = np.isfinite(y)
    t, y = t[there], y[there]
    every = max(len(t) // _POINTS, 1)
    rows = len(t) // every
    return t[: rows * every : every], y[: rows * every].reshape(rows, every).max(axis=1, initial=0.0)
