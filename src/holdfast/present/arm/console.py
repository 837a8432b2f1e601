"""Arms in numbers and words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast import arms
from holdfast.arm.model import Arm
from holdfast.arm.soundness import check
from holdfast.arm.task import plane_normal
from holdfast.assessment.single_points import explain, structures
from holdfast.grammar import TASKS
from holdfast.present.printing import Rows, alike, number

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(arm: Arm) -> dict[str, Any]:
    """An arm, which joints are single points of failure by structure, and what is wrong with its data."""
    return {
        "name": arm.name,
        **{key: value for key, value in arm.entry().items() if key != "arm"},
        "source": arm.source,
        "fingerprint": arm.fingerprint,
        "gravity_m_s2": arm.gravity,
        "joints": [
            {
                **{
                    key: getattr(joint, key)
                    for key in ("name", "type", "unit", "lower", "upper", "velocity", "effort", "friction")
                },
                "mass_kg": None if link is None else link.mass,
            }
            for joint, link in zip(arm.joints, arm.links, strict=True)
        ],
        "structure": [
            {
                "task": s.task,
                "redundancy": s.redundancy,
                "single_points_of_failure": [arm.joint_names[k] for k in s.fatal],
                "at_most_left": {arm.joint_names[k]: left for k, left in s.nearly},
                "weak_joints": {arm.joint_names[w.joint]: asdict(w) for w in s.weak},
                "end_it_together": [[arm.joint_names[k] for k in sets] for sets in s.together],
                "always_singular": s.never,
            }
            for s in structures(arm)
        ],
        "findings": [{"severity": f.severity, "subject": f.subject, "message": f.message} for f in check(arm)],
    }


def sentences(arm: Arm) -> list[str]:
    """Which arm it is."""
    return [f"{arm.title}: {arm.n} joints", *([f"Source: {arm.source}"] if arm.source else [])]


def key_table(arm: Arm) -> Rows:
    """Its joints."""
    rows = []
    for joint, link in zip(arm.joints, arm.links, strict=True):
        factor, unit = joint.shown
        limits = [f"{factor * x:.4g} {unit}" if np.isfinite(x) else "none" for x in (joint.lower, joint.upper)]
        rows.append([joint.name, joint.type, *limits, "not given" if link is None else f"{number(link.mass)} kg"])
    return Rows(["joint", "type", "lower", "upper", "link mass"], rows)


def next_steps(arm: Arm, name: str) -> list[str]:
    """What it looks like, and how it tolerates failures of the largest task for which it is redundant."""
    task = redundant_task(arm)
    seen = f"{name}.show()  # a view to turn, with a slider for each joint"
    if task is None:
        return [seen]
    return [
        seen,
        f"hf.indices.relative_manipulability({name}, {task!r})  # what a lock leaves",
        f"hf.assess({name}, task={task!r}, poses=200)  # and over a region about its home",
    ]


def redundant_task(arm: Arm) -> str | None:
    """The largest task of an arm's kind of motion with fewer rows than joints; None if there is none."""
    flat = plane_normal(arm) is not None
    some = [task for task, rows in TASKS.items() if task.startswith("planar") == flat and rows < arm.n]
    return max(some, key=TASKS.__getitem__, default=None)


def show(arm: Arm, out: Console) -> None:
    """Its joints as a table, then what its structure and its data lack."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    source = f". Source: {escape(arm.source)}" if arm.source else ""
    out.print(f"[bold]{escape(arm.title)}[/]: {arm.n} joints{source}")
    table = Grid("", "joint", "type", "lower", "upper", "speed", "effort", "link mass")
    for k, (joint, link) in enumerate(zip(arm.joints, arm.links, strict=True)):
        factor, unit = joint.shown
        table.add_row(
            str(k + 1),
            escape(joint.name),
            joint.type,
            *[f"{factor * x:.4g} {unit}" if np.isfinite(x) else "none" for x in (joint.lower, joint.upper)],
            f"{number(joint.velocity)} {joint.unit}/s" if np.isfinite(joint.velocity) else "not given",
            f"{number(joint.effort)} {'N' if joint.prismatic else 'N m'}" if np.isfinite(joint.effort) else "not given",
            f"{number(link.mass)} kg" if link is not None else "not given",
        )
    out.print(table)
    out.print()
    found = structures(arm)
    for s in found:
        style = "green" if s.survives and not s.weak else "yellow"
        label = f"{s.task}: " + (f"degree of redundancy {s.redundancy}. " if s.redundancy > 0 else "")
        out.print(f"[{style}]{label}[/]{escape(explain(arm, s, found))}", soft_wrap=True)
    # The same remark about every joint is one line.
    subjects: dict[tuple[str, str], list[str]] = {}
    for f in check(arm):
        subjects.setdefault((f.severity, f.message), []).append(f.subject)
    if subjects:
        out.print()
    for (severity, message), names in subjects.items():
        who = names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more like it"
        colour = "red" if severity == "error" else "yellow"
        out.print(f"[{colour}]{severity}[/] {escape(who)}: {escape(message)}", soft_wrap=True)


def describe(arm: Arm) -> list[str]:
    """The lines that ``holdfast describe`` prints where no terminal says how wide it is."""
    from holdfast.present.terminal import Screen

    out = Screen()
    with out.capture() as captured:
        show(arm, out)
    return [line.rstrip() for line in captured.get().splitlines()]


def library() -> list[dict[str, Any]]:
    """The built-in arms."""
    entries = [arms.about(name) for name in arms.names()]
    return [{"name": e.name, "joints": e.n, "summary": e.summary, "source": e.source, "licence": e.licence} for e in entries]


def show_library(out: Console) -> None:
    """The built-in arms as a table."""
    from holdfast.present.terminal import Grid

    table = Grid("name", "joints", "what it is", "licence")
    for e in library():
        table.add_row(e["name"], str(e["joints"]), e["summary"], e["licence"])
    out.print(table)


def shown_position(value: float, unit: str) -> str:
    """A joint's position, or an angle, for a table."""
    return f"{number(value)} m" if unit == "m" else f"{number(value)} rad ({number(np.degrees(value))} deg)"


def shown_positions(values: NDArray[np.float64], units: Sequence[str], digits: int = 5) -> list[str]:
    """A column of positions, or of measures of joints; angles are in degrees too."""
    degrees = iter(alike(np.degrees([x for x, unit in zip(values, units, strict=True) if unit == "rad"]), "deg"))
    pairs = zip(alike(values, units, digits), units, strict=True)
    return [f"{text} ({next(degrees)})" if unit == "rad" else text for text, unit in pairs]


def print_outside(arm: Arm, q: NDArray[np.float64], out: Console, when: str = "") -> None:
    """Which joints a configuration (n,) has beyond a limit, if any."""
    from rich.markup import escape

    names = [joint.name for joint, x in zip(arm.joints, q, strict=True) if not joint.lower <= x <= joint.upper]
    if names:
        out.print(f"[yellow]outside its limits{when}: {escape(', '.join(names))}[/]", soft_wrap=True)
