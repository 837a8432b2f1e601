"""Run the suite: ``python -m benchmarks.planners panda --cases 100 --task reach-pose --task line --out fail-active``.

Ctrl-C stops after the current cases; the same command resumes.
"""

from __future__ import annotations

import argparse
import shlex
import signal
import sys
from pathlib import Path

from benchmarks.planners.cases import CASE_MAKERS
from benchmarks.planners.methods import PLANNERS_BY_NAME
from benchmarks.planners.report import format_json, format_text, save
from benchmarks.planners.suite import fail_active

import holdfast as hf


def main() -> int:
    """Run the cases, write the files, and print the scores; return 130 after Ctrl-C."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.planners", description=__doc__)
    parser.add_argument("arm", nargs="?", default="panda", help="built-in name, or file of an arm")
    parser.add_argument("--base", help="base link of a URDF or MJCF file")
    parser.add_argument("--tip", help="tip link of a URDF or MJCF file")
    parser.add_argument("--out", type=Path, default=Path("fail-active"), help="folder for the cases and results")
    parser.add_argument("--cases", type=int, default=1000, help="cases of each task that reaches a pose; of the others a tenth")
    parser.add_argument("--task", action="append", help=f"one of {', '.join(CASE_MAKERS)}; may be repeated; default: all")
    parser.add_argument(
        "--planner", action="append", help=f"one of {', '.join(PLANNERS_BY_NAME)}; may be repeated; default: recover"
    )
    parser.add_argument("--cell", type=Path, help="cell file (YAML): each task runs with and without these objects")
    parser.add_argument("--seconds", type=float, default=10.0, help="time limit of a case, on one thread")
    parser.add_argument("--seed", type=int, default=1, help="the same seed gives the same cases")
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    options = parser.parse_args()
    interrupts: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _: interrupts.append(number))
    try:
        suite = fail_active(
            hf.arms.load(options.arm, base=options.base, tip=options.tip),
            options.out,
            cell=options.cell,
            cases=options.cases,
            tasks=options.task,
            planners=options.planner or ["recover"],
            seconds=options.seconds,
            seed=options.seed,
            stop=lambda: bool(interrupts),
        )
        files = save(suite, f"python -m benchmarks.planners {shlex.join(sys.argv[1:])}")
    except hf.HoldfastError as error:
        print(error, file=sys.stderr)
        return 2
    print(format_json(suite) if options.json else "\n".join([format_text(suite), *(f"written: {file}" for file in files)]))
    return 130 if interrupts else 0


if __name__ == "__main__":
    sys.exit(main())
