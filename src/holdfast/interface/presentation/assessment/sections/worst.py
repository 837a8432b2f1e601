"""Frequency of each worst failure, and the index that remains after each failure."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.formatting import format_as_given, format_number, format_percent
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report import figures
from holdfast.interface.report.page import Block, Picture, Table, Text

_MAX_TABLE_ROWS = 40


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
    if len(labels) > _MAX_TABLE_ROWS // 2:
        chosen = np.argsort(-counts, kind="stable")[: _MAX_TABLE_ROWS // 2]
        remark = f" The {len(chosen)} most frequent of {len(labels)} failures are shown."
    if total:
        figure = figures.bar_figure(
            [labels[failure] for failure in chosen],
            counts[chosen].tolist(),
            f"{'weight of ' if weighted else ''}{facts.noun}s at which this failure is the worst",
            total=total,
        )
        population = f"the weight, {total:,.4g}, of the" if weighted else f"{total:,}"
        text = (
            f"Of {population} {facts.reached_noun} that are not singular; where several failures are equally bad, the "
            f"first counts."
        )
        blocks.append(Picture(figures.svg(figure, "worst", "How often each failure is the worst"), text + remark))
    else:
        blocks.append(Text(f"Every {facts.noun} reached is singular, so no failure is worse than another."))
    blocks.append(_tabulate_failures(facts, labels, counts))
    return blocks


def _tabulate_failures(facts: AssessmentFacts, labels: list[str], counts: NDArray[Any]) -> Block:
    """Build the table of the index after each failure, at the configurations found and at the best ones."""
    if facts.poses is None:
        return Text(
            "The values after each failure were not kept; assess again with a store or with keep=True for them.", quiet=True
        )
    tail_level = 0.05 if facts.larger_is_better else 0.95
    relation = "≥" if facts.larger_is_better else "≤"
    titles = [
        "median",
        f"{100 * tail_level:.0f} % quantile",
        "worst of all",
        *([f"P({relation} {format_as_given(facts.threshold)})"] * facts.has_threshold),
    ]
    chosen = np.arange(len(labels))
    if len(chosen) > _MAX_TABLE_ROWS:
        chosen = np.sort(np.argsort(-counts, kind="stable")[:_MAX_TABLE_ROWS])
    cells: list[list[str]] = [[labels[failure]] for failure in chosen]
    header = ["If this locks"]
    for (_, _, poses), worst_counts in zip(facts.samples, (counts, facts.assessment.optimised_worst_counts), strict=False):
        assert poses is not None
        assert worst_counts is not None
        values = poses.by_failure[poses.reached]
        if not poses.reached.any():  # no configuration of any pose is clear
            for line in cells:
                line += ["–"] * len(titles)
            header += [f"after: {title}" for title in titles]
            continue
        weights = None if poses.weight is None else poses.weight[poses.reached]
        medians, tail_values = np.quantile(values, [0.5, tail_level], axis=0, method="inverted_cdf", weights=weights)
        fraction_met = np.average(
            values >= facts.threshold if facts.larger_is_better else values <= facts.threshold, axis=0, weights=weights
        )
        total = worst_counts.sum() or 1
        for line, failure in zip(cells, chosen, strict=True):
            line += [
                format_number(float(medians[failure])),
                format_number(float(tail_values[failure])),
                format_percent(worst_counts[failure] / total),
            ]
            line += [f"{fraction_met[failure]:.3f}"] * facts.has_threshold
        header += titles if len(header) == 1 else [f"after: {title}" for title in titles]
    caption = f"The {facts.index.name} after each failure, over {int(facts.poses.reached.sum()):,} {facts.reached_noun}"
    caption += (
        ", at the configurations found; after: at the best configurations." if facts.assessment.optimised is not None else "."
    )
    return Table(cells, header, frozenset(range(1, len(header))), caption=caption, wide=True)
