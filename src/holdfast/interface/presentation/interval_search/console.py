"""Text, tables, and JSON of all configurations of a pose."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.interface.presentation.printing import TextTable, format_column
from holdfast.kinematics.interval_search.search import Configurations


def to_dict(configurations: Configurations) -> dict[str, Any]:
    """Return the finding, the configurations, and the search effort; rad and m."""
    names = ("pose", "lower", "upper", "q", "boxes", "open", "widest", "seconds")
    known = {
        "task": configurations.task.name,
        "finding": configurations.finding.name.lower(),
        "sentence": configurations.finding.sentence,
    }
    return {**configurations.arm.entry(), **known, **{name: getattr(configurations, name) for name in names}}


def tables(configurations: Configurations) -> list[TextTable]:
    """Tabulate the configurations, one row for each."""
    prismatic = configurations.arm.prismatic
    header = [
        "",
        *(
            f"{name}, {'m' if is_prismatic else 'deg'}"
            for name, is_prismatic in zip(configurations.arm.joint_names, prismatic, strict=True)
        ),
    ]
    displayed = np.where(prismatic, configurations.q, np.rad2deg(configurations.q))
    return (
        [TextTable(header, [[str(row_index + 1), *format_column(q)] for row_index, q in enumerate(displayed)])]
        if len(displayed)
        else []
    )


def key_table(configurations: Configurations) -> TextTable:
    """Return the table of the configurations."""
    return (tables(configurations) or [TextTable(["finding"], [[configurations.finding.sentence]])])[0]
