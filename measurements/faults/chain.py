"""The table of section 7: random faults on random tasks, and how many of them are finished by whom."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

import holdfast as hf
from holdfast.response.diagnosis import Bounds, Monitor, calibrate, diagnose
from holdfast.response.faults import Fault, FaultModel, feasible
from measurements.faults.store import limits

HERE = Path(__file__).parent
TASKS, DRAWS, CALIBRATION = 2500, 25, 900_000  # seeds
SPEED, GAIN, DAMPING, CENTRING = 0.25, 2.0, 0.02, 0.15  # m/s, 1/s, m, 1/s
ONSET = (0.3, 1.5)  # s
AWAY = (0.2, 0.6)  # m, of a target
COULOMB, VISCOUS = 0.5, 0.3
# Of 100 faults so many of each kind, as in the specification.
MIX: dict[str, tuple[int, Fault]] = {
    "locked": (35, hf.faults.locked(onset=ONSET)),
    "limp": (15, hf.faults.limp(onset=ONSET)),
    "weak": (10, hf.faults.weak(gain=(0.2, 0.7), onset=ONSET)),
    "friction": (10, hf.faults.friction(coulomb=(2 * COULOMB, 8 * COULOMB), onset=ONSET)),
    "sensor_freeze": (10, hf.faults.sensor_freeze(onset=ONSET)),
    "reduced_range": (5, hf.faults.reduced_range(travel=(0.02, 0.3), onset=ONSET)),
    "reduced_speed": (5, hf.faults.reduced_speed(velocity=(0.2, 0.6), onset=ONSET)),
    "sensor_bias": (5, hf.faults.sensor_bias(bias=(0.005, 0.05), onset=ONSET)),
    "sensor_drift": (5, hf.faults.sensor_drift(rate=(0.01, 0.05), onset=ONSET)),
}


@dataclass(frozen=True)
class Trial:
    """One task of one robot."""

    number: int
    law: hf.control.Law
    q0: np.ndarray
    target: np.ndarray
    body: hf.Body


def trials(arm: hf.Arm, *, seed: int) -> Iterator[Trial]:
    """Without end; half of them positions, half poses."""
    laws = [hf.control.damped(arm, DAMPING, task=task, gain=GAIN, speed_limit=SPEED) for task in ("position", "pose")]
    room = 0.1 * (arm.upper - arm.lower)
    k = 0
    while True:
        rng = np.random.default_rng([seed, k])
        q0 = rng.uniform(arm.lower + room, arm.upper - room)
        ends = np.clip(q0 + rng.uniform(-1.2, 1.2, (64, arm.n)), arm.lower + room, arm.upper - room)
        poses = arm.forward_kinematics(np.vstack([q0, ends]))
        away = np.linalg.norm(poses[1:, :3, 3] - poses[0, :3, 3], axis=1)
        good = np.flatnonzero((away >= AWAY[0]) & (away <= AWAY[1]))
        if good.size:
            pose = poses[1 + good[0]]
            law = laws[k % 2]
            target = pose if law.task.angular else pose[:3, 3]
            yield Trial(k, law, q0, target, hf.Body(seed=seed + k, coulomb=COULOMB, viscous=VISCOUS))
        k += 1


REACTIONS = {  # by the key of a stored row
    "nobody notices": {"react": "none", "centring": CENTRING},
    "nobody notices, no null-space objective": {"react": "none", "centring": 0.0},
    "everything stops at an alarm": {"react": "stop", "centring": CENTRING},
    "chain, without recover": {"react": "chain", "centring": CENTRING, "plan": False},
    "chain": {"react": "chain", "centring": CENTRING},
    "known at once, without recover": {"react": "known", "centring": CENTRING, "plan": False},
}
LIMIT, PLANNED_LIMIT = 12.0, 24.0  # s
LABELS = {  # of columns in tables, by the key of a stored row
    "nobody notices": "no monitor",
    "nobody notices, no null-space objective": "no monitor, no null-space objective",
    "everything stops at an alarm": "stop at an alarm",
    "chain, without recover": "monitor, without recover",
    "chain": "monitor and recover",
    "known at once, without recover": "known fault, without recover",
    "known at once": "known fault",
    "noticed": "detected",
    "its joint named": "joint isolated",
    "an alarm between": "alarm between the faults",
    "by a posture": "by an intermediate configuration",
    "by a route": "by a planned route",
}


def bounds_of(arm: hf.Arm, robots: int, file: Path | None = None) -> Bounds:
    """Of healthy motion to other targets, by other robots; from a file if it is there, else written to it."""
    if file is not None and file.exists():
        return hf.diagnosis.load(file)
    logs = []
    for trial in islice(trials(arm, seed=CALIBRATION), robots):
        run = hf.simulate_faults(trial.law, trial.q0, trial.target, body=trial.body, centring=CENTRING, seed=trial.number)
        logs.append(run.log())
    found = calibrate(arm, logs, coulomb=np.full(arm.n, COULOMB), viscous=np.full(arm.n, VISCOUS))
    if file is not None:
        found.to_json(file)
    return found


def feasible_with(arm: hf.Arm, trial: Trial, known: hf.FaultRun) -> str:
    """Whether the goal was within reach of what was left: ``yes``, ``not found`` or ``unknown``."""
    (event,) = known.events
    j = arm.joint_index(event.joint)
    place = float(np.clip(known.places[j], arm.lower[j], arm.upper[j]))  # stops are soft: some joints are a little beyond
    return feasible(arm, trial.target, {event: place}, task=trial.law.task).answer


def judged(arm: hf.Arm, trial: Trial, monitor: Monitor) -> dict[str, Any] | None:
    """All reactions to one fault; None where the healthy robot does not reach the target, or the fault comes after that."""
    common: dict[str, Any] = {"body": trial.body, "seed": trial.number, "time_limit": LIMIT}
    healthy = hf.simulate_faults(trial.law, trial.q0, trial.target, centring=CENTRING, **common)
    mix = [kind for kind, (count, _) in MIX.items() for _ in range(count)]
    kind = mix[np.random.default_rng([DRAWS, trial.number]).integers(len(mix))]
    faults = FaultModel([MIX[kind][1]], seed=DRAWS)
    (event,) = faults.draw(arm, episode=trial.number)
    if not healthy.ok or event.onset >= healthy.time[-1] - 0.2:
        return None
    found: dict[str, Any] = {"number": trial.number, "kind": kind, "task": trial.law.task.name}
    found["false alarm"] = diagnose(arm, healthy.log(), monitor.bounds).verdict.alarm
    found["hours"] = healthy.time[-1] / 3600
    runs: dict[str, hf.FaultRun] = {}
    for name, options in REACTIONS.items():
        if name == "chain" and runs["chain, without recover"].ok:
            runs[name] = runs["chain, without recover"]
        else:
            limit = PLANNED_LIMIT if name == "chain" else LIMIT
            watch = monitor if options["react"] in ("stop", "chain") else None
            given = {**common, **options, "time_limit": limit}
            runs[name] = hf.simulate_faults(
                trial.law, trial.q0, trial.target, faults=faults, episode=trial.number, monitor=watch, **given
            )
        found[name] = runs[name].ok
    chain = runs["chain"]
    found["feasible"] = feasible_with(arm, trial, runs["known at once, without recover"])
    found["delay"] = chain.delay if np.isfinite(chain.delay) else None
    named = {verdict.joint for verdict in chain.verdicts if verdict.joint is not None}
    found["named"], found["joint right"] = [verdict.kind for verdict in chain.verdicts], named == {event.joint}
    found["braked"] = [a.joint for a in chain.actions if a.what == "brake"]
    found["wrong brake"] = any(joint != event.joint for joint in found["braked"])
    brake = next((a.time for a in chain.actions if a.what == "brake"), None)
    found["braked after"] = None if brake is None else brake - event.onset
    found["alarms"] = len(chain.verdicts)
    found["planned"], found["ended"] = any(a.what == "plan" for a in chain.actions), chain.outcome
    found["detour"] = any(a.what == "detour" for a in chain.actions)
    found["why"] = chain.actions[-1].sentence() if chain.actions else ""
    if found["delay"] is not None and chain.detection_time < chain.time[-1]:
        at = int(np.searchsorted(chain.time, chain.detection_time))
        both = arm.forward_kinematics(np.stack([chain.reference[at], chain.q[at]]))[:, :3, 3]
        found["distance"] = 1e3 * float(np.linalg.norm(both[0] - both[1]))
    return found


def made_with() -> str:
    """Versions of what made a table."""
    return ", ".join(f"{name} {version(name)}" for name in ("holdfast", "numpy", "mujoco"))


def percent(rows: Sequence[Mapping[str, Any]], name: str) -> str:
    """Format the percentage of the rows in which a column holds, with its exact 95 % interval."""
    hits = sum(bool(row[name]) for row in rows)
    if not rows:
        return "-"
    return f"{100 * hits / len(rows):.1f} ({limits(hits, len(rows))})"


def grouped(groups: Mapping[str, Sequence[Mapping[str, Any]]], columns: Sequence[str], *, counted: str) -> list[str]:
    """A table of these groups of rows: of how many rows of each which column holds."""
    lines = [
        f"| | {counted} | {' | '.join(LABELS.get(column, column) for column in columns)} |",
        "|" + "---|" * (len(columns) + 2),
    ]
    for name, some in groups.items():
        lines.append(f"| {name} | {len(some)} | {' | '.join(percent(some, column) for column in columns)} |")
    return lines


def table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of all faults, by task and by kind."""
    rows = [{**row, "feasible": row["feasible"] == "yes"} for row in rows]
    groups = {"all": rows, "feasible": [row for row in rows if row["feasible"]]}
    groups |= {task: [row for row in rows if row["task"] == task] for task in ("position", "pose")}
    groups |= {kind: [row for row in rows if row["kind"] == kind] for kind in MIX}
    return grouped(groups, ["feasible", *REACTIONS], counted="faults")


