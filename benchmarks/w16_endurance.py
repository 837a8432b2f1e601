"""W16, part E: motions of a Panda along a path that survive most single locks, beside local measures of fault tolerance."""

from __future__ import annotations

import argparse
import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "tests"))  # closed forms of a planar arm

import harness

DURATION = 10.0  # s
LINES, LOCKS, PAIRS, PLANAR, FOUR = 14, 100, 20, 30, 12
INJECTED = 20  # a pair
_FINE = 0.004
_APART = 1e-3  # rad: shorter intervals in which two ways to find ranges differ are rounding


def line(begin, end):
    import holdfast as hf

    return hf.paths.TimedPath(hf.paths.line(begin, end), hf.paths.Constant(DURATION))


def the_line():
    """Tool down, 1 m, at x 0.45 and z 0.35."""
    begin = np.eye(4)
    begin[:3, :3] = np.diag([1.0, -1.0, -1.0])
    begin[:3, 3] = [0.45, -0.5, 0.35]
    end = begin.copy()
    end[1, 3] = 0.5
    return line(begin, end)


def random_line(generator):
    """0.4 to 1 m, in front of the arm, with a random orientation that stays the same."""
    from scipy.spatial.transform import Rotation

    quaternion = generator.normal(size=4)
    way = generator.normal(size=3)
    way *= generator.uniform(0.4, 1.0) / np.linalg.norm(way) / 2
    middle = generator.uniform([0.25, -0.3, 0.2], [0.6, 0.3, 0.8])
    begin = np.eye(4)
    begin[:3, :3] = Rotation.from_quat(quaternion).as_matrix()
    end = begin.copy()
    begin[:3, 3], end[:3, 3] = middle - way, middle + way
    return line(begin, end)


def one_line(chosen: argparse.Namespace) -> str:
    import holdfast as hf

    arm, path = hf.arms.load("panda"), the_line()
    index = hf.indices.relative_manipulability(arm)
    grids = [(26, 0.1), (51, 0.05)] if chosen.quick else [(51, 0.1), (101, 0.05), (201, 0.025)]
    rows = []
    for samples, spacing in grids:
        times = []
        for k in range(chosen.rounds + 1):
            begun, wall = time.process_time(), time.perf_counter()
            best = hf.endure(arm, path, samples=samples, spacing=spacing)
            if k:
                times.append((time.process_time() - begun, time.perf_counter() - wall))
        spent, passed = np.min(times, axis=0)
        low, high = best.interval
        rows.append(
            f"| {samples} x {spacing:g} rad | {best.survival:.4f} | {low:.4f} to {high:.4f} | {best.bound:.4f} "
            f"| {best.gap:.4f} | {spent:.2f} | {passed:.2f} |"
        )
    samples, spacing = grids[-2]
    best = hf.endure(arm, path, samples=samples, spacing=spacing, compare=["least-norm", index])
    detour = hf.endure(arm, path, samples=samples, spacing=spacing, mode="detour")
    tried = best.inject(LOCKS if chosen.quick else 4 * LOCKS)
    others = ", ".join(f"{other.name} {other.survival:.3f}" for other in best.beside)
    joints = ", ".join(f"{x:.2f}" for x in best.by_joint.values())
    return (
        "### W16 E1: the motion that survives most locks on a line of 1 m, Panda, tool down, 10 s, equal rates\n\n"
        "| poses x spacing | survival | on the nodes, within the velocity limits, to with the spacing on top | bound | gap "
        "| processor s, least | wall s, least |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        + "\n".join(rows)
        + f"\n\nBeside it, {samples} poses: {others}. By joint: {joints}. With detours: {detour.survival:.4f}, bound "
        f"{detour.bound:.4f}. {len(tried.time)} locks injected, other integrator: {tried.interval}, "
        f"{100 * tried.alike:.1f} % as the table.\n"
    )


