"""Text, tables, and JSON of the replay of waypoints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.printing import TextTable, format_significant

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.response.recovery.waypoints import WaypointCheck


def to_dict(check: WaypointCheck) -> dict[str, Any]:
    """Return the satisfied and the violated constraints, and the final pose of the end effector."""
    return {
        "ok": check.ok,
        "waypoints": len(check.q),
        "configurations_looked_at": check.looked_at,
        "beyond_limits": check.beyond_limits,
        "locks_moved": check.locks_moved,
        "too_fast": check.too_fast,
        "too_hard": check.too_hard,
        "least_clearance_m": check.least_clearance,
        "least_room_m": check.least_room,
        "closest": check.closest or None,
        "margin_m": check.margin,
        "kept": [not violation for violation in check.kept],
        "tool_at_end": check.poses[-1],
    }


def key_table(check: WaypointCheck) -> TextTable:
    """Tabulate the satisfied and the violated constraints."""
    clearance = (
        "not looked at" if check.least_clearance is None else f"{format_significant(check.least_clearance)} m {check.closest}"
    )
    rows = [
        ["waypoints", str(len(check.q))],
        ["limits", ", ".join(check.beyond_limits) or "kept"],
        ["locks", ", ".join(check.locks_moved) or "kept"],
        *([["too fast", ", ".join(check.too_fast)]] if check.too_fast else []),
        *([["accelerates too hard", ", ".join(check.too_hard)]] if check.too_hard else []),
        *([["kept all the way", ", ".join(filter(None, check.kept)) or "kept"]] if check.kept else []),
        ["least clearance", clearance],
    ]
    return TextTable(["", ""], rows)


def show(check: WaypointCheck, out: Console) -> None:
    """Print the sentences of the check."""
    for sentence in check.describe():
        out.print(capitalise_first(sentence), markup=False, soft_wrap=True)
