"""W16, part F: degraded Pandas finish tasks with and without a cell, beside usual planners; proofs that they cannot.

The suite is that of ``holdfast bench fail-active``. ``--suite FOLDER`` shows a run that was made before, or resumes it.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

import harness

CELL = Path(__file__).parents[1] / "examples" / "cells" / "fail-active.yaml"
CASES, TARGETS, STARTS = 200, 200, 400
PLANNERS = ("recover", "differential-ik", "differential-ik-8-starts", "rrt-connect")


def suite(chosen: argparse.Namespace) -> str:
    import holdfast as hf

    folder = Path(chosen.suite or tempfile.mkdtemp(prefix="fail-active-"))
    cases = 20 if chosen.quick else chosen.cases
    found = hf.bench.fail_active(
        hf.arms.load("panda"), folder, cell=CELL, cases=cases, tasks=chosen.task, planners=chosen.planner or PLANNERS
    )
    lines = []
    for s in found.scores:
        feasible, (middle, late) = s.success_of_feasible, np.quantile(s.seconds, [0.5, 0.95])
        lines.append(
            f"| {s.task}{', cell' * s.in_cell} | {s.method} | {s.cases} | {s.solved} | {s.proved} | {s.argued} | {s.undecided} "
            f"| {s.refused} | {s.contradictions} | {'' if feasible is None else feasible} | {middle:.2g} | {late:.2g} |"
        )
    return (
        "### W16 F: a degraded Panda finishes its task\n\n"
        "Seed 1; cases, cell and tolerances: `holdfast bench fail-active`. A contradiction is a case solved within 1 mm and "
        "0.5 deg that is proved infeasible exactly.\n\n"
        "| task | planner | cases | solved | proved infeasible | argued | undecided | refused | contradictions "
        "| solved of those not proved infeasible | median, s | 95 %, s |\n"
        "| --- | --- " + "| ---: " * 10 + "|\n" + "\n".join(lines) + "\n"
    )


def proofs(chosen: argparse.Namespace) -> str:
    """How soon boxes decide goals of the healthy arm after locks or with ranges of 30 %, and whether it is true."""
    import holdfast as hf
    from holdfast.arm.task import as_task
    from holdfast.recovery.rows import row_solver

    arm, generator, rows = hf.arms.load("panda"), np.random.default_rng(16), []
    cases = (("position", 3, 0), ("position", 4, 0), ("pose", 2, 0), ("pose", 1, 0), ("pose", 0, 7), ("pose", 0, 2))
    for task, locks, ranges in cases:
        spent, ends, against, known = [], [], 0, 0
        solver = row_solver(arm, as_task(arm, task))
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
            q, kept = generator.uniform(low, high, (STARTS, arm.n)), np.ones((STARTS, solver.rows.m))
            poses = np.repeat(pose[None], STARTS, axis=0)
            q = solver.run(q, poses, kept, high > low)
            there = q[solver.meets(q, poses, kept, high > low) & ((q >= low) & (q <= high)).all(axis=1)]
            known += len(there) > 0
            against += found.none and len(there) > 0
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


def main() -> None:
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--suite", help="folder of the suite; a new one if not given")
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
