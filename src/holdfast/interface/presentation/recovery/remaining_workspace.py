"""Presentation of the remaining workspace after a failure."""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from typing import Any

from holdfast.interface import report
from holdfast.interface.presentation.assessment.sections.survival import draw_before_and_after
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, format_value
from holdfast.interface.report.views import SIDE_VIEW, choose_side_and_top_views
from holdfast.response.recovery.workspace_after_failure import RemainingWorkspace

_MAPS_CAPTION = (
    "Fraction of the targets that the healthy arm (left) and the failed arm (right) reach; small numbers count the targets."
)


def to_dict(remainder: RemainingWorkspace) -> dict[str, Any]:
    """Return the number of targets that the healthy arm reaches, and the number that the failed arm still reaches."""
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


def present(remainder: RemainingWorkspace) -> Presentation:
    """Present the remaining fraction of the workspace."""
    lock_text, remaining, healthy = remainder.degraded.describe(), remainder.left, int(remainder.healthy.sum())
    region = f"{remainder.region}; task dimensions {', '.join(remainder.rows)}"
    title = f"Remaining workspace with {lock_text}"
    if remaining is None:
        answer = f"No configuration of the healthy arm was found for any of the {len(remainder.healthy):,} targets ({region})."
        return Presentation(title, answer)
    targets = f"{healthy:,} targets that the healthy arm reaches ({region})"
    answer = (
        f"With {lock_text}, no configuration was found for any of the {targets} in {remainder.starts} random restarts each, "
        "which does not prove that there is none."
    )
    if remaining.value:
        answer = f"With {lock_text}, the arm still reaches {format_value(remaining, 'percent')} of the {targets}."
    phrase = "of the targets that the healthy arm reaches are still reached" if remaining.value else ""
    return Presentation(
        title,
        answer,
        facts=[
            Fact("remaining fraction of the workspace", remaining, style="percent", phrase=phrase),
            Fact("targets that the healthy arm reaches", healthy, phrase="targets that the healthy arm reaches were tried"),
            Fact("targets tried", len(remainder.healthy)),
            Fact("targets that the failed arm still reaches", int(remainder.locked.sum())),
        ],
        figures={"left": FigureSpec(partial(_draw_maps, remainder), "Remaining workspace", _MAPS_CAPTION)},
        method=[
            ("Reached", f"a configuration was found in {remainder.starts} random restarts, so the fraction is a lower bound"),
            ("Task dimensions", ", ".join(remainder.rows)),
        ],
    )


def _draw_maps(remainder: RemainingWorkspace) -> report.Figure:
    view = (choose_side_and_top_views(remainder.position) or [SIDE_VIEW])[0]
    return draw_before_and_after(remainder.position, remainder.healthy, remainder.locked, view, remainder.degraded.describe())
