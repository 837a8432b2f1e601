"""Presentation of a recovery: whether the goal is reached with the locked joints, the motion, and the remaining workspace."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count, format_number
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Presentation, TableSpec, make_headers
from holdfast.interface.presentation.recovery.remaining_workspace import present as present_remainder
from holdfast.interface.presentation.renderers import sentences, write_json
from holdfast.interface.report.page import Section
from holdfast.interface.report.palette import BLUE, FAINT, ORANGE, SKY, SOFT
from holdfast.interface.report.views import SIDE_VIEW, choose_side_and_top_views
from holdfast.model.collision.exact.exact_clearance import ExactClearance
from holdfast.response.recovery.goals import RelaxedRows
from holdfast.response.recovery.recovery import Recovery, RecoveryOutcome
from holdfast.response.recovery.timing.motion import TimedMotion

_TIMING_CAPTION = "Joint rates and accelerations over time, each divided by its limit."
_PATH_DOTS = 160  # samples of the tool path
_GHOST_COUNT = 4  # drawings of the arm between start and end
_VIEW_FRAMES = 121


def to_dict(recovery: Recovery) -> dict[str, Any]:
    """Return the outcome, the motion, its check, the remaining workspace, and the relaxed task dimensions."""
    path_rest, timed_motion = recovery.rest, recovery.timed
    return {
        **recovery.arm.entry(),
        "fingerprint": recovery.arm.fingerprint,
        "locked": recovery.locked,
        "degraded": recovery.degraded.to_dict(),
        "goal": recovery.goal,
        "task": recovery.task.name,
        "within": recovery.within,
        "ok": recovery.ok,
        "ending": recovery.ending.name.lower(),
        "sentence": recovery.ending.sentence,
        "reason": recovery.reason,
        "given_up": _relaxed_misses(recovery.relaxed),
        "choices": [_relaxed_misses(choice) for choice in recovery.choices],
        "verdict": {"answer": recovery.verdict.answer, "why": recovery.verdict.why, "kind": recovery.verdict.kind or None},
        "verified": None
        if recovery.verified is None
        else {
            **{name: getattr(recovery.verified, name) for name in ("ok", "faults", "exact_by", "goal_miss", "path_miss")},
            "kept": [{"off": deviation, "turned": tilt} for deviation, tilt in recovery.verified.kept],
        },
        "proof": recovery.proof,
        "goal_configurations_found": recovery.found,
        **{name: getattr(recovery, name) for name in ("starts", "metric", "unit", "length", "lower_bound")},
        "legs": [
            {name: getattr(leg, name) for name in ("name", "first", "last", "length", "lower_bound")} for leg in recovery.legs
        ],
        "joints": recovery.arm.joint_names,
        "waypoints": recovery.q,
        "timed": None
        if timed_motion is None
        else {
            "duration_s": timed_motion.duration,
            "without_accelerations_s": timed_motion.without,
            "accelerations": timed_motion.accelerations,
            "stops": timed_motion.stops,
            "rows": len(timed_motion.time),
            "period_s": timed_motion.period,
        },
        "check": recovery.check().to_dict() if len(recovery.q) else None,
        "clearance": None if recovery.clearance is None else summarize_shape(recovery.clearance, recovery.margin),
        "keep": [constraint.to_dict() for constraint in recovery.keep],
        "left": None if recovery.left is None else recovery.left.to_dict(),
        "rest_of_path": None
        if path_rest is None
        else {
            **{name: getattr(path_rest, name) for name in ("finished", "furthest", "first_lost", "deviation")},
            "given_up": _relaxed_misses(path_rest.given_up),
        },
        "seed": recovery.seed,
    }


def _relaxed_misses(relaxed_rows: RelaxedRows | None) -> dict[str, float] | None:
    """Return the errors in the relaxed task dimensions, by name with the unit."""
    if relaxed_rows is None:
        return None
    return {
        f"{name}_{unit}": residual
        for name, unit, residual in zip(relaxed_rows.names, relaxed_rows.units, relaxed_rows.misses, strict=True)
    }


def present(recovery: Recovery) -> Presentation:
    """Present whether the goal is reached, the motion with its checks, and the remaining workspace."""
    arm = recovery.arm
    remainder = None if recovery.left is None else present_remainder(recovery.left)
    timing = None if recovery.timed is None else FigureSpec(partial(_draw_timing, recovery), "Timing", _TIMING_CAPTION)
    exports: dict[str, Any] = {"recovery.json": partial(write_json, recovery)}
    return Presentation(
        f"{arm.name} after a known failure",
        _compose_answer(recovery),
        about=f"{arm.title}, {recovery.degraded.describe()}; goal: {recovery.goal}",
        lines=[*_list_reasons(recovery), *([] if remainder is None else [remainder.answer])],
        facts=[*_list_facts(recovery), *([] if remainder is None else remainder.facts)],
        tables=[_tabulate_joints(recovery)],
        figures={
            "motion": FigureSpec(partial(_draw_motion, recovery), on_page=False),
            **({} if timing is None else {"timing": timing}),
            **({} if remainder is None else remainder.figures),
        },
        sections=partial(_build_sections, recovery),
        method=[
            ("Goal", recovery.goal),
            ("Task", recovery.task.describe()),
            ("Search", f"{recovery.starts} random restarts for configurations of the goal, seed {recovery.seed}"),
            (
                "Length",
                "in joint space, 1 m counts as 1 rad" if recovery.unit == "rad" else "duration within the velocity limits",
            ),
            *([] if recovery.timed is None else [("Timing", _describe_timing(recovery.timed))]),
            *(("Path constraint", str(constraint)) for constraint in recovery.keep),
            ("Verified", "no motion to verify" if recovery.verified is None else str(recovery.verified)),
            ("Clearance", "not checked" if recovery.clearance is None else describe_shape(recovery.clearance, recovery.margin)),
        ],
        arm=arm,
        exports=exports | ({"waypoints.csv": recovery.to_csv} if len(recovery.q) else {}),
    )


def _compose_answer(recovery: Recovery) -> str:
    answer = f"With {recovery.degraded.describe()}, {recovery.ending.sentence}"
    if recovery.relaxed is not None:
        answer += f". The motion misses the goal in {recovery.relaxed}"
    if len(recovery.q) > 1:
        quantity = "length" if recovery.unit == "rad" else "duration"
        is_shortest = recovery.length <= recovery.lower_bound * (1 + 1e-9)
        bound = f"lower bound {format_number(recovery.lower_bound, 4)} {recovery.unit}"
        bound = "no route to any configuration found is shorter" if is_shortest else bound
        answer += (
            f". The motion has {format_count(len(recovery.q), 'waypoint')} and a {quantity} of "
            f"{format_number(recovery.length, 4)} {recovery.unit} ({bound})"
        )
    elif recovery.ending == RecoveryOutcome.GOAL_REACHED:
        answer += "; the arm is already there"
    if not recovery.ok:
        kind = f" ({recovery.verdict.kind})" if recovery.verdict.kind else ""
        answer += f". Verdict: {recovery.verdict.answer}{kind}"
    return f"{answer}."


def _list_reasons(recovery: Recovery) -> list[str]:
    """List the verdict of a solved request or else its reason, the legs of the motion, and the results of the replay."""
    is_verified = recovery.verdict.is_solved and recovery.verified is not None
    lines = [f"verdict: {recovery.verdict}" + f", {recovery.verified}" * is_verified] if recovery.ok else [recovery.verdict.why]
    lines += [f"path constraint: {constraint}" for constraint in recovery.keep]
    if recovery.reason and recovery.reason != recovery.verdict.why:
        lines.append(recovery.reason)
    if len(recovery.q) and isinstance(recovery.clearance, ExactClearance):
        lines.append(f"exact distances ({recovery.clearance.exact_by}), but not the lower bounds, show a collision-free motion")
    other_options = [
        str(option)
        for option in recovery.choices
        if recovery.relaxed is None or not set(option.names) <= set(recovery.relaxed.names)
    ]
    if other_options:
        lines.append("other sets of task dimensions that could be missed instead: " + "; ".join(other_options[:6]))
    for leg in recovery.legs:
        text = f"{leg.name}: {leg.last - leg.first + 1} waypoints, {format_number(leg.length, 4)} {recovery.unit}"
        if leg.name != "along the path":
            kind = "a straight line in joint space" if leg.straight else "the shortest route found"
            is_shortest = leg.length <= leg.lower_bound * (1 + 1e-9)
            bound = "no route" if is_shortest else f"lower bound {format_number(leg.lower_bound, 4)} {recovery.unit}"
            text += f" ({kind}; {bound} to any goal configuration found{' is shorter' if is_shortest else ''})"
        lines.append(text)
    lines += [part.describe() for part in (recovery.timed, recovery.rest) if part is not None]
    if len(recovery.q):
        shape_note = "" if recovery.clearance is None else f" ({describe_shape(recovery.clearance, recovery.margin)})"
        lines += [
            f"independent replay: {sentence.removesuffix('.')}{shape_note * sentence.startswith('Smallest')}"
            for sentence in sentences(recovery.check())
        ]
    return [f"{capitalise_first(line).removesuffix('.')}." for line in lines if line]


def _list_facts(recovery: Recovery) -> list[Fact]:
    facts = []
    if len(recovery.q) > 1:
        label = "length of the motion" if recovery.unit == "rad" else "duration of the motion"
        facts.append(Fact(label, recovery.length, recovery.unit, phrase=label))
        facts.append(Fact("waypoints", len(recovery.q), phrase="waypoints, joined by straight lines in joint space"))
        if recovery.timed is not None:
            label = "duration within the acceleration limits"
            facts.append(Fact(label, recovery.timed.duration, "s", phrase=label))
    if recovery.found:
        facts.append(Fact("configurations found for the goal", recovery.found, phrase="configurations were found for the goal"))
    return facts


def _tabulate_joints(recovery: Recovery) -> TableSpec:
    configurations = recovery.q[[0, -1]] if len(recovery.q) > 1 else recovery.at[None].repeat(2, axis=0)
    factors, units = zip(*(joint.display_unit for joint in recovery.arm.joints), strict=True)
    start, end = np.array(factors) * configurations
    marks = [recovery.degraded.mark(name) for name in recovery.arm.joint_names]
    columns: list[Column] = ["joint", *make_headers("start", "end", unit=units), ""]
    rows = list(zip(recovery.arm.joint_names, start.tolist(), end.tolist(), marks, strict=True))
    return TableSpec("Joint positions", columns, rows)


def _describe_timing(timed_motion: TimedMotion) -> str:
    moving_joints = np.flatnonzero(timed_motion.accelerations)
    limits = ", ".join(
        dict.fromkeys(
            f"{format_number(timed_motion.accelerations[joint], 4)} {timed_motion.arm.joints[joint].unit}/s²"
            for joint in moving_joints
        )
    )
    return (
        f"as fast as the speed limits and accelerations of {limits} allow, with parabolic blends at waypoints where they are "
        f"proved collision-free; one row every {format_number(timed_motion.period, 4)} s"
    )


# ---- figures -------------------------------------------------------------------------------------------------------------


def _build_sections(recovery: Recovery) -> list[Section]:
    """Build the view of the motion with the locked joints, or of the arm if there is no motion."""
    goals = [] if recovery.goal_pose is None else [recovery.goal_pose]
    options: dict[str, Any] = {"locked": list(recovery.locked), "targets": goals, "cell": recovery.cell}
    if len(recovery.q) < 2:
        caption = "The arm, which does not move, with the directions of motion that the lock removes."
        return [build_view_section("The arm", recovery.arm, recovery.at, caption, task=recovery.task, **options)]
    q, time = _resample_path(recovery.q, _VIEW_FRAMES), np.linspace(0.0, 100.0, _VIEW_FRAMES)
    readings, speed_text = [f"{progress:.0f} % of the path" for progress in time], "at constant speed in joint space"
    if recovery.timed is not None:
        timed_motion, time = recovery.timed, np.linspace(0.0, recovery.timed.time[-1], _VIEW_FRAMES)
        q = np.stack([np.interp(time, timed_motion.time, column) for column in timed_motion.q.T], axis=1)
        readings, speed_text = [f"{instant:.2f} s" for instant in time], "with its timing within the acceleration limits"
    caption = f"The motion with the locked joints, {speed_text}." + " The target of the end effector is marked." * bool(goals)
    return [build_view_section("The motion", recovery.arm, q, caption, time=time, readings=readings, **options)]


def _draw_motion(recovery: Recovery) -> report.Figure:
    """Draw the arm at its start, on its path, and at its end; the path of the tool is coloured from start to end."""
    arm = recovery.arm
    has_motion = len(recovery.q) > 1
    path = _resample_path(recovery.q, _PATH_DOTS) if has_motion else np.zeros((0, arm.n))
    points = arm.forward_kinematics(path)[:, :3, 3] if has_motion else np.zeros((0, 3))
    ghost_configurations = _resample_path(recovery.q, _GHOST_COUNT + 2)[1:-1] if has_motion else np.zeros((0, arm.n))
    start, *ghosts, final = arm.frames(
        np.vstack([recovery.at, ghost_configurations, recovery.q[-1] if has_motion else recovery.at])
    )[..., :3, 3]
    arm_scene = report.Scene(points, np.linspace(0, 100, len(points)), chain=final, square=arm.prismatic)
    goals = [] if recovery.goal_pose is None else [recovery.goal_pose[None, :3, 3]]
    extent = report.Scene(np.concatenate([points, start, *ghosts, final, *goals])).extent
    views, scale = choose_side_and_top_views(extent) or [SIDE_VIEW], report.Scale(0.0, 100.0)
    panel_width = 4.1 if len(views) > 1 else 5.0
    spans, height = report.scenes.fit_view_spans(extent, views, panel_width, 2.4, 4.8)
    with report.styled_figure(report.WIDTH_IN if len(views) > 1 else panel_width + 2.6, height + 1.7) as figure:
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        for axes, view in zip(panels, views, strict=True):
            for index, ghost in enumerate(ghosts):
                axes.plot(
                    *view.project(ghost).T, color=FAINT, linewidth=1.6, zorder=1.6, label="on the way" if index == 0 else None
                )
            if has_motion:
                axes.plot(
                    *view.project(start).T, color=BLUE, linewidth=2.0, marker="o", markersize=3, zorder=2.6, label="start"
                )
            dot_area = report.scenes.choose_dot_area(arm_scene, views, panel_width / spans[0])
            report.scenes.draw_view(axes, arm_scene, view, scale, dot_area, spans, panel_width, extent.mean(axis=0))
            locked_at_start = np.array([start[1 + arm.joint_index(name)] for name in recovery.locked])
            locked_at_end = np.array([final[1 + arm.joint_index(name)] for name in recovery.locked])
            axes.plot(*view.project(locked_at_start).T, "X", color=ORANGE, markersize=8, zorder=3.6, label="locked joint")
            axes.plot(*view.project(locked_at_end).T, "X", color=ORANGE, markersize=8, zorder=3.6)
            axes.plot([], [], color="#1b1f24", linewidth=2.8, label="end" if has_motion else "the arm, without a motion")
            if recovery.goal_pose is not None:
                goal_point = view.project(recovery.goal_pose[:3, 3])
                axes.plot(
                    *goal_point, "*", color=SKY, markeredgecolor=SOFT, markersize=13, zorder=3.4, label="goal of the tool"
                )
        if has_motion:
            report.scenes.add_color_bar(figure, arm_scene, scale, list(panels), "fraction of the tool's path, %")
        report.legend_below(figure, panels[0], 5)
        motion_text = f"{len(recovery.q)} waypoints, {recovery.length:.3g} {recovery.unit}" if has_motion else "no motion"
        title = f"{arm.name}: {recovery.ending.phrase}, {motion_text}"
        figure.suptitle(report.format_label(title, 110), fontsize=10, x=0.01, ha="left")
    return figure


def _draw_timing(recovery: Recovery) -> report.Figure:
    """Draw rates and accelerations of the moving joints as fractions of their limits, over time."""
    timed_motion = recovery.timed
    assert timed_motion is not None
    moving_joints = np.flatnonzero(np.abs(timed_motion.qd).max(axis=0) > 0)
    speed_limits = np.where(np.isfinite(recovery.degraded.v), recovery.degraded.v, np.abs(timed_motion.qd).max(axis=0))
    panels = [
        report.motions.TimePanel(
            timed_motion.time,
            {timed_motion.arm.joint_names[joint]: values[:, joint] / limits[joint] for joint in moving_joints},
            f"{quantity} / limit",
            title,
            reference_level=(1.0, "limit"),
        )
        for quantity, title, values, limits in (
            ("rate", "Rates", timed_motion.qd, speed_limits),
            ("acceleration", "Accelerations", timed_motion.qdd, timed_motion.accelerations),
        )
    ]
    return report.motions.motion_figure(panels, f"{recovery.arm.name}: {timed_motion.describe()}", "time, s")


def _resample_path(waypoints: Any, count: int) -> Any:
    """Resample the path (K, n) at ``count`` equal fractions of its length: configurations (count, n)."""
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(waypoints, axis=0), axis=1))])
    samples = np.linspace(0, lengths[-1], count)
    return np.stack([np.interp(samples, lengths, column) for column in waypoints.T], axis=1)
