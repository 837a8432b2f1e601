"""W10: the teleoperation laboratory: a task bank, a whole experiment with simulated operators, and one control cycle."""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices this small gain nothing from more
os.environ.setdefault("MKL_NUM_THREADS", "1")

import argparse
import statistics
import tempfile
import time
from pathlib import Path

import numpy as np

import harness
from control_steps import clock_time, percentiles, timed
from failure_tolerant_inverse import by_golden_section, planar_jacobian
from harness import Spread

SUBSTEPS = 10
LIMIT, DEAD_ZONE, RADIUS, CYCLES = 0.05, 0.005, 0.1, 1000
BANK_ASKED, EXPERIMENT_ASKED, CYCLE_ASKED = 10.0, 30.0, 50.0  # s, s, us


# ---- the same in plain NumPy, a trial at a time ----------------------------------------------------------------------------


def hand(q: np.ndarray) -> np.ndarray:
    s = np.cumsum(q)
    return np.array([np.cos(s).sum(), np.sin(s).sum()])


def rates(q: np.ndarray, v: np.ndarray, tolerant: bool) -> np.ndarray:
    """The law: pseudoinverse, or damped with the damping that a golden section finds (m = 2: PKE has one minimum)."""
    j = planar_jacobian(q)
    speed = np.linalg.norm(v)
    if tolerant and speed > 0:
        return speed * by_golden_section(j, v / speed)
    return j.T @ np.linalg.solve(j @ j.T, v)


def cycle(q: np.ndarray, v: np.ndarray, mask: np.ndarray, tolerant: bool) -> tuple[np.ndarray, np.ndarray]:
    actual = np.zeros(2)
    for k in range(SUBSTEPS):
        moving = mask * rates(q, v, tolerant)
        if k == 0:
            actual = planar_jacobian(q) @ moving
        q = q + moving / SUBSTEPS
    return q, actual


def trial(q: np.ndarray, target: np.ndarray, mask: np.ndarray, tolerant: bool) -> np.ndarray:
    """One trial of the computer, and M1 to M11 of it, NaN if the hand does not arrive."""
    x = hand(q)
    qs, xs, vs, actuals, still = [q], [x], [], [], 0
    for _ in range(CYCLES):
        if np.linalg.norm(target - x) <= RADIUS:
            break
        v = target - x
        v = v * min(1.0, LIMIT / np.linalg.norm(v))
        q, actual = cycle(q, v, mask, tolerant)
        after = hand(q)
        still = still + 1 if np.linalg.norm(after - x) < 1e-6 else 0
        x = after
        qs, xs, vs, actuals = [*qs, q], [*xs, x], [*vs, v], [*actuals, actual]
        if still >= 50:
            break
    if np.linalg.norm(target - x) > RADIUS:
        return np.full(11, np.nan)
    return eleven(np.array(qs), np.array(xs), np.array(vs), np.array(actuals), target)


def eleven(q: np.ndarray, x: np.ndarray, v: np.ndarray, a: np.ndarray, target: np.ndarray) -> np.ndarray:
    along = target - x[0]
    share = np.clip((x - x[0]) @ along / (along @ along), 0, 1)
    aside = np.linalg.norm(x - x[0] - share[:, None] * along, axis=1)
    to_go = np.linalg.norm(x - target, axis=1)
    speed, done = np.linalg.norm(v, axis=1), np.linalg.norm(a, axis=1)
    error = np.linalg.norm(v - a, axis=1) / speed
    angle = np.arctan2(v[:, 0] * a[:, 1] - v[:, 1] * a[:, 0], (v * a).sum(axis=1))
    turned = np.abs(angle[done > 1e-12 * speed])
    return np.array(
        [
            len(v),
            np.linalg.norm(np.diff(x, axis=0), axis=1).sum(),
            aside.max(),
            aside.mean(),
            np.maximum(np.diff(to_go), 0).sum(),
            np.abs(np.diff(q, axis=0)).sum(),
            error.mean(),
            error.max(),
            turned.mean() if len(turned) else 0.0,
            turned.max(initial=0.0),
            np.linalg.norm(np.diff(v, axis=0), axis=1).sum(),
        ]
    )


# ---- the bank --------------------------------------------------------------------------------------------------------------


