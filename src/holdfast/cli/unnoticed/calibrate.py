"""``holdfast calibrate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import BaseOption, HoldOption, JsonOption, TipOption, read_arm
from holdfast.cli.unnoticed.diagnose import ArmOption, ColumnsOption, LatencyOption
from holdfast.present.results import printed


def command(
    logs: Annotated[list[Path], typer.Argument(metavar="LOG...", help="Records (.npz, .csv or .parquet).", show_default=False)],
    arm: ArmOption,
    out: Annotated[Path, typer.Option("--out", help="File of the bounds (JSON).", show_default=False)],
    factor: Annotated[
        float | None,
        typer.Option(
            "--factor", help="On the largest healthy residual. Default: 1.5, without torques 2.5.", show_default=False
        ),
    ] = None,
    coulomb: Annotated[float, typer.Option("--coulomb", help="Dry friction of each joint, N m (N), if known.")] = 0.0,
    viscous: Annotated[
        float | None,
        typer.Option("--viscous", help="Viscous friction, N m s/rad (N s/m). Default: the arm's own.", show_default=False),
    ] = None,
    fit: Annotated[bool, typer.Option("--fit", help="Fit masses and friction to the records first.")] = False,
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """Calibrate the bounds of a monitor from records of a healthy arm, and tell how often it may alarm falsely.

    Example: holdfast calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json
    """
    model = read_arm(arm, base, tip, hold)
    records = [hf.faults.Log.load(log, columns=columns, latency=latency) for log in logs]
    bounds = hf.diagnosis.calibrate(model, records, factor=factor, coulomb=coulomb, viscous=viscous, fit=fit)
    printed(bounds, json_, [bounds.to_json(out)])
