"""Numbers, a table, maps and files of the measures over targets."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.convergence.analysis import FAILURE_ENDS
from holdfast.control.convergence.table import save_places
from holdfast.control.convergence.targets import TargetMeasures
from holdfast.core.formatting import capitalise_first, format_count, format_percent
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation import results
from holdfast.interface.presentation.convergence.places import (
    MEASURE_DEFINITIONS,
    compose_answer,
    describe_measure_maps,
    prepare_measure_maps,
    tabulate_means,
)
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from holdfast.interface.presentation.results import Drawings


def to_dict(measures: TargetMeasures) -> dict[str, Any]:
    """Return places, ends, and the measures of each target with their intervals, percent."""
    return {
        "targets": measures.targets.points,
        "ends": measures.ends,
        "percent": measures.measures,
        "percent_95": measures.target_intervals(),
    }


def tables(measures: TargetMeasures) -> list[TextTable]:
    """Return the means of the measures."""
    return [tabulate_means(measures, "the targets")]


def story(measures: TargetMeasures) -> PageContent:
    """Compose the report: the part of the path that keeps the targets within reach, and the target that a lock puts most at
    risk.
    """
    no_motion_text = (
        f"None of the {format_count(len(measures.targets), 'target')} is within reach of motions from "
        f"{format_count(len(measures.starts), 'start')}; choose others."
    )
    text, facts = compose_answer(measures, no_motion_text)
    target_means = measures.measures["Ravg"][:, -1]
    if np.isfinite(target_means).any() and np.nanmin(target_means) < np.nanmax(target_means):
        extremes = [int(arg_extreme(target_means)) for arg_extreme in (np.nanargmin, np.nanargmax)]
        (lowest, highest), (worst_target, best_target) = (
            target_means[extremes],
            [f"({', '.join(f'{coordinate:.3g}' for coordinate in measures.targets.points[index])}) m" for index in extremes],
        )
        text += (
            f" The target at {worst_target} is most at risk ({format_percent(lowest / 100)} of the way), that at "
            f"{best_target} least ({format_percent(highest / 100)})."
        )
    return PageContent(
        f"Which targets of {measures.law.arm.name} an unnoticed lock puts at risk",
        text,
        about=f"{measures.law.arm.name}, {measures.law.describe()}",
        facts=facts,
        lines=[f"{capitalise_first(line)}." for line in measures.describe()],
        figures=describe_measure_maps("targets"),
        method=[
            ("Law", measures.law.describe()),
            (
                "Motions",
                (
                    f"to {format_count(len(measures.targets), 'target')} from "
                    f"{format_count(len(measures.starts), 'start')}, the "
                    f"same for all; {int(measures.configurations.sum()):,} of them"
                ),
            ),
            ("Measures", MEASURE_DEFINITIONS),
            ("Source", "measures: Goel, Maciejewski, Balakrishnan 2005; over targets ours"),
        ],
        arm=measures.law.arm,
    )


def drawings(measures: TargetMeasures) -> Drawings:
    """Return functions that draw maps over the targets by name, like those of a workspace: ``reach``, and ``finish`` after
    failures.
    """
    about = (
        f"{measures.law.arm.name}, {measures.law.name}: each place is a target, its value the mean over "
        f"{len(measures.starts)} starts; "
        "grey: no value"
    )
    count = int(measures.ends.sum())
    return prepare_measure_maps(measures.law, measures.targets, measures.measures, about, f"{count} failures" if count else "")


def next_steps(measures: TargetMeasures, name: str) -> list[str]:
    """Suggest the values of each place and the full report."""
    del measures
    return [f"{name}.to_xarray()  # place by place", f'{name}.report("workspace.html")']


@reports_progress("writing the results")
def save(measures: TargetMeasures, folder: Path, command: str = "") -> list[Path]:
    """Save ``targets.csv``, with means over the starts and their 95 % intervals; ``targets.json``, maps and the report."""
    row_names = (*measures.law.arm.joint_names, "any")
    columns: list[str] = list(FAILURE_ENDS)
    values: list[Any] = [measures.ends]
    for name, bounds in measures.target_intervals().items():
        values += [measures.measures[name], bounds[..., 0], bounds[..., 1]]
        columns += [f"{name}_{column}_percent{suffix}" for suffix in ("", "_low", "_high") for column in row_names]
    facts: dict[str, Any] = {"arm": measures.law.arm.title, "law": measures.law.describe(), "starts": len(measures.starts)}
    files = save_places(folder, "targets", measures.targets, columns, values, facts)
    return files + results.save(measures, folder, command, "targets-", 130)
