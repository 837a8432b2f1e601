"""Text and tables of working ranges found by sampling."""

from __future__ import annotations

from typing import Any

from holdfast.certificates.suggestions.working_ranges import WorkingRanges
from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.printing import TextTable
from holdfast.interface.presentation.solvers.self_motion import format_ranges


def to_dict(working_ranges: WorkingRanges) -> dict[str, Any]:
    """Return the ranges in rad and m, their relative widths, and the numbers of the sample."""
    arm, locks = working_ranges.claim.arm, set(working_ranges.claim.locks)
    return {
        **arm.entry(),
        "task": working_ranges.claim.task,
        "found": working_ranges.ok,
        "working_ranges": dict(zip(arm.joint_names, working_ranges.ranges, strict=True)),
        "relative_widths": dict(zip(arm.joint_names, working_ranges.relative_widths, strict=True)),
        "limiting_joint": working_ranges.limiting_joint,
        "options": working_ranges.options,
        "targets": working_ranges.targets,
        "locked_values_per_joint": working_ranges.values,
        "reached_healthy": working_ranges.healthy,
        "lost": {arm.joint_names[joint]: int(working_ranges.lost[joint]) for joint in sorted(locks)},
        "passed": working_ranges.passed,
        "seconds": working_ranges.seconds,
    }


def tables(working_ranges: WorkingRanges) -> list[TextTable]:
    """Return each range, its width, and the number of sampled targets that its locks lose."""
    rows = []
    columns = working_ranges.claim.arm.joints, working_ranges.ranges, working_ranges.relative_widths
    for joint_index, (joint, limits, relative) in enumerate(zip(*columns, strict=True)):
        factor, unit = joint.display_unit
        loss_text = str(working_ranges.lost[joint_index]) if joint_index in working_ranges.claim.locks else "does not lock"
        width = f"{factor * (limits[1] - limits[0]):.4g} {unit}"
        rows.append([joint.name, format_ranges([limits], joint), width, format_percent(float(relative)), loss_text])
    return [TextTable(["joint", "working range", "width", "fraction of its limits", "targets lost"], rows)]


def next_steps(working_ranges: WorkingRanges, name: str) -> list[str]:
    """Return the proof for every point of the box."""
    return [f"hf.certify({name}.claim)  # for every point of the box, not a sample"] if working_ranges.ok else []
