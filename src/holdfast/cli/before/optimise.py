"""``holdfast configure``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.clearance import CapsulesOption, ClearanceOption, MarginOption, RadiusOption, check_clearance, read_clearance
from holdfast.cli.measure_options import OBJECTIVES
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    GravityOption,
    HoldOption,
    JsonOption,
    MountOption,
    PayloadOption,
    TaskOption,
    TipOption,
    check_unit_of_places,
    outside_limits,
    placed,
    read_arm,
    read_configuration,
    read_objective,
    read_pose,
    read_task,
)
from holdfast.errors import HoldfastError, InputError
from holdfast.files.output import writing
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import console, number, print_json, print_written
from holdfast.status import Status

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rich.console import Console

    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.clearance.clearance import Clearance
    from holdfast.indices.objective import Objective
    from holdfast.solvers.optimum import Optimum

    Array = NDArray[np.float64]

MANY = 0.5  # share of starts that agree, below which more starts are worth it


def configure(
    arm: ArmArgument,
    minimise: Annotated[
        str | None,
        typer.Option("--minimise", help=f"{OBJECTIVES}; or a sum: '0.5*torque:effort + 0.1*acceleration'.", show_default=False),
    ] = None,
    maximise: Annotated[
        str | None,
        typer.Option(
            "--maximise",
            help="The same objectives. A small index, or a large torque, makes the worst configuration.",
            show_default=False,
        ),
    ] = None,
    pose: Annotated[
        list[str] | None,
        typer.Option(
            "--pose",
            help="Of the tool in the world: x,y,z,roll,pitch,yaw in m and degrees, as URDF: Rz(yaw) Ry(pitch) Rx(roll). "
            "x,y,z is enough if the task has no orientation. May be given again.",
            show_default=False,
        ),
    ] = None,
    poses: Annotated[
        Path | None,
        typer.Option("--poses", help="CSV file of poses; first line x,y,z,qx,qy,qz,qw (or x,y,z).", show_default=False),
    ] = None,
    at: Annotated[
        list[str] | None,
        typer.Option(
            "--at",
            help="The pose of this configuration: joint values, rad and m, separated by commas or spaces. May be given again.",
            show_default=False,
        ),
    ] = None,
    degrees: Annotated[bool, typer.Option("--degrees", help="--at is in degrees (sliding joints stay in m).")] = False,
    task: TaskOption = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed; the same seed gives the same result.")] = 0,
    starts: Annotated[
        int | None,
        typer.Option(
            "--starts",
            help="Random starts per pose. Default: 128, or 32 if two joints or more are to spare.",
            show_default=False,
        ),
    ] = None,
    clearance: ClearanceOption = None,
    capsules: CapsulesOption = None,
    radius: RadiusOption = None,
    margin: MarginOption = None,
    mount: MountOption = "floor",
    gravity: GravityOption = None,
    payload: PayloadOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: Annotated[
        Path | None, typer.Option("--csv", help="Write the configurations to this file.", show_default=False)
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Configure the arm before a joint fails: the best configuration of a pose, without moving the hand.

    Example: holdfast configure panda --at "0 -45 0 -135 0 90 45" --degrees --minimise torque:effort
    """
    from holdfast.arm.task import as_task
    from holdfast.clearance.clearance import too_close
    from holdfast.solvers.optimum import optimise

    check_clearance(clearance, capsules, radius, margin)
    model = placed(read_arm(arm, base, tip, hold), mount, gravity, payload)
    chosen = as_task(model, read_task(task, arm, model))
    if (minimise is None) == (maximise is None):
        raise InputError("give one of --minimise and --maximise, for example --minimise torque:effort")
    wish = ("--minimise", minimise) if minimise is not None else ("--maximise", maximise or "")
    objective = read_objective(model, *wish, chosen)
    if [x is not None for x in (pose, poses, at)].count(True) != 1:
        raise InputError('give one of --pose "x,y,z,roll,pitch,yaw", --poses FILE.csv and --at "joint values"')
    given = None if at is None else np.array([read_configuration(model, x, degrees, "--at") for x in at])
    targets = model.forward_kinematics(given) if given is not None else _targets(model, chosen, pose or [], poses)
    apart = read_clearance(model, clearance, capsules, radius, margin, chooses=True)
    optimum = optimise(model, targets, objective, seed, starts, task=chosen, clearance=apart, margin=margin or 0.0)
    if not optimum.success.any():
        first = Status(int(optimum.status[0]))
        advice = first.sentence
        if first == Status.INFEASIBLE and apart is not None:
            advice = (
                f"the arm {too_close(margin or 0.0)} in each that was found ({shape_text(apart, 0.0)}): choose another pose, "
                "give the real shape by --capsules or a smaller --margin, or let it by --no-clearance"
            )
        raise HoldfastError(f"no configuration of {'the pose' if len(targets) == 1 else 'any pose'}: {advice}")
    result = _Result(model, chosen, objective, " ".join(wish).removeprefix("--"), targets, given, optimum, apart, margin or 0.0)
    if csv is not None:
        _write(result, csv)
    if json_:
        print_json(_data(result, seed))
    else:
        _print(result, csv)


