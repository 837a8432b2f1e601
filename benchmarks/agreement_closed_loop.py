"""Does the closed loop end as an independent integrator says? 10,000 random cases beside scipy's ``solve_ivp``.

Not a question of time: ``run_all.py`` keeps the section of RESULTS.md that ``--write`` makes. The reference takes hours; it is
kept case by case in ``--store``, and a later call goes on where an earlier one stopped.
"""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import argparse
import json
import math
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

import harness

Array = np.ndarray
Rates = Callable[[Any, Any, Any], Array]  # configuration, target and mask -> joint rates for Ke = 1

REST, ARRIVES, MOVES, DECAYS, LIMIT = 1e-8, 1e-5, 1e-3, 0.99, 3000.0  # the stated rule
MOST = 600_000  # evaluations, then the reference gives up
SEED = 20050401


# ---- cases -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Family:
    """Random cases of one arm and law.

    Attributes:
        name: For people.
        links: Lengths of a planar arm, m; empty for the Panda's hand position.
        weights: Of the joint rates.
        damping: 0 for none.
        count: Cases.
    """

    name: str
    links: tuple[float, ...]
    count: int
    weights: tuple[float, ...] = ()
    damping: float = 0.0


FAMILIES = (
    Family("3R, pseudoinverse", (1.0, 1.0, 1.0), 5000),
    Family("3R, weights 1, 4, 0.5", (1.0, 1.0, 1.0), 1000, weights=(1.0, 4.0, 0.5)),
    Family("3R, damping 0.1", (1.0, 1.0, 1.0), 1000, damping=0.1),
    Family("4R, pseudoinverse", (1.0, 0.8, 0.6, 0.4), 1000),
    Family("4R, weights 2, 1, 1, 0.3", (1.0, 0.8, 0.6, 0.4), 800, weights=(2.0, 1.0, 1.0, 0.3)),
    Family("4R, damping 0.2", (1.0, 0.8, 0.6, 0.4), 800, damping=0.2),
    Family("Panda, position, pseudoinverse", (), 100),
    Family("3R, unequal links, pseudoinverse", (1.2, 0.8, 0.5), 300),
)


@dataclass(frozen=True)
class Cases:
    """Starts (N, n), targets (N, m) and lock times (N, n), infinite for never."""

    q0: Array
    target: Array
    lock: Array


@lru_cache
def arm_of(family: Family) -> Any:
    import holdfast as hf

    if not family.links:
        return hf.arms.load("panda")
    return hf.Arm.from_dh([hf.DH(a=a, alpha=0.0) for a in family.links], name=f"planar-{len(family.links)}r")


@lru_cache
def cases(family: Family) -> Cases:
    """One joint locks in each run: from the start in three of four, else within 5/Ke."""
    g = np.random.default_rng([SEED, FAMILIES.index(family)])
    count = family.count
    if family.links:
        n, reach = len(family.links), sum(family.links)
        q0 = g.uniform(-np.pi, np.pi, (count, n))
        angle, radius = g.uniform(-np.pi, np.pi, count), 1.05 * reach * np.sqrt(g.uniform(0, 1, count))
        target = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    else:
        arm = arm_of(family)
        n = arm.n
        q0 = g.uniform(arm.lower, arm.upper, (count, n))
        target = arm.forward_kinematics(g.uniform(arm.lower, arm.upper, (count, n)))[:, :3, 3]
    lock = np.full((count, n), np.inf)
    late = g.uniform(0, 1, count) < 0.25
    lock[np.arange(count), g.integers(0, n, count)] = np.where(late, g.uniform(0, 5, count), 0.0)
    return Cases(q0, target, lock)


# ---- the reference ---------------------------------------------------------------------------------------------------


def rates_of(family: Family) -> tuple[Rates, Callable[[Array], Array]]:
    """Right-hand side for Ke = 1 and the hand's position, without holdfast's equations."""
    return _planar(family) if family.links else _spatial(family)


