"""``holdfast rehearse``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, SeedOption, TipOption, read_arm
from holdfast.files.output import made
from holdfast.present.printing import console, print_written


def command(
    arm: ArmArgument,
    out: Annotated[Path, typer.Option("--out", help="Folder of the records.")],
    records: Annotated[int, typer.Option("--records", min=1, help="So many, each with a motion of its own.")] = 1,
    duration: Annotated[float, typer.Option("--duration", help="Of each, s.")] = 6.0,
    faults: Annotated[Path | None, typer.Option("--faults", help="Faults file (YAML); record k is episode k.")] = None,
    body: Annotated[int, typer.Option("--body", help="Which robot: records of one have one.")] = 0,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
) -> None:
    """Simulate records of an arm with servos and noise, healthy or with faults, to try calibrate and diagnose on.

    Masses and friction of a robot are off by up to 20 % of the arm's model (needs the extra 'physics').

    Example: holdfast rehearse panda --records 2 --out healthy
    """
    model = read_arm(arm, base, tip, hold)
    model_of = None if faults is None else hf.faults.load(faults)
    events = None if model_of is None else [model_of.draw(model, episode=k, horizon=duration) for k in range(records)]
    seeds, folder = range(seed, seed + records), made(out)
    logs = hf.diagnosis.rehearse_many(model, duration, seeds=seeds, faults=events, bodies=[body] * records)
    files = [log.save(folder / f"{k:06d}.npz") for k, log in enumerate(logs)]
    print_written(console(), files)