def sentences(rows: Sequence[Mapping[str, Any]], robots: int) -> list[str]:
    """What the table does not show."""
    late = [row for row in rows if row["delay"] is not None and row["delay"] >= 0]
    early = sum(row["delay"] is not None and row["delay"] < 0 for row in rows)
    lines = [
        f"{len(late)} of {len(rows)} faults were detected, and the joint was correct in "
        f"{sum(row['joint right'] for row in late)} of these. {early} alarms came before the fault, and a joint without a "
        f"fault was braked in {sum(row['wrong brake'] for row in rows)} runs. The response used an intermediate configuration "
        f"in {sum(row['detour'] for row in rows)} runs and a planned route in {sum(row['planned'] for row in rows)} runs. "
        f"{sum(row['alarms'] > 1 for row in rows)} of {len(rows)} runs had another alarm after the first one.",
        f"The same runs without a fault had {sum(row['false alarm'] for row in rows)} false alarms in "
        f"{sum(row['hours'] for row in rows):.3g} h. The thresholds are 1.5 times the largest residuals of {robots} other "
        "robots, with one healthy run each.",
        "",
    ]
    for kind in ("locked", "limp"):
        some = [row for row in late if row["kind"] == kind]
        if some:
            delay, far = (np.array([row[name] for row in some if name in row]) for name in ("delay", "distance"))
            brake = np.array([row["braked after"] for row in some if row["braked after"] is not None])
            lines.append(
                f"- {kind}: {len(some)} of {sum(row['kind'] == kind for row in rows)} detected, joint correct in "
                f"{sum(row['joint right'] for row in some)}, delay {1e3 * np.median(delay):.0f} / "
                f"{1e3 * np.quantile(delay, 0.9):.0f} ms (median / 90 %), tool off its reference by {np.median(far):.2g} / "
                f"{np.quantile(far, 0.9):.2g} mm, braked after {1e3 * np.median(brake):.0f} / "
                f"{1e3 * np.quantile(brake, 0.9):.0f} ms"
            )
    return lines


