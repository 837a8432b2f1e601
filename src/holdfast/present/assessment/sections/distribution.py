"""How the index is distributed."""

from __future__ import annotations

from holdfast.present.assessment import thresholds
from holdfast.present.assessment.facts import Facts
from holdfast.report import figures
from holdfast.report.page import Block, Picture, Text
from holdfast.words import as_given, counted, interval, percent

TITLE = "How the index is distributed"


def blocks(f: Facts) -> list[Block]:
    """Density and cumulative distribution."""
    d = f.d
    if not f.drawable:
        return [Text(f"The index is infinite at each of the {counted(d.reached, f.noun)} reached.")] if d.reached else []
    titles = (
        f"Density (PDF), {d.reached:,} {'reached ' if d.unreached else ''}{f.noun}s",
        f"Cumulative (CDF), {d.samples:,} {f.noun}s",
    )
    figure = figures.distribution_figure(
        f.histogram, f.curves, f.marks, xlabel=f.axis_label, ylabel="fraction with a smaller value, F", titles=titles, log=f.log
    )
    meets = "1 − F" if f.larger else "F"
    text = f"The probability of meeting a threshold is {meets} there"
    text += f": {interval(f.answer)} at {as_given(f.threshold)}{f.unit}." if f.decided else "."
    if d.unreached:
        text += f" The dashed curve leaves out the {counted(d.unreached, 'pose')} for which no configuration was found."
    over = "the reached poses" if d.unreached else f"all {f.noun}s"
    total = f"the {percent(1 - d.infinite / d.reached)} with a finite value" if d.infinite else "1"
    text += f" The density is a histogram of {len(f.histogram.heights)} bins over {over} and adds up to {total}."
    picture = Picture(figures.svg(figure, "distribution", "Density and cumulative distribution of the index"), text)
    return [picture, *thresholds.blocks(f, figure)]
