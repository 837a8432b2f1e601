"""The step that raises the lowest of several functions most: a small linear program, as straight-line code.

``max t`` over z (r,) and t, subject to ``s_k + g_k z >= t`` for every function, ``|z_i| <= radius`` and limits
``low_j <= a_j z <= high_j``. Solved by a fixed number of primal-dual interior-point iterations, so that a batch of such
programs runs in SIMD; what a step lacks in precision the next one makes up for.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.kernels import SX
from holdfast.linalg import Vector, dot, solve_spd

ITERATIONS = 7
_CENTRING = 0.1
_KEEP_OFF = 0.9  # share of the way to the boundary that a step may go


def maximin_step(
    values: Sequence[SX], slopes: Sequence[Vector], rows: Sequence[Vector], low: Sequence[SX], high: Sequence[SX], radius: SX
) -> Vector:
    """The best z (r,).

    Args:
        values: F functions now.
        slopes: Their derivatives along z, F lists of r.
        rows: Directions a_j of the limits, lists of r.
        low: Lower limits of ``a_j z``; finite: +-1e3 stands for no limit.
        high: Upper limits.
        radius: Largest entry of z.
    """
    r = len(slopes[0])
    unit = [[ca.SX(float(i == k)) for i in range(r)] for k in range(r)]
    two_sided = [*zip(rows, low, high, strict=True), *[(e, -radius, radius) for e in unit]]
    floor = 1e-3 * radius  # a limit that is met already; closer to 0 the iteration stalls there
    count = len(values) + 2 * len(two_sided)

    z: Vector = [ca.SX(0)] * r
    lowest = values[0]
    for v in values[1:]:
        lowest = ca.if_else(v < lowest, v, lowest)
    t = lowest - 0.5 * radius
    above = [v - t for v in values]  # slacks of s_k + g_k z - t >= 0
    under = [_at_least(h, floor) for _, _, h in two_sided]
    over = [_at_least(-lo, floor) for _, lo, _ in two_sided]
    mu = 0.1 * radius / count
    y, p, n = [mu / s for s in above], [mu / s for s in under], [mu / s for s in over]

    for _ in range(ITERATIONS):
        target = _CENTRING * (dot(above, y) + dot(under, p) + dot(over, n)) / count
        # residuals of the constraints, and of the multipliers' balance
        ra = [s - (v + dot(g, z) - t) for s, v, g in zip(above, values, slopes, strict=True)]
        ru = [s - (h - dot(a, z)) for s, (a, _, h) in zip(under, two_sided, strict=True)]
        ro = [s - (dot(a, z) - lo) for s, (a, lo, _) in zip(over, two_sided, strict=True)]
        wa = [m / s for m, s in zip(y, above, strict=True)]
        wu = [m / s for m, s in zip(p, under, strict=True)]
        wo = [m / s for m, s in zip(n, over, strict=True)]
        ca_ = [target / s + w * e for s, w, e in zip(above, wa, ra, strict=True)]
        cu = [target / s + w * e for s, w, e in zip(under, wu, ru, strict=True)]
        co = [target / s + w * e for s, w, e in zip(over, wo, ro, strict=True)]
        h: list[list[SX]] = [[ca.SX(0)] * (r + 1) for _ in range(r + 1)]
        b: Vector = [ca.SX(0)] * r + [ca.SX(1)]
        for g, w, c in zip(slopes, wa, ca_, strict=True):
            for i in range(r):
                for k in range(i + 1):
                    h[i][k] = h[i][k] + w * g[i] * g[k]
                h[r][i] = h[r][i] - w * g[i]
                b[i] = b[i] + c * g[i]
            h[r][r] = h[r][r] + w
            b[r] = b[r] - c
        for (a, _, _), w1, w2, c1, c2 in zip(two_sided, wu, wo, cu, co, strict=True):
            w, c = w1 + w2, c2 - c1
            for i in range(r):
                for k in range(i + 1):
                    h[i][k] = h[i][k] + w * a[i] * a[k]
                b[i] = b[i] + c * a[i]
        full = [[h[max(i, k)][min(i, k)] for k in range(r + 1)] for i in range(r + 1)]
        for i in range(r + 1):
            full[i][i] = full[i][i] * (1 + 1e-12) + 1e-14
        step = solve_spd(full, b)
        dz, dt = step[:r], step[r]
        da = [dot(g, dz) - dt - e for g, e in zip(slopes, ra, strict=True)]
        du = [-dot(a, dz) - e for (a, _, _), e in zip(two_sided, ru, strict=True)]
        do = [dot(a, dz) - e for (a, _, _), e in zip(two_sided, ro, strict=True)]
        dy = [target / s - m - w * d for s, m, w, d in zip(above, y, wa, da, strict=True)]
        dp = [target / s - m - w * d for s, m, w, d in zip(under, p, wu, du, strict=True)]
        dn = [target / s - m - w * d for s, m, w, d in zip(over, n, wo, do, strict=True)]
        primal = _step_length([*above, *under, *over], [*da, *du, *do])
        dual = _step_length([*y, *p, *n], [*dy, *dp, *dn])
        z = [x + primal * d for x, d in zip(z, dz, strict=True)]
        t = t + primal * dt
        above = [s + primal * d for s, d in zip(above, da, strict=True)]
        under = [s + primal * d for s, d in zip(under, du, strict=True)]
        over = [s + primal * d for s, d in zip(over, do, strict=True)]
        y = [m + dual * d for m, d in zip(y, dy, strict=True)]
        p = [m + dual * d for m, d in zip(p, dp, strict=True)]
        n = [m + dual * d for m, d in zip(n, dn, strict=True)]
    return z


def _at_least(x: SX, floor: SX) -> SX:
    return ca.if_else(x < floor, floor, x)


def _step_length(values: Sequence[SX], changes: Sequence[SX]) -> SX:
    """Largest step up to 1 that keeps every value positive."""
    worst = ca.SX(_KEEP_OFF)
    for v, d in zip(values, changes, strict=True):
        ratio = -d / v
        worst = ca.if_else(ratio > worst, ratio, worst)
    return _KEEP_OFF / worst
