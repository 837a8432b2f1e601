"""``holdfast convergence-map``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.cli.groups import Chain, Touched
from holdfast.cli.laws import LawOption, TargetsOption, law_of, read_places, read_targets
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import Mapped, MapTimeOption
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetsOption,
    mapped: Mapped = Mapped(),
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MapTimeOption = None,
    touched: Touched = Touched(),
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Map how motions end with each joint locked from the start.

    Example: holdfast convergence-map panda --task position --target 0.5,0.2,0.4 --starts 1000 --out results

    Example: holdfast convergence-map planar-3r --target grid:12 --over targets --out results
    """
    made = law_of(law, arm, task, chain)
    targets, places = read_targets(made, target), read_places(mapped.starts)
    shape = touched.read(made.arm)
    with progress_bar(json_, "runs") as progress:
        drawn: dict[str, Any] = {"configurations": mapped.configurations, "over": mapped.over, "seed": seed}
        result = hf.convergence_map(made, targets, places, time_limit=time_limit, clearance=shape, progress=progress, **drawn)
    printed(result, json_, [] if mapped.out is None else result.save(mapped.out, command=said()))
