"""Presentation of a motion that is executed with masses and servos."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.physics.execution import Execution, format_error
from holdfast.core.formatting import format_number
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation
from holdfast.interface.report.page import Section

SERVO_QUANTITIES = ("tracking_error", "saturated_fraction", "stiffness", "damping")  # of each joint
_MAX_VIEW_FRAMES = 201
_OUTCOME_PHRASES = {
    "finished": "finished its motion",
    "stopped": "stopped on the way",
    "moving": "was still moving at the end",
    "unstable": "became unstable",
}


def to_dict(run: Execution) -> dict[str, Any]:
    """Return the outcome, the errors, and the deviations from the constraints."""
    names = run.arm.joint_names
    return {
        **run.arm.entry(),
        "outcome": run.outcome,
        "ok": run.ok,
        "time_s": run.time[-1],
        "q_final": dict(zip(names, run.q_final, strict=True)),
        "locked": {} if run.degraded is None else dict(run.degraded.locked),
        "lock_time_s": {
            name: lock_instant for name, lock_instant in zip(names, run.lock_time, strict=True) if np.isfinite(lock_instant)
        },
        "noticed_s": run.noticed,
        "goal_distance_m": run.goal_distance,
        "goal_turn_rad": run.goal_turn,
        "keep": [constraint.to_dict() for constraint in run.keep],
        "kept": [{"off": deviation, "turned": tilt} for deviation, tilt in run.constraint_errors],
        **{name: getattr(run, name) for name in ("beyond_limits", "too_fast", "error_limit")},
        "exceeded": None if run.first_excess is None else {"joint": run.first_excess[0], "time_s": run.first_excess[1]},
        "following_error": dict(zip(names, run.following_error.max(axis=0), strict=True)),
        "tool_error_m": {"most": run.tool_error[0].max(), "end": run.tool_error[0][-1]},
        "tool_error_rad": {"most": run.tool_error[1].max(), "end": run.tool_error[1][-1]},
        **{name: dict(zip(names, getattr(run, name), strict=True)) for name in SERVO_QUANTITIES},
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": list_contacts(run.contacts)})


def present(run: Execution) -> Presentation:
    """Present whether everything requested was done, with the numbers and the moving arm."""
    answer = f"{run.arm.name} {_OUTCOME_PHRASES[run.outcome]}"
    faults = run.faults()[run.outcome != "finished" :]
    if faults:
        answer += f", and {'; '.join(faults)}"
    elif run.outcome == "finished":
        achievements = ["the tool is at its goal"] * (run.goal is not None) + ["all constraints are satisfied"] * bool(run.keep)
        answer += f": {' and '.join([*achievements, 'the joints stayed within their limits'])}"
    return Presentation(
        f"{run.arm.name} with masses and servos",
        f"{answer}.",
        about=f"Arm {run.arm.title}, {run.servos.describe()}, on MuJoCo",
        lines=_compose_remarks(run),
        facts=_list_facts(run),
        tables=[tabulate_contacts(run.contacts)] if run.contacts else [],
        figures={
            "execution": FigureSpec(
                partial(_draw_figure, run),
                "Over time",
                "Errors of the tool with respect to its goal and its path constraints, and tracking errors of the joints.",
            )
        },
        sections=partial(_animate_motion, run),
        method=[("Simulated", f"{format_number(run.time[-1], 4)} s, MuJoCo, {run.servos.describe()}")],
        arm=run.arm,
    )


def _compose_remarks(run: Execution) -> list[str]:
    """Compose the sentences about the locks, the controller, the errors of the tool, and the limits of the joints."""
    remarks = []
    for index in np.flatnonzero(np.isfinite(run.lock_time) & (run.lock_time <= run.time[-1])):
        joint, lock_time = run.arm.joints[index], run.lock_time[index]
        factor, unit = joint.display_unit
        lock_text = f"locked at {lock_time:.4g} s" if lock_time > 0 else "locked"
        remarks.append(f"{joint.name} {lock_text}, at {factor * run.q_final[index]:.4g} {unit}.")
    if run.noticed <= run.time[-1]:
        remarks.append(f"The controller detected the lock at {run.noticed:.4g} s and slowed down.")
    distances, angles = run.tool_error
    largest_text, final_text = (
        f"{format_error(1000 * distance)} mm and {format_error(np.rad2deg(angle))} deg"
        for distance, angle in ((distances.max(), angles.max()), (distances[-1], angles[-1]))
    )
    remarks.append(f"The tool deviates from the motion by at most {largest_text}, and by {final_text} at the end.")
    if run.error_limit is not None and run.first_excess is None:
        remarks.append("The following error stays within its limit in every joint.")
    if not run.beyond_limits and not run.too_fast:
        remarks.append("The joints stayed within their position and speed limits.")
    if run.outcome == "unstable":
        remarks.append("The simulation became unstable; use softer servos or a higher servo rate.")
    return remarks


def _list_facts(run: Execution) -> list[Fact]:
    """List the simulated time, the errors of the tool, the deviations from the constraints, and the largest servo error."""
    facts = [Fact("simulated time", float(run.time[-1]), "s")]
    if run.goal_distance is not None:
        facts.append(
            Fact("distance from the goal", format_error(1000 * run.goal_distance) + " mm", phrase="from the tool to its goal")
        )
    if run.goal_turn is not None:
        facts.append(Fact("angle from the goal", format_error(np.rad2deg(run.goal_turn)) + " deg"))
    for constraint, (deviation, tilt) in zip(run.keep, run.constraint_errors, strict=True):
        if len(constraint.normals):
            facts.append(Fact(f"{constraint.name}: largest deviation", 1000 * deviation, "mm", digits=3))
        if np.isfinite(constraint.widest):
            allowed = f"{np.rad2deg(constraint.widest):.3g} allowed"
            facts.append(
                Fact(
                    f"{constraint.name}: largest tilt, {allowed}",
                    np.rad2deg(tilt),
                    "deg",
                    phrase=f"is the largest tilt of the tool; {allowed}",
                    digits=3,
                )
            )
    joint_index = int(run.tracking_error.argmax())
    factor, unit = run.arm.joints[joint_index].display_unit
    label = f"largest tracking error ({run.arm.joint_names[joint_index]})"
    return [*facts, Fact(label, factor * run.tracking_error[joint_index], unit, digits=3)]


def _animate_motion(run: Execution) -> list[Section]:
    frame_indices = np.linspace(0, len(run.time) - 1, min(_MAX_VIEW_FRAMES, len(run.time))).astype(int)
    locks = {
        name: float(instant) for name, instant in zip(run.arm.joint_names, run.lock_time, strict=True) if np.isfinite(instant)
    }
    section = build_view_section(
        "The motion",
        run.arm,
        run.q[frame_indices],
        "Measured motion of the arm.",
        time=np.linspace(0, run.time[-1], len(frame_indices)),
        readings=[f"{instant:.2f} s" for instant in run.time[frame_indices]],
        locked=locks,
        targets=[] if run.goal is None else [run.goal],
        cell=run.cell,
    )
    return [section]


def _draw_figure(run: Execution) -> report.Figure:
    """Draw the distance of the tool from its goal, the constraint deviations, and the tracking errors over time."""
    locks = run.lock_time[np.isfinite(run.lock_time) & (run.lock_time > 0)]

    def make_panel(
        values: FloatArray, label: str, title: str, level: tuple[float, str] | None = None
    ) -> report.motions.TimePanel:
        moments = tuple((float(instant), float(np.interp(instant, run.time, values)), "a joint locks") for instant in locks[:1])
        return report.motions.TimePanel(run.time, values, label, title, level, moments)

    panels = []
    if run.goal is not None:
        goal_position = run.goal[:3, 3] if run.goal.ndim == 2 else run.goal
        distances = np.linalg.norm(run.poses[:, :3, 3] - goal_position, axis=1)
        panels.append(make_panel(distances, "distance from the goal, m", "Goal"))
    for constraint in run.keep:
        deviation, tilt = constraint.distances(run.poses)
        if np.isfinite(constraint.widest):
            max_tilt = float(np.rad2deg(constraint.widest))
            panels.append(make_panel(np.rad2deg(tilt), "tilt, deg", constraint.name.capitalize(), (max_tilt, "allowed")))
        else:
            panels.append(
                make_panel(
                    1000 * deviation, "deviation, mm", constraint.name.capitalize(), (1000 * constraint.within[0], "allowed")
                )
            )
    tracking_errors = np.where(run.is_locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
    unit = "m or rad" if run.arm.prismatic.any() else "rad"
    panels.append(make_panel(tracking_errors, f"largest servo error, {unit}", "Servos"))
    caption = f"{run.arm.name}: {run.outcome}; {run.servos.describe()}, MuJoCo"
    return report.motions.motion_figure(panels, caption)
