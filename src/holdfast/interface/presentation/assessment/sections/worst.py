"""Frequency with which each failure is the worst one, and the index after each failure."""

from __future__ import annotations

import numpy as np

from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.tables import tabulate_failures
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.report.page import Block, Picture, Text

_MAX_BARS = 20


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the figure of how often each failure is the worst one, and the table of the index after each failure."""
    labels, counts = facts.failure_labels, facts.assessment.worst_counts
    if not facts.distribution.reached:
        return []
    blocks: list[Block] = []
    weighted = facts.distribution.has_weights
    total = float(counts.sum()) if weighted else int(counts.sum())
    chosen = np.arange(len(labels))
    remark = ""
    if len(labels) > _MAX_BARS:
        chosen = np.argsort(-counts, kind="stable")[:_MAX_BARS]
        remark = f" The {len(chosen)} most frequent of {len(labels)} failures are shown."
    if total:
        figure = report.bar_figure(
            [labels[failure] for failure in chosen],
            counts[chosen].tolist(),
            f"{'weight of ' if weighted else ''}{facts.noun}s at which this failure is the worst",
            total=total,
        )
        population = f"the weight, {total:,.4g}, of the" if weighted else f"{total:,}"
        text = (
            f"Over {population} {facts.reached_noun} that are not singular. If several failures are equally bad, the first "
            f"one counts."
        )
        blocks.append(Picture(report.svg(figure, "worst", "How often each failure is the worst"), text + remark))
    else:
        blocks.append(Text(f"Every {facts.noun} reached is singular, so all failures are equally bad."))
    table = tabulate_failures(facts)
    blocks += [] if table is None else [build_table_block(table.texts())]
    if facts.poses is None:
        blocks.append(
            Text("The values after each failure were not stored; assess again with a store or with keep=True.", quiet=True)
        )
    return blocks
