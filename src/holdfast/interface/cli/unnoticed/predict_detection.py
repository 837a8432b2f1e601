"""``holdfast predict-detection``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.unnoticed.diagnose import ArmOption


def command(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="Record (.npz, .csv), or motion as follow writes it.")],
    arm: ArmOption,
    bounds: Annotated[Path | None, "File that calibrate wrote: how soon a lock is noticed."] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Predict which locks a motion would reveal, and how soon.

    Example: holdfast predict-detection healthy/000000.npz --arm panda --bounds bounds.json
    """
    model = chain.resolve_arm(arm)
    q, rate = hf.diagnosis.read_motion(model, motion)
    thresholds = None if bounds is None else hf.diagnosis.load(bounds)
    detectability = hf.diagnosis.predict_detection(model, q, rate=rate, bounds=thresholds)
    output.print_result(detectability)
