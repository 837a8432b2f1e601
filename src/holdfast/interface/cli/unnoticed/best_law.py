"""``holdfast best-law``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions
from holdfast.interface.cli.laws import LawsOption, TargetsOption, read_laws, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.unnoticed.measures import MapOptions, MapTimeOption
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    target: TargetsOption,
    mapped: MapOptions = MapOptions(),
    law: LawsOption = None,
    task: TaskOption = None,
    time_limit: MapTimeOption = None,
    touched: ContactOptions = ContactOptions(),
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Rank control laws by how often they reach their target after an undetected lock.

    All laws are tried on the same failures, those of 'holdfast convergence-map'.

    Example: holdfast best-law panda --task position --target 0.5,0.2,0.4 --law pseudoinverse --law failure-tolerant:0.2
    """
    laws = read_laws(law, chain.resolve_arm(arm), task, arm)
    targets, positions = read_targets(laws[0], target), read_position_sampling(mapped.starts)
    clearance = touched.build_contact_clearance(laws[0].arm)
    map_options: dict[str, Any] = {"configurations": mapped.configurations, "over": mapped.over, "time_limit": time_limit}
    with ProgressBar(json_, "runs") as progress:
        result = hf.best_law(laws, targets, positions, progress=progress, clearance=clearance, seed=seed, **map_options)
    print_result(result, json_, [] if mapped.out is None else result.save(mapped.out, command=current_command()))
