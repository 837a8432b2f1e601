"""Printable allocation sheet: the order of tasks and scenarios for each subject."""

from __future__ import annotations

from pathlib import Path

from holdfast.core.errors import InputError
from holdfast.interface.report import page
from holdfast.interface.report.page import Page, Section, Table, Text
from holdfast.teleop.protocol.protocol import Protocol


def build_allocation_page(protocol: Protocol, subjects: int | None = None) -> Page:
    """Build the allocation as a page: one sheet with the orders of the tasks, then a sheet for each subject.

    A new subject gets the row of the balanced square that the fewest subjects have *completed*, so it is known only when the
    session starts, and the sheets are valid only if no subject drops out. The order of the scenarios depends on the running
    number of the subject.

    Args:
        protocol: Protocol of the experiment.
        subjects: Number of sheets; the number of subjects in the protocol if None.

    Raises:
        InputError: Fewer than one subject.
    """
    count = protocol.subjects if subjects is None else subjects
    if count < 1:
        raise InputError(f"subjects is {count}; it must be 1 or more")
    order = protocol.task_order()
    order_table = Table(
        [[str(row_index + 1), " ".join(str(task + 1) for task in row)] for row_index, row in enumerate(order)],
        ["row", "order of the tasks"],
    )
    scenario_table = Table([[str(scenario.number), scenario.label] for scenario in protocol.scenarios], ["scenario", ""])
    explanation = (
        f"Over {len(order)} rows, each task occurs equally often in each position, and each ordered pair of neighbours equally "
        f"often. A new subject gets the row that the fewest subjects have completed, so the row of a subject who drops out "
        f"is used again. The sheets below are valid as long as no subject drops out."
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
    header = ["position", "task", "failing joint", *("scenario" for _ in range(scenario_count))]
    table = Table(table_rows, header, frozenset({1}), marks=frozenset(range(3, 3 + scenario_count)))
    return Section(f"Subject number {subject + 1}, row {subject % rows + 1}", [table], sheet=True)


def write_allocation(protocol: Protocol, path: str | Path, subjects: int | None = None) -> Path:
    """Write the allocation sheets as one HTML file, in which each subject starts a new printed page.

    Args:
        protocol: Protocol of the experiment.
        path: HTML file to write.
        subjects: Number of sheets; the number of subjects in the protocol if None.

    Returns:
        Path of the file.

    Raises:
        InputError: Fewer than one subject.
        StoreError: The file cannot be written.
    """
    return page.write(build_allocation_page(protocol, subjects), path)
