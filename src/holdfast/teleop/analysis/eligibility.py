"""Analysis of an experiment from its records, limited to the trials that count."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from holdfast.core.errors import InputError
from holdfast.teleop.records.entries import SubjectKind, SubjectState
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.tables import computer_table, trial_table

if TYPE_CHECKING:
    from holdfast.teleop.analysis.computation import Missing
    from holdfast.teleop.analysis.result import Analysis


def analyse_records(
    records: Records, missing: Missing = "refuse", groups: int = 3, difficulty: Literal["operators", "computer"] = "operators"
) -> Analysis:
    """Analyse the recorded trials, compared with the computer operator in the same tasks.

    Subjects who dropped out are not included, and neither are simulated subjects if people took part; the notes name them.

    Args:
        records: Records of the experiment.
        missing: Treatment of empty cells, as for :func:`holdfast.teleop.analysis.analyse`.
        groups: Number of groups of difficulty.
        difficulty: Source of the CPM by which tasks are sorted.

    Raises:
        InputError: There are no trials, or not enough.
        HoldfastError: statsmodels is not installed.
    """
    from holdfast.teleop.analysis.computation import analyse

    table = trial_table(records)
    subjects = records.subjects()
    dropped = [subject.code for subject in subjects if subject.state == SubjectState.DROPPED]
    table = table[~table["subject"].isin(dropped)]
    is_person = table["kind"] == SubjectKind.PERSON
    simulated = sorted(set(table["subject"][~is_person])) if is_person.any() else []
    table = table[~table["subject"].isin(simulated)]
    if table.empty:
        raise InputError(
            f"'{records.folder}' contains no trials of subjects who have not dropped out, so there is nothing to analyse"
        )
    result = analyse(table, computer_table(records.protocol), missing=missing, groups=groups, difficulty=difficulty)
    notes = (
        *([f"dropped out, and not included: {', '.join(dropped)}"] if dropped else []),
        *([f"simulated, and not included: {', '.join(simulated)}"] if simulated else []),
    )
    return replace(result, notes=(*result.notes, *notes))
