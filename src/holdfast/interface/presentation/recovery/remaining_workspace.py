"""Tables and maps of the remaining workspace."""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from holdfast.interface.presentation.results import Drawings
    from holdfast.response.recovery.workspace_after_failure import RemainingWorkspace
FIGURE_CAPTIONS = {
    "left": (
        "What is left of the workspace",
        "Fraction of the targets that the healthy arm (left) and the failed arm (right) reach, seen from the side.",
    )
}


def to_dict(remainder: RemainingWorkspace) -> dict[str, Any]:
    """Return the number of targets that the healthy arm reaches, and that the failed arm still reaches."""
    fractions = {
        "fraction_left": remainder.left,
        "fraction_of_region": remainder.of_region,
        "healthy_fraction_of_region": remainder.healthy_of_region,
    }
    return {
        "what": remainder.region,
        "rows": remainder.rows,
        "targets": len(remainder.healthy),
        "reached_healthy": remainder.healthy.sum(),
        "still_reached": remainder.locked.sum(),
        **{name: None if interval is None else asdict(interval) for name, interval in fractions.items()},
        "starts": remainder.starts,
    }


def key_table(remainder: RemainingWorkspace) -> TextTable:
    """Tabulate the targets that the healthy arm reaches, and that the failed arm still reaches."""
    table_rows = [["targets", f"{len(remainder.healthy):,}"], ["the healthy arm reaches", f"{int(remainder.healthy.sum()):,}"]]
    return TextTable(["", ""], [*table_rows, ["the failed arm still reaches", f"{int(remainder.locked.sum()):,}"]])


def story(remainder: RemainingWorkspace) -> PageContent:
    """Compose the report: the remaining fraction of the workspace."""
    title = f"What is left of the workspace with {remainder.degraded.describe()}"
    paragraphs = [f"{sentence.removesuffix('.')}." for sentence in remainder.describe()]
    remaining, lock_text = remainder.left, remainder.degraded.describe()
    if remaining is None:
        return PageContent(title, paragraphs[0], about=remainder.region)
    answer = (
        f"With {lock_text}, {format_percent(remaining.value)} of what the healthy arm reaches is "
        f"still reached ({format_percent(remaining.low)} to {format_percent(remaining.high)}, 95 %)."
    )
    if not remaining.value:
        answer = (
            f"With {lock_text}, none of the {int(remainder.healthy.sum()):,} targets that the "
            f"healthy arm reaches was found to be reached in {remainder.starts} starts each, which does not prove that none is."
        )
    facts = [(format_percent(remaining.value), "of what the healthy arm reaches is left")] if remaining.value else []
    return PageContent(
        title,
        answer,
        about=remainder.region,
        facts=[*facts, (f"{int(remainder.healthy.sum()):,}", "targets that the healthy arm reaches were tried")],
        figures=FIGURE_CAPTIONS,
        tables=[key_table(remainder)],
        method=[
            ("Reached", f"a configuration was found in {remainder.starts} random starts; the fraction is a lower bound"),
            ("Rows that count", ", ".join(remainder.rows)),
        ],
    )


def drawings(remainder: RemainingWorkspace) -> Drawings:
    """Draw maps of the fraction of targets that the healthy and the failed arm reach; none where the healthy arm
    reaches none.
    """
    from holdfast.interface.presentation.assessment.sections.survival import draw_before_and_after
    from holdfast.interface.report.views import SIDE_VIEW, choose_side_and_top_views

    if not remainder.healthy.any():
        return {}
    view, lock_text = (choose_side_and_top_views(remainder.position) or [SIDE_VIEW])[0], remainder.degraded.describe()
    return {"left": partial(draw_before_and_after, remainder.position, remainder.healthy, remainder.locked, view, lock_text)}
