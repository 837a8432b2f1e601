"""A trade-off in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.trade_offs import QUANTILES, TradeOff
from holdfast.present.printing import Rows

if TYPE_CHECKING:
    from rich.console import Console


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
