"""Presentation of stationary points."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.points import StationaryPoints
from holdfast.control.equilibria.stability import REACHED_ERROR, Kind
from holdfast.control.equilibria.system import idle_joints
from holdfast.control.simulation.errors import display_errors, error_kinds
from holdfast.core.formatting import format_number
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.presentation import Column, Fact, Header, Presentation, TableSpec
from holdfast.interface.presentation.simulation.errors import format_errors
from holdfast.interface.report.page import Section

ROWS_PER_KIND = 12  # listed points of each kind
MAX_LISTED_EIGENVALUES = 3  # more eigenvalues are listed as a range
_MAX_DRAWN_ARMS = 3  # drawn arms away from the target
_KIND_CAPTIONS = {
    Kind.SOLUTION: "configurations at the target",
    Kind.SINK: "sinks, at which the arm stops",
    Kind.SADDLE: "saddles, at which hardly any start ends",
    Kind.SOURCE: "sources, at which no start ends",
    Kind.DEGENERATE: "degenerate points, whose stability the linearisation does not decide",
}


def to_dict(points: StationaryPoints) -> dict[str, Any]:
    """Return all points with their kinds; eigenvalues in units of the gain Ke."""
    arm, kinds = points.law.arm, error_kinds(points.law)
    return {
        **arm.entry(),
        "law": points.law.slug,
        "task": points.law.task.name,
        "locked": {arm.joint_names[index]: value for index, value in zip(points.locked, points.at, strict=True)},
        "starts": points.starts,
        "points": [
            {
                "kind": points.kinds[index],
                "q": dict(zip(arm.joint_names, points.q[index], strict=True)),
                **{kind.key: getattr(points, kind.name)[index] for kind in kinds},
                "eigenvalues": points.eigenvalues[index],
                "continuum": points.continuum[index],
                "attracting": points.attracting[index],
                "within_limits": points.within_limits[index],
            }
            for index in range(len(points))
        ],
    }


def present(points: StationaryPoints) -> Presentation:
    """Present whether the arm can stop at its target, away from it, or nowhere."""
    law, table = points.law, _tabulate_points(points)
    is_solution = points.kind == Kind.SOLUTION
    is_trap = ~is_solution & points.attracting
    errors = format_target_errors(points)[is_trap][np.argsort(points.error[is_trap])]
    facts = [
        Fact(kind.word, int((points.kind == kind).sum()), phrase=_KIND_CAPTIONS[kind])
        for kind in Kind
        if (points.kind == kind).any()
    ]
    if errors.size:
        phrase = "from the target, at the closest point at which the arm can stop away from it"
        facts.insert(0, Fact("", str(errors[0]), phrase=phrase))
    omitted_points = len(points) - len(table.rows)
    return Presentation(
        f"Stationary points of {law.arm.name} after an undetected lock",
        _compose_answer(points, is_solution, errors),
        about=f"{law.arm.title}, {law.describe()}; {points.starts:,} starts",
        lines=[*_compose_remarks(points), *[f"{omitted_points} more points; --json prints all."] * bool(omitted_points)],
        facts=facts,
        tables=[table],
        sections=partial(draw_stationary_arms, points),
        method=list_methods(points),
        arm=law.arm,
    )


def list_methods(points: StationaryPoints) -> list[tuple[str, str]]:
    """List how the points were found and classified."""
    return [
        ("Search", f"{points.starts:,} random starts; a point that no start converges to is missed"),
        ("Kinds", "by the eigenvalues of the linearised motion of the healthy joints, in units of the gain Ke"),
        ("Law", points.law.describe()),
    ]


def _compose_answer(points: StationaryPoints, is_solution: NDArray[np.bool_], errors: NDArray[np.str_]) -> str:
    opening = f"With {describe_locks(points)}, the target"
    if not len(points):
        return f"{opening} is not reached in any configuration found, and no point was found at which the arm stops."
    elif not errors.size:
        if is_solution.any():
            return f"{opening} is within reach, and no other point was found at which the arm can stop."
        return f"{opening} is out of reach, and no attracting stationary point was found, so the arm keeps moving."
    else:
        smallest_error, largest_error = errors[[0, -1]]
        trap_text = f"one {f'of {len(errors)} ' * (len(errors) > 1)}attracting stationary point{'s' * (len(errors) > 1)}"
        trap_text += f", {smallest_error}{f' to {largest_error}' * (smallest_error != largest_error)} from it"
        reach_text = "within reach, but the arm can also stop at" if is_solution.any() else "out of reach, and the arm stops at"
        answer = f"{opening} is {reach_text} {trap_text}."
    return answer


def _compose_remarks(points: StationaryPoints) -> list[str]:
    """Compose sentences about joints that do not affect the task, and about points that are not isolated."""
    names = [points.law.arm.joint_names[joint] for joint in idle_joints(points.law) if joint not in points.locked]
    remarks = [f"These joints do not affect the task and are shown at 0: {', '.join(names)}."] if names else []
    for kind in Kind:
        is_continuum = (points.kind == kind) & points.continuum
        if is_continuum.any():
            attracting_count = int((is_continuum & points.attracting).sum())
            attracting_text = "" if kind == Kind.SOLUTION else f", {attracting_count} of them attracting"
            remarks.append(
                f"{int(is_continuum.sum())} points of kind {kind.word} are samples of sets of points that are not isolated"
                f"{attracting_text}."
            )
    return remarks


def _tabulate_points(points: StationaryPoints) -> TableSpec:
    """Tabulate the first points of each kind, one row for each; joints in degrees or m."""
    joints, kinds, attracting = points.law.arm.joints, points.kinds, points.attracting
    errors = display_errors(points.law, points.q, points.error, points.target)
    columns: list[Column] = [
        "kind",
        *[Header(f"{joint.name}, {joint.display_unit[1]}", digits=7) for joint in joints],
        *[Header(f"{kind.text}, {kind.unit}", aligned=False) for kind in error_kinds(points.law)],
        "eigenvalues, Ke",
        "",
    ]
    rows = []
    for index, kind in enumerate(kinds):
        if (points.kind[:index] == points.kind[index]).sum() >= ROWS_PER_KIND:
            continue
        in_continuum = points.continuum[index]
        notes = ["not isolated"] * bool(in_continuum)
        notes += ["attracting"] * bool(in_continuum and points.error[index] > REACHED_ERROR and attracting[index])
        notes += ["beyond limits"] * bool(not points.within_limits[index])
        values = [joint.display_unit[0] * position for joint, position in zip(joints, points.q[index], strict=True)]
        values += [error[index] for error in errors]
        rows.append([kind, *values, _format_eigenvalues(points.eigenvalues[index]), ", ".join(notes)])
    return TableSpec("Stationary points", columns, rows)


def describe_locks(points: StationaryPoints) -> str:
    """Describe the locked joints and their values, for example ``joint2 locked at 140 deg``."""
    joints = points.law.arm.joints
    locks = [(joints[index], joints[index].display_unit, value) for index, value in zip(points.locked, points.at, strict=True)]
    return ", ".join(f"{joint.name} locked at {factor * value:.4g} {unit}" for joint, (factor, unit), value in locks)


def draw_stationary_arms(points: StationaryPoints) -> list[Section]:
    """Draw the arm at its target, and at the first points at which it stops elsewhere."""
    is_solution = points.kind == Kind.SOLUTION
    chosen = [
        (np.flatnonzero(is_solution)[:1], "at its target"),
        (np.flatnonzero(~is_solution & points.attracting)[:_MAX_DRAWN_ARMS], ""),
    ]
    labels = {index: label or f"{points.kinds[index]} {index + 1}" for indices, label in chosen for index in indices}
    if not labels:
        return []
    section = build_view_section(
        "The arm at its stationary points",
        points.law.arm,
        points.q[list(labels)],
        f"Configurations at which the arm can stop: {', '.join(labels.values())}.",
        name="stops",
        label="The arm at its stationary points",
        labels=list(labels.values()) if len(labels) > 1 else (),
        locked=points.locked,
        task=points.law.task,
        lost=False,
        targets=[points.target],
    )
    return [section]


def format_target_errors(points: StationaryPoints) -> NDArray[np.str_]:
    """Format the position and orientation errors of each point (P,), as far as the task prescribes them."""
    pairs = zip(points.position_error, points.angle_error, strict=True)
    return np.array([format_errors(points.law, position, angle) for position, angle in pairs], dtype=np.str_)


def _format_eigenvalues(values: Any) -> str:
    """Format the eigenvalues; if there are many, the ends of their range."""
    listed = values if len(values) <= MAX_LISTED_EIGENVALUES else values[[0, -1]]
    return (", " if len(values) <= MAX_LISTED_EIGENVALUES else " to ").join(map(_format_complex, listed))


def _format_complex(value: np.complex128) -> str:
    return format_number(value.real, 4) if abs(value.imag) < 1e-9 else f"{format_number(value.real, 4)}{value.imag:+.3g}i"
