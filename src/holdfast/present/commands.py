"""The command and the region file that make a run again."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import yaml
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast import arms
from holdfast.arm.model import Arm
from holdfast.arm.poses import zyx_angles
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.arms.tool import attachment, attachment_text
from holdfast.assessment.assessment import Assessment
from holdfast.failures import FailureSets, failure_sets
from holdfast.grammar import ROWS, TASKS
from holdfast.regions.region import Region
from holdfast.regions.weights import Density, swap_angles
from holdfast.registry import INDICES
from holdfast.report.page import Block, Code, Text

Array = NDArray[np.float64]

_POSES_FILE = "poses.csv"
_CAPSULES_FILE = "capsules.yaml"
_CELL_FILE = "cell.yaml"
_MOST_POSES = 50  # of a list in a report; a results folder holds any number


def command_line(a: Assessment) -> tuple[str | None, str]:
    """The command that makes the run again from ``region.yaml``, or None, and a remark."""
    index, task = a.index, a.index.task
    if not a.region.storable:
        return None, "The region has a function of your own, so no command line makes this run again; keep the script."
    if not INDICES.storable(index):
        return None, "The index is a function of your own, so no command line makes this run again; keep the script."
    asked = task_option(a.arm, task)
    if asked is None:
        return None, "The task is of your own making, so no command line makes this run again; keep the script."
    spec, words, remark = arms.command_words(a.arm)
    tool = {}
    known_arm = arms.load(a.arm.name) if a.arm.name in arms.names() else None
    if known_arm is not None and remark and replace(a.arm, tool=known_arm.tool).fingerprint == known_arm.fingerprint:
        spec, remark, text = a.arm.name, "", attachment_text(a.arm)
        words.clear()
        tool = {"tool": f"tool={text}"}
        if known_arm.with_tool(attachment(text.split(","))).fingerprint != a.arm.fingerprint:
            remark = "the tool to 12 digits"
    options = {**tool, "region": "region.yaml", "index": index.label, "task": asked}
    if task.length != 1.0:
        options["length"] = repr(task.length)
    if index.failures != failure_sets(a.arm, "single"):
        options["failures"] = failures_option(a.arm, index.failures)
    options |= {"poses": str(a.poses), "seed": str(a.seed), "sampling": a.sampling}
    if a.region.kind != "joints":
        options["restarts"] = str(a.restarts)
    apart = _clearance_options(a)
    locks = [f"--lock {shlex.quote(f'{a.arm.joint_names[k]}={angle!r}')}" for k, angle in a.plan.lock_at]
    words += [f"--{name} {shlex.quote(value)}" for name, value in options.items()]
    flags = [*(["--optimise"] if a.plan.optimise else []), *(["--after-lock"] if a.plan.after_lock else [])]
    return on_lines(f"holdfast assess {shlex.quote(spec)}", [*words, *flags, *apart, *locks]), remark


def pose_command(arm: Arm, pose: Array) -> str:
    """Return the command that finds the best configuration of a pose (4, 4), with the pose as roll, pitch, yaw in degrees."""
    spec, words, _ = arms.command_words(arm)
    numbers = [*pose[:3, 3].tolist(), *np.rad2deg(zyx_angles(pose[:3, :3])[::-1]).tolist()]
    text = ",".join(f"{round(x, 9) + 0.0:.10g}" for x in numbers)
    return " ".join([f"holdfast optimise {shlex.quote(spec)}", *words, f'--pose="{text}"'])


def on_lines(command: str, words: Iterable[str]) -> str:
    """A command with its options, on lines that a page holds, as a shell takes them."""
    lines = [command]
    for word in words:
        if len(lines[-1]) + len(word) > 90:
            lines[-1] += " \\"
            lines.append("    " + word)
        else:
            lines[-1] += " " + word
    return "\n".join(lines)


def _clearance_options(a: Assessment) -> list[str]:
    """What says how clear of itself the arm stays, where that is not what a run does anyway."""
    clearance, arm = a.plan.clearance, a.arm
    planar = plane_normal(arm) is not None
    looks = a.plan.optimise and not planar  # unless told otherwise
    if clearance is None:
        return ["--no-clearance"] if looks else []
    around = [] if clearance.cell is None else [f"--cell {_CELL_FILE}"]
    usual = _usual_shape(a)
    if not clearance.itself and not (usual and planar):
        around.append("--no-clearance")
    looks = looks or (clearance.cell is not None and clearance.itself != planar) or not clearance.itself
    radius = clearance.capsules.radius_along(arm)
    if usual:
        words = [] if looks else ["--clearance"]
    else:
        words = [f"--capsules {_CAPSULES_FILE}"] if radius is None else [f"--radius {radius!r}"]
    kept = a.plan.optimise or clearance.cell is not None
    return [*around, *words, *([f"--margin {a.plan.margin!r}"] if a.plan.margin and kept else [])]


def _usual_shape(a: Assessment) -> bool:
    """Whether the shape of the arm is the one that is taken where none is given."""
    clearance = a.plan.clearance
    if clearance is None or clearance.capsules.covers:
        return True
    known = arms.load(a.arm.name) if a.arm.name in arms.names() else None
    from holdfast.clearance.cover import shape_of  # takes long to import

    covered = known is not None and known.fingerprint == a.arm.fingerprint and shape_of(known).covers
    return clearance.capsules.assumed(a.arm) and not covered


def capsule_files(a: Assessment) -> list[Block]:
    """The capsule file and the cell file that the command needs, if any, to copy."""
    clearance = a.plan.clearance
    if clearance is None:
        return []
    files = {}
    if clearance.capsules.radius_along(a.arm) is None and not _usual_shape(a):
        files[_CAPSULES_FILE] = clearance.capsules.to_dict(a.arm)
    if clearance.cell is not None:
        files[_CELL_FILE] = clearance.cell.to_dict()
    made = [
        (name, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100))
        for name, data in files.items()
    ]
    return [Code(text.rstrip(), Markup("and <code>{}</code>:").format(name)) for name, text in made]


def task_option(arm: Arm, task: Task) -> str | None:
    """What ``--task`` says for a task, if it can."""
    if task.name in TASKS:
        standard = as_task(arm, task.name, task.length)
        return task.name if standard.frame == task.frame and np.array_equal(standard.rows, task.rows) else None
    picked = task.rows.argmax(axis=1)
    return f"{task.frame}:{','.join(ROWS[k] for k in picked)}" if np.array_equal(np.eye(6)[picked], task.rows) else None


def failures_option(arm: Arm, failures: FailureSets) -> str:
    """What ``--failures`` says: how many joints fail together, or the sets."""
    size = len(failures[0])
    if size < arm.n and failures == failure_sets(arm, size):
        return str(size)
    plain = not any(c in name for name in arm.joint_names for c in "+;")
    text = "; ".join("+".join(arm.joint_names[k] if plain else str(k + 1) for k in f) for f in failures)
    return text + ";" if text.isdigit() else text  # a lone number would be how many


def region_file(region: Region) -> str:
    """The region as the YAML text that :meth:`Region.load` reads, with every digit."""
    center, size = list(region.center), list(region.size)
    data: dict[str, object] = {"format": 2, "name": region.name, "angles": "rad"}
    if region.listed is not None:
        data["poses"] = _POSES_FILE
    elif region.kind in ("box", "cone"):
        box: dict[str, object] = {"center": center[:3], "size": size[:3]}
        if region.kind == "cone":
            box["cone"] = {"axis": list(region.axis), "within": float(np.rad2deg(region.within))}
        else:
            box |= {"rpy_center": center[:2:-1], "rpy_size": size[:2:-1]}
        data["box"] = box
        if isinstance(region.weight, Density):
            box["density"] = swap_angles(region.weight.to_dict())
    else:
        low = [c - s / 2 for c, s in zip(center, size, strict=True)]
        data["joints"] = {"lower": low, "upper": [c + s / 2 for c, s in zip(center, size, strict=True)]}
    text: str = yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100)
    return text.rstrip()


def region_files(region: Region) -> list[Block]:
    """The files that the command needs, to copy."""
    blocks: list[Block] = [Code(region_file(region), Markup("with <code>region.yaml</code>:"))]
    if region.listed is not None and len(region.listed) <= _MOST_POSES:
        blocks.append(Code(region.listed.table(), Markup("and <code>{}</code>:").format(_POSES_FILE)))
    elif region.listed is not None:
        where = Markup("and <code>{}</code>, the list of poses; the results folder holds it in <code>run.json</code>.")
        blocks.append(Text(where.format(_POSES_FILE)))
    return blocks
