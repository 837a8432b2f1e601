"""Text, tables, and JSON of a motion along a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.collision.shape import summarize_shape
from holdfast.interface.presentation.printing import TextTable, format_column, format_significant
from holdfast.kinematics.path_following.trajectory import Trajectory

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(trajectory: Trajectory) -> dict[str, Any]:
    """Return the motion with its start, end, and events."""
    names = trajectory.arm.joint_names
    data: dict[str, Any] = {
        **trajectory.arm.entry(),
        "objective": trajectory.objective.name,
        "better": trajectory.objective.better,
        "unit": trajectory.objective.unit,
        "task": trajectory.task.name,
        "method": trajectory.method,
        "gain": trajectory.gain,
        "seed": trajectory.seed,
        "duration_s": trajectory.time[-1],
        "samples": len(trajectory.time),
        "tool_on_path": trajectory.on_path,
        "position_error_m": np.nanmax(trajectory.position_error),
        "rotation_error_rad": np.nanmax(trajectory.rotation_error),
        "value": _summarize_values(trajectory.value),
        "best_value": None if trajectory.best_value is None else _summarize_values(trajectory.best_value),
        "largest_rate_norm_per_s": trajectory.peak_rate,
        "largest_rate_norm_at_s": trajectory.peak_time,
        "q_start": dict(zip(names, trajectory.q[0], strict=True)),
        "q_end": dict(zip(names, trajectory.q[-1], strict=True)),
        "events": [
            {"kind": event.kind, "start_s": event.start, "end_s": event.end, "text": event.text} for event in trajectory.events
        ],
    }
    if trajectory.clear_of is not None and trajectory.clearance is not None and trajectory.nearest is not None:
        instant, pair = trajectory.nearest
        data["least_clearance"] = {"m": trajectory.clearance[instant], "pair": pair, "at_s": trajectory.time[instant]}
        data["clearance"] = summarize_shape(trajectory.clear_of, trajectory.margin)
    if trajectory.torque_bound is not None:
        scales = [slowness.time_scale for slowness in trajectory.slowness(trajectory.torque_bound)]
        data["torque_bound"] = trajectory.torque_bound
        data["time_scale"] = max(scales)
        data["time_scale_by_joint"] = dict(zip(names, scales, strict=True))
    return data


def key_table(trajectory: Trajectory) -> TextTable:
    """Tabulate the objective along the path, and the joint rates."""
    facts = _summarize_values(trajectory.value)
    rows = [
        [f"{trajectory.objective.name}: {', '.join(facts)}", ", ".join(map(format_significant, facts.values()))],
        [
            "largest norm of the joint rates",
            f"{format_significant(trajectory.peak_rate)} rad/s at {format_significant(trajectory.peak_time)} s",
        ],
        ["end effector off its path by at most", trajectory.tool_error],
    ]
    if trajectory.clearance is not None and trajectory.nearest is not None:
        instant, pair = trajectory.nearest
        rows.append(["smallest clearance", f"{format_significant(1000 * trajectory.clearance[instant])} mm, {pair}"])
    return TextTable(["", ""], rows)


def show(trajectory: Trajectory, out: Console) -> None:
    """Print whether the end effector stays on its path, the objective as a table, and the events."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    headline, _, *remarks = trajectory.describe()
    text_style = "bold" if trajectory.on_path else "bold red"
    out.print(f"[{text_style}]{escape(capitalise_first(headline))}[/]", soft_wrap=True)
    facts = _summarize_values(trajectory.value)
    table = BandedTable(escape(trajectory.objective.name), *facts)
    unit = "" if trajectory.objective.unit in ("1", "mixed") else f", {trajectory.objective.unit}"
    rows = {f"{trajectory.method}{unit}": trajectory.value} | (
        {} if trajectory.best_value is None else {"best of each pose": trajectory.best_value}
    )
    value_texts = format_column([value for values in rows.values() for value in _summarize_values(values).values()])
    for row_index, name in enumerate(rows):
        table.add_row(escape(name), *value_texts[row_index * len(facts) : (row_index + 1) * len(facts)])
    out.print(table)
    for remark in remarks:
        out.print(escape(capitalise_first(remark)), soft_wrap=True)
    if trajectory.torque_bound is not None:
        _show_required_slowdown(trajectory, trajectory.torque_bound, out)


def _summarize_values(values: FloatArray) -> dict[str, float]:
    return {
        "start": values[0],
        "end": values[-1],
        "mean": np.nanmean(values),
        "smallest": np.nanmin(values),
        "largest": np.nanmax(values),
    }


def _show_required_slowdown(trajectory: Trajectory, bound: float, out: Console) -> None:
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    slowness = trajectory.slowness(bound)
    worst = max(slowness, key=lambda joint_slowness: joint_slowness.time_scale)
    joint = escape(trajectory.arm.joint_names[slowness.index(worst)])
    verdict = (
        f"slow enough: it could be done in {format_significant(worst.time_scale)} of the time"
        if worst.satisfied
        else f"too fast: it must take {format_significant(worst.time_scale)} times as long "
        f"({format_significant(worst.time_scale * trajectory.time[-1])} s)"
    )
    out.print(
        f"For torques within {bound:g} N m of gravity's the motion is {verdict}; joint '{joint}' sets the limit.",
        soft_wrap=True,
    )
    table = BandedTable("joint", "time scale", "decided at")
    for name, scale_text, joint_slowness in zip(
        trajectory.arm.joint_names,
        format_column(joint_slowness.time_scale for joint_slowness in slowness),
        slowness,
        strict=True,
    ):
        table.add_row(
            escape(name),
            scale_text,
            f"{trajectory.time[joint_slowness.worst_time_index]:.4g} s" if joint_slowness.time_scale > 0 else "",
        )
    out.print(table)
