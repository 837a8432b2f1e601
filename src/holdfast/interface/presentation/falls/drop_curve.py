"""Presentation of the drops after a power loss at every instant of a motion."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.falls.along import DropCurve
from holdfast.core.formatting import format_count, format_number
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.falls.motion import describe_free_joints, format_distance, list_friction, name_drop
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.report.page import Section

_LIMITS_M = (0.01, 0.05, 0.1, 0.2)


def to_dict(curve: DropCurve) -> dict[str, Any]:
    """Return the drops at all instants, and the worst instant."""
    return {
        **curve.falls.arm.entry(),
        "worst_time_s": curve.time[curve.worst],
        "worst_drop_m": curve.drop[curve.worst],
        "exposure_m_s": curve.exposure,
        "spacing_s": curve.spacing,
        "rates_from": curve.rates_from,
        **{name: getattr(curve, name) for name in ("time", "drop", "impact_speed", "impact_energy")},
        **{name: getattr(curve.falls, name) for name in ("of", "q", "rates", "error")},
    }


def present(curve: DropCurve) -> Presentation:
    """Present the worst instant, the drop over time, and the hold-up times."""
    falls, arm, worst = curve.falls, curve.falls.arm, curve.worst
    answer = (
        f"A power loss at {format_number(curve.time[worst], 4)} s is the worst of {format_count(len(curve.time), 'instant')}: "
        f"the {name_drop(falls.of)} is {format_distance(curve.drop[worst])}"
    )
    contact = None if falls.contacts is None else falls.contacts.select_contact(worst)
    if contact is not None:
        answer += f" until {contact.link} touches {contact.object}, at {format_number(curve.impact_speed[worst], 3)} m/s"
    rows = [(1000 * limit, curve.find_hold_up_time(limit)) for limit in _LIMITS_M]
    times = [("never" if time is None else f"{time:.3g} s") for _, time in rows]
    table = TableSpec(
        "Time for which a buffered supply must drive the arm along this motion",
        [Header("until the drop stays below", "mm"), "hold-up time"],
        [(limit, time) for (limit, _), time in zip(rows, times, strict=True)],
    )
    return Presentation(
        f"Power loss of {arm.name} along a motion",
        f"{answer}.",
        about=f"Arm {arm.title}. {describe_free_joints(falls)}",
        facts=[
            Fact("largest drop", 1000 * float(curve.drop[worst]), "mm", phrase="largest drop, sampled"),
            Fact("mean drop", 1000 * curve.exposure / max(float(np.ptp(curve.time)), 1e-300), "mm", phrase="mean over time"),
            Fact("exposure", 1000 * curve.exposure, "mm s"),
            Fact("largest time between instants", curve.spacing, "s"),
        ],
        tables=[table],
        figures={"drop": FigureSpec(partial(draw_curves, {"": curve}), "Over time", "Drop for a power loss at each instant.")},
        sections=partial(build_film, curve),
        method=[
            ("Instants", f"{len(curve.time)}; between them nothing was simulated"),
            ("Joint rates", "given" if curve.rates_from == "given" else "slopes of parabolas through 5 rows"),
            ("Simulated", f"{falls.duration:g} s after each power loss"),
            *list_friction(falls),
        ],
        arm=arm,
    )


def draw_curves(curves: dict[str, DropCurve]) -> report.Figure:
    """Draw the drops over the instant of the power loss, one line for each named motion."""
    first = next(iter(curves.values()))
    time = max((curve.time for curve in curves.values()), key=lambda instants: instants[-1])
    lines = {
        name: np.interp(time, curve.time, 1000 * curve.drop, right=np.nan) if len(curves) > 1 else 1000 * curve.drop
        for name, curve in curves.items()
    }
    moment = (float(first.time[first.worst]), 1000 * float(first.drop[first.worst]), "worst")
    values = lines if len(curves) > 1 else lines[next(iter(lines))]
    panel = report.motions.TimePanel(time, values, f"{name_drop(first.falls.of)}, mm", "", moments=(moment,))
    caption = f"{first.falls.arm.name}: {len(first.time)} simulated power losses"
    return report.motions.motion_figure([panel], caption, "instant of the power loss, s", panel_width=report.WIDTH_IN)


def build_film(curve: DropCurve, title: str = "The motion") -> list[Section]:
    """Build the view of the motion with the drop of the tool for a power loss at each instant."""
    readings = [f"{t:.2f} s, drop {1000 * drop:.0f} mm" for t, drop in zip(curve.time, curve.drop, strict=True)]
    caption = f"{title}, with the {name_drop(curve.falls.of)} for a power loss at each instant."
    return [build_view_section(title, curve.falls.arm, curve.falls.q, caption, time=curve.time, readings=readings)]
