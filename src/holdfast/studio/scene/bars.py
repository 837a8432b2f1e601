"""The live numbers of a window as small HTML: bars per joint, what is lost, and where the end effector is."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.indices.lost_directions import Loss, manipulability_kept
from holdfast.report.palette import BLUE, FAINT, INK, ORANGE, SOFT
from holdfast.studio.scene.machine import Bars, Reading

Array = NDArray[np.float64]
_STYLE = f"font:12px/1.35 system-ui,sans-serif;color:{INK};padding:2px 12px 6px"


def shown(value: float, digits: int = 3) -> str:
    """A number for people; rounding noise about 0 is 0."""
    if not np.isfinite(value):
        return "infinite" if np.isinf(value) else "none"
    return "0" if abs(value) < 1e-12 else f"{value:.{digits}g}"


def bars_html(bars: Bars | str, what: str, names: Sequence[str], conditions: Sequence[str]) -> str:
    """One bar per joint, the worst one named; or the sentence that says why there are none."""
    if isinstance(bars, str):
        return f'<div style="{_STYLE};color:{SOFT}">{escape(bars[:1].upper() + bars[1:])}.</div>'
    finite = np.where(np.isfinite(bars.values), bars.values, 0.0)
    whole = max(float(finite.max()), 1.0 if bars.title == "relative manipulability" else 0.0) or 1.0
    units = set(bars.unit)
    common = "" if units == {"1"} or len(units) > 1 else f", {escape(bars.unit[0])},"
    rows = []
    for k, (name, value) in enumerate(zip(names, bars.values, strict=True)):
        share = 1.0 if np.isinf(value) else min(max(float(finite[k]) / whole, 0.0), 1.0)
        color, weight = (ORANGE, "600") if k == bars.worst else (BLUE, "400")
        mark = "" if conditions[k] == "healthy" else f' <b style="color:{ORANGE}">{conditions[k]}</b>'
        unit = f" {escape(bars.unit[k])}" if len(units) > 1 else ""
        rows.append(
            f'<tr style="font-weight:{weight};white-space:nowrap">'
            f'<td style="padding:0 6px 0 0;max-width:13em;overflow:hidden;text-overflow:ellipsis">{escape(name)}{mark}</td>'
            f'<td style="width:40%"><div style="background:{FAINT};height:9px">'
            f'<div style="background:{color};height:9px;width:{100 * share:.1f}%"></div></div></td>'
            f'<td style="text-align:right;padding-left:6px">{shown(value)}{unit}</td></tr>'
        )
    name, value = names[bars.worst], shown(float(bars.values[bars.worst]))
    note = f" ({escape(bars.status)})" if bars.status else ""
    return (
        f'<div style="{_STYLE}" data-worst="{escape(name, quote=True)}"><b>{escape(bars.title)}</b>{common} {what}: '
        f'worst: <b style="color:{ORANGE}">{escape(name)}</b>, {value}{note}'
        f'<table style="width:100%;border-spacing:0 1px">{"".join(rows)}</table></div>'
    )


def losses_html(arm: Arm, task: Task, reading: Reading, failed: Sequence[int]) -> str:
    """What the failure takes from the end effector, in words."""
    if not reading.hit:
        return ""
    names = " and ".join(escape(arm.joint_names[k]) for k in reading.hit)
    kept = manipulability_kept(reading.losses)
    head = f"<b>{names}</b> {'has' if len(reading.hit) == 1 else 'have'} failed" if failed else f"If <b>{names}</b> locks"
    lines = [f"{head}: {percent(kept)} of the manipulability is left."]
    for loss in reading.losses[:2]:
        word = "lost" if loss.lost else f"{percent(loss.kept)} of the speed is left"
        lines.append(f"{direction_words(task, loss)}: <b>{word}</b>")
    before, after = (" × ".join(shown(r, 2) for r in e.radii) for e in (reading.before, reading.after))
    lines.append(
        f'<span style="color:{SOFT}">ellipsoid of the tool point, m/s at joint rates of norm 1: {before}, then {after}</span>'
    )
    return f'<div style="{_STYLE}">{"<br>".join(lines)}</div>'


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
