"""``holdfast target-measures``."""

from __future__ import annotations

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.laws import LawOption, TargetsOption, law_of, read_places, read_targets
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import Measured, MeasureTimeOption
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetsOption,
    measured: Measured = Measured(),
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MeasureTimeOption = None,
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Measure how much an undetected lock endangers each target, averaged over starts.

    The measures of 'holdfast workspace' for many targets, each over the same starts.

    Example: holdfast target-measures planar-3r --target grid:12 --out results

    Example: holdfast target-measures panda --task position --target random:50 --out results
    """
    made = law_of(law, arm, task, chain)
    targets, places = read_targets(made, target), None if measured.starts is None else read_places(measured.starts)
    options = {"time_limit": time_limit, "seed": seed, **measured.options()}
    with progress_bar(json_, "targets") as progress:
        result = hf.target_measures(made, targets, places, progress=progress, **options)
    printed(result, json_, [] if measured.out is None else result.save(measured.out, command=said()))
