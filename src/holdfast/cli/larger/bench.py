"""``holdfast bench``: suites of cases that anyone can run again, ours and others' planners on the same ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.groups import CellOption, Chain
from holdfast.cli.larger.study import chunks_progress, stopping
from holdfast.cli.options import ArmArgument, JsonOption
from holdfast.present.results import printed, said

command = typer.Typer(name="bench", help="Run benchmarks for motion planners.", no_args_is_help=True)


@command.callback()
def _root() -> None:
    """Run benchmarks for motion planners."""


@command.command("fail-active")
def fail_active(
    arm: ArmArgument = "panda",
    out: Annotated[Path, "Folder for the cases and results."] = Path("fail-active"),
    cases: Annotated[
        int, typer.Option("--cases", min=1, help="Cases of each task that reaches a pose; of the others a tenth.")
    ] = 1000,
    task: Annotated[list[str] | None, "Only this one; may be given again."] = None,
    planner: Annotated[
        list[str] | None,
        "recover, differential-ik, differential-ik-8-starts, rrt-connect or ompl-rrt-connect; may be given again.",
        "recover",
    ] = None,
    cell: CellOption = None,
    seconds: Annotated[float, "Time limit of a case, on one thread."] = 10.0,
    seed: Annotated[int, typer.Option("--seed", min=0, help="The same seed gives the same cases.")] = 1,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Benchmark planners on random failures and tasks.

    Ctrl-C stops after the current cases; the same command resumes.

    Example: holdfast bench fail-active panda --cases 100 --task reach-pose --task line --out fail-active
    """
    model = chain.arm(arm)
    with stopping() as stop, chunks_progress(json_) as progress:
        found = hf.bench.fail_active(
            model,
            out,
            cell=cell,
            cases=cases,
            tasks=task,
            planners=planner or ["recover"],
            seconds=seconds,
            seed=seed,
            progress=progress,
            stop=stop,
        )
    files = found.save(out, command=said())
    printed(found, json_, files)
    if stop():
        raise KeyboardInterrupt
