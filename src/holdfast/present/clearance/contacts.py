"""What a motion touches, for machines and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from holdfast.clearance.contacts import Contact
from holdfast.present.printing import Rows, number


def contact_entries(contacts: Sequence[Contact], unit: str = "s", many: bool = False) -> list[dict[str, Any]]:
    """Every contact by name; with the number of its run, from 0, if there are many."""
    return [({"run": c.run} if many else {}) | _entry(c, unit) for c in contacts]


def _entry(contact: Contact, unit: str) -> dict[str, Any]:
    exact = contact.exact_time
    found = {} if exact is None else {"exact": np.isfinite(exact), f"exact_time_{unit}": exact if np.isfinite(exact) else None}
    return {
        f"time_{unit}": contact.time,
        "link": contact.link,
        "object": contact.object,
        "depth_m": contact.depth,
        "by": "bound",
        **found,
    }


def contact_table(contacts: Sequence[Contact], unit: str = "s") -> Rows:
    """When each pair touches first, by the bound and where it was asked exactly, and how deep it goes."""
    asked = any(c.exact_time is not None for c in contacts)
    rows = [[c.link, c.object, number(c.time), *([_exact(c)] * asked), number(1000 * c.depth)] for c in contacts]
    return Rows(["link", "touches", f"first at, {unit}", *(["exactly at"] * asked), "at most, mm deep"], rows)


def _exact(contact: Contact) -> str:
    exact = contact.exact_time
    return "" if exact is None else number(exact) if np.isfinite(exact) else "does not touch"
