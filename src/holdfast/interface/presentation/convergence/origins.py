"""Numbers, tables, figures and files of a workspace analysis."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.convergence.analysis import FAILURE_ENDS
from holdfast.control.convergence.start_workspace import Workspace
from holdfast.control.convergence.table import save_places
from holdfast.core.formatting import capitalise_first, format_count
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation import results
from holdfast.interface.presentation.convergence.places import (
    MEASURE_DEFINITIONS,
    compose_answer,
    describe_measure_maps,
    format_with_interval,
    prepare_measure_maps,
    tabulate_means,
)
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from holdfast.interface.presentation.results import Drawings


def to_dict(workspace: Workspace) -> dict[str, Any]:
    """Return the contents of the analysis as JSON data; NaN is None."""
    columns = workspace.columns
    reached = workspace.configurations > 0
    return {
        **workspace.law.arm.entry(),
        "law": workspace.law.describe(),
        "task": workspace.law.task.name,
        "target": workspace.target.tolist(),
        "starts": len(workspace.places),
        "starts_in_reach": int(reached.sum()),
        "configurations": int(workspace.configurations.sum()),
        "lost_at_singular_configurations": int(workspace.lost.sum()),
        "method": workspace.method,
        "relative_to": workspace.relative_to,
        "bounds_rad": {name: [list(arc) for arc in arcs] for name, arcs in zip(columns[:-1], workspace.bounds, strict=True)},
        "ends": dict(zip(FAILURE_ENDS, workspace.ends.sum(axis=0).tolist(), strict=True)),
        "undecided_fraction": workspace.undecided_fraction,
        "not_simulated_fraction": workspace.skipped_fraction,
        "mean_percent": {name: dict(zip(columns, values, strict=True)) for name, values in workspace.means().items()},
        "mean_percent_95": {name: dict(zip(columns, values, strict=True)) for name, values in workspace.intervals().items()},
        "starts_with_R100_full": _count_by_column(workspace, workspace.reach.full >= 100 - 1e-9),
        "starts_with_R100_none": _count_by_column(workspace, workspace.reach.full == 0),
    }


def tables(workspace: Workspace) -> list[TextTable]:
    """Return the lock positions that each joint permits, the means of the measures, and for samples the starts that always
    succeed.
    """
    bound_rows = []
    for joint, arcs in zip(workspace.law.arm.joints, workspace.bounds, strict=True):
        factor, unit = joint.display_unit
        arcs_text = ", ".join(f"{factor * lower:.2f} to {factor * upper:.2f} {unit}" for lower, upper in arcs)
        bound_rows.append([joint.name, arcs_text or "no value"])
    sampled = workspace.method == "sampled"
    result_tables = [
        TextTable(["joint", "target in reach with it at"], bound_rows),
        tabulate_means(workspace, "the starts", sampled),
    ]
    if sampled:
        measure_names = ["R100", "F100"] if workspace.ends.sum() else ["R100"]
        table_rows = [
            [
                column,
                *(format_with_interval(100 * interval.value, 100 * interval.low, 100 * interval.high) for interval in shares),
            ]
            for column, shares in zip(
                workspace.columns, zip(*map(workspace.throughout, measure_names), strict=True), strict=True
            )
        ]
        title = "where all configurations that were drawn do, an upper bound for all that there are"
        result_tables.append(
            TextTable(["joint", *(f"starts with {name} 100, percent" for name in measure_names)], table_rows, title)
        )
    return result_tables


def story(workspace: Workspace) -> PageContent:
    """Compose the report: the part of the path on which the target stays within reach, and how often the failed arm
    reaches it.
    """
    no_start_text = (
        f"None of the {format_count(len(workspace.places), 'start')} has a configuration from which the "
        f"target is reached; choose starts within reach."
    )
    text, facts = compose_answer(workspace, no_start_text)
    method_texts = {
        "brute": "all failures simulated, from configurations equally far apart along the self-motion",
        "procedure": "simulated only where a sink exists; elsewhere the arm is taken to reach the target",
        "sampled": "random configurations, all failures simulated",
    }
    return PageContent(
        f"Starts from which {workspace.law.arm.name} still reaches a target when a joint locks on the way",
        text,
        about=f"{workspace.law.arm.name}, {workspace.law.describe()}",
        facts=facts,
        lines=[f"{capitalise_first(line)}." for line in workspace.describe()[1:]],
        figures=describe_measure_maps("starts"),
        method=[
            ("Law", workspace.law.describe()),
            ("Target", ", ".join(f"{coordinate:.4g}" for coordinate in workspace.target[:3, 3]) + " m"),
            (
                "Starts",
                (
                    f"{int((workspace.configurations > 0).sum()):,} of {len(workspace.places):,} within reach, "
                    f"{int(workspace.configurations.sum()):,} configurations"
                ),
            ),
            ("Failures", f"{method_texts[workspace.method]}; {workspace.simulated_count:,} simulated"),
            ("Measures", MEASURE_DEFINITIONS),
            ("Source", "Goel, Maciejewski, Balakrishnan 2005"),
        ],
        arm=workspace.law.arm,
    )


def key_table(workspace: Workspace) -> TextTable:
    """Return the means of the measures."""
    return tabulate_means(workspace, "the starts", workspace.method == "sampled")


def next_steps(workspace: Workspace, name: str) -> list[str]:
    """Suggest the values of each place and the full report."""
    del workspace
    return [f"{name}.to_xarray()  # place by place", f'{name}.report("workspace.html")']


@reports_progress("writing the results")
def save(workspace: Workspace, folder: Path, command: str = "") -> list[Path]:
    """Save ``workspace.csv``, ``workspace.json``, the figures and the report."""
    columns = [
        "configurations",
        "lost",
        *FAILURE_ENDS,
        *(f"{name}_{column}_percent" for name in workspace.measures for column in workspace.columns),
    ]
    values = [workspace.configurations, workspace.lost, workspace.ends, *workspace.measures.values()]
    files = save_places(folder, "workspace", workspace.places, columns, values, workspace.to_dict())
    return files + results.save(workspace, folder, command, dpi=130)


def drawings(workspace: Workspace) -> Drawings:
    """Return functions that draw the maps of Fig. 10 by file name: ``reach``, and ``finish`` if failures were simulated.

    For tasks that are not in a plane ``reach-top`` and ``reach-side``, seen along z and along y, and ``finish`` likewise.
    """
    about = (
        f"{workspace.law.arm.name}, {workspace.law.name}: {len(workspace.places)} starts, "
        f"{int(workspace.configurations.sum())} configurations; grey: no value"
    )
    failures = ""
    if workspace.ends.sum():
        failures = (
            f"{workspace.simulated_count} failures simulated, {100 * workspace.undecided_fraction:.2f} % undecided "
            f"at the time limit"
        )
        if workspace.method == "procedure":
            failures += f", {int(workspace.ends[:, -1].sum())} locked where no sink is"
    return prepare_measure_maps(workspace.law, workspace.places, workspace.measures, about, failures, workspace.target[:3, 3])


def _count_by_column(workspace: Workspace, flags: NDArray[np.bool_]) -> dict[str, int]:
    return dict(zip(workspace.columns, flags.sum(axis=0).tolist(), strict=True))
