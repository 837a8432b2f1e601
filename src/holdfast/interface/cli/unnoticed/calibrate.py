"""``holdfast calibrate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import JsonOption
from holdfast.interface.cli.unnoticed.diagnose import ArmOption, ColumnsOption, LatencyOption
from holdfast.interface.presentation.results import print_result


def command(
    logs: Annotated[list[Path], typer.Argument(metavar="LOG...", help="Records (.npz, .csv or .parquet).")],
    arm: ArmOption,
    out: Annotated[Path, "File of the bounds (JSON)."],
    factor: Annotated[float | None, "On the largest healthy residual. Default: 1.5, without torques 2.5."] = None,
    coulomb: Annotated[float, "Dry friction of each joint, N m (N), if known."] = 0.0,
    viscous: Annotated[float | None, "Viscous friction, N m s/rad (N s/m). Default: the arm's own."] = None,
    fit: Annotated[bool, "Fit masses and friction to the records first."] = False,
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Set the detection thresholds of the monitor from logs of a healthy arm.

    Example: holdfast calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json
    """
    model = chain.resolve_arm(arm)
    records = [hf.faults.Log.load(log, columns=columns, latency=latency) for log in logs]
    bounds = hf.diagnosis.calibrate(model, records, factor=factor, coulomb=coulomb, viscous=viscous, fit=fit)
    print_result(bounds, json_, [bounds.to_json(out)])
