"""The measures over targets: numbers, a table, maps and files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.convergence.analysis import ENDS
from holdfast.convergence.table import save_places
from holdfast.convergence.targets import TargetMeasures
from holdfast.notice import says
from holdfast.present import results
from holdfast.present.convergence.places import MEASURES, answer, figure_words, mean_rows, measure_maps
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, counted, percent

if TYPE_CHECKING:
    from holdfast.present.results import Drawings


def to_dict(t: TargetMeasures) -> dict[str, Any]:
    """Places, ends, and the measures of each target with their intervals, percent."""
    return {"targets": t.targets.points, "ends": t.ends, "percent": t.measures, "percent_95": t.target_intervals()}


def tables(t: TargetMeasures) -> list[Rows]:
    """The means of the measures."""
    return [mean_rows(t, "the targets")]


def story(t: TargetMeasures) -> Story:
    """Which part of the way keeps the targets within reach, and the target that a lock puts most at risk."""
    nothing = (
        f"None of the {counted(len(t.targets), 'target')} is within reach of motions from "
        f"{counted(len(t.starts), 'start')}; choose others."
    )
    text, facts = answer(t, nothing)
    each = t.measures["Ravg"][:, -1]
    if np.isfinite(each).any() and np.nanmin(each) < np.nanmax(each):
        ends = [int(f(each)) for f in (np.nanargmin, np.nanargmax)]
        (low, high), (bad, good) = (each[ends], [f"({', '.join(f'{x:.3g}' for x in t.targets.points[k])}) m" for k in ends])
        text += (
            f" The target at {bad} is most at risk ({percent(low / 100)} of the way), that at "
            f"{good} least ({percent(high / 100)})."
        )
    return Story(
        f"Which targets of {t.law.arm.name} an unnoticed lock puts at risk",
        text,
        about=f"{t.law.arm.name}, {t.law.describe()}",
        facts=facts,
        lines=[f"{capitalised(line)}." for line in t.describe()],
        figures=figure_words("targets"),
        method=[
            ("Law", t.law.describe()),
            (
                "Motions",
                (
                    f"to {counted(len(t.targets), 'target')} from {counted(len(t.starts), 'start')}, the "
                    f"same for all; {int(t.configurations.sum()):,} of them"
                ),
            ),
            ("Measures", MEASURES),
            ("Source", "measures: Goel, Maciejewski, Balakrishnan 2005; over targets ours"),
        ],
        arm=t.law.arm,
    )


def drawings(t: TargetMeasures) -> Drawings:
    """Maps over the targets by name, as those of a workspace: ``reach``, and ``finish`` if failures were looked at."""
    about = (
        f"{t.law.arm.name}, {t.law.name}: each place is a target, its value the mean over {len(t.starts)} starts; "
        "grey: no value"
    )
    count = int(t.ends.sum())
    return measure_maps(t.law, t.targets, t.measures, about, f"{count} failures" if count else "")


def next_steps(t: TargetMeasures, name: str) -> list[str]:
    """The values of each place, and the whole report."""
    del t
    return [f"{name}.to_xarray()  # place by place", f'{name}.report("workspace.html")']


@says("writing the results")
def save(t: TargetMeasures, folder: Path, command: str = "") -> list[Path]:
    """``targets.csv``, with means over the starts and their 95 % intervals; ``targets.json``, maps and the page."""
    names = (*t.law.arm.joint_names, "any")
    columns: list[str] = list(ENDS)
    values: list[Any] = [t.ends]
    for name, sure in t.target_intervals().items():
        values += [t.measures[name], sure[..., 0], sure[..., 1]]
        columns += [f"{name}_{column}_percent{end}" for end in ("", "_low", "_high") for column in names]
    facts: dict[str, Any] = {"arm": t.law.arm.title, "law": t.law.describe(), "starts": len(t.starts)}
    files = save_places(folder, "targets", t.targets, columns, values, facts)
    return files + results.save(t, folder, command, "targets-", 130)
