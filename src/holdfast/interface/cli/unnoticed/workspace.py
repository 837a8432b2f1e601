"""``holdfast workspace``."""

from __future__ import annotations

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.laws import LawOption, TargetsOption, read_law_for_arm, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.unnoticed.measures import MeasureOptions, MeasureTimeOption, PlacesOption
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    target: TargetsOption,
    over: PlacesOption = "starts",
    measured: MeasureOptions = MeasureOptions(),
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MeasureTimeOption = None,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Map the start positions from which a target is still reached after an undetected lock.

    The results are the measures R100 to Fsens of Goel et al. 2005: for a planar arm over a lattice of starts, for other arms by
    sampling, with 95 % intervals. With the same --out, a stopped analysis resumes. With --over targets, the measures are
    computed for many targets over the same starts, and show how much a lock endangers each target.

    Example: holdfast workspace planar-3r --target 1.5,1.5 --method procedure --out results

    Example: holdfast workspace panda --task position --target 0.5,0.2,0.4 --starts 200 --out results

    Example: holdfast workspace planar-3r --over targets --target grid:12 --out results
    """
    control_law = read_law_for_arm(law, arm, task, chain)
    targets = read_targets(control_law, target)
    places = None if measured.starts is None else read_position_sampling(measured.starts)
    store = None if measured.out is None or over == "targets" else measured.out / "run"
    options = {"over": over, "time_limit": time_limit, "seed": seed, "store": store, **measured.library_arguments()}
    with ProgressBar(json_, over) as progress:
        result = hf.workspace(control_law, targets, places, progress=progress, **options)
    print_result(result, json_, [] if measured.out is None else result.save(measured.out, command=current_command()))
