"""Seven joints whose levers are all alike: a smooth ascent of the least singular value after the worst lock.

The soft minimum of all eigenvalues after all locks is climbed by L-BFGS from very many starts, and from the best of them with
growing sharpness: at the optimum many of these eigenvalues are the same.
"""

from __future__ import annotations

from time import monotonic

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

import holdfast as hf

Array = NDArray[np.float64]

FIRST, LAST = (20.0, 60.0), (200.0, 600.0, 2000.0, 6000.0, 2e4, 6e4, 2e5)  # sharpness, of eigenvalues near 1/3
STARTS, FOLLOWED = 600, 8


def columns(x: Array) -> tuple[Array, ...]:
    """Axes w (3, n) and velocities v (3, n) of length 1 and across them, from any numbers (6 n,); and what slopes need."""
    a, b = x.reshape(2, 3, -1)
    long = np.linalg.norm(a, axis=0)
    w = a / long
    along = (w * b).sum(axis=0)
    across = b - w * along
    far = np.linalg.norm(across, axis=0)
    return w, across / far, b, long, along, far


def soft_minimum(x: Array, sharpness: float) -> tuple[float, Array]:
    """Of the squared singular values after each lock, negative, and its slope (6 n,)."""
    w, v, b, long, along, far = columns(x)
    j = np.vstack([v, w])
    values, vectors = np.linalg.eigh(j @ j.T - np.einsum("ik,jk->kij", j, j))
    low = values.min()
    weights = np.exp(-sharpness * (values - low))
    total = weights.sum()
    pull = np.einsum("kia,ka,kja->kij", vectors, weights / total, vectors)
    slope = 2 * (pull.sum(axis=0) @ j - np.einsum("kij,jk->ik", pull, j))
    of_across = (slope[:3] - v * (v * slope[:3]).sum(axis=0)) / far
    of_along = -(w * of_across).sum(axis=0)
    of_b = of_across + w * of_along
    of_w = slope[3:] - along * of_across + b * of_along
    of_a = (of_w - w * (w * of_w).sum(axis=0)) / long
    return float(np.log(total) / sharpness - low), -np.concatenate([of_a.ravel(), of_b.ravel()])


def least(x: Array) -> float:
    """The least singular value after the worst lock."""
    w, v, *_ = columns(x)
    j = np.vstack([v, w])
    return float(min(np.linalg.svd(np.delete(j, k, axis=1), compute_uv=False)[-1] for k in range(j.shape[1])))


def climbed(x: Array, sharpnesses: tuple[float, ...], steps: int) -> Array:
    """Where L-BFGS ends, sharper each time."""
    for q in sharpnesses:
        x = minimize(soft_minimum, x, (q,), jac=True, method="L-BFGS-B", options={"maxiter": steps, "maxcor": 30}).x
    return x


def table(n: int = 7) -> list[str]:
    """The best of all starts, how many of those followed agree, and what the same lines keep of relative manipulability."""
    bound = hf.index_bounds.bound_singular_value(n=n, m=6, angular=True).bound
    rng, start = np.random.default_rng(1), monotonic()
    found = sorted((climbed(rng.normal(size=6 * n), FIRST, 150) for _ in range(STARTS)), key=least)[-FOLLOWED:]
    found = sorted((climbed(x, LAST, 300) for x in found), key=least)
    best = found[-1]
    w, v, *_ = columns(best)
    null = np.linalg.svd(np.vstack([v, w]))[2][6:]
    agree = sum(least(x) > least(best) - 1e-5 for x in found)
    return [
        "| joints | starts | least singular value | of the bound | of those followed agree | relative manipulability | "
        "condition number | seconds |",
        "|---|---|---|---|---|---|---|---|",
        f"| {n} | {STARTS} | {least(best):.6f} | {least(best) / bound:.4f} | {agree} of {FOLLOWED} | {abs(null).min():.4f} | "
        f"{np.linalg.cond(np.vstack([v, w])):.3f} | {monotonic() - start:.0f} |",
    ]
