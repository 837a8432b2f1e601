"""``holdfast observe``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import BaseOption, HoldOption, JsonOption, OutOption, PlotOption, TipOption, read_arm
from holdfast.cli.unnoticed.diagnose import ArmOption
from holdfast.present.results import drawn, printed


def command(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="Record (.npz, .csv), or motion as follow writes it.")],
    arm: ArmOption,
    bounds: Annotated[
        Path | None, typer.Option("--bounds", help="File that calibrate wrote: how soon a lock is noticed.")
    ] = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Say before it is made what a motion will show of locked joints: which are seen, how soon, and which look alike.

    Example: holdfast observe healthy/000000.npz --arm panda --bounds bounds.json
    """
    model = read_arm(arm, base, tip, hold)
    q, rate = hf.diagnosis.read_motion(model, motion)
    known = None if bounds is None else hf.diagnosis.load(bounds)
    found = hf.diagnosis.observe(model, q, rate=rate, bounds=known)
    printed(found, json_, drawn(found, plot, out))
