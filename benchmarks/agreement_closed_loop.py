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

REST, ARRIVES, MOVES, DECAYS, LIMIT = 1e-8, 1e-5, 1e-3, 0.99, 3000.0  # the stated rule; holdfast also looks for a return
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
        count: Cases.
        damping: 0 for none.
        drawn: Cases that are drawn, of which the first are taken; ``count`` if 0.
        locks: Joints that lock.
    """

    name: str
    links: tuple[float, ...]
    count: int
    weights: tuple[float, ...] = ()
    damping: float = 0.0
    drawn: int = 0
    locks: int = 1


FAMILIES = (
    Family("3R, pseudoinverse", (1.0, 1.0, 1.0), 5000),
    Family("3R, weights 1, 4, 0.5", (1.0, 1.0, 1.0), 1000, weights=(1.0, 4.0, 0.5)),
    Family("3R, damping 0.1", (1.0, 1.0, 1.0), 1000, damping=0.1),
    Family("4R, pseudoinverse", (1.0, 0.8, 0.6, 0.4), 1000),
    Family("4R, weights 2, 1, 1, 0.3", (1.0, 0.8, 0.6, 0.4), 800, weights=(2.0, 1.0, 1.0, 0.3)),
    Family("4R, damping 0.2", (1.0, 0.8, 0.6, 0.4), 800, damping=0.2),
    Family("Panda, position, pseudoinverse", (), 20, drawn=100),
    Family("3R, unequal links, pseudoinverse", (1.2, 0.8, 0.5), 300),
    Family("5R, two joints lock, pseudoinverse", (0.8, 0.7, 0.6, 0.5, 0.4), 80, locks=2),
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
def cases(family: Family, seed: int = SEED) -> Cases:
    """Joints lock in each run: from the start in three of four, else within 5/Ke."""
    g = np.random.default_rng([seed, FAMILIES.index(family)])
    count = family.drawn or family.count
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
    for _ in range(family.locks):
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
    most: int = MOST,
) -> dict[str, Any]:
    """One run by ``solve_ivp``, under the stated rule."""
    from scipy.integrate import solve_ivp

    field, hand = rates_of(family)
    left = most

    def answer(outcome: str, reason: str, q: Array, t: float) -> dict[str, Any]:
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
                return answer("undecided", "singular", q, t)
            if rest(t, q) < 0:
                return answer("rest", "", q, t)
            watch = t >= 0.8 * limit
            found = solve_ivp(f, (t, stop), q, "DOP853", rtol=rtol, atol=atol, events=rest, dense_output=watch)
        except GaveUpError:
            return answer("undecided", "steps", q, t)
        except (ZeroDivisionError, np.linalg.LinAlgError, ValueError):
            return answer("undecided", "singular", q, t)
        q, t = found.y[:, -1], float(found.t[-1])
        if found.status == 1:
            return answer("rest", "", q, t)
        if found.status != 0:
            return answer("undecided", "singular", q, t)
        if watch:
            samples = min(3001, 100 + int(50 * (stop - found.t[0])))
            dense = found.sol(np.linspace(found.t[0], stop, samples)).T
            speeds[stop] = np.array([np.linalg.norm(field(y, target, mask)) for y in dense])
    early, late = speeds[0.9 * limit], speeds[limit]
    if min(early.min(), late.min()) > MOVES and late.max() >= DECAYS * early.max():
        return answer("moving", "", q, t)
    return answer("undecided", "slow", q, t)


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


# What we found when we looked at the cases that differ.
_TREMBLES = (
    "holdfast is right. The rest point is stiff, its fastest rate {} Ke: at rtol 1e-10 the reference trembles about it above "
    "the speed of rest until its evaluations are spent; at 1e-13 it comes to rest where holdfast does"
)
_TURNS = (
    "holdfast is right. Joint 1 turns for ever, {:.1f} rad per 1/Ke, and the reference's evaluations are spent before the time "
    "is up; given as many as it takes, it is moving too, with the same error at the end"
)
NOTES = {
    "3R, pseudoinverse, 1994": _TREMBLES.format(-182),
    "3R, pseudoinverse, 2659": _TURNS.format(7431.2 / 3000),
    "3R, pseudoinverse, 4664": _TURNS.format(11810.1 / 3000),
    "3R, weights 1, 4, 0.5, 238": _TREMBLES.format(-309),
    "3R, weights 1, 4, 0.5, 757": _TREMBLES.format(-671),
    "3R, weights 1, 4, 0.5, 824": _TREMBLES.format(-141),
    "3R, weights 1, 4, 0.5, 827": _TREMBLES.format(-189),
}


# ---- comparing -------------------------------------------------------------------------------------------------------


def law_of(family: Family) -> Any:
    from holdfast import control

    arm, task = arm_of(family), "planar" if family.links else "position"
    if family.weights:
        return control.weighted(arm, family.weights, task)
    return control.damped(arm, family.damping, task) if family.damping else control.pseudoinverse(arm, task)


def held(family: Family, rows: list[int], **options: Any) -> Any:
    """Runs of holdfast for some of the cases."""
    from holdfast import simulate

    c = cases(family)
    return simulate(law_of(family), c.q0[rows], c.target[rows], locked=c.lock[rows], **options)


@dataclass(frozen=True)
class Compared:
    """One family.

    Attributes:
        family: Which.
        rows: Cases that were compared.
        different: Those of another outcome.
        converged: Largest distance of the terminal points where both converge, m.
        stuck: The same where both are stuck.
        counts: Of outcomes, by the reference.
    """

    family: Family
    rows: list[int]
    different: list[int]
    converged: float
    stuck: float
    counts: dict[str, int]


def compare(family: Family, found: dict[int, dict[str, Any]], **options: Any) -> Compared:
    rows = sorted(found)
    runs = held(family, rows, **options)
    hand = rates_of(family)[1]
    outcome = np.array([found[k]["outcome"] for k in rows])
    end = np.array([hand(np.array(found[k]["q"])) for k in rows])
    away, same = np.linalg.norm(end - runs.x_final, axis=1), outcome == runs.outcome

    def largest(name: str) -> float:
        return float(away[same & (outcome == name)].max(initial=0.0))

    counts = {str(name): int(count) for name, count in zip(*np.unique(outcome, return_counts=True), strict=True)}
    different = [k for k, s in zip(rows, same, strict=True) if not s]
    return Compared(family, rows, different, largest("converged"), largest("stuck"), counts)


def ended(outcome: str, reason: str, error: float, time: float) -> str:
    return f"{outcome}, {error:.3g} m, at {time:.4g}" if not reason else f"{outcome} ({reason})"


def look(family: Family, k: int, row: dict[str, Any]) -> list[str]:
    """A case of another outcome: both answers, both again at tight tolerance, and what starts close by do."""
    c, runs = cases(family), held(family, [k])
    tight = held(family, [k], tolerance=1e-13)
    with np.errstate(all="ignore"):
        again, how = reference(family, c.q0[k], c.target[k], c.lock[k], rtol=1e-13, atol=1e-15), "rtol 1e-13"
        if again["reason"] == "steps":
            again = reference(family, c.q0[k], c.target[k], c.lock[k], rtol=1e-9, atol=1e-11, most=50 * MOST)
            how = "rtol 1e-9, as long as it takes"
    g = np.random.default_rng([SEED, k])
    near = c.q0[k] + 1e-8 * g.normal(size=(20, c.q0.shape[1]))
    from holdfast import simulate

    others = simulate(law_of(family), near, c.target[k], locked=np.tile(c.lock[k], (20, 1)))
    around = ", ".join(f"{count} {name}" for name, count in others.counts().items() if count)
    path = runs.path(0, 4000)
    least = min(smallest(family, q) for q in path.q)
    theirs, theirs_again = (ended(r["outcome"], r["reason"], r["error"], r["time"]) for r in (row, again))
    ours, ours_again = (ended(str(r.outcome[0]), reason_of(r), r.error[0], r.time[0]) for r in (runs, tight))
    return [f"{family.name}, {k}", theirs, ours, f"{theirs_again}, {how}", ours_again, around, f"{least:.1e}"]


def reason_of(runs: Any) -> str:
    from holdfast.control.simulation import Reason

    reason = Reason(int(runs.reason[0]))
    return reason.name.lower().replace("_", " ") if reason else ""


def smallest(family: Family, q: Array) -> float:
    """Least singular value of the task's Jacobian, m."""
    law = law_of(family)
    return float(np.linalg.svd(law.task.rows @ law.arm.jacobian(q), compute_uv=False)[-1])


