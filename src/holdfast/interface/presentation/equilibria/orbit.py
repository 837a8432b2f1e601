"""Presentation of a periodic motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.equilibria.limit_cycles import Orbit
from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface.presentation.presentation import Column, Fact, Header, Presentation, TableSpec


def to_dict(orbit: Orbit) -> dict[str, Any]:
    """Return the attributes of the orbit, and its stability; s, rad and m."""
    return {**vars(orbit), "stable": orbit.stable}


def present(orbit: Orbit) -> Presentation:
    """Present the period, the motion of each joint over a period, and the range of the errors."""
    period = "" if np.isnan(orbit.period) else f" (period {orbit.period:.4g} s)"
    columns: list[Column] = [
        "joint",
        Header("range, rad (or m)", aligned=False),
        "full revolutions",
        Header("mean rate, rad/s (or m/s)", aligned=False),
    ]
    rows = zip(range(1, len(orbit.rates) + 1), orbit.amplitude, orbit.windings, orbit.rates, strict=True)
    ranges = (
        ("distance from the target", orbit.position_error, 1000.0, "mm"),
        ("angle", orbit.angle_error, 180 / np.pi, "deg"),
    )
    facts = [
        Fact(f"{name}, largest {format_number(time, 4)} s after q", (factor * lower, factor * upper), unit)
        for (name, (lower, upper), factor, unit), time in zip(ranges, orbit.largest_times, strict=True)
        if upper > 0
    ]
    answer = f"{capitalise_first(orbit.label)}{period}."
    return Presentation("Periodic motion", answer, facts=facts, tables=[TableSpec("Over a period", columns, list(rows))])
