"""``holdfast teleop tasks``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import JsonOption
from holdfast.interface.cli.progress import show_status
from holdfast.interface.cli.values import read_task
from holdfast.interface.presentation.results import print_result

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm


def tasks(
    arm: Annotated[
        str, typer.Argument(metavar="ARM", help="Arm: built-in name, URDF or MJCF file, or DH table.")
    ] = "planar-3r",
    per_joint: Annotated[int, typer.Option("--per-joint", min=1, help="Number of tasks for each failed joint.")] = 400,
    distance: Annotated[float, "Distance from start to target in m."] = 2.0,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed; the same seed gives the same tasks.")] = 0,
    select: Annotated[int, typer.Option("--select", min=1, help="Number of tasks, spread over their difficulty.")] = 22,
    special: Annotated[
        bool,
        typer.Option(
            "--special/--no-special",
            help="Also select the most disorienting task, and one in which a wrong stationary point attracts the failed arm.",
        ),
    ] = True,
    task: Annotated[str | None, "Task of the joystick: planar or position.", "planar for a planar arm, else position"] = None,
    out: Annotated[FigurePath, "Folder for bank.csv, protocol.yaml and bank.png."] = None,
    json_: JsonOption = False,
) -> None:
    """Generate and select tasks.

    Example: holdfast teleop tasks --seed 1 --out bank
    """
    from holdfast.teleop import choose_tasks, make_task_bank

    model = ArmSourceOptions().resolve_arm(arm)
    rows = _choose_joystick_task(model) if task is None else read_task(task, arm, model)
    with show_status("running the tasks") as update_status:
        bank = make_task_bank(model, per_joint, None, distance=distance, task=rows, seed=seed)
        update_status("choosing")
        choice = choose_tasks(bank, model, rows, count=select, special=special, seed=seed)
        files = [] if out is None else choice.save(out, arm)
    print_result(choice, json_, files)


def _choose_joystick_task(arm: Arm) -> str:
    """Return the default task of the joystick: the plane of an arm that moves in a plane, else the position."""
    from holdfast.model.arm.task import plane_normal

    return "planar" if plane_normal(arm) is not None else "position"
