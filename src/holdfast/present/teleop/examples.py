"""Single tasks in the report: the motions in every scenario, and the distributions of the measures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.present.teleop import figures
from holdfast.present.teleop.motions import Motion, motions_figure, ring
from holdfast.report.figures import svg
from holdfast.report.page import Block, Picture
from holdfast.teleop.analysis.observations import NAMES
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.teleop.analysis.tables import median_operator

if TYPE_CHECKING:
    from holdfast.teleop.protocol.protocol import Protocol

Array = NDArray[np.float64]


def example_blocks(a: Analysis, task: int, protocol: Protocol | None, paths: Paths | None) -> list[Block]:
    """Motions, if there are any, and distributions of one task.

    Args:
        a: The analysis.
        task: Its number.
        protocol: Of the experiment; task k there is number k + 1 here.
        paths: See :meth:`holdfast.teleop.analysis.Analysis.report`.
    """
    t = a.observed.tasks.index(task)
    blocks: list[Block] = []
    group = a.groups.names[a.groups.of_task[t]]
    who = "Simulated operators. " if a.simulated else ""
    if paths is not None and protocol is not None and protocol.rows.m == 2:
        blocks += _motions(a, t, protocol, paths, who)
    o = a.observed
    every = np.concatenate([o.cpm[..., None], o.measures], axis=-1)[:, t, :, : len(NAMES) + o.rated]
    values = [[every[:, s, k] for s in range(len(o.conditions))] for k in range(every.shape[-1])]
    its = None
    if a.computer is not None:
        machine = np.concatenate([a.computer.cpm[0, t, :, None], a.computer.measures[0, t]], axis=-1)
        its = [machine[:, k] for k in range(len(NAMES))]
    note = "" if protocol is None or task > len(protocol.notes) else protocol.notes[task - 1]
    caption = (
        f"{who}Task {task} ({group}{f'; {note}' if note else ''}): CPM and all measures of {a.who} in each scenario, of "
        f"the trials that reached the target. Circles: the computer."
    )
    figure = figures.measures_figure(values, its, [c.scenario for c in o.conditions])
    return [*blocks, Picture(svg(figure, f"task-{task}-measures", caption), caption)]


def _motions(a: Analysis, t: int, protocol: Protocol, paths: Paths, who: str) -> list[Block]:
    """Of the median operator, and of the computer, as far as they were recorded."""
    o, task = a.observed, a.observed.tasks[t]
    middle = median_operator(o, t, o.index(a.conditions[0].scenario))
    tasks, k = protocol.tasks, task - 1
    whole = ring(protocol.arm, tasks.q0[k]) if protocol.rows.name == "planar" else None
    left = ring(protocol.arm, tasks.q0[k], int(tasks.joint[k])) if whole is not None and tasks.joint[k] >= 0 else None
    found = []
    for name, title in ((None if middle is None else o.subjects[middle], "operator"), (None, "computer")):
        if title == "operator" and name is None:
            continue
        for c in o.conditions:
            path: Array | None = paths(name, task, c.scenario)
            if path is not None and len(path):
                label = f"{c.label}" if title == "operator" else f"computer, {c.label}"
                found.append(
                    Motion(
                        path=path,
                        title=label,
                        target=tasks.target[k],
                        radius=protocol.radius,
                        whole=whole,
                        left=left if c.failed else None,
                    )
                )
    if not found:
        return []
    joint = "" if tasks.joint[k] < 0 else f"; {protocol.arm.joint_names[int(tasks.joint[k])]} fails"
    operator = "" if middle is None else f" of the median operator, {o.subjects[middle]},"
    caption = (
        f"{who}Motions{operator} and of the computer in task {task}{joint}: from light to dark, from the dot to "
        f"the target circle, with "
        "the straight way dashed."
    )
    if whole is not None:
        caption += " Circle: what the healthy arm reaches; grey: what the failure takes away (not shown to operators)."
    return [Picture(svg(motions_figure(found), f"task-{task}-motions", caption), caption)]
