"""``holdfast assess`` and ``holdfast report``."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    FailuresOption,
    IndexOption,
    JsonOption,
    LengthOption,
    TaskOption,
    TipOption,
    console,
    number,
    print_json,
    read_arm,
    read_by_joint,
    read_failures,
    read_task,
)
from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.arm import Arm
    from holdfast.assess import Assessment, Region


FailureRateOption = Annotated[
    list[str] | None,
    typer.Option(
        "--failure-rate",
        help="joint=how often it fails, for the share left after a failure; may be given again.",
        show_default=False,
    ),
]


def assess(
    arm: ArmArgument,
    region: Annotated[
        Path | None, typer.Option("--region", help="Region file (YAML). Default: around the arm's home.", show_default=False)
    ] = None,
    index: IndexOption = "relative-manipulability",
    task: TaskOption = None,
    failures: FailuresOption = "single",
    length: LengthOption = 1.0,
    poses: Annotated[
        int | None,
        typer.Option("--poses", help="Number of poses. Default: 2000, or of a list of poses each once.", show_default=False),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", help="Seed; the same seed gives the same result.")] = 0,
    sampling: Annotated[str, typer.Option("--sampling", help="random or sobol.")] = "random",
    restarts: Annotated[int, typer.Option("--restarts", help="Random starts per pose before it counts as not found.")] = 100,
    optimise: Annotated[bool, typer.Option("--optimise", help="Also find the best configuration of each pose.")] = False,
    after_lock: Annotated[
        bool, typer.Option("--after-lock", help="Also find which poses can still be reached once each joint has locked.")
    ] = False,
    lock_at: Annotated[
        list[str] | None,
        typer.Option("--lock-at", help="joint=angle, rad or m, at which it locks; may be given again.", show_default=False),
    ] = None,
    failure_rate: FailureRateOption = None,
    at_least: Annotated[
        list[float] | None, typer.Option("--at-least", help="Threshold; may be given again.", show_default=False)
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for results and report; a stopped run goes on.", show_default=False)
    ] = None,
    threads: Annotated[
        int | None, typer.Option("--threads", help="Threads. Default: all processors.", show_default=False)
    ] = None,
    base: BaseOption = None,
    tip: TipOption = None,
    json_: JsonOption = False,
) -> None:
    """Over a region of the workspace: with which probability does the arm keep its dexterity when any one joint locks?

    Example: holdfast assess pa10-9dof --poses 2000 --seed 1 --out results
    """
    from holdfast.assess import assess as run
    from holdfast.assess import explain, structures
    from holdfast.assess.assess import check_rates
    from holdfast.assess.structure import structure
    from holdfast.indices import by_name
    from holdfast.kernels import set_threads

    check_thresholds(at_least)
    if threads is not None:
        set_threads(threads)
    model = read_arm(arm, base, tip)
    chosen = read_region(region, arm, model)
    locks, rates = read_by_joint(model, lock_at, "--lock-at"), read_by_joint(model, failure_rate, "--failure-rate")
    if rates:
        check_rates(model, rates)
    for name in rates:
        if not after_lock and name not in locks:
            raise InputError(f"--failure-rate of '{name}' needs its lock; add --after-lock, or --lock-at {name}=ANGLE")
    measure = by_name(index, model, read_task(task, arm, model), read_failures(model, failures), length)
    if sampling not in ("random", "sobol"):
        raise InputError(f"sampling '{sampling}' is not known; use 'random' or 'sobol'")
    if not json_:
        found = structure(model, measure.task)
        if not found.survives:
            typer.echo(explain(model, found, structures(model)), err=True)
    with _progress(json_) as progress:
        result = run(
            model,
            chosen,
            measure,
            poses=poses,
            seed=seed,
            sampling="sobol" if sampling == "sobol" else "random",
            restarts=restarts,
            store=out,
            progress=progress,
            optimise=optimise,
            after_lock=after_lock,
            lock_at=locks,
        )
    page = None if out is None else result.report(out / "report.html", at_least[0] if at_least else None)
    if json_:
        print_json({**_summary(result, at_least, rates), "report": None if page is None else str(page)})
    else:
        _print(result, at_least, rates)
        if page is not None:
            typer.echo(f"report: {page}")


def report(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="Folder that 'holdfast assess --out' wrote.", show_default=False)
    ],
    to: Annotated[Path | None, typer.Option("--to", help="HTML file. Default: DIR/report.html.", show_default=False)] = None,
    at_least: Annotated[list[float] | None, typer.Option("--at-least", help="Threshold; may be given again.")] = None,
    failure_rate: FailureRateOption = None,
    json_: JsonOption = False,
) -> None:
    """Write the report of a results folder again, also of a run that was stopped.

    Example: holdfast report results
    """
    from holdfast.assess import load

    check_thresholds(at_least)
    result = load(folder)
    rates = read_by_joint(result.arm, failure_rate, "--failure-rate")
    if rates and result.distribution.samples:
        result.expected_survival(rates)  # before anything is written
    page = result.report(to or folder / "report.html", at_least[0] if at_least else None)
    if json_:
        print_json({**_summary(result, at_least, rates), "report": str(page)})
    else:
        _print(result, at_least, rates)
        typer.echo(f"report: {page}")


def check_thresholds(at_least: list[float] | None) -> None:
    """Refuse --at-least nan before any work is done."""
    if any(math.isnan(x) for x in at_least or []):
        raise InputError("--at-least is nan; give a number")


def read_region(path: Path | None, spec: str, arm: Arm) -> Region:
    """--region, or a region about the arm's home; for the paper's arm the paper's."""
    from holdfast import arms
    from holdfast.assess import Region
    from holdfast.assess.region import builtin_region

    if path is not None:
        return Region.load(path)
    known = builtin_region(spec)
    if known is not None:
        return known
    return Region.around(arm, arms.about(spec).home if spec in arms.names() else None)


