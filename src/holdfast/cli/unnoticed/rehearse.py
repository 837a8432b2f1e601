"""``holdfast rehearse``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.options import ArmArgument, SeedOption
from holdfast.files.output import made
from holdfast.present.printing import console, print_written


def command(
    arm: ArmArgument,
    out: Annotated[Path, "Folder of the records."],
    records: Annotated[int, typer.Option("--records", min=1, help="So many, each with a motion of its own.")] = 1,
    duration: Annotated[float, "Of each, s."] = 6.0,
    faults: Annotated[Path | None, "Faults file (YAML); record k is episode k."] = None,
    body: Annotated[int, "Which robot: records of one have one."] = 0,
    seed: SeedOption = 0,
    chain: Chain = Chain(),
) -> None:
    """Simulate sensor logs of an arm, with or without faults.

    Masses and friction of a robot are off by up to 20 % of the arm's model (needs the extra 'physics').

    Example: holdfast rehearse panda --records 2 --out healthy
    """
    model = chain.arm(arm)
    model_of = None if faults is None else hf.faults.load(faults)
    events = None if model_of is None else [model_of.draw(model, episode=k, horizon=duration) for k in range(records)]
    seeds, folder = range(seed, seed + records), made(out)
    logs = hf.diagnosis.rehearse_many(model, duration, seeds=seeds, faults=events, bodies=[body] * records)
    files = [log.save(folder / f"{k:06d}.npz") for k, log in enumerate(logs)]
    print_written(console(), files)
