"""``holdfast recover``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.clearance import CapsulesOption, ClearanceOption, MarginOption, RadiusOption, check_clearance, read_clearance
from holdfast.cli.options import (
    TASK_HELP,
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TipOption,
    check_unit_of_places,
    read_arm,
    read_configuration,
    read_joint,
    read_numbers,
    read_pose,
    read_task,
)
from holdfast.errors import InputError
from holdfast.files.output import put
from holdfast.grammar import is_number
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import console, number, plain, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.clearance.clearance import Clearance
    from holdfast.recovery.recovery import Recovery
    from holdfast.recovery.waypoints import Replay

NOT_MET = 3  # exit code: it worked, and the answer is that not everything asked for is met


def command(
    arm: ArmArgument,
    lock: Annotated[
        list[str] | None,
        typer.Option(
            "--lock",
            help="JOINT=ANGLE (rad or m), or JOINT, which then stands as in --at. May be given again.",
            show_default=False,
        ),
    ] = None,
    at: Annotated[
        str | None,
        typer.Option("--at", help="Where the arm stands: joint values, rad and m, by commas or spaces.", show_default=False),
    ] = None,
    goal: Annotated[
        str | None,
        typer.Option(
            "--goal",
            help="home, 'q:' and joint values, or 'pose:' and x,y,z,roll,pitch,yaw (m and degrees) or x,y,z. "
            "Default: home; with --path none.",
            show_default=False,
        ),
    ] = None,
    task: Annotated[
        str | None,
        typer.Option("--task", help=f"{TASK_HELP} With it, home and q: mean the hand's pose there.", show_default=False),
    ] = None,
    path: Annotated[
        Path | None,
        typer.Option("--path", help="Path file (YAML): the rest of the hand's path, to be finished first.", show_default=False),
    ] = None,
    degrees: Annotated[
        bool, typer.Option("--degrees", help="--at, --lock and q: are in degrees (sliding joints stay in m).")
    ] = False,
    metric: Annotated[
        str, typer.Option("--metric", help="What is short: travel (of the joints) or time (at the velocity limits).")
    ] = "travel",
    region: Annotated[
        Path | None,
        typer.Option(
            "--region",
            help="Region file (YAML) of which to say what is left. Default: random poses of the healthy arm.",
            show_default=False,
        ),
    ] = None,
    samples: Annotated[int, typer.Option("--samples", min=0, help="Of these; 0: do not look.")] = 1000,
    starts: Annotated[int, typer.Option("--starts", min=1, help="Random starts of the search for configurations.")] = 256,
    tries: Annotated[int, typer.Option("--tries", min=0, help="Searches for a way where straight lines are blocked.")] = 4,
    seed: Annotated[int, typer.Option("--seed", min=0, help="The same seed gives the same result.")] = 0,
    clearance: ClearanceOption = None,
    capsules: CapsulesOption = None,
    radius: RadiusOption = None,
    margin: MarginOption = None,
    check: Annotated[
        Path | None,
        typer.Option("--check", help="Plan nothing; replay these waypoints (CSV) and say what they keep.", show_default=False),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder for waypoints.csv, recovery.json, motion.png and left.png.", show_default=False),
    ] = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the waypoints to this file.", show_default=False)] = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """My joint is stuck now: what is left of the workspace, can the task be finished, and which is the shortest way home?

    Exit code 0 only if everything that was asked for is met; 3 if a row, a lock, a limit or the goal had to be dropped.

    Example: holdfast recover panda --lock 4=-2 --at "2 0.6 0 -2 0 2.5 0.8" --task position --out home
    """
    check_clearance(clearance, capsules, radius, margin)
    model = read_arm(arm, base, tip, hold)
    shape = read_clearance(model, clearance, capsules, radius, margin, chooses=True)
    if check is not None:
        _replay(model, check, _locks(model, lock or [], degrees), shape, margin or 0.0, json_)
        return
    if at is None:
        raise InputError("give --at, where the arm stands now, for example --at " + ",".join("0" * model.n))
    if not lock:
        raise InputError(f"give --lock, which joint is stuck, for example --lock {model.joint_names[0]}")
    from holdfast.paths.path import Path as HandPath
    from holdfast.recovery import search
    from holdfast.regions.region import Region

    locked = _locks(model, lock, degrees)
    stands = read_configuration(model, at, degrees, "--at")
    aim, positions = _goal(model, goal or ("home" if path is None else ""), degrees)
    chosen = None if task is None else read_task(task, arm, model)
    if positions:
        chosen = _position_task(model, chosen)
    hand_path = None if path is None else HandPath.load(path)
    if hand_path is not None:
        check_unit_of_places(model, hand_path.pose(np.linspace(0, 1, 21))[:, :3, 3], "--path")
    result = search.recover(
        model,
        {name: float(stands[model.joint_index(name)]) if value is None else value for name, value in locked.items()},
        stands,
        aim,
        chosen,
        path=hand_path,
        clearance=shape or False,
        margin=margin or 0.0,
        metric=metric,  # type: ignore[arg-type]
        region=None if region is None else Region.load(region),
        samples=samples,
        starts=starts,
        tries=tries,
        seed=seed,
    )
    files = []
    if csv is not None and len(result.q):
        files.append(result.save(csv))
    if out is not None:
        files += _folder(result, out)
    if json_:
        print_json(_data(result))
    else:
        _print(result, files)
        if csv is not None and not len(result.q):
            typer.echo(f"holdfast: there is no motion, so '{csv}' is not written", err=True)
    if not result.ok:
        raise typer.Exit(NOT_MET)


def _locks(arm: Arm, texts: list[str], degrees: bool) -> dict[str, float | None]:
    """Where each locked joint stands, by name; None: as in --at."""
    found: dict[str, float | None] = {}
    for text in texts:
        joint, equals, value = text.rpartition("=")
        k = read_joint(arm, joint if equals else text)
        name = arm.joint_names[k]
        if name in found:
            raise InputError(f"--lock gives joint '{name}' twice; give each joint once")
        found[name] = None
        if equals:
            numbers = read_numbers(f"--lock '{text}'", value, "one number after =")
            if numbers.size != 1 or not np.isfinite(numbers).all():
                raise InputError(f"--lock '{text}' is not joint=angle; write for example --lock {name}=0.3")
            found[name] = float(np.deg2rad(numbers[0]) if degrees and not arm.prismatic[k] else numbers[0])
    return found


def _goal(arm: Arm, text: str, degrees: bool) -> tuple[Any, bool]:
    """--goal as the library takes it, and whether it is a position alone."""
    if text in ("", "home") or text in arm.states:
        return text or None, False
    kind, colon, rest = text.partition(":")
    words = text.replace(",", " ").split()
    if not colon and words and is_number(words[0]):
        count = len(words)
        if arm.n in (3, 6) and count in (3, 6):
            raise InputError(f"--goal '{text}' could be joint values or a pose; write 'q:{text}' or 'pose:{text}'")
        kind, rest = ("q" if count == arm.n else "pose"), text
    if kind == "q":
        return read_configuration(arm, rest, degrees, "--goal"), False
    if kind != "pose":
        raise InputError(
            f"--goal '{text}' is not known; write {', '.join({'home': 0, **arm.states})}, "
            f"'q:...' with {arm.n} joint values, or 'pose:...'"
        )
    pose = read_pose(arm, "--goal", rest)
    if pose.shape == (4, 4):
        return pose, False
    whole = np.eye(4)
    whole[:3, 3] = pose
    return whole, True


def _position_task(arm: Arm, task: Any) -> Any:
    """The task of a goal without orientation."""
    from holdfast.arm.task import as_task, plane_normal

    if task is None:
        return "planar" if plane_normal(arm) is not None else "position"
    made = as_task(arm, task)
    if made.angular:
        raise InputError(
            f"--goal has no orientation and task '{made.name}' needs one; give x,y,z,roll,pitch,yaw or --task position"
        )
    return made


# ---- out -----------------------------------------------------------------------------------------------------------------


def _replay(arm: Arm, file: Path, locked: dict[str, float | None], shape: Clearance | None, margin: float, json_: bool) -> None:
    from holdfast.recovery.waypoints import check_waypoints, read_waypoints

    q = read_waypoints(arm, file)
    stands: dict[str | int, float] = {
        name: float(q[0, arm.joint_index(name)]) if x is None else x for name, x in locked.items()
    }
    replay = check_waypoints(arm, q, stands, shape, margin)
    if json_:
        print_json(_replay_data(replay))
    else:
        for line in replay.describe():
            typer.echo(line[:1].upper() + line[1:])
    if not replay.ok:
        raise typer.Exit(NOT_MET)


def _replay_data(replay: Replay) -> dict[str, Any]:
    return {
        "ok": replay.ok,
        "waypoints": len(replay.q),
        "configurations_looked_at": replay.looked_at,
        "beyond_limits": replay.beyond_limits,
        "locks_moved": replay.locks_moved,
        "least_clearance_m": replay.least_clearance,
        "margin_m": replay.margin,
        "hand_at_end": replay.poses[-1],
    }


def _folder(result: Recovery, out: Path) -> list[Path]:
    from holdfast.report.figures import save_png

    (file,) = put(out, {"recovery.json": json.dumps(plain(_data(result)), indent=2) + "\n"})
    files = [file, save_png(result.figure(), out / "motion.png", 150)]
    if len(result.q):
        files.append(result.save(out / "waypoints.csv"))
    if result.left is not None and result.left.healthy.any():
        files.append(save_png(result.map(), out / "left.png", 150))
    return files


def _rows(rows: Any) -> dict[str, float] | None:
    """What rows that are given up miss, by name with its unit."""
    if rows is None:
        return None
    return {f"{name}_{unit}": miss for name, unit, miss in zip(rows.names, rows.units, rows.misses, strict=True)}


def _interval(p: Any) -> dict[str, float] | None:
    return None if p is None else {"value": p.value, "low": p.low, "high": p.high, "confidence": p.confidence}


def _data(result: Recovery) -> dict[str, Any]:
    replay = result.check() if len(result.q) else None
    left, rest = result.left, result.rest
    return {
        **result.arm.entry(),
        "fingerprint": result.arm.fingerprint,
        "locked": result.locked,
        "goal": result.goal,
        "task": result.task.name,
        "ok": result.ok,
        "ending": result.ending.name.lower(),
        "sentence": result.ending.sentence,
        "reason": result.reason,
        "given_up": _rows(result.given_up),
        "choices": [_rows(c) for c in result.choices],
        "proof": result.proof,
        "goal_configurations_found": result.found,
        "starts": result.starts,
        "metric": result.metric,
        "unit": result.unit,
        "length": result.length,
        "lower_bound": result.lower_bound,
        "legs": [
            {"name": g.name, "first": g.first, "last": g.last, "length": g.length, "lower_bound": g.lower_bound}
            for g in result.legs
        ],
        "joints": list(result.arm.joint_names),
        "waypoints": result.q,
        "check": None if replay is None else _replay_data(replay),
        "clearance": None if result.clearance is None else shape_summary(result.clearance, result.margin),
        "left": None
        if left is None
        else {
            "what": left.region,
            "rows": list(left.rows),
            "targets": len(left.healthy),
            "reached_healthy": int(left.healthy.sum()),
            "still_reached": int(left.locked.sum()),
            "share_left": _interval(left.left),
            "share_of_region": _interval(left.of_region),
            "healthy_share_of_region": _interval(left.healthy_of_region),
            "starts": left.starts,
        },
        "rest_of_path": None
        if rest is None
        else {
            "finished": rest.finished,
            "furthest": rest.furthest,
            "first_lost": rest.first_lost,
            "deviation": rest.deviation,
            "given_up": _rows(rest.given_up),
        },
        "seed": result.seed,
    }


def _print(result: Recovery, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    first, verdict, *rest = result.describe()
    out.print(escape(first), soft_wrap=True)
    out.print(f"[{'bold' if result.ok else 'bold red'}]{escape(verdict)}[/]", soft_wrap=True)
    for line in rest:
        out.print(escape(line[:1].upper() + line[1:]), soft_wrap=True)
    if len(result.q):
        replay = result.check()
        shape = "" if result.clearance is None else f" ({shape_text(result.clearance, result.margin)})"
        for line in replay.describe():
            out.print(escape(f"check: {line}{shape if line.startswith('least') else ''}"), soft_wrap=True)
        table = Table("joint", "start", "end", "", box=None, pad_edge=False)
        for k, joint in enumerate(result.arm.joints):
            factor, unit = joint.shown
            cells = [f"{number(factor * x)} {unit}" for x in (result.q[0, k], result.q[-1, k])]
            table.add_row(escape(joint.name), *cells, "locked" if joint.name in result.locked else "")
        out.print(table)
    print_written(out, files)
