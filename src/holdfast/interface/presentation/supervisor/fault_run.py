"""Presentation of a run with faults: the outcome, the events, the alarms, and the actions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.collision.contacts import list_contacts
from holdfast.interface.presentation.collision.shape import describe_shape
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.report.page import Section
from holdfast.response.supervisor.run import OUTCOME_PHRASES, FaultRun

_RESPONSE_PHRASES = {
    "none": "no fault response",
    "stop": "the arm stops at an alarm",
    "chain": "the controller responds to the diagnosis of the monitor",
    "known": "every fault is known immediately",
}
_TIMELINE_CAPTION = (
    "Distance of the tool from its target, tracking errors, and positions of the joints. Solid vertical lines: a fault begins. "
    "Dashed lines: alarms and actions of the controller."
)
_MAX_POINTS = 1500  # points of a line
_MIN_PLOTTED_ERROR = 1e-5  # rad or m


def to_dict(run: FaultRun) -> dict[str, Any]:
    """Return the faults, the alarms, the actions, and the outcome."""
    return {
        **run.arm.entry(),
        **{name: getattr(run, name) for name in ("outcome", "ok", "react")},
        "time_s": run.time[-1],
        "miss_m": run.position_error[-1],
        "turn_rad": run.orientation_error[-1] if run.law.task.angular else None,
        "faults": [event.to_stored() for event in run.events],
        "id": run.events.id,
        "noticed_s": run.detection_time,
        "alarms": [{"time_s": verdict.time, "joint": verdict.joint, "kind": verdict.kind} for verdict in run.verdicts],
        "actions": [
            {"time_s": action.time, "what": action.what, "joint": action.joint, "why": action.why} for action in run.actions
        ],
        "braked": {} if run.degraded is None else dict(run.degraded.locked),
        "q_final": dict(zip(run.arm.joint_names, run.q[-1], strict=True)),
        "body_seed": run.body.seed,
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": list_contacts(run.contacts)})


def present(run: FaultRun) -> Presentation:
    """Present the outcome, the times of faults and alarms, and the actions."""
    angle_text = f" and {np.rad2deg(run.orientation_error[-1]):.3g} deg" if run.law.task.angular else ""
    answer = (
        f"{capitalise_first(OUTCOME_PHRASES[run.outcome])} ({_RESPONSE_PHRASES[run.react]}), "
        f"{1e3 * run.position_error[-1]:.3g} mm{angle_text} from the target after {run.time[-1]:.4g} s of simulated time."
    )
    lines = [] if run.events else ["this episode has no fault"]
    if not run.actions and run.react != "none":
        lines.append("no fault was detected")
    if run.contacts is not None:
        lines += [contact.sentence() for contact in run.contacts] or ["the arm touched nothing"]
    if run.false_alarm:
        lines.append("the first alarm is false, because no fault had begun; the thresholds do not hold for this motion")
    lines.append("everything here is simulated; the monitor and the fault response are not a certified safety function")
    distance = Fact(
        "distance of the tool from its target at the end",
        1e3 * run.position_error[-1],
        "mm",
        phrase="from the tool to its target at the end",
        digits=3,
    )
    facts = [distance]
    if np.isfinite(run.delay) and run.delay >= 0:
        facts.append(Fact("time from fault to alarm", 1e3 * run.delay, "ms", phrase="from the fault to the alarm", digits=3))
    events = [(event.onset, event.sentence()) for event in run.events]
    events += [(action.time, action.sentence()) for action in run.actions]
    names = run.arm.joint_names
    rows = [
        [time, sentence if sentence.split(":")[0] in names else capitalise_first(sentence)] for time, sentence in sorted(events)
    ]
    table = TableSpec("Faults and actions", [Header("time, s", aligned=False), "event"], rows)
    return Presentation(
        f"{run.arm.name} with faults",
        answer,
        about=f"{run.arm.title}, {run.law.describe()}",
        lines=[f"{line if line.split(':')[0] in names else capitalise_first(line)}." for line in lines],
        facts=facts,
        tables=[table] if rows else [],
        figures={"chain": FigureSpec(partial(_draw_run, run), "Over time", _TIMELINE_CAPTION)},
        sections=partial(_build_sections, run),
        method=[
            ("Simulated", f"{format_number(run.time[-1], 4)} s, MuJoCo, {run.servos.describe()}, body {run.body.seed}"),
            ("Clearance", "not checked" if run.clearance is None else describe_shape(run.clearance, 0.0)),
        ],
        arm=run.arm,
    )


def _build_sections(run: FaultRun) -> Sequence[Section]:
    frame_indices = np.linspace(0, len(run.time) - 1, min(201, len(run.time))).astype(int)
    locked_joints = {} if run.degraded is None else run.degraded.locked
    brake_times = {
        action.joint: action.time for action in run.actions if action.what == "brake" and action.joint in locked_joints
    }
    section = build_view_section(
        "The motion",
        run.arm,
        run.q[frame_indices],
        "Measured motion of the arm; a braked joint is marked from the time of its brake.",
        time=run.time[frame_indices],
        readings=[f"{instant:.2f} s" for instant in run.time[frame_indices]],
        locked=brake_times,
        targets=[run.target if run.law.task.angular else run.target[:3, 3]],
        cell=None if run.clearance is None else run.clearance.cell,
    )
    return [section]


def _draw_run(run: FaultRun) -> report.Figure:
    """Draw over time the distance of the tool from its target, the tracking errors of the joints, and the joints."""
    samples = np.unique(np.linspace(0, len(run.time) - 1, _MAX_POINTS).astype(int))
    time, faulty_joints = run.time[samples], {event.joint for event in run.events}
    unit = "rad or m" if run.arm.prismatic.any() else "rad"
    with report.styled_figure(1.25 * report.WIDTH_IN, 6.2) as figure:
        distance_axes, error_axes, joint_axes = figure.subplots(3, 1, sharex=True)
        distance_axes.plot(time, 1e3 * run.position_error[samples], color=report.BLUE)
        distance_axes.set(ylabel="mm", title="Distance of the tool from its target", ylim=(0, None))
        tracking_error = np.abs(run.reference - run.q_measured)
        for index, name in enumerate(run.arm.joint_names):
            is_faulty = name in faulty_joints
            line_style = {
                "color": report.ORANGE if is_faulty else report.SKY,
                "linewidth": 1.6 if is_faulty else 0.9,
                "zorder": 2 + is_faulty,
            }
            error_axes.plot(time, np.maximum(tracking_error[samples, index], _MIN_PLOTTED_ERROR), **line_style)
            joint_axes.plot(time, run.q[samples, index], label=name if is_faulty else None, **line_style)
        error_axes.set(ylabel=unit, title="Tracking errors of the joints", yscale="log")
        joint_axes.set(ylabel=unit, title="Joint positions", xlabel="time, s", xlim=(0, max(float(time[-1]), 1e-3)))
        if faulty_joints:
            joint_axes.legend(loc="best", fontsize=8)
        _mark_events(run, [distance_axes, error_axes, joint_axes])
        figure.suptitle(
            report.format_label(f"{run.arm.name}, {run.law.name}: {run.outcome}", 200), fontsize=9, color=report.SOFT
        )
    return figure


def _mark_events(run: FaultRun, panels: Sequence[report.Axes]) -> None:
    """Draw a vertical line for each fault and action, and list them in the first panel."""
    moments = [(event.onset, f"fault: {event.kind}", report.ORANGE) for event in run.events if event.onset <= run.time[-1]]
    moments += [(action.time, action.what, report.INK) for action in run.actions]
    for time, _, color in moments:
        for axes in panels:
            axes.axvline(time, color=color, linewidth=0.9, linestyle="--" if color == report.INK else "-")
    legend_text = "\n".join(f"{time:.3f} s  {label}" for time, label, _ in sorted(moments)[:9])
    panels[0].text(0.985, 0.95, legend_text, transform=panels[0].transAxes, fontsize=7.5, ha="right", va="top")
