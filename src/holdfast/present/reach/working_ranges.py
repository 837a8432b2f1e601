"""Working ranges that were found: numbers and a table."""

from __future__ import annotations

from typing import Any

from holdfast.present.printing import Rows
from holdfast.present.solvers.self_motions import ranges
from holdfast.reach.working_ranges import WorkingRanges
from holdfast.words import percent


def to_dict(found: WorkingRanges) -> dict[str, Any]:
    """Return the ranges in rad and m, their relative widths, and the numbers of the sample."""
    arm, locks = found.claim.arm, set(found.claim.locks)
    return {
        **arm.entry(),
        "task": found.claim.task,
        "found": found.ok,
        "working_ranges": dict(zip(arm.joint_names, found.ranges, strict=True)),
        "relative_widths": dict(zip(arm.joint_names, found.relative_widths, strict=True)),
        "limiting_joint": found.limiting_joint,
        "options": found.options,
        "targets": found.targets,
        "locked_values_per_joint": found.values,
        "reached_healthy": found.healthy,
        "lost": {joint.name: int(found.lost[k]) for k, joint in enumerate(arm.joints) if k in locks},
        "passed": found.passed,
        "seconds": found.seconds,
    }


def tables(found: WorkingRanges) -> list[Rows]:
    """Return each range, its width, and the number of sampled targets that its locks lose."""
    rows = []
    for k, (joint, pair, relative) in enumerate(zip(found.claim.arm.joints, found.ranges, found.relative_widths, strict=True)):
        factor, unit = joint.shown
        lost = str(found.lost[k]) if k in found.claim.locks else "does not lock"
        width = f"{factor * (pair[1] - pair[0]):.4g} {unit}"
        rows.append([joint.name, ranges([pair], joint), width, percent(float(relative)), lost])
    return [Rows(["joint", "working range", "width", "fraction of its limits", "targets lost"], rows)]


def next_steps(found: WorkingRanges, name: str) -> list[str]:
    """Return the proof for every point of the box."""
    return [f"hf.certify({name}.claim)  # for every point of the box, not a sample"] if found.ok else []
