"""Command line, region file, and shape files that reproduce a run."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import yaml
from markupsafe import Markup

from holdfast.core.formatting import capitalise_first
from holdfast.core.labels import TASK_ROW_NAMES, TASK_SIZES
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.core.typing import FloatArray
from holdfast.interface.report.page import Block, Code, Text
from holdfast.kinematics.regions.region import Region
from holdfast.kinematics.regions.weights import Density, swap_roll_and_yaw
from holdfast.model import arms
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import zyx_angles
from holdfast.model.arm.task import Task, as_task, plane_normal
from holdfast.model.arms.tool import format_tool_pose, tool_pose_from_numbers
from holdfast.model.failure_modes import FailureSets, failure_sets
from holdfast.studies.assessment.assessment import Assessment

_POSES_FILE = "poses.csv"
_CAPSULES_FILE = "capsules.yaml"
_CELL_FILE = "cell.yaml"
_MAX_LISTED_POSES = 50  # poses of a list that a report contains; a results folder contains all


def build_command_line(assessment: Assessment) -> tuple[str | None, str]:
    """Return the command that reproduces the run with ``region.yaml``, and a remark; None and the reason if there is none."""
    index, task = assessment.index, assessment.index.task
    if not assessment.region.storable:
        return None, "The region has a user-defined weight function, so no command reproduces this run; keep the script."
    if not INDEX_REGISTRY.is_storable(index):
        return None, "The index is a user-defined class, so no command reproduces this run; keep the script."
    task_text = format_task_option(assessment.arm, task)
    if task_text is None:
        return None, "The task has user-defined rows, so no command reproduces this run; keep the script."
    spec, option_words, remark = arms.command_words(assessment.arm)
    tool = {}
    known_arm = arms.load(assessment.arm.name) if assessment.arm.name in arms.names() else None
    if known_arm is not None and remark and replace(assessment.arm, tool=known_arm.tool).fingerprint == known_arm.fingerprint:
        spec, remark, text = assessment.arm.name, "", format_tool_pose(assessment.arm)
        option_words.clear()
        tool = {"tool": f"tool={text}"}
        if known_arm.with_tool(tool_pose_from_numbers(text.split(","))).fingerprint != assessment.arm.fingerprint:
            remark = "the tool pose is rounded to 12 digits"
    options = {**tool, "region": "region.yaml", "index": index.label, "task": task_text}
    if task.length != 1.0:
        options["length"] = repr(task.length)
    if index.failures != failure_sets(assessment.arm, "single"):
        options["failures"] = format_failures_option(assessment.arm, index.failures)
    options |= {"poses": str(assessment.poses), "seed": str(assessment.seed), "sampling": assessment.sampling}
    if assessment.region.kind != "joints":
        options["restarts"] = str(assessment.restarts)
    clearance_options = _clearance_options(assessment)
    locks = [
        f"--lock {shlex.quote(f'{assessment.arm.joint_names[joint]}={angle!r}')}" for joint, angle in assessment.plan.lock_at
    ]
    option_words += [f"--{name} {shlex.quote(value)}" for name, value in options.items()]
    switches = [
        *(["--optimise"] if assessment.plan.optimise else []),
        *(["--after-lock"] if assessment.plan.after_lock else []),
    ]
    return wrap_command(f"holdfast assess {shlex.quote(spec)}", [*option_words, *switches, *clearance_options, *locks]), remark


def build_pose_command(arm: Arm, pose: FloatArray) -> str:
    """Return the command that finds the best configuration of a pose (4, 4), with the pose as roll, pitch, yaw in degrees."""
    spec, option_words, _ = arms.command_words(arm)
    values = [*pose[:3, 3].tolist(), *np.rad2deg(zyx_angles(pose[:3, :3])[::-1]).tolist()]
    text = ",".join(f"{round(value, 9) + 0.0:.10g}" for value in values)
    return " ".join([f"holdfast optimise {shlex.quote(spec)}", *option_words, f'--pose="{text}"'])


def wrap_command(command: str, options: Iterable[str]) -> str:
    """Wrap a command with its options to the width of a page, in shell syntax."""
    lines = [command]
    for word in options:
        if len(lines[-1]) + len(word) > 90:
            lines[-1] += " \\"
            lines.append("    " + word)
        else:
            lines[-1] += " " + word
    return "\n".join(lines)


def _clearance_options(assessment: Assessment) -> list[str]:
    """Return the options for the clearance of the arm from itself and its cell, where they differ from the defaults."""
    clearance, arm = assessment.plan.clearance, assessment.arm
    planar = plane_normal(arm) is not None
    default_on = assessment.plan.optimise and not planar  # the default of the command
    if clearance is None:
        return ["--no-clearance"] if default_on else []
    cell_options = [] if clearance.cell is None else [f"--cell {_CELL_FILE}"]
    is_default_shape = _has_default_shape(assessment)
    if not clearance.itself and not (is_default_shape and planar):
        cell_options.append("--no-clearance")
    default_on = default_on or (clearance.cell is not None and clearance.itself != planar) or not clearance.itself
    radius = clearance.capsules.radius_along(arm)
    if is_default_shape:
        shape_options = [] if default_on else ["--clearance"]
    else:
        shape_options = [f"--capsules {_CAPSULES_FILE}"] if radius is None else [f"--radius {radius!r}"]
    has_margin = assessment.plan.optimise or clearance.cell is not None
    return [
        *cell_options,
        *shape_options,
        *([f"--margin {assessment.plan.margin!r}"] if assessment.plan.margin and has_margin else []),
    ]


def _has_default_shape(assessment: Assessment) -> bool:
    """Return whether the shape of the arm is the default one."""
    clearance = assessment.plan.clearance
    if clearance is None or clearance.capsules.covers:
        return True
    library_arm = arms.load(assessment.arm.name) if assessment.arm.name in arms.names() else None
    from holdfast.model.collision.cover import choose_capsules  # takes long to import

    has_default_cover = (
        library_arm is not None
        and library_arm.fingerprint == assessment.arm.fingerprint
        and choose_capsules(library_arm).covers
    )
    return clearance.capsules.is_assumed(assessment.arm) and not has_default_cover


def build_shape_file_blocks(assessment: Assessment) -> list[Block]:
    """Return the capsule file and the cell file that the command needs, if any, as blocks to copy."""
    clearance = assessment.plan.clearance
    if clearance is None:
        return []
    files = {}
    if clearance.capsules.radius_along(assessment.arm) is None and not _has_default_shape(assessment):
        files[_CAPSULES_FILE] = clearance.capsules.to_dict(assessment.arm)
    if clearance.cell is not None:
        files[_CELL_FILE] = clearance.cell.to_dict()
    texts = [
        (name, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100))
        for name, data in files.items()
    ]
    return [Code(text.rstrip(), Markup("and <code>{}</code>:").format(name)) for name, text in texts]


def format_task_option(arm: Arm, task: Task) -> str | None:
    """Return the value of ``--task`` for a task; None if the option cannot express it."""
    if task.name in TASK_SIZES:
        standard = as_task(arm, task.name, task.length)
        return task.name if standard.frame == task.frame and np.array_equal(standard.rows, task.rows) else None
    components = task.rows.argmax(axis=1)
    return (
        f"{task.frame}:{','.join(TASK_ROW_NAMES[component] for component in components)}"
        if np.array_equal(np.eye(6)[components], task.rows)
        else None
    )


def format_failures_option(arm: Arm, failures: FailureSets) -> str:
    """Return the value of ``--failures``: the number of joints that fail together, or the sets."""
    set_size = len(failures[0])
    if set_size < arm.n and failures == failure_sets(arm, set_size):
        return str(set_size)
    names_are_plain = not any(separator in name for name in arm.joint_names for separator in "+;")
    text = "; ".join(
        "+".join(arm.joint_names[joint] if names_are_plain else str(joint + 1) for joint in failure) for failure in failures
    )
    return text + ";" if text.isdigit() else text  # a lone number would be how many


def format_region_file(region: Region) -> str:
    """Return the region as the YAML text that :meth:`Region.load` reads, with every digit."""
    center, size = list(region.center), list(region.size)
    data: dict[str, object] = {"format": 2, "name": region.name, "angles": "rad"}
    if region.listed is not None:
        data["poses"] = _POSES_FILE
    elif region.kind in ("box", "cone"):
        box: dict[str, object] = {"center": center[:3], "size": size[:3]}
        if region.kind == "cone":
            box["cone"] = {"axis": list(region.axis), "within": float(np.rad2deg(region.max_tilt))}
        else:
            box |= {"rpy_center": center[:2:-1], "rpy_size": size[:2:-1]}
        data["box"] = box
        if isinstance(region.weight, Density):
            box["density"] = swap_roll_and_yaw(region.weight.to_dict())
    else:
        lower = [middle - extent / 2 for middle, extent in zip(center, size, strict=True)]
        data["joints"] = {"lower": lower, "upper": [middle + extent / 2 for middle, extent in zip(center, size, strict=True)]}
    text: str = yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100)
    return text.rstrip()


def build_region_file_blocks(region: Region) -> list[Block]:
    """Return the files that the command needs, as blocks to copy."""
    blocks: list[Block] = [Code(format_region_file(region), Markup("with <code>region.yaml</code>:"))]
    if region.listed is not None and len(region.listed) <= _MAX_LISTED_POSES:
        blocks.append(Code(region.listed.to_csv(), Markup("and <code>{}</code>:").format(_POSES_FILE)))
    elif region.listed is not None:
        remark = Markup("and <code>{}</code>, the list of poses; the results folder holds it in <code>run.json</code>.")
        blocks.append(Text(remark.format(_POSES_FILE)))
    return blocks


def build_command_block(command: str, remark: str) -> Code:
    """Return a command to copy, below a remark on it."""
    return Code(command, remark and f"{capitalise_first(remark)}:")


def build_rerun_blocks(assessment: Assessment) -> list[Block]:
    """Build the command that repeats the run with the files that it needs, or the reason why there is none."""
    command, remark = build_command_line(assessment)
    if command is None:
        return [Text(remark)]
    return [
        build_command_block(command, remark),
        *build_region_file_blocks(assessment.region),
        *build_shape_file_blocks(assessment),
    ]
