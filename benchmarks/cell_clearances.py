"""W15: a Panda with its collision meshes in a cell of eight objects: bound, exact sign and exact distance, on one thread."""

from __future__ import annotations

import os

os.environ["HOLDFAST_THREADS"] = "1"  # the peers have one
os.environ["HOLDFAST_LEVEL"] = "1"  # the better code at once: compiling is not what is measured

import argparse
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1]))  # the tests' oracles

import harness
import panda
from harness import Spread

CONTACT = 1e-5  # m: nearer than this two libraries may differ
STEP = 1e-6
Ask = Callable[[np.ndarray], np.ndarray]


def clearance(cell):
    import holdfast as hf

    return hf.Clearance(panda.ours(), cell=cell, itself=False)


def cells():
    from tests.model.collision import geometry

    return geometry.of_primitives(), geometry.of_hulls(), geometry.of_channels()


# ---- peers -----------------------------------------------------------------------------------------------------------


def in_mujoco(cell) -> Ask:
    from tests.model.collision.geometry import InMujoco

    return InMujoco(cell).touches


def in_coal(cell, distances: bool) -> Ask:
    from tests.model.collision.geometry import InCoal

    made = InCoal(cell)
    return made.distances if distances else made.touches


def in_fcl(cell) -> Ask:
    from tests.model.collision.geometry import InFcl

    return InFcl(cell, clearance(cell)).touches


def alternate(
    first: Callable[[], object], second: Callable[[], object], rounds: int, clock: Callable[[], float] = time.thread_time
) -> tuple[list[float], list[float]]:
    """As :func:`harness.alternate`, in processor time: all contenders have one thread, and the machine may be shared."""
    times: tuple[list[float], list[float]] = ([], [])
    for k in range(rounds + 1):
        for call, kept in zip((first, second), times, strict=True):
            start = clock()
            call()
            if k:
                kept.append(clock() - start)
    return times


# ---- how fast --------------------------------------------------------------------------------------------------------


