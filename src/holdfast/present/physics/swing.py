"""A free swing: its numbers, its words and its figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.clearance.contacts import contact_entries, contact_table
from holdfast.present.printing import Rows, number, print_rows
from holdfast.present.story import Story

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.physics.fall import FreeSwing

_CLOSE_UP = 1.5  # times the last brake time
_FRAMES, _SEEN = 201, 0.01  # of a motion; of the farthest that it goes

POWER_LOSS = "A power loss frees all joints at once, and then the tool drops further."


def to_dict(swing: FreeSwing) -> dict[str, Any]:
    """What happened, and where the tool is when the brakes act."""
    failed = swing.arm.joints[swing.joint]
    unit = failed.unit
    return {
        **swing.arm.entry(),
        "joint": failed.name,
        "q": dict(zip(swing.arm.joint_names, swing.q, strict=True)),
        "unit": unit,
        "damping": swing.damping,
        "outcome": swing.outcome,
        "settled": swing.settled,
        f"rest_{unit}": swing.rest_angle,
        f"peak_{unit}": swing.peak,
        f"initial_acceleration_{unit}_s2": swing.initial_acceleration,
        "simulated_s": swing.time[-1],
        "drops": [
            {
                "brake_after_ms": d.after_ms,
                f"moved_{unit}": d.angle,
                f"speed_{unit}_s": d.speed,
                "tool_drop_m": d.drop,
                "tool_distance_m": d.distance,
            }
            for d in swing.drops
        ],
    } | ({} if swing.contacts is None else {"contacts": contact_entries(swing.contacts)})


def key_table(swing: FreeSwing) -> Rows:
    """How far it goes, and where the tool is when brakes act."""
    factor, unit = swing.arm.joints[swing.joint].shown
    rows = [["largest displacement", f"{number(factor * swing.peak)} {unit}"]]
    if swing.contacts is not None:
        rows.append(["touches", ", ".join(f"{c.link} & {c.object} at {number(c.time)} s" for c in swing.contacts) or "nothing"])
    rows += [[f"tool has dropped after {d.after_ms:g} ms", f"{number(1000 * d.drop)} mm"] for d in swing.drops]
    return Rows(["", ""], rows)


def next_steps(swing: FreeSwing, name: str) -> list[str]:
    """Which joint would fall hardest here, and the motion as a table."""
    del swing
    return [
        f"hf.susceptibility.torque({name}.arm).by_joint({name}.q)  # which joint would fall how hard",
        f'{name}.to_csv("swing.csv")',
    ]


def show(swing: FreeSwing, out: Console) -> None:
    """How it ended, and a table of the brake times."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    failed = swing.arm.joints[swing.joint]
    factor, shown = failed.shown
    unit = failed.unit

    def amount(value: float) -> str:
        return f"{number(value)} m" if unit == "m" else f"{number(np.degrees(value))} deg ({number(value)} rad)"

    for line in swing.describe()[:2]:
        out.print(escape(line), soft_wrap=True)
    facts = Grid()
    if swing.settled:
        facts.add_row("displacement at the end", f"[bold]{amount(swing.rest_angle)}[/]")
    facts.add_row("largest displacement", amount(swing.peak))
    facts.add_row("initial acceleration", f"{number(swing.initial_acceleration)} {unit}/s^2")
    facts.add_row("friction", f"{number(swing.damping)} {'N s/m' if unit == 'm' else 'N m s/rad'}")
    facts.add_row("simulated", f"{number(swing.time[-1])} s")
    out.print(facts)
    if swing.drops:
        table = Grid("brakes engage after", "joint has moved", "at", "tool has dropped", "and moved")
        for d in swing.drops:
            table.add_row(
                f"{d.after_ms:g} ms",
                f"{number(factor * d.angle)} {shown}",
                f"{number(factor * d.speed)} {shown}/s",
                f"{number(1000 * d.drop)} mm",
                f"{number(1000 * d.distance)} mm",
            )
        out.print(table)
    out.print(f"All other joints are held. {POWER_LOSS}", soft_wrap=True)
    if swing.contacts:
        print_rows(out, contact_table(swing.contacts))
    elif swing.contacts is not None:
        out.print("It touches nothing on the way.")


