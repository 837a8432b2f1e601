"""Text, tables, and JSON of stationary points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.equilibria.points import StationaryPoints
from holdfast.control.equilibria.stability import REACHED_ERROR, Kind
from holdfast.control.simulation.errors import display_errors, error_kinds
from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant, print_table
from holdfast.interface.presentation.simulation.errors import format_errors

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rich.console import Console

CONSOLE_ROWS_PER_KIND = 12  # points of a kind on the console
PAGE_ROWS = 60  # on a page
MAX_LISTED_EIGENVALUES = 3  # eigenvalues: of more only the ends of their range
_MAX_DRAWN_ARMS = 3  # that are drawn off the target
_KIND_CAPTIONS = {
    Kind.SOLUTION: "configurations at the target",
    Kind.SINK: "sinks: the arm stops there",
    Kind.SADDLE: "saddles: hardly any start ends there",
    Kind.SOURCE: "sources: no start ends there",
    Kind.DEGENERATE: "points where the linearisation does not decide",
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


def tables(points: StationaryPoints) -> list[TextTable]:
    """Tabulate the points, one row for each; joints in degrees or m."""
    joints = points.law.arm.joints
    titles = [f"{kind.text}, {kind.unit}" for kind in error_kinds(points.law)]
    errors = display_errors(points.law, points.q, points.error, points.target)
    header = ["kind", *(f"{joint.name}, {joint.display_unit[1]}" for joint in joints), *titles, "eigenvalues, Ke", ""]
    rows = []
    attracting = points.attracting
    for index, kind in enumerate(points.kinds):
        in_continuum = points.continuum[index]
        notes = ["one of many"] if in_continuum else []
        notes += ["attracting"] if in_continuum and points.error[index] > REACHED_ERROR and attracting[index] else []
        notes += [] if points.within_limits[index] else ["beyond limits"]
        values = [f"{joint.display_unit[0] * position:.4f}" for joint, position in zip(joints, points.q[index], strict=True)]
        values += [format_significant(error[index]) for error in errors]
        rows.append([kind, *values, _format_eigenvalues(points.eigenvalues[index]), ", ".join(notes)])
    return [TextTable(header, rows)]


def describe_locks(points: StationaryPoints) -> str:
    """Describe the locked joints and their values, for example ``joint2 locked at 140 deg``."""
    joints = points.law.arm.joints
    locks = [
        (joints[joint_index], joints[joint_index].display_unit, value)
        for joint_index, value in zip(points.locked, points.at, strict=True)
    ]
    return ", ".join(f"{joint.name} locked at {factor * value:.4g} {unit}" for joint, (factor, unit), value in locks)


def story(points: StationaryPoints) -> PageContent:
    """Compose the report: whether the arm can stop at its target, off it, or nowhere."""
    law = points.law
    is_solution = points.kind == Kind.SOLUTION
    is_trap = ~is_solution & points.attracting
    errors = format_target_errors(points)[is_trap][np.argsort(points.error[is_trap])]
    opening = f"With {describe_locks(points)} the target"
    if not len(points):
        answer = f"{opening} is not reached in any configuration found, and no point at which the arm stops was found either."
    elif not errors.size:
        reached = "is within reach, and nothing else was found at which the arm can stop" if is_solution.any() else ""
        answer = (
            f"{opening} {reached or 'is out of reach, and no stationary point that attracts was found: the arm keeps moving'}."
        )
    else:
        smallest_error, largest_error = errors[[0, -1]]
        trap_text = "a stationary point" if len(errors) == 1 else f"one of {len(errors)} stationary points that attract"
        trap_text += (
            f", {smallest_error} off it" if smallest_error == largest_error else f", {smallest_error} to {largest_error} off it"
        )
        reach_text = "within reach, but the arm can also stop at" if is_solution.any() else "out of reach, and the arm stops at"
        answer = f"{opening} is {reach_text} {trap_text}."
    facts = [(f"{int((points.kind == kind).sum()):,}", _KIND_CAPTIONS[kind]) for kind in Kind if (points.kind == kind).any()]
    if errors.size:
        facts.insert(0, (errors[0], "off the target, at the nearest point that holds the arm away from it"))
    lines = (
        [*map(capitalise_first, points.describe()[1:])] if points.continuum.any() or _mentions_undetected_locks(points) else []
    )
    return PageContent(
        f"Where {law.arm.name} can stop with a lock that its controller does not know of",
        answer,
        about=f"{law.arm.name}, {law.describe()}",
        facts=facts[:5],
        lines=[f"{sentence}." for sentence in lines],
        views=[*_draw_stationary_arms(points, is_solution, is_trap)],
        tables=[table._replace(rows=table.rows[:PAGE_ROWS]) for table in tables(points)],
        method=[
            ("Search", f"{points.starts:,} random starts; points that none of them converges to are missed"),
            ("Kinds", "by the eigenvalues of the linearised motion of the healthy joints, in units of the gain Ke"),
            ("Law", law.describe()),
            ("Listed", f"the first {min(PAGE_ROWS, len(points))} of {len(points)}; --json has all"),
        ],
        arm=law.arm,
    )


def _mentions_undetected_locks(points: StationaryPoints) -> bool:
    return any("does not notice" in line for line in points.describe())


def _draw_stationary_arms(points: StationaryPoints, solved: Any, holds: Any) -> list[tuple[str, list[Any]]]:
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    chosen = [(np.flatnonzero(solved)[:1], "at its target"), (np.flatnonzero(holds)[:_MAX_DRAWN_ARMS], "")]
    labeled_points = [(index, label or f"{points.kinds[index]} {index + 1}") for indices, label in chosen for index in indices]
    if not labeled_points:
        return []
    arm_scene = scene(
        points.law.arm,
        points.q[[index for index, _ in labeled_points]],
        labels=[label for _, label in labeled_points] if len(labeled_points) > 1 else (),
        locked=points.locked,
        task=points.law.task,
        lost=False,
        targets=[points.target],
    )
    picture = Picture(
        arm_scene.to_html("stops", "The arm where it can stop"),
        f"Where it can stop: {', '.join(name for _, name in labeled_points)}.",
    )
    return [("The arm where it stops", [picture])]


def show(points: StationaryPoints, out: Console) -> None:
    """Print the sentences, and the first points of each kind."""
    for line in points.describe():
        out.print(line, markup=False, soft_wrap=True)
    (table,) = tables(points)
    kind = points.kind
    shown_rows = [row for index, row in enumerate(table.rows) if (kind[:index] == kind[index]).sum() < CONSOLE_ROWS_PER_KIND]
    print_table(out, table._replace(rows=shown_rows))
    if len(shown_rows) < len(points):
        out.print(f"and {len(points) - len(shown_rows)} more; --json has all", soft_wrap=True)


def format_target_errors(points: StationaryPoints) -> NDArray[np.str_]:
    """Return the position and orientation errors of each point (P,) in words, as far as the task prescribes them."""
    pairs = zip(points.position_error, points.angle_error, strict=True)
    return np.array([format_errors(points.law, position, angle) for position, angle in pairs], dtype=np.str_)


def _format_eigenvalues(values: Any) -> str:
    """Format the eigenvalues; if there are many, the ends of their range."""
    listed = values if len(values) <= MAX_LISTED_EIGENVALUES else values[[0, -1]]
    return (", " if len(values) <= MAX_LISTED_EIGENVALUES else " to ").join(map(_format_complex, listed))


def _format_complex(value: np.complex128) -> str:
    return format_significant(value.real) if abs(value.imag) < 1e-9 else f"{format_significant(value.real)}{value.imag:+.3g}i"
