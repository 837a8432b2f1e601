"""``holdfast diagnose``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE

ArmOption = Annotated[str, "Built-in name, URDF or MJCF file, or DH table (YAML)."]
ColumnsOption = Annotated[Path | None, "Names and units of the columns (YAML), where they are not a log's."]
LatencyOption = Annotated[float, "By which the tool's pose is recorded late, s."]


def command(
    log: Annotated[Path, typer.Argument(metavar="LOG", help="Record (.npz, .csv or .parquet).")],
    arm: ArmOption,
    bounds: Annotated[Path, "File that calibrate wrote."],
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Detect and identify a joint fault in a log.

    Exit code 0 if nothing was found, 3 if there is an alarm.

    Example: holdfast diagnose healthy/000000.npz --arm panda --bounds bounds.json --out diagnosis
    """
    model = chain.resolve_arm(arm)
    diagnosis = hf.diagnosis.diagnose(
        model, hf.faults.Log.load(log, columns=columns, latency=latency), hf.diagnosis.load(bounds)
    )
    output.print_result(diagnosis)
    if diagnosis.verdict.alarm:
        raise typer.Exit(NOT_MET_EXIT_CODE)
