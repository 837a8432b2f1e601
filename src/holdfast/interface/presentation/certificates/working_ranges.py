"""Presentation of working ranges found by sampling."""

from __future__ import annotations

from typing import Any

from holdfast.certificates.suggestions.working_ranges import WorkingRanges
from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.presentation import Column, Header, Presentation, TableSpec
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


def present(working_ranges: WorkingRanges) -> Presentation:
    """Present whether ranges were found, the sample, the limiting joint, and the range of each joint."""
    arm, ranges, lost = working_ranges.claim.arm, working_ranges.ranges, working_ranges.lost
    targets, relative_widths = working_ranges.targets, working_ranges.relative_widths.tolist()
    limiting = arm.joint_index(working_ranges.limiting_joint)
    factor, unit = arm.joints[limiting].display_unit
    span = f"{factor * ranges[limiting, 0]:.4g} to {factor * ranges[limiting, 1]:.4g} {unit}"
    if working_ranges.ok:
        answer = (
            f"Found working ranges: within them, the healthy arm reaches all {targets} sampled targets. So does the arm with "
            f"one joint locked at any of {working_ranges.values} sampled values of its range. A sample proves nothing."
        )
        lines = [
            f"The limiting joint is {arm.joint_names[limiting]}: its range of {span} is "
            f"{format_percent(relative_widths[limiting])} of its limits."
        ]
    else:
        reason, lines = f"the healthy arm reaches {working_ranges.healthy}", []
        if lost[limiting]:
            reason += f", and locks of {arm.joint_names[limiting]}, whose range is {span}, make {lost[limiting]} unreachable"
        answer = (
            f"Not found: with the best working ranges, the arm reaches {working_ranges.passed} of {targets} sampled targets "
            f"({format_percent(working_ranges.passed / targets)}) whichever joint locks; {reason}."
        )
    columns: list[Column] = [
        "joint",
        "working range",
        Header("width", [joint.display_unit[1] for joint in arm.joints], aligned=False),
        Header("fraction of its limits", style="percent"),
        "targets lost",
    ]
    rows = [
        [
            joint.name,
            format_ranges([limits], joint),
            float(joint.display_unit[0] * (limits[1] - limits[0])),
            relative_width,
            int(lost[index]) if index in working_ranges.claim.locks else "does not lock",
        ]
        for index, (joint, limits, relative_width) in enumerate(zip(arm.joints, ranges, relative_widths, strict=True))
    ]
    return Presentation(f"Working ranges of {arm.name}", answer, lines=lines, tables=[TableSpec("", columns, rows)], arm=arm)
