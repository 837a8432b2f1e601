"""A run with faults in numbers and words: what happened, what was noticed, what was done."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.clearance.contacts import contact_entries
from holdfast.present.clearance.shape import shape_text
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised

if TYPE_CHECKING:
    from holdfast.reaction.run import FaultRun

SAFETY = "Everything here is simulated. The monitor and the reaction are no certified safety function."


def to_dict(run: FaultRun) -> dict[str, Any]:
    """The faults, the actions and how it ended."""
    return {
        **run.arm.entry(),
        "outcome": run.outcome,
        "ok": run.ok,
        "react": run.react,
        "time_s": run.time[-1],
        "miss_m": run.miss[-1],
        "turn_rad": run.turn[-1] if run.law.task.angular else None,
        "faults": [event.stored() for event in run.events],
        "id": run.events.id,
        "noticed_s": run.noticed,
        "alarms": [{"time_s": v.time, "joint": v.joint, "kind": v.kind} for v in run.verdicts],
        "actions": [{"time_s": a.time, "what": a.what, "joint": a.joint, "why": a.why} for a in run.actions],
        "braked": {} if run.degraded is None else dict(run.degraded.locked),
        "q_final": dict(zip(run.arm.joint_names, run.q[-1], strict=True)),
        "body_seed": run.body.seed,
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": contact_entries(run.contacts)})


def key_table(run: FaultRun) -> Rows:
    """Faults and actions in order of time; elsewhere its sentences say them."""
    happened: list[tuple[float, str, str, str]] = [(e.onset, "fault", e.joint, e.kind) for e in run.events]
    happened += [(a.time, a.what, a.joint or "", a.why) for a in run.actions]
    rows = [[number(t, 4), *cells] for t, *cells in sorted(happened, key=lambda row: row[0])]
    end = [number(run.time[-1], 4), "end", "", run.outcome]
    return Rows(["time, s", "what", "joint", "why"], [*rows, end], "in order of time")


def next_steps(run: FaultRun, name: str) -> list[str]:
    """The record, and what is left of the arm."""
    if run.degraded is not None:
        return [f"{name}.degraded", f'{name}.log().save("run.npz")']
    return [f'{name}.log().save("run.npz")  # for hf.diagnosis.diagnose', f'{name}.report("run.html")']


def story(run: FaultRun) -> Story:
    """Whether the task was finished; when it happened, when it was noticed, and what was done."""
    first, *others = run.describe()
    facts = [(f"{number(1e3 * run.miss[-1], 3)} mm", "from the tool to its target at the end")]
    if np.isfinite(run.delay) and run.delay >= 0:
        facts.append((f"{number(1e3 * run.delay, 3)} ms", "from the fault to the alarm"))
    return Story(
        f"{run.arm.name} with faults",
        f"{capitalised(first)}.",
        about=f"{run.arm.title}, {run.law.describe()}",
        facts=facts,
        lines=[*(f"{line if line.split(':')[0] in run.arm.joint_names else capitalised(line)}." for line in others), SAFETY],
        views=_moving(run),
        figures={
            "chain": (
                "Over time",
                "What the tool still has to go, how far each joint is behind its reference, and where the joints are. Upright "
                "lines: a fault begins; it is noticed; something is done.",
            )
        },
        method=[
            ("Simulated", f"{number(run.time[-1])} s, MuJoCo, {run.servos.describe()}, body {run.body.seed}"),
            ("Clearance", "not looked at" if run.clearance is None else shape_text(run.clearance, 0.0)),
        ],
        arm=run.arm,
    )


def _moving(run: FaultRun) -> list[tuple[str, list[Any]]]:
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    rows = np.linspace(0, len(run.time) - 1, min(201, len(run.time))).astype(int)
    held = {} if run.degraded is None else run.degraded.locked
    braked = {a.joint: a.time for a in run.actions if a.what == "brake" and a.joint in held}
    words = "The arm as it moved; joints that were braked are marked from then on."
    shown = scene(
        run.arm,
        run.q[rows],
        time=run.time[rows],
        readings=[f"{t:.2f} s" for t in run.time[rows]],
        locked=braked,
        targets=[run.target if run.law.task.angular else run.target[:3, 3]],
        cell=None if run.clearance is None else run.clearance.cell,
    )
    return [("The motion", [Picture(shown.html("motion", words), words)])]
