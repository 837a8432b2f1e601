"""Notebook view of indices and susceptibilities, and their console text and JSON at one configuration (n,)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import format_number
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.console import list_limit_violations
from holdfast.interface.presentation.presentation import Fact, Presentation
from holdfast.interface.presentation.printing import format_column, format_positions
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility

if TYPE_CHECKING:
    from rich.console import Console


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


def index_values(index: Index, q: FloatArray) -> dict[str, Any]:
    """Return the index after each failure, the worst case, and the gradient of the worst case, as JSON data."""
    result, names = index.evaluate(q), index.arm.joint_names
    singular = bool(result.status == Status.SINGULAR)
    return {
        **index.arm.entry(),
        "index": index.label,
        "task": index.task.name,
        "characteristic_length_m": index.task.length,
        **{attribute: getattr(index, attribute) for attribute in ("unit", "better", "bound", "bound_note", "best_known")},
        "attained": index.is_attained,
        "source": index.source,
        "q": dict(zip(names, q.tolist(), strict=True)),
        "value": result.value,
        "by_failure": dict(zip(index.failure_names, result.by_failure.tolist(), strict=True)),
        "worst": None if singular else index.failure_names[int(result.worst)],
        "singular": singular,
        "gradient": dict(zip(names, index.gradient(q).tolist(), strict=True)),
    }


def susceptibility_values(measure: Susceptibility, q: FloatArray) -> dict[str, Any]:
    """Return the susceptibility, the contribution of each joint, and the gradient, as JSON data."""
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
        "joint_status": {
            name: Status(int(status)).name.lower() for name, status in zip(names, result.joint_status, strict=True)
        },
        "gradient": dict(zip(names, measure.gradient(q).tolist(), strict=True)),
    }


def show_index(index: Index, q: FloatArray, out: Console) -> None:
    """Print the worst case, a table of the failures, and the gradient."""
    from rich.markup import escape

    results, unit = index_values(index, q), _unit_suffix(index)
    verdict = "[yellow]The arm is singular here: the index is 0 (infinite for a condition number) by convention.[/]"
    if not results["singular"]:
        bound = f"; at most {format_number(index.bound, 4)} for any configuration" if index.bound is not None else ""
        if index.ceiling is not None:
            bound = f"; {index.ceiling.compare_value(results['value'])}"
        value_text = f"[bold]{format_number(results['value'], 6)}{unit}[/]"
        verdict = f"Worst case {value_text}, a lock of [bold]{escape(results['worst'])}[/]{bound}"
    values = zip(results["by_failure"], format_column(results["by_failure"].values(), digits=6), strict=True)
    rows = [(name, value_text, "[bold]worst[/]" if name == results["worst"] else "") for name, value_text in values]
    _show_measure(index, q, verdict, ("failure", f"{index.name}{unit}", ""), rows, out)
    _show_gradient("worst case", results, out)


def show_susceptibility(measure: Susceptibility, q: FloatArray, out: Console) -> None:
    """Print the susceptibility, a table of the joints, and the meaning of their states."""
    results = susceptibility_values(measure, q)
    kinds, values = list(results["joint_unit"].values()), list(results["by_joint"].values())
    states = ["" if state == "ok" else state.replace("_", " ") for state in results["joint_status"].values()]
    rows = list(zip(results["by_joint"], format_positions(values, kinds, 6), states, strict=True))
    verdict = f"Susceptibility [bold]{format_number(results['value'], 6)}{_unit_suffix(measure)}[/]; smaller is better"
    _show_measure(measure, q, verdict, ("joint", measure.formula.name, ""), rows, out)
    for state in dict.fromkeys(results["joint_status"].values()):
        if state != "ok":
            out.print(f"[yellow]{state.replace('_', ' ')}: {Status[state.upper()].sentence}[/]", soft_wrap=True)
    _show_gradient("value", results, out)


def display_unit(objective: Objective) -> str:
    """Return the unit of an objective, or an empty text if it has none that could be shown."""
    return "" if objective.unit in ("1", "mixed") else objective.unit


def _unit_suffix(measure: Objective) -> str:
    from rich.markup import escape

    return "" if measure.unit == "1" else f" {escape(measure.unit)}"


def _show_measure(
    measure: Index | Susceptibility,
    q: FloatArray,
    verdict: str,
    head: tuple[str, ...],
    rows: Iterable[tuple[str, ...]],
    out: Console,
) -> None:
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    out.print(f"{escape(measure.describe())}, arm {escape(measure.arm.title)}", soft_wrap=True)
    out.print(verdict, soft_wrap=True)
    for notice in list_limit_violations(measure.arm, q):
        out.print(f"[yellow]{escape(notice.text)}[/]", soft_wrap=True)
    table = BandedTable(*head)
    for name, *cells in rows:
        table.add_row(escape(name), *cells)
    out.print(table)


def _show_gradient(quantity: str, results: dict[str, Any], out: Console) -> None:
    from rich.markup import escape

    gradient = ", ".join(f"{name} {format_number(value, 4)}" for name, value in results["gradient"].items())
    out.print(f"gradient of the {quantity}, per rad or m: {escape(gradient)}", soft_wrap=True)
