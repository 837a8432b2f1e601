"""``holdfast page``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from holdfast.core.registry import LAW_REGISTRY
from holdfast.interface.cli.groups import ArmSourceOptions, CellOption, MeshesOption
from holdfast.interface.cli.laws import OptionalTargetOption
from holdfast.interface.cli.options import ArmArgument, DegreesOption, TaskOption
from holdfast.interface.cli.values import read_configuration, read_joint, read_target, read_task
from holdfast.interface.presentation.printing import make_console, print_written_files


def command(
    arm: ArmArgument,
    out: Annotated[Path, "HTML file to write."],
    q: Annotated[
        str | None, "First joint values in rad and m. Default: a configuration that another one improves most."
    ] = None,
    degrees: DegreesOption = False,
    lock: Annotated[list[str] | None, "Joint that is locked at first, by name or number from 1. Repeatable."] = None,
    law: Annotated[
        list[str] | None,
        f"Control law of the undetected lock; give two: {LAW_REGISTRY.usage}.",
        "pseudoinverse and failure-tolerant",
    ] = None,
    target: OptionalTargetOption = None,
    task: TaskOption = None,
    with_: Annotated[list[str] | None, typer.Option("--with", help="Further arm in a menu. Repeatable.")] = None,
    cell: CellOption = None,
    meshes: MeshesOption = None,
    plain: Annotated[bool, "Omit the five steps: only dragging, bars, and locks."] = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
) -> None:
    """Write an interactive page of an arm: one HTML file that needs no server, network, or Python.

    Drag the tool, lock joints, and see which motion remains, which configuration keeps more, and what a power cut does.

    Example: holdfast page panda --out panda.html
    """
    from holdfast.model import arms
    from holdfast.model.arm.task import as_task, default_path_task, target_pose
    from holdfast.model.cell.cell import Cell
    from holdfast.model.shapes.reading import with_mesh_folder

    model = chain.resolve_arm(arm)
    model = model if meshes is None else with_mesh_folder(model, meshes)
    position_task = as_task(model, default_path_task(model, oriented=False))
    page = model.page(
        q=None if q is None else read_configuration(model, q, degrees),
        locked=[read_joint(model, name) for name in lock or []],
        laws=law or ("pseudoinverse", "failure-tolerant"),
        target=None if target is None else target_pose(position_task, read_target(model, position_task, target)),
        task=as_task(model, read_task(task, arm, model)),
        cell=None if cell is None else Cell.load(cell),
        beside=[arms.load(name) for name in with_ or []],
        plain=plain,
    )
    print_written_files(make_console(), [page.save(out)])
