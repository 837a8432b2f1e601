"""Figures of a comparison of laws."""

from __future__ import annotations

import numpy as np

from holdfast.control.convergence.law_comparison import ANY_JOINT, LawComparison
from holdfast.control.simulation.errors import error_kinds
from holdfast.core.formatting import capitalise_first
from holdfast.core.probability.intervals import Difference
from holdfast.interface import report
from holdfast.interface.presentation.convergence.law_tables import OUTCOME_NAMES, get_time_unit

_COST_MEASURES = (
    ("deviation", "distance from the line, m", 1.0),
    ("angle", "largest angle, deg", 180 / np.pi),
    ("time", "time to the target, {unit}", 1.0),
)


def draw_law_outcomes(comparison: LawComparison) -> report.Figure:
    """Draw stacked bars of the outcomes, with a group for each failure and a bar for each law."""
    stacks = []
    for failure in comparison.failures:
        cases = [comparison.case(name, failure) for name in comparison.names]
        shares = np.array([[case.has_outcome(outcome).mean() for outcome in OUTCOME_NAMES] for case in cases])
        intervals = [case.share() for case in cases]
        lower, upper = (
            np.array([getattr(interval, bound) if interval else np.nan for interval in intervals]) for bound in ("low", "high")
        )
        stacks.append(
            report.Stack(
                name=failure,
                bars=comparison.names,
                shares=shares,
                low=lower,
                high=upper,
                level=float(cases[0].reachable.mean()),
            )
        )
    return report.stack_figure(
        stacks, OUTCOME_NAMES, f"fraction of the {len(comparison):,} motions", level="targets still within reach"
    )


def draw_law_gains(comparison: LawComparison) -> report.Figure:
    """Draw the paired differences to the first law, by joint."""
    failures = [*comparison.joints, ANY_JOINT]

    def make_gains(name: str, differences: list[Difference], factor: float = 1.0) -> report.Gains:
        value, lower, upper = (
            factor * np.array([getattr(difference, attribute) for difference in differences])
            for attribute in ("value", "low", "high")
        )
        return report.Gains(label=name, value=value, low=lower, high=upper)

    converged_gains = [
        make_gains(name, [comparison.gain(name, failure) for failure in failures]) for name in comparison.names[1:]
    ]
    error_panels = [
        (
            f"{kind.name.partition('_')[0]} error, {kind.unit}",
            [
                make_gains(name, [comparison.change(name, kind.name, failure) for failure in failures], kind.factor)
                for name in comparison.names[1:]
            ],
        )
        for kind in error_kinds(comparison.laws[0])
    ]
    return report.gain_figure(failures, [("fraction that converges", converged_gains), *error_panels])


def draw_law_errors(comparison: LawComparison) -> report.Figure:
    """Draw cumulative distributions of the errors at the end, in mm and degrees, over all joints; with one unit also their
    excess.
    """
    kinds = error_kinds(comparison.laws[0])
    quantities: list[tuple[str, str, float]] = [
        (kind.name, f"{capitalise_first(kind.text)} at the end, {kind.unit}", kind.factor) for kind in kinds
    ]
    if len(kinds) == 1:
        quantities.append(("excess", f"Error above the smallest possible, {kinds[0].unit}", kinds[0].factor))
    panels = []
    for quantity, title, factor in quantities:
        samples = [factor * comparison.pool_values(name, quantity).ravel() for name in comparison.names]
        axis_values = np.geomspace(
            1e-5 * factor, 1.2 * max(float(np.nanmax(sample, initial=1e-3 * factor)) for sample in samples), 400
        )
        curves = []
        for name, values in zip(comparison.names, samples, strict=True):
            finite = np.sort(values[np.isfinite(values)])
            curves.append(
                report.Curve(axis_values, np.searchsorted(finite, axis_values, side="right") / max(len(values), 1), name)
            )
        panels.append((title, curves))
    unit_text = " or ".join(kind.unit for kind in kinds)
    return report.compare_cdf_figure(
        panels, [], f"error, {unit_text}", ylabel="fraction of runs with at most this error", log=True
    )


def draw_healthy_costs(comparison: LawComparison) -> report.Figure:
    """Draw quantiles of the cost of each law for the healthy arm."""
    spreads = []
    for measure, label, factor in _COST_MEASURES:
        quantiles = factor * np.array([comparison.cost(name, measure) for name in comparison.names])  # type: ignore[arg-type]
        spreads.append(report.Spread(label.format(unit=get_time_unit(comparison)), quantiles))
    return report.spread_figure(comparison.names, spreads)
