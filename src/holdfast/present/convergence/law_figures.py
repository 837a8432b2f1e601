"""Figures of a comparison of laws."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.convergence.law_comparison import ANY, LawComparison
from holdfast.present.convergence.law_rows import OUTCOMES, time_unit
from holdfast.probability.intervals import Difference
from holdfast.report.figures import Curve, compare_cdf_figure
from holdfast.report.outcomes import Gains, Spread, Stack, gain_figure, spread_figure, stack_figure
from holdfast.simulation.errors import error_kinds
from holdfast.words import capitalised

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

    def of(name: str, differences: list[Difference], factor: float = 1.0) -> Gains:
        value, low, high = (factor * np.array([getattr(d, x) for d in differences]) for x in ("value", "low", "high"))
        return Gains(label=name, value=value, low=low, high=high)

    more = [of(name, [c.gain(name, j) for j in cases]) for name in c.names[1:]]
    nearer = [
        (
            f"{kind.name.partition('_')[0]} error, {kind.unit}",
            [of(name, [c.change(name, kind.name, j) for j in cases], kind.factor) for name in c.names[1:]],
        )
        for kind in error_kinds(c.laws[0])
    ]
    return gain_figure(
        cases,
        [("fraction that converges", more), *nearer],
    )


def error_figure(c: LawComparison) -> Figure:
    """Cumulative distributions of the errors at the end, in mm and degrees, over all joints; in one unit also their excess."""
    kinds = error_kinds(c.laws[0])
    shown: list[tuple[str, str, float]] = [
        (kind.name, f"{capitalised(kind.text)} at the end, {kind.unit}", kind.factor) for kind in kinds
    ]
    if len(kinds) == 1:
        shown.append(("excess", f"Error above the least possible, {kinds[0].unit}", kinds[0].factor))
    panels = []
    for of, title, factor in shown:
        every = [factor * c.pooled(name, of).ravel() for name in c.names]
        axis = np.geomspace(1e-5 * factor, 1.2 * max(float(np.nanmax(v, initial=1e-3 * factor)) for v in every), 400)
        curves = []
        for name, values in zip(c.names, every, strict=True):
            finite = np.sort(values[np.isfinite(values)])
            curves.append(Curve(axis, np.searchsorted(finite, axis, side="right") / max(len(values), 1), name))
        panels.append((title, curves))
    unit = " or ".join(kind.unit for kind in kinds)
    return compare_cdf_figure(panels, [], f"error, {unit}", ylabel="fraction of runs with at most that", log=True)


def healthy_figure(c: LawComparison) -> Figure:
    """Quantiles of what each law costs the healthy arm."""
    spreads = []
    for of, label, factor in _COSTS:
        quantiles = factor * np.array([c.cost(name, of) for name in c.names])  # type: ignore[arg-type]
        spreads.append(Spread(label.format(unit=time_unit(c)), quantiles))
    return spread_figure(c.names, spreads)
