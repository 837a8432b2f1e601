"""Single tasks in the report: motions in every scenario, and distributions of the measures."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.teleop import figures
from holdfast.interface.presentation.teleop.motions import Motion, motions_figure, ring
from holdfast.interface.report.page import Block, Picture
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.teleop.analysis.tables import median_operator
from holdfast.teleop.protocol.protocol import Protocol


def build_example_blocks(analysis: Analysis, task: int, protocol: Protocol | None, paths: Paths | None) -> list[Block]:
    """Build the figure of the motions of one task, if any were recorded, and the distributions of its measures.

    ``task`` is its number from 1. ``paths`` returns tool positions; see :meth:`holdfast.teleop.analysis.Analysis.report`.
    """
    task_index = analysis.observed.tasks.index(task)
    blocks: list[Block] = []
    group = analysis.groups.names[analysis.groups.of_task[task_index]]
    operator_note = "Simulated operators. " if analysis.is_simulated else ""
    if paths is not None and protocol is not None and protocol.rows.m == 2:
        blocks += _draw_motions(analysis, task_index, protocol, paths, operator_note)
    observed, computer = analysis.observed, analysis.computer
    computer_values = None
    if computer is not None:
        computer_values = [np.concatenate(values) for values in figures.list_measure_values(computer, [task_index])]
    note = "" if protocol is None or task > len(protocol.notes) else protocol.notes[task - 1]
    caption = (
        f"{operator_note}Task {task} ({group}{f'; {note}' if note else ''}): CPM and all measures of {analysis.subject_phrase} "
        "in each scenario, over the trials that reached the target. Circles: computer control."
    )
    values = figures.list_measure_values(observed, [task_index])
    figure = figures.measures_figure(values, computer_values, [condition.scenario for condition in observed.conditions])
    return [*blocks, Picture(report.svg(figure, f"task-{task}-measures", caption), caption)]


def _draw_motions(analysis: Analysis, task_index: int, protocol: Protocol, paths: Paths, operator_note: str) -> list[Block]:
    """Draw the recorded motions of the median operator and under computer control."""
    observed, task = analysis.observed, analysis.observed.tasks[task_index]
    median_subject = median_operator(observed, task_index, observed.condition_index(analysis.conditions[0].scenario))
    tasks, task_row = protocol.tasks, task - 1
    healthy_ring = ring(protocol.arm, tasks.q0[task_row]) if protocol.rows.name == "planar" else None
    failed_ring = (
        ring(protocol.arm, tasks.q0[task_row], int(tasks.joint[task_row]))
        if healthy_ring is not None and tasks.joint[task_row] >= 0
        else None
    )
    motions = []
    for name, title in (
        (None if median_subject is None else observed.subjects[median_subject], "operator"),
        (None, "computer"),
    ):
        if title == "operator" and name is None:
            continue
        for condition in observed.conditions:
            path: FloatArray | None = paths(name, task, condition.scenario)
            if path is not None and len(path):
                label = f"{condition.label}" if title == "operator" else f"computer, {condition.label}"
                motions.append(
                    Motion(
                        path=path,
                        title=label,
                        target=tasks.target[task_row],
                        radius=protocol.radius,
                        whole=healthy_ring,
                        left=failed_ring if condition.failed else None,
                    )
                )
    if not motions:
        return []
    joint = "" if tasks.joint[task_row] < 0 else f"; {protocol.arm.joint_names[int(tasks.joint[task_row])]} fails"
    operator_text = "" if median_subject is None else f" of the median operator, {observed.subjects[median_subject]},"
    caption = (
        f"{operator_note}Motions{operator_text} and under computer control in task {task}{joint}: from the dot to the target "
        "circle, darker with time, with the straight path dashed."
    )
    if healthy_ring is not None:
        caption += " Circle: workspace of the healthy arm; grey: part lost by the failure (not shown to operators)."
    return [Picture(report.svg(motions_figure(motions), f"task-{task}-motions", caption), caption)]
