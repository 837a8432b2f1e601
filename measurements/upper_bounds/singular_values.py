"""Ceilings of the least singular value: 100,000 random Jacobians each, and an optimiser that tries to beat them."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

import holdfast as hf

Array = NDArray[np.float64]
RANDOM, STARTS, STEPS = 100_000, 64, 1500
SIZES = [
    (3, 2, 1),
    (5, 3, 1),
    (7, 3, 1),
    (7, 6, 1),
    (4, 2, 2),
    (5, 2, 2),
    (6, 2, 2),
    (5, 3, 2),
    (6, 3, 2),
    (7, 3, 2),
    (7, 3, 3),
]
POSES = [(7, 1, "each 1"), (7, 1, "mean 1"), (8, 1, "mean 1"), (8, 2, "mean 1"), (7, 1, "any"), (8, 1, "any")]
LONG = 300.0  # lengths, of a pose whose levers may have any


def table() -> list[str]:
    """Bound, the best of random Jacobians, and the best of the optimiser."""
    lines = [
        f"| joints, rows, lock | levers | bound | by | best of {RANDOM:,} random | best of the optimiser | of the bound |",
        "|---|---|---|---|---|---|---|",
    ]
    rng = np.random.default_rng(0)
    for n, m, k, levers in [(*size, "") for size in SIZES] + [(n, 6, k, levers) for n, k, levers in POSES]:
        lever = np.inf if levers == "any" else 1.0
        c = hf.index_bounds.bound_singular_value(n=n, m=m, k=k, lever=lever, angular=bool(levers))
        some = max(float(least(placed(rng.normal(size=(RANDOM // 20, m, n)), levers), k)[0].max()) for _ in range(20))
        best = float(climbed(placed(rng.normal(size=(STARTS, m, n)), levers), k, levers).max())
        assert max(some, best) <= c.bound * (1 + 1e-12), (n, m, k, some, best, c.bound)
        kind = f"pose, {levers}" if levers else "one unit, mean 1"
        lines.append(
            f"| {n}, {m}, {k} | {kind} | {c.bound:.6f} | {c.bound_by} | {some:.6f} | {best:.6f} | {best / c.bound:.4f} |"
        )
    return lines


def placed(j: Array, levers: str) -> Array:
    """The nearest Jacobians (B, m, n) that the bound is of: mean squared column 1, or lines of a pose with such levers."""
    if not levers:
        return np.asarray(j / np.sqrt((j**2).sum(axis=(1, 2), keepdims=True) / j.shape[2]))
    v, w = j[:, :3], j[:, 3:]
    w = w / np.linalg.norm(w, axis=1, keepdims=True)
    v = v - w * (v * w).sum(axis=1, keepdims=True)
    squares = (v**2).sum(axis=1, keepdims=True)
    if levers != "each 1":
        squares = squares.mean(axis=2, keepdims=True)
    return np.concatenate([(LONG if levers == "any" else 1.0) * v / np.sqrt(squares), w], axis=1)


def least(j: Array, k: int) -> tuple[Array, Array, Array]:
    """Least singular value (B,) after the worst k columns; all (B, F, m) eigenvalues, and the (B, F, m, m) vectors."""
    sets = np.array(list(combinations(range(j.shape[2]), k)))
    taken = np.moveaxis(j[:, :, sets], 2, 1)  # (B, F, m, k)
    left = (j @ np.swapaxes(j, 1, 2))[:, None] - taken @ np.swapaxes(taken, 2, 3)
    values, vectors = np.linalg.eigh(left)
    return np.sqrt(np.maximum(values[..., 0].min(axis=1), 0)), values, vectors


def climbed(j: Array, k: int, levers: str) -> Array:
    """The best value (B,) on the way of an ascent of the soft minimum of all eigenvalues, which grows sharper."""
    sets = np.array(list(combinations(range(j.shape[2]), k)))
    kept = np.ones((len(sets), j.shape[2]))
    kept[np.arange(len(sets))[:, None], sets] = 0
    unit = np.ones((1, j.shape[1], 1))
    if levers == "any":
        unit[:, :3] = LONG  # steps of long columns are long
    best, speed = np.zeros(len(j)), np.zeros_like(j)
    for step in range(STEPS):
        value, eigenvalues, vectors = least(j, k)
        best = np.maximum(best, value)
        done = step / STEPS
        low = eigenvalues.min(axis=(1, 2), keepdims=True)
        weights = np.exp(-(60 * 50**done) * (eigenvalues / np.maximum(low, 1e-9) - 1))
        weights /= weights.sum(axis=(1, 2), keepdims=True)
        half = vectors * np.sqrt(weights)[:, :, None, :]
        pull = (half @ np.swapaxes(half, 2, 3)) @ j[:, None]  # (B, F, m, n)
        slope = (pull * kept[:, None]).sum(axis=1) * unit**2
        size = np.sqrt(((slope / unit) ** 2).sum(axis=(1, 2), keepdims=True))
        speed = 0.8 * speed + slope / np.maximum(size, 1e-12) * (0.05 * (1 - done) ** 2 + 1e-5)
        j = placed(j + speed, levers)
    return best
