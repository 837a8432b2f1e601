"""Index and gradient in NumPy as fast as we could make them: arrays with the batch last, in place, in chunks of the cache.

With J = [j_1 .. j_9], Cholesky J J' = L L' and y_k = L^-1 j_k, the leverage of column k is h_k = |y_k|^2 and
rho_k = sqrt(1 - h_k). For the worst column k let u = (J J')^-1 j_k and w = e_k - J' u; then dh_k = 2 sum_c w_c u' dj_c.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

import pa10
from harness import Function

Array = np.ndarray

CHUNK = 512  # configurations


def cross_into(out: Array, a: Array, b: Array) -> Array:
    for i, k, m in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[k], b[m], out=out[i])
        out[i] -= a[m] * b[k]
    return out


def jacobian(q: Array) -> Array:
    """(9, B) joint values -> (6, 9, B)."""
    cosine, sine = np.cos(q), np.sin(q)
    x, y, z, p = np.zeros((4, 3, q.shape[1]))
    x[0] = y[1] = z[2] = 1
    j = np.empty((6, pa10.N, q.shape[1]))
    origin = np.empty((3, pa10.N, q.shape[1]))
    for i in range(pa10.N):
        j[3:, i], origin[:, i] = z, p
        turned, side = cosine[i] * x + sine[i] * y, cosine[i] * y - sine[i] * x
        if pa10.D[i]:
            p = p + pa10.D[i] * z
        if pa10.A[i]:
            p = p + pa10.A[i] * turned
        ca, sa = pa10.COS_ALPHA[i], pa10.SIN_ALPHA[i]
        x, y, z = turned, *((ca * side + sa * z, ca * z - sa * side) if ca else (sa * z, -sa * side))
    cross_into(j[:3], j[3:], p[:, None] - origin)
    return j


def whiten(j: Array) -> tuple[dict[tuple[int, int], Array], list[Array], Array]:
    """Off-diagonal entries of L, 1 / its diagonal, and L^-1 J (6, 9, B)."""
    lower: dict[tuple[int, int], Array] = {}
    inverse: list[Array] = []
    for c in range(6):
        for r in range(c, 6):
            entry = np.einsum("kb,kb->b", j[r], j[c])
            for k in range(c):
                entry -= lower[r, k] * lower[c, k]
            if r == c:
                inverse.append(1 / np.sqrt(entry))
            else:
                lower[r, c] = entry * inverse[c]
    y = j.copy()
    for r in range(6):
        for k in range(r):
            y[r] -= lower[r, k] * y[k]
        y[r] *= inverse[r]
    return lower, inverse, y


def worst_columns(q: Array) -> Array:
    """(9, B) joint values -> (B,) smallest rho_k."""
    y = whiten(jacobian(q))[2]
    return np.sqrt(np.maximum(1 - np.einsum("ikb,ikb->kb", y, y).max(axis=0), 0))


def gradient_columns(q: Array) -> Array:
    """(9, B) joint values -> (9, B) gradient of the smallest rho_k.

    Joint i turns every column c >= i about its axis z_i, and moves the tool under the columns c < i: with u = (f, t) and
    j_c = (v_c, z_c), u' dj_c / dq_i is z_i . (v_c x f + z_c x t) for c >= i and v_i . (f x z_c) for c < i.
    """
    j = jacobian(q)
    lower, inverse, y = whiten(j)
    leverage = np.einsum("ikb,ikb->kb", y, y)
    chosen, each = leverage.argmax(axis=0), np.arange(q.shape[1])
    u = y[:, chosen, each]
    for r in reversed(range(6)):
        for k in range(r + 1, 6):
            u[r] -= lower[k, r] * u[k]
        u[r] *= inverse[r]
    weight = -np.einsum("ib,icb->cb", u, j)
    weight[chosen, each] += 1
    v, z, force, torque = j[:3], j[3:], u[:3, None], u[3:, None]
    turning = cross_into(np.empty_like(z), v, force)
    turning += cross_into(np.empty_like(z), z, torque)
    turning *= weight
    moving = cross_into(np.empty_like(z), force, z)
    moving *= weight
    for c in reversed(range(pa10.N - 1)):
        turning[:, c] += turning[:, c + 1]  # sum over the columns from c on
    for c in range(1, pa10.N):
        moving[:, c] += moving[:, c - 1]  # sum over the columns up to c
    gradient = np.einsum("icb,icb->cb", z, turning)
    gradient[1:] += np.einsum("icb,icb->cb", v[:, 1:], moving[:, :-1])
    gradient /= -np.sqrt(1 - leverage[chosen, each])
    return gradient


def in_chunks(formula: Function, threads: int = 1) -> Function:
    """``worst_columns`` or ``gradient_columns`` as a function of (N, 9) row-major configurations."""
    pool = ThreadPoolExecutor(threads) if threads > 1 else None

    def one(rows: Array) -> Array:
        return formula(np.ascontiguousarray(rows.T)).T

    def evaluate(q: Array) -> Array:
        chunks = [q[start : start + CHUNK] for start in range(0, len(q), CHUNK)]
        return np.concatenate(list(map(one, chunks) if pool is None else pool.map(one, chunks)))

    return evaluate
