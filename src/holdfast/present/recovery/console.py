"""A recovery in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, alike, number
from holdfast.words import capitalised

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.recovery.goals import RowsGivenUp
    from holdfast.recovery.recovery import Recovery


def to_dict(recovery: Recovery) -> dict[str, Any]:
    """What came of it: the ending, the motion, its check, what is left and what is given up."""
    rest = recovery.rest
    return {
        **recovery.arm.entry(),
        "fingerprint": recovery.arm.fingerprint,
        "locked": recovery.locked,
        "goal": recovery.goal,
        "task": recovery.task.name,
        "ok": recovery.ok,
        "ending": recovery.ending.name.lower(),
        "sentence": recovery.ending.sentence,
        "reason": recovery.reason,
        "given_up": _rows(recovery.given_up),
        "choices": [_rows(c) for c in recovery.choices],
        "proof": recovery.proof,
        "goal_configurations_found": recovery.found,
        "starts": recovery.starts,
        "metric": recovery.metric,
        "unit": recovery.unit,
        "length": recovery.length,
        "lower_bound": recovery.lower_bound,
        "legs": [
            {"name": g.name, "first": g.first, "last": g.last, "length": g.length, "lower_bound": g.lower_bound}
            for g in recovery.legs
        ],
        "joints": recovery.arm.joint_names,
        "waypoints": recovery.q,
        "check": recovery.check().to_dict() if len(recovery.q) else None,
        "clearance": None if recovery.clearance is None else shape_summary(recovery.clearance, recovery.margin),
        "left": None if recovery.left is None else recovery.left.to_dict(),
        "rest_of_path": None
        if rest is None
        else {
            "finished": rest.finished,
            "furthest": rest.furthest,
            "first_lost": rest.first_lost,
            "deviation": rest.deviation,
            "given_up": _rows(rest.given_up),
        },
        "seed": recovery.seed,
    }


def key_table(recovery: Recovery) -> Rows:
    """What came of it."""
    rows = [
        ["goal", recovery.goal],
        ["ending", recovery.ending.name.lower().replace("_", " ")],
        ["waypoints", str(len(recovery.q))],
    ]
    if recovery.legs:
        rows.append(["length", f"{number(recovery.length)} {recovery.unit} (at least {number(recovery.lower_bound)})"])
    if recovery.left is not None and recovery.left.left is not None:
        rows.append(["of the workspace is left", str(recovery.left.left)])
    return Rows(["", ""], rows)


def next_steps(recovery: Recovery, name: str) -> list[str]:
    """The motion for a controller, or why there is none."""
    if not len(recovery.q):
        return [f"{name}.choices  # rows that could be given up"]
    return [f"{name}.check()  # an independent replay", f'{name}.to_csv("waypoints.csv")']


def _rows(rows: RowsGivenUp | None) -> dict[str, float] | None:
    """What rows that are given up miss, by name with its unit."""
    if rows is None:
        return None
    return {f"{name}_{unit}": miss for name, unit, miss in zip(rows.names, rows.units, rows.misses, strict=True)}


def show(recovery: Recovery, out: Console) -> None:
    """The sentences, what the replay of the motion found, and where the joints begin and end."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    first, verdict, *rest = recovery.describe()
    out.print(escape(first), soft_wrap=True)
    out.print(f"[{'bold' if recovery.ok else 'bold red'}]{escape(verdict)}[/]", soft_wrap=True)
    for line in rest:
        out.print(escape(capitalised(line)), soft_wrap=True)
    if not len(recovery.q):
        return
    for line in checks(recovery):
        out.print(escape(f"check: {line}"), soft_wrap=True)
    table = Grid("joint", "start", "end", "")
    factors, units = zip(*(joint.shown for joint in recovery.arm.joints), strict=True)
    for name, *cells in zip(recovery.arm.joint_names, *(alike(factors * x, units) for x in recovery.q[[0, -1]]), strict=True):
        table.add_row(escape(name), *cells, "locked" if name in recovery.locked else "")
    out.print(table)


def checks(recovery: Recovery) -> list[str]:
    """What the replay of its motion found, sentences."""
    shape = "" if recovery.clearance is None else f" ({shape_text(recovery.clearance, recovery.margin)})"
    return [line + shape * line.startswith("least") for line in recovery.check().describe()]
