"""Search for Jacobians whose worst case after k failures is large: an ascent from many starts, then linear programmes.

Only the null space matters, so the search is over orthonormal N (n x p) with p = n - m. A *found* value is no ceiling: it is
what is known to be attainable.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from time import monotonic

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.frames import orthogonal_complement

_ASCENT_STEPS = 350
_FINAL_SHARPNESS = 256.0  # exponent of the soft minimum at the end
_POLISHED_GAIN = 1e-15  # predicted gain of rho^2 below which a point is polished
_SMALLEST_DETERMINANT = 1e-300


class NullSpaceMinors:
    """Squared minors of all k rows of orthonormal N, and their derivatives, for batches of N."""

    def __init__(self, n: int, k: int) -> None:
        self.n, self.k = n, k
        self.sets = np.array(list(combinations(range(n), k)))
        places = (self.sets[:, :, None] * n + self.sets[:, None, :]).reshape(-1)
        self._gather = places

    def row_grams(self, null: FloatArray) -> FloatArray:
        """Return ``N_S N_S'``, (..., F, k, k)."""
        projector = null @ np.swapaxes(null, -1, -2)
        flat = projector.reshape(*projector.shape[:-2], -1)[..., self._gather]
        return flat.reshape(*projector.shape[:-2], len(self.sets), self.k, self.k)

    def soft_minimum_gradient(self, null: FloatArray, sharpness: float) -> FloatArray:
        """Return the gradient by N of the soft minimum of ``log rho_S^2``, tangent to the orthonormal N, (B, n, p)."""
        grams = self.row_grams(null)
        logs = np.log(np.maximum(np.linalg.det(grams), _SMALLEST_DETERMINANT))
        weights = np.exp(-sharpness * (logs - logs.min(axis=-1, keepdims=True)))
        weights /= weights.sum(axis=-1, keepdims=True)
        inverse = np.linalg.inv(grams + 1e-14 * np.eye(self.k))
        # Sums by counting: a matrix product of this size would start the threads of BLAS, which wait for one another.
        size, batch = self.n * self.n, len(null)
        places = (np.arange(batch)[:, None] * size + self._gather).ravel()
        spread = np.bincount(places, (weights[..., None, None] * inverse).ravel(), batch * size)
        gradient = 2 * spread.reshape(batch, self.n, self.n) @ null
        return gradient - null @ (np.swapaxes(null, -1, -2) @ gradient)

    def squared_minors_and_gradients(self, null: FloatArray, complement: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the squares (F,) of one N, and their derivatives (F, m p) along ``N + Q X`` by the entries of X (m, p)."""
        grams = self.row_grams(null)
        squares = np.linalg.det(grams)
        rows = np.linalg.solve(grams, null[self.sets])  # (F, k, p)
        gradients = np.einsum("fkm,fkp->fmp", complement[self.sets], rows)
        return squares, 2 * squares[:, None] * gradients.reshape(len(squares), -1)


def ascend_batch(minors: NullSpaceMinors, starts: FloatArray, deadline: float = np.inf) -> FloatArray:
    """Improve a batch of N (B, n, p) by gradient ascent of a soft minimum that grows sharper from step to step."""
    null = np.linalg.qr(starts)[0]
    speed = np.zeros_like(null)
    for step in range(_ASCENT_STEPS):
        if monotonic() > deadline:
            break
        progress_made = step / _ASCENT_STEPS
        gradient = minors.soft_minimum_gradient(null, 2 * (_FINAL_SHARPNESS / 2) ** progress_made)
        length = np.linalg.norm(gradient, axis=(1, 2), keepdims=True)
        speed = 0.8 * speed + gradient / np.maximum(length, 1e-12) * (0.05 * (1 - progress_made) ** 2 + 2e-4)
        null = np.linalg.qr(null + speed)[0]
    return null


def polish_null_space(minors: NullSpaceMinors, null: FloatArray, deadline: float = np.inf) -> tuple[FloatArray, float]:
    """Bring one N (n, p) to a local optimum by linear programmes within a trust region; return it and its least square."""
    from scipy.optimize import linprog

    n, p = null.shape
    radius, best_square = 0.05, float(np.linalg.det(minors.row_grams(null)).min())
    columns = (n - p) * p
    cost = np.zeros(columns + 1)
    cost[-1] = -1.0
    while radius > 1e-14 and monotonic() < deadline:
        complement = np.linalg.qr(null, mode="complete")[0][:, p:]
        squares, gradients = minors.squared_minors_and_gradients(null, complement)
        # What is best + gain >= squares + slopes . X with |X| <= radius can never be worst is left out.
        near_minimum = squares - radius * abs(gradients).sum(axis=1) <= best_square + radius * abs(gradients).sum(axis=1).max()
        # In units of the radius and of the best value, so that the solver's tolerances are relative ones.
        scale = max(best_square, 1e-12)
        rows = np.hstack([-gradients[near_minimum] * radius / scale, np.ones((near_minimum.sum(), 1))])
        answer = linprog(
            cost,
            A_ub=rows,
            b_ub=(squares[near_minimum] - best_square) / scale,
            bounds=[(-1, 1)] * columns + [(None, None)],
            method="highs-ds",
        )
        if answer.fun is None or answer.x is None:
            radius *= 0.3
            continue
        gain = -answer.fun * scale
        if gain < _POLISHED_GAIN:
            break
        moved = np.linalg.qr(null + complement @ (radius * answer.x[:-1]).reshape(n - p, p))[0]
        value = float(np.linalg.det(minors.row_grams(moved)).min())
        if value <= best_square:
            radius *= 0.3
            continue
        radius *= 2.0 if value - best_square > 0.7 * gain else 1.0
        radius = min(radius, 0.5)
        null, best_square = moved, value
    return null, best_square


def best_null_space(
    n: int,
    p: int,
    k: int,
    *,
    seed: int,
    seconds: float,
    sufficient_value: float = np.inf,
    starts: int = 48,
    refined_count: int = 10,
    progress: Callable[[float], None] | None = None,
) -> tuple[FloatArray, float]:
    """Return the best N found in the time, and its worst case; batches of starts are tried until the time is over.

    Args:
        n: Joints.
        p: Redundancy.
        k: Failures at once.
        seed: Of the starts.
        seconds: Time; one start is always polished.
        sufficient_value: Worst case that ends the search.
        starts: Of a batch.
        refined_count: How many of them are polished, the best ones.
        progress: Called with the best value after each polish.

    Returns:
        N (n, p) and ``min rho_S``.
    """
    if k == p and n - p < p:  # the minors of the complement are the same, and smaller
        complement_found, value = best_null_space(
            n, n - p, n - p, seed=seed, seconds=seconds, sufficient_value=sufficient_value, progress=progress
        )
        return orthogonal_complement(complement_found), value
    rng, minors = np.random.default_rng(seed), NullSpaceMinors(n, k)
    end = monotonic() + seconds
    best_found: tuple[FloatArray, float] | None = None
    while best_found is None or monotonic() < end:
        batch = ascend_batch(minors, rng.standard_normal((starts, n, p)), end)
        worst = np.linalg.det(minors.row_grams(batch)).min(axis=1)
        for i in np.argsort(-worst)[:refined_count]:
            null, square = polish_null_space(minors, batch[i], np.inf if best_found is None else end)
            if best_found is None or square > best_found[1]:
                best_found = null, square
            if progress is not None:
                progress(float(np.sqrt(best_found[1])))
            if best_found[1] >= sufficient_value**2:
                end = -np.inf
            if monotonic() > end:
                break
    return best_found[0], float(np.sqrt(max(best_found[1], 0.0)))
