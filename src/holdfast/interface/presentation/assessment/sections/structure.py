"""Table of all tasks with the joints that are single points of failure."""

from __future__ import annotations

from markupsafe import Markup

from holdfast.core.formatting import format_number, format_percent
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Table, Text


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the table of all tasks with the joints whose lock makes the task singular in every configuration."""
    run_structure, all_structures = facts.task_structures
    joint_names = facts.assessment.arm.joint_names
    table_rows: list[list[str | Markup]] = []
    for structure in all_structures:
        cells: list[str | Markup] = [
            Markup("{} {}").format(structure.task, "(this run)") if structure is run_structure else structure.task,
            str(structure.redundancy),
        ]
        near_losses = dict(structure.nearly)
        weaknesses = {weakness.joint: weakness for weakness in structure.weak}
        for joint in range(len(joint_names)):
            is_fatal = joint in structure.fatal or structure.never
            cell = Markup('<span class="fatal">fatal</span>') if is_fatal else Markup('<span class="ok">–</span>')
            if joint in near_losses:
                cell = Markup('<span class="fatal">≤ {}</span>').format(format_number(near_losses[joint]))
            elif joint in weaknesses:
                cell = Markup('<span class="weak">≤ {}</span>').format(format_percent(weaknesses[joint].manipulability_left))
            cells.append(cell)
        verdicts = {
            "never possible": structure.never,
            "not redundant": structure.redundancy <= 0,
            "single point of failure": structure.fatal,
            "nearly one": structure.nearly,
            "weak joint": structure.weak,
        }
        table_rows.append([*cells, next((verdict for verdict, applies in verdicts.items() if applies), "none")])
    header = ["Task", "Redundancy", *[str(joint + 1) for joint in range(len(joint_names))], "Single point of failure"]
    joints = "; ".join(f"{joint + 1} {name}" for joint, name in enumerate(joint_names))
    return [
        Text(
            "A joint is fatal if its lock makes the task singular in every configuration, so no choice of configuration helps. "
            "A number is the largest relative manipulability found after the lock, printed where it is nearly 0. A percentage "
            "is the largest manipulability found after the lock, relative to the largest one of the healthy arm."
        ),
        Table(table_rows, header, frozenset({1}), marks=frozenset(range(2, len(joint_names) + 2)), wide=True, sortable=False),
        Text(f"Joints: {joints}. Redundancy: joints minus task dimensions.", quiet=True),
    ]