def options(program: str, about: str | None, tasks: tuple[int, str]) -> argparse.Namespace:
    """Those of a table of tasks; ``tasks``: how many if not given, and which count."""
    parser = argparse.ArgumentParser(prog=f"python -m measurements.faults.{program}", description=about)
    parser.add_argument("--arm", default="panda")
    parser.add_argument("--tasks", type=int, default=tasks[0], help=tasks[1])
    parser.add_argument("--robots", type=int, default=40, help="other robots that bounds are calibrated on")
    parser.add_argument("--bounds", type=Path, help="file of these bounds: read, or else written")
    parser.add_argument("--store", type=Path, help="lines of JSON, one a task: resumed, and added to")
    return parser.parse_args()


def entries(
    arm: hf.Arm, judge: Callable[[hf.Arm, Trial, Monitor], dict[str, Any] | None], chosen: argparse.Namespace, *, seed: int
) -> list[Mapping[str, Any]]:
    """What became of each task that counts; what a run before has judged is taken from the store."""
    known = chosen.store.read_text(encoding="utf-8").splitlines() if chosen.store and chosen.store.exists() else []
    stored = {entry["number"]: entry for entry in map(json.loads, known)}
    monitor: Monitor | None = None
    rows: list[Mapping[str, Any]] = []
    for trial in trials(arm, seed=seed):
        entry = stored.get(trial.number)
        if entry is None:
            monitor = monitor or Monitor(arm, bounds_of(arm, chosen.robots, chosen.bounds))
            entry = judge(arm, trial, monitor) or {"number": trial.number}
            if chosen.store:
                with chosen.store.open("a", encoding="utf-8") as lines:
                    lines.write(json.dumps(entry) + "\n")
        if "kind" in entry:
            rows.append(entry)
            print(f"\r{len(rows)} of {chosen.tasks} tasks", end="", file=sys.stderr, flush=True)
        if len(rows) >= chosen.tasks:
            break
    return rows


