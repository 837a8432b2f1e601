"""``holdfast compare``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from holdfast.cli.laws import LawsOption, read_law
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TaskOption,
    TipOption,
    read_arm,
    read_configuration,
    read_joint,
    read_numbers,
    read_target,
    read_task,
)
from holdfast.errors import InputError
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.convergence.law_comparison import LawComparison
    from holdfast.convergence.random_motions import PointToPoint

MOTIONS = 100


def compare(
    arm: ArmArgument,
    law: LawsOption = None,
    motions: Annotated[
        int | None,
        typer.Option("--motions", "--tasks", help="How many random motions from point to point.", show_default=str(MOTIONS)),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Of the random motions.")] = 0,
    distance: Annotated[
        str | None,
        typer.Option("--distance", help="Of random motions, m: least,greatest, for example 0.2,0.8.", show_default=False),
    ] = None,
    reachable_after: Annotated[
        list[str] | None,
        typer.Option(
            "--reachable-after",
            help="Random motions whose target is still within reach with this JOINT locked at the start, or 'each'. May be "
            "given again.",
            show_default=False,
        ),
    ] = None,
    start: Annotated[
        str | None,
        typer.Option("--start", help="Instead: one motion from these joint values, rad and m, ...", show_default=False),
    ] = None,
    target: Annotated[
        str | None, typer.Option("--target", help="... to here, as 'holdfast simulate' takes it.", show_default=False)
    ] = None,
    lock: Annotated[
        list[str] | None,
        typer.Option(
            "--lock",
            help="JOINT that locks, alone and from the start; may be given again. Or 'each', or 'none'.",
            show_default="each",
        ),
    ] = None,
    task: TaskOption = None,
    gain: Annotated[float, typer.Option("--gain", help="Ke, per s or per cycle.")] = 1.0,
    speed_limit: Annotated[
        float | None,
        typer.Option("--speed-limit", help="Of the hand, m/s or m per cycle. Default: none.", show_default=False),
    ] = None,
    cycles: Annotated[bool, typer.Option("--cycles", help="Discrete control cycles in place of continuous time.")] = False,
    time_limit: Annotated[
        float | None, typer.Option("--time-limit", help="s or cycles.", show_default="3000/gain s, or 1000 cycles")
    ] = None,
    degrees: Annotated[bool, typer.Option("--degrees", help="--start is in degrees (sliding joints stay in m).")] = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for report.html and tables (CSV).", show_default=False)
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Compare control laws of one arm on the same motions while a joint has locked and the controller does not know.

    Arms, tools and tasks are compared by 'holdfast assess A B C', which is something else: how much dexterity a failure leaves.

    Example: holdfast compare panda --task position --law pseudoinverse --law failure-tolerant:0.5 --motions 200 --out laws
    """
    from holdfast.convergence.law_comparison import compare_laws

    model = read_arm(arm, base, tip, hold)
    chosen = read_task(task, arm, model)
    options: dict[str, Any] = {"gain": gain, "speed_limit": speed_limit}
    laws = [read_law(text, model, chosen, **options) for text in law or ["pseudoinverse", "failure-tolerant"]]
    locked = _locks(model, lock)
    drawn: PointToPoint | None = None
    if start is None and target is None:
        drawn = _draw(model, chosen, motions, seed, distance, reachable_after)
        q0, goal, about = drawn.q0, drawn.target, f"{drawn.describe()}; seed {seed}"
    elif start is None or target is None:
        raise InputError("--start and --target go together; give both, or neither for random motions")
    elif motions is not None or distance is not None or reachable_after:
        raise InputError("--motions, --distance and --reachable-after are about random motions; leave out --start and --target")
    else:
        q0, goal = read_configuration(model, start, degrees, "--start"), read_target(laws[0].arm, laws[0].task, target)
        about = f"one motion of '{model.name}'"
    result = compare_laws(laws, q0, goal, locked, cycles, time_limit=time_limit, seed=seed)
    files = []
    if out is not None:
        files = result.save(out)
        files.append(result.report(out / "report.html", f"holdfast {shlex.join(sys.argv[1:])}", about))
    if json_:
        print_json(_data(result, about))
    else:
        _print(result, about, files)


