"""Index and gradient as straight-line code on scalars, for compilers that like it: JAX (a scalar is a batch) and CasADi.

The formulas are those of ``numpy_soa.py``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

import pa10
from harness import Function

Scalar = Any
Vector = Sequence[Scalar]

JOINTS, ROWS = range(pa10.N), range(6)


def dot(a: Vector, b: Vector) -> Scalar:
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def cross(a: Vector, b: Vector) -> list[Scalar]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a: Vector, b: Vector, factor: float = 1.0) -> list[Scalar]:
    return [x + (y if factor == 1 else factor * y) for x, y in zip(a, b, strict=True)]


def columns_of_jacobian(cosine: Vector, sine: Vector) -> list[list[Scalar]]:
    """Nine columns (v, z) of six scalars."""
    zero = cosine[0] * 0
    one = zero + 1
    x, y, z, p = [one, zero, zero], [zero, one, zero], [zero, zero, one], [zero, zero, zero]
    axes, origins = [], []
    for i in JOINTS:
        axes.append(z)
        origins.append(p)
        turned = [cosine[i] * a + sine[i] * b for a, b in zip(x, y, strict=True)]
        side = [cosine[i] * b - sine[i] * a for a, b in zip(x, y, strict=True)]
        if pa10.D[i]:
            p = plus(p, z, float(pa10.D[i]))
        if pa10.A[i]:
            p = plus(p, turned, float(pa10.A[i]))
        ca, sa = float(pa10.COS_ALPHA[i]), float(pa10.SIN_ALPHA[i])
        if ca:
            y, z = plus([ca * a for a in side], z, sa), plus([ca * a for a in z], side, -sa)
        else:
            y, z = [sa * a for a in z], [-sa * a for a in side]
        x = turned
    return [cross(z, plus(p, origin, -1.0)) + z for z, origin in zip(axes, origins, strict=True)]


def whiten(j: list[list[Scalar]], sqrt: Callable[[Scalar], Scalar]) -> tuple[list[Vector], Vector, list[Vector]]:
    """L, 1 / its diagonal, and the columns of L^-1 J."""
    lower: list[list[Scalar]] = [[None] * 6 for _ in ROWS]
    inverse: list[Scalar] = []
    for c in ROWS:
        for r in range(c, 6):
            entry = dot([column[r] for column in j], [column[c] for column in j])
            for k in range(c):
                entry = entry - lower[r][k] * lower[c][k]
            if r == c:
                inverse.append(1 / sqrt(entry))
            else:
                lower[r][c] = entry * inverse[c]
    whitened = []
    for column in j:
        y: list[Scalar] = []
        for r in ROWS:
            entry = column[r]
            for k in range(r):
                entry = entry - lower[r][k] * y[k]
            y.append(entry * inverse[r])
        whitened.append(y)
    return lower, inverse, whitened


def largest(values: Vector, maximum: Callable[[Scalar, Scalar], Scalar]) -> Scalar:
    best = values[0]
    for x in values[1:]:
        best = maximum(best, x)
    return best


def worst(cosine: Vector, sine: Vector, sqrt: Callable[..., Scalar], maximum: Callable[..., Scalar]) -> Scalar:
    """The smallest rho_k."""
    whitened = whiten(columns_of_jacobian(cosine, sine), sqrt)[2]
    return sqrt(maximum(1 - largest([dot(y, y) for y in whitened], maximum), 0.0))


def gradient(cosine: Vector, sine: Vector, sqrt: Callable[..., Scalar], maximum: Callable[..., Scalar]) -> list[Scalar]:
    """Its derivative by the nine joints."""
    j = columns_of_jacobian(cosine, sine)
    lower, inverse, whitened = whiten(j, sqrt)
    leverage = [dot(y, y) for y in whitened]
    top = largest(leverage, maximum)
    chosen = [(h == top) * 1.0 for h in leverage]
    u = [dot([y[r] for y in whitened], chosen) for r in ROWS]
    for r in reversed(ROWS):
        for k in range(r + 1, 6):
            u[r] = u[r] - lower[k][r] * u[k]
        u[r] = u[r] * inverse[r]
    force, torque = u[:3], u[3:]
    weight = [e - dot(u, column) for e, column in zip(chosen, j, strict=True)]
    turning = [[w * a for a in plus(cross(c[:3], force), cross(c[3:], torque))] for w, c in zip(weight, j, strict=True)]
    moving = [[w * a for a in cross(force, c[3:])] for w, c in zip(weight, j, strict=True)]
    for c in reversed(range(pa10.N - 1)):
        turning[c] = plus(turning[c], turning[c + 1])
    for c in range(1, pa10.N):
        moving[c] = plus(moving[c], moving[c - 1])
    slope = -1 / sqrt(1 - top)
    out = [dot(j[0][3:], turning[0])]
    out += [dot(j[c][3:], turning[c]) + dot(j[c][:3], moving[c - 1]) for c in range(1, pa10.N)]
    return [g * slope for g in out]


def in_jax(formula: Callable[..., Any], chunk: int | None = None) -> Function:
    """Compiled by XLA as a function of (N, 9) row-major configurations, over all of them or in a loop over chunks.

    Cosines and sines are held apart: fused into each of their uses, XLA would compute them many times.
    """
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    @jax.jit
    def compiled(rows: Any) -> Any:
        cosine, sine = jax.lax.optimization_barrier((jnp.cos(rows.T), jnp.sin(rows.T)))
        result = formula(cosine, sine, jnp.sqrt, jnp.maximum)
        return jnp.stack(result, axis=-1) if isinstance(result, list) else result

    def evaluate(q: np.ndarray) -> np.ndarray:
        if chunk is None or len(q) <= chunk:
            return np.asarray(compiled(q))
        parts = [compiled(q[start : start + chunk]) for start in range(0, len(q), chunk)]
        return np.concatenate([np.asarray(part) for part in parts])

    return evaluate


def casadi_gradient(threads: int, batch: int) -> Function:
    """CasADi's own derivative of the index on its virtual machine, mapped over threads."""
    import casadi as ca

    q = ca.SX.sym("q", pa10.N)
    angles = ca.vertsplit(q)
    rho = worst([ca.cos(a) for a in angles], [ca.sin(a) for a in angles], ca.sqrt, ca.fmax)
    function = ca.Function("gradient", [q], [ca.gradient(rho, q)], {"cse": True})
    mapped = {}

    def evaluate(rows: np.ndarray) -> np.ndarray:
        if len(rows) not in mapped:
            mapped[len(rows)] = function.map(len(rows), "thread", threads) if len(rows) == batch else function.map(len(rows))
        return np.asarray(mapped[len(rows)](rows.T)).T

    return evaluate
