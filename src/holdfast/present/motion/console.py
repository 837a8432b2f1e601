"""A motion along a path in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.motion.trajectory import Array, Trajectory
from holdfast.present.clearance.shape import shape_summary
from holdfast.present.printing import Rows, alike, number
from holdfast.words import capitalised

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(t: Trajectory) -> dict[str, Any]:
    """The motion by name, with its start, end and events."""
    names = t.arm.joint_names
    data: dict[str, Any] = {
        **t.arm.entry(),
        "objective": t.objective.name,
        "better": t.objective.better,
        "unit": t.objective.unit,
        "task": t.task.name,
        "method": t.method,
        "gain": t.gain,
        "seed": t.seed,
        "duration_s": t.time[-1],
        "samples": len(t.time),
        "tool_on_path": t.on_path,
        "position_error_m": np.nanmax(t.position_error),
        "rotation_error_rad": np.nanmax(t.rotation_error),
        "value": _facts(t.value),
        "best_value": None if t.best_value is None else _facts(t.best_value),
        "largest_rate_norm_per_s": t.peak_rate,
        "largest_rate_norm_at_s": t.peak_time,
        "q_start": dict(zip(names, t.q[0], strict=True)),
        "q_end": dict(zip(names, t.q[-1], strict=True)),
        "events": [{"kind": e.kind, "start_s": e.start, "end_s": e.end, "text": e.text} for e in t.events],
    }
    if t.clear_of is not None and t.clearance is not None and t.nearest is not None:
        k, pair = t.nearest
        data["least_clearance"] = {"m": t.clearance[k], "pair": pair, "at_s": t.time[k]}
        data["clearance"] = shape_summary(t.clear_of, t.margin)
    if t.torque_bound is not None:
        scales = [s.time_scale for s in t.slowness(t.torque_bound)]
        data["torque_bound"] = t.torque_bound
        data["time_scale"] = max(scales)
        data["time_scale_by_joint"] = dict(zip(names, scales, strict=True))
    return data


def key_table(t: Trajectory) -> Rows:
    """The objective along the path, and the joint rates."""
    facts = _facts(t.value)
    rows = [
        [f"{t.objective.name}: {', '.join(facts)}", ", ".join(map(number, facts.values()))],
        ["largest norm of the joint rates", f"{number(t.peak_rate)} rad/s at {number(t.peak_time)} s"],
        ["end effector off its path by at most", t.tool_error],
    ]
    if t.clearance is not None and t.nearest is not None:
        k, pair = t.nearest
        rows.append(["smallest clearance", f"{number(1000 * t.clearance[k])} mm, {pair}"])
    return Rows(["", ""], rows)


def next_steps(t: Trajectory, name: str) -> list[str]:
    """The file for a controller, and the page with the arm moving."""
    del t
    return [
        f"{name}.arm.show({name}.q, time={name}.time)  # the arm moving",
        f'{name}.to_csv("motion.csv")',
        f'{name}.report("motion.html")',
    ]


def show(t: Trajectory, out: Console) -> None:
    """Whether the end effector stays on its path, the objective as a table, and what happened."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    first, _, *rest = t.describe()
    look = "bold" if t.on_path else "bold red"
    out.print(f"[{look}]{escape(capitalised(first))}[/]", soft_wrap=True)
    facts = _facts(t.value)
    table = Grid(escape(t.objective.name), *facts)
    unit = "" if t.objective.unit in ("1", "mixed") else f", {t.objective.unit}"
    rows = {f"{t.method}{unit}": t.value} | ({} if t.best_value is None else {"best of each pose": t.best_value})
    shown = alike([x for values in rows.values() for x in _facts(values).values()])
    for k, name in enumerate(rows):
        table.add_row(escape(name), *shown[k * len(facts) : (k + 1) * len(facts)])
    out.print(table)
    for line in rest:
        out.print(escape(capitalised(line)), soft_wrap=True)
    if t.torque_bound is not None:
        _show_slowness(t, t.torque_bound, out)


def _facts(values: Array) -> dict[str, float]:
    return {
        "start": values[0],
        "end": values[-1],
        "mean": np.nanmean(values),
        "smallest": np.nanmin(values),
        "largest": np.nanmax(values),
    }


def _show_slowness(t: Trajectory, bound: float, out: Console) -> None:
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    slowness = t.slowness(bound)
    worst = max(slowness, key=lambda s: s.time_scale)
    joint = escape(t.arm.joint_names[slowness.index(worst)])
    verdict = (
        f"slow enough: it could be done in {number(worst.time_scale)} of the time"
        if worst.satisfied
        else f"too fast: it must take {number(worst.time_scale)} times as long ({number(worst.time_scale * t.time[-1])} s)"
    )
    out.print(
        f"For torques within {bound:g} N m of gravity's the motion is {verdict}; joint '{joint}' sets the limit.",
        soft_wrap=True,
    )
    table = Grid("joint", "time scale", "decided at")
    for name, scale, s in zip(t.arm.joint_names, alike(s.time_scale for s in slowness), slowness, strict=True):
        table.add_row(escape(name), scale, f"{t.time[s.worst_time_index]:.4g} s" if s.time_scale > 0 else "")
    out.print(table)
