"""Presentation of the trade-off between the error of the healthy arm and the error after an undetected lock."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.laws.trade_offs import QUANTILE_LEVELS, TradeOff
from holdfast.core.formatting import format_percent
from holdfast.interface import report
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec, make_headers
from holdfast.interface.report.palette import ORANGE

_NEGLIGIBLE_GAIN = 0.005  # relative gain that counts as none
_PLATEAU_TOLERANCE = 1e-3  # relative difference in gain that does not justify a larger allowed error
_FIGURE_FIGURE_CAPTION = (
    "Left: peak velocity error after an undetected lock of any joint, divided by that of the pseudoinverse; values below 1 "
    "are a gain. Right: velocity error of the healthy arm. The bands contain 50 % and 90 % of the samples."
)


def to_dict(curve: TradeOff) -> dict[str, Any]:
    """Return quantiles of each measure over the samples for each allowed error, as JSON data."""
    measures: dict[str, Any] = {}
    for name in ("gain", "healthy_error", "peak_error"):
        measures[name] = {
            f"q{round(100 * level):02d}": row for level, row in zip(QUANTILE_LEVELS, curve.quantiles(name), strict=True)
        }
        measures[name]["median_95_percent_interval"] = curve.median_interval(name).T
    return {
        **curve.arm.entry(),
        "task": curve.task.name,
        "characteristic_length_m": curve.task.length,
        "samples": len(curve.gain),
        "seed": curve.seed,
        "pre_failure_error": curve.allowed,
        **measures,
    }


def present(curve: TradeOff) -> Presentation:
    """Present the smaller error after an undetected lock, at the allowed error with half of the largest gain."""
    median_gain, healthy_error = np.median(curve.gain, axis=0), np.median(curve.healthy_error, axis=0)
    lower, upper = curve.median_interval()
    best_index = int((median_gain <= median_gain.min() + _PLATEAU_TOLERANCE).argmax())  # first of a plateau
    largest_gain = 1 - median_gain[best_index]
    if largest_gain < _NEGLIGIBLE_GAIN:
        answer = (
            f"A velocity error of the healthy arm does not reduce the error after an undetected lock: the median peak error "
            f"is that of the pseudoinverse for all allowed errors up to {curve.allowed[-1]:.2g}."
        )
        facts = [Fact("", float(curve.allowed[-1]), phrase="of the commanded speed, the largest allowed error tested")]
    else:
        half_index = int((1 - median_gain >= largest_gain / 2).argmax())
        half_gain = 1 - median_gain[half_index]
        answer = (
            f"If the healthy arm may deviate by {curve.allowed[half_index]:.2g} of the commanded speed, the median peak error "
            f"after an undetected lock is {format_percent(half_gain)} smaller than that of the pseudoinverse. The largest "
            f"reduction found is {format_percent(largest_gain)}, for {curve.allowed[best_index]:.2g}."
        )
        interval_text = f"{format_percent(max(1 - upper[half_index], 0))} to {format_percent(1 - lower[half_index])}, 95 %"
        gain_phrase = f"smaller median peak error for an allowed error of {curve.allowed[half_index]:.2g}; {interval_text}"
        facts = [
            Fact("", half_gain, phrase=gain_phrase, style="percent"),
            Fact("", healthy_error[half_index], phrase="of the speed, median error of the healthy arm", style="percent"),
            Fact("", largest_gain, phrase=f"largest reduction found, for {curve.allowed[best_index]:.2g}", style="percent"),
        ]
    low_quantile, high_quantile = curve.quantiles(levels=(0.05, 0.95))
    labels = ("peak error after a lock (pseudoinverse: 1)", "95 % interval", "5 to 95 % of the samples")
    columns: list[Column] = [Header("allowed error", digits=2), *make_headers(*labels, "error of the healthy arm", digits=3)]
    intervals, ranges = zip(lower, upper, strict=True), zip(low_quantile, high_quantile, strict=True)
    rows = list(zip(curve.allowed, median_gain, intervals, ranges, healthy_error, strict=True))
    return Presentation(
        f"Trade-off of {curve.arm.name} between the errors before and after an undetected lock",
        answer,
        about=f"Task {curve.task.describe()}, {len(curve.gain):,} random configurations and directions",
        facts=facts,
        tables=[TableSpec("Medians over the samples", columns, rows)],
        figures={"trade-off": FigureSpec(partial(_draw_figure, curve), "Trade-off", _FIGURE_FIGURE_CAPTION)},
        method=[
            ("Task", f"{curve.task.describe()}, characteristic length {curve.task.length:g} m"),
            ("Samples", f"{len(curve.gain):,} configurations within the limits and directions, seed {curve.seed}"),
            ("Intervals", "95 %, of medians, from order statistics"),
            ("Source", "Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9)"),
        ],
        arm=curve.arm,
    )


def _draw_figure(curve: TradeOff) -> report.Figure:
    """Draw the median and quantile bands of the error after a failure and of the error of the healthy arm."""
    with report.styled_figure(report.WIDTH_IN, 3.9) as figure:
        gain, cost = figure.subplots(1, 2)
        title_prefix = report.format_label(f"{curve.arm.name}, {curve.task.name}", 30)
        measures = zip(
            (gain, cost),
            ("gain", "healthy_error"),
            ("peak velocity error after a failure,\nrelative to the pseudoinverse", "velocity error of the healthy arm"),
            (f"{title_prefix}: after a lock", f"Healthy arm, {len(curve.gain):,} samples"),
            strict=True,
        )
        for axes, measure_name, ylabel, title in measures:
            report.draw_quantile_bands(axes, curve.allowed, curve.quantiles(measure_name))
            axes.set(xlabel="allowed pre-failure error (of the commanded speed)", ylabel=ylabel, xlim=(0, curve.allowed[-1]))
            axes.set_ylim(0, 1.02)
            axes.set_title(title)
        cost.plot(curve.allowed, curve.allowed, color=ORANGE, linestyle=(0, (4.5, 2)), label="allowed error")
        report.legend_below(figure, cost, 4)
    return figure
