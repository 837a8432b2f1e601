"""``holdfast workspace``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.laws import LawOption, TargetOption, law_of
from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, JsonOption, SeedOption, TaskOption, TipOption, read_target
from holdfast.cli.progress import progress_bar
from holdfast.cli.unnoticed.measures import (
    CONFIGURATIONS_HELP,
    STARTS_HELP,
    MeasureTimeOption,
    PointsOption,
    ProcedureOption,
    SampledOption,
    WholeOption,
    measured,
)
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    target: TargetOption,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for report, figures, table and summary.", show_default=False)
    ] = None,
    starts: Annotated[str | None, typer.Option("--starts", help=STARTS_HELP, show_default="grid:52, or 100")] = None,
    configurations: Annotated[
        int | None, typer.Option("--configurations", help=CONFIGURATIONS_HELP, show_default="36, or 8")
    ] = None,
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
    options = measured(starts, procedure, sampled, whole)
    goal, store = read_target(made.arm, made.task, target), None if out is None else out / "run"
    with progress_bar(json_, "starts") as progress:
        result = hf.workspace(
            made,
            goal,
            configurations=configurations,
            points=points,
            time_limit=time_limit,
            seed=seed,
            store=store,
            progress=progress,
            **options,
        )
    printed(result, json_, [] if out is None else result.save(out, command=said()))


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command("workspace")(command)
