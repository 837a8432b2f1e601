"""``holdfast workspace``."""

from __future__ import annotations

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.laws import LawOption, TargetOption, law_of, read_places
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import Measured, MeasureTimeOption
from holdfast.cli.values import read_target
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetOption,
    measured: Measured = Measured(),
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: MeasureTimeOption = None,
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Map the start positions from which a target is still reached after an undetected lock.

    The measures R100 to Fsens of Goel et al. 2005: for a planar arm over a lattice of starts, for other arms by sampling,
    with 95 % intervals. A stopped analysis resumes if --out is the same. Over targets: 'holdfast target-measures'.

    Example: holdfast workspace planar-3r --target 1.5,1.5 --method procedure --out results

    Example: holdfast workspace panda --task position --target 0.5,0.2,0.4 --starts 200 --out results
    """
    made = law_of(law, arm, task, chain)
    goal, places = read_target(made.arm, made.task, target), None if measured.starts is None else read_places(measured.starts)
    store = None if measured.out is None else measured.out / "run"
    options = {"time_limit": time_limit, "seed": seed, "store": store, **measured.options()}
    with progress_bar(json_, "starts") as progress:
        result = hf.workspace(made, goal, places, progress=progress, **options)
    printed(result, json_, [] if measured.out is None else result.save(measured.out, command=said()))