def many_lines(chosen: argparse.Namespace) -> str:
    import holdfast as hf

    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm)
    generator, found, without, inside, alike, away = np.random.default_rng(16), [], 0, 0, [], []
    samples, spacing, wanted = (26, 0.1, 3) if chosen.quick else (101, 0.05, LINES)
    while len(found) < wanted:
        try:
            best = hf.endure(arm, random_line(generator), samples=samples, spacing=spacing, compare=["least-norm", index])
        except hf.HoldfastError:
            without += 1
            continue
        tried = best.inject(LOCKS)
        inside += tried.interval.low <= best.survival <= tried.interval.high
        alike.append(tried.alike)
        found.append((best.survival, best.bound, best.gap, *(other.survival for other in best.beside)))
        away.append([other.off > 0 for other in best.beside])
        off = [f"{other.name} {100 * other.off:.0f} %" for other in best.beside if other.off]
        print(len(found), np.round(found[-1], 3), f"alike {tried.alike:.3f}", "off the path:", off, file=sys.stderr, flush=True)
    values = np.array(found)
    names = ["survival", "bound", "gap", *(other.name for other in best.beside)]
    rows = [f"| {n} | {v.mean():.3f} | {v.min():.3f} | {v.max():.3f} |" for n, v in zip(names, values.T, strict=True)]
    return (
        f"### W16 E2: {wanted} random lines of 0.4 to 1 m, random orientation that stays, {samples} poses, {spacing:g} rad\n\n"
        "| | mean | smallest | largest |\n| --- | ---: | ---: | ---: |\n"
        + "\n".join(rows)
        + f"\n\n{without} more lines had a pose without a configuration, or no continuous motion. {LOCKS} locks on each: "
        f"{100 * np.mean(alike):.2f} % as the table says, the survival inside the 95 % interval on {inside} of {wanted}. "
        f"Off the path at some samples, where nothing counts as survived: "
        + ", ".join(f"{other.name} on {count}" for other, count in zip(best.beside, np.sum(away, axis=0), strict=True))
        + ".\n"
    )


def point_to_point(chosen: argparse.Namespace) -> str:
    """Against all goals on a grid five times as fine, with the ranges of the joints by another algorithm.

    That misses arcs and gaps narrower than a 90th of a joint's range. Where it differs from the curves a proof decides: all
    configurations of the goal with the joint locked there, by branch and bound.
    """
    import holdfast as hf
    from holdfast.solvers import fibres

    arm, generator, locks = hf.arms.load("panda"), np.random.default_rng(16), np.random.default_rng(17)
    velocity = np.array([j.velocity for j in arm.joints])
    ours, brute, straight, right, differ, lost_inside, tried = [], [], [], 0, 0, 0, 0
    for _ in range(3 if chosen.quick else PAIRS):
        start, other = generator.uniform(arm.lower, arm.upper, (2, arm.n))
        pose = arm.forward_kinematics(other)

        def there(k, value, pose=pose):
            low, high = arm.lower.copy(), arm.upper.copy()
            low[k] = high[k] = value
            return len(hf.all_configurations(arm, pose, limits=(low, high)).q) > 0

        got = hf.endure_to(arm, start, pose)
        ranges = hf.joint_bounds(arm, pose, "pose")
        goals = fibres(arm, pose, spacing=_FINE)[0].q
        lost = np.zeros((len(goals), arm.n))
        for k, arcs in enumerate(ranges):
            arcs, agreed, parts = decided(arcs, got.ranges[k], lambda value, k=k: there(k, value))
            right, differ = right + agreed, differ + parts
            low, high = np.minimum(start[k], goals[:, k]), np.maximum(start[k], goals[:, k])
            safe = sum(np.maximum(np.minimum(high, b) - np.maximum(low, a), 0.0) for a, b in arcs)
            lost[:, k] = (high - low - safe) / velocity[k]
        ours.append(got.exposure)
        brute.append(lost.sum(axis=1).min())
        nearest = goals[np.abs(goals - start).max(axis=1).argmin()]
        way = start + np.linspace(0, 1, 2001)[:, None] * (nearest - start)
        out = [~np.any([(x >= a) & (x <= b) for a, b in arcs], axis=0) for x, arcs in zip(way.T, got.ranges, strict=True)]
        straight.append(float(np.mean(out, axis=1).sum()) * float((np.abs(nearest - start) / velocity).max()))
        for q, k in zip(got.at(locks.uniform(0, got.duration, INJECTED)), locks.integers(0, arm.n, INJECTED), strict=True):
            if any(a + 1e-6 <= q[k] <= b - 1e-6 for a, b in got.ranges[k]):
                tried += 1
                lost_inside += not there(k, q[k])
    ours_, brute_ = np.array(ours), np.array(brute)
    return (
        f"### W16 E3: point to point, {len(ours)} random pairs, exposure of one joint to locks that lose the goal\n\n"
        f"In the mean {ours_.mean():.3f} s, brute force {brute_.mean():.3f} s (largest difference "
        f"{np.abs(ours_ - brute_).max():.4f} s, {100 * np.abs(ours_ / brute_ - 1).max():.3f} % of a pair's), straight and "
        f"synchronised to the nearest goal {np.mean(straight):.3f} s. The ranges of the joints differ from those of "
        f"`joint_bounds` in {differ} intervals longer than {_APART:g} rad; branch and bound says that the curves are "
        f"right in {right} of them, and brute force goes by what it says. {tried} locks injected inside the ranges: "
        f"{lost_inside} lost.\n"
    )