def _targets(arm: Arm, task: Task, texts: Sequence[str], file: Path | None) -> Array:
    if file is None:
        option, given = "--pose", [read_pose(arm, "--pose", text) for text in texts]
    else:
        from holdfast.paths.path_file import pose_table

        option, given = "--poses", pose_table(file, "--poses")
    if not given:
        raise InputError(f"{option}: '{file}' holds no poses; give at least one row of them")
    check_unit_of_places(arm, np.array([x[:3, 3] if x.shape == (4, 4) else x for x in given]), option)
    targets = np.tile(np.eye(4), (len(given), 1, 1))
    for target, found in zip(targets, given, strict=True):
        if found.shape == (4, 4):
            target[:] = found
        elif task.angular:
            raise InputError(
                f"{option}: a pose is given as x,y,z without orientation, but task '{task.name}' asks for one; give all of it, "
                "or --task position"
            )
        else:
            target[:3, 3] = found
    return targets


@dataclass(frozen=True)
class _Result:
    arm: Arm
    task: Task
    objective: Objective
    wish: str
    targets: Array
    given: Array | None
    optimum: Optimum
    clearance: Clearance | None
    margin: float

    @property
    def before(self) -> Array:
        """(N, n) the configurations given, or the first that were found; NaN where none was."""
        if self.given is not None:
            return self.given
        return np.where(self.optimum.success[:, None], self.optimum.start_q, np.nan)

    @property
    def values_before(self) -> Array:
        """(N,)."""
        return self.optimum.start_value if self.given is None else self.objective(self.given)

    def apart(self, q: Array) -> Array:
        """(N,) clearance of the arm from itself, m; NaN where it is not looked at."""
        return np.full(len(q), np.nan) if self.clearance is None else self.clearance(q)

    @property
    def worse(self) -> NDArray[np.bool_]:
        """(N,) True where the configuration given is better than the one found, and as clear."""
        sign = 1 if self.objective.better == "larger" else -1
        lost = sign * (self.values_before - self.optimum.value)
        better = lost > 1e-9 * np.abs(self.optimum.value)
        return np.asarray(better & ~(self.apart(self.before) < self.margin))

    def measures(self) -> list[tuple[str, tuple[str, ...], Array, Array]]:
        """Of every summand: its name, the unit of each joint, and what each joint has before and after, (N, n)."""
        from holdfast.indices.index import Index
        from holdfast.indices.susceptibility.measure import Susceptibility

        found: dict[str, tuple[str, tuple[str, ...], Array, Array]] = {}
        for measure in _summands(self.objective):
            if isinstance(measure, Susceptibility):
                found[measure.slug] = (
                    measure.slug,
                    measure.joint_unit,
                    measure.by_joint(self.before),
                    measure.by_joint(self.optimum.q),
                )
            elif isinstance(measure, Index):
                units = (measure.unit,) * self.arm.n
                found[measure.label] = measure.label, units, measure.by_joint(self.before), measure.by_joint(self.optimum.q)
        return list(found.values())


