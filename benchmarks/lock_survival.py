"""W16, part E: how long the motion takes to find that survives most locks along a line.

What it survives: ``python -m measurements.fail_active``.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1]))  # the papers

from measurements.fail_active.lines import the_line

import harness


def one_line(chosen: argparse.Namespace) -> str:
    import holdfast as hf

    arm, path = hf.arms.load("panda"), the_line()
    index = hf.indices.relative_manipulability(arm)
    grids = [(26, 0.1, [])] if chosen.quick else [(51, 0.1, []), (101, 0.05, []), (201, 0.025, [])]
    if not chosen.quick:
        grids.insert(2, (101, 0.05, ["least-norm", index]))
    rows = []
    for samples, spacing, compare in grids:
        times = []
        for k in range(chosen.rounds + 1):
            begun, wall = time.process_time(), time.perf_counter()
            best = hf.plan_motion(arm, path, samples=samples, spacing=spacing, compare=compare)
            if k:
                times.append((time.process_time() - begun, time.perf_counter() - wall))
        spent, passed = np.min(times, axis=0)
        rows.append(
            f"| {samples} x {spacing:g} rad | {len(best.comparisons) or '-'} | {best.survival:.4f} "
            f"| {best.gap:.4f} | {spent:.2f} | {passed:.2f} |"
        )
    return (
        "### W16 E1: the motion that survives most locks on a line of 1 m, Panda, tool down, 10 s, equal rates\n\n"
        "| poses x spacing | motions compared | survival | gap | processor s, least | wall s, least |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: |\n" + "\n".join(rows) + "\n"
    )


def main() -> None:
    print(one_line(harness.options(__doc__, rounds=3)), flush=True)


if __name__ == "__main__":
    main()
