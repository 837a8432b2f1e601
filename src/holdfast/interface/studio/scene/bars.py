"""Live numbers of a window as short HTML: bars per joint, lost directions, and the remaining manipulability."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

from holdfast.interface.studio.scene.machine import JointBars, LiveReading
from holdfast.kinematics.indices.lost_directions import DirectionLoss, remaining_manipulability
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task


def format_value(value: float, digits: int = 3) -> str:
    """Format a number, with rounding errors about 0 as 0."""
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "none"
    return "0" if abs(value) < 1e-12 else f"{value:.{digits}g}"


def bars_html(bars: JointBars | str, consequence: str, names: Sequence[str], conditions: Sequence[str]) -> str:
    """Return one bar per joint with the name of the worst joint, or the reason why there are none."""
    if isinstance(bars, str):
        return f'<div class="hf-bars hf-soft">{escape(bars[:1].upper() + bars[1:])}.</div>'
    finite = np.where(np.isfinite(bars.values), bars.values, 0.0)
    full_scale = max(float(finite.max()), 1.0 if bars.title == "relative manipulability" else 0.0) or 1.0
    units = set(bars.unit)
    common = "" if units == {"1"} or len(units) > 1 else f", {escape(bars.unit[0])},"
    rows = []
    for joint, (name, value) in enumerate(zip(names, bars.values, strict=True)):
        fraction = 1.0 if np.isinf(value) else min(max(float(finite[joint]) / full_scale, 0.0), 1.0)
        condition_html = "" if conditions[joint] == "healthy" else f" <b>{conditions[joint]}</b>"
        unit = f" {escape(bars.unit[joint])}" if len(units) > 1 else ""
        rows.append(
            f"<tr{' class=hf-worst' if joint == bars.worst else ''}><td>{escape(name)}{condition_html}</td>"
            f'<td><div><div style="width:{100 * fraction:.1f}%"></div></div></td><td>{format_value(value)}{unit}</td></tr>'
        )
    name, value = names[bars.worst], format_value(float(bars.values[bars.worst]))
    note = f" ({escape(bars.status)})" if bars.status else ""
    return (
        f'<div class="hf-bars" data-worst="{escape(name, quote=True)}"><strong>{escape(bars.title)}</strong>{common} '
        f"{consequence}; "
        f"worst: <b>{escape(name)}</b>, {value}{note}<table>{''.join(rows)}</table></div>"
    )


def losses_html(arm: Arm, task: Task, reading: LiveReading, failed: Sequence[int]) -> str:
    """Describe the manipulability and the directions of motion that the failure removes from the end effector."""
    if not reading.failure_joints:
        return ""
    names = " and ".join(escape(arm.joint_names[joint]) for joint in reading.failure_joints)
    remaining = remaining_manipulability(reading.losses)
    joints_html = f"<strong>{names}</strong>"
    heading = (
        f"{joints_html} {'has' if len(reading.failure_joints) == 1 else 'have'} failed" if failed else f"If {joints_html} locks"
    )
    lines = [f"{heading}: {format_percent(remaining)} of the manipulability remains."]
    for loss in reading.losses[:2]:
        loss_text = "lost" if loss.lost else f"{format_percent(loss.kept)} of the speed remains"
        lines.append(f"Motion {describe_direction(task, loss)}: <strong>{loss_text}</strong>")
    before, after = (
        " × ".join(format_value(r, 2) for r in shape.radii) for shape in (reading.healthy_ellipsoid, reading.failed_ellipsoid)
    )
    tool = "non-rotating tool" if task.angular else "tool"
    lines.append(
        f'<span class="hf-soft">ellipsoid of the {tool}, m/s at joint rates of norm 1: healthy {before}, failed {after}</span>'
    )
    return f'<div class="hf-bars">{"<br>".join(lines)}</div>'


def format_percent(fraction: float) -> str:
    """Format a fraction as a percentage; a small remainder is not shown as 0 %."""
    if fraction <= 1e-6:
        return "nothing" if fraction <= 0 else "next to nothing"
    return f"{100 * fraction:.3g} %"


def describe_direction(task: Task, loss: DirectionLoss) -> str:
    """Describe a direction of the task as a twist: translation along one axis and rotation about another."""
    twist = task.rows.T @ loss.direction
    linear, angular = float(np.linalg.norm(twist[:3])), float(np.linalg.norm(twist[3:]))
    parts = []
    for magnitude, numbers, preposition in ((linear, twist[:3], "along"), (angular, twist[3:], "about")):
        if magnitude > 0.05:
            axis = numbers / magnitude * (1.0 if numbers[int(np.abs(numbers).argmax())] > 0 else -1.0)
            fraction = "" if min(linear, angular) <= 0.05 else f"{100 * magnitude**2:.0f} % "
            parts.append(f"{fraction}{preposition} ({', '.join(f'{component:.2f}' for component in axis + 0.0)})")
    frame = " of the tool" if task.frame == "tool" else ""
    return " and ".join(parts) + frame
