"""Notebook view of indices, susceptibilities, and sums of them."""

from __future__ import annotations

from holdfast.core.formatting import format_number
from holdfast.interface.presentation.presentation import Fact, Presentation
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility


def present(objective: Objective) -> Presentation:
    """Present the objective with its better direction, bound, and source."""
    facts = [Fact("better", objective.better), Fact("unit", "none" if objective.unit == "1" else objective.unit)]
    if isinstance(objective, Index):
        bound = "not known" if objective.bound is None else format_number(objective.bound, 4)
        bound += f" ({objective.bound_note})" if objective.bound_note else ""
        facts += [Fact("no configuration can exceed", bound), Fact("failures considered", len(objective.failures))]
    if isinstance(objective, (Index, Susceptibility)):
        facts.append(Fact("source", objective.source or "not given"))
    description = objective.describe() if isinstance(objective, (Index, Susceptibility)) else objective.name
    return Presentation(objective.name, f"{description}, arm {objective.arm.title}", facts=facts)
