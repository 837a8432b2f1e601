"""``holdfast index``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.cli.measure_options import IndexOption
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    DegreesOption,
    FailuresOption,
    HoldOption,
    JsonOption,
    LengthOption,
    QOption,
    TaskOption,
    TipOption,
    outside_limits,
    read_arm,
    read_configuration,
    read_failures,
    read_task,
)
from holdfast.present.printing import console, number, print_json
from holdfast.status import Status

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from holdfast.indices.index import Index


def command(
    arm: ArmArgument,
    q: QOption,
    index: IndexOption = "relative-manipulability",
    task: TaskOption = None,
    failures: FailuresOption = "single",
    length: LengthOption = 1.0,
    degrees: DegreesOption = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """Evaluate a fault tolerance index at a configuration: per failed joint, the worst one, and the gradient.

    Example: holdfast index pa10-9dof --index relative-manipulability --q "0 30 0 90 0 18 0 36 0" --degrees
    """
    from holdfast.indices.index import by_name

    model = read_arm(arm, base, tip, hold)
    configurations = np.array([read_configuration(model, text, degrees) for text in q])
    measure = by_name(index, model, read_task(task, arm, model), read_failures(model, failures), length)
    results = [_evaluate(measure, x) for x in configurations]
    if json_:
        print_json(results if len(results) > 1 else results[0])
        return
    _print(measure, configurations, results)


def _evaluate(measure: Index, q: NDArray[np.float64]) -> dict[str, Any]:
    result = measure.evaluate(q)
    singular = bool(result.status == Status.SINGULAR)
    names = measure.failure_names
    return {
        **measure.arm.entry(),
        "index": measure.label,
        "task": measure.task.name,
        "characteristic_length_m": measure.task.length,
        "unit": measure.unit,
        "better": measure.better,
        "bound": measure.bound,
        "bound_note": measure.bound_note,
        "source": measure.source,
        "q": dict(zip(measure.arm.joint_names, q.tolist(), strict=True)),
        "value": result.value,
        "by_failure": dict(zip(names, result.by_failure.tolist(), strict=True)),
        "worst": None if singular else names[int(result.worst)],
        "singular": singular,
        "gradient": dict(zip(measure.arm.joint_names, measure.gradient(q).tolist(), strict=True)),
    }


def _print(measure: Index, configurations: NDArray[np.float64], results: list[dict[str, Any]]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    unit = "" if measure.unit == "1" else f" {measure.unit}"
    for q, r in zip(configurations, results, strict=True):
        out.print(f"{escape(measure.describe())}, arm {escape(measure.arm.title)}", soft_wrap=True)
        if r["singular"]:
            out.print(
                "[yellow]The arm is singular here: the index is 0 (infinite for a condition number) by convention.[/]",
                soft_wrap=True,
            )
        else:
            note = f" ({measure.bound_note})" if measure.bound_note else ""
            bound = f"; at most {number(measure.bound)} for any configuration{note}" if measure.bound is not None else ""
            out.print(
                f"[bold]{number(r['value'], 6)}{unit}[/], worst when [bold]{escape(r['worst'])}[/] locks{bound}", soft_wrap=True
            )
        outside = outside_limits(measure.arm, q)
        if outside:
            out.print(f"[yellow]outside its limits: {escape(', '.join(outside))}[/]", soft_wrap=True)
        table = Table("failure", f"{measure.name}{unit}", box=None, pad_edge=False)
        for name, value in r["by_failure"].items():
            mark = " <- worst" if name == r["worst"] else ""
            table.add_row(escape(name), f"{number(value, 6)}{mark}")
        out.print(table)
        gradient = ", ".join(f"{name} {number(value)}" for name, value in r["gradient"].items())
        out.print(f"gradient of the worst case, per rad or m: {escape(gradient)}", soft_wrap=True)
