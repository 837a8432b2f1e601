"""``holdfast observe``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.groups import Chain, Output
from holdfast.cli.unnoticed.diagnose import ArmOption


def command(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="Record (.npz, .csv), or motion as follow writes it.")],
    arm: ArmOption,
    bounds: Annotated[Path | None, "File that calibrate wrote: how soon a lock is noticed."] = None,
    chain: Chain = Chain(),
    output: Output = Output(),
) -> None:
    """Predict which locks a motion would reveal, and how soon.

    Example: holdfast observe healthy/000000.npz --arm panda --bounds bounds.json
    """
    model = chain.arm(arm)
    q, rate = hf.diagnosis.read_motion(model, motion)
    known = None if bounds is None else hf.diagnosis.load(bounds)
    found = hf.diagnosis.observe(model, q, rate=rate, bounds=known)
    output.printed(found)