def write(program: str, title: str, chosen: argparse.Namespace, *, seeds: str, about: str, lines: Sequence[str]) -> None:
    """The page of a table of tasks: what made it, what it is about, and its lines."""
    text = [
        f"# {title}",
        "",
        f"Written by `python -m measurements.faults.{program} --arm {chosen.arm} --tasks {chosen.tasks} --robots "
        f"{chosen.robots}` on "
        f"{datetime.now():%Y-%m-%d} with {made_with()}. The seeds are {seeds}, {CALIBRATION} (calibration). Everything is "
        "**simulated**.",
        "",
        about,
        "",
        *lines,
        "",
    ]
    (HERE / f"{program.upper()}-{chosen.arm}.md").write_text("\n".join(text), encoding="utf-8")
    print("\n" + "\n".join(text))


def main() -> None:
    """Make the table of one arm and write it."""
    chosen = options("chain", __doc__, (20, "tasks that the healthy robot finishes, each with a fault"))
    arm = hf.arms.load(chosen.arm)
    rows = entries(arm, judged, chosen, seed=TASKS)
    about = (
        "Each task has its own robot, whose masses and friction differ from the model by up to 20 %. Half of the tasks are "
        f"positions and half are poses, {AWAY[0]:g} to {AWAY[1]:g} m away, and the healthy robot reaches each within "
        f"{LIMIT:g} s. One fault begins after {ONSET[0]:g} to {ONSET[1]:g} s. The control law is the damped inverse at "
        f"{SPEED:g} m/s, which enforces joint limits. Except in one column, it moves the joints towards the middle of their "
        f"ranges at {CENTRING:g}/s. A task is finished if the true tool is within 5 mm and 1 deg for 0.2 s, after at most "
        f"{LIMIT:g} s ({PLANNED_LIMIT:g} s with a plan). Fractions are in per cent, with Clopper-Pearson intervals of 95 %."
    )
    lines = [*table(rows), "", *sentences(rows, chosen.robots)]
    seeds = f"{TASKS} (tasks and robots), {DRAWS} (faults)"
    write("chain", f"Fault response, {arm.title}", chosen, seeds=seeds, about=about, lines=lines)


if __name__ == "__main__":
    main()
