"""Two faults, one after the other: what the chain makes of the second, while the arm goes on without the first joint."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

import holdfast as hf
from holdfast.response.diagnosis import Monitor
from holdfast.response.faults import FaultEvent, feasible
from measurements.faults.chain import CENTRING, ONSET, PLANNED_LIMIT, Trial, entries, grouped, options, write

TASKS, DRAWS = 5200, 52  # seeds
KINDS = ("locked", "limp", "sensor_freeze")
AFTER = 2.0  # s after the first joint was braked


def judged(arm: hf.Arm, trial: Trial, monitor: Monitor) -> dict[str, Any] | None:
    """What became of a task; None where nothing is braked, or the tool is at its target before the second fault."""
    rng = np.random.default_rng([DRAWS, trial.number])
    first, second = rng.choice(arm.n, 2, replace=False)
    kinds, onset = rng.choice(KINDS, 2), float(rng.uniform(*ONSET))
    events = [FaultEvent(kinds[0], arm.joint_names[first], onset)]

    def run(**more: Any) -> hf.FaultRun:
        common: dict[str, Any] = {"body": trial.body, "seed": trial.number, "centring": CENTRING, "time_limit": PLANNED_LIMIT}
        return hf.simulate_faults(trial.law, trial.q0, trial.target, faults=events, **common, **more)

    alone = run(monitor=monitor)
    brake = next((a.time for a in alone.actions if a.what == "brake"), np.inf)
    if alone.time[-1] < brake + AFTER + 0.2:
        return None
    events.append(FaultEvent(kinds[1], arm.joint_names[second], brake + AFTER))
    both, known = run(monitor=monitor), run(react="known")
    at = np.clip(both.q[int(np.searchsorted(both.time, events[1].onset))], arm.lower, arm.upper)
    places = {event: float(at[arm.joint_index(event.joint)]) for event in events}
    noticed = [a.time for a in both.actions if a.what == "alarm" and a.time > events[1].onset]
    named = [v.joint for v in both.verdicts if v.time > events[1].onset]
    braked = [a.joint for a in both.actions if a.what == "brake"]
    return {
        "number": trial.number,
        "kind": str(kinds[1]),
        "task": trial.law.task.name,
        "feasible": feasible(arm, trial.target, places, task=trial.law.task, at=at).answer,
        "known at once": known.ok,
        "chain": both.ok,
        "noticed": bool(noticed),
        "delay": noticed[0] - events[1].onset if noticed else None,
        "its joint named": events[1].joint in named,
        "both braked": {event.joint for event in events} <= set(braked),
        "another joint braked": bool(set(braked) - {event.joint for event in events}),
        "an alarm between": any(brake < v.time <= events[1].onset for v in both.verdicts),
        "did": [action.sentence() for action in both.actions],
    }


SHOWN = ("feasible", "chain", "known at once", "noticed")
COLUMNS = (*SHOWN, "its joint named", "both braked", "another joint braked", "an alarm between")


def table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of all tasks, by what is feasible, by task, and by kind of the second fault."""
    told = [{**row, "feasible": row["feasible"] == "yes"} for row in rows]
    groups = {"all": told, "feasible": [row for row in told if row["feasible"]]}
    groups |= {task: [row for row in told if row["task"] == task] for task in ("position", "pose")}
    groups |= {f"second: {kind}": [row for row in told if row["kind"] == kind] for kind in KINDS}
    delay = [1e3 * row["delay"] for row in told if row["delay"] is not None]
    late = f"{np.median(delay):.0f} / {np.quantile(delay, 0.9):.0f} ms (median / 90 %)" if delay else "-"
    return [*grouped(groups, COLUMNS, counted="tasks"), "", f"Delay of the alarm after the second fault: {late}."]


def main() -> None:
    """Make the table of one arm and write it; what a run before has judged is taken from the store."""
    chosen = options("second", __doc__, (10, "tasks in which the second fault comes in time"))
    arm = hf.arms.load(chosen.arm)
    rows = entries(arm, judged, chosen, seed=TASKS)
    about = (
        "Robots, tasks and control law are those of the fault response, with other seeds. Two joints, sampled uniformly, fail "
        "one after the other. Each is locked, swings freely or has a frozen sensor. The first fault begins after "
        f"{ONSET[0]:g} to {ONSET[1]:g} s, and the second one {AFTER:g} s after the first joint was braked. Tasks that end "
        "before are omitted. A task is feasible if a motion to the target exists from the configuration at the second fault, "
        "with both joints locked there. Fractions are in per cent, with Clopper-Pearson intervals of 95 %."
    )
    seeds = f"{TASKS} (tasks and robots), {DRAWS} (faults)"
    write("second", f"A second fault, {arm.title}", chosen, seeds=seeds, about=about, lines=table(rows))


if __name__ == "__main__":
    main()
