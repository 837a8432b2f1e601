"""``holdfast tolerant-workspace``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import numpy as np

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import TASK_NAMES_HELP, ArmArgument, SeedOption
from holdfast.interface.cli.values import read_joint, read_numbers, read_task

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm


def command(
    arm: ArmArgument,
    task: Annotated[str | None, f"{TASK_NAMES_HELP} Default: planar for an arm that moves in a plane, else position."] = None,
    limit: Annotated[
        list[str] | None, "Artificial limits JOINT=LOW,HIGH in degrees (prismatic: m). Repeatable. Default: the joint limits."
    ] = None,
    optimise: Annotated[bool, "Search for the artificial limits that maximise the area or volume of the region."] = False,
    rotation: Annotated[str | None, "Tool orientation, if the task has one: roll,pitch,yaw in degrees. Default: 0,0,0."] = None,
    points: Annotated[int, "Number of sampled points (planar arms of three joints need none)."] = 1000,
    angles: Annotated[int, "Number of locked values that are tried per joint."] = 24,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Compute the points that stay reachable after any single lock.

    Example: holdfast tolerant-workspace planar-3r --optimise --plot region.png
    """
    from holdfast.model.arm.formats.urdf import rpy_rotation
    from holdfast.model.arm.task import plane_normal

    model = chain.resolve_arm(arm)
    rows = read_task(task, arm, model) if task else "planar" if plane_normal(model) is not None else "position"
    limits = {read_joint(model, text.partition("=")[0]): _read_limit(model, text) for text in limit or []}
    tool_rotation = None
    if rotation is not None:
        values = read_numbers("--rotation", rotation, "roll,pitch,yaw (degrees)")
        if values.size != 3 or not np.isfinite(values).all():
            raise InputError(f"--rotation has {format_count(values.size, 'number')}; give roll,pitch,yaw in degrees")
        tool_rotation = rpy_rotation(np.deg2rad(values).tolist())
    region = hf.tolerant_workspace(
        model, rows, limits or None, optimise=optimise, rotation=tool_rotation, points=points, angles=angles, seed=seed
    )
    output.print_result(region)


def _read_limit(arm: Arm, text: str) -> tuple[float, float]:
    joint, _, values = text.partition("=")
    numbers = read_numbers(f"--limit '{text}'", values, "JOINT=LOW,HIGH")
    if numbers.size != 2:
        raise InputError(f"--limit '{text}' has {format_count(numbers.size, 'number')} after =; give both limits")
    factor = arm.joints[read_joint(arm, joint)].display_unit[0]
    return float(numbers[0] / factor), float(numbers[1] / factor)
