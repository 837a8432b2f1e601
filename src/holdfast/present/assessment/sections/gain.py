"""What choosing configurations well gains: the distribution before and after, and pose by pose."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.present.assessment.facts import Facts
from holdfast.probability.distribution import Distribution
from holdfast.report import figures
from holdfast.report.figures import Curve
from holdfast.report.page import Block, Picture, Table, Text
from holdfast.words import as_given, counted, half_width, interval, number

TITLE = "What choosing configurations gains"
_MOST_DOTS = 20_000


def blocks(f: Facts) -> list[Block]:
    """Before and after, if the run was optimised; Abdi et al. 2012, Figs. 5 to 7."""
    best = f.a.optimised
    if best is None or not best.reached:
        return []
    blocks: list[Block] = [
        Text(
            f"After: for each pose the best configuration found that keeps the pose{_kept(f)}. "
            "Found by a local search from several starts: a lower bound of what is possible."
        ),
        _table(f, best),
    ]
    if f.drawable:
        figure = gain_figure(f, best)
        blocks.append(
            Picture(
                figures.svg(figure, "gain", "Distribution of the index before and after choosing configurations"),
                f"{f.d.samples:,} poses. Right: the {f.d.reached:,} reached poses in the order of the index before; "
                "what a pose gains is the height of its dot above the line." + _lost(f),
            )
        )
    return blocks


def _kept(f: Facts) -> str:
    """What the best configurations keep besides the pose."""
    clearance, margin = f.a.plan.clearance, f.a.plan.margin
    if clearance is None:
        return " and the joint limits, even where the arm collides with itself"
    apart = f"a clearance of {margin:g} m" if margin else f"the arm clear of {f.everything}"
    return f", the joint limits and {apart} ({clearance.capsules.describe(f.a.arm)})"


def _lost(f: Facts) -> str:
    hopeless = f.a.collisions.hopeless if f.a.collisions is not None else 0
    others = "the arm itself" if f.others == "itself" else f.everything
    return f" {counted(hopeless, 'pose')} without a configuration clear of {others} have no dot." if hopeless else ""


def _table(f: Facts, best: Distribution) -> Table:
    steps = (0.05, 0.25, 0.5, 0.75, 0.95)
    ask = {"at_least" if f.larger else "at_most": f.threshold}
    rows = []
    for name, d, optimised in (("before", f.d, False), ("after", best, True)):
        chance = f.a.interval(optimised=optimised, **ask)  # type: ignore[arg-type]
        top = d.highest if f.larger else d.lowest
        name += f", {d.reached:,} poses" if best.reached < f.d.reached else ""
        rows.append([name, *[number(float(x)) for x in d.quantile(steps)], number(d.mean), number(top), interval(chance)])
    sign = "≥" if f.larger else "≤"
    head = [
        "Index over reached poses", "5 %", "25 %", "median", "75 %", "95 %", "mean", "best",
        f"P({sign} {as_given(f.threshold)}), all poses",
    ]  # fmt: skip
    return Table(rows, head, frozenset(range(1, 9)), wide=True)


def gain_figure(f: Facts, best: Distribution) -> Figure:
    """Left: the two cumulative distributions. Right: both values of each pose, sorted by the first (Figs. 6 and 7)."""
    curves = gain_curves(f, best)
    axis = curves[0].x
    with figures.style():
        figure = Figure(figsize=(figures.WIDTH, 3.9))
        left, right = figure.subplots(1, 2)
        shown = [mark for mark in f.marks if mark.x <= axis[-1]]
        figures.draw_cdf(left, curves, shown, xlabel=f.axis_label, ylabel="fraction with a smaller value, F", log=f.log)
        left.set_title(f"Cumulative (CDF), {f.d.samples:,} poses")
        rows = f.rows
        if rows is None:
            right.set_axis_off()
        else:
            before = rows.value[rows.reached]
            after = f.a.columns["optimised_index"][:][: len(rows.reached)][rows.reached]
            order = np.argsort(before)
            some = order if len(order) <= _MOST_DOTS else order[:: -(-len(order) // _MOST_DOTS)]
            rank = np.searchsorted(np.sort(before), before[some]) + 1
            right.plot(rank, after[some], ".", color=figures.BLUE, markersize=2.2, rasterized=True)
            right.plot(rank, before[some], color=figures.ORANGE, linewidth=1.6)
            right.set(xlabel="reached poses, sorted by the index before", ylabel=f.axis_label, ylim=(0, None))
            if f.log:
                right.set(yscale="log", ylim=(None, None))
            right.set_title("Each pose before (line) and after (dots)")
        figures.legend_below(figure, left)
        return figures.finished(figure)


def gain_curves(f: Facts, best: Distribution) -> list[Curve]:
    """The distributions after and before choosing configurations over one axis, each with its 95 % band."""
    ends = [x for d in (f.d, best) for x in (d.lowest, d.highest) if np.isfinite(x)]
    low = min(0.0, *ends) if not f.log else min(ends)
    axis = (np.geomspace if f.log else np.linspace)(low, max(ends) * 1.02, 400)
    samples = ((best, "after: the best configurations", False), (f.d, "before: as inverse kinematics found them", True))
    return [
        Curve(axis, d.cdf(axis), f"{label}, 95 % band {half_width(d.band())}", second=second, band=d.band())
        for d, label, second in samples
    ]


def cdf_figure(f: Facts) -> Figure:
    """The cumulative distribution with its 95 % band; before and after choosing configurations if the run was optimised."""
    best = f.a.optimised
    curves = f.curves if best is None or not best.reached else gain_curves(f, best)
    with figures.style():
        figure = Figure(figsize=(7.2, 4.8))
        axes = figure.subplots()
        shown = [mark for mark in f.marks if mark.x <= curves[0].x[-1]]
        figures.draw_cdf(axes, curves, shown, xlabel=f.axis_label, ylabel="fraction with a smaller value, F", log=f.log)
        lost = f", {f.d.unreached:,} of them not reached" if f.d.unreached else ""
        axes.set_title(f"{figures.plain(f.a.arm.name, 30)}: {f.d.samples:,} {f.noun}s{lost}")
        figures.legend_below(figure, axes, 1)
        return figures.finished(figure)
