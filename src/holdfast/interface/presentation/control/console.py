"""Text, tables, and JSON of a trade-off."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.laws.trade_offs import QUANTILE_LEVELS, TradeOff
from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from rich.console import Console

_NEGLIGIBLE_GAIN = 0.005  # less than this gain is none
_PLATEAU_TOLERANCE = 1e-3  # differences that nobody would pay for


def to_dict(curve: TradeOff) -> dict[str, Any]:
    """Return quantiles of each measure over the samples, against the allowed errors."""
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


def key_table(curve: TradeOff) -> TextTable:
    """Tabulate medians over the samples, one row for each allowed error."""
    columns = (curve.allowed, np.median(curve.gain, axis=0), np.median(curve.healthy_error, axis=0))
    rows = [
        [f"{allowed:.2f}", f"{gain:.3f}", f"{healthy_error:.3f}"] for allowed, gain, healthy_error in zip(*columns, strict=True)
    ]
    return TextTable(["allowed error", "peak error after a lock, by the pseudoinverse's", "error of the healthy arm"], rows)


def story(curve: TradeOff) -> PageContent:
    """Compose the report: the gain after an unnoticed lock for an error of the healthy arm, at half of the largest gain."""
    median_gain, healthy_error = np.median(curve.gain, axis=0), np.median(curve.healthy_error, axis=0)
    lower, upper = curve.median_interval()
    best_index = int((median_gain <= median_gain.min() + _PLATEAU_TOLERANCE).argmax())  # of a plateau the first
    largest_gain = 1 - median_gain[best_index]
    if largest_gain < _NEGLIGIBLE_GAIN:
        answer = (
            f"No velocity error of the healthy arm gains anything after an unnoticed lock: the "
            f"median peak error stays that of the pseudoinverse, up to an allowed error of {curve.allowed[-1]:.2g}."
        )
        facts = [(f"{curve.allowed[-1]:.2g}", "largest error that was allowed, of the commanded speed")]
    else:
        half_index = int((1 - median_gain >= largest_gain / 2).argmax())
        answer = (
            f"An error of {curve.allowed[half_index]:.2g} of the commanded speed, allowed while the arm "
            f"is healthy, takes {format_percent(1 - median_gain[half_index])} off the median peak error after an unnoticed "
            f"lock; the most that was found is {format_percent(largest_gain)}, for {curve.allowed[best_index]:.2g}."
        )
        interval_text = f"{format_percent(max(1 - upper[half_index], 0))} to {format_percent(1 - lower[half_index])}, 95 %"
        facts = [
            (
                format_percent(1 - median_gain[half_index]),
                f"less peak error for an allowed error of {curve.allowed[half_index]:.2g}, median; {interval_text}",
            ),
            (format_percent(healthy_error[half_index]), "of the speed is what the healthy arm then pays, median"),
            (format_percent(largest_gain), f"less, the most there is, for {curve.allowed[best_index]:.2g}"),
        ]
    return PageContent(
        f"What {curve.arm.name} gains from an error before a failure",
        answer,
        about=f"Task {curve.task.describe()}, {len(curve.gain):,} random configurations and directions",
        facts=facts,
        figures={
            "trade-off": (
                "Gain and price",
                (
                    "Left: the peak velocity error after an unnoticed lock of any joint, by that of the "
                    "pseudoinverse; below 1 the failed arm gains. Right: the velocity error of the "
                    "healthy arm. Bands hold half, and nine tenths, of the samples."
                ),
            )
        },
        tables=[key_table(curve)._replace(title="Medians over the samples")],
        method=[
            ("Task", f"{curve.task.describe()}, characteristic length {curve.task.length:g} m"),
            ("Samples", f"{len(curve.gain):,} configurations within the limits and directions, seed {curve.seed}"),
            ("Intervals", "95 %, of medians, from order statistics"),
            ("Source", "Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9)"),
        ],
        arm=curve.arm,
    )


def next_steps(curve: TradeOff, name: str) -> list[str]:
    """Suggest the control law that uses such an error."""
    allowed = float(curve.allowed[len(curve.allowed) // 2])
    return [f"law = hf.control.failure_tolerant({name}.arm, {name}.task, {allowed:.2g})  # spends that much"]


def show(curve: TradeOff, out: Console) -> None:
    """Print a row for each allowed error."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    out.print(
        f"Arm {escape(curve.arm.title)}, task {escape(curve.task.describe())}: {len(curve.gain)} random configurations and "
        "directions",
        soft_wrap=True,
    )
    out.print(
        "Peak velocity error after an unnoticed lock, by that of the pseudoinverse; and what it costs the healthy arm.",
        soft_wrap=True,
    )
    columns = ("allowed", "peak: median (95%)", "5 to 95 % of samples", "healthy: median")
    table = BandedTable(*columns)
    (lower, upper), (low_quantile, middle, high_quantile) = curve.median_interval(), curve.quantiles(levels=(0.05, 0.5, 0.95))
    healthy_error = np.median(curve.healthy_error, axis=0)
    for index, allowed in enumerate(curve.allowed):
        table.add_row(
            f"{allowed:.2f}",
            f"[bold]{middle[index]:.3f}[/] ({lower[index]:.3f} to {upper[index]:.3f})",
            f"{low_quantile[index]:.3f} to {high_quantile[index]:.3f}",
            f"{healthy_error[index]:.3f}",
        )
    out.print(table)
