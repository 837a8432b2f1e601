"""``holdfast workspace``."""

from __future__ import annotations

import holdfast as hf
from holdfast.cli.laws import LawOption, TargetOption, law_of
from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, JsonOption, SeedOption, TaskOption, TipOption, read_target
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
    target: TargetOption,
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
    """From where does an arm still reach a target when a joint locks on the way and nobody knows?

    The measures R100 to Fsens of Goel et al. 2005: for a planar arm over a lattice of starts, for other arms by sampling,
    with 95 % intervals. A stopped analysis resumes if --out is the same. Over targets: 'holdfast target-measures'.

    Example: holdfast workspace planar-3r --target 1.5,1.5 --procedure --out results

    Example: holdfast workspace panda --task position --target 0.5,0.2,0.4 --starts 200 --out results
    """
    made = law_of(law, arm, task, base, tip, hold)
    more = {"configurations": configurations, "points": points, "time_limit": time_limit, "seed": seed}
    options = measured(starts, procedure, sampled, whole, store=None if out is None else out / "run", **more)
    goal = read_target(made.arm, made.task, target)
    with progress_bar(json_, "starts") as progress:
        result = hf.workspace(made, goal, progress=progress, **options)
    printed(result, json_, [] if out is None else result.save(out, command=said()))
