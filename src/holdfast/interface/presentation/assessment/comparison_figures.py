"""Figures of a comparison of assessments, and a slider that moves the threshold over them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from holdfast.core.formatting import format_as_given, format_count, format_half_width, format_interval
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.assessment import thresholds
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.tables import best_intervals_are_disjoint, find_leaders
from holdfast.interface.report.page import Block, Picture, Section
from holdfast.studies.assessment.comparison import Comparison


def draw_distributions(comparison: Comparison) -> report.Figure:
    """Draw the cumulative distributions of all candidates."""
    f = AssessmentFacts(comparison.assessments[0], comparison.threshold)
    candidates = list(zip(comparison.names, comparison.assessments, strict=True))
    samples = [
        ("At the configurations found" if f.assessment.region.kind != "joints" else "Cumulative (CDF)", candidates, False)
    ]
    if any(assessment.optimised is not None for assessment in comparison.assessments):
        samples.append(
            (
                "At the best configurations",
                [(name, assessment) for name, assessment in candidates if assessment.optimised is not None],
                True,
            )
        )
    axis, log = _choose_index_axis(comparison, f)
    marks = [report.Mark(comparison.threshold, f"threshold {format_as_given(comparison.threshold)}{f.unit_suffix}")]
    if (bound := _find_common_bound(comparison)) is not None:
        marks.append(report.Mark(bound, f"no configuration can exceed {bound:.3f}", "bound"))
    panels = [
        (title, [report.Curve(axis, assessment.cdf(axis, optimised=optimised), name) for name, assessment in group])
        for title, group, optimised in samples
    ]
    return report.compare_cdf_figure(panels, marks, f.axis_label, ylabel="fraction with a smaller value, F", log=log)


def _find_common_bound(comparison: Comparison) -> float | None:
    """Return the upper bound of the index if all candidates share one number, else None."""
    bounds = {assessment.index.bound for assessment in comparison.assessments}
    return bounds.pop() if len(bounds) == 1 else None


def _choose_index_axis(comparison: Comparison, facts: AssessmentFacts) -> tuple[FloatArray, bool]:
    """Return the index values at which all distributions are drawn, and whether they are logarithmic."""
    distributions = [
        assessment.distribution_of(optimised)
        for assessment in comparison.assessments
        for optimised in (False, True)[: 1 + (assessment.optimised is not None)]
    ]
    extremes = [
        value for distribution in distributions for value in (distribution.lowest, distribution.highest) if np.isfinite(value)
    ]
    log = not facts.larger_is_better and min(extremes) > 0 and max(extremes) > 20 * min(extremes)
    extremes += [value for value in (comparison.threshold, _find_common_bound(comparison)) if value is not None]
    if log:
        return np.geomspace(min(extremes), max(extremes), 801), True
    return np.linspace(min(0.0, *extremes), 1.04 * max(0.0, *extremes), 801), False


def _build_threshold_slider(comparison: Comparison, facts: AssessmentFacts, figure: report.Figure, band: float) -> Block:
    """Build a threshold slider with the probability of each candidate and the best candidate at every step."""
    axis, log = _choose_index_axis(comparison, facts)
    threshold_values = thresholds.choose_thresholds(axis, log, comparison.threshold)
    comparisons = [replace(comparison, threshold=moved) for moved in threshold_values.tolist()]
    answers: dict[str, list[str]] = {}
    if len({assessment.index.task.name for assessment in comparison.assessments}) == 1:
        answers["Largest probability"] = [_describe_leader(moved) for moved in comparisons]
    for name, assessment in zip(comparison.names, comparison.assessments, strict=True):
        answers[name] = [format_interval(moved.interval(name)) for moved in comparisons]
        if assessment.optimised is not None:
            answers[f"{name}, best configurations"] = [
                format_interval(moved.interval(name, optimised=True)) for moved in comparisons
            ]
    return thresholds.build_slider(facts, threshold_values, answers, figure, "each curve", band)


def _describe_leader(comparison: Comparison) -> str:
    """Name the candidate or candidates with the largest probability, and whether the lead is significant."""
    leaders = find_leaders(comparison)
    if len(leaders) > 1:
        return "all equal" if len(leaders) == len(comparison.names) else f"{' and '.join(leaders)}, equal"
    is_certain = best_intervals_are_disjoint(comparison)
    return leaders[0] if is_certain else f"{leaders[0]}; its interval overlaps with that of the next"


def build_sections(comparison: Comparison) -> list[Section]:
    """Build the figure of the distributions, its explanation, and the threshold slider."""
    facts, figure = AssessmentFacts(comparison.assessments[0], comparison.threshold), draw_distributions(comparison)
    text = (
        f"Over all {format_count(facts.distribution.samples, facts.noun)} of each candidate. The probability of meeting a "
        f"threshold is {'1 − F' if facts.larger_is_better else 'F'} at the threshold. "
    )
    if any(assessment.distribution.unreached for assessment in comparison.assessments):
        text += f"A pose without a configuration counts as {'0' if facts.larger_is_better else 'infinite'}. "
    band_width = max(assessment.distribution.band() for assessment in comparison.assessments)
    text += f"The 95 % band of each curve is {format_half_width(band_width)}."
    picture = Picture(report.svg(figure, "compare", "Cumulative distributions of all candidates"), text)
    slider = _build_threshold_slider(comparison, facts, figure, band_width)
    return [Section("Distribution of the index", [picture, slider])]
