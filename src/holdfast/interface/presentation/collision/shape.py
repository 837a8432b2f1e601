"""Collision model of an arm and its surroundings, as JSON and as text."""

from __future__ import annotations

from typing import Any

from holdfast.core.formatting import format_count
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.exact_clearance import ExactClearance


def summarize_shape(clearance: Clearance, margin: float) -> dict[str, Any]:
    """Return the collision model of the arm and its cell as JSON data."""
    arm, capsules = clearance.arm, clearance.capsules
    radius = capsules.radius_along(arm)
    capsule_origin = "given" if radius is None else "assumed radius" if capsules.is_assumed(arm) else "given radius"
    source = "cover" if capsules.covers else capsule_origin
    return {
        "capsules": source,
        "radius_m": radius,
        "description": capsules.describe(arm),
        "margin_m": margin,
        "pairs_checked": clearance.pair_names,
        "pairs_not_checked": {pair.name: pair.reason for pair in clearance.ignored},
        "cell": _summarize_cell(clearance),
    }


def _summarize_cell(clearance: Clearance) -> dict[str, Any] | None:
    """Return the cell around the arm as JSON data, with the kind of its distances; None without a cell."""
    cell = clearance.cell
    if cell is None:
        return None
    entries = {"name": cell.name, "sha256": cell.digest, "objects": [solid.name for solid in cell], "margin_m": cell.margin}
    is_exact = isinstance(clearance, ExactClearance)
    return entries | ({"distances": "exact", "by": clearance.exact_by} if is_exact else {"distances": "bound"})


def describe_cell(cell: Cell, distances: str = "distances from it are lower bounds") -> str:
    """Describe the cell around the arm in a phrase."""
    return f"cell '{cell.name}' with {format_count(len(cell), 'object')} ({cell.digest[:12]}), {distances}"


def describe_shape(clearance: Clearance, margin: float) -> str:
    """Describe the collision model of the arm and its cell in a phrase that is printed in parentheses."""
    exact_note = [f"small distances from it are exact ({clearance.exact_by})"] if isinstance(clearance, ExactClearance) else []
    cell_note = "" if clearance.cell is None else f"; {describe_cell(clearance.cell, *exact_note)}"
    margin_note = f"; margin {margin:g} m" if margin else ""
    return f"capsules: {clearance.capsules.describe(clearance.arm)}{cell_note}{margin_note}"