def bank(chosen: argparse.Namespace) -> str:
    from holdfast import arms
    from holdfast.teleop import SCENARIO_NAMES, TaskBank, run_tasks, sample_tasks

    each, few = (20, 2) if chosen.quick else (400, 10)
    arm = arms.load("planar-3r")
    tasks = sample_tasks(arm, each, seed=1)
    sample = np.linspace(0, len(tasks) - 1, few).astype(np.int64)
    masks = [tasks.healthy_mask(s.failed) for s in SCENARIO_NAMES]

    def drawn() -> None:
        sample_tasks(arm, each, seed=1)

    def ours() -> TaskBank:
        return TaskBank.from_trials(tasks, run_tasks(arm, tasks))

    def plain() -> np.ndarray:
        return np.array(
            [
                [trial(tasks.q0[i], tasks.target[i], mask[i], "tolerant" in s.law) for i in sample]
                for s, mask in zip(SCENARIO_NAMES, masks, strict=True)
            ]
        )

    harness.progress("W10: task bank")
    found, expected = ours(), plain()
    here = found.measures[:, sample]
    both = np.isfinite(here) & np.isfinite(expected)
    error = float((np.abs(here - expected) / np.maximum(np.abs(expected), 1e-3))[both].max())
    first, second = harness.alternate(ours, plain, chosen.rounds)
    draw = statistics.median([harness.seconds(drawn) for _ in range(chosen.rounds)])
    factor = len(tasks) / len(sample)
    ratio = Spread.of([factor * b / a for a, b in zip(first, second, strict=True)])
    whole = statistics.median(first)
    lines = [
        [
            "**holdfast `task_bank`**",
            harness.number(whole + draw),
            "-",
            "-",
            f"of it {draw:.2g} s to draw reachable tasks; asked for: below {BANK_ASKED:g} s for 1200 on two quiet cores",
        ],
        ["the trials and measures of it", harness.number(whole), "1", "-", f"{len(tasks) * len(SCENARIO_NAMES)} trials"],
        [
            "NumPy, a trial at a time",
            harness.number(factor * statistics.median(second)),
            str(ratio),
            f"{error:.0e}",
            f"extrapolated from {len(sample)} tasks in {len(SCENARIO_NAMES)} scenarios",
        ],
    ]
    head = ["contender", "s", "holdfast is faster by (range)", "largest difference of a measure", "note"]
    return harness.table(f"W10: {len(tasks)} tasks in {len(SCENARIO_NAMES)} scenarios, planar 3R", head, lines)


# ---- the experiment --------------------------------------------------------------------------------------------------------


def experiment(chosen: argparse.Namespace) -> str:
    from holdfast.teleop import TrialKind, read_protocol, replay_trials, simulate_experiment

    protocol = read_protocol()
    people = 2 if chosen.quick else 24
    protocol.plants  # noqa: B018 - compiled before the clock runs
    times, again, counts = [], [], (0, 0)
    for seed in range(min(chosen.rounds, 3)):
        harness.progress(f"W10: experiment {seed + 1}")
        with tempfile.TemporaryDirectory() as folder:
            start = time.perf_counter()
            records = simulate_experiment(Path(folder) / "study", protocol, people, seed=seed)
            times.append(time.perf_counter() - start)
            with records:
                again.append(harness.seconds(lambda r=records: replay_trials(r)))
                counts = tuple(len(records.entries(kind=k)) for k in (TrialKind.TRIAL, TrialKind.TRAINING))
    asked = f"{counts[0]} trials and {counts[1]} of training; asked for: below {EXPERIMENT_ASKED:g} s for 24 people"
    lines = [
        [f"{people} simulated people, training to last rating, recorded", str(Spread.of(times)), asked],
        ["every trial replayed", str(Spread.of(again)), "differences looked at"],
    ]
    return harness.table("W10: an experiment", ["", "s (range)", "note"], lines)


# ---- one cycle -------------------------------------------------------------------------------------------------------------


def one_cycle(chosen: argparse.Namespace) -> str:
    from holdfast.teleop import read_protocol

    calls = 100 if chosen.quick else chosen.calls
    protocol = read_protocol()
    g = np.random.default_rng(1)
    q = np.ascontiguousarray(g.uniform(-np.pi, np.pi, (500, 3)))
    angle = g.uniform(-np.pi, np.pi, 500)
    v = LIMIT * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    mask = np.ones(3)
    lines = []
    for plant, tolerant, name in ((protocol.plants[0], False, "pseudoinverse"), (protocol.plants[1], True, "failure-tolerant")):
        harness.progress(f"W10: control cycle, {name}")

        def ours(i: int, plant=plant) -> np.ndarray:
            return plant.step_one(q[i], v[i], mask)[0]

        def plain(i: int, tolerant=tolerant) -> np.ndarray:
            return cycle(q[i], v[i], mask, tolerant)[0]

        difference = max(float(np.abs(ours(i) - plain(i)).max()) for i in range(100))
        timed(ours, ours, calls)
        alone = [t for _ in range(chosen.rounds) for t in timed(ours, ours, calls)[1]]
        less = max(calls // 10, 10)  # of the slow one
        rounds = [timed(ours, plain, less) for _ in range(chosen.rounds)]
        own, other = ([t for both in rounds for t in both[k]] for k in (0, 1))
        ratio = Spread.of([statistics.median(b) / statistics.median(a) for a, b in rounds])
        lines.append([f"**holdfast `Plant.cycle`**, {name}", *percentiles(alone), "-", "1", "-"])
        lines.append([f"NumPy, {name}", *percentiles(other), " / ".join(percentiles(own)), str(ratio), f"{difference:.0e}"])
    head = ["contender", "median us", "p99 us", "holdfast beside it, median / p99 us", "holdfast is faster by (range)"]
    text = harness.table("W10: one control cycle, planar 3R", [*head, "largest difference of a joint, rad"], lines)
    return (
        f"{text}\nA cycle is {SUBSTEPS} sub-steps, each with the law evaluated anew; {calls} calls in a round, 500 random "
        f"configurations, {chosen.rounds} rounds; the clock's own time, {clock_time():.2g} us, is inside. Asked for: "
        f"below {CYCLE_ASKED:g} us. "
        "Joints differ most near singularities, where Euler steps of the pseudoinverse are large."
    )


def main() -> None:
    extra = argparse.ArgumentParser(add_help=False)
    extra.add_argument("--calls", type=int, default=2000, help="calls of both in a round (default %(default)s)")
    chosen = harness.options(__doc__, parents=[extra])
    print(bank(chosen))
    print(experiment(chosen))
    print(one_cycle(chosen))


if __name__ == "__main__":
    main()
