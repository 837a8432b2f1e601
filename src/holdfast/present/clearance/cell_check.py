"""What a check of a cell found, in numbers and words."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised, counted, percent

if TYPE_CHECKING:
    from holdfast.clearance.cell_check import CellCheck, CheckedObject


def to_dict(check: CellCheck) -> dict[str, Any]:
    """All that it found, by object."""
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
        "objects": {each.name: {key: value for key, value in asdict(each).items() if key != "name"} for each in check.objects},
    }


def tables(check: CellCheck) -> list[Rows]:
    """A row for each object."""
    head = ["object", "margin, m", "grid, mm", "seems nearer by at most, mm", *(["touched in"] if check.arm else [])]
    return [Rows(head, [_row(each, bool(check.arm)) for each in check.objects], "Objects")]


def _row(each: CheckedObject, touched: bool) -> list[str]:
    kind = (
        f"{each.kind} of {counted(each.parts, 'point' if each.kind == 'point cloud' else 'triangle')}"
        if each.parts
        else each.kind
    )
    seen = [number(1000 * x, 3) if each.width else "exact" for x in (each.width, each.excess)]
    shown = "none" if np.isnan(each.touching) else percent(each.touching)
    return [f"{each.name}: {kind}", number(each.margin), *seen, *([shown] if touched else [])]


def story(check: CellCheck) -> Story:
    """What touches, and each object."""
    first, *others = map(capitalised, check.describe())
    about = f"Cell '{check.cell}'" + (f", arm '{check.arm}'" if check.arm else "")
    touch = [(percent(check.colliding), "of the configurations touch an object")] if check.arm and check.colliding else []
    answer = first if not others else others[-2] if check.ok and check.arm else others[0]
    if check.ok and check.arm and not check.colliding:
        answer = f"In none of {check.samples} configurations within the limits does the arm touch an object, by the bound"
    from markupsafe import Markup

    return Story(
        "Check of a cell",
        answer.rstrip(".") + ".",
        about=about,
        facts=[*touch, (str(len(check.objects)), "objects")],
        lines=[first, *others],
        method=[
            (
                "Distances",
                "lower bounds: of the spheres that cover the arm, from formulas and grids that are never above the truth",
            ),
            ("SHA-256 of the cell", Markup("<code>{}</code>").format(check.digest)),
        ],
    )
