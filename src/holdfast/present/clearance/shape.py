"""What the shape of an arm is taken to be and what is around it, for machines and for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.clearance.exact.sharper import Sharper
from holdfast.words import counted

if TYPE_CHECKING:
    from holdfast.cell.cell import Cell
    from holdfast.clearance.clearance import Clearance


def shape_summary(clearance: Clearance, margin: float) -> dict[str, Any]:
    """What the arm and its cell are taken to be, for machines."""
    arm, capsules = clearance.arm, clearance.capsules
    radius = capsules.radius_along(arm)
    given = "given" if radius is None else "assumed radius" if capsules.assumed(arm) else "given radius"
    source = "cover" if capsules.covers else given
    return {
        "capsules": source,
        "radius_m": radius,
        "description": capsules.describe(arm),
        "margin_m": margin,
        "pairs_checked": clearance.pair_names,
        "pairs_not_checked": {p.name: p.reason for p in clearance.ignored},
        "cell": None if clearance.cell is None else cell_summary(clearance.cell) | _exact(clearance),
    }


def _exact(clearance: Clearance) -> dict[str, Any]:
    return {"distances": "exact", "by": clearance.exact_by} if isinstance(clearance, Sharper) else {}


def cell_summary(cell: Cell) -> dict[str, Any]:
    """What is around the arm, for machines; its distances are lower bounds."""
    return {
        "name": cell.name,
        "sha256": cell.digest,
        "objects": [solid.name for solid in cell],
        "margin_m": cell.margin,
        "distances": "bound",
    }


def cell_text(cell: Cell, distances: str = "distances from it are lower bounds") -> str:
    """What is around the arm, for people."""
    return f"cell '{cell.name}' with {counted(len(cell), 'object')} ({cell.digest[:12]}), {distances}"


def shape_text(clearance: Clearance, margin: float) -> str:
    """What the arm and its cell are taken to be, in brackets after a sentence."""
    exact = [f"small distances from it are exact ({clearance.exact_by})"] if isinstance(clearance, Sharper) else []
    around = "" if clearance.cell is None else f"; {cell_text(clearance.cell, *exact)}"
    wanted = f"; margin {margin:g} m" if margin else ""
    return f"capsules: {clearance.capsules.describe(clearance.arm)}{around}{wanted}"
