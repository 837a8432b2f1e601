"""Notebook view of indices, susceptibilities, and sums of them."""

from __future__ import annotations

from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility


def sentences(objective: Objective) -> list[str]:
    """Return the description of the objective and its arm."""
    description = objective.describe() if isinstance(objective, (Index, Susceptibility)) else objective.name
    return [f"{description}, arm {objective.arm.title}"]


def key_table(objective: Objective) -> TextTable:
    """Tabulate the better direction, the bound, and the source."""
    rows = [["better", objective.better], ["unit", "none" if objective.unit == "1" else objective.unit]]
    if isinstance(objective, Index):
        bound = "not known" if objective.bound is None else format_significant(objective.bound)
        bound += f" ({objective.bound_note})" if objective.bound_note else ""
        rows += [["no configuration can exceed", bound], ["failures considered", f"{len(objective.failures)}"]]
    if isinstance(objective, (Index, Susceptibility)):
        rows.append(["source", objective.source or "not given"])
    return TextTable(["", ""], rows)
