"""``holdfast target-measures``."""

from __future__ import annotations

from typing import Any

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.laws import LawOption, TargetsOption, law_of, read_places, read_targets
from holdfast.cli.options import ArmArgument, JsonOption, SeedOption, TaskOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed import measures
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetsOption,
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
    """Measure which targets an unnoticed lock puts at risk, averaged over starts.

    The measures of 'holdfast workspace' for many targets, each over the same starts.

    Example: holdfast target-measures planar-3r --target grid:12 --out results

    Example: holdfast target-measures panda --task position --target random:50 --out results
    """
    made = law_of(law, arm, task, chain)
    targets, places = read_targets(made, target), None if starts is None else read_places(starts)
    options: dict[str, Any] = {"points": points, "time_limit": time_limit, "relative_to": relative_to, "seed": seed}
    with progress_bar(json_, "targets") as progress:
        result = hf.target_measures(
            made, targets, places, configurations=configurations, method=method, progress=progress, **options
        )
    printed(result, json_, [] if out is None else result.save(out, command=said()))
