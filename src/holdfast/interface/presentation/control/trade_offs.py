"""Figure of a trade-off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from holdfast.control.laws.trade_offs import TradeOff
from holdfast.interface.report.figures import BLUE, ORANGE, SKY, WIDTH_IN, format_label, legend_below, settle_layout, style

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes


def figures(curve: TradeOff, into: Iterable[Axes] | None = None) -> dict[str, Figure]:
    """Draw the median and quantile bands of the gain after a failure and of its cost; into two existing axes, if given."""
    if into is not None:
        _draw_panels(curve, *into)
        return {}
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        gain, cost = figure.subplots(1, 2)
        _draw_panels(curve, gain, cost)
        legend_below(figure, cost, 4)
        return {"trade-off": settle_layout(figure)}


def _draw_panels(curve: TradeOff, gain: Axes, cost: Axes) -> None:
    title_prefix = format_label(f"{curve.arm.name}, {curve.task.name}", 30)
    panels = zip(
        (gain, cost),
        ("gain", "healthy_error"),
        ("peak velocity error after a failure,\nrelative to the pseudoinverse", "velocity error of the healthy arm"),
        (f"{title_prefix}: what the failed arm gains", f"What the healthy arm pays, {len(curve.gain):,} samples"),
        strict=True,
    )
    for axes, measure_name, ylabel, title in panels:
        q05, q25, q50, q75, q95 = curve.quantiles(measure_name)
        axes.fill_between(curve.allowed, q05, q95, color=SKY, alpha=0.4, linewidth=0, label="5 to 95 %")
        axes.fill_between(curve.allowed, q25, q75, color=SKY, linewidth=0, label="25 to 75 %")
        axes.plot(curve.allowed, q50, color=BLUE, linewidth=1.9, label="median")
        axes.set(xlabel="allowed pre-failure error (of the commanded speed)", ylabel=ylabel, xlim=(0, curve.allowed[-1]))
        axes.set_ylim(0, 1.02)
        axes.set_title(title)
    cost.plot(curve.allowed, curve.allowed, color=ORANGE, linestyle=(0, (4.5, 2)), label="all that is allowed")
