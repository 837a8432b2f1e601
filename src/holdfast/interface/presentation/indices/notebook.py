"""Notebook view of indices, susceptibilities, and sums of them."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility
from holdfast.model.arm.postures import generic_configuration


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


def next_steps(objective: Objective, name: str) -> list[str]:
    """Suggest the value at one configuration, joint by joint, and a better configuration of the same pose."""
    q = np.round(generic_configuration(objective.arm), 2).tolist()
    has_joint_values = isinstance(objective, (Index, Susceptibility))
    value = f"{name}.by_joint({q})  # whichever joint fails" if has_joint_values else f"{name}({q})"
    return [
        value,
        f"hf.optimise({name}.arm, {name}.arm.forward_kinematics({q}), {name})  # the same pose, a better configuration",
    ]
