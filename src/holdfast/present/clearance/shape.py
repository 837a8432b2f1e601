"""What the shape of an arm is taken to be, for machines and for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from holdfast.clearance.clearance import Clearance


def shape_summary(clearance: Clearance, margin: float) -> dict[str, Any]:
    """What the arm is taken to be, for machines."""
    arm, capsules = clearance.arm, clearance.capsules
    radius = capsules.radius_along(arm)
    source = "given" if radius is None else "assumed radius" if capsules.assumed(arm) else "given radius"
    return {
        "capsules": source,
        "radius_m": radius,
        "description": capsules.describe(arm),
        "margin_m": margin,
        "pairs_checked": clearance.pair_names,
        "pairs_not_checked": {p.name: p.reason for p in clearance.ignored},
    }


def shape_text(clearance: Clearance, margin: float) -> str:
    """What the arm is taken to be, in brackets after a sentence."""
    wanted = f"; margin {margin:g} m" if margin else ""
    return f"capsules: {clearance.capsules.describe(clearance.arm)}{wanted}"