def speed(chosen: argparse.Namespace) -> str:
    many, few = (2000, 50) if chosen.quick else (50_000, 500)
    q = panda.configurations(many)
    primitives, hulls, channels = cells()
    ours = {"bound": "__call__", "bound with gradient": "nearest", "sign": "sign", "distance": "exact"}
    races = [
        ("bound", primitives, "MuJoCo, kinematics and collisions", lambda: in_mujoco(primitives), many // 10),
        ("bound", primitives, "coal, distance of every pair", lambda: in_coal(primitives, True), few),
        ("bound with gradient", primitives, "coal, distance of every pair", lambda: in_coal(primitives, True), few),
        ("bound", hulls, "MuJoCo, kinematics and collisions", lambda: in_mujoco(hulls), many // 10),
        ("bound with gradient", hulls, "coal, distance of every pair", lambda: in_coal(hulls, True), few),
        ("bound", channels, "coal, distance of every pair", lambda: in_coal(channels, True), few),
        ("sign", primitives, "MuJoCo, kinematics and collisions", lambda: in_mujoco(primitives), many // 10),
        ("sign", primitives, "python-fcl, every pair", lambda: in_fcl(primitives), few),
        ("sign", primitives, "coal, every pair", lambda: in_coal(primitives, False), few),
        ("sign", hulls, "MuJoCo, kinematics and collisions", lambda: in_mujoco(hulls), many // 10),
        ("sign", channels, "coal, every pair", lambda: in_coal(channels, False), few),
        ("distance", primitives, "coal, distance of every pair", lambda: in_coal(primitives, True), few),
        ("distance", hulls, "coal, distance of every pair", lambda: in_coal(hulls, True), few),
        ("distance", channels, "coal, distance of every pair", lambda: in_coal(channels, True), few),
    ]
    lines = []
    for what, cell, name, make, rows in races:
        harness.progress(f"W15: {what}, {cell.name}: {name}")
        mine = getattr(clearance(cell), ours[what])
        some = q if what.startswith("bound") and cell is primitives else q[: many // 5]
        try:
            theirs = make()
        except ImportError as missing:
            lines.append([what, cell.name, "-", name, "-", f"not installed: {missing.name}"])
            continue
        first, second = alternate(lambda mine=mine, some=some: mine(some), lambda f=theirs, n=rows: f(q[:n]), chosen.rounds)
        own, other = ([n / t / 1e3 for t in times] for n, times in ((len(some), first), (rows, second)))
        ratio = Spread.of([a / b for a, b in zip(own, other, strict=True)])
        lines.append(
            [
                what,
                cell.name,
                harness.number(statistics.median(own)),
                name,
                harness.number(statistics.median(other)),
                str(ratio),
            ]
        )
    head = ["question", "cell", "holdfast, thousand/s", "peer", "peer, thousand/s", "holdfast is faster by (range)"]
    return harness.table("W15: configurations of a Panda in a cell of eight objects, one thread", head, lines)


def one_row(chosen: argparse.Namespace) -> str:
    """Called from Python with one configuration."""
    primitives = cells()[0]
    asked = clearance(primitives)
    rows = panda.configurations(20 if chosen.quick else 2000)
    lines = []
    for name, ask in (
        ("bound", asked),
        ("gradient of the bound", asked.gradient),
        ("sign", asked.sign),
        ("distance", asked.exact),
    ):
        ask(rows[0])
        times = [harness.seconds(lambda row=row, ask=ask: ask(row)) * 1e6 for row in rows]
        lines.append([name, f"{np.median(times):.0f}", f"{np.quantile(times, 0.99):.0f}"])
    return harness.table("W15: one configuration at a time", ["question", "median us", "p99 us"], lines)


# ---- how right -------------------------------------------------------------------------------------------------------


def agreement(chosen: argparse.Namespace) -> str:
    q = panda.configurations(50 if chosen.quick else 10_000, seed=7)
    lines = []
    for cell in cells():
        harness.progress(f"W15: agreement, {cell.name}")
        asked = clearance(cell)
        clear, exact, bound = asked.sign(q), asked.exact(q), asked(q)
        expected = in_coal(cell, True)(q)
        sure = np.abs(expected) > CONTACT
        convex = cell.name != cells()[2].name
        differ = str(int((~clear != in_mujoco(cell)(q))[sure].sum())) if convex else "meshes are hulls there"
        apart = expected > 0
        excess = (expected - bound)[apart]
        lines.append(
            [
                cell.name,
                str(int((~apart).sum())),
                differ,
                str(int((clear != apart)[sure].sum())),
                f"{np.abs(exact - np.maximum(expected, 0)).max():.0e}",
                str(int((~apart & (bound > 0)).sum())),
                f"{-excess.min():.1e}",
                f"{1e3 * excess.mean():.1f}, {1e3 * np.quantile(excess, 0.95):.1f}",
            ]
        )
    head = [
        "cell",
        "of which touch",
        "sign differs from MuJoCo",
        "from coal",
        "distance from coal's, m",
        "bound misses",
        "bound above coal by, m",
        "below it by, mm, mean and 95th percentile",
    ]
    table = harness.table(f"W15: {len(q):,} configurations", head, lines)
    return f"{table}\nThe cover has {len(clearance(cells()[0]).obstacles.balls.link)} spheres."


def gradients(chosen: argparse.Namespace) -> str:
    q = panda.configurations(500 if chosen.quick else 20_000, seed=8)
    lines = []
    for cell in cells():
        asked = clearance(cell)
        ends = [[asked.margin_left(q + side * STEP * e) for side in (-2, -1, 1, 2)] for e in np.eye(panda.N)]
        coarse = np.stack([(d - a) / (4 * STEP) for a, _, _, d in ends], axis=1)
        fine = np.stack([(c - b) / (2 * STEP) for _, b, c, _ in ends], axis=1)
        # At a kink, where another sphere, face or object becomes the nearest, two steps give two slopes.
        smooth = np.abs(coarse - fine).max(axis=1) < 1e-7
        error = np.abs(fine - asked.gradient(q)).max(axis=1)[smooth].max()
        lines.append(
            f"Gradient of the bound among {cell.name} against central differences of {STEP:g} rad in {smooth.sum():,} of "
            f"{len(q):,} configurations in which twice the step says the same to 1e-7: largest error {error:.1e} m/rad.\n"
        )
    return "\n".join(lines)


def assessed(chosen: argparse.Namespace) -> str:
    import holdfast as hf

    poses, cell = 200 if chosen.quick else 20_000, cells()[0]

    def run(cell: hf.Cell | None) -> None:
        hf.assess(panda.ours(), poses=poses, cell=cell)

    first, second = alternate(lambda: run(cell), lambda: run(None), chosen.rounds, time.process_time)
    ratio = Spread.of([a / b for a, b in zip(first, second, strict=True)])
    return f"`assess` of {poses:,} poses takes {ratio} times as long in the cell of primitives as without a cell.\n"


def main() -> None:
    chosen = harness.options(__doc__, rounds=3)
    print(speed(chosen))
    print(one_row(chosen))
    print(agreement(chosen))
    print()
    print(gradients(chosen))
    print(assessed(chosen))


if __name__ == "__main__":
    main()
