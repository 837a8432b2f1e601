"""The same work done by two checkouts in turn: how much faster the second is, and how long each compiles.

    python benchmarks/side_by_side.py before=/path/to/one after=/path/to/other [--rounds 5] [--only TEXT]

Each checkout is measured with the work that its own copy of this file describes, because names differ between versions; work
that only one of them has is left out. Both use the Python that runs this. A round is a process of each, which works for a
second, or once where that takes longer; the least processor time counts. Cold is the first call in a process with an empty
kernel cache, less the least one; the rate is that of the steady state. Of the studio (W11) only what the server computes is
here: a browser draws the same for both.
"""

from __future__ import annotations

import argparse
import json
import os
import runpy
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

# Of each workload: what is set up, what is measured, and how many rows that is.
WORK = {
    "W1 worst index, PA10, 1 thread": (
        "arm = hf.arms.load('pa10-9dof'); f = hf.indices.relative_manipulability(arm); q = draw(arm, 400_000)",
        "f(q)",
        400_000,
    ),
    "W2 gradient, PA10, 1 thread": (
        "arm = hf.arms.load('pa10-9dof'); f = hf.indices.relative_manipulability(arm); q = draw(arm, 200_000)",
        "f.gradient(q)",
        200_000,
    ),
    "W3 inverse kinematics, PA10, 1 thread": (
        "arm = hf.arms.load('pa10-9dof'); poses = arm.forward_kinematics(draw(arm, 4000))",
        "hf.solve_ik(arm, poses)",
        4000,
    ),
    "W4 optimise relative manipulability, PA10": (
        "arm = hf.arms.load('pa10-9dof'); f = hf.indices.relative_manipulability(arm)\n"
        "p = arm.forward_kinematics(draw(arm, 60))",
        "hf.optimise(arm, p, f)",
        60,
    ),
    "W4 optimise condition number, Panda": (
        "arm = hf.arms.load('panda'); f = hf.indices.by_name('condition-number', arm)\n"
        "p = arm.forward_kinematics(draw(arm, 30))",
        "hf.optimise(arm, p, f)",
        30,
    ),
    "W5 torque susceptibility and gradient, Panda": (
        "arm = hf.arms.load('panda'); f = hf.susceptibility.torque(arm, 'effort'); q = draw(arm, 100_000)",
        "f(q), f.gradient(q)",
        100_000,
    ),
    "W6 control step, torque gradient, Panda": (
        "from holdfast.kinematics.path_following import GradientProjection\narm = hf.arms.load('panda')\n"
        "law = GradientProjection(arm, hf.susceptibility.torque(arm, 'effort'), rate_cap=1.0, period=0.01)\n"
        "step = law.prepare() if hasattr(law, 'prepare') else law.step\nq = draw(arm, 1)[0]; v = rng.normal(size=6) / 10",
        "for _ in range(20_000): step(q, v)",
        20_000,
    ),
    "W8 closed loop, pseudoinverse, planar 3R": (
        "arm = hf.arms.load('planar-3r'); law = hf.control.pseudoinverse(arm, 'planar'); q = rng.uniform(-3, 3, (40_000, 3))",
        "hf.simulate(law, q, np.tile([1.2, 0.7], (40_000, 1)), locked=[1], time_limit=60)",
        40_000,
    ),
    "W8 closed loop, pseudoinverse, Panda, position": (
        "arm = hf.arms.load('panda'); law = hf.control.pseudoinverse(arm, 'position'); q = draw(arm, 2000)\n"
        "x = arm.forward_kinematics(draw(arm, 2000))[:, :3, 3]",
        "hf.simulate(law, q, x, locked=[3], time_limit=60)",
        2000,
    ),
    "W9 failure-tolerant inverse, iiwa14, pose, 1 thread": (
        "arm = hf.arms.load('iiwa14'); law = hf.control.failure_tolerant(arm)\n"
        "q = draw(arm, 20_000); v = rng.normal(size=(20_000, 6))",
        "law.velocity(q, v)",
        20_000,
    ),
    "W9 failure-tolerant step, iiwa14, pose": (
        "arm = hf.arms.load('iiwa14'); law = hf.control.failure_tolerant(arm); q = draw(arm, 1)[0]; v = rng.normal(size=6)\n"
        "step = law.prepare() if hasattr(law, 'prepare') else law.step",
        "for _ in range(5000): step(q, v)",
        5000,
    ),
    "W9 closed loop, failure-tolerant, iiwa14, pose": (
        "arm = hf.arms.load('iiwa14'); law = hf.control.failure_tolerant(arm); q = draw(arm, 100)\n"
        "x = arm.forward_kinematics(draw(arm, 100))",
        "hf.simulate(law, q, x, locked=[3], time_limit=60)",
        100,
    ),
    "W10 task bank, trials and measures, planar 3R": (
        "from holdfast.teleop import TaskBank, run_tasks, sample_tasks\n"
        "arm = hf.arms.load('planar-3r'); tasks = sample_tasks(arm, 400, seed=1)",
        "TaskBank.from_trials(tasks, run_tasks(arm, tasks))",
        4800,
    ),
    "W10 experiment of 2 simulated people, recorded and replayed": (
        "from holdfast.teleop import read_protocol, replay_trials, simulate_experiment\n"
        "protocol = read_protocol(); protocol.plants",
        "with tempfile.TemporaryDirectory() as t, simulate_experiment(Path(t) / 'study', protocol, 2, seed=0) as r:\n"
        "    replay_trials(r)",
        1,
    ),
    "W10 control cycle, failure-tolerant, planar 3R": (
        "from holdfast.teleop import read_protocol\nplant = read_protocol().plants[1]\n"
        "q = rng.uniform(-3, 3, 3); v = np.array([0.03, 0.04]); mask = np.ones(3)",
        "for _ in range(10_000): plant.step_one(q, v, mask)",
        10_000,
    ),
    "W11 numbers that the studio's server computes, Panda": (
        "from holdfast.model.arm.task import as_task\n"
        "from holdfast.interface.studio.machine import CompiledArm\n"
        "arm = hf.arms.load('panda'); m = CompiledArm(arm, as_task(arm, 'pose')); q = draw(arm, 300)\n"
        "def read(x):\n"
        "    m.evaluate_index_bars(x, 'relative-manipulability'); m.evaluate_susceptibility_bars(x, 'torque')",
        "for x in q: read(x)",
        300,
    ),
    "W12 study of 4 chunks, PA10, 1 thread": (
        "sys.path.insert(0, BENCHMARKS); import study_scaling as w\n"
        "kept = tempfile.TemporaryDirectory(); asked = w.study(Path(kept.name), 4, 1 << 20)",
        "with tempfile.TemporaryDirectory() as t: w.timed(Path(t) / 'out', asked, w.threads(1))",
        1 << 22,
    ),
    "W13 designs at poses with gradient, PA10": (
        "sys.path.insert(0, BENCHMARKS)\nfrom design_gradients import designs, holdfast\n"
        "from optimised_configurations import reachable_poses\nrun = holdfast(reachable_poses(16)); many = designs(16)",
        "run(many)",
        256,
    ),
}
PROGRAM = """
import json, os, sys, tempfile, time
from pathlib import Path
import numpy as np
import holdfast as hf
hf.set_threads(1)
rng = np.random.default_rng(0)
def draw(arm, rows):
    low, high = np.where(np.isfinite(arm.lower), arm.lower, -3.0), np.where(np.isfinite(arm.upper), arm.upper, 3.0)
    return rng.uniform(low, high, (rows, arm.n))
def timed(what):
    begin = time.process_time()
    exec(what, globals())
    return time.process_time() - begin
cold = timed(SETUP) + timed(WORK)
best = spent = timed(WORK)
while spent < 1:
    again = timed(WORK)
    best, spent = min(best, again), spent + again
print(json.dumps([cold - best, best]))
"""


