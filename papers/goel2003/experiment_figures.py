"""Figures 2 to 7, with the computer and with simulated operators."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.interface.presentation.teleop import (
    Motion,
    Scatter,
    bank_figure,
    measures_figure,
    motions_figure,
    ring,
    scatter_figure,
    tasks_figure,
)
from holdfast.interface.report import SOFT, save_png, style
from holdfast.teleop.analysis import Analysis, median_operator
from holdfast.teleop.bank import Binning, TaskBank
from papers.goel2003.simulated_operators import Study, shown

_SCALES = {
    "anticipated": "anticipated: CPM3 of the computer",
    "actual": "actual: median CPM3, simulated operators",
    "perceived": "perceived: median rating, simulated",
}


def draw(s: Study, made: TaskBank, cells: Binning, folder: Path) -> dict[str, str]:
    """Save all figures; their names and titles."""
    a = s.analysis
    save_png(_bank(s, made, cells), folder / "figure-2.png", 110)
    save_png(_difficulty(a), folder / "figure-3.png", 110)
    found = tasks_figure(a, ("Simulated operators: the median operator of each task", "Computer"))
    save_png(found, folder / "figure-4.png", 110)
    titles = {
        "figure-2": "Fig. 2: 1200 tasks (seed 1) and the tasks of the shipped protocol, computer control",
        "figure-3": "Fig. 3: anticipated, actual and perceived difficulty of 24 tasks, 24 simulated operators",
        "figure-4": "Fig. 4: CPM under both laws, tasks sorted by CPM3; simulated operators and computer",
    }
    for number, (group, task) in zip((5, 6, 7), shown(a).items(), strict=True):
        save_png(_motions(s, task), folder / f"figure-{number}.png", 110)
        save_png(_measures(a, task), folder / f"figure-{number}-measures.png", 110)
        what = f"Fig. {number}: {'an' if group == 'easy' else 'a'} {group} task ({task} of our protocol)"
        titles[f"figure-{number}"] = f"{what}, simulated median operator (above) and computer (below) in the four scenarios"
        titles[f"figure-{number}-measures"] = f"{what}, CPM and measures of 24 simulated operators, and of the computer"
    return titles


def _bank(s: Study, made: TaskBank, cells: Binning) -> Figure:
    """The bank, with those of the protocol's tasks that are of it; their notes say which."""
    rows = [int(m[1]) - 1 for note in s.protocol.notes if (m := re.match(r"bank task (\d+),", note))]
    chosen = np.array(rows, dtype=np.int64)
    np.testing.assert_array_equal(made.tasks.q0[chosen], s.protocol.tasks.q0[: len(chosen)])
    plain = chosen[: len(s.protocol.tasks) - 2]
    return bank_figure(made, cells, plain, special=chosen[len(plain) :])


def _difficulty(a: Analysis) -> Figure:
    table = a.table("tasks").sort_values("task")
    panels = []
    for c in a.correlations:
        if c.first in _SCALES:
            x, y = (table[name].to_numpy(dtype=np.float64) for name in (c.first, c.second))
            panels.append(
                Scatter(x=x, y=y, xlabel=_SCALES[c.first], ylabel=_SCALES[c.second], correlation=c, groups=a.groups.of_task)
            )
    return scatter_figure(panels, a.groups.names)


def _motions(s: Study, task: int) -> Figure:
    a, p, k = s.analysis, s.protocol, task - 1
    whole, left = ring(p.arm, p.tasks.q0[k]), ring(p.arm, p.tasks.q0[k], int(p.tasks.joint[k]))
    middle = median_operator(a.observed, a.observed.tasks.index(task), a.observed.condition_index(a.conditions[0].scenario))
    motions = []
    for who, name in ((None if middle is None else a.observed.subjects[middle], "simulated"), (None, "computer")):
        for c in a.observed.conditions:
            path = s.paths(who, task, c.scenario)
            if path is not None:
                motions.append(
                    Motion(
                        path=path,
                        title=f"{name}, {c.label}",
                        target=p.tasks.target[k],
                        radius=p.radius,
                        whole=whole,
                        left=left if c.failed else None,
                    )
                )
    return motions_figure(motions)


def _measures(a: Analysis, task: int) -> Figure:
    o, t = a.observed, a.observed.tasks.index(task)
    assert a.computer is not None
    every = np.concatenate([o.cpm[..., None], o.measures], axis=-1)[:, t]
    values = [[every[:, s, k] for s in range(len(o.conditions))] for k in range(every.shape[-1])]
    machine = np.concatenate([a.computer.cpm[0, t, :, None], a.computer.measures[0, t]], axis=-1)
    figure = measures_figure(values, list(machine.T), [c.scenario for c in o.conditions])
    with style():
        figure.text(0.995, 0.01, f"task {task}, {a.subject_phrase}", ha="right", va="bottom", fontsize=9, color=SOFT)
    return figure
