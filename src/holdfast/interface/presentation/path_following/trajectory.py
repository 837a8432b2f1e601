"""Presentation of a motion along a path."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_as_given
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.indices.console import display_unit
from holdfast.interface.presentation.path_following.trajectory_figures import build_sections, draw_figure
from holdfast.interface.presentation.presentation import (
    Column,
    Fact,
    FigureSpec,
    Notice,
    Presentation,
    TableSpec,
    format_value,
    make_headers,
)
from holdfast.kinematics.path_following.slow_motion import SlowMotion
from holdfast.kinematics.path_following.trajectory import Trajectory


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


def present(trajectory: Trajectory) -> Presentation:
    """Present whether the end effector stays on its path, the objective along it, and the events."""
    objective, arm = trajectory.objective, trajectory.arm
    unit = display_unit(objective)
    worst_text = f"The worst {objective.name} on the way is {format_value(trajectory.worst, unit=unit)}."
    if trajectory.on_path:
        answer = f"The end effector stays on its path (largest error {trajectory.tool_error}). {worst_text}"
    else:
        answer = f"The end effector leaves its path by up to {trajectory.tool_error}. {worst_text}"
    lines, tables = [], [_tabulate_values(trajectory, unit)]
    if trajectory.clearance is not None and trajectory.nearest is not None:
        sample, pair = trajectory.nearest
        distance = format_value(1000 * trajectory.clearance[sample], unit="mm")
        lines.append(f"Smallest clearance {distance} ({pair}) at {trajectory.time[sample]:.4g} s.")
    if trajectory.torque_bound is not None:
        slowness = trajectory.slowness(trajectory.torque_bound)
        lines.append(_compose_verdict(trajectory, trajectory.torque_bound, slowness))
        tables.append(_tabulate_slowness(trajectory, slowness))
    if trajectory.events:
        columns: list[Column] = ["event", *make_headers("from, s", "to, s", aligned=False), ""]
        events = [
            (event.kind, event.start, event.end, capitalise_first(event.text.split(": ", 1)[1])) for event in trajectory.events
        ]
        tables.append(TableSpec("Events", columns, events))
    else:
        lines.append("No events on the way: no algorithmic singularity, no joint at a limit, no unusually high joint rate.")
    return Presentation(
        f"Motion of {arm.name} along a path",
        answer,
        about=f"{capitalise_first(trajectory.method)} on {arm.title}, {objective.name}, {objective.better} is better, "
        f"{trajectory.time[-1]:.4g} s, {len(trajectory.time):,} samples",
        lines=lines,
        notices=[] if trajectory.on_path else [Notice(f"{trajectory.headline}.", "bad")],
        facts=_list_facts(trajectory, unit),
        tables=tables,
        figures={"motion": FigureSpec(partial(draw_figure, trajectory), on_page=False, saved=False)},
        sections=partial(build_sections, trajectory),
        method=[
            ("Law", trajectory.method),
            ("Objective", f"{objective.name}, {objective.better} is better"),
            ("Task", trajectory.task.describe()),
            ("Gain", format_as_given(trajectory.gain)),
            (
                "Collision avoidance",
                "none" if trajectory.clear_of is None else describe_shape(trajectory.clear_of, trajectory.margin),
            ),
            ("Rate cap", "none" if trajectory.rate_cap is None else f"{trajectory.rate_cap:g} rad/s"),
            (
                "Steps",
                f"{trajectory.steps:,} of {trajectory.time[-1] / trajectory.steps:.3g} s; {len(trajectory.time):,} "
                f"samples are stored",
            ),
            ("Without the objective", "least-norm joint rates from the same configuration, all else equal"),
            ("Seed", str(trajectory.seed)),
        ],
        arm=arm,
        exports={"trajectory.csv": trajectory.to_csv},
    )


def _list_facts(trajectory: Trajectory, unit: str) -> list[Fact]:
    """List the objective, the joint rates, the error of the tool, and the clearance in a few numbers."""
    rate_phrase = f"largest norm of the joint rates, at {trajectory.peak_time:.3g} s"
    facts = [
        Fact("", trajectory.worst, unit, phrase=f"worst {trajectory.objective.name} on the way"),
        Fact("", float(trajectory.value.mean()), unit, phrase=f"mean {trajectory.objective.name} on the way"),
        Fact(rate_phrase, trajectory.peak_rate, "rad/s", phrase=rate_phrase),
        Fact("median norm of the joint rates", float(np.median(trajectory.rate_norm)), "rad/s"),
    ]
    for label, fraction, is_shown in (
        ("samples in which the rate cap slows the self-motion", trajectory.self_motion, trajectory.rate_cap is not None),
        ("samples in which joint limits slow the end effector", trajectory.task_share, None),
    ):
        slowed = float(np.mean(fraction < 1 - 1e-9))
        if is_shown or (is_shown is None and slowed):
            facts.append(Fact(label, slowed, style="percent"))
    return facts


def _tabulate_values(trajectory: Trajectory, unit: str) -> TableSpec:
    """Tabulate the objective along the path, with the best value of each pose if it is known."""
    values = {f"{trajectory.method}{unit and f', {unit}'}": trajectory.value}
    if trajectory.best_value is not None:
        values["best of each pose"] = trajectory.best_value
    rows = [(name, *_summarize_values(numbers).values()) for name, numbers in values.items()]
    title = f"{capitalise_first(trajectory.objective.name)} along the path"
    return TableSpec(title, ["", *_summarize_values(trajectory.value)], rows)


def _summarize_values(values: FloatArray) -> dict[str, float]:
    return {
        "start": values[0],
        "end": values[-1],
        "mean": np.nanmean(values),
        "smallest": np.nanmin(values),
        "largest": np.nanmax(values),
    }


def _compose_verdict(trajectory: Trajectory, bound: float, slowness: Sequence[SlowMotion]) -> str:
    worst = max(slowness, key=lambda joint_slowness: joint_slowness.time_scale)
    scale, joint = format_value(worst.time_scale), trajectory.arm.joint_names[list(slowness).index(worst)]
    duration = format_value(worst.time_scale * trajectory.time[-1], unit="s")
    goal = f"to keep all joint torques within {bound:g} N m of the gravity torques"
    if worst.satisfied:
        verdict = f"The motion is slow enough {goal}: it must take at least {scale} of its duration"
    else:
        verdict = f"The motion is too fast {goal}: it must take at least {scale} times as long ({duration})"
    return f"{verdict}; joint '{joint}' sets the limit."


def _tabulate_slowness(trajectory: Trajectory, slowness: Sequence[SlowMotion]) -> TableSpec:
    """Tabulate the time scale that each joint requires."""
    columns = ["joint", "time scale", "duration, s", "critical instant"]
    rows = []
    for name, joint_slowness in zip(trajectory.arm.joint_names, slowness, strict=True):
        scale, instant = joint_slowness.time_scale, trajectory.time[joint_slowness.worst_time_index]
        rows.append((name, scale, scale * trajectory.time[-1], f"{instant:.4g} s" if scale > 0 else ""))
    return TableSpec("Required time scale (English and Maciejewski 1998, eq. 6)", columns, rows)
