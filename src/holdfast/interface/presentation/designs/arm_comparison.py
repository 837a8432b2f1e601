"""Numbers and text of a comparison of whole arms in one table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant, print_table
from holdfast.kinematics.index_bounds.manipulability_bounds import failure_phrase
from holdfast.studies.designs.arm_comparison import ArmComparison

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(comparison: ArmComparison) -> dict[str, Any]:
    """Return each column with its unit and samples, and the value and interval of every arm, as JSON data."""
    return {
        "arms": [arm.entry() for arm in comparison.arms],
        "task": comparison.task.name,
        "failures": comparison.failures,
        "region": comparison.region.name,
        "level": comparison.level,
        "columns": [
            {
                "measure": column.measure,
                "name": column.name,
                "unit": column.unit,
                "samples": column.samples,
                "values": comparison.values[:, index].tolist(),
                "low": comparison.low[:, index].tolist(),
                "high": comparison.high[:, index].tolist(),
            }
            for index, column in enumerate(comparison.columns)
        ],
        "left_out": list(comparison.left_out),
        "front": comparison.front().tolist(),
        "seed": comparison.seed,
        "seconds": comparison.seconds,
    }


def show(comparison: ArmComparison, out: Console) -> None:
    """Print the question and the table."""
    for line in (comparison.describe()[0], *comparison.left_out):
        out.print(line, markup=False, soft_wrap=True)
    print_table(out, key_table(comparison))


def story(comparison: ArmComparison) -> PageContent:
    """Compose the report: the non-dominated arms, and how they were measured."""
    names = [arm.name for arm in comparison.arms]
    if len(names) > 1:
        answer = (
            f"Of {len(names)} arms beaten by no other in everything: "
            f"{', '.join(names[arm_index] for arm_index in comparison.front())}."
        )
    else:
        first_column = int(np.argmax(comparison.values[0] > 0))
        unit_text = "" if comparison.columns[first_column].unit == "1" else f" {comparison.columns[first_column].unit}"
        answer = (
            f"{capitalise_first(comparison.columns[first_column].name)}: "
            f"{format_significant(comparison.values[0, first_column])}{unit_text}."
        )
    return PageContent(
        f"{', '.join(names)}: judged as {'wholes' if len(names) > 1 else 'a whole'}",
        answer,
        lines=[f"{capitalise_first(remark)}." for remark in comparison.left_out],
        tables=tables(comparison),
        method=[
            ("Task", comparison.task.describe()),
            ("Region", comparison.region.describe()),
            ("Failures", f"{failure_phrase(comparison.failures)}; of a workspace one"),
            ("Draws", f"seed {comparison.seed}, the same poses for all arms"),
            ("Intervals", "95 %: exact for fractions, by order statistics for quantiles"),
        ],
    )


def tables(comparison: ArmComparison) -> list[TextTable]:
    """Return a row for each column, arms side by side."""
    header = ["measure", "unit", "samples", *(arm.name for arm in comparison.arms)]
    table_rows = []
    for index, column in enumerate(comparison.columns):
        intervals = zip(comparison.values[:, index], comparison.low[:, index], comparison.high[:, index], strict=True)
        cells = [
            f"{format_significant(value)} ({format_significant(lower, 3)} to {format_significant(upper, 3)})"
            for value, lower, upper in intervals
        ]
        table_rows.append([column.name, column.unit, f"{column.samples:,}" if column.samples else "exact", *cells])
    return [TextTable(header, table_rows, "Values with their intervals: larger is better in all")]


def key_table(comparison: ArmComparison) -> TextTable:
    """Return a row for each column, arms side by side, for notebooks."""
    return tables(comparison)[0]


def next_steps(comparison: ArmComparison, name: str) -> list[str]:
    """Suggest the non-dominated arms."""
    return [f'{name}.front("{comparison.columns[0].name}")  # what intervals do not tell apart counts as equal']
