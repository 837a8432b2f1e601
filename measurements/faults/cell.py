"""A ball in the way of what is left of an arm: whether the chain still finishes its task, and what the arm touches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

import holdfast as hf
from holdfast.response.diagnosis import Monitor
from holdfast.response.faults import FaultEvent
from measurements.faults.chain import CENTRING, ONSET, PLANNED_LIMIT, Trial, entries, grouped, options, write
from measurements.faults.second import KINDS

TASKS, DRAWS = 6300, 63  # seeds
RADIUS, MARGIN, AWAY = 0.04, 0.01, 0.15  # m; away: from the tool where it was braked, and from the target
STOPPING = 0.15  # s after the brake in which the arm comes to rest and waits


def judged(arm: hf.Arm, trial: Trial, monitor: Monitor) -> dict[str, Any] | None:
    """What became of a task; None where it is not finished without the ball, nothing is braked, or no ball has a place."""
    rng = np.random.default_rng([DRAWS, trial.number])
    kind, joint, onset = rng.choice(KINDS), arm.joint_names[rng.integers(arm.n)], float(rng.uniform(*ONSET))
    common: dict[str, Any] = {"body": trial.body, "seed": trial.number, "centring": CENTRING, "time_limit": PLANNED_LIMIT}
    common |= {"faults": [FaultEvent(kind, joint, onset)], "monitor": monitor}
    free = hf.simulate_faults(trial.law, trial.q0, trial.target, **common)
    brake = next((a.time for a in free.actions if a.what == "brake"), None)
    if not free.ok or brake is None:
        return None
    tool = free.poses[:, :3, 3]
    ends = tool[[int(np.searchsorted(free.time, brake)), -1]]
    away = np.linalg.norm(tool[:, None] - ends, axis=2).min(axis=1)
    places = np.flatnonzero((away > AWAY) & (free.time > brake))
    if not places.size:
        return None
    cell = hf.Cell([hf.cell.Sphere("ball", RADIUS, pose=free.poses[rng.choice(places)], margin=MARGIN)])
    try:
        clearance = hf.Clearance(arm, cell=cell, itself=False)
    except hf.InputError:  # it would be in the arm's base
        return None
    stopping = free.q[(free.time >= brake) & (free.time <= brake + STOPPING)]
    touched = replace(free, clearance=clearance).contacts
    if not touched or touched[0].time <= brake or not (clearance.margin_left(stopping) >= 0).all():
        return None
    kept = hf.simulate_faults(trial.law, trial.q0, trial.target, clearance=clearance, **common)
    did = {action.what for action in kept.actions}
    return {
        "number": trial.number,
        "kind": str(kind),
        "task": trial.law.task.name,
        "finished": kept.ok,
        "by a posture": kept.ok and "detour" in did and "plan" not in did,
        "by a route": kept.ok and "plan" in did,
        "stopped": kept.outcome == "stopped",
        "touched": any(contact.exact_time is None or np.isfinite(contact.exact_time) for contact in kept.contacts or ()),
        "why": [action.sentence() for action in kept.actions],
        "contacts": [contact.sentence() for contact in kept.contacts or ()],
    }


COLUMNS = ("finished", "by a posture", "by a route", "stopped", "touched")


def table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of all tasks, by task, and by kind of the fault."""
    groups = {"all": list(rows)} | {name: [r for r in rows if r["task"] == name] for name in ("position", "pose")}
    groups |= {kind: [row for row in rows if row["kind"] == kind] for kind in KINDS}
    return grouped(groups, COLUMNS, counted="tasks")


def main() -> None:
    """Make the table of one arm and write it; what a run before has judged is taken from the store."""
    chosen = options("cell", __doc__, (10, "tasks with a ball in the way"))
    arm = hf.arms.load(chosen.arm)
    rows = entries(arm, judged, chosen, seed=TASKS)
    about = (
        "Robots, tasks and control law are those of the fault response, with other seeds. One joint locks, swings freely or "
        f"has a frozen sensor, and is braked. Then a ball with a radius of {100 * RADIUS:g} cm and a margin of "
        f"{100 * MARGIN:g} cm is placed on the remaining path that the tool followed without the ball. It is at least "
        f"{100 * AWAY:g} cm from the position of braking and from the target, and not in the way of the stopping arm. Each "
        "task is therefore finished without the ball, and **without collision checks each would touch it**. *Touched* means "
        "that the mesh of a link touches the ball. Whether a detour exists is unknown. Fractions are in per cent, with "
        "Clopper-Pearson intervals of 95 %."
    )
    seeds = f"{TASKS} (tasks and robots), {DRAWS} (faults and balls)"
    write("cell", f"Recovery with an obstacle, {arm.title}", chosen, seeds=seeds, about=about, lines=table(rows))


if __name__ == "__main__":
    main()
