"""Notes on the limits of the numbers of an analysis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from holdfast.core.formatting import format_count
from holdfast.teleop.analysis.groups import CellMeans, TaskGroups
from holdfast.teleop.analysis.observations import TrialTable


def compose_analysis_notes(
    observed: TrialTable,
    computer: TrialTable | None,
    conditions: Sequence[int],
    grouped: TaskGroups,
    cells: CellMeans,
    left_out: Sequence[str],
    normalise: str,
) -> Iterator[str]:
    """Yield the notes of an analysis, one or two sentences each."""
    if observed.kind == "simulated":
        yield "The operators are simulated, so these numbers describe the simulation and not people."
    if left_out:
        yield f"{format_count(len(left_out), 'subject')} left out completely because of empty cells: {', '.join(left_out)}."
    without_cpm = observed.cause != ""
    if without_cpm.any():
        by_scenario = ", ".join(
            f"{int(without_cpm[:, :, position].sum())} in scenario {condition.scenario}"
            for position, condition in enumerate(observed.conditions)
            if without_cpm[:, :, position].any()
        )
        yield (
            f"{format_count(int(without_cpm.sum()), 'trial')} of {without_cpm.size:,} "
            f"{'has' if without_cpm.sum() == 1 else 'have'} no CPM ({by_scenario}). Means are over the trials that reached the "
            "target, which favours a law under which the hardest trials do not reach it."
        )
    incomplete = cells.tasks < grouped.sizes
    if incomplete.any():
        fewest = int((grouped.sizes - cells.tasks).max())
        yield (
            f"{int(incomplete.sum())} of {incomplete.size} cell means are over fewer tasks than their group has, at most "
            f"{fewest} fewer; the table of cells contains the number of tasks of each cell."
        )
    unknown = [observed.tasks[task] for task in np.flatnonzero(~np.isfinite(grouped.difficulty))]
    if unknown:
        yield (
            f"Task {', '.join(map(str, unknown))}: no difficulty is known, because the reference trial was not completed by "
            f"{'the computer' if grouped.by == 'computer' else 'most operators'}; counted as the most difficult."
        )
    if grouped.by == "operators":
        yield (
            "Tasks are grouped by the operators' own CPM of the reference scenario. The effect of difficulty is therefore "
            "built in, and so is a part of the interaction: if a task went badly there by chance, another law seems to help. "
            "Grouping by the computer's CPM does not have this effect."
        )
    if len(set(grouped.sizes.tolist())) > 1:
        yield f"The groups have {', '.join(map(str, grouped.sizes))} tasks; surplus tasks are in the easiest groups."
    if not observed.has_ratings:
        yield "No trial was rated, so CPM is the sum of eleven measures, without the operators' own."
    yield (
        "Each measure is divided in CPM by its largest value, which is that of one extreme trial. Levels of CPM are comparable "
        "within this analysis only; ratios and single measures are comparable with others."
    )
    if computer is not None:
        yield (
            "CPM of operators and of the computer are divided by common largest measures."
            if normalise == "together"
            else "CPM of operators and of the computer are each divided by their own largest measures, and are "
            "on different scales."
        )
