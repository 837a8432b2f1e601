"""``holdfast workspace``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.cli.laws import LawOption, read_law
from holdfast.cli.options import (
    TARGET_HELP,
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TaskOption,
    TipOption,
    read_arm,
    read_target,
    read_task,
)
from holdfast.cli.progress import progress_bar
from holdfast.errors import InputError
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.control.law import Law
    from holdfast.convergence.origins import Workspace
    from holdfast.convergence.targets import TargetMeasures


def command(
    arm: ArmArgument,
    target: Annotated[
        str,
        typer.Option(
            "--target",
            help=f"{TARGET_HELP} Many targets: a lattice (grid:12) or a number of random ones (random:200).",
            show_default=False,
        ),
    ],
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for figures, table and summary.", show_default=False)
    ] = None,
    starts: Annotated[
        str | None,
        typer.Option(
            "--starts",
            help="grid:52, a lattice over the workspace of a planar arm, or a number of random places.",
            show_default="grid:52, or 100; over targets 20; with --map 1000",
        ),
    ] = None,
    configurations: Annotated[
        int | None,
        typer.Option(
            "--configurations",
            help="Of each start: on each curve of its self-motion, or random ones.",
            show_default="36, or 8; over targets 8, or 4; with --map 20",
        ),
    ] = None,
    points: Annotated[
        int | None,
        typer.Option(
            "--points",
            help="Failures of each joint on each motion; 0: ranges only.",
            show_default="10, or 3; over targets 2",
        ),
    ] = None,
    procedure: Annotated[
        bool, typer.Option("--procedure/--brute", help="Simulate only failures where there is a sink, or all.")
    ] = False,
    sampled: Annotated[
        bool,
        typer.Option(
            "--sampled", help="Random configurations of each start; so it is for every arm that does not move in a plane."
        ),
    ] = False,
    whole: Annotated[
        bool, typer.Option("--whole/--inside", help="F of the whole way, or of its part within the joints' ranges.")
    ] = False,
    map_: Annotated[
        bool, typer.Option("--map", help="How motions end with a joint locked from their start, in place of the six measures.")
    ] = False,
    over: Annotated[str, typer.Option("--over", help="With --map: over the starts or over the targets.")] = "starts",
    laws: Annotated[
        str | None,
        typer.Option(
            "--laws",
            help="With --map: several laws on the same failures, as 'pseudoinverse; damped:0.05; failure-tolerant:0.2'.",
            show_default=False,
        ),
    ] = None,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    time_limit: Annotated[
        float | None, typer.Option("--time-limit", help="s.", show_default="2000 s; with --map 500 s")
    ] = None,
    seed: Annotated[int, typer.Option("--seed", help="Seed; the same seed gives the same result.")] = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """From where does the hand still come to a target when a joint locks on the way and nobody knows?

    The measures R100 to Fsens of Goel et al. 2005: for a planar arm over a lattice of starts, for other arms by sampling,
    with 95 % intervals. A stopped analysis goes on where it was if --out is the same. With --map, how motions end.

    Example: holdfast workspace planar-3r --target 1.5,1.5 --procedure --out results

    Example: holdfast workspace panda --task position --target 0.5,0.2,0.4 --starts 200 --out results
    """
    model = read_arm(arm, base, tip, hold)
    wanted = read_task(task, arm, model)
    if laws is None:
        made = [read_law(law, model, wanted)]
    else:
        made = [read_law(part, model, wanted, "--laws") for part in map(str.strip, laws.split(";")) if part]
    if not map_ and laws is None:
        if procedure and sampled:
            raise InputError("--procedure and --sampled exclude each other; leave one out")
        options: dict[str, Any] = {
            "starts": None if starts is None else _places(starts),
            "configurations": configurations,
            "points": points,
            "method": "procedure" if procedure else "sampled" if sampled else None,
            "relative_to": "whole" if whole else "inside",
            "time_limit": time_limit,
            "seed": seed,
        }
        if target.startswith(("grid", "random:")):
            _over_targets(made[0], target, options, out, json_)
        else:
            _measures(made[0], target, options, out, json_)
        return
    if procedure or sampled or whole or points is not None:
        raise InputError(
            "--procedure, --sampled, --whole and --points belong to the measures; leave them out, or --map and --laws"
        )
    options = {
        "targets": _places(target)
        if target.startswith(("grid", "random:"))
        else read_target(made[0].arm, made[0].task, target),
        "starts": _places(starts or "1000"),
        "configurations": 20 if configurations is None else configurations,
        "over": over,
        "time_limit": time_limit,
        "seed": seed,
    }
    _map(made, options, out, json_)


def _places(text: str) -> str | int:
    text = text.removeprefix("random:")
    return int(text) if text.isdecimal() else text


def _measures(law: Law, target: str, options: dict[str, Any], out: Path | None, json_: bool) -> None:
    from holdfast.convergence.origins import workspace as run
    from holdfast.present.convergence.origins import save, summary

    goal = read_target(law.arm, law.task, target)
    with progress_bar(json_, "starts") as progress:
        w = run(law, goal, store=None if out is None else out / "run", progress=progress, **options)
    files = [] if out is None else save(w, out)
    if json_:
        print_json(summary(w))
    else:
        _print(w, files)


def _over_targets(law: Law, target: str, options: dict[str, Any], out: Path | None, json_: bool) -> None:
    from rich.markup import escape

    from holdfast.convergence.targets import target_measures

    with progress_bar(json_, "targets") as progress:
        found = target_measures(law, _places(target), progress=progress, **options)
    files = [] if out is None else found.save(out)
    if json_:
        print_json(
            {
                "targets": found.targets.points,
                "ends": found.ends,
                "percent": found.measures,
                "percent_95": found.target_intervals(),
            }
        )
        return
    show = console()
    for line in found.describe():
        show.print(escape(line), soft_wrap=True)
    _print_means(show, "mean over the targets, percent", found)
    print_written(show, files)


def _print(w: Workspace, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    show = console()
    for line in w.describe():
        show.print(escape(line), soft_wrap=True)
    table = Table("joint", "target in reach with it at", box=None, pad_edge=False)
    for joint, arcs in zip(w.law.arm.joints, w.bounds, strict=True):
        factor, unit = joint.shown
        told = ", ".join(f"{factor * a:.2f} to {factor * b:.2f} {unit}" for a, b in arcs)
        table.add_row(escape(joint.name), told or "no value")
    show.print(table)
    sampled = w.method == "sampled"
    _print_means(show, "mean over the starts, percent", w, sampled)
    if sampled:
        names = ["R100", "F100"] if w.ends.sum() else ["R100"]
        rows = Table("joint", *(f"starts with {name} 100, percent" for name in names), box=None, pad_edge=False)
        for column, shares in zip(w.columns, zip(*map(w.throughout, names), strict=True), strict=True):
            rows.add_row(escape(column), *[_with_interval(100 * i.value, 100 * i.low, 100 * i.high) for i in shares])
        show.print("where all configurations that were drawn do, an upper bound for all that there are:")
        show.print(rows)
    print_written(show, files)


def _print_means(show: Console, title: str, found: Workspace | TargetMeasures, intervals: bool = True) -> None:
    """A column for each measure, a row for each joint."""
    from rich.markup import escape
    from rich.table import Table

    means, sure = found.means(), found.intervals()
    table = Table("joint", *means, box=None, pad_edge=False)
    for k, name in enumerate((*found.law.arm.joint_names, "any")):
        cells = [_with_interval(v[k], *sure[m][k]) if intervals else number(v[k]) for m, v in means.items()]
        table.add_row(escape(name), *cells)
    show.print(title + (" (and 95 % interval):" if intervals else ":"))
    show.print(table)


def _with_interval(value: float, low: float, high: float) -> str:
    return number(value) if value != value else f"{value:.1f}\n{low:.1f} to {high:.1f}"


def _map(laws: list[Law], options: dict[str, Any], out: Path | None, json_: bool) -> None:
    from rich.markup import escape

    from holdfast.convergence.law_choice import best_law
    from holdfast.convergence.maps import convergence_map
    from holdfast.present.convergence.maps import save, summary

    several = len(laws) > 1
    with progress_bar(json_, "runs") as progress:
        if several:
            choice = best_law(laws, progress=progress, **options)
            maps, told = list(choice.maps), choice.describe()
        else:
            maps = [convergence_map(laws[0], progress=progress, **options)]
            told = maps[0].describe()
    files: list[Path] = []
    if out is not None:
        for k, one in enumerate(maps):
            files += save(one, out / f"{k + 1}-{one.law.slug}" if several else out)
    if json_:
        best = {"best": choice.best, "laws": list(choice.names)} if several else {}
        print_json({**best, "maps": [summary(one) for one in maps]} if several else summary(maps[0]))
        return
    show = console()
    for line in [*told, *(f"written: {file}" for file in files)]:
        show.print(escape(line), soft_wrap=True)
