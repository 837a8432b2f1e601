"""Presentation of a comparison of arms by global measures of fault tolerance."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface.presentation.presentation import Presentation, TableSpec, format_value
from holdfast.kinematics.index_bounds.manipulability_bounds import failure_phrase
from holdfast.studies.designs.arm_comparison import ArmComparison


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
                **{attribute: getattr(column, attribute) for attribute in ("measure", "name", "unit", "samples")},
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


def present(comparison: ArmComparison) -> Presentation:
    """Present the non-dominated arms, and the value of each measure for every arm."""
    names, columns = [arm.name for arm in comparison.arms], comparison.columns
    if len(names) > 1:
        front = ", ".join(names[arm_index] for arm_index in comparison.front())
        answer = f"Pareto-optimal among the {len(names)} arms: {front}."
    else:
        first = int(np.argmax(comparison.values[0] > 0))
        value_text = format_value(float(comparison.values[0, first]), "number", columns[first].unit)
        answer = f"{capitalise_first(columns[first].name)}: {value_text}."
    head = ["measure", "unit", "samples"]
    rows = []
    for index, column in enumerate(columns):
        estimates = zip(comparison.values[:, index], comparison.low[:, index], comparison.high[:, index], strict=True)
        cells = [
            f"{format_number(value, 4)} ({format_number(low, 3)} to {format_number(high, 3)})" for value, low, high in estimates
        ]
        rows.append([column.name, column.unit, column.samples or "exact", *cells])
    title = "Values with their 95 % intervals; larger is better for every measure"
    return Presentation(
        f"Global fault tolerance of {', '.join(names)}",
        answer,
        about=f"{', '.join(names)}: task {comparison.task.name}, {comparison.region.name}, seed {comparison.seed}",
        lines=[f"{capitalise_first(remark)}." for remark in comparison.left_out],
        tables=[TableSpec(title, [*head, *names], rows)],
        method=[
            ("Task", comparison.task.describe()),
            ("Region", comparison.region.describe()),
            ("Failures", f"{failure_phrase(comparison.failures)}; one joint for workspace measures"),
            ("Samples", f"seed {comparison.seed}, the same poses for all arms"),
            ("Intervals", "95 %: exact for fractions, by order statistics for quantiles"),
        ],
    )