def _summands(objective: Objective) -> list[Objective]:
    from holdfast.indices.objective import Opposite, WeightedSum

    if isinstance(objective, Opposite):
        return _summands(objective.objective)
    return [o for _, o in objective.terms] if isinstance(objective, WeightedSum) else [objective]


def _data(result: _Result, seed: int) -> dict[str, Any]:
    names, optimum, measures = result.arm.joint_names, result.optimum, result.measures()
    before_apart, after_apart = result.apart(result.before), result.apart(optimum.q)

    def row(k: int) -> dict[str, Any]:
        return {
            "pose": result.targets[k].tolist(),
            "status": Status(int(optimum.status[k])).name.lower(),
            "value_before": result.values_before[k],
            "value": optimum.value[k],
            "worse_than_given": bool(result.worse[k]),
            "q_before": dict(zip(names, result.before[k].tolist(), strict=True)),
            "q": dict(zip(names, optimum.q[k].tolist(), strict=True)),
            "clearance_before_m": before_apart[k],
            "clearance_m": after_apart[k],
            "blocked": bool(optimum.blocked[k]) if result.clearance is not None else None,
            "starts": optimum.starts[k],
            "agreeing": optimum.agreeing[k],
            "position_error_m": optimum.position_error[k],
            "rotation_error_rad": optimum.rotation_error[k],
            "measures": {
                slug: {
                    name: {"unit": unit, "before": before[k, i], "after": after[k, i]}
                    for i, (name, unit) in enumerate(zip(names, units, strict=True))
                }
                for slug, units, before, after in measures
            },
        }

    return {
        **result.arm.entry(),
        "objective": result.wish,
        "better": result.objective.better,
        "unit": result.objective.unit,
        "task": result.task.name,
        "before": "found" if result.given is None else "given",
        "seed": seed,
        "clearance": None if result.clearance is None else shape_summary(result.clearance, result.margin),
        "poses": [row(k) for k in range(len(result.targets))],
    }


def _print(result: _Result, file: Path | None) -> None:
    from rich.markup import escape
    from rich.table import Table

    out, optimum = console(), result.optimum
    unit = "" if result.objective.unit in ("1", "mixed") else f" {escape(result.objective.unit)}"
    first = "first configuration found" if result.given is None else "configuration given"
    out.print(f"{escape(result.wish)}, arm {escape(result.arm.title)}, task {escape(result.task.describe())}", soft_wrap=True)
    if len(result.targets) == 1:
        _print_one(result, out, first, unit)
    else:
        table = Table("pose", f"before{unit}", f"after{unit}", "starts agreeing", "", box=None, pad_edge=False)
        for k, status in enumerate(optimum.status):
            table.add_row(
                str(k + 1),
                number(result.values_before[k], 6),
                number(optimum.value[k], 6),
                "" if np.isnan(optimum.agreeing[k]) else f"{optimum.agreeing[k]:.0%} of {optimum.starts[k]}",
                "" if status == Status.OK else Status(int(status)).name.lower().replace("_", " "),
            )
        out.print(table)
        out.print(f"before: the {first}; configurations go to --csv FILE or --json", soft_wrap=True)
    _print_clearance(result, out)
    for status in sorted({int(s) for s in optimum.status if s != Status.OK}):
        out.print(f"[yellow]{Status(status).name.lower().replace('_', ' ')}: {Status(status).sentence}[/]", soft_wrap=True)
    if result.given is not None and result.worse.any():
        which = "" if len(result.targets) == 1 else f" of {int(result.worse.sum())} poses"
        out.print(f"[yellow]The configuration given{which} is better than any found; give more --starts.[/]", soft_wrap=True)
    print_written(out, [file])


