"""``holdfast bench``: reproducible suites of cases for motion planners, those of holdfast and external ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, CellOption
from holdfast.interface.cli.larger.study import show_chunk_progress, stop_on_signal
from holdfast.interface.cli.options import ArmArgument, JsonOption
from holdfast.interface.presentation.results import current_command, print_result

command = typer.Typer(name="bench", help="Run benchmarks for motion planners.", no_args_is_help=True)


@command.callback()
def _describe_group() -> None:
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
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Benchmark planners on random failures and tasks.

    Ctrl-C stops after the current cases; the same command resumes.

    Example: holdfast bench fail-active panda --cases 100 --task reach-pose --task line --out fail-active
    """
    model = chain.resolve_arm(arm)
    with stop_on_signal() as stop, show_chunk_progress(json_) as progress:
        benchmark = hf.planner_benchmark.fail_active(
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
    files = benchmark.save(out, command=current_command())
    print_result(benchmark, json_, files)
    if stop():
        raise KeyboardInterrupt
