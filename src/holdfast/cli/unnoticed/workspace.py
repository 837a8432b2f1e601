"""``holdfast workspace``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.laws import LawOption, TargetOption, law_of, read_places
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption, read_target
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed import measures
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetOption,
    out: measures.FolderOption = None,
    starts: measures.StartsOption = None,
    configurations: measures.ConfigurationsOption = None,
    points: measures.PointsOption = None,
    method: measures.MethodOption = None,
    relative_to: measures.RelativeOption = "inside",
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: measures.MeasureTimeOption = None,
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Map the starts from which an arm still reaches a target when a joint locks on the way and nobody notices.

    The measures R100 to Fsens of Goel et al. 2005: for a planar arm over a lattice of starts, for other arms by sampling,
    with 95 % intervals. A stopped analysis resumes if --out is the same. Over targets: 'holdfast target-measures'.

    Example: holdfast workspace planar-3r --target 1.5,1.5 --method procedure --out results

    Example: holdfast workspace panda --task position --target 0.5,0.2,0.4 --starts 200 --out results
    """
    made = law_of(law, arm, task, chain)
    goal, places = read_target(made.arm, made.task, target), None if starts is None else read_places(starts)
    store = None if out is None else out / "run"
    options: dict[str, Any] = {
        "points": points,
        "time_limit": time_limit,
        "relative_to": relative_to,
        "seed": seed,
        "store": store,
    }
    with progress_bar(json_, "starts") as progress:
        result = hf.workspace(made, goal, places, configurations=configurations, method=method, progress=progress, **options)
    printed(result, json_, [] if out is None else result.save(out, command=said()))
