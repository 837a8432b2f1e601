"""``holdfast best-law``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.cli.groups import Chain, Touched
from holdfast.cli.laws import LawsOption, TargetsOption, read_laws, read_places, read_targets
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import Mapped, MapTimeOption
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetsOption,
    mapped: Mapped = Mapped(),
    law: LawsOption = None,
    task: TaskOption = None,
    time_limit: MapTimeOption = None,
    touched: Touched = Touched(),
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Rank control laws by how often they reach their target after an undetected lock.

    All laws are tried on the same failures, those of 'holdfast convergence-map'.

    Example: holdfast best-law panda --task position --target 0.5,0.2,0.4 --law pseudoinverse --law failure-tolerant:0.2
    """
    laws = read_laws(law, chain.arm(arm), task, arm)
    targets, places = read_targets(laws[0], target), read_places(mapped.starts)
    shape = touched.read(laws[0].arm)
    how: dict[str, Any] = {"configurations": mapped.configurations, "over": mapped.over, "time_limit": time_limit}
    with progress_bar(json_, "runs") as progress:
        result = hf.best_law(laws, targets, places, progress=progress, clearance=shape, seed=seed, **how)
    printed(result, json_, [] if mapped.out is None else result.save(mapped.out, command=said()))
