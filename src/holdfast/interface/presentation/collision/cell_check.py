"""Presentation of the check of a cell."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import format_count, format_number, format_percent
from holdfast.interface.presentation.presentation import Fact, Header, Notice, Presentation, TableSpec

if TYPE_CHECKING:
    from holdfast.model.collision.cell_check import CellCheck, CheckedObject


def to_dict(check: CellCheck) -> dict[str, Any]:
    """Return all results of the check, by object."""
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
        text = f"The base of '{check.arm}' touches {', '.join(check.base)}; if it is mounted there, put it into may_touch."
        notices.append(Notice(text, "bad"))
    if check.always:
        text = f"In all of {check.samples} configurations these touch: {', '.join(check.always)}; see may_touch."
        notices.append(Notice(text, "bad"))
    lines = [] if check.arm else ["Give an arm to see what it touches."]
    if not check.arm:
        answer = f"Cell '{check.cell}' has {object_count}."
    elif check.colliding:
        share = format_percent(check.colliding)
        answer = f"{share} of {check.samples} configurations within the limits touch an object, by the bound."
    else:
        answer = f"In none of {check.samples} configurations within the limits does the arm touch an object, by the bound."
    if check.arm:
        lines.append(
            f"{format_count(check.spheres, 'sphere')} cover the moving links of '{check.arm}' ({check.shape}) and reach up to "
            f"{1000 * check.reach:.3g} mm beyond its capsules."
        )
    columns = [
        Header("object", "object"),
        Header("margin", "margin, m", aligned=False),
        Header("width", "grid, mm"),
        Header("excess", "seems nearer by at most, mm"),
        *([Header("touching", "touched in", style="percent")] if check.arm else []),
    ]
    from markupsafe import Markup

    return Presentation(
        "Check of a cell",
        answer,
        about=f"Cell '{check.cell}' with {object_count}{f', arm {check.arm!r}' if check.arm else ''}",
        lines=lines,
        notices=notices,
        facts=[Fact("", check.colliding, phrase="of the configurations touch an object", style="percent")] if check.arm else [],
        tables=[TableSpec("Objects", columns, [_list_cells(checked, bool(check.arm)) for checked in check.objects])],
        method=[
            (
                "Distances",
                "lower bounds: of the spheres that cover the arm, from formulas and grids that are never above the truth",
            ),
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
