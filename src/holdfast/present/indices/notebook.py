"""What a configuration is worth, as a notebook shows it: indices, susceptibilities and sums of them."""

from __future__ import annotations

import numpy as np

from holdfast.arm.postures import generic_configuration
from holdfast.indices.index import Index
from holdfast.indices.objective import Objective
from holdfast.indices.susceptibility.measure import Susceptibility
from holdfast.present.printing import Rows, number


def sentences(objective: Objective) -> list[str]:
    """What it is."""
    said = objective.describe() if isinstance(objective, (Index, Susceptibility)) else objective.name
    return [f"{said}, arm {objective.arm.title}"]


def key_table(objective: Objective) -> Rows:
    """Which way is better, how good it can be, and where it is from."""
    rows = [["better", objective.better], ["unit", "none" if objective.unit == "1" else objective.unit]]
    if isinstance(objective, Index):
        bound = "not known" if objective.bound is None else number(objective.bound)
        bound += f" ({objective.bound_note})" if objective.bound_note else ""
        rows += [["no configuration can exceed", bound], ["failures considered", f"{len(objective.failures)}"]]
    if isinstance(objective, (Index, Susceptibility)):
        rows.append(["source", objective.source or "not given"])
    return Rows(["", ""], rows)


def next_steps(objective: Objective, name: str) -> list[str]:
    """Its value at one configuration, joint by joint, and a better configuration of the same pose."""
    q = np.round(generic_configuration(objective.arm), 2).tolist()
    several = isinstance(objective, (Index, Susceptibility))
    value = f"{name}.by_joint({q})  # whichever joint fails" if several else f"{name}({q})"
    return [
        value,
        f"hf.optimise({name}.arm, {name}.arm.forward_kinematics({q}), {name})  # the same pose, a better configuration",
    ]
