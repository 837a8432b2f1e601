"""``holdfast studio``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from holdfast.core.errors import InputError
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, OWN_INDEX, SUSCEPTIBILITY_REGISTRY, unknown_name_message
from holdfast.interface.cli.groups import ArmSourceOptions, CellOption, MeshesOption
from holdfast.interface.cli.laws import OptionalTargetOption, read_law
from holdfast.interface.cli.options import ArmArgument, DegreesOption, TaskOption
from holdfast.interface.cli.values import default_task, read_configuration, read_joint, read_numbers, read_target, read_task

if TYPE_CHECKING:
    from holdfast.interface.studio.state import Condition
    from holdfast.model.arm.model import Arm

DEFAULT_PORT = 8123


def command(
    arm: ArmArgument,
    port: Annotated[int, "Port of the page; 0 selects a free one."] = DEFAULT_PORT,
    host: Annotated[str, "Address to listen on. Admit other machines only in a network of people you trust."] = "127.0.0.1",
    q: Annotated[str | None, "Joint values in rad and m. Default: a generic configuration near home."] = None,
    degrees: DegreesOption = False,
    task: TaskOption = None,
    lock: Annotated[list[str] | None, "Locked joint, by name or number from 1. Repeatable."] = None,
    free: Annotated[list[str] | None, "Free-swinging joint, by name or number from 1. Repeatable."] = None,
    index: Annotated[str, f"Index shown by the bars: a built-in one, {OWN_INDEX}."] = "relative-manipulability",
    susceptibility: Annotated[str, f"Susceptibility shown by the bars: {SUSCEPTIBILITY_REGISTRY.usage}."] = ("torque"),
    objective: Annotated[
        str, f"Objective of the view best-worst: index, susceptibility, {OWN_INDEX}."
    ] = "relative-manipulability",
    law: Annotated[
        list[str] | None,
        f"Control law; give it twice to compare two laws: {LAW_REGISTRY.usage}.",
        "pseudoinverse and failure-tolerant",
    ] = None,
    target: OptionalTargetOption = None,
    file: Annotated[str | None, "Motion to play: a CSV file or folder that follow, simulate or recover wrote."] = None,
    region: Annotated[str | None, "Results folder that assess wrote."] = None,
    cell: CellOption = None,
    meshes: MeshesOption = None,
    move: Annotated[list[str] | None, "Object of the environment to move: NAME=x,y,z[,qx,qy,qz,qw], m. Repeatable."] = None,
    time: Annotated[float, "Time in the motion of --file that is shown first, s."] = 0.0,
    show: Annotated[
        str | None, "View to open: arm, best-worst, laws, fall, region or file.", "file or region if given, else arm"
    ] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
) -> None:
    """Drag an arm and lock its joints in your browser, and compare laws, regions, and faults.

    The page is that of 'page', and a server on this computer answers what needs Python. Ctrl-C stops the server.

    Example: holdfast studio panda --lock 4
    """
    from pathlib import Path

    from holdfast.interface.studio.server import serve
    from holdfast.interface.studio.state import DISPLAY_MODES, State
    from holdfast.model.arm.poses import pose_numbers
    from holdfast.model.arm.postures import generic_configuration
    from holdfast.model.arm.task import as_task, target_pose
    from holdfast.model.cell.cell import Cell
    from holdfast.model.shapes.reading import with_mesh_folder

    model = chain.resolve_arm(arm)
    model = model if meshes is None else with_mesh_folder(model, meshes)
    task_name = default_task(arm, model) if task is None else task
    studio_task = as_task(model, read_task(task_name, arm, model))
    INDEX_REGISTRY.read_label(index, "--index")
    SUSCEPTIBILITY_REGISTRY.read_label(susceptibility, "--susceptibility")
    objective_name = objective.partition(":")[0]
    if objective_name not in SUSCEPTIBILITY_REGISTRY and not INDEX_REGISTRY.covers(objective):
        raise InputError(
            f"--objective: {unknown_name_message('objective', objective_name, INDEX_REGISTRY, SUSCEPTIBILITY_REGISTRY)}"
        )
    (SUSCEPTIBILITY_REGISTRY if objective_name in SUSCEPTIBILITY_REGISTRY else INDEX_REGISTRY).read_label(
        objective, "--objective"
    )
    if show is not None and show not in DISPLAY_MODES:
        raise InputError(f"--show '{show}' is not known; use one of {', '.join(DISPLAY_MODES)}")
    configuration = generic_configuration(model) if q is None else read_configuration(model, q, degrees)
    laws = law or ["pseudoinverse", "failure-tolerant"]
    if len(laws) != 2:
        raise InputError(f"--law is given {len(laws)} times; the studio shows two laws side by side, so give it twice")
    for label in laws:
        read_law(label, model, studio_task)
    for option, path in (("--file", file), ("--region", region)):
        if path is not None and not Path(path).exists():
            raise InputError(f"{option}: there is no file or folder '{path}'")
    target_numbers = None
    if target is not None:
        target_numbers = pose_numbers(target_pose(studio_task, read_target(model, studio_task, target)))
    state = State(
        arm=arm,
        names=model.joint_names,
        q=tuple(float(value) for value in configuration),
        task=task_name,
        base=chain.base,
        tip=chain.tip,
        hold=() if model.chain is None else model.chain.held,
        conditions=_read_conditions(model, lock or [], free or []),
        index=index,
        susceptibility=susceptibility,
        objective=objective,
        laws=(laws[0], laws[1]),
        target=target_numbers,
        show=show or ("file" if file else "region" if region else "arm"),
        file=file,
        region=region,
        time=time,
        cell=None if cell is None else str(cell),
        meshes=None if meshes is None else str(meshes),
        moved=_read_moved_objects(move or []),
    )

    def print_address(url: str) -> None:
        typer.echo(f"Open {url} in a browser; Ctrl-C stops.")

    if move and cell is None:
        raise InputError("--move moves an object of an environment, and there is none; add --cell FILE")
    environment = None if cell is None else Cell.load(cell)
    with serve(model, state, host, port=port, task=studio_task, cell=environment, ready=print_address) as running_studio:
        running_studio.wait()


def _read_conditions(model: Arm, lock: list[str], free: list[str]) -> tuple[Condition, ...]:
    conditions: list[Condition] = ["healthy"] * model.n
    requested: tuple[tuple[list[str], Condition], ...] = ((lock, "locked"), (free, "free"))
    for names, condition in requested:
        for name in names:
            joint = read_joint(model, name)
            if conditions[joint] != "healthy":
                raise InputError(f"joint '{model.joint_names[joint]}' is given twice among --lock and --free; give it once")
            conditions[joint] = condition
    return tuple(conditions)


def _read_moved_objects(texts: list[str]) -> tuple[tuple[str, tuple[float, ...]], ...]:
    moved_objects: list[tuple[str, tuple[float, ...]]] = []
    for text in texts:
        name, _, numbers = text.partition("=")
        values = read_numbers("--move", numbers, "numbers")
        if values.size == 3:
            values = np.concatenate([values, [0.0, 0.0, 0.0, 1.0]])
        if values.size != 7 or not np.isfinite(values).all() or not np.linalg.norm(values[3:]) > 1e-9:
            raise InputError(f"--move '{text}': give name=x,y,z in m, or name=x,y,z,qx,qy,qz,qw, not all q 0")
        moved_objects.append((name, tuple(values.tolist())))
    return tuple(moved_objects)
