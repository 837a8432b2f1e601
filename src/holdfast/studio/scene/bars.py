"""The live numbers of a window as small HTML: bars per joint, what is lost, and where the end effector is."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.indices.lost_directions import Loss, manipulability_kept
from holdfast.studio.scene.machine import Bars, Reading

Array = NDArray[np.float64]


def shown(value: float, digits: int = 3) -> str:
    """A number for people; rounding noise about 0 is 0."""
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "none"
    return "0" if abs(value) < 1e-12 else f"{value:.{digits}g}"


def bars_html(bars: Bars | str, what: str, names: Sequence[str], conditions: Sequence[str]) -> str:
    """One bar per joint, the worst one named; or the sentence that says why there are none."""
    if isinstance(bars, str):
        return f'<div class="hf-bars hf-soft">{escape(bars[:1].upper() + bars[1:])}.</div>'
    finite = np.where(np.isfinite(bars.values), bars.values, 0.0)
    whole = max(float(finite.max()), 1.0 if bars.title == "relative manipulability" else 0.0) or 1.0
    units = set(bars.unit)
    common = "" if units == {"1"} or len(units) > 1 else f", {escape(bars.unit[0])},"
    rows = []
    for k, (name, value) in enumerate(zip(names, bars.values, strict=True)):
        share = 1.0 if np.isinf(value) else min(max(float(finite[k]) / whole, 0.0), 1.0)
        mark = "" if conditions[k] == "healthy" else f" <b>{conditions[k]}</b>"
        unit = f" {escape(bars.unit[k])}" if len(units) > 1 else ""
        rows.append(
            f"<tr{' class=hf-worst' if k == bars.worst else ''}><td>{escape(name)}{mark}</td>"
            f'<td><div><div style="width:{100 * share:.1f}%"></div></div></td><td>{shown(value)}{unit}</td></tr>'
        )
    name, value = names[bars.worst], shown(float(bars.values[bars.worst]))
    note = f" ({escape(bars.status)})" if bars.status else ""
    return (
        f'<div class="hf-bars" data-worst="{escape(name, quote=True)}"><strong>{escape(bars.title)}</strong>{common} {what}: '
        f"worst: <b>{escape(name)}</b>, {value}{note}<table>{''.join(rows)}</table></div>"
    )


def losses_html(arm: Arm, task: Task, reading: Reading, failed: Sequence[int]) -> str:
    """What the failure takes from the end effector, in words."""
    if not reading.hit:
        return ""
    names = " and ".join(escape(arm.joint_names[k]) for k in reading.hit)
    kept = manipulability_kept(reading.losses)
    who = f"<strong>{names}</strong>"
    head = f"{who} {'has' if len(reading.hit) == 1 else 'have'} failed" if failed else f"If {who} locks"
    lines = [f"{head}: {percent(kept)} of the manipulability is left."]
    for loss in reading.losses[:2]:
        word = "lost" if loss.lost else f"{percent(loss.kept)} of the speed is left"
        lines.append(f"{direction_words(task, loss)}: <strong>{word}</strong>")
    before, after = (" × ".join(shown(r, 2) for r in e.radii) for e in (reading.before, reading.after))
    lines.append(
        f'<span class="hf-soft">ellipsoid of the tool point, m/s at joint rates of norm 1: {before}, then {after}</span>'
    )
    return f'<div class="hf-bars">{"<br>".join(lines)}</div>'


def percent(share: float) -> str:
    """A share for people; what is not quite lost is not 0 %."""
    if share <= 1e-6:
        return "nothing" if share <= 0 else "next to nothing"
    return f"{100 * share:.3g} %"


def direction_words(task: Task, loss: Loss) -> str:
    """A direction of the task as a twist in words: which way, and about which axis."""
    twist = task.rows.T @ loss.direction
    linear, angular = float(np.linalg.norm(twist[:3])), float(np.linalg.norm(twist[3:]))
    parts = []
    for size, numbers, word in ((linear, twist[:3], "along"), (angular, twist[3:], "about")):
        if size > 0.05:
            axis = numbers / size * (1.0 if numbers[int(np.abs(numbers).argmax())] > 0 else -1.0)
            share = "" if min(linear, angular) <= 0.05 else f"{100 * size**2:.0f} % "
            parts.append(f"{share}{word} ({', '.join(f'{x:.2f}' for x in axis + 0.0)})")
    frame = " of the tool" if task.frame == "tool" else ""
    return " and ".join(parts) + frame