def story(swing: FreeSwing) -> Story:
    """How far the joint swings, and how far the tool drops until the brakes hold it."""
    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.shown

    def amount(value: float) -> str:
        return f"{number(factor * value)} {unit}"

    last = swing.drops[-1] if swing.drops else None
    words = {
        "balanced": f"{failed.name} does not move when it swings free here: gravity pulls it neither way",
        "rest": f"{failed.name} swings by up to {amount(swing.peak)} and hangs still {amount(abs(swing.rest_angle))} away",
        "stop": f"{failed.name} falls against its stop, {amount(abs(swing.rest_angle))} away",
        "contact": f"{failed.name} falls until {_lies(swing)}, {amount(abs(swing.rest_angle))} away",
        "moving": f"{failed.name} swings by up to {amount(swing.peak)} and still moves after {number(swing.time[-1])} s",
    }
    answer = words[swing.outcome]
    facts = [] if swing.outcome == "balanced" else [(amount(swing.peak), "farthest that the joint goes")]
    if last is not None and swing.outcome != "balanced":
        way = "dropped" if last.drop >= 0 else "risen"
        answer += f"; if brakes engage after {last.after_ms:g} ms the tool has {way} by {number(1000 * abs(last.drop))} mm"
        facts += [
            (f"{number(1000 * d.distance)} mm", f"is how far the tool has moved when brakes engage after {d.after_ms:g} ms")
            for d in swing.drops[:3]
        ]
    facts.append((f"{number(swing.initial_acceleration)} {failed.unit}/s²", "acceleration of the joint as it fails"))
    joint = "joint has moved"
    rows = [
        [
            f"{d.after_ms:g} ms",
            amount(d.angle),
            f"{amount(d.speed)}/s",
            f"{number(1000 * d.drop)} mm",
            f"{number(1000 * d.distance)} mm",
        ]
        for d in swing.drops
    ]
    friction = f"{number(swing.damping)} {'N s/m' if failed.prismatic else 'N m s/rad'}"
    return Story(
        f"A free-swinging {failed.name} of {swing.arm.name}",
        f"{answer}.",
        about=f"All other joints are held. {POWER_LOSS}",
        facts=[x for x in facts if x[0][:2] != "0 "],
        views=_moving(swing),
        figures={
            "swing": ("Over time", "How far the joint has moved and the height of the tool; dots: where brakes would hold it.")
        },
        tables=[
            *([Rows(["brakes engage after", joint, "at", "tool has dropped", "and moved"], rows)] if rows else []),
            *([contact_table(swing.contacts)] if swing.contacts else []),
        ],
        method=[
            ("Friction", f"viscous, {friction}"),
            ("Brakes", "are assumed to stop the joint at once"),
            ("Simulated", f"{number(swing.time[-1])} s, MuJoCo"),
            (
                "Configuration",
                ", ".join(f"{q * j.shown[0]:.4g} {j.shown[1]}" for q, j in zip(swing.q, swing.arm.joints, strict=True)),
            ),
        ],
        arm=swing.arm,
    )


def _lies(swing: FreeSwing) -> str:
    """What is against what in the end: the first contact, as far as was noted."""
    first = swing.contacts[0] if swing.contacts else None
    return "it lies against an object" if first is None else f"{first.link} lies against {first.object}"


def _moving(swing: FreeSwing) -> list[tuple[str, list[Any]]]:
    if swing.outcome == "balanced":
        return []
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    away = np.flatnonzero(np.abs(swing.angle - swing.angle[-1]) > _SEEN * max(swing.peak, 1e-12))
    end = min(int(1.05 * (away[-1] if away.size else 0)) + 2, len(swing.time))
    time = np.linspace(0.0, swing.time[end - 1], _FRAMES)
    q = np.tile(swing.q, (_FRAMES, 1))
    q[:, swing.joint] += np.interp(time, swing.time, swing.angle)
    factor, unit = swing.arm.joints[swing.joint].shown
    readings = [
        f"{t:.2f} s, moved by {factor * x:.3g} {unit}"
        for t, x in zip(time, q[:, swing.joint] - swing.q[swing.joint], strict=True)
    ]
    words = f"{swing.arm.joint_names[swing.joint]} swinging free, all other joints held."
    return [
        (
            "The swing",
            [Picture(scene(swing.arm, q, time=time, readings=readings, cell=swing.cell).html("motion", words), words)],
        )
    ]


def figures(swing: FreeSwing) -> dict[str, Figure]:
    """The joint and the height of the tool over time, and a close-up of the time until the brakes act."""
    from holdfast.report.motions import Panel, motion_figure

    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.shown
    pull = float(np.linalg.norm(swing.arm.gravity)) or 1.0
    height = -(swing.tool_position - swing.tool_position[0]) @ swing.arm.gravity / pull
    level = (factor * swing.rest_angle, "where it ends") if swing.settled else None
    panels = [
        Panel(swing.time, factor * swing.angle, f"joint has moved, {unit}", f"Joint {failed.name}", level),
        Panel(swing.time, height, "tool height above its start, m", "Tool"),
    ]
    last = max((d.after_ms for d in swing.drops), default=0.0) / 1000
    if last > 0 and swing.outcome != "balanced":
        early = swing.time <= max(_CLOSE_UP * last, swing.time[1])
        moments = tuple(
            (d.after_ms / 1000, -1000 * d.drop, f"{d.after_ms:g} ms: {0.0 - 1000 * d.drop:.3g} mm") for d in swing.drops
        )
        label = "tool height above its start, mm"
        panels.append(Panel(swing.time[early], 1000 * height[early], label, "Tool, when brakes engage", None, moments))
    friction = f"{swing.damping:.3g} {'N s/m' if failed.prismatic else 'N m s/rad'}"
    caption = f"{swing.arm.name}: free swing of {failed.name}, all other joints held, friction {friction}, MuJoCo"
    return {"swing": motion_figure(panels, caption)}
