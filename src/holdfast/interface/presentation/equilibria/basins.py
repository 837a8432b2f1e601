"""Presentation of basins of attraction."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.equilibria.attraction import Basins
from holdfast.control.equilibria.stability import Kind
from holdfast.core.formatting import format_count, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.equilibria import points as points_of
from holdfast.interface.presentation.equilibria.curves import display_values, label_axis
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec


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


def present(basins: Basins) -> Presentation:
    """Present the fraction of the initial configurations that reach the target, and the outcomes of the others."""
    converged, points = basins.convergence, basins.points
    start_count = format_count(len(basins.end), "start")
    largest_miss = max(
        (outcome for outcome in basins.shares if not _is_target(basins, outcome[0])),
        key=lambda outcome: outcome[1].value,
        default=None,
    )
    lock_text = points_of.describe_locks(points)
    confidence_text = f"{100 * converged.confidence:.4g} %"
    if converged.value == 0:
        reach_note = "" if (points.kind == Kind.SOLUTION).any() else ", which is out of reach"
        answer = (
            f"With {lock_text}, none of {start_count} reaches the target{reach_note} (upper end of the {confidence_text} "
            f"interval: {format_percent(converged.high)})."
        )
    else:
        answer = (
            f"With {lock_text}, {format_percent(converged.value)} of {start_count} reach the target "
            f"({format_percent(converged.low)} to {format_percent(converged.high)}, {confidence_text})."
        )
    error_by_name = _target_errors(basins)
    if largest_miss is not None and largest_miss[1].value:
        answer = (
            answer[:-1] + f"; {format_percent(largest_miss[1].value)} end "
            f"{_outcome_phrase(largest_miss[0])}{error_by_name.get(largest_miss[0], '')}."
        )
    facts = [
        Fact("", fraction.value, phrase=f"end {_outcome_phrase(name)}{error_by_name.get(name, '')}", style="percent")
        for name, fraction in basins.shares
        if fraction.value
    ][:4]
    if converged.value:
        phrase = f"of the starts reach the target; {format_percent(converged.low)} to {format_percent(converged.high)}"
        facts.insert(0, Fact("", converged.value, phrase=phrase, style="percent"))
    sampling_text = (
        f"a grid of {basins.shape[0]} by {basins.shape[1]}" if basins.shape else "sampled uniformly within the joint limits"
    )
    errors = dict(zip(map(basins.name, range(len(points))), points_of.format_target_errors(points).tolist(), strict=True))
    columns = ["ends at", "fraction of starts", "distance from the target"]
    rows = [(name, fraction, errors.get(name, "")) for name, fraction in basins.shares]
    return Presentation(
        f"Starts from which {points.law.arm.name} still reaches its target",
        answer,
        about=f"{points.law.arm.title}, {points.law.describe()}; stationary points from {points.starts:,} random starts",
        facts=facts,
        tables=[TableSpec("Outcomes of the starts", columns, rows)],
        figures={
            "basins": FigureSpec(
                partial(_draw_basins, basins), "Basins of attraction", f"{start_count} by outcome; {sampling_text}."
            )
        },
        sections=partial(points_of.draw_stationary_arms, points),
        method=[
            ("Starts", f"{start_count}, {sampling_text}; each is simulated until it stops or reaches the time limit"),
            (
                "Intervals",
                f"{100 * converged.confidence:.4g} %, exact (Clopper-Pearson); for a grid, computed as for the same number of "
                "random starts",
            ),
            *points_of.list_methods(points),
        ],
        arm=points.law.arm,
    )


def _is_target(basins: Basins, name: str) -> bool:
    return name == "target" or name.startswith("solution")


def _outcome_phrase(name: str) -> str:
    """Return the outcome of an initial configuration as a phrase after the verb end."""
    return {"moving": "nowhere, because they keep moving", "undecided": "undecided", "target": "at the target"}.get(
        name, name if name.startswith("stuck") else f"at {name}"
    )


def _target_errors(basins: Basins) -> dict[str, str]:
    return {
        basins.name(point): f" ({error} from the target)"
        for point, error in enumerate(points_of.format_target_errors(basins.points))
        if basins.points.kind[point] != Kind.SOLUTION
    }


def _draw_basins(basins: Basins) -> report.Figure:
    """Draw a map of the basins where the initial configurations are a grid over two joints (Fig. 8 of Goel et al. 2005), else
    bars.
    """
    points, arm = basins.points, basins.points.law.arm
    lock_text = ", ".join(
        f"{arm.joint_names[index]} locked at {value * arm.joints[index].display_unit[0]:.4g} "
        f"{arm.joints[index].display_unit[1]}"
        for index, value in zip(points.locked, points.at, strict=True)
    )
    caption = f"{arm.name}, {points.law.name}; {lock_text}; {len(basins.end)} starts"
    shares = basins.shares
    if basins.shape is None:
        caption_text = f"{caption}; lines: {100 * basins.confidence:.4g} % intervals"
        return report.curves.basin_fraction_figure(
            [outcome for outcome, _ in shares],
            [(interval.value, interval.low, interval.high) for _, interval in shares],
            caption_text,
        )
    first, second = basins.healthy
    codes, cells = np.unique(basins.end, return_inverse=True)
    names = [basins.name(int(code)) for code in codes]
    lower, upper = (extremum(basins.starts[:, [first, second]], axis=0) for extremum in (np.min, np.max))
    half_cells = (upper - lower) / (np.array(basins.shape) - 1) / 2
    lower, upper = lower - half_cells, upper + half_cells
    scale = np.array([arm.joints[first].display_unit[0], arm.joints[second].display_unit[0]])
    lower_shown, upper_shown = lower * scale, upper * scale
    isolated = np.flatnonzero(~points.continuum)
    value, y = (display_values(arm, points.q, index).tolist() for index in (first, second))
    marks = [(points.kinds[index], value[index], y[index], f"{points.kinds[index]} {index + 1}") for index in isolated]
    lines = [(display_values(arm, q, first), display_values(arm, q, second)) for q in basins.boundaries]
    extent = (float(lower_shown[0]), float(upper_shown[0]), float(lower_shown[1]), float(upper_shown[1]))
    return report.curves.basin_map_figure(
        cells.reshape(basins.shape), names, extent, marks, lines, (label_axis(arm, first), label_axis(arm, second)), caption
    )
