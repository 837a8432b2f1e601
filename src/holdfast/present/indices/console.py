"""Indices and susceptibilities at one configuration (n,), in numbers and words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.indices.index import Index
from holdfast.indices.objective import Objective
from holdfast.indices.susceptibility.measure import Susceptibility
from holdfast.present.arm.console import print_outside, shown_positions
from holdfast.present.printing import alike, number
from holdfast.status import Status

if TYPE_CHECKING:
    from rich.console import Console

Array = NDArray[np.float64]


def index_values(index: Index, q: Array) -> dict[str, Any]:
    """The index after each failure, the worst of them, and its gradient."""
    result, names = index.evaluate(q), index.arm.joint_names
    singular = bool(result.status == Status.SINGULAR)
    return {
        **index.arm.entry(),
        "index": index.label,
        "task": index.task.name,
        "characteristic_length_m": index.task.length,
        "unit": index.unit,
        "better": index.better,
        "bound": index.bound,
        "bound_note": index.bound_note,
        "best_known": index.best_known,
        "attained": index.attained,
        "source": index.source,
        "q": dict(zip(names, q.tolist(), strict=True)),
        "value": result.value,
        "by_failure": dict(zip(index.failure_names, result.by_failure.tolist(), strict=True)),
        "worst": None if singular else index.failure_names[int(result.worst)],
        "singular": singular,
        "gradient": dict(zip(names, index.gradient(q).tolist(), strict=True)),
    }


def susceptibility_values(measure: Susceptibility, q: Array) -> dict[str, Any]:
    """The susceptibility, what each joint adds, and its gradient."""
    result, names = measure.evaluate(q), measure.arm.joint_names
    return {
        **measure.arm.entry(),
        "measure": measure.slug,
        "unit": measure.unit,
        "better": measure.better,
        "source": measure.source,
        "gravity_m_s2": measure.arm.gravity,
        "weights": measure.weights,
        "q": dict(zip(names, q.tolist(), strict=True)),
        "value": result.value,
        "by_joint": dict(zip(names, result.by_joint.tolist(), strict=True)),
        "joint_unit": dict(zip(names, measure.joint_unit, strict=True)),
        "joint_status": {name: Status(int(s)).name.lower() for name, s in zip(names, result.joint_status, strict=True)},
        "gradient": dict(zip(names, measure.gradient(q).tolist(), strict=True)),
    }


def show_index(index: Index, q: Array, out: Console) -> None:
    """The worst case, then a table of the failures."""
    from rich.markup import escape

    r, unit = index_values(index, q), _unit(index)
    verdict = "[yellow]The arm is singular here: the index is 0 (infinite for a condition number) by convention.[/]"
    if not r["singular"]:
        bound = f"; at most {number(index.bound)} for any configuration" if index.bound is not None else ""
        if index.ceiling is not None:
            bound = f"; {index.ceiling.compared(r['value'])}"
        verdict = f"[bold]{number(r['value'], 6)}{unit}[/], worst when [bold]{escape(r['worst'])}[/] locks{bound}"
    values = zip(r["by_failure"], alike(r["by_failure"].values(), digits=6), strict=True)
    rows = [(name, text, "[bold]worst[/]" if name == r["worst"] else "") for name, text in values]
    _show(index, q, verdict, ("failure", f"{index.name}{unit}", ""), rows, out)
    _show_gradient("worst case", r, out)


def show_susceptibility(measure: Susceptibility, q: Array, out: Console) -> None:
    """The value, then a table of the joints, and what their states mean."""
    r = susceptibility_values(measure, q)
    kinds, values = list(r["joint_unit"].values()), list(r["by_joint"].values())
    states = ["" if state == "ok" else state.replace("_", " ") for state in r["joint_status"].values()]
    rows = list(zip(r["by_joint"], shown_positions(np.array(values), kinds, 6), states, strict=True))
    verdict = f"[bold]{number(r['value'], 6)}{_unit(measure)}[/], smaller is better"
    _show(measure, q, verdict, ("joint", measure.formula.name, ""), rows, out)
    for state in dict.fromkeys(r["joint_status"].values()):
        if state != "ok":
            out.print(f"[yellow]{state.replace('_', ' ')}: {Status[state.upper()].sentence}[/]", soft_wrap=True)
    _show_gradient("value", r, out)


def _unit(measure: Objective) -> str:
    from rich.markup import escape

    return "" if measure.unit == "1" else f" {escape(measure.unit)}"


def _show(
    measure: Index | Susceptibility,
    q: Array,
    verdict: str,
    head: tuple[str, ...],
    rows: Iterable[tuple[str, ...]],
    out: Console,
) -> None:
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    out.print(f"{escape(measure.describe())}, arm {escape(measure.arm.title)}", soft_wrap=True)
    out.print(verdict, soft_wrap=True)
    print_outside(measure.arm, q, out)
    table = Grid(*head)
    for name, *cells in rows:
        table.add_row(escape(name), *cells)
    out.print(table)


def _show_gradient(of: str, r: dict[str, Any], out: Console) -> None:
    from rich.markup import escape

    gradient = ", ".join(f"{name} {number(value)}" for name, value in r["gradient"].items())
    out.print(f"gradient of the {of}, per rad or m: {escape(gradient)}", soft_wrap=True)
