"""Text, tables, and JSON of a run with faults: events, alarms, and actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.collision.contacts import list_contacts
from holdfast.interface.presentation.collision.shape import describe_shape
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant

if TYPE_CHECKING:
    from holdfast.response.supervisor.run import FaultRun

SIMULATION_NOTE = "Everything here is simulated. The monitor and the reaction are no certified safety function."


def to_dict(run: FaultRun) -> dict[str, Any]:
    """Return the faults, the alarms, the actions, and the outcome."""
    return {
        **run.arm.entry(),
        "outcome": run.outcome,
        "ok": run.ok,
        "react": run.react,
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


def key_table(run: FaultRun) -> TextTable:
    """Tabulate faults and actions in order of time; the sentences contain them elsewhere."""
    events: list[tuple[float, str, str, str]] = [(event.onset, "fault", event.joint, event.kind) for event in run.events]
    events += [(action.time, action.what, action.joint or "", action.why) for action in run.actions]
    rows = [[format_significant(instant, 4), *cells] for instant, *cells in sorted(events, key=lambda row: row[0])]
    end = [format_significant(run.time[-1], 4), "end", "", run.outcome]
    return TextTable(["time, s", "what", "joint", "why"], [*rows, end], "in order of time")


def story(run: FaultRun) -> PageContent:
    """Compose the report: the outcome, the times of faults and alarms, and the actions."""
    headline, *remarks = run.describe()
    facts = [(f"{format_significant(1e3 * run.position_error[-1], 3)} mm", "from the tool to its target at the end")]
    if np.isfinite(run.delay) and run.delay >= 0:
        facts.append((f"{format_significant(1e3 * run.delay, 3)} ms", "from the fault to the alarm"))
    return PageContent(
        f"{run.arm.name} with faults",
        f"{capitalise_first(headline)}.",
        about=f"{run.arm.title}, {run.law.describe()}",
        facts=facts,
        lines=[
            *(f"{remark if remark.split(':')[0] in run.arm.joint_names else capitalise_first(remark)}." for remark in remarks),
            SIMULATION_NOTE,
        ],
        views=_animate_run(run),
        figures={
            "chain": (
                "Over time",
                "What the tool still has to go, how far each joint is behind its reference, and where the joints are. Upright "
                "lines: a fault begins; it is noticed; something is done.",
            )
        },
        method=[
            ("Simulated", f"{format_significant(run.time[-1])} s, MuJoCo, {run.servos.describe()}, body {run.body.seed}"),
            ("Clearance", "not looked at" if run.clearance is None else describe_shape(run.clearance, 0.0)),
        ],
        arm=run.arm,
    )


def _animate_run(run: FaultRun) -> list[tuple[str, list[Any]]]:
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    frame_indices = np.linspace(0, len(run.time) - 1, min(201, len(run.time))).astype(int)
    locked_joints = {} if run.degraded is None else run.degraded.locked
    brake_times = {
        action.joint: action.time for action in run.actions if action.what == "brake" and action.joint in locked_joints
    }
    caption = "The arm as it moved; joints that were braked are marked from then on."
    motion_scene = scene(
        run.arm,
        run.q[frame_indices],
        time=run.time[frame_indices],
        readings=[f"{instant:.2f} s" for instant in run.time[frame_indices]],
        locked=brake_times,
        targets=[run.target if run.law.task.angular else run.target[:3, 3]],
        cell=None if run.clearance is None else run.clearance.cell,
    )
    return [("The motion", [Picture(motion_scene.to_html("motion", caption), caption)])]
