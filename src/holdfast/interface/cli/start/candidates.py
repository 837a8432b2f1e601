"""Candidates of ``holdfast assess``: arms, their tool attachments and tasks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.cli.values import default_task, read_numbers

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm
    from holdfast.model.arms.spec import ArmSpec

TOOL_HELP = (
    "Tool attachment NAME=x,y,z,roll,pitch,yaw in the frame of the last link: m, and degrees as in URDF, Rz(yaw) Ry(pitch) "
    "Rx(roll). It replaces the tool of the arm. Repeatable."
)


@dataclass(frozen=True)
class Candidate:
    """Arm with a tool and a task.

    Attributes:
        name: Name in reports, and of the folder.
        spec: Arm as given on the command line.
        arm: Arm with the tool.
        task: Task of ``--task``, or the arm's own.
        tool: Name of the tool, or None for the arm's own.
    """

    name: str
    spec: str
    arm: Arm
    task: str
    tool: str | None


def read_candidates(arm_specs: list[ArmSpec], tools: list[str], tasks: list[str]) -> list[Candidate]:
    """Combine every arm with every tool and every task.

    Raises:
        InputError: A tool is not NAME and six numbers, or two candidates have the same name.
        ArmError: There is no such arm.
    """
    from holdfast.studies.assessment.comparison import check_names

    attachments = [read_tool(text) for text in tools]
    candidates = []
    for arm_spec in arm_specs:
        spec, arm = arm_spec.spec, arm_spec.load()
        arm_name = arm_spec.name or (arm.name if spec == arm.name else Path(spec).stem)
        variants: list[tuple[str | None, Arm]] = [(name, arm.with_tool(pose)) for name, pose in attachments]
        for tool, model in variants or [(None, arm)]:
            for task in tasks or [default_task(spec, model)]:
                parts = [arm_name, tool, task if len(tasks) > 1 else None]
                name = "-".join(re.sub(r"[^\w.+-]+", "_", part) for part in parts if part)
                candidates.append(Candidate(name.lstrip("."), spec, model, task, tool))
    check_names([candidate.name for candidate in candidates])
    return candidates


def read_tool(text: str) -> tuple[str, NDArray[np.float64]]:
    """Read ``--tool``; return its name and its pose (4, 4).

    Raises:
        InputError: Not a name and six finite numbers.
    """
    from holdfast.model.arms.tool import tool_pose_from_numbers

    name, equals, numbers_text = text.partition("=")
    name = name.strip()
    if not equals or not re.fullmatch(r"\w[\w.+-]*", name):
        raise InputError(f"--tool '{text}' is not NAME=x,y,z,roll,pitch,yaw; write for example gripper=0,0,0.1,0,0,45 (m, deg)")
    numbers = read_numbers(f"--tool {name}", numbers_text, "6 numbers")
    if len(numbers) != 6:
        raise InputError(f"--tool {name} has {format_count(len(numbers), 'number')}; give 6: x,y,z,roll,pitch,yaw (m, deg)")
    if not np.isfinite(numbers).all():
        raise InputError(f"--tool {name} contains NaN or infinity; give 6 finite numbers")
    return name, tool_pose_from_numbers(numbers)
