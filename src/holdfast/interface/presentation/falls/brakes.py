"""Presentation of the drops with brakes of several torques and delays."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.falls.brake_curve import BrakeComparison
from holdfast.core.formatting import format_number
from holdfast.interface import report
from holdfast.interface.presentation.falls.motion import format_distance, name_drop
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec


def to_dict(comparison: BrakeComparison) -> dict[str, Any]:
    """Return the drops of all brakes."""
    names = ("q", "of", "after", "torque", "drop", "drop_at_brake", "drop_without", "need")
    return {**comparison.arm.entry(), **{name: getattr(comparison, name) for name in names}}


def present(comparison: BrakeComparison) -> Presentation:
    """Present the drops over delay and torque, and the torque that holds the arm at rest."""
    row, column = np.unravel_index(np.argmin(comparison.drop), comparison.drop.shape)
    delays = [f"{1000 * after:g} ms" for after in comparison.after]
    columns: list[Column] = ["brake torque", *(Header(f"after {delay}", "mm", aligned=False) for delay in delays)]
    rows = [
        (name, *(1000 * drops))
        for name, drops in zip(
            ["stops at once", *_name_brakes(comparison)], [comparison.drop_at_brake, *comparison.drop], strict=True
        )
    ]
    weak = [
        joint.name
        for joint, need, torque in zip(comparison.arm.joints, comparison.need, comparison.torque.max(axis=0), strict=True)
        if need > torque
    ]
    return Presentation(
        f"Brakes of {comparison.arm.name} after a power loss",
        f"The smallest drop is {format_distance(comparison.drop[row, column])}, with {_name_brakes(comparison)[row]} after "
        f"{delays[column]}; without brakes it is {format_distance(comparison.drop_without)}.",
        about=f"Arm {comparison.arm.title}",
        lines=[
            "Brakes of finite torque need time and distance to stop the arm; the row 'stops at once' ignores that.",
            *([f"No brake torque holds {', '.join(weak)} in this configuration without friction."] if weak else []),
        ],
        facts=[
            Fact(
                "brake torque that holds each joint at rest",
                ", ".join(f"{format_number(max(float(need), 0.0), 3)}" for need in comparison.need),
                "N m (N)",
            )
        ],
        tables=[TableSpec(f"Largest {name_drop(comparison.of)}", columns, rows)],
        figures={"brakes": FigureSpec(partial(_draw_figure, comparison), "Drop over the delay")},
        arm=comparison.arm,
    )


def _name_brakes(comparison: BrakeComparison) -> list[str]:
    """Return the torque of each brake as text: one number if it is the same for all joints."""
    return [
        f"{torque[0]:g} N m" if (torque == torque[0]).all() else f"{' / '.join(f'{value:g}' for value in torque)} N m"
        for torque in comparison.torque
    ]


def _draw_figure(comparison: BrakeComparison) -> report.Figure:
    lines = dict(zip(_name_brakes(comparison), 1000 * comparison.drop, strict=True))
    lines["stops at once"] = 1000 * comparison.drop_at_brake
    panel = report.motions.TimePanel(1000 * comparison.after, lines, f"largest {name_drop(comparison.of)}, mm", "")
    caption = f"{comparison.arm.name}: {comparison.drop.size} simulated power losses"
    return report.motions.motion_figure([panel], caption, "delay of the brakes, ms", panel_width=report.WIDTH_IN)
