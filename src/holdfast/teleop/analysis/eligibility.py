"""From the records of an experiment to its analysis: whose trials count."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from holdfast.errors import InputError
from holdfast.teleop.records.entries import State, Who
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.tables import computer_table, trial_table

if TYPE_CHECKING:
    from holdfast.teleop.analysis.computation import Missing
    from holdfast.teleop.analysis.result import Analysis


def analyse_records(
    records: Records,
    missing: Missing = "refuse",
    groups: int = 3,
    difficulty: Literal["operators", "computer"] = "operators",
) -> Analysis:
    """Analyse what was recorded, beside the computer in the same tasks.

    Subjects who dropped out are no part of any number, and where people took part programs are not; the notes name them.

    Args:
        records: The records.
        missing: As :func:`holdfast.teleop.analysis.analyse` has it; so are the others.
        groups: Number of groups of difficulty.
        difficulty: Whose CPM tasks are sorted by.

    Raises:
        InputError: There are no trials, or not enough.
        HoldfastError: statsmodels is not installed.
    """
    from holdfast.teleop.analysis.computation import analyse

    table = trial_table(records)
    subjects = records.subjects()
    dropped = [s.code for s in subjects if s.state == State.DROPPED]
    table = table[~table["subject"].isin(dropped)]
    people = table["kind"] == Who.PERSON
    programs = sorted(set(table["subject"][~people])) if people.any() else []
    table = table[~table["subject"].isin(programs)]
    if table.empty:
        raise InputError(
            f"'{records.folder}' holds no trials of subjects who have not dropped out; there is nothing to analyse"
        )
    result = analyse(table, computer_table(records.protocol), missing=missing, groups=groups, difficulty=difficulty)
    notes = (
        *([f"dropped out, and not part of any number: {', '.join(dropped)}"] if dropped else []),
        *([f"simulated, and not part of any number: {', '.join(programs)}"] if programs else []),
    )
    return replace(result, notes=(*result.notes, *notes))
