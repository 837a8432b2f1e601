"""Presentation of the check of a cell."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
from markupsafe import Markup

from holdfast.core.formatting import format_count, format_number, format_percent
from holdfast.interface.presentation.presentation import Column, Fact, Header, Notice, Presentation, TableSpec
from holdfast.model.collision.cell_check import CellCheck, CheckedObject


def to_dict(check: CellCheck) -> dict[str, Any]:
    """Return the results of the check for the arm and for each object, as JSON data."""
    return {
        "cell": check.cell,
        "sha256": check.digest,
        "arm": check.arm or None,
        "ok": check.ok,
        "base_touches": list(check.base),
        "always_touching": list(check.always),
        "colliding": check.colliding,
        "configurations": check.samples,
        "spheres": check.spheres,
        "sphere_excess_m": check.reach,
        "shape": check.shape or None,
        "objects": {
            object_check.name: {key: value for key, value in asdict(object_check).items() if key != "name"}
            for object_check in check.objects
        },
    }


def present(check: CellCheck) -> Presentation:
    """Present the contacts of the arm with the cell, and each object."""
    object_count = format_count(len(check.objects), "object")
    notices = []
    if check.base:
        text = f"The base of '{check.arm}' touches {', '.join(check.base)}. If it is mounted there, add the pair to may_touch."
        notices.append(Notice(text, "bad"))
    if check.always:
        text = f"These pairs touch in all {check.samples} configurations: {', '.join(check.always)}. See may_touch."
        notices.append(Notice(text, "bad"))
    lines = [] if check.arm else ["Use --arm to check an arm for contacts with these objects."]
    if not check.arm:
        answer = f"Cell '{check.cell}' has {object_count}."
    elif check.colliding:
        share = format_percent(check.colliding)
        answer = (
            f"The arm touches an object in at most {share} of {check.samples} random configurations within the joint limits."
        )
    else:
        answer = f"The arm touches no object in any of {check.samples} configurations within the joint limits."
    if check.arm:
        lines.append(
            f"The distances are lower bounds, computed from {format_count(check.spheres, 'sphere')} that cover the moving "
            f"links of '{check.arm}' ({check.shape}) and extend up to {1000 * check.reach:.3g} mm beyond its capsules."
        )
    columns: list[Column] = [
        "object",
        Header("margin, m", aligned=False),
        "grid, mm",
        "largest distance error, mm",
        *([Header("touched in", style="percent")] if check.arm else []),
    ]
    return Presentation(
        "Check of a cell",
        answer,
        about=f"Cell '{check.cell}' with {object_count}{f', arm {check.arm!r}' if check.arm else ''}",
        lines=lines,
        notices=notices,
        facts=[Fact("", check.colliding, phrase="of the configurations, at most, touch an object", style="percent")]
        if check.arm
        else [],
        tables=[TableSpec("Objects", columns, [_list_cells(checked, bool(check.arm)) for checked in check.objects])],
        method=[
            ("Distances", "lower bounds between objects and the spheres that cover the arm, from formulas and distance grids"),
            ("SHA-256 of the cell", Markup("<code>{}</code>").format(check.digest)),
        ],
    )


def _list_cells(checked: CheckedObject, with_contacts: bool) -> list[Any]:
    noun = "point" if checked.kind == "point cloud" else "triangle"
    kind = f"{checked.kind} of {format_count(checked.parts, noun)}" if checked.parts else checked.kind
    distances = [
        format_number(1000 * distance, 3) if checked.width else "exact" for distance in (checked.width, checked.excess)
    ]
    contact_rate = "none" if np.isnan(checked.touching) else checked.touching
    return [f"{checked.name}: {kind}", checked.margin, *distances, *([contact_rate] if with_contacts else [])]