def _planar(family: Family) -> tuple[Rates, Callable[[Array], Array]]:
    """Columns of J from the definition, the inverse by Cramer's rule; the determinant by Cauchy and Binet's formula."""
    n, links = len(family.links), family.links
    spread = [1 / w for w in family.weights] or [1.0] * n
    square = family.damping**2

    def rates(q: Any, x: Any, mask: Any) -> Array:
        total = px = py = 0.0
        u, v = [0.0] * n, [0.0] * n
        for k in range(n):
            total += q[k]
            u[k], v[k] = -links[k] * math.sin(total), links[k] * math.cos(total)
        for k in range(n - 2, -1, -1):
            u[k] += u[k + 1]
            v[k] += v[k + 1]
        px, py = v[0], -u[0]
        a = b = c = square
        b = 0.0
        for s, y, z in zip(spread, u, v, strict=True):
            a, b, c = a + s * y * y, b + s * y * z, c + s * z * z
        if square:
            d = a * c - b * b
        else:
            d = sum(spread[i] * spread[k] * (u[i] * v[k] - u[k] * v[i]) ** 2 for i in range(n) for k in range(i + 1, n))
        ex, ey = x[0] - px, x[1] - py
        f, g = (c * ex - b * ey) / d, (a * ey - b * ex) / d
        return np.array([m * s * (y * f + z * g) for m, s, y, z in zip(mask, spread, u, v, strict=True)])

    def hand(q: Array) -> Array:
        s = np.cumsum(q)
        return np.array([np.dot(links, np.cos(s)), np.dot(links, np.sin(s))])

    return rates, hand


def _spatial(family: Family) -> tuple[Rates, Callable[[Array], Array]]:
    """Products of NumPy transforms, numpy.linalg.pinv."""
    arm = arm_of(family)
    origins = [np.asarray(joint.origin) for joint in arm.joints]
    axes = [np.asarray(joint.axis) for joint in arm.joints]
    skews = [np.cross(np.eye(3), axis) for axis in axes]
    squares = [k @ k for k in skews]

    def chain(q: Any) -> tuple[Array, Array, Array]:
        r, p = arm.base[:3, :3], arm.base[:3, 3]
        z, o = np.empty((arm.n, 3)), np.empty((arm.n, 3))
        for k in range(arm.n):
            p, r = p + r @ origins[k][:3, 3], r @ origins[k][:3, :3]
            z[k], o[k] = r @ axes[k], p
            r = r @ (np.eye(3) + math.sin(q[k]) * skews[k] + (1 - math.cos(q[k])) * squares[k])
        return p + r @ arm.tool[:3, 3], z, o

    def rates(q: Any, x: Any, mask: Any) -> Array:
        p, z, o = chain(q)
        j = np.cross(z, p - o).T
        return np.asarray(mask * (np.linalg.pinv(j) @ (x - p)))

    return rates, lambda q: chain(q)[0]


class GaveUpError(Exception):
    """Too many evaluations."""