class _progress:
    """A bar on stderr while a person looks, nothing otherwise."""

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet or not sys.stderr.isatty()
        self._bar: Any = None

    def __enter__(self) -> Any:
        if self._quiet:
            return None
        from rich.console import Console
        from rich.progress import Progress, TimeRemainingColumn

        self._bar = Progress(
            *Progress.get_default_columns()[:-1], TimeRemainingColumn(), console=Console(stderr=True), transient=True
        )
        self._bar.start()
        job = self._bar.add_task("poses", total=None)
        return lambda done, total: self._bar.update(job, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()


def _summary(result: Assessment, at_least: list[float] | None, rates: dict[str | int, float]) -> dict[str, Any]:
    d = result.distribution
    names = result.index.failure_names
    reached = d.reached > 0
    return {
        "arm": result.arm.name,
        "fingerprint": result.arm.fingerprint,
        "index": result.index.slug,
        "unit": result.index.unit,
        "better": result.index.better,
        "bound": result.index.bound,
        "task": result.index.task.name,
        "characteristic_length_m": result.index.task.length,
        "region": result.region.to_dict(),
        "poses": result.poses,
        "seed": result.seed,
        "sampling": result.sampling,
        "restarts": result.restarts,
        "complete": result.complete,
        "evaluated": d.samples,
        "reached": d.reached,
        "not_found": d.unreached,
        "singular": d.singular,
        "effective_sample_size": d.effective() if d.weighted and d.samples else None,
        "mean": d.mean if reached else None,
        "quantiles": dict(zip(["0.05", "0.5", "0.95"], d.quantile([0.05, 0.5, 0.95]).tolist(), strict=True))
        if reached
        else None,
        "band_95": d.band() if d.samples else None,
        "probability": [_probability(result, h) for h in _thresholds(result, at_least)] if d.samples else [],
        "worst_counts": dict(zip(names, result.worst_counts.tolist(), strict=True)),
        "optimised": _optimised(result, at_least),
        "after_lock": _after_lock(result),
        "expected_survival": result.expected_survival(rates) if rates and d.samples else None,
        "seconds": result.seconds,
    }


def _optimised(result: Assessment, at_least: list[float] | None) -> dict[str, Any] | None:
    d, counts = result.optimised, result.optimised_worst_counts
    if d is None or counts is None or not d.reached:
        return None
    return {
        "mean": d.mean,
        "quantiles": dict(zip(["0.05", "0.5", "0.95"], d.quantile([0.05, 0.5, 0.95]).tolist(), strict=True)),
        "probability": [_probability(result, h, optimised=True) for h in _thresholds(result, at_least)],
        "worst_counts": dict(zip(result.index.failure_names, counts.tolist(), strict=True)),
    }


def _after_lock(result: Assessment) -> dict[str, Any] | None:
    if result.survivors is None or not result.distribution.samples:
        return None
    locks = result.locks
    return {
        name: {"value": p.value, "low": p.low, "high": p.high, "locked_at": locks[name]}
        for name, p in result.survival().items()
    }


def _thresholds(result: Assessment, given: list[float] | None) -> list[float]:
    if given:
        return given
    if result.index.bound is not None:
        return [h for h in (0.05, 0.1, 0.2, 0.3) if h < result.index.bound]
    if not result.distribution.reached:
        return []
    return [float(f"{x:.3g}") for x in result.distribution.quantile([0.25, 0.5, 0.75]).tolist()]


def _probability(result: Assessment, h: float, optimised: bool = False) -> dict[str, Any]:
    key = "at_least" if result.index.better == "larger" else "at_most"
    p = result.interval(optimised=optimised, **{key: h})  # type: ignore[arg-type]
    return {key: h, "value": p.value, "low": p.low, "high": p.high, "confidence": p.confidence}


def _print(result: Assessment, at_least: list[float] | None, rates: dict[str | int, float]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    d = result.distribution
    out.print(f"[bold]{escape(result.arm.name)}[/]: {escape(result.index.describe())}", soft_wrap=True)
    out.print(f"{escape(result.region.name)}: {escape(result.region.describe())}", soft_wrap=True)
    if not result.complete:
        out.print(
            f"[yellow]not finished: {d.samples} of {result.poses} poses; the same 'holdfast assess' command goes on[/]",
            soft_wrap=True,
        )
    lost = f"{d.unreached_share if d.samples else 0:.1%}{' of the weight' if d.weighted else ''}"
    out.print(
        f"{d.samples} poses, seed {result.seed}: {d.reached} reached, {d.unreached} not found within the limits "
        f"({lost}, counted as failed), {d.singular} singular",
        soft_wrap=True,
    )
    if not d.samples:
        return
    if d.weighted:
        text = f"poses count by weight: effective sample size {d.effective():.4g}, from which the intervals are approximated"
        out.print(text, soft_wrap=True)
    both = [(result.distribution, "as inverse kinematics found them")]
    if result.optimised is not None:
        both.append((result.optimised, "best configurations found"))
    if d.reached:
        for which, name in both:
            low, middle, high = which.quantile([0.05, 0.5, 0.95]).tolist()
            spread = f"median {number(middle)}, 5 % {number(low)}, 95 % {number(high)}, mean {number(which.mean)}"
            out.print(f"over reached poses, {name}: {spread}", soft_wrap=True)
        if result.index.bound is not None:
            out.print(f"no configuration can beat {number(result.index.bound)}", soft_wrap=True)
    sign = "at least" if result.index.better == "larger" else "at most"
    after = ["optimised", "95 % interval"] if result.optimised is not None else []
    table = Table(result.index.name, "probability", "95 % interval", *after, box=None, pad_edge=False)
    for h in _thresholds(result, at_least):
        cells = []
        for optimised in (False, True)[: len(both)]:
            p = _probability(result, h, optimised)
            cells += [f"{p['value']:.4f}", f"{p['low']:.4f} to {p['high']:.4f}"]
        table.add_row(f"{sign} {h:g}", *cells)
    out.print(table)
    columns = [result.worst_counts, *([] if result.optimised_worst_counts is None else [result.optimised_worst_counts])]
    if any(c.sum() for c in columns):
        head = "is the worst in" + (" weight" if d.weighted else "")
        table = Table("failure", head, *["optimised"][: len(columns) - 1], box=None, pad_edge=False)
        for k, name in enumerate(result.index.failure_names):
            if any(c[k] for c in columns):
                table.add_row(
                    escape(name), *[f"{c[k]:{'.4g' if d.weighted else 'd'}} ({c[k] / (c.sum() or 1):.1%})" for c in columns]
                )
        out.print(table)
    if result.survivors is not None:
        table = Table("once it has locked", "where", "poses still reached", "95 % interval", box=None, pad_edge=False)
        for name, share in result.survival().items():
            where = _where(result, name)
            table.add_row(escape(name), where, f"{share.value:.4f}", f"{share.low:.4f} to {share.high:.4f}")
        out.print(table)
        if rates:
            left = result.expected_survival(rates)
            out.print(f"after a failure, by how often each joint fails: {left:.4f} of the poses still reached", soft_wrap=True)


def _where(result: Assessment, joint: str) -> str:
    """Where a joint locks, in degrees or metres."""
    angle = result.locks[joint]
    if angle is None:
        return "as at another pose"
    prismatic = result.arm.prismatic[result.arm.joint_index(joint)]
    return f"{angle:.4g} m" if prismatic else f"{math.degrees(angle):.4g} deg"


def add(app: typer.Typer) -> None:
    """Register the commands."""
    app.command()(assess)
    app.command()(report)
