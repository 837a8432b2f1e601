"""W9: the failure-tolerant inverse in batch, planar 3R and Panda, and one control step of it for the Panda's pose."""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices this small gain nothing from more
os.environ.setdefault("MKL_NUM_THREADS", "1")

import argparse
import statistics
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1]))  # the closed form on arrays
sys.path.append(str(Path(__file__).parents[1] / "tests" / "control" / "laws"))  # the exact method: the tests' oracle

import harness
import panda
from control_steps import Step, by_mink, by_pink, clock_time, percentiles, timed
from harness import Contender, Function, Spread

ALLOWED = 0.5
FIXED = 0.1  # damping of the peer that does not search
MANY, FEW, POSTURES = 100_000, 100, 500
GOLDEN = (np.sqrt(5) - 1) / 2

Solve = Callable[[np.ndarray, np.ndarray], np.ndarray]  # J (m, n) and u (m,) -> joint rates (n,)


# ---- the arms ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Problem:
    """An arm and a task: rows are configurations and unit directions side by side."""

    name: str
    n: int
    m: int
    jacobian: Callable[[np.ndarray], np.ndarray]  # q (n,) -> (m, n)

    def rows(self, count: int) -> np.ndarray:
        g = np.random.default_rng(1)
        q = g.uniform(-np.pi, np.pi, (count, self.n)) if self.n == 3 else panda.configurations(count)
        u = g.normal(size=(count, self.m))
        return np.column_stack([q, u / np.linalg.norm(u, axis=1, keepdims=True)])

    def law(self):
        from holdfast import arms
        from holdfast.control import FailureTolerant

        task = {2: "planar", 3: "position", 6: "pose"}[self.m]
        return FailureTolerant(arms.load("planar-3r") if self.n == 3 else panda.ours(), task, ALLOWED)


def planar_jacobian(q: np.ndarray) -> np.ndarray:
    s = np.cumsum(q)
    return np.array([-np.cumsum(np.sin(s)[::-1])[::-1], np.cumsum(np.cos(s)[::-1])[::-1]])


def panda_jacobian(m: int) -> Callable[[np.ndarray], np.ndarray]:
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    return lambda q: pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL_WORLD_ALIGNED)[:m]


# ---- one row at a time ---------------------------------------------------------------------------------------------------


def damped(j: np.ndarray, u: np.ndarray, damping: float) -> np.ndarray:
    return j.T @ np.linalg.solve(j @ j.T + damping**2 * np.eye(len(j)), u)


def fixed(j: np.ndarray, u: np.ndarray) -> np.ndarray:
    return damped(j, u, FIXED)


def by_polynomials() -> Solve:
    """The specification's exact method: all stationary points and crossings as roots of polynomials."""
    from damping_oracle import optimum

    return lambda j, u: damped(j, u, optimum(j, u, ALLOWED)[0])


def by_golden_section(j: np.ndarray, u: np.ndarray) -> np.ndarray:
    """One eigendecomposition, then bisection for the largest damping and a golden section below it, to 1e-7 of it."""
    squares, v = np.linalg.eigh(j @ j.T)
    c = v.T @ u
    products, columns = (v.T @ j) * c[:, None], (j * j).sum(axis=0)

    def peak(damping: float) -> float:
        s = damping * damping
        y = 1 / (squares + s)
        healthy, along = s * c * y, y @ products
        return healthy @ healthy + (along * along * (2 * s + columns)).max()

    ratio = ALLOWED / (1 - ALLOWED)
    low, high = np.log(squares[0] * ratio), np.log(squares[-1] * ratio)
    for _ in range(40):
        middle = (low + high) / 2
        s = np.exp(middle)
        healthy = s * c / (squares + s)
        low, high = (middle, high) if healthy @ healthy < ALLOWED * ALLOWED else (low, middle)
    low, high = 0.0, float(np.exp(low / 2))
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    fa, fb = peak(a), peak(b)
    for _ in range(34):
        if fa < fb:
            high, b, fb = b, a, fa
            a = high - GOLDEN * (high - low)
            fa = peak(a)
        else:
            low, a, fa = a, b, fb
            b = low + GOLDEN * (high - low)
            fb = peak(b)
    s = ((low + high) / 2) ** 2
    return (1 / (squares + s)) @ products


def one_by_one(problem: Problem, make: Callable[[], Solve]) -> Function:
    solve, n = make(), problem.n
    return lambda rows: np.array([solve(problem.jacobian(r[:n]), r[n:]) for r in rows])


# ---- batches -------------------------------------------------------------------------------------------------------------


def holdfast(problem: Problem) -> Function:
    law, n = problem.law(), problem.n
    return lambda rows: law.velocity(rows[:, :n], rows[:, n:])


def numpy_batched(problem: Problem) -> Function:
    """SVD, golden section and all of it on arrays, 2000 rows at a time."""
    from papers.goel2003.peak_error import PeakError

    n = problem.n

    def some(rows: np.ndarray) -> np.ndarray:
        j, u = np.array([problem.jacobian(r[:n]) for r in rows]), rows[:, n:]
        damping = PeakError(j, u, ALLOWED).golden_section(34)
        squares = j @ j.transpose(0, 2, 1) + damping[:, None, None] ** 2 * np.eye(problem.m)
        return (j.transpose(0, 2, 1) @ np.linalg.solve(squares, u[:, :, None]))[:, :, 0]

    return lambda rows: np.concatenate([some(rows[k : k + 2000]) for k in range(0, len(rows), 2000)])


