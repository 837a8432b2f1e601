"""A trade-off in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.trade_offs import QUANTILES, TradeOff
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import percent

if TYPE_CHECKING:
    from rich.console import Console

_NOTHING, _LEVEL = 0.005, 1e-3  # less than this gain is none; differences that nobody would pay for


def to_dict(curve: TradeOff) -> dict[str, Any]:
    """Quantiles of each measure over the samples, against the allowed errors."""
    told: dict[str, Any] = {}
    for name in ("gain", "healthy_error", "peak_error"):
        told[name] = {f"q{round(100 * x):02d}": row for x, row in zip(QUANTILES, curve.quantiles(name), strict=True)}
        told[name]["median_95_percent_interval"] = curve.median_interval(name).T
    return {
        **curve.arm.entry(),
        "task": curve.task.name,
        "characteristic_length_m": curve.task.length,
        "samples": len(curve.gain),
        "seed": curve.seed,
        "pre_failure_error": curve.allowed,
        **told,
    }


def key_table(curve: TradeOff) -> Rows:
    """A row for each allowed error, medians over the samples."""
    columns = (curve.allowed, np.median(curve.gain, axis=0), np.median(curve.healthy_error, axis=0))
    rows = [[f"{e:.2f}", f"{gain:.3f}", f"{paid:.3f}"] for e, gain, paid in zip(*columns, strict=True)]
    return Rows(["allowed error", "peak error after a lock, by the pseudoinverse's", "error of the healthy arm"], rows)


def story(curve: TradeOff) -> Story:
    """What an error of the healthy arm gains after an unnoticed lock, where half of it is gained."""
    middle, paid = np.median(curve.gain, axis=0), np.median(curve.healthy_error, axis=0)
    low, high = curve.median_interval()
    best = int((middle <= middle.min() + _LEVEL).argmax())  # of a plateau the first
    gained = 1 - middle[best]
    if gained < _NOTHING:
        answer = (
            f"No velocity error of the healthy arm gains anything after an unnoticed lock: the "
            f"median peak error stays that of the pseudoinverse, up to an allowed error of {curve.allowed[-1]:.2g}."
        )
        facts = [(f"{curve.allowed[-1]:.2g}", "largest error that was allowed, of the commanded speed")]
    else:
        k = int((1 - middle >= gained / 2).argmax())
        answer = (
            f"An error of {curve.allowed[k]:.2g} of the commanded speed, allowed while the arm "
            f"is healthy, takes {percent(1 - middle[k])} off the median peak error after an unnoticed "
            f"lock; the most that was found is {percent(gained)}, for {curve.allowed[best]:.2g}."
        )
        sure = f"{percent(max(1 - high[k], 0))} to {percent(1 - low[k])}, 95 %"
        facts = [
            (percent(1 - middle[k]), f"less peak error for an allowed error of {curve.allowed[k]:.2g}, median; {sure}"),
            (percent(paid[k]), "of the speed is what the healthy arm then pays, median"),
            (percent(gained), f"less, the most there is, for {curve.allowed[best]:.2g}"),
        ]
    return Story(
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
    """The law that spends such an error."""
    allowed = float(curve.allowed[len(curve.allowed) // 2])
    return [f"law = hf.control.failure_tolerant({name}.arm, {name}.task, {allowed:.2g})  # spends that much"]


def show(curve: TradeOff, out: Console) -> None:
    """A row for each allowed error."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

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
    table = Grid(*columns)
    (low, high), (q05, middle, q95) = curve.median_interval(), curve.quantiles(levels=(0.05, 0.5, 0.95))
    paid = np.median(curve.healthy_error, axis=0)
    for k, e in enumerate(curve.allowed):
        table.add_row(
            f"{e:.2f}",
            f"[bold]{middle[k]:.3f}[/] ({low[k]:.3f} to {high[k]:.3f})",
            f"{q05[k]:.3f} to {q95[k]:.3f}",
            f"{paid[k]:.3f}",
        )
    out.print(table)
