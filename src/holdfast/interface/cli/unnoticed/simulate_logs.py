"""``holdfast simulate-logs``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.files.output import make_folder
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import ArmArgument, SeedOption
from holdfast.interface.presentation.printing import make_console, print_written_files


def command(
    arm: ArmArgument,
    out: Annotated[Path, "Folder of the records."],
    records: Annotated[int, typer.Option("--records", min=1, help="So many, each with a motion of its own.")] = 1,
    duration: Annotated[float, "Of each, s."] = 6.0,
    faults: Annotated[Path | None, "Faults file (YAML); record k is episode k."] = None,
    robot: Annotated[int, "Which robot: records of one have one."] = 0,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
) -> None:
    """Simulate sensor logs of an arm, with or without faults.

    Masses and friction of a robot are off by up to 20 % of the arm's model (needs the extra 'physics').

    Example: holdfast simulate-logs panda --records 2 --out healthy
    """
    model = chain.resolve_arm(arm)
    fault_model = None if faults is None else hf.faults.load(faults)
    events = (
        None
        if fault_model is None
        else [fault_model.draw(model, episode=number, horizon=duration) for number in range(records)]
    )
    seeds, folder = range(seed, seed + records), make_folder(out)
    logs = hf.diagnosis.simulate_logs(model, duration, seeds=seeds, faults=events, robots=[robot] * records)
    files = [log.save(folder / f"{number:06d}.npz") for number, log in enumerate(logs)]
    print_written_files(make_console(), files)
