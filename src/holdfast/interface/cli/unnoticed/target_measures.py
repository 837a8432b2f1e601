"""``holdfast target-measures``."""

from __future__ import annotations

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.laws import LawOption, TargetsOption, read_law_for_arm, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.unnoticed.measures import MeasureOptions, MeasureTimeOption
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    target: TargetsOption,
    measured: MeasureOptions = MeasureOptions(),
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MeasureTimeOption = None,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Measure how much an undetected lock endangers each target, averaged over starts.

    The measures of 'holdfast workspace' for many targets, each over the same starts.

    Example: holdfast target-measures planar-3r --target grid:12 --out results

    Example: holdfast target-measures panda --task position --target random:50 --out results
    """
    control_law = read_law_for_arm(law, arm, task, chain)
    targets, places = (
        read_targets(control_law, target),
        None if measured.starts is None else read_position_sampling(measured.starts),
    )
    options = {"time_limit": time_limit, "seed": seed, **measured.library_arguments()}
    with ProgressBar(json_, "targets") as progress:
        result = hf.target_measures(control_law, targets, places, progress=progress, **options)
    print_result(result, json_, [] if measured.out is None else result.save(measured.out, command=current_command()))
