"""``holdfast swing``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TipOption,
    read_arm,
    read_configuration,
    read_joint,
)
from holdfast.files.output import writing
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.physics.swing import FreeSwing

ENDS = {
    "rest": "hangs at rest",
    "stop": "lies against its stop",
    "balanced": "does not move: gravity pulls it neither way here",
    "moving": "was still moving at the end; give more --duration or --damping",
}
CLOSE_UP = 1.5  # times the last brake time, in the figure


def swing(
    arm: ArmArgument,
    q: Annotated[str, typer.Option("--q", help="Joint values, rad and m, separated by commas or spaces.", show_default=False)],
    joint: Annotated[
        str, typer.Option("--joint", help="The joint that lets go, by name or number from 1.", show_default=False)
    ],
    damping: Annotated[
        float | None,
        typer.Option(
            "--damping",
            help="Viscous friction, N m s/rad or N s/m. Default: the joint's own, or 10 % of critical if it has next to none.",
            show_default=False,
        ),
    ] = None,
    brake: Annotated[
        list[float] | None,
        typer.Option("--brake", help="Brakes act after so many ms. May be given again.", show_default="50, 100 and 200"),
    ] = None,
    limits: Annotated[
        bool, typer.Option("--limits", help="The joint's limits stop it (those of sliding joints always do).")
    ] = False,
    duration: Annotated[
        float | None, typer.Option("--duration", help="At most so many seconds. Default: until at rest.", show_default=False)
    ] = None,
    degrees: Annotated[bool, typer.Option("--degrees", help="--q is in degrees (sliding joints stay in m).")] = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the motion to this file.", show_default=False)] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the motion into this PNG file.", show_default=False)] = None,
    json_: JsonOption = False,
) -> None:
    """Simulate what happens when one joint lets go and swings under gravity, all others held (needs the extra 'physics').

    The brakes are taken to stop the joint at once.

    Example: holdfast swing panda --q "0 -45 0 -135 0 90 45" --degrees --joint 4 --brake 50 --brake 100
    """
    from holdfast.physics.swing import BRAKES, free_swing

    model = read_arm(arm, base, tip, hold)
    result = free_swing(
        model,
        read_configuration(model, q, degrees),
        read_joint(model, joint),
        damping,
        duration,
        brake_after=tuple(brake) if brake else BRAKES,
        limits=limits,
    )
    if csv is not None:
        _write(result, csv)
    if plot is not None:
        _draw(result, plot)
    if json_:
        print_json(_data(result))
    else:
        _print(result, [file for file in (csv, plot) if file is not None])


def _data(result: FreeSwing) -> dict[str, Any]:
    failed = result.arm.joints[result.joint]
    unit = failed.unit
    return {
        **result.arm.entry(),
        "joint": failed.name,
        "q": dict(zip(result.arm.joint_names, result.q.tolist(), strict=True)),
        "unit": unit,
        "damping": result.damping,
        "outcome": result.outcome,
        "settled": result.settled,
        f"rest_{unit}": result.rest_angle,
        f"peak_{unit}": result.peak,
        f"initial_acceleration_{unit}_s2": result.initial_acceleration,
        "simulated_s": result.time[-1],
        "drops": [
            {
                "brake_after_ms": d.after_ms,
                f"moved_{unit}": d.angle,
                f"speed_{unit}_s": d.speed,
                "tool_drop_m": d.drop,
                "tool_distance_m": d.distance,
            }
            for d in result.drops
        ],
    }


def _amount(value: float, unit: str) -> str:
    return f"{number(value)} m" if unit == "m" else f"{number(np.degrees(value))} deg ({number(value)} rad)"


def _print(result: FreeSwing, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    failed = result.arm.joints[result.joint]
    unit = failed.unit
    friction = "N s/m" if unit == "m" else "N m s/rad"
    out.print(
        f"Free swing of [bold]{escape(failed.name)}[/], arm {escape(result.arm.title)}, all other joints held", soft_wrap=True
    )
    out.print(f"It {ENDS[result.outcome]}.", soft_wrap=True)
    facts = Table.grid(padding=(0, 2))
    if result.settled:
        facts.add_row("at rest, from where it let go", f"[bold]{_amount(result.rest_angle, unit)}[/]")
    facts.add_row("farthest it got", _amount(result.peak, unit))
    facts.add_row("acceleration at first", f"{number(result.initial_acceleration)} {unit}/s^2")
    facts.add_row("friction", f"{number(result.damping)} {friction}")
    facts.add_row("simulated", f"{number(result.time[-1])} s")
    out.print(facts)
    if result.drops:
        spin = "m" if unit == "m" else "deg"
        table = Table("brakes act after", "joint has moved", "at", "tool has dropped", "and moved", box=None, pad_edge=False)
        for d in result.drops:
            angle, speed = (d.angle, d.speed) if unit == "m" else (np.degrees(d.angle), np.degrees(d.speed))
            table.add_row(
                f"{d.after_ms:g} ms",
                f"{number(angle)} {spin}",
                f"{number(speed)} {spin}/s",
                f"{number(1000 * d.drop)} mm",
                f"{number(1000 * d.distance)} mm",
            )
        out.print(table)
    print_written(out, files)


def _write(result: FreeSwing, path: Path) -> None:
    unit = result.arm.joints[result.joint].unit
    header = f"time_s,moved_{unit},speed_{unit}_s,tool_x_m,tool_y_m,tool_z_m"
    rows = np.column_stack([result.time, result.angle, result.velocity, result.tool_position])
    with writing(path, "motion") as file:
        np.savetxt(file, rows, fmt="%.9g", delimiter=",", header=header, comments="")


def _draw(result: FreeSwing, path: Path) -> None:
    from holdfast.report.figures import save_png
    from holdfast.report.motions import Panel, motion_figure

    failed = result.arm.joints[result.joint]
    slides = failed.prismatic
    scale, shown = failed.shown
    pull = float(np.linalg.norm(result.arm.gravity)) or 1.0
    height = -(result.tool_position - result.tool_position[0]) @ result.arm.gravity / pull
    level = (scale * result.rest_angle, "comes to rest") if result.settled else None
    panels = [
        Panel(result.time, scale * result.angle, f"joint has moved, {shown}", f"Joint {failed.name}", level),
        Panel(result.time, height, "tool height above its start, m", "Tool"),
    ]
    last = max((d.after_ms for d in result.drops), default=0.0) / 1000
    if last > 0 and result.outcome != "balanced":
        early = result.time <= max(CLOSE_UP * last, result.time[1])
        moments = tuple(
            (d.after_ms / 1000, -1000 * d.drop, f"{d.after_ms:g} ms: {0.0 - 1000 * d.drop:.3g} mm") for d in result.drops
        )
        first = Panel(
            result.time[early], 1000 * height[early], "tool height above its start, mm", "Tool, when brakes act", None, moments
        )
        panels.append(first)
    friction = f"{result.damping:.3g} {'N s/m' if slides else 'N m s/rad'}"
    caption = f"{result.arm.name}: free swing of {failed.name}, all other joints held, friction {friction}, MuJoCo"
    save_png(motion_figure(panels, caption), path)
