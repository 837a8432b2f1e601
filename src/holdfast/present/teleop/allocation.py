"""The allocation sheet: who does which task in which scenario when, to print."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from holdfast.errors import InputError
from holdfast.teleop.protocol.protocol import Protocol

if TYPE_CHECKING:
    from holdfast.report.page import Page, Section


def allocation_page(protocol: Protocol, subjects: int | None = None) -> Page:
    """The sheet as a page: the orders of the tasks on one sheet, then a sheet for each subject.

    Rows of the balanced square are given to those who *complete* a session, so that the row of a subject is known only when
    he or she comes: the sheets hold for an experiment in which nobody drops out. The order of scenarios goes with the
    subject's running number.

    Args:
        protocol: The protocol.
        subjects: How many sheets; as many as the protocol wants if not given.

    Raises:
        InputError: Fewer than one subject.
    """
    from holdfast.report.page import Page, Section, Table, Text

    count = protocol.subjects if subjects is None else subjects
    if count < 1:
        raise InputError(f"{count} subjects cannot be given an order; give 1 or more")
    order = protocol.order()
    square = Table(
        [[str(r + 1), " ".join(str(t + 1) for t in row)] for r, row in enumerate(order)],
        ["row", "tasks in the order in which they are done"],
    )
    scenarios = Table([[str(s.number), s.label] for s in protocol.scenarios], ["scenario", ""])
    about = (
        f"Each task occurs equally often in each position, and each ordered pair of neighbours equally often, over "
        f"{len(order)} rows. A new subject gets the row that the fewest have completed, so the rows of those who drop out "
        f"are used again; the sheets below are valid as long as nobody drops out."
    )
    return Page(
        f"Allocation: {protocol.name}",
        f"{count} subjects, {len(protocol.tasks)} tasks, {len(protocol.scenarios)} scenarios in random order within each task.",
        [
            Section("Orders of the tasks", [Text(about), scenarios, square]),
            *(_sheet(protocol, k, len(order)) for k in range(count)),
        ],
        subtitle=f"seed {protocol.seed}",
        footer="Written by holdfast. Tick a box when a trial is done.",
    )


def _sheet(protocol: Protocol, subject: int, rows: int) -> Section:
    from holdfast.report.page import Section, Table

    each = len(protocol.scenarios)
    session = protocol.session(subject % rows, subject)
    lines = []
    for place, at in enumerate(range(0, len(session), each)):
        task = int(session[at, 0])
        joint = int(protocol.tasks.joint[task])
        scenarios = [f"{protocol.scenarios[s].number} ☐" for s in session[at : at + each, 1]]
        lines.append([str(place + 1), str(task + 1), protocol.arm.joint_names[joint] if joint >= 0 else "none", *scenarios])
    head = ["place", "task", "joint that fails", *("scenario" for _ in range(each))]
    table = Table(lines, head, frozenset({1}), marks=frozenset(range(3, 3 + each)))
    return Section(f"Subject number {subject + 1}, row {subject % rows + 1}", [table], sheet=True)


def write_allocation(protocol: Protocol, path: str | Path, subjects: int | None = None) -> Path:
    """Write the sheet as one HTML file that prints a subject on a page.

    Raises:
        InputError: Fewer than one subject.
        StoreError: The file cannot be written.
    """
    from holdfast.report import page

    return page.write(allocation_page(protocol, subjects), path)