def report(path: Path) -> str:
    """The section for RESULTS.md."""
    from holdfast.core.probability import Interval

    found: dict[int, dict[int, dict[str, Any]]] = {}
    for (i, k), row in stored(path).items():
        found.setdefault(i, {})[k] = row
    results = [(i, compare(FAMILIES[i], rows)) for i, rows in sorted(found.items())]
    lines, total, same = [], 0, 0
    for _, r in results:
        share = Interval.from_counts(len(r.rows) - len(r.different), len(r.rows))
        total, same = total + len(r.rows), same + len(r.rows) - len(r.different)
        counts = ", ".join(f"{count} {name}" for name, count in r.counts.items())
        lines.append([r.family.name, str(len(r.rows)), percent(share), f"{r.converged:.0e}", f"{r.stuck:.0e}", counts])
    share = Interval.from_counts(same, total)
    lines.append(
        [
            "**all**",
            str(total),
            f"**{percent(share)}**",
            f"{max(r.converged for _, r in results):.0e}",
            f"{max(r.stuck for _, r in results):.0e}",
            "",
        ]
    )
    head = ["arm and law", "cases", "same outcome (95 % interval)", "converged: largest m", "stuck: largest m", "solve_ivp"]
    text = [harness.table("Closed loop: does it end as scipy's `solve_ivp` says?", head, lines)]
    text.append(
        "Random start, target (also out of reach) and locked joints, from the start in three of four cases, else within 5/Ke. "
        "The reference is DOP853 at rtol 1e-10, atol 1e-12, with a right-hand side of its own, under the same stated rule to "
        "3000/Ke. Undecided is an outcome too. Distances are between the terminal points of the hand.\n"
    )
    rows = [look(r.family, k, found[i][k]) for i, r in results for k in r.different]
    if rows:
        names = ["case", "solve_ivp", "holdfast", "solve_ivp again", "holdfast, tolerance 1e-13", "20 starts 1e-8 rad away"]
        names += ["least singular value met"]
        rows = [[*row, NOTES.get(row[0], "")] for row in rows]
        text.append(harness.table("Cases of another outcome", [*names, "explanation"], rows))
    return "\n".join(text)


def percent(share: Any) -> str:
    return f"{100 * share.value:.2f} % ({100 * share.low:.2f} to {100 * share.high:.2f})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--store", type=Path, default=Path("build/agreement_closed_loop.jsonl"), help="(default %(default)s)")
    parser.add_argument("--processes", type=int, default=2, help="(default %(default)s)")
    parser.add_argument("--report", action="store_true", help="compare what is stored, and compute nothing more")
    parser.add_argument("--write", action="store_true", help="put the section into RESULTS.md")
    chosen = parser.parse_args()
    if not chosen.report:
        integrate(chosen.store, chosen.processes)
    text = report(chosen.store)
    print(text)
    if chosen.write:
        import run_all

        run_all.put("agreement_closed_loop", f"{text}\n\nMeasured: {harness.environment()}.")


if __name__ == "__main__":
    main()
