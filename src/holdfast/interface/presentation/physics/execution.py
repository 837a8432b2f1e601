"""Text, tables, JSON, and figure of a motion that is executed with masses and servos."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.physics.execution import format_error
from holdfast.core.formatting import capitalise_first
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.control.physics.execution import Execution


_MAX_VIEW_FRAMES = 201


def to_dict(run: Execution) -> dict[str, Any]:
    """Return the outcome, the errors, and the constraints that were satisfied."""
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
        "beyond_limits": run.beyond_limits,
        "too_fast": run.too_fast,
        "error_limit": run.error_limit,
        "exceeded": None if run.first_excess is None else {"joint": run.first_excess[0], "time_s": run.first_excess[1]},
        "following_error": dict(zip(names, run.following_error.max(axis=0), strict=True)),
        "tool_error_m": {"most": run.tool_error[0].max(), "end": run.tool_error[0][-1]},
        "tool_error_rad": {"most": run.tool_error[1].max(), "end": run.tool_error[1][-1]},
        "tracking_error": dict(zip(names, run.tracking_error, strict=True)),
        "saturated_fraction": dict(zip(names, run.saturated_fraction, strict=True)),
        "stiffness": dict(zip(names, run.stiffness, strict=True)),
        "damping": dict(zip(names, run.damping, strict=True)),
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": list_contacts(run.contacts)})


def tables(run: Execution) -> list[TextTable]:
    """Tabulate the requested and the measured values, and the contacts."""
    rows = [["simulated time, s", format_significant(run.time[-1])]]
    if run.goal_distance is not None:
        rows.append(["tool off the goal, mm", format_error(1000 * run.goal_distance)])
    if run.goal_turn is not None:
        rows.append(["turned away from it, deg", format_error(np.rad2deg(run.goal_turn))])
    for constraint, (deviation, tilt) in zip(run.keep, run.constraint_errors, strict=True):
        rows += [[f"{constraint.name}: off at most, mm", format_significant(1000 * deviation, 3)]] * bool(
            len(constraint.normals)
        )
        if np.isfinite(constraint.widest):
            max_tilt = format_significant(np.rad2deg(constraint.widest), 3)
            rows.append(
                [f"{constraint.name}: turned away at most, deg", f"{format_significant(np.rad2deg(tilt), 3)} of {max_tilt}"]
            )
    rows.append(["joint behind its reference at most", _format_largest_lag(run)])
    result_tables = [TextTable(["", ""], rows)]
    return [*result_tables, tabulate_contacts(run.contacts)] if run.contacts else result_tables


def _format_largest_lag(run: Execution) -> str:
    joint_index = int(run.tracking_error.argmax())
    joint = run.arm.joints[joint_index]
    factor, unit = joint.display_unit
    return f"{format_significant(factor * run.tracking_error[joint_index], 3)} {unit} ({joint.name})"


def story(run: Execution) -> PageContent:
    """Compose the report: whether everything requested was done, the numbers, and the moving arm."""
    headline, *remarks = run.describe()
    outcome_phrases = {
        "finished": "finished its motion",
        "stopped": "stopped on the way",
        "moving": "was still moving at the end",
    }
    answer = f"{run.arm.name} {outcome_phrases.get(run.outcome, 'became unstable')}"
    faults = run.faults()[run.outcome != "finished" :]
    if faults:
        answer += f", and {'; '.join(faults)}"
    elif run.outcome == "finished":
        achievements = [
            *["the tool is at its goal"] * (run.goal is not None),
            *["what was to be kept was kept"] * bool(run.keep),
        ]
        answer += f": {' and '.join([*achievements, 'the joints kept their limits'])}"
    facts = []
    if run.goal_distance is not None:
        facts.append((f"{format_error(1000 * run.goal_distance)} mm", "from the tool to its goal"))
    facts += [
        (
            f"{format_significant(np.rad2deg(tilt), 3)} deg",
            f"is the most that the tool was turned away; {np.rad2deg(constraint.widest):.3g} allowed",
        )
        for constraint, (_, tilt) in zip(run.keep, run.constraint_errors, strict=True)
        if np.isfinite(constraint.widest)
    ]
    return PageContent(
        f"{run.arm.name} with masses and servos",
        f"{answer}.",
        about=headline,
        facts=[fact for fact in facts if fact[0][:2] != "0 "],
        lines=[f"{remark if remark.split()[0] in run.arm.joint_names else capitalise_first(remark)}." for remark in remarks],
        views=_animate_motion(run),
        figures={"execution": ("Over time", "What was asked of the tool, and how far the joints lag behind their references.")},
        method=[("Simulated", f"{format_significant(run.time[-1])} s, MuJoCo, {run.servos.describe()}")],
        arm=run.arm,
    )


def _animate_motion(run: Execution) -> list[tuple[str, list[Any]]]:
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    frame_indices = np.linspace(0, len(run.time) - 1, min(_MAX_VIEW_FRAMES, len(run.time))).astype(int)
    locks = {
        name: float(instant) for name, instant in zip(run.arm.joint_names, run.lock_time, strict=True) if np.isfinite(instant)
    }
    caption = "The arm as it was measured."
    goals = [] if run.goal is None else [run.goal]
    motion_scene = scene(
        run.arm,
        run.q[frame_indices],
        time=np.linspace(0, run.time[-1], len(frame_indices)),
        readings=[f"{instant:.2f} s" for instant in run.time[frame_indices]],
        locked=locks,
        targets=goals,
        cell=run.cell,
    )
    return [("The motion", [Picture(motion_scene.to_html("motion", caption), caption)])]


def figures(run: Execution) -> dict[str, Figure]:
    """Draw over time the distance of the tool from its goal, the deviation from the constraints, and the lag of the joints."""
    from holdfast.interface.report.motions import TimePanel, motion_figure

    locks = run.lock_time[np.isfinite(run.lock_time) & (run.lock_time > 0)]

    def make_panel(values: FloatArray, label: str, title: str, level: tuple[float, str] | None = None) -> TimePanel:
        moments = tuple(
            (float(lock_instant), float(np.interp(lock_instant, run.time, values)), "a joint locks")
            for lock_instant in locks[:1]
        )
        return TimePanel(run.time, values, label, title, level, moments)

    panels = []
    if run.goal is not None:
        goal_position = run.goal[:3, 3] if run.goal.ndim == 2 else run.goal
        distances = np.linalg.norm(run.poses[:, :3, 3] - goal_position, axis=1)
        panels.append(make_panel(distances, "tool off its goal, m", "Goal"))
    for constraint in run.keep:
        deviation, tilt = constraint.distances(run.poses)
        if np.isfinite(constraint.widest):
            max_tilt = float(np.rad2deg(constraint.widest))
            panels.append(make_panel(np.rad2deg(tilt), "turned away, deg", constraint.name.capitalize(), (max_tilt, "allowed")))
        else:
            panels.append(
                make_panel(
                    1000 * deviation, "tool off, mm", constraint.name.capitalize(), (1000 * constraint.within[0], "allowed")
                )
            )
    tracking_errors = np.where(run.is_locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
    unit = "m or rad" if run.arm.prismatic.any() else "rad"
    panels.append(make_panel(tracking_errors, f"largest servo error, {unit}", "Servos"))
    caption = f"{run.arm.name}: {run.outcome}; {run.servos.describe()}, MuJoCo"
    return {"execution": motion_figure(panels, caption)}
