"""Presentation of the replay of waypoints."""

from __future__ import annotations

from typing import Any

from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface.presentation.presentation import Fact, Presentation
from holdfast.response.recovery.waypoints import WaypointCheck


def to_dict(check: WaypointCheck) -> dict[str, Any]:
    """Return the satisfied and the violated constraints, and the final pose of the end effector."""
    return {
        "ok": check.ok,
        "waypoints": len(check.q),
        "configurations_looked_at": check.looked_at,
        **{name: getattr(check, name) for name in ("beyond_limits", "locks_moved", "too_fast", "too_hard")},
        "least_clearance_m": check.least_clearance,
        "least_room_m": check.least_room,
        "closest": check.closest or None,
        "margin_m": check.margin,
        "kept": [not violation for violation in check.kept],
        "tool_at_end": check.poses[-1],
    }


def present(check: WaypointCheck) -> Presentation:
    """Present the satisfied and the violated constraints."""
    verdict = "satisfy all requirements" if check.ok else "do NOT satisfy all requirements"
    lines = [f"{name} exceeds its limits by {format_number(x, 4)} (rad or m)" for name, x in check.beyond_limits.items()]
    lines += [f"{name} is locked but moves by {format_number(x, 4)} (rad or m)" for name, x in check.locks_moved.items()]
    lines += [f"{name} is too fast: {format_number(rate, 4)} (rad/s or m/s)" for name, rate in check.too_fast.items()]
    lines += [f"{name} accelerates too much: {format_number(x, 4)} (rad/s² or m/s²)" for name, x in check.too_hard.items()]
    lines += [f"the tool is {violation}" for violation in check.kept if violation]
    if check.kept and not any(check.kept):
        lines.append("all path constraints are satisfied")
    if check.least_clearance is None:
        lines.append("the clearance was not checked")
    else:
        pair_text = f"{check.closest}, " if check.closest else ""
        clearance, outcome = format_number(check.least_clearance, 4), "satisfied" if check.is_collision_free else "VIOLATED"
        lines.append(f"smallest clearance {clearance} m ({pair_text}margin {check.margin:g} m): {outcome}")
    if not check.beyond_limits and not check.locks_moved:
        lines.append("limits and locks are respected")
    if check.paced and not check.too_fast and not check.too_hard:
        lines.append(f"{check.paced} are respected")
    return Presentation(
        "Replay of waypoints",
        f"The waypoints {verdict} at all checked configurations of the motion.",
        lines=[f"{capitalise_first(line)}." for line in lines],
        facts=[Fact("waypoints", len(check.q)), Fact("configurations checked", check.looked_at)],
    )
