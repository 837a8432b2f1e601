"""``holdfast susceptibility``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    DegreesOption,
    JsonOption,
    QOption,
    TipOption,
    console,
    number,
    outside_limits,
    print_json,
    read_arm,
    read_configuration,
    read_numbers,
)
from holdfast.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from holdfast.arm import Arm
    from holdfast.indices.susceptibility import Susceptibility

    Array = NDArray[np.float64]

MOUNTS = {
    "floor": np.eye(3),
    "wall": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    "ceiling": np.diag([1.0, -1, -1]),
}

GravityOption = Annotated[
    str | None,
    typer.Option(
        "--gravity", help="Gravity acceleration in the world, m/s^2, as 0,0,-9.81. Default: the arm's.", show_default=False
    ),
]
MountOption = Annotated[
    str, typer.Option("--mount", help="floor (as described), wall (turned 90 deg about y) or ceiling (180 deg about x).")
]
PayloadOption = Annotated[
    str | None,
    typer.Option(
        "--payload",
        help="A point mass in the hand: kg, then x,y,z of its place in the last link's frame, m (default 0,0,0).",
        show_default=False,
    ),
]


def susceptibility(
    arm: ArmArgument,
    q: QOption,
    measure: Annotated[str, typer.Option("--measure", help="torque, acceleration or swing-angle.")] = "torque",
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
    json_: JsonOption = False,
) -> None:
    """Evaluate what a free-swinging failure of each joint would do at a configuration; smaller is better.

    Example: holdfast susceptibility panda --measure swing-angle --q "0 -45 0 -135 0 90 45" --degrees --mount wall
    """
    from holdfast.indices.susceptibility import by_name

    model = _placed(read_arm(arm, base, tip), mount, gravity, payload)
    configurations = np.array([read_configuration(model, text, degrees) for text in q])
    chosen = by_name(measure, model, None if weights is None else _read_weights(weights))
    results = [_evaluate(chosen, x) for x in configurations]
    if json_:
        print_json(results if len(results) > 1 else results[0])
        return
    _print(chosen, configurations, results)


def _placed(arm: Arm, mount: str, gravity: str | None, payload: str | None) -> Arm:
    from holdfast.arm import Link

    if mount not in MOUNTS:
        raise InputError(f"--mount '{mount}' is not known; use one of {', '.join(MOUNTS)}")
    turn = np.eye(4)
    turn[:3, :3] = MOUNTS[mount]
    arm = arm.with_base(turn @ arm.base)
    if gravity is not None:
        arm = replace(arm, gravity=read_numbers("--gravity", gravity, "3 numbers"))
    if payload is not None:
        numbers = read_numbers("--payload", payload, "1 or 4 numbers")
        if numbers.size not in (1, 4):
            raise InputError(f"--payload has {numbers.size} numbers; give the mass, kg, or the mass and x, y, z, m")
        place = numbers[1:] if numbers.size == 4 else np.zeros(3)
        arm = arm.with_payload(Link(float(numbers[0]), place, np.zeros((3, 3)), "payload"))
    return arm


def _read_weights(text: str) -> Any:
    if text in ("effort", "worst-case"):
        return text
    file = Path(text)
    if file.suffix.lower() != ".csv":
        return read_numbers("--weights", text, "effort, worst-case, a .csv file, or one number per joint")
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise InputError(f"--weights: cannot read {file}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"--weights: {file} is not text; give numbers separated by commas") from error
    rows = [read_numbers(f"--weights {file}", line, "numbers") for line in lines if line.strip()]
    if len({len(row) for row in rows}) != 1:
        raise InputError(f"--weights: {file} must hold lines of equally many numbers: one per joint, or a square matrix")
    table = np.array(rows)
    return table.ravel() if 1 in table.shape else table


def _evaluate(measure: Susceptibility, q: Array) -> dict[str, Any]:
    from holdfast.indices.susceptibility import JointStatus

    result = measure.evaluate(q)
    arm = measure.arm
    return {
        "arm": arm.name,
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
            name: JointStatus(int(s)).name.lower() for name, s in zip(arm.joint_names, result.joint_status, strict=True)
        },
        "gradient": dict(zip(arm.joint_names, measure.gradient(q).tolist(), strict=True)),
    }


def _print(measure: Susceptibility, configurations: Array, results: list[dict[str, Any]]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from holdfast.indices.susceptibility import JointStatus

    out = console()
    unit = "" if measure.unit == "1" else f" {measure.unit}"
    for q, r in zip(configurations, results, strict=True):
        out.print(f"{escape(measure.describe())}, arm {escape(measure.arm.name)}", soft_wrap=True)
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
                out.print(f"[yellow]{flag.replace('_', ' ')}: {JointStatus[flag.upper()].advice}[/]", soft_wrap=True)
        gradient = ", ".join(f"{name} {number(value)}" for name, value in r["gradient"].items())
        out.print(f"gradient of the value, per rad or m: {escape(gradient)}", soft_wrap=True)


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command()(susceptibility)
