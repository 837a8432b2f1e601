"""What a run that never stops does, in numbers."""

from __future__ import annotations

from typing import Any

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
    return [Rows(head, rows, f"over a period; error {number(orbit.error[0])} to {number(orbit.error[1])}, m and rad")]
