"""``holdfast convergence-map``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.interface.cli.groups import ContactOptions
from holdfast.interface.cli.laws import SeededLawOptions, TargetsOption, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.unnoticed.measures import MapOptions, MapTimeOption
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    target: TargetsOption,
    mapped: MapOptions = MapOptions(),
    controlled: SeededLawOptions = SeededLawOptions(),
    time_limit: MapTimeOption = None,
    touched: ContactOptions = ContactOptions(),
    json_: JsonOption = False,
) -> None:
    """Map how motions end with each joint locked from the start.

    Example: holdfast convergence-map panda --task position --target 0.5,0.2,0.4 --starts 1000 --out results

    Example: holdfast convergence-map planar-3r --target grid:12 --over targets --out results
    """
    control_law = controlled.read_law(arm)
    targets, places = read_targets(control_law, target), read_position_sampling(mapped.starts)
    clearance = touched.build_contact_clearance(control_law.arm)
    with ProgressBar(json_, "runs") as progress:
        map_options: dict[str, Any] = {"configurations": mapped.configurations, "over": mapped.over, "seed": controlled.seed}
        result = hf.convergence_map(
            control_law, targets, places, time_limit=time_limit, clearance=clearance, progress=progress, **map_options
        )
    print_result(result, json_, [] if mapped.out is None else result.save(mapped.out, command=current_command()))
