"""What is left of the workspace: numbers, and maps."""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import percent

if TYPE_CHECKING:
    from holdfast.present.results import Drawings
    from holdfast.recovery.remainder import WhatIsLeft
FIGURES = {
    "left": (
        "What is left of the workspace",
        "Fraction of the targets that the healthy arm (left) and the failed arm (right) reach, seen from the side.",
    )
}


def to_dict(left: WhatIsLeft) -> dict[str, Any]:
    """How many targets were reached before, and how many still are."""
    fractions = {
        "fraction_left": left.left,
        "fraction_of_region": left.of_region,
        "healthy_fraction_of_region": left.healthy_of_region,
    }
    return {
        "what": left.region,
        "rows": left.rows,
        "targets": len(left.healthy),
        "reached_healthy": left.healthy.sum(),
        "still_reached": left.locked.sum(),
        **{name: None if found is None else asdict(found) for name, found in fractions.items()},
        "starts": left.starts,
    }


def key_table(left: WhatIsLeft) -> Rows:
    """How many targets were reached before, and how many still are."""
    told = [["targets", f"{len(left.healthy):,}"], ["the healthy arm reaches", f"{int(left.healthy.sum()):,}"]]
    return Rows(["", ""], [*told, ["the failed arm still reaches", f"{int(left.locked.sum()):,}"]])


def story(left: WhatIsLeft) -> Story:
    """How much of the workspace is left."""
    title = f"What is left of the workspace with {left.degraded.describe()}"
    told = [f"{line.removesuffix('.')}." for line in left.describe()]
    found, failed = left.left, left.degraded.describe()
    if found is None:
        return Story(title, told[0], about=left.region)
    answer = (
        f"With {failed}, {percent(found.value)} of what the healthy arm reaches is "
        f"still reached ({percent(found.low)} to {percent(found.high)}, 95 %)."
    )
    if not found.value:
        answer = (
            f"With {failed}, none of the {int(left.healthy.sum()):,} targets that the "
            f"healthy arm reaches was found to be reached in {left.starts} starts each, which does not prove that none is."
        )
    facts = [(percent(found.value), "of what the healthy arm reaches is left")] if found.value else []
    return Story(
        title,
        answer,
        about=left.region,
        facts=[*facts, (f"{int(left.healthy.sum()):,}", "targets that the healthy arm reaches were tried")],
        figures=FIGURES,
        tables=[key_table(left)],
        method=[
            ("Reached", f"a configuration was found in {left.starts} random starts; the fraction is a lower bound"),
            ("Rows that count", ", ".join(left.rows)),
        ],
    )


def next_steps(left: WhatIsLeft, name: str) -> list[str]:
    """The whole report."""
    del left
    return [f'{name}.report("left.html")']


def drawings(left: WhatIsLeft) -> Drawings:
    """Maps of the fraction of targets that the healthy and the failed arm reach; none where the healthy arm reaches none."""
    from holdfast.present.assessment.sections.survival import before_and_after_figure
    from holdfast.report.views import SIDE, sides

    if not left.healthy.any():
        return {}
    view, failed = (sides(left.position) or [SIDE])[0], left.degraded.describe()
    return {"left": partial(before_and_after_figure, left.position, left.healthy, left.locked, view, failed)}
