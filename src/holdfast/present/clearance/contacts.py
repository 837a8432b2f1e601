"""What a motion touches, for machines and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from holdfast.clearance.contacts import Contact
from holdfast.present.printing import Rows, number


def contact_entries(contacts: Sequence[Contact], unit: str = "s", many: bool = False) -> list[dict[str, Any]]:
    """Every contact by name; with the number of its run, from 0, if there are many."""
    return [
        ({"run": c.run} if many else {}) | {f"time_{unit}": c.time, "link": c.link, "object": c.object, "depth_m": c.depth}
        for c in contacts
    ]


def contact_table(contacts: Sequence[Contact], unit: str = "s") -> Rows:
    """When each pair touches first, and how deep it goes."""
    rows = [[c.link, c.object, number(c.time), number(1000 * c.depth)] for c in contacts]
    return Rows(["link", "touches", f"first at, {unit}", "at most, mm deep"], rows)
