"""``holdfast diagnose``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import NOT_MET, BaseOption, HoldOption, JsonOption, OutOption, PlotOption, TipOption, read_arm
from holdfast.present.results import drawn, printed

ArmOption = Annotated[
    str, typer.Option("--arm", help="Built-in name, URDF or MJCF file, or DH table (YAML).", show_default=False)
]
ColumnsOption = Annotated[
    Path | None,
    typer.Option("--columns", help="Names and units of the columns (YAML), where they are not a log's.", show_default=False),
]
LatencyOption = Annotated[float, typer.Option("--latency", help="By which the tool's pose is recorded late, s.")]


def command(
    log: Annotated[Path, typer.Argument(metavar="LOG", help="Record (.npz, .csv or .parquet).", show_default=False)],
    arm: ArmOption,
    bounds: Annotated[Path, typer.Option("--bounds", help="File that calibrate wrote.", show_default=False)],
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Look for a joint fault in a record of an arm: when it alarms, which joint, which kind, and what could not be told.

    Exit code 0 if nothing was found, 3 if there is an alarm.

    Example: holdfast diagnose healthy/000000.npz --arm panda --bounds bounds.json --out diagnosis
    """
    model = read_arm(arm, base, tip, hold)
    found = hf.diagnosis.diagnose(model, hf.faults.Log.load(log, columns=columns, latency=latency), hf.diagnosis.load(bounds))
    printed(found, json_, drawn(found, plot, out))
    if found.verdict.alarm:
        raise typer.Exit(NOT_MET)
