"""``holdfast target-measures``."""

from __future__ import annotations

import holdfast as hf
from holdfast.cli.laws import LawOption, TargetsOption, law_of, read_targets
from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, JsonOption, SeedOption, TaskOption, TipOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import (
    ConfigurationsOption,
    FolderOption,
    MeasureTimeOption,
    PointsOption,
    ProcedureOption,
    SampledOption,
    StartsOption,
    WholeOption,
    measured,
)
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetsOption,
    out: FolderOption = None,
    starts: StartsOption = None,
    configurations: ConfigurationsOption = None,
    points: PointsOption = None,
    procedure: ProcedureOption = False,
    sampled: SampledOption = False,
    whole: WholeOption = False,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MeasureTimeOption = None,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """Which targets does a lock put at risk that nobody knows of, wherever the motion began?

    The measures of 'holdfast workspace' for many targets, each over the same starts.

    Example: holdfast target-measures planar-3r --target grid:12 --out results

    Example: holdfast target-measures panda --task position --target random:50 --out results
    """
    made = law_of(law, arm, task, base, tip, hold)
    more = {"configurations": configurations, "points": points, "time_limit": time_limit, "seed": seed}
    options, targets = measured(starts, procedure, sampled, whole, **more), read_targets(made, target)
    with progress_bar(json_, "targets") as progress:
        result = hf.target_measures(made, targets, progress=progress, **options)
    printed(result, json_, [] if out is None else result.save(out, command=said()))
