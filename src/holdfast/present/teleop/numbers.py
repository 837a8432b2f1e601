"""An analysis of an experiment in numbers."""

from __future__ import annotations

from typing import Any

from holdfast.present.printing import Rows, number, plain
from holdfast.teleop.analysis.result import Analysis


def to_dict(a: Analysis) -> dict[str, Any]:
    """Whose trials they are, and every table, row by row."""
    data = {
        "subjects": list(a.observed.subjects),
        "simulated": a.simulated,
        "left_out": a.left_out,
        "notes": a.notes,
        "tables": {name: table.to_dict("records") for name, table in a.tables.items()},
    }
    made: dict[str, Any] = plain(data)
    return made


def key_table(a: Analysis) -> Rows:
    """The mean CPM with the failed arm under each law."""
    return Rows(["law", "mean CPM with the failed arm"], [[law, number(mean)] for law, mean in a.law_means().items()])


def next_steps(a: Analysis, name: str) -> list[str]:
    """The comparisons."""
    del a
    return [f'{name}.table("comparisons")', f'{name}.report("experiment.html")']
