"""W8: the closed loop of a planar 3R arm whose controller does not know that a joint has locked, 15/Ke of it."""

from __future__ import annotations

import math

import numpy as np

import harness
from harness import Contender, Function

GAIN, STEP, STEPS = 5.0, 0.02, 150
TIME = STEP * STEPS
MANY, FEW = 40_000, 10


def cases(rows: int) -> np.ndarray:
    """(N, 8): configuration, 0 for the locked joint and 1 for the others, target; as in workload W5 of the peers."""
    g = np.random.default_rng(3)
    q = np.column_stack([g.uniform(-np.pi, np.pi, rows), g.uniform(0.4, 2.0, (rows, 2))])
    healthy = np.ones((rows, 3))
    healthy[np.arange(rows), g.integers(0, 3, rows)] = 0.0
    s = np.cumsum(q + healthy * g.uniform(-0.4, 0.4, (rows, 3)), axis=1)
    return np.column_stack([q, healthy, np.cos(s).sum(axis=1), np.sin(s).sum(axis=1)])


def holdfast(**options: object) -> Function:
    from holdfast import arms, simulate
    from holdfast.control import Pseudoinverse

    law = Pseudoinverse(arms.load("planar-3r"), "planar", GAIN)

    def run(rows: np.ndarray) -> np.ndarray:
        return simulate(law, rows[:, :3], rows[:, 6:], locked=rows[:, 3:6].argmin(axis=1), time_limit=TIME, **options).q_final

    return run


def rates(q: list, healthy: list, x: list, cos, sin) -> list:
    """``mask J' (J J')^-1 Ke e`` on scalars or columns."""
    s0 = q[0]
    s1 = s0 + q[1]
    s2 = s1 + q[2]
    c0, c1, c2, n0, n1, n2 = cos(s0), cos(s1), cos(s2), sin(s0), sin(s1), sin(s2)
    ex, ey = GAIN * (x[0] - c0 - c1 - c2), GAIN * (x[1] - n0 - n1 - n2)
    u, v = (-(n0 + n1 + n2), -(n1 + n2), -n2), (c0 + c1 + c2, c1 + c2, c2)
    a, b, c = (sum(f * g for f, g in zip(left, right, strict=True)) for left, right in ((u, u), (u, v), (v, v)))
    d = a * c - b * b
    p, r = (c * ex - b * ey) / d, (a * ey - b * ex) / d
    return [h * (f * p + g * r) for h, f, g in zip(healthy, u, v, strict=True)]


def numpy_batched() -> Function:
    def run(rows: np.ndarray) -> np.ndarray:
        out = []
        for start in range(0, len(rows), 2000):
            columns = list(rows[start : start + 2000].T.copy())
            q, healthy, x = columns[:3], columns[3:6], columns[6:]

            def f(q: list, healthy: list = healthy, x: list = x) -> list:
                return rates(q, healthy, x, np.cos, np.sin)

            for _ in range(STEPS):
                k1 = f(q)
                k2 = f([a + STEP / 2 * k for a, k in zip(q, k1, strict=True)])
                k3 = f([a + STEP / 2 * k for a, k in zip(q, k2, strict=True)])
                k4 = f([a + STEP * k for a, k in zip(q, k3, strict=True)])
                q = [a + STEP / 6 * (w + 2 * x + 2 * y + z) for a, w, x, y, z in zip(q, k1, k2, k3, k4, strict=True)]
            out.append(np.stack(q, axis=1))
        return np.concatenate(out)

    return run


