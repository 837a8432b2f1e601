"""Distribution of the index over the region."""

from __future__ import annotations

from holdfast.core.formatting import format_as_given, format_count, format_interval, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.assessment import thresholds
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Picture, Text


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the figure of the density and the cumulative distribution, and the threshold slider."""
    d = facts.distribution
    if not facts.has_finite_values:
        return (
            [Text(f"The index is infinite at each of the {format_count(d.reached, facts.noun)} reached.")] if d.reached else []
        )
    titles = (
        f"Density (PDF), {d.reached:,} {'reached ' if d.unreached else ''}{facts.noun}s",
        f"Cumulative (CDF), {d.samples:,} {facts.noun}s",
    )
    figure = report.distribution_figure(
        facts.histogram,
        facts.curves,
        facts.marks,
        xlabel=facts.axis_label,
        ylabel="fraction with a smaller value, F",
        titles=titles,
        log=facts.is_logarithmic,
    )
    formula = "1 − F" if facts.larger_is_better else "F"
    text = f"The probability of meeting a threshold is {formula} at the threshold"
    text += (
        f": {format_interval(facts.probability)} at {format_as_given(facts.threshold)}{facts.unit_suffix}."
        if facts.has_threshold
        else "."
    )
    if d.unreached:
        text += f" The dashed curve excludes the {format_count(d.unreached, 'pose')} for which no configuration was found."
    population = "the reached poses" if d.unreached else f"all {facts.noun}s"
    total = f"the {format_percent(1 - d.infinite / d.reached)} with a finite value" if d.infinite else "1"
    text += f" The density is a histogram of {len(facts.histogram.heights)} bins over {population}; its area is {total}."
    picture = Picture(report.svg(figure, "distribution", "Density and cumulative distribution of the index"), text)
    return [picture, *thresholds.blocks(facts, figure)]
