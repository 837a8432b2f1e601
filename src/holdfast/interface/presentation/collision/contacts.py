"""JSON entries and table of the contacts between an arm and objects during a motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from holdfast.core.formatting import format_number
from holdfast.interface.presentation.presentation import Column, Header, TableSpec
from holdfast.model.collision.contacts import Contact


def list_contacts(contacts: Sequence[Contact], unit: str = "s", many: bool = False) -> list[dict[str, Any]]:
    """List every contact as JSON data, with the number of its run, from 0, if there are several runs (``many``)."""
    return [({"run": contact.run} if many else {}) | _contact_entry(contact, unit) for contact in contacts]


def _contact_entry(contact: Contact, unit: str) -> dict[str, Any]:
    exact = contact.exact_time
    exact_fields = (
        {} if exact is None else {"exact": np.isfinite(exact), f"exact_time_{unit}": exact if np.isfinite(exact) else None}
    )
    return {
        f"time_{unit}": contact.time,
        "link": contact.link,
        "object": contact.object,
        "depth_m": contact.depth,
        "by": "bound",
        **exact_fields,
    }


def tabulate_contacts(contacts: Sequence[Contact], unit: str = "s") -> TableSpec:
    """Tabulate the first contact time of each pair, by the bound and, where requested, exactly, and its depth."""
    columns: list[Column] = [
        "link",
        "touches",
        Header(f"first contact, {unit}", aligned=False),
        f"exact time, {unit}",
        Header("depth at most, mm", aligned=False),
    ]
    rows: list[tuple[Any, ...]] = [
        (contact.link, contact.object, contact.time, _format_exact_time(contact), 1000 * contact.depth) for contact in contacts
    ]
    if all(contact.exact_time is None for contact in contacts):
        columns, rows = columns[:3] + columns[4:], [row[:3] + row[4:] for row in rows]
    return TableSpec("Contacts", columns, rows)


def _format_exact_time(contact: Contact) -> str:
    exact = contact.exact_time
    return "" if exact is None else format_number(exact, 4) if np.isfinite(exact) else "does not touch"
