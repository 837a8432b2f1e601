"""The figure of a trade-off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from holdfast.control.trade_offs import TradeOff
from holdfast.report.figures import BLUE, ORANGE, SKY, WIDTH, finished, legend_below, plain, style

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes


def figures(t: TradeOff, into: Iterable[Axes] | None = None) -> dict[str, Figure]:
    """Median and quantile bands of the gain after a failure, and of what it costs; into two axes that are there, if given."""
    if into is not None:
        _draw(t, *into)
        return {}
    with style():
        drawn = Figure(figsize=(WIDTH, 3.9))
        gain, price = drawn.subplots(1, 2)
        _draw(t, gain, price)
        legend_below(drawn, price, 4)
        return {"trade-off": finished(drawn)}


def _draw(t: TradeOff, gain: Axes, price: Axes) -> None:
    named = plain(f"{t.arm.name}, {t.task.name}", 30)
    panels = zip(
        (gain, price),
        ("gain", "healthy_error"),
        ("peak velocity error after a failure,\nrelative to the pseudoinverse", "velocity error of the healthy arm"),
        (f"{named}: what the failed arm gains", f"What the healthy arm pays, {len(t.gain):,} samples"),
        strict=True,
    )
    for axes, of, ylabel, title in panels:
        q05, q25, q50, q75, q95 = t.quantiles(of)
        axes.fill_between(t.allowed, q05, q95, color=SKY, alpha=0.4, linewidth=0, label="5 to 95 %")
        axes.fill_between(t.allowed, q25, q75, color=SKY, linewidth=0, label="25 to 75 %")
        axes.plot(t.allowed, q50, color=BLUE, linewidth=1.9, label="median")
        axes.set(xlabel="allowed pre-failure error (of the commanded speed)", ylabel=ylabel, xlim=(0, t.allowed[-1]))
        axes.set_ylim(0, 1.02)
        axes.set_title(title)
    price.plot(t.allowed, t.allowed, color=ORANGE, linestyle=(0, (4.5, 2)), label="all that is allowed")