def reference(
    family: Family,
    q0: Array,
    target: Array,
    lock: Array,
    limit: float = LIMIT,
    rtol: float = 1e-10,
    atol: float = 1e-12,
    method: str = "DOP853",
) -> dict[str, Any]:
    """One run by ``solve_ivp``, under the stated rule."""
    from scipy.integrate import solve_ivp

    field, hand = rates_of(family)
    left = MOST

    def ended(outcome: str, reason: str, q: Array, t: float) -> dict[str, Any]:
        error = float(np.linalg.norm(target - hand(q)))
        if outcome == "rest":
            outcome = "converged" if error < ARRIVES else "stuck"
        return {"outcome": outcome, "reason": reason, "q": [float(a) for a in q], "error": error, "time": float(t)}

    q, t = np.array(q0, dtype=float), 0.0
    speeds: dict[float, Array] = {}
    stops = sorted({*lock[(lock > 0) & (lock < 0.8 * limit)], 0.8 * limit, 0.9 * limit, limit})
    for stop in stops:
        mask = (lock > t).astype(float)

        def f(_: float, y: Array, mask: Array = mask) -> Array:
            nonlocal left
            left -= 1
            if left < 0:
                raise GaveUpError
            return field(y, target, mask)

        def rest(s: float, y: Array) -> float:
            return float(np.linalg.norm(f(s, y))) - REST

        rest.terminal = True  # type: ignore[attr-defined]
        try:
            if not np.isfinite(f(t, q)).all():
                return ended("undecided", "singular", q, t)
            if rest(t, q) < 0:
                return ended("rest", "", q, t)
            watch = t >= 0.8 * limit
            found = solve_ivp(f, (t, stop), q, method, rtol=rtol, atol=atol, events=rest, dense_output=watch)
        except GaveUpError:
            return ended("undecided", "steps", q, t)
        except (ZeroDivisionError, np.linalg.LinAlgError, ValueError):
            return ended("undecided", "singular", q, t)
        q, t = found.y[:, -1], float(found.t[-1])
        if found.status == 1:
            return ended("rest", "", q, t)
        if found.status != 0:
            return ended("undecided", "singular", q, t)
        if watch:
            dense = found.sol(np.linspace(found.t[0], stop, 3001)).T
            speeds[stop] = np.array([np.linalg.norm(field(y, target, mask)) for y in dense])
    early, late = speeds[0.9 * limit], speeds[limit]
    if min(early.min(), late.min()) > MOVES and late.max() >= DECAYS * early.max():
        return ended("moving", "", q, t)
    return ended("undecided", "slow", q, t)


# ---- keeping it ------------------------------------------------------------------------------------------------------


def work(job: tuple[int, list[int]]) -> list[dict[str, Any]]:
    family = FAMILIES[job[0]]
    c = cases(family)
    with np.errstate(all="ignore"):
        return [{"family": job[0], "case": k, **reference(family, c.q0[k], c.target[k], c.lock[k])} for k in job[1]]


def stored(path: Path) -> dict[tuple[int, int], dict[str, Any]]:
    """What is there already; a line that was cut off counts as not there."""
    found = {}
    for line in path.read_text().splitlines() if path.exists() else ():
        try:
            row = json.loads(line)
        except json.JSONDecodeError:
            continue
        found[row["family"], row["case"]] = row
    return found


def jobs(done: set[tuple[int, int]], size: int = 10) -> Iterator[tuple[int, list[int]]]:
    """The cases left, families side by side, so that a part of the whole is a fair part."""
    left = [[k for k in range(f.count) if (i, k) not in done] for i, f in enumerate(FAMILIES)]
    chunks = [(k / FAMILIES[i].count, i, row[k : k + size]) for i, row in enumerate(left) for k in range(0, len(row), size)]
    for _, i, chunk in sorted(chunks):
        yield i, chunk


def integrate(path: Path, processes: int) -> None:
    done = set(stored(path))
    total, begun, start = sum(f.count for f in FAMILIES), len(done), time.monotonic()
    path.parent.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(processes) as pool, path.open("a") as file:
        count = begun
        for job in as_completed([pool.submit(work, job) for job in jobs(done)]):
            rows = job.result()
            file.writelines(json.dumps(row) + "\n" for row in rows)
            file.flush()
            count += len(rows)
            rate = (count - begun) / (time.monotonic() - start)
            harness.progress(f"{count} of {total} cases, {rate:.2f}/s, {(total - count) / rate / 60:.0f} min left")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--store", type=Path, default=Path("build/agreement_closed_loop.jsonl"), help="(default %(default)s)")
    parser.add_argument("--processes", type=int, default=2, help="(default %(default)s)")
    chosen = parser.parse_args()
    integrate(chosen.store, chosen.processes)


if __name__ == "__main__":
    main()
