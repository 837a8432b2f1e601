"""Printable allocation sheet: the order of tasks and scenarios for each subject."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from holdfast.core.errors import InputError
from holdfast.teleop.protocol.protocol import Protocol

if TYPE_CHECKING:
    from holdfast.interface.report.page import Page, Section


def build_allocation_page(protocol: Protocol, subjects: int | None = None) -> Page:
    """Build the sheet as a page: the orders of the tasks on one sheet, then a sheet for each subject.

    Rows of the balanced square are given to those who *complete* a session, so that the row of a subject is known only when
    he or she comes: the sheets hold for an experiment in which nobody drops out. The order of scenarios goes with the
    subject's running number.

    Args:
        protocol: The protocol.
        subjects: How many sheets; as many as the protocol wants if not given.

    Raises:
        InputError: Fewer than one subject.
    """
    from holdfast.interface.report.page import Page, Section, Table, Text

    count = protocol.subjects if subjects is None else subjects
    if count < 1:
        raise InputError(f"{count} subjects cannot be given an order; give 1 or more")
    order = protocol.task_order()
    order_table = Table(
        [[str(row_index + 1), " ".join(str(task + 1) for task in row)] for row_index, row in enumerate(order)],
        ["row", "tasks in the order in which they are done"],
    )
    scenario_table = Table([[str(scenario.number), scenario.label] for scenario in protocol.scenarios], ["scenario", ""])
    explanation = (
        f"Each task occurs equally often in each position, and each ordered pair of neighbours equally often, over "
        f"{len(order)} rows. A new subject gets the row that the fewest have completed, so the rows of those who drop out "
        f"are used again; the sheets below are valid as long as nobody drops out."
    )
    return Page(
        f"Allocation: {protocol.name}",
        f"{count} subjects, {len(protocol.tasks)} tasks, {len(protocol.scenarios)} scenarios in random order within each task.",
        [
            Section("Orders of the tasks", [Text(explanation), scenario_table, order_table]),
            *(_subject_sheet(protocol, subject, len(order)) for subject in range(count)),
        ],
        subtitle=f"seed {protocol.seed}",
        footer="Written by holdfast. Tick a box when a trial is done.",
    )


def _subject_sheet(protocol: Protocol, subject: int, rows: int) -> Section:
    from holdfast.interface.report.page import Section, Table

    scenario_count = len(protocol.scenarios)
    session = protocol.session_order(subject % rows, subject)
    table_rows = []
    for position, first_trial in enumerate(range(0, len(session), scenario_count)):
        task = int(session[first_trial, 0])
        joint = int(protocol.tasks.joint[task])
        scenarios = [
            f"{protocol.scenarios[scenario].number} ☐" for scenario in session[first_trial : first_trial + scenario_count, 1]
        ]
        table_rows.append(
            [str(position + 1), str(task + 1), protocol.arm.joint_names[joint] if joint >= 0 else "none", *scenarios]
        )
    header = ["place", "task", "joint that fails", *("scenario" for _ in range(scenario_count))]
    table = Table(table_rows, header, frozenset({1}), marks=frozenset(range(3, 3 + scenario_count)))
    return Section(f"Subject number {subject + 1}, row {subject % rows + 1}", [table], sheet=True)


def write_allocation(protocol: Protocol, path: str | Path, subjects: int | None = None) -> Path:
    """Write the sheet as one HTML file that prints a subject on a page.

    Raises:
        InputError: Fewer than one subject.
        StoreError: The file cannot be written.
    """
    from holdfast.interface.report import page

    return page.write(build_allocation_page(protocol, subjects), path)
