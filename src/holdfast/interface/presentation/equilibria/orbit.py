"""Text and JSON of a periodic motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.equilibria.limit_cycles import Orbit
from holdfast.interface.presentation.printing import TextTable, format_significant


def to_dict(orbit: Orbit) -> dict[str, Any]:
    """Return the attributes of the orbit, and its stability; s, rad and m."""
    return {**vars(orbit), "stable": orbit.stable}


def tables(orbit: Orbit) -> list[TextTable]:
    """Tabulate the motion of each joint over a period, and the range of the errors."""
    values = zip(orbit.amplitude, orbit.windings, orbit.rates, strict=True)
    rows = [
        [str(joint + 1), format_significant(amplitude), str(windings), format_significant(rate)]
        for joint, (amplitude, windings, rate) in enumerate(values)
    ]
    header = ["joint", "range, rad (or m)", "whole turns", "mean rate, rad/s (or m/s)"]
    error_ranges = (
        ("distance from the target", orbit.position_error, 1000.0, " mm"),
        ("angle", orbit.angle_error, 180 / np.pi, "°"),
    )
    errors = [
        f"{name} {format_significant(factor * lower)} to {format_significant(factor * upper)}{unit}, largest "
        f"{format_significant(time)} s after q"
        for (name, (lower, upper), factor, unit), time in zip(error_ranges, orbit.largest_times, strict=True)
        if upper > 0
    ]
    return [TextTable(header, rows, "; ".join(["over a period", *errors]))]
