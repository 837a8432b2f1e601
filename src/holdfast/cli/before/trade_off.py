"""``holdfast trade-off``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TaskOption,
    TipOption,
    read_arm,
    read_numbers,
    read_task,
)
from holdfast.present.printing import console, print_json

if TYPE_CHECKING:
    from holdfast.control.trade_offs import TradeOff

ALLOWED = "0 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9"


def command(
    arm: ArmArgument,
    task: TaskOption = None,
    samples: Annotated[int, typer.Option("--samples", help="Random configurations and directions.")] = 2000,
    allowed: Annotated[str, typer.Option("--allowed", help="Pre-failure errors, from 0 to below 1, increasing.")] = ALLOWED,
    seed: Annotated[int, typer.Option("--seed", help="Of the samples.", min=0)] = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the curves into this PNG file.", show_default=False)] = None,
    json_: JsonOption = False,
) -> None:
    """What a velocity error of the healthy arm buys after a lock that nobody notices: which pre-failure error to choose.

    Example: holdfast trade-off panda --task position --samples 2000 --plot trade-off.png
    """
    from holdfast.control.trade_offs import trade_off as run

    model = read_arm(arm, base, tip, hold)
    errors = read_numbers("--allowed", allowed, "numbers from 0 to below 1")
    curve = run(model, read_task(task, arm, model), samples, errors, seed)
    if plot is not None:
        from holdfast.report.figures import save_png

        save_png(curve.figure(), plot)
    if json_:
        print_json(_data(curve, seed))
    else:
        _print(curve, plot)


def _data(curve: TradeOff, seed: int) -> dict[str, Any]:
    from holdfast.control.trade_offs import QUANTILES

    told: dict[str, Any] = {}
    for name in ("gain", "healthy_error", "peak_error"):
        quantiles, interval = curve.quantiles(name), curve.median_interval(name)
        told[name] = {f"q{round(100 * level):02d}": row.tolist() for level, row in zip(QUANTILES, quantiles, strict=True)}
        told[name]["median_95_percent_interval"] = interval.T.tolist()
    return {
        **curve.arm.entry(),
        "task": curve.task.name,
        "characteristic_length_m": curve.task.length,
        "samples": len(curve.gain),
        "seed": seed,
        "pre_failure_error": curve.allowed.tolist(),
        **told,
    }


def _print(curve: TradeOff, plot: Path | None) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
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
    table = Table(*columns, box=None, pad_edge=False)
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
    if plot is not None:
        out.print(f"written: {escape(str(plot))}", soft_wrap=True)


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command("trade-off")(command)
