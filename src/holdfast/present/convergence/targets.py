"""The measures over targets: numbers, a table, maps and files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.convergence.analysis import ENDS
from holdfast.convergence.table import save_places
from holdfast.convergence.targets import TargetMeasures
from holdfast.notice import says
from holdfast.present import results
from holdfast.present.convergence.places import mean_rows, measure_maps
from holdfast.present.printing import Rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(t: TargetMeasures) -> dict[str, Any]:
    """Places, ends, and the measures of each target with their intervals, percent."""
    return {"targets": t.targets.points, "ends": t.ends, "percent": t.measures, "percent_95": t.target_intervals()}


def tables(t: TargetMeasures) -> list[Rows]:
    """The means of the measures."""
    return [mean_rows(t, "the targets")]


def figures(t: TargetMeasures) -> dict[str, Figure]:
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
