"""Stationary points in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.equilibria.points import StationaryPoints
from holdfast.equilibria.stability import REACHED, Kind
from holdfast.present.printing import Rows, number, print_rows
from holdfast.present.simulation.errors import error_text
from holdfast.present.story import Story
from holdfast.simulation.errors import error_kinds, shown_errors
from holdfast.words import capitalised

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rich.console import Console

SHOWN = 12  # points of a kind on the console
ROWS = 60  # on a page
MANY = 3  # eigenvalues: of more only the ends of their range
_ARMS = 3  # that are drawn off the target
_COUNTED = {
    Kind.SOLUTION: "configurations at the target",
    Kind.SINK: "sinks: the arm stops there",
    Kind.SADDLE: "saddles: hardly any start ends there",
    Kind.SOURCE: "sources: no start ends there",
    Kind.DEGENERATE: "points where the linearisation does not decide",
}


def to_dict(points: StationaryPoints) -> dict[str, Any]:
    """All points by what they are; eigenvalues in units of the gain Ke."""
    arm, kinds = points.law.arm, error_kinds(points.law)
    return {
        **arm.entry(),
        "law": points.law.slug,
        "task": points.law.task.name,
        "locked": {arm.joint_names[k]: x for k, x in zip(points.locked, points.at, strict=True)},
        "starts": points.starts,
        "points": [
            {
                "kind": points.kinds[k],
                "q": dict(zip(arm.joint_names, points.q[k], strict=True)),
                **{kind.key: getattr(points, kind.name)[k] for kind in kinds},
                "eigenvalues": points.eigenvalues[k],
                "continuum": points.continuum[k],
                "attracting": points.attracting[k],
                "within_limits": points.within_limits[k],
            }
            for k in range(len(points))
        ],
    }


def tables(points: StationaryPoints) -> list[Rows]:
    """A row for each point; joints in degrees or m."""
    joints = points.law.arm.joints
    titles = [f"{kind.text}, {kind.unit}" for kind in error_kinds(points.law)]
    errors = shown_errors(points.law, points.q, points.error, points.target)
    head = ["kind", *(f"{j.name}, {j.shown[1]}" for j in joints), *titles, "eigenvalues, Ke", ""]
    rows = []
    attracting = points.attracting
    for k, kind in enumerate(points.kinds):
        loose = points.continuum[k]
        notes = ["one of many"] if loose else []
        notes += ["attracting"] if loose and points.error[k] > REACHED and attracting[k] else []
        notes += [] if points.within_limits[k] else ["beyond limits"]
        values = [f"{j.shown[0] * x:.4f}" for j, x in zip(joints, points.q[k], strict=True)]
        values += [number(error[k]) for error in errors]
        rows.append([kind, *values, _spread(points.eigenvalues[k]), ", ".join(notes)])
    return [Rows(head, rows)]


def where(points: StationaryPoints) -> str:
    """What is locked, and at which values: ``joint2 locked at 140 deg``."""
    joints = points.law.arm.joints
    at = [(joints[k], joints[k].shown, x) for k, x in zip(points.locked, points.at, strict=True)]
    return ", ".join(f"{joint.name} locked at {factor * x:.4g} {unit}" for joint, (factor, unit), x in at)


def story(points: StationaryPoints) -> Story:
    """Where the arm can stop: at its target, off it, or nowhere."""
    law = points.law
    solved = points.kind == Kind.SOLUTION
    holds = ~solved & points.attracting
    errors = off_target(points)[holds][np.argsort(points.error[holds])]
    there = f"With {where(points)} the target"
    if not len(points):
        answer = f"{there} is not reached in any configuration found, and no point at which the arm stops was found either."
    elif not errors.size:
        reached = "is within reach, and nothing else was found at which the arm can stop" if solved.any() else ""
        answer = (
            f"{there} {reached or 'is out of reach, and no stationary point that attracts was found: the arm keeps moving'}."
        )
    else:
        near, far = errors[[0, -1]]
        some = "a stationary point" if len(errors) == 1 else f"one of {len(errors)} stationary points that attract"
        some += f", {near} off it" if near == far else f", {near} to {far} off it"
        how = "within reach, but the arm can also stop at" if solved.any() else "out of reach, and the arm stops at"
        answer = f"{there} is {how} {some}."
    facts = [(f"{int((points.kind == kind).sum()):,}", _COUNTED[kind]) for kind in Kind if (points.kind == kind).any()]
    if errors.size:
        facts.insert(0, (errors[0], "off the target, at the nearest point that holds the arm away from it"))
    lines = [*map(capitalised, points.describe()[1:])] if points.continuum.any() or _idle(points) else []
    return Story(
        f"Where {law.arm.name} can stop with a lock that its controller does not know of",
        answer,
        about=f"{law.arm.name}, {law.describe()}",
        facts=facts[:5],
        lines=[f"{line}." for line in lines],
        views=[*_view(points, solved, holds)],
        tables=[table._replace(rows=table.rows[:ROWS]) for table in tables(points)],
        method=[
            ("Search", f"{points.starts:,} random starts; points that none of them converges to are missed"),
            ("Kinds", "by the eigenvalues of the linearised motion of the healthy joints, in units of the gain Ke"),
            ("Law", law.describe()),
            ("Listed", f"the first {min(ROWS, len(points))} of {len(points)}; --json has all"),
        ],
        arm=law.arm,
    )


def _idle(points: StationaryPoints) -> bool:
    return any("does not notice" in line for line in points.describe())


def _view(points: StationaryPoints, solved: Any, holds: Any) -> list[tuple[str, list[Any]]]:
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    chosen = [(np.flatnonzero(solved)[:1], "at its target"), (np.flatnonzero(holds)[:_ARMS], "")]
    named = [(k, words or f"{points.kinds[k]} {k + 1}") for some, words in chosen for k in some]
    if not named:
        return []
    shown = scene(
        points.law.arm,
        points.q[[k for k, _ in named]],
        labels=[words for _, words in named] if len(named) > 1 else (),
        locked=points.locked,
        task=points.law.task,
        lost=False,
        targets=[points.target],
    )
    picture = Picture(shown.html("stops", "The arm where it can stop"), f"Where it can stop: {', '.join(w for _, w in named)}.")
    return [("The arm where it stops", [picture])]


def next_steps(points: StationaryPoints, name: str) -> list[str]:
    """Which starts end at them."""
    locked = dict(zip(points.locked, points.at.tolist(), strict=True))
    return [f"hf.basins({name}.law, {name}.target, {locked!r}, starts=64).plot()  # which starts end at which point"]


def show(points: StationaryPoints, out: Console) -> None:
    """The sentences, and the first points of each kind."""
    for line in points.describe():
        out.print(line, markup=False, soft_wrap=True)
    (table,) = tables(points)
    kind = points.kind
    shown = [row for k, row in enumerate(table.rows) if (kind[:k] == kind[k]).sum() < SHOWN]
    print_rows(out, table._replace(rows=shown))
    if len(shown) < len(points):
        out.print(f"and {len(points) - len(shown)} more; --json has all", soft_wrap=True)


def off_target(points: StationaryPoints) -> NDArray[np.str_]:
    """Return the distance and the angle of each point (P,) from the target in words, as far as the task prescribes them."""
    pairs = zip(points.position_error, points.angle_error, strict=True)
    return np.array([error_text(points.law, position, angle) for position, angle in pairs], dtype=np.str_)


def _spread(values: Any) -> str:
    """Eigenvalues, or of many the ends of their range."""
    few = values if len(values) <= MANY else values[[0, -1]]
    return (", " if len(values) <= MANY else " to ").join(map(_complex, few))


def _complex(value: np.complex128) -> str:
    return number(value.real) if abs(value.imag) < 1e-9 else f"{number(value.real)}{value.imag:+.3g}i"