def run(checkout: Path, setup: str, work: str, cache: str, level: str) -> tuple[float, float]:
    """Seconds of a cold start beyond the work, and of the work."""
    program = f"SETUP, WORK, BENCHMARKS = {setup!r}, {work!r}, {str(checkout / 'benchmarks')!r}\n{PROGRAM}"
    kept = {**os.environ, "PYTHONPATH": str(checkout / "src"), "HOLDFAST_CACHE": cache, "XDG_CACHE_HOME": cache}
    done = subprocess.run(
        [sys.executable, "-c", program], env={**kept, "HOLDFAST_LEVEL": level}, check=True, capture_output=True, text=True
    )
    first, work_s = json.loads(done.stdout.splitlines()[-1])
    return first, work_s


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkouts", nargs=2, metavar="NAME=PATH")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    sides = [(name, Path(path)) for name, _, path in (text.partition("=") for text in given.checkouts)]
    (a, before), (b, after) = sides
    print(f"| work, one thread | first use {a}, s | first use {b}, s | rows/s {a} | rows/s {b} | {b} is faster by (range) |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    before_work, after_work = (runpy.run_path(str(path / "benchmarks" / "side_by_side.py"))["WORK"] for path in (before, after))
    for name, (setup, work, rows) in after_work.items():
        if given.only not in name or name not in before_work:
            continue
        old_setup, old_work, _ = before_work[name]
        steady = []
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            cold = [run(before, old_setup, old_work, one, "")[0], run(after, setup, work, two, "")[0]]
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            for _ in range(given.rounds):
                steady.append([run(before, old_setup, old_work, one, "1")[1], run(after, setup, work, two, "1")[1]])
        ratios = sorted(x / y for x, y in steady)
        rates = [rows / statistics.median(side) for side in zip(*steady, strict=True)]
        middle = statistics.median(ratios)
        print(
            f"| {name} | {cold[0]:.2f} | {cold[1]:.2f} | {rates[0]:.3g} | {rates[1]:.3g} | "
            f"{middle:.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}) |",
            flush=True,
        )


if __name__ == "__main__":
    main()
