"""Text, tables, and JSON of basins of attraction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.control.equilibria.attraction import Basins
from holdfast.control.equilibria.stability import Kind
from holdfast.core.formatting import format_count, format_percent
from holdfast.interface.presentation.equilibria import points as points_of
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(basins: Basins) -> dict[str, Any]:
    """Return the stationary points, and the fraction of the initial configurations that end at each."""
    return {
        **points_of.to_dict(basins.points),
        "starts": len(basins.end),
        "fractions": [
            {"end": name, "fraction": interval.value, "low": interval.low, "high": interval.high}
            for name, interval in basins.shares
        ],
        "converged": {"fraction": basins.convergence.value, "low": basins.convergence.low, "high": basins.convergence.high},
        "confidence": basins.confidence,
    }


def tables(basins: Basins) -> list[TextTable]:
    """Tabulate the outcomes of the initial configurations, one row for each."""
    error_by_name = dict(
        zip(map(basins.name, range(len(basins.points))), points_of.format_target_errors(basins.points), strict=True)
    )
    rows = [[name, str(fraction), error_by_name.get(name, "")] for name, fraction in basins.shares]
    return [TextTable(["ends at", "fraction of starts", "error"], rows)]


def story(basins: Basins) -> PageContent:
    """Compose the report: the fraction of the initial configurations that reach the target, and the outcomes of the others."""
    converged, points = basins.convergence, basins.points
    points_report, start_count = points_of.story(points), format_count(len(basins.end), "start")
    largest_miss = max(
        (outcome for outcome in basins.shares if not _is_target(basins, outcome[0])),
        key=lambda outcome: outcome[1].value,
        default=None,
    )
    lock_text = points_of.describe_locks(points)
    confidence_text = f"{100 * converged.confidence:.4g} %"
    if converged.value == 0:
        reach_note = "" if (points.kind == Kind.SOLUTION).any() else ": it is out of reach"
        answer = (
            f"With {lock_text} none of {start_count} reaches the target{reach_note} (at most "
            f"{format_percent(converged.high)} would, {confidence_text})."
        )
    else:
        answer = (
            f"With {lock_text} {format_percent(converged.value)} of {start_count} reach the target "
            f"({format_percent(converged.low)} to {format_percent(converged.high)}, {confidence_text})."
        )
    error_by_name = _target_errors(basins)
    if largest_miss is not None and largest_miss[1].value:
        answer = (
            answer[:-1] + f"; {format_percent(largest_miss[1].value)} end "
            f"{_outcome_phrase(largest_miss[0])}{error_by_name.get(largest_miss[0], '')}."
        )
    facts = [
        *(
            [
                (
                    format_percent(converged.value),
                    f"of the starts reach the target; {format_percent(converged.low)} to {format_percent(converged.high)}",
                )
            ]
            if converged.value
            else []
        ),
        *[
            (format_percent(fraction.value), f"end {_outcome_phrase(name)}{error_by_name.get(name, '')}")
            for name, fraction in basins.shares
            if fraction.value
        ][:4],
    ]
    sampling_text = (
        f"{basins.shape[0]} by {basins.shape[1]} cells" if basins.shape else "starts drawn uniformly within the limits"
    )
    return PageContent(
        f"Starts from which {points.law.arm.name} still reaches its target",
        answer,
        about=points_report.about,
        facts=facts if converged.value else facts[:4],
        views=points_report.views,
        figures={"basins": ("Where the starts end", f"{start_count}, by where each ends; {sampling_text}.")},
        method=[
            ("Starts", f"{start_count}: {sampling_text}; each is simulated until it stops or the time limit comes"),
            (
                "Intervals",
                f"{100 * converged.confidence:.4g} %, exact (Clopper-Pearson); of a grid those that as many random "
                f"starts would have",
            ),
            *points_report.method[:-1],
        ],
        arm=points.law.arm,
    )


def _is_target(basins: Basins, name: str) -> bool:
    return name == "target" or name.startswith("solution")


def _outcome_phrase(name: str) -> str:
    """Return the outcome of an initial configuration as words after the verb."""
    return {"moving": "nowhere: they keep moving", "undecided": "undecided", "target": "at the target"}.get(
        name, name if name.startswith("stuck") else f"at {name}"
    )


def _target_errors(basins: Basins) -> dict[str, str]:
    return {
        basins.name(point): f", {error} off it"
        for point, error in enumerate(points_of.format_target_errors(basins.points))
        if basins.points.kind[point] != Kind.SOLUTION
    }


def figures(basins: Basins) -> dict[str, Figure]:
    """Draw ``basins``: a map where the initial configurations are a grid over two joints, else bars."""
    from holdfast.interface.presentation.equilibria.figures import draw_basins

    return {"basins": draw_basins(basins)}
