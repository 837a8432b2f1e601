"""The figure of a run with faults."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.report import figures as style

if TYPE_CHECKING:
    from holdfast.reaction.run import FaultRun

_POINTS = 1500  # of a line
_LEAST = 1e-5  # rad or m


def figures(run: FaultRun) -> dict[str, Figure]:
    """The tool's way to its target, the joints' distances from their references, and the joints, over time."""
    rows = np.unique(np.linspace(0, len(run.time) - 1, _POINTS).astype(int))
    time, blamed = run.time[rows], {event.joint for event in run.events}
    unit = "rad or m" if run.arm.prismatic.any() else "rad"
    with style.style():
        drawn = Figure(figsize=(1.25 * style.WIDTH, 6.2))
        off, behind, joints = drawn.subplots(3, 1, sharex=True)
        off.plot(time, 1e3 * run.miss[rows], color=style.BLUE)
        off.set(ylabel="mm", title="Tool to its target", ylim=(0, None))
        lag = np.abs(run.reference - run.told)
        for k, name in enumerate(run.arm.joint_names):
            chosen = name in blamed
            look = {"color": style.ORANGE if chosen else style.SKY, "linewidth": 1.6 if chosen else 0.9, "zorder": 2 + chosen}
            behind.plot(time, np.maximum(lag[rows, k], _LEAST), **look)
            joints.plot(time, run.q[rows, k], label=name if chosen else None, **look)
        behind.set(ylabel=unit, title="Joints behind their references", yscale="log")
        joints.set(ylabel=unit, title="Joints", xlabel="time, s", xlim=(0, max(float(time[-1]), 1e-3)))
        if blamed:
            joints.legend(loc="best", fontsize=8)
        _moments(run, [off, behind, joints])
        drawn.suptitle(style.plain(f"{run.arm.name}, {run.law.name}: {run.outcome}", 200), fontsize=9, color=style.SOFT)
        return {"chain": style.finished(drawn)}


def _moments(run: FaultRun, panels: Sequence[Axes]) -> None:
    """Upright lines, named in the first panel."""
    moments = [(event.onset, f"fault: {event.kind}", style.ORANGE) for event in run.events if event.onset <= run.time[-1]]
    moments += [(a.time, a.what, style.INK) for a in run.actions]
    for time, _, colour in moments:
        for axes in panels:
            axes.axvline(time, color=colour, linewidth=0.9, linestyle="--" if colour == style.INK else "-")
    told = "\n".join(f"{time:.3f} s  {words}" for time, words, _ in sorted(moments)[:9])
    panels[0].text(0.985, 0.95, told, transform=panels[0].transAxes, fontsize=7.5, ha="right", va="top")
