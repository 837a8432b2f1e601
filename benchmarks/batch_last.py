"""Index and gradient in arrays whose last axis is the batch: the form that suits NumPy and JAX best.

With J = [j_1 .. j_9], Cholesky J J' = L L' and y_k = L^-1 j_k, the leverage of column k is h_k = |y_k|^2 and
rho_k = sqrt(1 - h_k). For the worst column let u = (J J')^-1 j_k and w = e_k - J' u; then dh_k = 2 sum_c w_c u' dj_c.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from types import ModuleType
from typing import Any

import numpy as np
import pa10
from harness import Function

Array = Any  # of NumPy or JAX

CHUNK = 512  # configurations; the intermediate arrays then stay in the cache


def cross(a: Array, b: Array, xp: ModuleType) -> Array:
    return xp.stack((a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]))


def jacobian(cosine: Array, sine: Array, xp: ModuleType) -> Array:
    """(9, B) cosines and sines -> (6, 9, B)."""
    unit = np.eye(3)[:, :, None] + xp.zeros_like(cosine[0])
    x, y, z, p = unit[0], unit[1], unit[2], xp.zeros_like(unit[0])
    axes, origins = [], []
    for i in range(pa10.N):
        axes.append(z)
        origins.append(p)
        turned, side = cosine[i] * x + sine[i] * y, cosine[i] * y - sine[i] * x
        if pa10.D[i]:
            p = p + float(pa10.D[i]) * z
        if pa10.A[i]:
            p = p + float(pa10.A[i]) * turned
        ca, sa = float(pa10.COS_ALPHA[i]), float(pa10.SIN_ALPHA[i])
        x, y, z = turned, *((ca * side + sa * z, ca * z - sa * side) if ca else (sa * z, -sa * side))
    z = xp.stack(axes, axis=1)
    return xp.concatenate((cross(z, p[:, None] - xp.stack(origins, axis=1), xp), z))


def whiten(j: Array, xp: ModuleType) -> tuple[dict[tuple[int, int], Array], list[Array], Array]:
    """Off-diagonal entries of L, 1 / its diagonal, and Y = L^-1 J (6, 9, B)."""
    lower: dict[tuple[int, int], Array] = {}
    inverse: list[Array] = []
    for c in range(6):
        for r in range(c, 6):
            entry = xp.einsum("kb,kb->b", j[r], j[c]) if xp is np else (j[r] * j[c]).sum(0)
            for k in range(c):
                entry = entry - (lower[r, k] * lower[c, k])
            if r == c:
                inverse.append(1 / xp.sqrt(entry))
            else:
                lower[r, c] = entry * inverse[c]
    lines: list[Array] = []
    for r in range(6):
        entry = j[r]
        for k in range(r):
            entry = entry - lower[r, k] * lines[k]
        lines.append(entry * inverse[r])
    return lower, inverse, xp.stack(lines)


def squared_columns(y: Array, xp: ModuleType) -> Array:
    return xp.einsum("ikb,ikb->kb", y, y) if xp is np else (y * y).sum(0)


def worst(cosine: Array, sine: Array, xp: ModuleType) -> Array:
    """(B,) the smallest rho_k."""
    y = whiten(jacobian(cosine, sine, xp), xp)[2]
    return xp.sqrt(xp.maximum(1 - squared_columns(y, xp).max(0), 0))


def gradient(cosine: Array, sine: Array, xp: ModuleType) -> Array:
    """(9, B) gradient of the smallest rho_k.

    Joint i turns column c >= i about its axis z_i and moves the tool under column c < i, so
    u' dj_c / dq_i = z_i . (v_c x f + z_c x t) for c >= i and v_i . (f x z_c) for c < i, with u = (f, t), j_c = (v_c, z_c).
    """
    j = jacobian(cosine, sine, xp)
    v, z = j[:3], j[3:]
    lower, inverse, y = whiten(j, xp)
    leverage = squared_columns(y, xp)
    largest = leverage.max(0)
    chosen = (leverage == largest).astype(leverage.dtype)
    u = list((y * chosen).sum(1))
    for r in reversed(range(6)):
        for k in range(r + 1, 6):
            u[r] = u[r] - lower[k, r] * u[k]
        u[r] = u[r] * inverse[r]
    u = xp.stack(u)
    weight = chosen - (xp.einsum("ib,icb->cb", u, j) if xp is np else (u[:, None] * j).sum(0))
    force, torque = u[:3, None], u[3:, None]
    own = (cross(v, force, xp) + cross(z, torque, xp)) * weight
    lever = cross(force, z, xp) * weight
    outward = xp.cumsum(own[:, ::-1], axis=1)[:, ::-1]
    inward = xp.cumsum(lever, axis=1) - lever
    return -((z * outward).sum(0) + (v * inward).sum(0)) / xp.sqrt(1 - largest)


def in_numpy(formula: Any, threads: int = 1) -> Function:
    """``worst`` or ``gradient`` as a function of (N, 9) row-major configurations, in chunks that fit the cache."""
    pool = ThreadPoolExecutor(threads) if threads > 1 else None

    def one(rows: np.ndarray) -> np.ndarray:
        columns = np.ascontiguousarray(rows.T)
        return formula(np.cos(columns), np.sin(columns), np).T

    def evaluate(q: np.ndarray) -> np.ndarray:
        chunks = [q[start : start + CHUNK] for start in range(0, len(q), CHUNK)]
        return np.concatenate(list(map(one, chunks) if pool is None else pool.map(one, chunks)))

    return evaluate


def in_jax(formula: Any, chunk: int | None = None) -> Function:
    """The same compiled by XLA, over the whole batch or in a Python loop over chunks.

    Cosines and sines are held apart: fused into each use, XLA would compute them many times.
    """
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    @jax.jit
    def compiled(rows: Array) -> Array:
        columns = rows.T
        return formula(*jax.lax.optimization_barrier((jnp.cos(columns), jnp.sin(columns))), jnp).T

    def evaluate(q: np.ndarray) -> np.ndarray:
        if chunk is None or len(q) <= chunk:
            return np.asarray(compiled(q))
        parts = [compiled(q[start : start + chunk]) for start in range(0, len(q), chunk)]
        return np.concatenate([np.asarray(part) for part in parts])

    return evaluate
