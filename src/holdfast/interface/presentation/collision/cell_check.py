"""Text, tables, and JSON of the check of a cell."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count, format_percent
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant

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


def tables(check: CellCheck) -> list[TextTable]:
    """Tabulate the objects, one row for each."""
    header = ["object", "margin, m", "grid, mm", "seems nearer by at most, mm", *(["touched in"] if check.arm else [])]
    return [TextTable(header, [_format_object(object_check, bool(check.arm)) for object_check in check.objects], "Objects")]


def _format_object(object_check: CheckedObject, touched: bool) -> list[str]:
    kind = (
        f"{object_check.kind} of "
        f"{format_count(object_check.parts, 'point' if object_check.kind == 'point cloud' else 'triangle')}"
        if object_check.parts
        else object_check.kind
    )
    distances = [
        format_significant(1000 * x, 3) if object_check.width else "exact" for x in (object_check.width, object_check.excess)
    ]
    contact_rate = "none" if np.isnan(object_check.touching) else format_percent(object_check.touching)
    return [
        f"{object_check.name}: {kind}",
        format_significant(object_check.margin),
        *distances,
        *([contact_rate] if touched else []),
    ]


def story(check: CellCheck) -> PageContent:
    """Compose the report: the contacts, and each object."""
    headline, *remarks = map(capitalise_first, check.describe())
    about = f"Cell '{check.cell}'" + (f", arm '{check.arm}'" if check.arm else "")
    contact_facts = (
        [(format_percent(check.colliding), "of the configurations touch an object")] if check.arm and check.colliding else []
    )
    answer = headline if not remarks else remarks[-2] if check.ok and check.arm else remarks[0]
    if check.ok and check.arm and not check.colliding:
        answer = f"In none of {check.samples} configurations within the limits does the arm touch an object, by the bound"
    from markupsafe import Markup

    return PageContent(
        "Check of a cell",
        answer.rstrip(".") + ".",
        about=about,
        facts=[*contact_facts, (str(len(check.objects)), "objects")],
        lines=[headline, *remarks],
        method=[
            (
                "Distances",
                "lower bounds: of the spheres that cover the arm, from formulas and grids that are never above the truth",
            ),
            ("SHA-256 of the cell", Markup("<code>{}</code>").format(check.digest)),
        ],
    )
