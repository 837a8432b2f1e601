"""W19: ceilings: the search for a null space and the judgement of many arms, beside the same in NumPy."""

from __future__ import annotations

import argparse
import sys
import time
from itertools import combinations
from pathlib import Path

import numpy as np

import harness

sys.path.append(str(Path(__file__).parents[1]))

SIZES = [(8, 6, 2), (9, 6, 2), (7, 3, 3)]
PLAIN = 20  # arms that NumPy judges


def searches(chosen: argparse.Namespace) -> str:
    """The same seconds of our search and of SciPy's on the same objective."""
    from measurements.upper_bounds.ascent_search import search_null_space
    from scipy.optimize import minimize

    seconds, rows = 3.0 if chosen.quick else 20.0, []
    for n, m, k in SIZES:
        harness.progress(f"{n}, {m}, {k}")
        found, best = search_null_space(n=n, m=m, k=k, seed=1, seconds=seconds), 0.0
        sets, rng, end = np.array(list(combinations(range(n), k))), np.random.default_rng(1), time.monotonic() + seconds

        def least(x: np.ndarray, sets: np.ndarray = sets, shape: tuple[int, int] = (n, n - m)) -> float:
            some = np.linalg.qr(x.reshape(shape))[0][sets]
            return -float(np.sqrt(max(np.linalg.det(some @ np.swapaxes(some, 1, 2)).min(), 0.0)))

        while time.monotonic() < end:
            best = max(best, -minimize(least, rng.normal(size=n * (n - m)), method="Nelder-Mead").fun)
        known = found.ceiling.best_known
        rows.append([f"{n}, {m}, {k}", f"{known:.8f}", f"{found.value / known:.8f}", f"{best / known:.8f}"])
    head = ["joints, rows, lock", "best known", "ours, of it", "Nelder-Mead on the same objective, of it"]
    return harness.table(f"W19: search for {seconds:.0f} s, one core each", head, rows)


def judged(chosen: argparse.Namespace) -> str:
    """All 2,520 orders of seven lines, and some of them in NumPy."""
    from measurements.synthesis.arms import synthesise
    from measurements.synthesis.orders import compare_joint_orders

    import holdfast as hf

    samples = 200 if chosen.quick else 2000
    j = synthesise(hf.index_bounds.upper_bound(n=7, m=6), starts=4).jacobians[0]
    compare_joint_orders(j, samples=10, at_most=1)  # compiles
    harness.progress("orders")
    start = time.perf_counter()
    found = compare_joint_orders(j, samples=samples)
    ours = len(found.orders) * samples / (time.perf_counter() - start)
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (samples, 7))
    start = time.perf_counter()
    for d, order in enumerate(found.orders[:PLAIN]):
        mean = plain(j[:, order], q).mean()
        assert abs(mean - found.mean[d]) < 1e-9
    theirs = PLAIN * samples / (time.perf_counter() - start)
    rows = [["holdfast", f"{ours:,.0f}", f"{ours / theirs:.0f}"], ["NumPy, batches of configurations", f"{theirs:,.0f}", "1"]]
    return harness.table("W19: orders of seven lines judged", ["", "configurations/s", "ratio"], rows)


def plain(jacobian: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Least entry of the null vector at each q: lines turned one after the other, null space by SVD."""
    w, o = jacobian[3:].T, np.cross(jacobian[3:].T, jacobian[:3].T)
    turn, shift, columns = np.tile(np.eye(3), (len(q), 1, 1)), np.zeros((len(q), 3)), []
    for i in range(7):
        axis, at = turn @ w[i], turn @ o[i] + shift
        columns.append(np.hstack([np.cross(at, axis), axis]))
        cross = np.array([[0, -w[i, 2], w[i, 1]], [w[i, 2], 0, -w[i, 0]], [-w[i, 1], w[i, 0], 0]])
        s, c = np.sin(q[:, i])[:, None, None], np.cos(q[:, i])[:, None, None]
        rotation = np.eye(3) + s * cross + (1 - c) * (cross @ cross)
        shift = (turn @ (o[i] - rotation @ o[i])[..., None])[..., 0] + shift
        turn = turn @ rotation
    return abs(np.linalg.svd(np.stack(columns, axis=2))[2][:, -1]).min(axis=1)


def main() -> None:
    chosen = harness.options(__doc__, rounds=1)
    for part in (searches, judged):
        print(part(chosen), flush=True)


if __name__ == "__main__":
    main()
