"""``holdfast susceptibility``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    DegreesOption,
    GravityOption,
    HoldOption,
    JsonOption,
    MountOption,
    PayloadOption,
    QOption,
    TipOption,
    outside_limits,
    placed,
    read_arm,
    read_configuration,
    read_weights,
)
from holdfast.present.printing import console, number, print_json
from holdfast.registry import SUSCEPTIBILITIES
from holdfast.status import Status

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from holdfast.indices.susceptibility.measure import Susceptibility

    Array = NDArray[np.float64]


def command(
    arm: ArmArgument,
    q: QOption,
    measure: Annotated[str, typer.Option("--measure", help=f"{SUSCEPTIBILITIES.usage}.")] = "torque",
    weights: Annotated[
        str | None,
        typer.Option(
            "--weights",
            help="effort, worst-case, one number per joint as 1,2,3, or a CSV file of them or of a square matrix. "
            "Default: all joints alike.",
            show_default=False,
        ),
    ] = None,
    mount: MountOption = "floor",
    gravity: GravityOption = None,
    payload: PayloadOption = None,
    degrees: DegreesOption = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """Evaluate what a free-swinging failure of each joint would do at a configuration; smaller is better.

    Example: holdfast susceptibility panda --measure swing-angle --q "0 -45 0 -135 0 90 45" --degrees --mount wall
    """
    from holdfast.indices.susceptibility.measure import by_name

    model = placed(read_arm(arm, base, tip, hold), mount, gravity, payload)
    configurations = np.array([read_configuration(model, text, degrees) for text in q])
    chosen = by_name(measure, model, None if weights is None else read_weights("--weights", weights))
    results = [_evaluate(chosen, x) for x in configurations]
    if json_:
        print_json(results if len(results) > 1 else results[0])
        return
    _print(chosen, configurations, results)


def _evaluate(measure: Susceptibility, q: Array) -> dict[str, Any]:
    result = measure.evaluate(q)
    arm = measure.arm
    return {
        **arm.entry(),
        "measure": measure.slug,
        "unit": measure.unit,
        "better": measure.better,
        "source": measure.source,
        "gravity_m_s2": arm.gravity.tolist(),
        "weights": measure.weights.tolist(),
        "q": dict(zip(arm.joint_names, q.tolist(), strict=True)),
        "value": result.value,
        "by_joint": dict(zip(arm.joint_names, result.by_joint.tolist(), strict=True)),
        "joint_unit": dict(zip(arm.joint_names, measure.joint_unit, strict=True)),
        "joint_status": {
            name: Status(int(s)).name.lower() for name, s in zip(arm.joint_names, result.joint_status, strict=True)
        },
        "gradient": dict(zip(arm.joint_names, measure.gradient(q).tolist(), strict=True)),
    }


def _print(measure: Susceptibility, configurations: Array, results: list[dict[str, Any]]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    unit = "" if measure.unit == "1" else f" {measure.unit}"
    for q, r in zip(configurations, results, strict=True):
        out.print(f"{escape(measure.describe())}, arm {escape(measure.arm.title)}", soft_wrap=True)
        out.print(f"[bold]{number(r['value'], 6)}{escape(unit)}[/], smaller is better", soft_wrap=True)
        outside = outside_limits(measure.arm, q)
        if outside:
            out.print(f"[yellow]outside its limits: {escape(', '.join(outside))}[/]", soft_wrap=True)
        table = Table("joint", measure.formula.name, "", box=None, pad_edge=False)
        for name, value in r["by_joint"].items():
            kind = r["joint_unit"][name]
            shown = f"{number(value, 6)} {kind}" + (f" ({number(np.rad2deg(value), 4)} deg)" if kind == "rad" else "")
            flag = r["joint_status"][name]
            table.add_row(escape(name), shown, "" if flag == "ok" else flag.replace("_", " "))
        out.print(table)
        for flag in dict.fromkeys(r["joint_status"].values()):
            if flag != "ok":
                out.print(f"[yellow]{flag.replace('_', ' ')}: {Status[flag.upper()].sentence}[/]", soft_wrap=True)
        gradient = ", ".join(f"{name} {number(value)}" for name, value in r["gradient"].items())
        out.print(f"gradient of the value, per rad or m: {escape(gradient)}", soft_wrap=True)