NUMBA = """
def run(rows):
    out = np.empty((rows.shape[0], 3))
    for t in prange(rows.shape[0]):
        y0 = rows[t, 0]; y1 = rows[t, 1]; y2 = rows[t, 2]
        for st in range(STEPS):
            a0 = a1 = a2 = 0.0; k0 = k1 = k2 = 0.0
            for s in range(4):
                h = 0.0 if s == 0 else (STEP if s == 3 else STEP / 2); w = 1.0 if (s == 0 or s == 3) else 2.0
                s0 = y0 + h * k0; s1 = s0 + y1 + h * k1; s2 = s1 + y2 + h * k2
                c0 = cos(s0); c1 = cos(s1); c2 = cos(s2); n0 = sin(s0); n1 = sin(s1); n2 = sin(s2)
                ex = GAIN * (rows[t, 6] - c0 - c1 - c2); ey = GAIN * (rows[t, 7] - n0 - n1 - n2)
                u0 = -(n0 + n1 + n2); u1 = -(n1 + n2); u2 = -n2; v0 = c0 + c1 + c2; v1 = c1 + c2; v2 = c2
                A = u0 * u0 + u1 * u1 + u2 * u2; B = u0 * v0 + u1 * v1 + u2 * v2; C = v0 * v0 + v1 * v1 + v2 * v2
                d = A * C - B * B; p = (C * ex - B * ey) / d; r = (A * ey - B * ex) / d
                k0 = rows[t, 3] * (u0 * p + v0 * r); k1 = rows[t, 4] * (u1 * p + v1 * r); k2 = rows[t, 5] * (u2 * p + v2 * r)
                a0 += w * k0; a1 += w * k1; a2 += w * k2
            y0 += STEP / 6 * a0; y1 += STEP / 6 * a1; y2 += STEP / 6 * a2
        out[t, 0] = y0; out[t, 1] = y1; out[t, 2] = y2
    return out
"""


def numba_kernel(parallel: bool) -> Function:
    import numba

    space = {"np": np, "prange": numba.prange, "cos": math.cos, "sin": math.sin, "STEP": STEP, "STEPS": STEPS, "GAIN": GAIN}
    exec(NUMBA, space)
    return numba.njit(fastmath=True, parallel=parallel)(space["run"])


def solve_ivp(method: str, rtol: float, atol: float) -> Function:
    from scipy.integrate import solve_ivp as solve

    def run(rows: np.ndarray) -> np.ndarray:
        return np.array(
            [
                solve(
                    lambda t, q, row=row: rates(q, row[3:6], row[6:], math.cos, math.sin),
                    (0, TIME),
                    row[:3],
                    method,
                    rtol=rtol,
                    atol=atol,
                ).y[:, -1]
                for row in rows
            ]
        )

    return run


def main() -> None:
    chosen = harness.options(__doc__)
    many = 400 if chosen.quick else MANY
    rows = cases(many)
    sample = rows[:20]
    expected = solve_ivp("DOP853", 1e-12, 1e-13)(sample)
    peers = [
        Contender("holdfast, adaptive, tolerance 1e-9 (default)", holdfast, many),
        Contender("holdfast, fixed steps (rk4)", lambda: holdfast(method="rk4", step=STEP), many),
        Contender("NumPy, batches of 2000, RK4", numpy_batched, min(many, 4000)),
        Contender("Numba, RK4, one thread", lambda: numba_kernel(False), min(many, 20_000)),
        Contender("Numba, RK4, all threads", lambda: numba_kernel(True), min(many, 20_000)),
        Contender("SciPy solve_ivp, DOP853, rtol 1e-10", lambda: solve_ivp("DOP853", 1e-10, 1e-12), FEW),
    ]
    title = f"W8: closed loop of a failed 3R arm, {TIME:g} s at Ke = {GAIN:g}/s"
    ours = Contender("holdfast, adaptive, tolerance 1e-8", lambda: holdfast(tolerance=1e-8), many)
    print(harness.race(title, ours, peers, rows, sample, expected, chosen.rounds))
    loose = [
        Contender("SciPy solve_ivp, RK45, rtol 1e-6", lambda: solve_ivp("RK45", 1e-6, 1e-9), FEW),
        Contender("holdfast, adaptive, tolerance 1e-8", lambda: holdfast(tolerance=1e-8), many),
    ]
    ours = Contender("holdfast, adaptive, tolerance 1e-6", lambda: holdfast(tolerance=1e-6), many)
    print(harness.race("W8, where less accuracy will do", ours, loose, rows, sample, expected, chosen.rounds))
    print(
        f"A row is one run of {TIME:g} s; the error is the largest of a joint at the end, rad. holdfast also notes closest "
        "approach, path length and joint excursions."
    )


if __name__ == "__main__":
    main()
