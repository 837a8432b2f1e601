"""``holdfast studio``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from holdfast.cli.groups import CellOption, Chain, MeshesOption
from holdfast.cli.options import TARGET_HELP, ArmArgument, DegreesOption, TaskOption
from holdfast.cli.values import default_task, read_configuration, read_joint, read_numbers, read_target, read_task
from holdfast.errors import InputError
from holdfast.registry import INDICES, LAWS, OWN_INDEX, SUSCEPTIBILITIES, unknown

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.studio.state import Condition

PORT = 8123


def command(
    arm: ArmArgument,
    port: Annotated[int, "Port of the page; 0 takes any free one."] = PORT,
    host: Annotated[str, "Address to listen on. Let other machines in only among people you trust."] = "127.0.0.1",
    q: Annotated[str | None, "Joint values, rad and m. Default: near home, in no special place."] = None,
    degrees: DegreesOption = False,
    task: TaskOption = None,
    lock: Annotated[list[str] | None, "A joint that is locked. May be given again."] = None,
    free: Annotated[list[str] | None, "A joint that swings freely. May be given again."] = None,
    index: Annotated[str, f"Index shown by the bars: a built-in one, {OWN_INDEX}."] = "relative-manipulability",
    susceptibility: Annotated[str, f"Susceptibility shown by the bars: {SUSCEPTIBILITIES.usage}."] = ("torque"),
    objective: Annotated[str, f"Index or susceptibility for best and worst, {OWN_INDEX}."] = "relative-manipulability",
    law: Annotated[
        list[str] | None, f"Two laws side by side: {LAWS.usage}. Give it twice.", "pseudoinverse and failure-tolerant"
    ] = None,
    target: Annotated[str | None, TARGET_HELP] = None,
    file: Annotated[str | None, "A motion that follow, simulate or recover wrote: CSV or folder."] = None,
    region: Annotated[str | None, "A results folder that assess wrote."] = None,
    cell: CellOption = None,
    meshes: MeshesOption = None,
    move: Annotated[
        list[str] | None, "An object of the cell elsewhere: name=x,y,z[,qx,qy,qz,qw], m. May be given again."
    ] = None,
    time: Annotated[float, "Time at which the motion is shown, s."] = 0.0,
    show: Annotated[
        str | None, "View to open: arm, best-worst, laws, swing, region or file.", "file or region if given, else arm"
    ] = None,
    chain: Chain = Chain(),
) -> None:
    """Drag an arm and lock its joints in an interactive 3-D view (needs the extra 'view').

    Every browser window has its own arm. Ctrl-C stops the server.

    Example: holdfast studio panda --lock 4
    """
    from pathlib import Path

    from holdfast.arm.poses import pose_numbers
    from holdfast.arm.postures import generic_configuration
    from holdfast.arm.task import as_task, target_pose
    from holdfast.cell.cell import Cell
    from holdfast.cli.laws import read_law
    from holdfast.shapes.reading import with_meshes
    from holdfast.studio.server import serve
    from holdfast.studio.state import SHOWS, State

    model = chain.arm(arm)
    model = model if meshes is None else with_meshes(model, meshes)
    text = default_task(arm, model) if task is None else task
    rows = as_task(model, read_task(text, arm, model))
    INDICES.read(index, "--index")
    SUSCEPTIBILITIES.read(susceptibility, "--susceptibility")
    name = objective.partition(":")[0]
    if name not in SUSCEPTIBILITIES and not INDICES.covers(objective):
        raise InputError(f"--objective: {unknown('objective', name, INDICES, SUSCEPTIBILITIES)}")
    (SUSCEPTIBILITIES if name in SUSCEPTIBILITIES else INDICES).read(objective, "--objective")
    if show is not None and show not in SHOWS:
        raise InputError(f"--show '{show}' is not known; use one of {', '.join(SHOWS)}")
    start = generic_configuration(model) if q is None else read_configuration(model, q, degrees)
    laws = law or ["pseudoinverse", "failure-tolerant"]
    if len(laws) != 2:
        raise InputError(f"--law is given {len(laws)} times; the studio shows two laws side by side, so give it twice")
    for label in laws:
        read_law(label, model, rows)
    for option, path in (("--file", file), ("--region", region)):
        if path is not None and not Path(path).exists():
            raise InputError(f"{option}: there is no file or folder '{path}'")
    goal = None
    if target is not None:
        goal = pose_numbers(target_pose(rows, read_target(model, rows, target)))
    state = State(
        arm=arm,
        names=model.joint_names,
        q=tuple(float(x) for x in start),
        task=text,
        base=chain.base,
        tip=chain.tip,
        hold=() if model.chain is None else model.chain.held,
        conditions=_conditions(model, lock or [], free or []),
        index=index,
        susceptibility=susceptibility,
        objective=objective,
        laws=(laws[0], laws[1]),
        target=goal,
        show=show or ("file" if file else "region" if region else "arm"),
        file=file,
        region=region,
        time=time,
        cell=None if cell is None else str(cell),
        meshes=None if meshes is None else str(meshes),
        moved=_moved(move or []),
    )

    def ready(url: str) -> None:
        typer.echo(f"Open {url} in a browser; Ctrl-C stops.")

    if move and cell is None:
        raise InputError("--move takes an object of a cell elsewhere, and there is no cell; add --cell FILE")
    around = None if cell is None else Cell.load(cell)
    with serve(model, state, host, port=port, task=rows, cell=around, ready=ready) as page:
        page.wait()


def _conditions(model: Arm, lock: list[str], free: list[str]) -> tuple[Condition, ...]:
    conditions: list[Condition] = ["healthy"] * model.n
    wanted: tuple[tuple[list[str], Condition], ...] = ((lock, "locked"), (free, "free"))
    for names, condition in wanted:
        for name in names:
            k = read_joint(model, name)
            if conditions[k] != "healthy":
                raise InputError(f"joint '{model.joint_names[k]}' is given twice among --lock and --free; give it once")
            conditions[k] = condition
    return tuple(conditions)


def _moved(given: list[str]) -> tuple[tuple[str, tuple[float, ...]], ...]:
    out: list[tuple[str, tuple[float, ...]]] = []
    for text in given:
        name, _, numbers = text.partition("=")
        values = read_numbers("--move", numbers, "numbers")
        if values.size == 3:
            values = np.concatenate([values, [0.0, 0.0, 0.0, 1.0]])
        if values.size != 7 or not np.isfinite(values).all() or not np.linalg.norm(values[3:]) > 1e-9:
            raise InputError(f"--move '{text}': give name=x,y,z in m, or name=x,y,z,qx,qy,qz,qw, not all q 0")
        out.append((name, tuple(values.tolist())))
    return tuple(out)
