"""The figure of a trade-off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from holdfast.report import figures

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from holdfast.control.trade_offs import TradeOff


def figure(t: TradeOff) -> Figure:
    """See :meth:`holdfast.control.TradeOff.figure`."""
    with figures.style():
        drawn = Figure(figsize=(figures.WIDTH, 3.9))
        gain, price = drawn.subplots(1, 2)
        draw(t, gain, price)
        figures.legend_below(drawn, price, 4)
        return figures.finished(drawn)


def draw(t: TradeOff, gain: Axes, price: Axes) -> None:
    """See :meth:`holdfast.control.TradeOff.draw`."""
    named = figures.plain(f"{t.arm.name}, {t.task.name}", 30)
    panels = zip(
        (gain, price),
        ("gain", "healthy_error"),
        ("peak velocity error after a failure,\nrelative to the pseudoinverse", "velocity error of the healthy arm"),
        (f"{named}: what the failed arm gains", f"What the healthy arm pays, {len(t.gain):,} samples"),
        strict=True,
    )
    for axes, of, ylabel, title in panels:
        q05, q25, q50, q75, q95 = t.quantiles(of)
        axes.fill_between(t.allowed, q05, q95, color=figures.SKY, alpha=0.4, linewidth=0, label="5 to 95 %")
        axes.fill_between(t.allowed, q25, q75, color=figures.SKY, linewidth=0, label="25 to 75 %")
        axes.plot(t.allowed, q50, color=figures.BLUE, linewidth=1.9, label="median")
        axes.set(xlabel="allowed pre-failure error (of the commanded speed)", ylabel=ylabel, xlim=(0, t.allowed[-1]))
        axes.set_ylim(0, 1.02)
        axes.set_title(title)
    price.plot(t.allowed, t.allowed, color=figures.ORANGE, linestyle=(0, (4.5, 2)), label="all that is allowed")