def _locks(arm: Arm, given: list[str] | None) -> Literal["each"] | list[int] | None:
    if given is None or given == ["each"]:
        return "each"
    if given == ["none"]:
        return None
    for text in given:
        if text in ("each", "none"):
            raise InputError(f"--lock {text} stands alone; leave out the other --lock")
        if "@" in text and text not in arm.joint_names:
            raise InputError(f"--lock '{text}': in a comparison joints lock at the start; give {text.partition('@')[0]} alone")
    return [read_joint(arm, text) for text in given]


def _draw(
    arm: Arm, task: Any, motions: int | None, seed: int, distance: str | None, reachable_after: list[str] | None
) -> PointToPoint:
    from holdfast.convergence.random_motions import point_to_point

    span: tuple[float, float] | None = None
    if distance is not None:
        numbers = read_numbers("--distance", distance, "least,greatest")
        if numbers.size != 2:
            raise InputError(f"--distance has {numbers.size} numbers; give the least and the greatest distance, m")
        span = float(numbers[0]), float(numbers[1])
    joints: Literal["each"] | list[int] | None = None
    if reachable_after:
        joints = "each" if reachable_after == ["each"] else [read_joint(arm, text) for text in reachable_after]
    return point_to_point(arm, MOTIONS if motions is None else motions, seed, span, joints, task)


def _data(c: LawComparison, about: str) -> dict[str, Any]:
    from holdfast.present.convergence import law_comparison as rows

    data: dict[str, Any] = {
        **c.arm.entry(),
        "task": c.laws[0].task.name,
        "motions": len(c),
        "about": about,
        "laws": {name: law.describe() for name, law in zip(c.names, c.laws, strict=True)},
        "outcomes": c.table,
        "healthy": rows.healthy_rows(c),
        "undecided": {name: c.reasons(name) for name in c.names},
    }
    if rows.pairs(c):
        data["gains"] = rows.gain_rows(c)
    return data


def _print(c: LawComparison, about: str, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from holdfast.present.convergence import law_comparison as rows
    from holdfast.words import percent

    out = console()
    size = "m and rad" if c.laws[0].task.angular else "m"
    out.print(f"Arm {escape(c.arm.title)}, task {escape(c.laws[0].task.describe())}; {escape(about)}", soft_wrap=True)
    out.print(f"[bold]{escape(rows.headline(c))}[/]", soft_wrap=True)
    table = Table(
        "law",
        "locked",
        "arrives",
        "95 % interval",
        "stuck",
        "moving",
        "undecided",
        "within reach",
        "astray",
        box=None,
        pad_edge=False,
    )
    for r in c.table:
        interval = f"{percent(r['converged_low'])} to {percent(r['converged_high'])}"
        shares = [percent(r[x]) for x in ("stuck", "moving", "undecided", "reachable")]
        astray = "" if r["astray"] is None else f"{number(r['astray'], 3)}"
        table.add_row(escape(r["law"]), escape(r["failure"]), percent(r["converged"]), interval, *shares, astray)
    out.print(table)
    out.print(
        f"astray: median end error, {size}, of the runs that do not arrive; joint limits are not enforced", soft_wrap=True
    )
    if rows.pairs(c):
        gains = Table(
            "law", "locked", f"arrive, more than with {escape(c.names[0])}", f"end error, {size}", box=None, pad_edge=False
        )
        for r in rows.gain_rows(c):
            more, error = (
                f"{factor * r[x]:+.{digits}f} ({factor * r[f'{x}_low']:+.{digits}f} to {factor * r[f'{x}_high']:+.{digits}f})"
                for x, factor, digits in (("gain", 100.0, 1), ("error", 1.0, 4))
            )
            gains.add_row(escape(r["law"]), escape(r["failure"]), f"{more} points", error)
        out.print(gains)
    if c.comparable.any():
        _print_costs(c, rows.healthy_rows(c))
    print_written(out, files)


def _print_costs(c: LawComparison, costs: list[dict[str, Any]]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from holdfast.words import fixed

    out = console()
    unit = "cycles" if c.runs[0].cycles else "s"
    table = Table(
        "while healthy", "off the straight line", "largest angle to the command", "to the target", box=None, pad_edge=False
    )
    for r in costs:
        cells = [
            f"{fixed(r[f'{of}_50{end}'], digits)} {shown}"
            for of, end, shown, digits in (("deviation", "_m", "m", 3), ("angle", "_deg", "deg", 1), ("time", "", unit, 2))
        ]
        table.add_row(escape(r["law"]), *cells)
    out.print(table)
    out.print("medians over the motions that arrive with every law", soft_wrap=True)
