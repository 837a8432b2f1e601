"""W16, part F: degraded Pandas finish tasks with and without a cell, beside usual planners; proofs that they cannot.

The suite is that of ``python -m benchmarks.planners``. ``--suite FOLDER`` shows a run that was made before;
``--before CHECKOUT`` asks the ``recover`` of another checkout the same cases, in a process of its own.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import harness

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT))

CELL = ROOT / "examples" / "cells" / "fail-active.yaml"
CASES, TARGETS = 200, 200
STARTS, STEPS = 200, 40  # of Newton's method
PLANNERS = ("recover", "differential-ik", "differential-ik-8-starts", "rrt-connect")


def suite(chosen: argparse.Namespace) -> str:
    from benchmarks.planners.suite import FailActive, fail_active

    import holdfast as hf

    if chosen.suite:
        found = [FailActive(hf.sweeps.Study.open(folder)) for folder in chosen.suite]
    else:
        folder, cases = tempfile.mkdtemp(prefix="fail-active-"), 20 if chosen.quick else chosen.cases
        planners = chosen.planner or PLANNERS
        panda = hf.arms.load("panda")
        found = [fail_active(panda, folder, cell=CELL, cases=cases, tasks=chosen.task, planners=planners)]
    lines = []
    for s in (score for one in found for score in one.scores):
        feasible, (middle, late) = s.success_of_feasible, np.quantile(s.processor, [0.5, 0.95])
        counts = (s.cases, s.solved, s.proved, s.within, s.argued, s.undecided, s.refused, s.contradictions)
        lines.append(
            f"| {s.task}{', cell' * s.in_cell} | {s.method} | {' | '.join(map(str, counts))} | "
            f"{'' if feasible is None else feasible} | {middle:.2g} | {late:.2g} | {s.processor.max():.2g} |"
        )
    if chosen.before and not chosen.suite:
        lines += rows_before(chosen, folder, cases)
    return (
        "### W16 F: a degraded Panda finishes its task\n\n"
        "Seed 1; cases, cell and tolerances: `python -m benchmarks.planners`. A contradiction is a case solved within 1 mm and "
        "0.5 deg that is proved infeasible within them. Seconds of the processor.\n\n"
        "| task | planner | cases | solved | proved infeasible | so within 1 mm, 0.5 deg | argued | undecided | refused "
        "| contradictions | solved of those not proved infeasible within | median, s | 95 %, s | longest, s |\n"
        "| --- | --- " + "| ---: " * 12 + "|\n" + "\n".join(lines) + "\n"
    )


def rows_before(chosen: argparse.Namespace, folder: str, cases: int) -> list[str]:
    """Rows of the table for another checkout, which runs the cases of ``folder``; its scores.csv has no longest time."""
    other = tempfile.mkdtemp(prefix="fail-active-before-")
    tasks = [word for task in chosen.task or () for word in ("--task", task)]
    checkout = Path(chosen.before).resolve()
    is_command = not (checkout / "benchmarks" / "planners").is_dir()  # of checkouts before the suite left the package
    module = ["holdfast", "bench", "fail-active"] if is_command else ["benchmarks.planners"]
    words = [*module, "panda", "--cell", str(CELL), "--cases", str(cases), *tasks, "--planner", "recover"]
    subprocess.run(
        [sys.executable, "-m", *words, "--out", other],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (checkout / "src", checkout)))},
        stdout=subprocess.DEVNULL,
        check=True,
    )
    digests = [{json.loads(line)["digest"] for line in (Path(x) / "cases.jsonl").open()} for x in (folder, other)]
    if digests[0] != digests[1]:
        sys.exit("the other checkout draws other cases")
    counts = ("cases", "solved", "proved", "within", "argued", "undecided", "refused", "contradictions")
    with (Path(other) / "scores.csv").open() as file:
        return [
            f"| {row['task']}{', cell' * (row['in_cell'] == 'True')} | {row['planner']} of {chosen.before} | "
            f"{' | '.join(row[name] for name in counts)} | {float(row['success_of_feasible']):.4f} | "
            f"{float(row['processor_median']):.2g} | {float(row['processor_95']):.2g} | |"
            for row in csv.DictReader(file)
        ]


def proofs(chosen: argparse.Namespace) -> str:
    """How soon boxes decide goals of the healthy arm after locks or with ranges of 30 %, and whether it is true."""
    import holdfast as hf

    arm, generator, rows = hf.arms.load("panda"), np.random.default_rng(16), []
    cases = (("position", 3, 0), ("position", 4, 0), ("pose", 2, 0), ("pose", 1, 0), ("pose", 0, 7), ("pose", 0, 2))
    for task, locks, ranges in cases:
        spent, ends, against, known = [], [], 0, 0
        hf.all_configurations(arm, np.eye(4), task, time_limit=0.1)
        for _ in range(5 if chosen.quick else TARGETS):
            low, high = arm.lower.copy(), arm.upper.copy()
            for k in generator.choice(arm.n, locks, replace=False):
                low[k] = high[k] = generator.uniform(low[k], high[k])
            for k in generator.choice(arm.n, ranges, replace=False):
                width = 0.3 * (high[k] - low[k])
                low[k] = generator.uniform(low[k], high[k] - width)
                high[k] = low[k] + width
            pose = arm.forward_kinematics(generator.uniform(arm.lower, arm.upper))
            begun = time.process_time()
            found = hf.all_configurations(arm, pose, task, limits=(low, high), time_limit=60.0, most_boxes=10**9)
            spent.append(time.process_time() - begun)
            ends.append(found.finding.name)
            there = newton(arm, task, pose, low, high, generator)
            known += len(there) > 0
            against += found.proved_empty and len(there) > 0
            if found.finding.name == "ALL":
                counts = slice(6 if task == "position" else 7)  # the last joint does not move the tool point
                against += sum(np.abs(found.q - x)[:, counts].max(axis=1).min() > 1e-4 for x in there)
        times, ended = np.array(spent), np.array(ends)
        unknown = len(times) - known
        what = f"{locks} lock{'s' * (locks > 1)}" if locks else f"ranges of 30 % of {ranges} joints"
        within = " | ".join(
            f"{int(((ended == 'NONE') & (times <= limit)).sum())}, {100 * np.mean((ended != 'OPEN') & (times <= limit)):.1f} %"
            for limit in (1, 10, 30)
        )
        last = f"{np.median(times):.2g} | {times.max():.3g}"
        rows.append(f"| {task} | {what} | {len(times)} | {unknown} | {within} | {against} | {last} |")
    return (
        "### W16 F3: proofs by boxes of joints, goals of random healthy configurations\n\n"
        f"One thread, seconds of the processor. Newton's method looks for a configuration from {STARTS} starts; what it finds "
        "may neither be proved absent nor be missing where all configurations are listed. Of each limit: goals proved "
        "to have none, and the fraction of all goals that is decided.\n\n"
        "| rows | failure | goals | none found by Newton's method | within 1 s | 10 s | 30 s | contradictions | median, s "
        "| longest, s |\n"
        "| --- | --- " + "| ---: " * 8 + "|\n" + "\n".join(rows) + "\n"
    )


def newton(arm, task, pose, low, high, generator):  # type: ignore[no-untyped-def]
    """Configurations (K, n) within limits that damped Newton steps from random starts end at."""
    q, free = generator.uniform(low, high, (STARTS, arm.n)), high > low
    size = 3 if task == "position" else 6
    for _ in range(STEPS):
        at = arm.forward_kinematics(q)
        turn = Rotation.from_matrix(pose[:3, :3] @ at[:, :3, :3].transpose(0, 2, 1)).as_rotvec()
        error = np.concatenate([pose[:3, 3] - at[:, :3, 3], turn], axis=1)[:, :size, None]
        slope = arm.jacobian(q)[:, :size] * free
        back = slope.transpose(0, 2, 1)
        q = np.clip(q + (back @ np.linalg.solve(slope @ back + 1e-9 * np.eye(size), error))[..., 0].clip(-0.5, 0.5), low, high)
    return q[np.abs(error).max(axis=(1, 2)) < 1e-8]


def main() -> None:
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--suite", action="append", help="folder of a suite that was run before; may be given again")
    parser.add_argument("--before", metavar="CHECKOUT", help="another checkout, whose recover is asked the same cases")
    parser.add_argument("--cases", type=int, default=CASES, help="of each task that reaches a pose; of the others a tenth")
    parser.add_argument("--planner", action="append", help="only this one; may be given again")
    parser.add_argument("--task", action="append", help="only this one; may be given again")
    parser.add_argument("--part", choices=("proofs", "suite"), help="only this one")
    chosen = harness.options(__doc__, parents=[parser])
    for part in (proofs, suite):
        if chosen.part in (None, part.__name__):
            print(part(chosen), flush=True)


if __name__ == "__main__":
    main()
