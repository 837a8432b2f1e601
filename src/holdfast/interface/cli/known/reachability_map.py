"""``holdfast reachability-map``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import ArmArgument, SeedOption
from holdfast.interface.cli.values import read_configuration


def command(
    arm: ArmArgument,
    at: Annotated[
        str | None,
        "Joint values in rad and m at which each joint is locked, separated by commas or spaces. Default: several values of "
        "the range of each joint.",
    ] = None,
    degrees: Annotated[bool, "Read --at in degrees (prismatic joints: m)."] = False,
    cell_size: Annotated[
        float | None, "Edge length of a cell in m. Default: 1/12 of the longest reach, in a plane 1/40."
    ] = None,
    bands: Annotated[int, "Number of bands of the sphere of directions; a cell has 2 x BANDS x BANDS directions."] = 3,
    lock_values: Annotated[int, "Number of lock values of each joint without --at."] = 4,
    samples: Annotated[int, "Number of configurations for the intact arm, and for each lock value."] = 1_000_000,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    npz: Annotated[Path | None, "NPZ file (numpy) for the map."] = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Map the tool directions that an arm reaches in each cell of its workspace, intact and with each joint locked.

    Example: holdfast reachability-map panda --at "0 -45 0 -135 0 90 45" --degrees --npz map.npz --plot map.png
    """
    model = chain.resolve_arm(arm)
    reachability = hf.reachability_map(
        model,
        at=None if at is None else read_configuration(model, at, degrees, "--at"),
        cell_size=cell_size,
        bands=bands,
        lock_values=lock_values,
        samples=samples,
        seed=seed,
    )
    output.print_result(reachability, [] if npz is None else [reachability.to_npz(npz)])
