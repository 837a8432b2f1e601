"""Text, tables, JSON, and figure of a free swing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant, print_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.control.physics.fall import FreeSwing

_CLOSE_UP_FACTOR = 1.5  # times the last brake time
_VIEW_FRAMES = 201  # of a motion
_VISIBLE_FRACTION = 0.01  # of the farthest that it goes

POWER_LOSS_NOTE = "A power loss frees all joints at once, and then the tool drops further."


def to_dict(swing: FreeSwing) -> dict[str, Any]:
    """Return the outcome of the swing, and the tool positions at the brake times."""
    failed = swing.arm.joints[swing.joint]
    unit = failed.unit
    return {
        **swing.arm.entry(),
        "joint": failed.name,
        "q": dict(zip(swing.arm.joint_names, swing.q, strict=True)),
        "unit": unit,
        "damping": swing.damping,
        "outcome": swing.outcome,
        "settled": swing.is_settled,
        f"rest_{unit}": swing.rest_angle,
        f"peak_{unit}": swing.peak,
        f"initial_acceleration_{unit}_s2": swing.initial_acceleration,
        "simulated_s": swing.time[-1],
        "drops": [
            {
                "brake_after_ms": brake_drop.after_ms,
                f"moved_{unit}": brake_drop.angle,
                f"speed_{unit}_s": brake_drop.speed,
                "tool_drop_m": brake_drop.drop,
                "tool_distance_m": brake_drop.distance,
            }
            for brake_drop in swing.drops
        ],
    } | ({} if swing.contacts is None else {"contacts": list_contacts(swing.contacts)})


def key_table(swing: FreeSwing) -> TextTable:
    """Tabulate the largest displacement, and the drop of the tool at the brake times."""
    factor, unit = swing.arm.joints[swing.joint].display_unit
    rows = [["largest displacement", f"{format_significant(factor * swing.peak)} {unit}"]]
    if swing.contacts is not None:
        rows.append(
            [
                "touches",
                ", ".join(
                    f"{contact.link} & {contact.object} at {format_significant(contact.time)} s" for contact in swing.contacts
                )
                or "nothing",
            ]
        )
    rows += [
        [f"tool has dropped after {brake_drop.after_ms:g} ms", f"{format_significant(1000 * brake_drop.drop)} mm"]
        for brake_drop in swing.drops
    ]
    return TextTable(["", ""], rows)


def show(swing: FreeSwing, out: Console) -> None:
    """Print the outcome, and a table of the brake times."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    failed = swing.arm.joints[swing.joint]
    factor, display_unit = failed.display_unit
    unit = failed.unit

    def format_amount(value: float) -> str:
        return (
            f"{format_significant(value)} m"
            if unit == "m"
            else f"{format_significant(np.degrees(value))} deg ({format_significant(value)} rad)"
        )

    for sentence in swing.describe()[:2]:
        out.print(escape(sentence), soft_wrap=True)
    facts = BandedTable()
    if swing.is_settled:
        facts.add_row("displacement at the end", f"[bold]{format_amount(swing.rest_angle)}[/]")
    facts.add_row("largest displacement", format_amount(swing.peak))
    facts.add_row("initial acceleration", f"{format_significant(swing.initial_acceleration)} {unit}/s^2")
    facts.add_row("friction", f"{format_significant(swing.damping)} {'N s/m' if unit == 'm' else 'N m s/rad'}")
    facts.add_row("simulated", f"{format_significant(swing.time[-1])} s")
    out.print(facts)
    if swing.drops:
        table = BandedTable("brakes engage after", "joint has moved", "at", "tool has dropped", "and moved")
        for brake_drop in swing.drops:
            table.add_row(
                f"{brake_drop.after_ms:g} ms",
                f"{format_significant(factor * brake_drop.angle)} {display_unit}",
                f"{format_significant(factor * brake_drop.speed)} {display_unit}/s",
                f"{format_significant(1000 * brake_drop.drop)} mm",
                f"{format_significant(1000 * brake_drop.distance)} mm",
            )
        out.print(table)
    out.print(f"All other joints are held. {POWER_LOSS_NOTE}", soft_wrap=True)
    if swing.contacts:
        print_table(out, tabulate_contacts(swing.contacts))
    elif swing.contacts is not None:
        out.print("It touches nothing on the way.")