def decided(theirs, ours, there):
    """Arcs by the proof ``there`` where two lists of them differ; in how many intervals ``ours`` is right, of how many."""
    ends = sorted({x for arc in (*theirs, *ours) for x in arc})
    arcs, right, differ = [], 0, 0
    for a, b in pairwise(ends):
        said = [any(low <= (a + b) / 2 <= high for low, high in every) for every in (theirs, ours)]
        yes = said[0]
        if said[0] != said[1] and b - a > _APART:
            yes = there((a + b) / 2)
            right, differ = right + (yes == said[1]), differ + 1
        if yes:
            arcs.append((a, b))
    return arcs, right, differ


def guarantees(chosen: argparse.Namespace) -> str:
    """Planar arms: where is there a motion that survives everything, by closed forms and by the table?"""
    import holdfast as hf
    from unit_links import LIMITS, arm, around, configuration, places, survives

    generator, alike, given, count = np.random.default_rng(16), 0, 0, 0
    while count < (5 if chosen.quick else PLANAR):
        machine = arm(None if count % 2 else LIMITS)
        begin, way = generator.uniform(-1.8, 1.8, 2), generator.normal(size=2)
        end = begin + way * generator.uniform(0.2, 1.0) / np.linalg.norm(way)
        path = hf.paths.TimedPath(hf.paths.line([*begin, 0.0], [*end, 0.0]), hf.paths.Constant(2.0))
        try:
            best = hf.endure(machine, path, samples=21, spacing=0.05)
        except hf.HoldfastError:
            continue
        count += 1
        points, alive = places(path, 21), None
        for t in range(20, -1, -1):  # backwards: configurations that survive everything and lead to such
            every = [configuration(0, v, points[t], s) for v in np.arange(-np.pi, np.pi, 0.05) for s in (-1, 1)]
            q = np.array([[x[0], *around(x[1:])] for x in every if x is not None]).reshape(-1, 3)
            q = q[((q >= machine.lower) & (q <= machine.upper)).all(axis=1)]
            q = np.array([x for x in q if all(survives(machine, x, k, points[t:]) for k in range(3))]).reshape(-1, 3)
            if alive is not None and len(q) and len(alive):
                q = q[np.abs(around(q[:, None] - alive)).max(axis=2).min(axis=1) <= 0.3]
            alive = q
            if not len(q):
                break
        sure = bool(len(alive))
        given += sure
        alike += sure == best.guaranteed and (best.guaranteed or best.never is not None or best.survival > 0.99)
    return (
        f"### W16 E4: guarantees on {count} lines of planar arms of three unit links, half of them with narrow limits\n\n"
        f"Brute force over closed forms finds a motion that survives every lock on {given}; `endure` agrees on {alike}.\n"
    )


def more_redundancy(chosen: argparse.Namespace) -> str:
    """Two degrees of redundancy, where the survival is a lower bound: how far below the truth about the same motion?"""
    import four_links
    import holdfast as hf

    generator, samples, rows = np.random.default_rng(4), 15, []
    while len(rows) < (2 if chosen.quick else FOUR):
        middle, width = generator.uniform(-0.5, 0.5, 4), generator.uniform(0.6, 1.3, 4)
        low, high = middle - width, middle + width
        machine = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=a, upper=b) for a, b in zip(low, high, strict=True)], name="4R")
        begin, end = machine.forward_kinematics(generator.uniform(low, high, (2, 4)))[:, :3, 3]
        end = begin + (end - begin) * min(1.0, 1.2 / np.linalg.norm(end - begin))
        path = hf.paths.TimedPath(hf.paths.line(begin, end), hf.paths.Constant(2.0))
        try:
            best = hf.endure(machine, path, task="planar", samples=samples, spacing=0.15, seed=1)
        except hf.HoldfastError:
            continue
        points = path.pose(np.linspace(0, 2.0, 4 * (samples - 1) + 1))[:, :2, 3]
        truth = np.array(
            [[four_links.survives(low, high, q, k, points[4 * t :]) for k in range(4)] for t, q in enumerate(best.q)]
        )
        weights = best.rates.weights(best.time)
        said = best.survives
        rows.append((best.survival, weights @ truth.mean(axis=1) / weights.sum(), (said & ~truth).sum(), (truth & ~said).sum()))
    ours, true, wrong, missed = np.array(rows).T
    return (
        f"### W16 E5: two degrees of redundancy, {len(rows)} lines of planar arms of four unit links with narrow limits\n\n"
        f"Survival, a lower bound: {ours.mean():.3f} in the mean; of the same motions by reachability over closed forms "
        f"{true.mean():.3f}, largest difference {(true - ours).max():.3f}. Of {len(rows) * samples * 4} verdicts "
        f"{wrong.sum():.0f} say survived where it is not, {missed.sum():.0f} say lost where it is survived.\n"
    )


def main() -> None:
    chosen = harness.options(__doc__, rounds=3)
    for part in (one_line, many_lines, point_to_point, guarantees, more_redundancy):
        print(part(chosen), flush=True)


if __name__ == "__main__":
    main()
