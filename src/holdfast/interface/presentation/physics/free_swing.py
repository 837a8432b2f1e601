"""Presentation of a free swing."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Notice, Presentation, TableSpec

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.control.physics.fall import FreeSwing
    from holdfast.interface.report.page import Section

_CLOSE_UP_FACTOR = 1.5  # times the last brake time
_VIEW_FRAMES = 201  # of a motion
_VISIBLE_FRACTION = 0.01  # fraction of the largest displacement

POWER_LOSS_NOTE = "A power loss releases all joints at the same time; the tool then drops further."


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


def present(swing: FreeSwing) -> Presentation:
    """Present the swing of the joint, and the drop of the tool until the brakes hold it."""
    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.display_unit
    friction = Fact("viscous friction", float(swing.damping), "N s/m" if failed.prismatic else "N m s/rad")
    duration = Fact("simulated time", float(swing.time[-1]), "s")
    rest = [Fact("displacement at rest", swing.rest_angle, failed.unit, style="angle")] if swing.is_settled else []
    columns = [
        Header("after_ms", "brakes engage after", "ms"),
        Header("moved", "joint has moved", unit, aligned=False),
        Header("speed", "joint speed", f"{unit}/s", aligned=False),
        Header("drop", "tool has dropped", "mm", aligned=False),
        Header("distance", "tool has moved", "mm", aligned=False),
    ]
    rows = [
        (f"{braked.after_ms:g} ms", factor * braked.angle, factor * braked.speed, 1000 * braked.drop, 1000 * braked.distance)
        for braked in swing.drops
    ]
    tables = [TableSpec("State when the brakes engage", columns, rows)] if rows else []
    positions = zip(swing.q, swing.arm.joints, strict=True)
    return Presentation(
        f"A free-swinging {failed.name} of {swing.arm.name}",
        _compose_answer(swing),
        about=f"Arm {swing.arm.title}. All other joints are held. {POWER_LOSS_NOTE}",
        lines=[
            *(["More --duration or --damping shows where the joint settles."] if swing.outcome == "moving" else []),
            *(["The arm touches nothing on the way."] if swing.contacts == () else []),
        ],
        notices=[Notice(f"{capitalise_first(swing.contacts[0].sentence())}.")] if swing.contacts else [],
        facts=[
            Fact("largest displacement", swing.peak, failed.unit, phrase="largest displacement of the joint", style="angle"),
            *rest,
            *[
                Fact(
                    "",
                    1000 * braked.distance,
                    "mm",
                    phrase=f"moved by the tool until brakes engage after {braked.after_ms:g} ms",
                )
                for braked in swing.drops[:3]
            ],
            Fact(
                "initial acceleration",
                swing.initial_acceleration,
                f"{failed.unit}/s^2",
                phrase="acceleration of the joint at the failure",
            ),
            friction,
            duration,
        ],
        tables=[*tables, *([tabulate_contacts(swing.contacts)] if swing.contacts else [])],
        figures={
            "swing": FigureSpec(
                partial(_draw_figure, swing),
                "Over time",
                "Displacement of the joint and height of the tool; dots mark where brakes would stop the tool.",
            )
        },
        sections=partial(_animate_swing, swing),
        method=[
            ("Friction", f"viscous, {friction.text}"),
            ("Brakes", "assumed to stop the joint instantly"),
            ("Simulated", f"{duration.text}, MuJoCo"),
            ("Configuration", ", ".join(f"{q * joint.display_unit[0]:.4g} {joint.display_unit[1]}" for q, joint in positions)),
        ],
        arm=swing.arm,
    )


def _compose_answer(swing: FreeSwing) -> str:
    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.display_unit
    peak, rest = (f"{format_number(abs(factor * angle), 4)} {unit}" for angle in (swing.peak, swing.rest_angle))
    if swing.outcome == "balanced":
        return f"{failed.name} does not move when it is released here, because it is balanced under gravity."
    answer = {
        "rest": f"{failed.name} swings by up to {peak} and settles {rest} from its start",
        "stop": f"{failed.name} falls against its stop, {rest} from its start",
        "contact": f"{failed.name} falls until {_describe_contact(swing)}, {rest} from its start",
        "moving": f"{failed.name} swings by up to {peak} and is still moving after {format_number(swing.time[-1], 4)} s",
    }[swing.outcome]
    if swing.drops:
        last_drop = swing.drops[-1]
        direction = "dropped" if last_drop.drop >= 0 else "risen"
        answer += (
            f"; if brakes engage after {last_drop.after_ms:g} ms, the tool has {direction} by "
            f"{format_number(1000 * abs(last_drop.drop), 4)} mm"
        )
    return f"{answer}."


def _describe_contact(swing: FreeSwing) -> str:
    """Describe the bodies in contact at the end, from the first recorded contact."""
    first_contact = swing.contacts[0] if swing.contacts else None
    return "it lies against an object" if first_contact is None else f"{first_contact.link} lies against {first_contact.object}"


def _animate_swing(swing: FreeSwing) -> list[Section]:
    from holdfast.interface.presentation.arm.view import build_view_section

    if swing.outcome == "balanced":
        return []
    moving_samples = np.flatnonzero(np.abs(swing.angle - swing.angle[-1]) > _VISIBLE_FRACTION * max(swing.peak, 1e-12))
    end_sample = min(int(1.05 * (moving_samples[-1] if moving_samples.size else 0)) + 2, len(swing.time))
    time = np.linspace(0.0, swing.time[end_sample - 1], _VIEW_FRAMES)
    q, displacements = np.tile(swing.q, (_VIEW_FRAMES, 1)), np.interp(time, swing.time, swing.angle)
    q[:, swing.joint] += displacements
    factor, unit = swing.arm.joints[swing.joint].display_unit
    readings = [
        f"{instant:.2f} s, displacement {factor * displacement:.3g} {unit}"
        for instant, displacement in zip(time, displacements, strict=True)
    ]
    caption = f"{swing.arm.joint_names[swing.joint]} swinging freely, all other joints held."
    return [build_view_section("The swing", swing.arm, q, caption, time=time, readings=readings, cell=swing.cell)]


def _draw_figure(swing: FreeSwing) -> Figure:
    """Draw the joint and the height of the tool over time, and a close-up of the time until the brakes engage."""
    from holdfast.interface.report.motions import TimePanel, motion_figure

    failed = swing.arm.joints[swing.joint]
    factor, unit = failed.display_unit
    gravity_norm = float(np.linalg.norm(swing.arm.gravity)) or 1.0
    height = -(swing.tool_position - swing.tool_position[0]) @ swing.arm.gravity / gravity_norm
    level = (factor * swing.rest_angle, "rest position") if swing.is_settled else None
    panels = [
        TimePanel(swing.time, factor * swing.angle, f"joint displacement, {unit}", f"Joint {failed.name}", level),
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
            TimePanel(swing.time[is_early], 1000 * height[is_early], label, "Tool until the brakes engage", None, moments)
        )
    friction = f"{swing.damping:.3g} {'N s/m' if failed.prismatic else 'N m s/rad'}"
    caption = f"{swing.arm.name}: free swing of {failed.name}, all other joints held, friction {friction}, MuJoCo"
    return motion_figure(panels, caption)