def story(swing: FreeSwing) -> PageContent:
    """Compose the report: the swing of the joint, and the drop of the tool until the brakes hold it."""
    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.display_unit

    def format_amount(value: float) -> str:
        return f"{format_significant(factor * value)} {unit}"

    last_drop = swing.drops[-1] if swing.drops else None
    answers = {
        "balanced": f"{failed.name} does not move when it swings free here: gravity pulls it neither way",
        "rest": f"{failed.name} swings by up to {format_amount(swing.peak)} and hangs still "
        f"{format_amount(abs(swing.rest_angle))} away",
        "stop": f"{failed.name} falls against its stop, {format_amount(abs(swing.rest_angle))} away",
        "contact": f"{failed.name} falls until {_describe_contact(swing)}, {format_amount(abs(swing.rest_angle))} away",
        "moving": f"{failed.name} swings by up to {format_amount(swing.peak)} and still moves after "
        f"{format_significant(swing.time[-1])} s",
    }
    answer = answers[swing.outcome]
    facts = [] if swing.outcome == "balanced" else [(format_amount(swing.peak), "farthest that the joint goes")]
    if last_drop is not None and swing.outcome != "balanced":
        direction = "dropped" if last_drop.drop >= 0 else "risen"
        answer += (
            f"; if brakes engage after {last_drop.after_ms:g} ms the tool has {direction} by "
            f"{format_significant(1000 * abs(last_drop.drop))} mm"
        )
        facts += [
            (
                f"{format_significant(1000 * brake_drop.distance)} mm",
                f"is how far the tool has moved when brakes engage after {brake_drop.after_ms:g} ms",
            )
            for brake_drop in swing.drops[:3]
        ]
    facts.append(
        (f"{format_significant(swing.initial_acceleration)} {failed.unit}/s²", "acceleration of the joint as it fails")
    )
    joint = "joint has moved"
    rows = [
        [
            f"{brake_drop.after_ms:g} ms",
            format_amount(brake_drop.angle),
            f"{format_amount(brake_drop.speed)}/s",
            f"{format_significant(1000 * brake_drop.drop)} mm",
            f"{format_significant(1000 * brake_drop.distance)} mm",
        ]
        for brake_drop in swing.drops
    ]
    friction = f"{format_significant(swing.damping)} {'N s/m' if failed.prismatic else 'N m s/rad'}"
    return PageContent(
        f"A free-swinging {failed.name} of {swing.arm.name}",
        f"{answer}.",
        about=f"All other joints are held. {POWER_LOSS_NOTE}",
        facts=[fact for fact in facts if fact[0][:2] != "0 "],
        views=_animate_swing(swing),
        figures={
            "swing": ("Over time", "How far the joint has moved and the height of the tool; dots: where brakes would hold it.")
        },
        tables=[
            *([TextTable(["brakes engage after", joint, "at", "tool has dropped", "and moved"], rows)] if rows else []),
            *([tabulate_contacts(swing.contacts)] if swing.contacts else []),
        ],
        method=[
            ("Friction", f"viscous, {friction}"),
            ("Brakes", "are assumed to stop the joint at once"),
            ("Simulated", f"{format_significant(swing.time[-1])} s, MuJoCo"),
            (
                "Configuration",
                ", ".join(
                    f"{q * swing_joint.display_unit[0]:.4g} {swing_joint.display_unit[1]}"
                    for q, swing_joint in zip(swing.q, swing.arm.joints, strict=True)
                ),
            ),
        ],
        arm=swing.arm,
    )


def _describe_contact(swing: FreeSwing) -> str:
    """Describe the bodies in contact at the end, from the first recorded contact."""
    first_contact = swing.contacts[0] if swing.contacts else None
    return "it lies against an object" if first_contact is None else f"{first_contact.link} lies against {first_contact.object}"


def _animate_swing(swing: FreeSwing) -> list[tuple[str, list[Any]]]:
    if swing.outcome == "balanced":
        return []
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    moving_samples = np.flatnonzero(np.abs(swing.angle - swing.angle[-1]) > _VISIBLE_FRACTION * max(swing.peak, 1e-12))
    end_sample = min(int(1.05 * (moving_samples[-1] if moving_samples.size else 0)) + 2, len(swing.time))
    time = np.linspace(0.0, swing.time[end_sample - 1], _VIEW_FRAMES)
    q = np.tile(swing.q, (_VIEW_FRAMES, 1))
    q[:, swing.joint] += np.interp(time, swing.time, swing.angle)
    factor, unit = swing.arm.joints[swing.joint].display_unit
    readings = [
        f"{instant:.2f} s, moved by {factor * displacement:.3g} {unit}"
        for instant, displacement in zip(time, q[:, swing.joint] - swing.q[swing.joint], strict=True)
    ]
    caption = f"{swing.arm.joint_names[swing.joint]} swinging free, all other joints held."
    return [
        (
            "The swing",
            [Picture(scene(swing.arm, q, time=time, readings=readings, cell=swing.cell).to_html("motion", caption), caption)],
        )
    ]


def figures(swing: FreeSwing) -> dict[str, Figure]:
    """Draw the joint and the height of the tool over time, and a close-up of the time until the brakes act."""
    from holdfast.interface.report.motions import TimePanel, motion_figure

    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.display_unit
    gravity_norm = float(np.linalg.norm(swing.arm.gravity)) or 1.0
    height = -(swing.tool_position - swing.tool_position[0]) @ swing.arm.gravity / gravity_norm
    level = (factor * swing.rest_angle, "where it ends") if swing.is_settled else None
    panels = [
        TimePanel(swing.time, factor * swing.angle, f"joint has moved, {unit}", f"Joint {failed.name}", level),
        TimePanel(swing.time, height, "tool height above its start, m", "Tool"),
    ]
    last_brake_s = max((brake_drop.after_ms for brake_drop in swing.drops), default=0.0) / 1000
    if last_brake_s > 0 and swing.outcome != "balanced":
        is_early = swing.time <= max(_CLOSE_UP_FACTOR * last_brake_s, swing.time[1])
        moments = tuple(
            (
                brake_drop.after_ms / 1000,
                -1000 * brake_drop.drop,
                f"{brake_drop.after_ms:g} ms: {0.0 - 1000 * brake_drop.drop:.3g} mm",
            )
            for brake_drop in swing.drops
        )
        label = "tool height above its start, mm"
        panels.append(
            TimePanel(swing.time[is_early], 1000 * height[is_early], label, "Tool, when brakes engage", None, moments)
        )
    friction = f"{swing.damping:.3g} {'N s/m' if failed.prismatic else 'N m s/rad'}"
    caption = f"{swing.arm.name}: free swing of {failed.name}, all other joints held, friction {friction}, MuJoCo"
    return {"swing": motion_figure(panels, caption)}
