"""``holdfast stationary`` and ``holdfast basins``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.laws import LawOption, TargetOption, read_law
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    PlotOption,
    SeedOption,
    TaskOption,
    TipOption,
    read_arm,
    read_joint,
    read_numbers,
    read_target,
    read_task,
)
from holdfast.errors import InputError
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.equilibria.attraction import Basins
    from holdfast.equilibria.curves import Curves
    from holdfast.equilibria.points import RestPoints

LockOption = Annotated[
    list[str],
    typer.Option("--lock", help="A joint that stands. May be given again, with --at.", show_default=False),
]
DegreesOption = Annotated[bool, typer.Option("--degrees", help="--at is in degrees (sliding joints stay in m).")]
SHOWN = 12  # points of a kind in a table
MANY = 3  # eigenvalues: of more only the ends of their range


def stationary(
    arm: ArmArgument,
    target: TargetOption,
    lock: LockOption,
    at: Annotated[
        str | None,
        typer.Option("--at", help="Where each stands, rad or m. Default: curves over all values.", show_default=False),
    ] = None,
    degrees: DegreesOption = False,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    json_: JsonOption = False,
) -> None:
    """Find where an arm can come to rest when joints have locked and its controller does not know.

    Example: holdfast stationary planar-3r --target 1.5,1.5 --lock 2 --at 140 --degrees
    """
    from holdfast.equilibria.search import stationary as find

    model = read_arm(arm, base, tip, hold)
    made = read_law(law, model, read_task(task, arm, model))
    joints, goal = [read_joint(model, text) for text in lock], read_target(made.arm, made.task, target)
    if at is None:
        curves = find(made, goal, joints, seed=seed)
        if plot is not None:
            from holdfast.present.equilibria.figures import curves_figure
            from holdfast.report.figures import save_png

            save_png(curves_figure(curves, seed), plot)
        if json_:
            print_json(_curves_data(curves))
        else:
            _print_curves(curves, plot)
        return
    if plot is not None:
        raise InputError("--plot draws curves over the locked value; leave out --at, or see 'holdfast basins --plot'")
    points = find(made, goal, joints, _at(model, joints, at, degrees), seed=seed)
    if json_:
        print_json(_points_data(points))
    else:
        _print_points(points)


def basins(
    arm: ArmArgument,
    target: TargetOption,
    lock: LockOption,
    at: Annotated[str, typer.Option("--at", help="Where each locked joint stands, rad or m.", show_default=False)],
    starts: Annotated[int, typer.Option("--starts", help="How many random starts.")] = 2000,
    grid: Annotated[
        int | None,
        typer.Option("--grid", help="Two healthy joints: a map of so many by so many starts instead.", show_default=False),
    ] = None,
    degrees: DegreesOption = False,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    json_: JsonOption = False,
) -> None:
    """Find from where an arm with locked joints still arrives, and where it ends if not.

    Example: holdfast basins planar-3r --target 1.5,1.5 --lock 2 --at 45 --degrees --grid 80 --plot basins.png
    """
    from holdfast.equilibria.attraction import basins as find

    model = read_arm(arm, base, tip, hold)
    made = read_law(law, model, read_task(task, arm, model))
    joints = [read_joint(model, text) for text in lock]
    found = find(made, read_target(made.arm, made.task, target), joints, _at(model, joints, at, degrees), starts, grid, seed)
    if plot is not None:
        from holdfast.present.equilibria.figures import basins_figure
        from holdfast.report.figures import save_png

        save_png(basins_figure(found), plot)
    if json_:
        print_json(_basins_data(found))
    else:
        _print_basins(found, plot)


def _at(arm: Arm, joints: list[int], text: str, degrees: bool) -> np.ndarray[Any, np.dtype[np.float64]]:
    values = read_numbers("--at", text, "one number for each locked joint")
    if values.size != len(joints):
        raise InputError(f"--at has {values.size} numbers; give one for each of the {len(joints)} locked joints")
    return np.where(arm.prismatic[joints], values, np.deg2rad(values)) if degrees else values


# ---- for machines ------------------------------------------------------------------------------------------------------


def _points_data(points: RestPoints) -> dict[str, Any]:
    arm = points.law.arm
    return {
        **arm.entry(),
        "law": points.law.slug,
        "task": points.law.task.name,
        "locked": {arm.joint_names[k]: x for k, x in zip(points.locked, points.at, strict=True)},
        "starts": points.starts,
        "points": [
            {
                "kind": kind,
                "q": dict(zip(arm.joint_names, q, strict=True)),
                "error": error,
                "eigenvalues": [{"real": x.real, "imaginary": x.imag} for x in values],
                "continuum": loose,
                "attracting": attracting,
                "within_limits": inside,
            }
            for kind, q, error, values, loose, attracting, inside in zip(
                points.kinds,
                points.q.tolist(),
                points.error.tolist(),
                points.eigenvalues.tolist(),
                points.continuum.tolist(),
                points.attracting.tolist(),
                points.within_limits.tolist(),
                strict=True,
            )
        ],
    }


def _curves_data(curves: Curves) -> dict[str, Any]:
    arm = curves.law.arm
    return {
        **arm.entry(),
        "law": curves.law.slug,
        "task": curves.law.task.name,
        "locked": arm.joint_names[curves.joint],
        "starts": curves.starts,
        "sink_arcs": [list(arc) for arc in curves.sink_arcs],
        "degenerate_values": curves.degenerate_angles,
        "surface_points": len(curves.loose),
        "surface_attracting": np.sort(curves.loose.q[curves.loose.attracting, curves.joint]),
        "curves": [
            {
                "points": len(c.q),
                "closed": c.closed,
                "degenerate": c.degenerate,
                "segments": [{"kind": s.kind.word, "from": c.locked[s.first], "to": c.locked[s.last]} for s in c.segments],
                "folds": c.locked[c.folds],
                "branch_points": c.locked[c.branch_points],
                "hopf_points": c.locked[c.hopf_points],
                "rank_losses": c.locked[c.rank_losses],
                "solutions": c.locked[c.solutions],
            }
            for c in curves.curves
        ],
    }


def _basins_data(found: Basins) -> dict[str, Any]:
    return {
        **_points_data(found.points),
        "starts": len(found.end),
        "shares": [{"end": name, "share": i.value, "low": i.low, "high": i.high} for name, i in found.shares],
        "converged": {"share": found.converged.value, "low": found.converged.low, "high": found.converged.high},
        "confidence": found.confidence,
    }


# ---- for people --------------------------------------------------------------------------------------------------------


def _print_points(points: RestPoints) -> None:
    from rich.markup import escape

    from holdfast.equilibria.stability import REACHED

    out, arm = console(), points.law.arm
    for line in points.describe():
        out.print(escape(line), soft_wrap=True)
    table = _table(arm, "error", "eigenvalues, Ke", "")
    shown = np.flatnonzero(_first(points.kind, SHOWN))
    for k in shown:
        loose = points.continuum[k]
        notes = ["one of many"] if loose else []
        notes += ["attracting"] if loose and points.error[k] > REACHED and points.attracting[k] else []
        notes += [] if points.within_limits[k] else ["beyond limits"]
        table.add_row(
            points.kinds[k],
            *_joints(arm, points.q[k]),
            number(points.error[k]),
            _spread(points.eigenvalues[k]),
            ", ".join(notes),
        )
    out.print(table)
    if len(shown) < len(points):
        out.print(f"and {len(points) - len(shown)} more; --json has all", soft_wrap=True)


def _print_curves(curves: Curves, plot: Path | None) -> None:
    from rich.markup import escape
    from rich.table import Table

    out, arm = console(), curves.law.arm
    for line in curves.describe():
        out.print(escape(line), soft_wrap=True)
    factor, unit = arm.joints[curves.joint].shown
    table = Table(
        "curve", f"{escape(arm.joint_names[curves.joint])}, {unit}", "kind", "error, least to most", box=None, pad_edge=False
    )
    for k, c in enumerate(curves.curves):
        for s in c.segments:
            error = c.error[s.first : s.last + 1]
            ends = f"{factor * c.locked[s.first]:.3f} to {factor * c.locked[s.last]:.3f}"
            table.add_row(str(k + 1), ends, s.kind.word, f"{number(error.min())} to {number(error.max())}")
    if curves.curves:
        out.print(table)
    print_written(out, [plot])


def _print_basins(found: Basins, plot: Path | None) -> None:
    from rich.markup import escape
    from rich.table import Table

    out, points = console(), found.points
    out.print(escape(points.describe()[0]), soft_wrap=True)
    out.print(f"[bold]{found.converged}[/] of {len(found.end)} starts reach the target", soft_wrap=True)
    table = Table("ends at", "share of starts", "error", box=None, pad_edge=False)
    codes = {found.name(k): k for k in range(len(points))}
    for name, share in found.shares:
        table.add_row(name, str(share), number(points.error[codes[name]]) if name in codes else "")
    out.print(table)
    print_written(out, [plot])


def _table(arm: Arm, *more: str) -> Any:
    from rich.markup import escape
    from rich.table import Table

    joints = [f"{escape(j.name)}, {j.shown[1]}" for j in arm.joints]
    return Table("kind", *joints, *more, box=None, pad_edge=False)


def _joints(arm: Arm, q: Any) -> list[str]:
    return [f"{j.shown[0] * x:.4f}" for j, x in zip(arm.joints, q, strict=True)]


def _first(kind: Any, most: int) -> Any:
    """(P,) True for the first so many of each kind."""
    return np.array([int((kind[:k] == kind[k]).sum()) < most for k in range(len(kind))], dtype=bool)


def _spread(values: Any) -> str:
    """Eigenvalues, or of many the ends of their range."""
    few = values if len(values) <= MANY else values[[0, -1]]
    return (", " if len(values) <= MANY else " to ").join(_complex(x) for x in few)


def _complex(value: complex) -> str:
    return number(value.real) if abs(value.imag) < 1e-9 else f"{number(value.real)}{value.imag:+.3g}i"
