"""W23: one search for a route of a Panda, shortened, next to VAMP; soundness of checks and proofs of edges.

The problems are those of ``benchmarks/locked_planning``, whose README says which two files to download.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import harness

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT))

CELL = ROOT / "examples" / "cells" / "fail-active.yaml"
EDGES, BATCH = 1_000_000, 20_000
POINTS = 20  # random configurations of each proved edge that are looked at
TRIES = 3  # searches of each problem; the median of their times counts


def searches(chosen) -> str:
    """The time of one search and the shortening of its route, and the length of the route."""
    from benchmarks.locked_planning.adapters import Holdfast, Vamp
    from benchmarks.locked_planning.problems import draw, make_healthy, read_problems
    from benchmarks.locked_planning.robots import load_robot, write_files

    from holdfast.response.recovery.routes import _SEARCH_LEVELS
    from holdfast.response.recovery.space import FreeSpace, JointMetric

    try:
        robot = load_robot("spheres", None)
        problems = draw(make_healthy(read_problems(None), robot))[: 20 if chosen.quick else None]
    except (FileNotFoundError, ValueError) as error:
        return f"Not measured: {error}"
    urdf = write_files(robot, Path(tempfile.mkdtemp(prefix="route-search-")))
    ours, vamp = Holdfast(robot, urdf), None if Vamp.missing() else Vamp(robot, urdf)
    free, (spacing, room, rounds) = np.ones(7, dtype=bool), _SEARCH_LEVELS[0]
    metric = JointMetric.for_arm(ours.arm, "travel", None, free)
    times: dict[str, list[float]] = {"holdfast": [], "vamp": []}
    lengths: dict[str, list[float]] = {"holdfast": [], "vamp": []}
    proved = 0
    for problem in problems:
        space = FreeSpace(ours.arm, free, ours.cell_clearance(problem), 0.0, np.stack([problem.start, problem.goal]))
        search = space.compiled_search(metric, np.stack([problem.start, problem.goal]))
        environment = None if vamp is None else vamp._environment(problem)
        spent: dict[str, list[float]] = {"holdfast": [], "vamp": []}
        length: dict[str, float] = {"holdfast": np.nan, "vamp": np.nan}
        for seed in range(TRIES + 1):  # the first one warms up
            begun = time.thread_time()
            found = search.search(problem.start, problem.goal[None], seed, max_rounds=rounds, spacing=spacing, room=room)
            spent["holdfast"].append(time.thread_time() - begun)
            if found is not None:
                length["holdfast"] = float(metric.cumulative_length(found[0])[-1])
            if vamp is not None:
                vamp.sampler.reset()
                vamp.sampler.skip(100 * seed)
                begun = time.thread_time()
                result = vamp.plan(problem.start.tolist(), [problem.goal.tolist()], environment, vamp.settings, vamp.sampler)
                short = vamp.panda.simplify(result.path, environment, vamp.simplify, vamp.sampler) if result.solved else None
                spent["vamp"].append(time.thread_time() - begun)
                if short is not None:
                    length["vamp"] = short.path.cost()
        if found is not None:
            q = found[0]
            q[0], q[-1] = problem.start, problem.goal
            proved += bool(space.are_segments_valid(q[:-1], q[1:]).all())
        for name, values in spent.items():
            if values:
                times[name].append(statistics.median(values[1:]))
                lengths[name].append(length[name])
    lines = [
        "| planner | problems | solved | median, us | 95 %, us | path length, median, rad |",
        "|---|---:|---:|---:|---:|---:|",
    ]
    for name, seconds in times.items():
        if seconds:
            middle, late = 1e6 * np.quantile(seconds, [0.5, 0.95])
            solved = int(np.isfinite(lengths[name]).sum())
            lines.append(
                f"| {name} | {len(seconds)} | {solved} | {middle:.0f} | {late:.0f} | {np.nanmedian(lengths[name]):.3f} |"
            )
    text = "\n".join(lines) + f"\n\n{proved} of {len(problems)} routes of the last search are proved over their whole length."
    if times["vamp"]:
        ratios = np.quantile(times["holdfast"], [0.5, 0.95]) / np.quantile(times["vamp"], [0.5, 0.95])
        both = np.array(lengths["holdfast"]) / np.array(lengths["vamp"])
        text += (
            f" holdfast takes {ratios[0]:.2f} times as long as VAMP in the median, {ratios[1]:.2f} times at 95 %; its routes "
            f"have {np.nanmedian(both):.3f} times the length in the median."
        )
    return text


def soundness(chosen) -> str:
    """Whether checked configurations and proved edges are free by the kernel for single configurations."""
    import holdfast as hf
    from holdfast.response.recovery.space import MIN_RESOLVED_MOTION_M, FreeSpace

    arm, rng = hf.arms.load("panda"), np.random.default_rng(23)
    clearance = hf.Clearance(arm, cell=hf.Cell.load(CELL))
    space = FreeSpace(arm, np.ones(7, dtype=bool), clearance, 0.0, arm.lower[None])
    edges, count = space.edges, 2 * BATCH if chosen.quick else EDGES
    wrong, deepest, proved_count, least = 0, 0.0, 0, np.inf
    for _ in range(count // BATCH):
        a = rng.uniform(arm.lower, arm.upper, (BATCH, 7))
        steps = rng.normal(size=a.shape) * rng.choice([0.05, 0.2, 0.5], (BATCH, 1))
        ends = a + steps
        accepted = edges.check_edges(a, steps)
        depth = -clearance.margin_left(ends[accepted])  # the last configuration of an edge is always checked
        wrong += int((depth > 1e-5).sum())
        deepest = max(deepest, float(depth.max()))
        proved = np.flatnonzero(edges.prove_edges(a, steps, None, MIN_RESOLVED_MOTION_M))
        proved_count += len(proved)
        for _ in range(POINTS):
            q = a[proved] + rng.uniform(size=(len(proved), 1)) * steps[proved]
            least = min(least, float(clearance.margin_left(q).min()))
    return (
        f"Of {count:,} random edges of the built-in Panda in the work cell of the examples, {wrong} were accepted with an end "
        f"that penetrates by more than 0.01 mm (deepest: {1e3 * max(deepest, 0):.2g} mm). {proved_count:,} edges were proved. "
        f"The least clearance in {POINTS} random configurations of each of them is {1e3 * least:.2g} mm."
    )


def main() -> None:
    chosen = harness.options(__doc__)
    print(
        "### W23: one search for a route of a Panda\n\nProblems of MotionBenchMaker with the spheres of VAMP; one search "
        "and the shortening of its route, without the tables of the objects. Time of the thread, the planners in turns.\n\n"
        f"{searches(chosen)}\n\n{soundness(chosen)}"
    )


if __name__ == "__main__":
    main()
