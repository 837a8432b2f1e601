"""``holdfast workspace``."""

from __future__ import annotations

import holdfast as hf
from holdfast.interface.cli.laws import SeededLawOptions, TargetsOption, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.unnoticed.measures import MeasureOptions, MeasureTimeOption, PlacesOption
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    target: TargetsOption,
    over: PlacesOption = "starts",
    measured: MeasureOptions = MeasureOptions(),
    controlled: SeededLawOptions = SeededLawOptions(),
    time_limit: MeasureTimeOption = None,
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
    control_law = controlled.read_law(arm)
    targets = read_targets(control_law, target)
    places = None if measured.starts is None else read_position_sampling(measured.starts)
    store = None if measured.out is None or over == "targets" else measured.out / "run"
    options = {"over": over, "time_limit": time_limit, "seed": controlled.seed, "store": store, **measured.library_arguments()}
    with ProgressBar(json_, over) as progress:
        result = hf.workspace(control_law, targets, places, progress=progress, **options)
    print_result(result, json_, [] if measured.out is None else result.save(measured.out, command=current_command()))
