"""Lines of a Panda: the best motion beside its bound, beside local measures of fault tolerance, and injected locks."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from papers.claims import Claim, Verdict
from papers.part import Part
from scipy.spatial.transform import Rotation

import holdfast as hf

Array = NDArray[np.float64]

DURATION = 10.0  # s
LINES, LOCKS = 14, 100


def verdict(met: bool) -> Verdict:
    """Of a bar."""
    return Verdict.HOLDS if met else Verdict.FALSE


def line(begin: Array, end: Array, duration: float = DURATION) -> hf.paths.TimedPath:
    """From pose or point to another, s."""
    return hf.paths.TimedPath(hf.paths.line(begin, end), hf.paths.Constant(duration))


def the_line() -> hf.paths.TimedPath:
    """Tool down, 1 m, at x 0.45 and z 0.35."""
    begin = np.diag([1.0, -1.0, -1.0, 1.0])
    begin[:3, 3] = [0.45, -0.5, 0.35]
    end = begin.copy()
    end[1, 3] = 0.5
    return line(begin, end)


def random_line(generator: np.random.Generator) -> hf.paths.TimedPath:
    """0.4 to 1 m, in front of the arm, with a random orientation that stays the same."""
    quaternion = generator.normal(size=4)
    way = generator.normal(size=3)
    way *= generator.uniform(0.4, 1.0) / np.linalg.norm(way) / 2
    middle = generator.uniform([0.25, -0.3, 0.2], [0.6, 0.3, 0.8])
    begin = np.eye(4)
    begin[:3, :3] = Rotation.from_quat(quaternion).as_matrix()
    end = begin.copy()
    begin[:3, 3], end[:3, 3] = middle - way, middle + way
    return line(begin, end)


def one_line(quick: bool) -> Part:
    """E1, but for its time, which is in ``benchmarks/lock_survival.py``."""
    arm, path = hf.arms.load("panda"), the_line()
    index = hf.indices.relative_manipulability(arm)
    grids = [(26, 0.1), (51, 0.05)] if quick else [(51, 0.1), (101, 0.05), (201, 0.025)]
    rows, found = [], {}
    for samples, spacing in grids:
        compare: list[Any] = ["least-norm", index] if (samples, spacing) == grids[-2] else []
        found[samples] = best = hf.plan_motion(arm, path, samples=samples, spacing=spacing, compare=compare)
        assert best.interval is not None
        low, high = best.interval
        rows.append(
            f"| {samples} x {spacing:g} rad | {best.survival:.4f} | {low:.4f} to {high:.4f} | {best.survival_bound:.4f} "
            f"| {best.gap:.4f} |"
        )
    samples, spacing = grids[-2]
    best, finer = found[samples], found[grids[-1][0]]
    detour = hf.plan_motion(arm, path, samples=samples, spacing=spacing, mode="detour")
    tried = best.test_locks(LOCKS if quick else 4 * LOCKS)
    beside = {other.name: other.survival for other in best.comparisons}
    local = beside[f"gradient projection of {index.name}"]
    gap = best.gap if best.gap is not None else np.nan
    change = abs(best.survival - finer.survival)
    claims = [
        Claim(
            "E1 survival on the line of 1 m",
            "0.744, asked 0.743",
            f"{best.survival:.4f}",
            "finds the same motion or a better one; it is smoothed",
            verdict(best.survival >= 0.743),
        ),
        Claim(
            "E1 gap to the bound",
            "0.751, asked 0.01",
            f"{best.survival_bound:.4f}, {gap:.4f}",
            "our bound takes at each node the best of all places up to halfway to its neighbours",
            verdict(gap <= 0.01),
        ),
        Claim(
            "E1 above gradient projection",
            "0.214, asked 0.15",
            f"{best.survival - local:.3f}",
            f"gradient projection {local:.3f} beside 0.530: its start and step are ours",
            verdict(best.survival - local >= 0.15),
        ),
        Claim(
            "E1 grid halved",
            "0.002, asked 0.005",
            f"{change:.4f}",
            f"{best.survival:.4f} and {finer.survival:.4f}",
            verdict(change <= 0.005),
        ),
        Claim("E1 with detours", "0.777", f"{detour.survival:.4f}", f"bound {detour.survival_bound:.4f}"),
        Claim(
            "E1 injected locks",
            "399 of 400 as the table",
            f"{100 * tried.agreement:.1f} % of {len(tried.time)}",
            f"survived {tried.interval}",
            verdict(tried.agreement >= 0.99 and tried.interval.low <= best.survival <= tried.interval.high),
        ),
    ]
    joints = ", ".join(f"{x:.2f}" for x in best.by_joint.values())
    section = [
        "## E1: a line of 1 m, Panda, tool down, 10 s, equal rates",
        "",
        "| poses x spacing | survival | on the nodes, within the velocity limits, to with the spacing on top | bound | gap |",
        "|---|---:|---:|---:|---:|",
        *rows,
        "",
        f"Beside it, {samples} poses: {', '.join(f'{name} {x:.3f}' for name, x in beside.items())}. "
        f"By joint: {joints} (the first study: 0.71, 1, 0.87, 0.01, 1, 1, 0.61).",
    ]
    return Part(claims, section)


def many_lines(quick: bool) -> Part:
    """E2."""
    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm)
    found: list[Any] = []
    generator, without, inside, alike, away = np.random.default_rng(16), 0, 0, [], []
    samples, spacing, wanted = (26, 0.1, 3) if quick else (101, 0.05, LINES)
    names: list[str] = []
    while len(found) < wanted:
        try:
            best = hf.plan_motion(arm, random_line(generator), samples=samples, spacing=spacing, compare=["least-norm", index])
        except hf.HoldfastError:
            without += 1
            continue
        tried = best.test_locks(LOCKS)
        inside += tried.interval.low <= best.survival <= tried.interval.high
        alike.append(tried.agreement)
        assert best.survival_bound is not None
        assert best.gap is not None
        found.append((best.survival, best.survival_bound, best.gap, *(other.survival for other in best.comparisons)))
        away.append([other.off > 0 for other in best.comparisons])
        names = [other.name for other in best.comparisons]
        print(len(found), np.round(found[-1], 3), f"alike {tried.agreement:.3f}", file=sys.stderr, flush=True)
    values, off = np.array(found), np.sum(away, axis=0)
    rows = [
        f"| {n} | {v.mean():.3f} | {v.min():.3f} | {v.max():.3f} |"
        for n, v in zip(["survival", "bound", "gap", *names], values.T, strict=True)
    ]
    mean = dict(zip(["survival", "bound", "gap", *names], values.mean(axis=0), strict=True))
    local = f"gradient projection of {index.name}"
    other_lines = "other lines, drawn alike; those of the first study were not kept"
    ended = f"it leaves the path at joint limits on {off[names.index(local)]} of our lines, where nothing counts as survived"
    claims = [
        Claim("E2 mean survival, 14 lines", "0.677", f"{mean['survival']:.3f}", other_lines),
        Claim(
            "E2 mean gap",
            "0.013, asked 0.02",
            f"{mean['gap']:.4f}",
            f"largest {values[:, 2].max():.4f}",
            verdict(mean["gap"] <= 0.02),
        ),
        Claim("E2 gradient projection, mean", "0.297", f"{mean[local]:.3f}", ended),
        Claim(
            "E2 injected locks as the table",
            "asked 99 %",
            f"{100 * np.mean(alike):.2f} %",
            f"{LOCKS} on each line",
            verdict(bool(np.mean(alike) >= 0.99)),
        ),
        Claim(
            "E2 survival within the interval of the injection",
            "asked all",
            f"{inside} of {wanted}",
            "95 % intervals: one in 20 may miss",
            verdict(inside == wanted),
        ),
        Claim(
            "a local measure buys nothing over a task",
            "0.297 beside least norm's 0.278",
            f"{mean[local]:.3f} beside {mean['least norm']:.3f}",
            f"the best motion {mean['survival']:.3f}; the measure's own best "
            f"continuous motion {mean[f'best continuous {index.name}']:.3f}, for which it must be known along the whole path",
            verdict(mean[local] - mean["least norm"] < 0.1 * (mean["survival"] - mean["least norm"])),
        ),
    ]
    section = [
        f"## E2: {wanted} random lines of 0.4 to 1 m, random orientation that stays, {samples} poses, {spacing:g} rad",
        "",
        "| | mean | smallest | largest |",
        "|---|---:|---:|---:|",
        *rows,
        "",
        f"{without} more lines had a pose without a configuration, or no continuous motion. Off the path at some samples: "
        + ", ".join(f"{name} on {count}" for name, count in zip(names, off, strict=True))
        + ".",
    ]
    return Part(claims, section)
