"""What a run that never stops does, in numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.equilibria.limit_cycles import Orbit
from holdfast.present.printing import Rows, number


def to_dict(orbit: Orbit) -> dict[str, Any]:
    """Its attributes, and whether it is stable; s, rad and m."""
    return {**vars(orbit), "stable": orbit.stable}


def next_steps(orbit: Orbit, name: str) -> list[str]:
    """What says whether it is stable."""
    del orbit
    return [f"{name}.multipliers  # all inside the unit circle: the orbit attracts"]


def tables(orbit: Orbit) -> list[Rows]:
    """What each joint does over a period."""
    values = zip(orbit.amplitude, orbit.windings, orbit.rates, strict=True)
    rows = [[str(k + 1), number(range_), str(turns), number(rate)] for k, (range_, turns, rate) in enumerate(values)]
    head = ["joint", "range, rad (or m)", "whole turns", "mean rate, rad/s (or m/s)"]
    kinds = (("distance from the target", orbit.position_error, 1000.0, " mm"), ("angle", orbit.angle_error, 180 / np.pi, "°"))
    errors = [
        f"{name} {number(factor * low)} to {number(factor * high)}{unit}, largest {number(time)} s after q"
        for (name, (low, high), factor, unit), time in zip(kinds, orbit.largest_times, strict=True)
        if high > 0
    ]
    return [Rows(head, rows, "; ".join(["over a period", *errors]))]
