"""Figures of a comparison of laws."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.convergence.law_comparison import ANY, LawComparison
from holdfast.present.convergence.law_rows import OUTCOMES, error_unit, time_unit
from holdfast.probability.intervals import Difference
from holdfast.report.figures import Curve, compare_cdf_figure
from holdfast.report.outcomes import Gains, Spread, Stack, gain_figure, spread_figure, stack_figure

_COSTS = (
    ("deviation", "off the straight line, m", 1.0),
    ("angle", "largest angle to the command, deg", 180 / np.pi),
    ("time", "until within 1e-3 of the target (of the arm's length, and rad), {unit}", 1.0),
)


def outcome_figure(c: LawComparison) -> Figure:
    """Stacked bars of outcomes, a group per failure and a bar per law."""
    stacks = []
    for failure in c.failures:
        cases = [c.case(name, failure) for name in c.names]
        shares = np.array([[case.ended(o).mean() for o in OUTCOMES] for case in cases])
        ends = [case.share() for case in cases]
        low, high = (np.array([getattr(e, end) if e else np.nan for e in ends]) for end in ("low", "high"))
        stacks.append(
            Stack(name=failure, bars=c.names, shares=shares, low=low, high=high, level=float(cases[0].reachable.mean()))
        )
    return stack_figure(
        stacks, OUTCOMES, f"fraction of {len(c):,} motions, each law and failure", level="targets still within reach"
    )


def gains_figure(c: LawComparison) -> Figure:
    """Paired differences to the first law, by joint."""
    cases = [*c.joints, ANY]

    def of(name: str, differences: list[Difference]) -> Gains:
        value, low, high = (np.array([getattr(d, x) for d in differences]) for x in ("value", "low", "high"))
        return Gains(label=name, value=value, low=low, high=high)

    more = [of(name, [c.gain(name, j) for j in cases]) for name in c.names[1:]]
    nearer = [of(name, [c.change(name, "error", j) for j in cases]) for name in c.names[1:]]
    first = c.names[0]
    return gain_figure(
        cases,
        [
            (f"fraction that converges, minus that with {first}", more),
            (f"mean end error minus that with {first}, {error_unit(c)}", nearer),
        ],
    )


def error_figure(c: LawComparison) -> Figure:
    """Cumulative distributions of the end error, and of what it exceeds the least by, over all joints."""
    panels = []
    every = {of: [c.pooled(name, of).ravel() for name in c.names] for of in ("error", "excess")}
    top = max(float(np.nanmax(v, initial=1e-3)) for values in every.values() for v in values)
    axis = np.geomspace(1e-5, 1.2 * top, 400)
    for of, title in (("error", "Error at the end"), ("excess", "What it exceeds the least by")):
        curves = []
        for name, values in zip(c.names, every[of], strict=True):
            finite = np.sort(values[np.isfinite(values)])
            curves.append(Curve(axis, np.searchsorted(finite, axis, side="right") / max(len(values), 1), name))
        panels.append((title, curves))
    return compare_cdf_figure(panels, [], f"error, {error_unit(c)}", ylabel="fraction of runs with at most that", log=True)


def healthy_figure(c: LawComparison) -> Figure:
    """Quantiles of what each law costs the healthy arm."""
    spreads = []
    for of, label, factor in _COSTS:
        quantiles = factor * np.array([c.cost(name, of) for name in c.names])  # type: ignore[arg-type]
        spreads.append(Spread(label.format(unit=time_unit(c)), quantiles))
    return spread_figure(c.names, spreads)
