"""Figure of a run with faults."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.interface.report import figures as style

if TYPE_CHECKING:
    from holdfast.response.supervisor.run import FaultRun

_MAX_POINTS = 1500  # of a line
_MIN_PLOTTED_ERROR = 1e-5  # rad or m


def figures(run: FaultRun) -> dict[str, Figure]:
    """Draw over time the distance of the tool from its target, the tracking errors of the joints, and the joints."""
    samples = np.unique(np.linspace(0, len(run.time) - 1, _MAX_POINTS).astype(int))
    time, faulty_joints = run.time[samples], {event.joint for event in run.events}
    unit = "rad or m" if run.arm.prismatic.any() else "rad"
    with style.style():
        figure = Figure(figsize=(1.25 * style.WIDTH_IN, 6.2))
        distance_axes, error_axes, joint_axes = figure.subplots(3, 1, sharex=True)
        distance_axes.plot(time, 1e3 * run.position_error[samples], color=style.BLUE)
        distance_axes.set(ylabel="mm", title="Tool to its target", ylim=(0, None))
        tracking_error = np.abs(run.reference - run.q_measured)
        for index, name in enumerate(run.arm.joint_names):
            is_faulty = name in faulty_joints
            line_style = {
                "color": style.ORANGE if is_faulty else style.SKY,
                "linewidth": 1.6 if is_faulty else 0.9,
                "zorder": 2 + is_faulty,
            }
            error_axes.plot(time, np.maximum(tracking_error[samples, index], _MIN_PLOTTED_ERROR), **line_style)
            joint_axes.plot(time, run.q[samples, index], label=name if is_faulty else None, **line_style)
        error_axes.set(ylabel=unit, title="Joints behind their references", yscale="log")
        joint_axes.set(ylabel=unit, title="Joints", xlabel="time, s", xlim=(0, max(float(time[-1]), 1e-3)))
        if faulty_joints:
            joint_axes.legend(loc="best", fontsize=8)
        _mark_events(run, [distance_axes, error_axes, joint_axes])
        figure.suptitle(style.format_label(f"{run.arm.name}, {run.law.name}: {run.outcome}", 200), fontsize=9, color=style.SOFT)
        return {"chain": style.settle_layout(figure)}


def _mark_events(run: FaultRun, panels: Sequence[Axes]) -> None:
    """Draw a vertical line for each fault and action, and list them in the first panel."""
    moments = [(event.onset, f"fault: {event.kind}", style.ORANGE) for event in run.events if event.onset <= run.time[-1]]
    moments += [(action.time, action.what, style.INK) for action in run.actions]
    for time, _, color in moments:
        for axes in panels:
            axes.axvline(time, color=color, linewidth=0.9, linestyle="--" if color == style.INK else "-")
    legend_text = "\n".join(f"{time:.3f} s  {label}" for time, label, _ in sorted(moments)[:9])
    panels[0].text(0.985, 0.95, legend_text, transform=panels[0].transAxes, fontsize=7.5, ha="right", va="top")
