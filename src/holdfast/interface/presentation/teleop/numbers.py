"""JSON and key table of an analysis of an experiment."""

from __future__ import annotations

from typing import Any

from holdfast.interface.presentation.printing import TextTable, format_significant, to_json_types
from holdfast.teleop.analysis.result import Analysis


def to_dict(analysis: Analysis) -> dict[str, Any]:
    """Return the subjects, and every table, row by row."""
    data = {
        "subjects": list(analysis.observed.subjects),
        "simulated": analysis.is_simulated,
        "left_out": analysis.left_out,
        "notes": analysis.notes,
        "tables": {name: table.to_dict("records") for name, table in analysis.tables.items()},
    }
    json_data: dict[str, Any] = to_json_types(data)
    return json_data


def key_table(analysis: Analysis) -> TextTable:
    """Tabulate the mean CPM with the failed arm under each law."""
    return TextTable(
        ["law", "mean CPM with the failed arm"], [[law, format_significant(mean)] for law, mean in analysis.law_means().items()]
    )