def _print_clearance(result: _Result, out: Console) -> None:
    """What keeps the arm from running through itself, and where it would have."""
    from rich.markup import escape

    from holdfast.clearance.clearance import too_close

    if result.clearance is None:
        return
    before, after = result.apart(result.before), result.apart(result.optimum.q)
    close, blocked = too_close(result.margin), int(result.optimum.blocked.sum())
    if len(before) == 1:
        apart = ", ".join(f"{number(x[0], 3)} m {when}" for x, when in ((before, "before"), (after, "after")) if x[0] == x[0])
        text = f"clearance of the arm from itself: {apart}"
        text += f"; a better configuration {close} and was not taken" if blocked else ""
    else:
        counts = [int((x < result.margin).sum()) for x in (before, after)]
        text = f"the arm {close} in {counts[0]} of {len(before)} configurations before, in {counts[1] or 'none'} after"
        text += f"; at {blocked} poses a better configuration does and was not taken" if blocked else ""
    out.print(escape(f"{text} ({shape_text(result.clearance, result.margin)})"), soft_wrap=True)


def _print_one(result: _Result, out: Console, first: str, unit: str) -> None:
    from rich.markup import escape
    from rich.table import Table

    arm, optimum, measures = result.arm, result.optimum, result.measures()
    before, after = result.before[0], optimum.q[0]
    out.print(
        f"[bold]{number(optimum.value[0], 6)}{unit}[/], {result.objective.better} wanted; "
        f"{number(result.values_before[0], 6)} before (the {first})",
        soft_wrap=True,
    )
    table = Table("joint", "before", "after", box=None, pad_edge=False)
    for slug, *_ in measures:
        table.add_column(f"{escape(slug)} before")
        table.add_column("after")
    for i, joint in enumerate(arm.joints):
        cells = [_angle(before[i], joint.unit), _angle(after[i], joint.unit)]
        cells += [_measure(x[0, i], units[i]) for _, units, *both in measures for x in both]
        table.add_row(escape(joint.name), *cells)
    out.print(table)
    outside = outside_limits(arm, before)
    if outside:
        out.print(f"[yellow]outside its limits before: {escape(', '.join(outside))}[/]", soft_wrap=True)
    share = optimum.agreeing[0]
    advice = "" if share >= MANY else "; there are many optima: more --starts may find a better one"
    out.print(
        f"{optimum.starts[0]} starts met the pose; of those followed to the end {share:.0%} agree{advice}", soft_wrap=True
    )
    if optimum.status[0] == Status.OK:
        out.print(f"pose met to {optimum.position_error[0]:.1e} m and {optimum.rotation_error[0]:.1e} rad", soft_wrap=True)


def _angle(value: float, unit: str) -> str:
    return f"{number(value)} m" if unit == "m" else f"{number(value)} rad ({number(np.degrees(value))} deg)"


def _measure(value: float, unit: str) -> str:
    if unit == "rad":
        return _angle(value, unit)
    return number(value) + ("" if unit == "1" else f" {unit}")


def _write(result: _Result, path: Path) -> None:
    import csv

    from holdfast.files.spreadsheet import cell

    optimum = result.optimum
    names = [f"{joint.name}_{joint.unit}" for joint in result.arm.joints]
    columns = ["pose", "status", "value_before", "value", "starts", "agreeing", "position_error_m", "rotation_error_rad"]
    with writing(path, "configurations") as file:
        table = csv.writer(file)
        table.writerow(map(cell, columns + names))
        for k in range(len(result.targets)):
            errors = optimum.position_error[k], optimum.rotation_error[k]
            facts = [result.values_before[k], optimum.value[k], optimum.starts[k], optimum.agreeing[k], *errors]
            cells = [f"{x:.12g}" for x in [*facts, *optimum.q[k]]]
            table.writerow([k + 1, Status(int(optimum.status[k])).name.lower(), *cells])
