"""Figure of the residuals of a record over time, with bounds and alarm."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.interface.report import figures as style
from holdfast.response.diagnosis.answer import Diagnosis

_MAX_POINTS = 2000  # of a line: the largest of what lies between
_MIN_PLOTTED_RATIO = 1e-2
_PANEL_TITLES = {
    "torque": "Torque that the model does not know",
    "tracking": "Joint sensors behind their references",
    "tool": "Measured tool beside that of the joints",
}


def figures(diagnosis: Diagnosis) -> dict[str, Figure]:
    """Draw a panel for each monitored level."""
    names, verdict = [name for name in _PANEL_TITLES if name in diagnosis.signals.levels], diagnosis.verdict
    joints = diagnosis.arm.joint_names
    with style.style():
        figure = Figure(figsize=(1.25 * style.WIDTH_IN, 0.6 + 1.9 * len(names)))
        panels = np.atleast_1d(figure.subplots(len(names), 1, sharex=True))
        for name, axes in zip(names, panels, strict=True):
            values = getattr(diagnosis.scaled, name).reshape(len(diagnosis.log.t), -1)
            for joint, column in enumerate(values.T):
                is_blamed = name != "tool" and joints[joint] == verdict.joint
                color = style.ORANGE if is_blamed else style.BLUE if name == "tool" else style.SKY
                times, residuals = _thin_samples(diagnosis.log.t, column)
                label = joints[joint] if is_blamed else None
                axes.plot(
                    times,
                    np.maximum(residuals, _MIN_PLOTTED_RATIO),
                    color=color,
                    linewidth=1.6 if is_blamed else 0.9,
                    label=label,
                    zorder=2 + is_blamed,
                )
            for interval in diagnosis.gaps:
                axes.axvspan(*interval, color=style.EMPTY_COLOR, linewidth=0, zorder=4)  # over the lines that lead across
            axes.axhline(1.0, color=style.INK, linewidth=1.0, linestyle="--")
            if verdict.alarm:
                axes.axvline(verdict.time, color=style.INK, linewidth=1.0)
                if axes is panels[0]:
                    axes.text(
                        verdict.time, 1.02, f" alarm, {verdict.time:.3f} s", transform=axes.get_xaxis_transform(), fontsize=8
                    )
            axes.set(title=_PANEL_TITLES[name], ylabel="of the bound", yscale="log", ylim=(_MIN_PLOTTED_RATIO, None))
            if verdict.joint is not None and name != "tool":
                axes.legend(loc="lower left", fontsize=8)
        panels[-1].set(xlabel="time, s", xlim=(diagnosis.log.t[0], diagnosis.log.t[-1]))
        return {"residuals": style.settle_layout(figure)}


def _thin_samples(t: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Reduce a signal to the number of points that a figure shows; each segment keeps its largest value."""
    is_finite = np.isfinite(y)
    t, y = t[is_finite], y[is_finite]
    stride = max(len(t) // _MAX_POINTS, 1)
    segment_count = len(t) // stride
    return t[: segment_count * stride : stride], y[: segment_count * stride].reshape(segment_count, stride).max(
        axis=1, initial=0.0
    )
