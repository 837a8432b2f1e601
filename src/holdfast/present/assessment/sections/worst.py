"""Which failure is the worst, how often, and what it leaves."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.present.assessment.facts import Facts
from holdfast.report import figures
from holdfast.report.page import Block, Picture, Table, Text
from holdfast.words import as_given, number, percent

TITLE = "Which failure is the worst"
_MOST_ROWS = 40


def blocks(f: Facts) -> list[Block]:
    """Which failure is the worst, how often."""
    names, counts = f.failure_labels, f.a.worst_counts
    if not f.d.reached:
        return []
    blocks: list[Block] = []
    weighted = f.d.weighted
    total = float(counts.sum()) if weighted else int(counts.sum())
    chosen = np.arange(len(names))
    note = ""
    if len(names) > _MOST_ROWS // 2:
        chosen = np.argsort(-counts, kind="stable")[: _MOST_ROWS // 2]
        note = f" The {len(chosen)} most frequent of {len(names)} failures are shown."
    if total:
        figure = figures.bar_figure(
            [names[k] for k in chosen],
            counts[chosen].tolist(),
            f"{'weight of ' if weighted else ''}{f.noun}s at which this failure is the worst",
            total=total,
        )
        whole = f"the weight, {total:,.4g}, of the" if weighted else f"{total:,}"
        text = f"Of {whole} {f.reached} that are not singular; where several failures are equally bad, the first counts."
        blocks.append(Picture(figures.svg(figure, "worst", "How often each failure is the worst"), text + note))
    else:
        blocks.append(Text(f"Every {f.noun} reached is singular, so no failure is worse than another."))
    blocks.append(_failure_table(f, names, counts))
    return blocks


def _failure_table(f: Facts, names: list[str], counts: NDArray[Any]) -> Block:
    """Of each failure, side by side for the configurations found and for the best ones."""
    if f.rows is None:
        return Text(
            "The values after each failure were not kept; assess again with a store or with keep=True for them.", quiet=True
        )
    bad = 0.05 if f.larger else 0.95
    sign = "≥" if f.larger else "≤"
    titles = ["median", f"{100 * bad:.0f} % quantile", "worst of all", *([f"P({sign} {as_given(f.threshold)})"] * f.decided)]
    chosen = np.arange(len(names))
    if len(chosen) > _MOST_ROWS:
        chosen = np.sort(np.argsort(-counts, kind="stable")[:_MOST_ROWS])
    cells: list[list[str]] = [[names[k]] for k in chosen]
    head = ["If this locks"]
    for (_, _, rows), worst in zip(f.samples, (counts, f.a.optimised_worst_counts), strict=False):
        assert rows is not None
        assert worst is not None
        values = rows.by_failure[rows.reached]
        if not rows.reached.any():  # no configuration of any pose is clear
            for row in cells:
                row += ["–"] * len(titles)
            head += [f"after: {t}" for t in titles]
            continue
        weight = None if rows.weight is None else rows.weight[rows.reached]
        middle, low = np.quantile(values, [0.5, bad], axis=0, method="inverted_cdf", weights=weight)
        met = np.average(values >= f.threshold if f.larger else values <= f.threshold, axis=0, weights=weight)
        total = worst.sum() or 1
        for row, k in zip(cells, chosen, strict=True):
            row += [number(float(middle[k])), number(float(low[k])), percent(worst[k] / total)]
            row += [f"{met[k]:.3f}"] * f.decided
        head += titles if len(head) == 1 else [f"after: {t}" for t in titles]
    caption = f"The {f.index.name} after each failure, over {int(f.rows.reached.sum()):,} {f.reached}"
    caption += ", at the configurations found; after: at the best configurations." if f.a.optimised is not None else "."
    return Table(cells, head, frozenset(range(1, len(head))), caption=caption, wide=True)
