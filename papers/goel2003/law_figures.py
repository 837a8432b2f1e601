"""Figures of section II; the paper has none of them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import (
    BLUE,
    ORANGE,
    SOFT,
    WIDTH_IN,
    draw_quantile_bands,
    legend_below,
    save_png,
    settle_layout,
    style,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from papers.goel2003.peak_error import TwoMinima


def two_minima(found: TwoMinima, path: Path) -> None:
    """PKE over the damping, for the counterexample."""
    largest = float(found.error.largest[0])
    damping = np.geomspace(1e-4, largest, 1500)
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.62, 4.4))
        axes = figure.subplots()
        axes.semilogx(damping, found.error(damping[None])[0], color=BLUE, label="peak velocity error")
        none = float(found.error(np.zeros(1))[0])
        axes.axhline(none, color=SOFT, linestyle=(0, (1.2, 1.6)), label="pseudoinverse (no damping)")
        axes.plot(*found.law, "o", color=BLUE, markersize=8, label=f"failure-tolerant inverse, {found.law[1]:.4f}")
        axes.plot(*found.golden, "s", color=ORANGE, markersize=7, label=f"golden section, {found.golden[1]:.4f}")
        axes.set(xlabel="damping, unit of the singular values (1 m)", ylabel="peak velocity error, of the commanded speed")
        axes.set_title("7R arm, pose: two minima")
        axes.set_xlim(1e-4, largest)
        legend_below(figure, axes, 2)
        save_png(settle_layout(figure), path, dpi=110)


def draw_quantiles(axes: Axes, curve: hf.control.TradeOff, measure: str, label: str) -> None:
    """Draw the median of a measure and its quantile bands against the allowed error."""
    draw_quantile_bands(axes, curve.allowed, curve.quantiles(measure))
    axes.set(
        xlabel="allowed pre-failure error (of the commanded speed)", ylabel=label, xlim=(0, curve.allowed[-1]), ylim=(0, 1.02)
    )


def trade_off(curves: Sequence[hf.control.TradeOff], path: Path) -> None:
    """Post-failure gain and pre-failure price against the allowed error, an arm per row."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 7.6))
        for row, curve in zip(figure.subplots(len(curves), 2), curves, strict=True):
            draw_quantiles(row[0], curve, "gain", "peak velocity error after a failure,\nrelative to the pseudoinverse")
            draw_quantiles(row[1], curve, "healthy_error", "velocity error of the healthy arm")
            row[1].plot(curve.allowed, curve.allowed, color=ORANGE, linestyle=(0, (4.5, 2)), label="largest allowed error")
            row[0].set_title(f"{curve.arm.name}, {curve.task.name}: failed arm")
            row[1].set_title(f"Healthy arm, {len(curve.gain):,} samples")
            for axes in row:
                axes.axvline(0.5, color=SOFT, linestyle=(0, (1.2, 1.6)), label="the paper's choice")
        legend_below(figure, row[1], 5)
        save_png(settle_layout(figure), path, dpi=110)
