"""A limit cycle in numbers."""

from __future__ import annotations

from typing import Any

from holdfast.equilibria.limit_cycles import Orbit


def to_dict(orbit: Orbit) -> dict[str, Any]:
    """Period in s, multipliers, and what each joint and the error do over a period; rad and m."""
    return {
        "label": orbit.label,
        "stable": orbit.stable,
        "period_s": orbit.period,
        "multipliers": [{"real": x.real, "imaginary": x.imag} for x in orbit.multipliers],
        "amplitude": orbit.amplitude,
        "windings": orbit.windings,
        "rates": orbit.rates,
        "q": orbit.q,
        "error": {"least": orbit.error[0], "most": orbit.error[1]},
    }