def peaks(problem: Problem, rows: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """PKE of joint rates, literally."""
    out = []
    for r, x in zip(rows, rates, strict=True):
        j = problem.jacobian(r[: problem.n])
        out.append(np.linalg.norm(r[problem.n :, None] - (j @ x)[:, None] + j * x, axis=0).max())
    return np.array(out)


def batch(problem: Problem, chosen: argparse.Namespace) -> str:
    many, few = (2000, 20) if chosen.quick else (MANY, FEW)
    rows = problem.rows(many)
    sample = rows[:200]
    expected = peaks(problem, sample, one_by_one(problem, by_polynomials)(sample))
    peers = [
        Contender("NumPy, polynomials (exact)", lambda: one_by_one(problem, by_polynomials), few),
        Contender("NumPy, golden section", lambda: one_by_one(problem, lambda: by_golden_section), few),
        Contender("NumPy on arrays, SVD and golden section", lambda: numpy_batched(problem), min(many, 4000)),
        Contender("NumPy, fixed damping", lambda: one_by_one(problem, lambda: fixed), few, "no search: another law"),
    ]
    return harness.race(
        f"W9: failure-tolerant inverse in batch, {problem.name}",
        Contender("holdfast `law.velocity`", lambda: holdfast(problem), many),
        peers,
        rows,
        sample,
        expected,
        chosen.rounds,
        expected,
        lambda rates: peaks(problem, sample, rates),
    )


# ---- one step ------------------------------------------------------------------------------------------------------------


def stepping(problem: Problem, solve: Solve) -> Callable[[np.ndarray, np.ndarray], Step]:
    return lambda q, u: lambda i: solve(problem.jacobian(q[i]), u[i])


def one_step(problem: Problem, chosen: argparse.Namespace) -> str:
    calls = 100 if chosen.quick else chosen.calls
    rows = problem.rows(POSTURES)
    q, u = np.ascontiguousarray(rows[:, : problem.n]), np.ascontiguousarray(rows[:, problem.n :])
    law = problem.law()
    step, velocity = law.prepare(), law.velocity
    least = peaks(problem, rows, one_by_one(problem, by_polynomials)(rows))

    def excess(step: Step) -> str:
        above = peaks(problem, rows, np.array([step(i) for i in range(POSTURES)])) / least - 1
        return f"{np.median(above):.0e} / {above.max():.0e}"

    def ours(i: int) -> np.ndarray:
        return step(q[i], u[i])

    peers = [
        ("holdfast `law.velocity`", lambda q, u: lambda i: velocity(q[i], u[i]), "the same with checks"),
        ("Pinocchio + NumPy, golden section", stepping(problem, by_golden_section), "the same law where PKE has one minimum"),
        ("Pinocchio + NumPy, polynomials (exact)", stepping(problem, by_polynomials()), "the same law"),
        ("Pinocchio + NumPy, fixed damping", stepping(problem, fixed), "no search: another law"),
        ("pink, frame + posture + limits, daqp", by_pink("daqp"), "quadratic program: another law"),
        ("mink, frame + posture + limits, daqp", by_mink, "quadratic program: another law"),
    ]
    timed(ours, ours, calls)
    alone = [t for _ in range(chosen.rounds) for t in timed(ours, ours, calls)[1]]
    lines = [["**holdfast `law.step`**", *percentiles(alone), "-", "1", excess(ours), "alone"]]
    for name, make, note in peers:
        harness.progress(f"W9: {name}")
        try:
            theirs = make(q, u)
            above = "-" if "another law" in note else excess(theirs)
            timed(ours, theirs, max(calls // 10, 10))
            rounds = [timed(ours, theirs, calls) for _ in range(chosen.rounds)]
        except ImportError as missing:
            lines.append([name, *"-----", f"not installed: {missing.name}"])
            continue
        except Exception as failure:  # one broken peer must not cost the others their rows
            lines.append([name, *"-----", f"failed: {type(failure).__name__}: {str(failure)[:80]}".replace("\n", " ")])
            continue
        own, other = ([t for both in rounds for t in both[k]] for k in (0, 1))
        ratio = Spread.of([statistics.median(second) / statistics.median(first) for first, second in rounds])
        lines.append([name, *percentiles(other), " / ".join(percentiles(own)), str(ratio), above, note])
    head = ["contender", "median us", "p99 us", "holdfast beside it, median / p99 us", "holdfast is faster by (range)"]
    text = harness.table("W9: one control step, Panda's pose", [*head, "PKE above optimum, median / most", "note"], lines)
    return (
        f"{text}\n{chosen.rounds} rounds of {calls} calls of each, holdfast and the peer by turns, {POSTURES} configurations "
        f"within the joint limits and unit twists; the clock's own time, {clock_time():.2g} us, is inside."
    )


def main() -> None:
    extra = argparse.ArgumentParser(add_help=False)
    extra.add_argument("--calls", type=int, default=1000, help="calls of both in a round (default %(default)s)")
    chosen = harness.options(__doc__, parents=[extra])
    position, pose = (Problem(f"Panda, m = {m}", 7, m, panda_jacobian(m)) for m in (3, 6))
    for problem in (Problem("planar 3R, m = 2", 3, 2, planar_jacobian), position, pose):
        print(batch(problem, chosen))
    print(
        "A row is a configuration and a unit direction; the error is that of the peak velocity error of what comes out, "
        f"relative to the exact optimum, largest of 200 rows. Allowed pre-failure error {ALLOWED:g}.\n"
    )
    print(one_step(pose, chosen))


if __name__ == "__main__":
    main()
