"""The step that raises the lowest of several functions most: a small linear program, as straight-line code.

``max sum_p w_p t_p`` over z (r,) and t, subject to ``s_k + g_k z >= t_p`` for every function k of part p, ``|z_i| <= radius``
and limits ``low_j <= a_j z <= high_j``. Solved by a fixed number of primal-dual interior-point iterations, so that a batch
of such programs runs in SIMD; what a step lacks in precision the next one makes up for.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.indices.objective import Part
from holdfast.kernels.program import SX
from holdfast.linalg import Vector, dot, smallest, solve_spd

ITERATIONS = 7
_CENTRING = 0.1
_KEEP_OFF = 0.9  # share of the way to the boundary that a step may go


def maximin_step(parts: Sequence[Part], rows: Sequence[Vector], low: Sequence[SX], high: Sequence[SX], radius: SX) -> Vector:
    """The best z (r,).

    Args:
        parts: What to raise: a weighted sum of minima of functions, with the slopes of these along z.
        rows: Directions a_j of the limits, lists of r.
        low: Lower limits of ``a_j z``; finite: +-1e3 stands for no limit.
        high: Upper limits.
        radius: Largest entry of z.
    """
    weights, values, slopes, part_of = _scaled(parts)
    r, p = len(slopes[0]), len(weights)
    unit = [[ca.SX(float(i == k)) for i in range(r)] for k in range(r)]
    two_sided = [*zip(rows, low, high, strict=True), *[(e, -radius, radius) for e in unit]]
    floor = 1e-3 * radius  # a limit that is met already; closer to 0 the iteration stalls there
    count = len(values) + 2 * len(two_sided)

    z: Vector = [ca.SX(0)] * r
    t = [smallest([v for v, owner in zip(values, part_of, strict=True) if owner == k]) - 0.5 * radius for k in range(p)]
    above = [v - t[k] for v, k in zip(values, part_of, strict=True)]  # slacks of s_k + g_k z - t_p >= 0
    under = [_at_least(h, floor) for _, _, h in two_sided]
    over = [_at_least(-lo, floor) for _, lo, _ in two_sided]
    mu = 0.1 * radius / count
    y, u, n = [mu / s for s in above], [mu / s for s in under], [mu / s for s in over]

    for _ in range(ITERATIONS):
        target = _CENTRING * (dot(above, y) + dot(under, u) + dot(over, n)) / count
        # residuals of the constraints, and of the multipliers' balance
        ra = [s - (v + dot(g, z) - t[k]) for s, v, g, k in zip(above, values, slopes, part_of, strict=True)]
        ru = [s - (h - dot(a, z)) for s, (a, _, h) in zip(under, two_sided, strict=True)]
        ro = [s - (dot(a, z) - lo) for s, (a, lo, _) in zip(over, two_sided, strict=True)]
        wa = [m / s for m, s in zip(y, above, strict=True)]
        wu = [m / s for m, s in zip(u, under, strict=True)]
        wo = [m / s for m, s in zip(n, over, strict=True)]
        ca_ = [target / s + w * e for s, w, e in zip(above, wa, ra, strict=True)]
        cu = [target / s + w * e for s, w, e in zip(under, wu, ru, strict=True)]
        co = [target / s + w * e for s, w, e in zip(over, wo, ro, strict=True)]
        h: list[list[SX]] = [[ca.SX(0)] * (r + p) for _ in range(r + p)]
        b: Vector = [ca.SX(0)] * r + weights
        for g, w, c, owner in zip(slopes, wa, ca_, part_of, strict=True):
            for i in range(r):
                for k in range(i + 1):
                    h[i][k] = h[i][k] + w * g[i] * g[k]
                h[r + owner][i] = h[r + owner][i] - w * g[i]
                b[i] = b[i] + c * g[i]
            h[r + owner][r + owner] = h[r + owner][r + owner] + w
            b[r + owner] = b[r + owner] - c
        for (a, _, _), w1, w2, c1, c2 in zip(two_sided, wu, wo, cu, co, strict=True):
            w, c = w1 + w2, c2 - c1
            for i in range(r):
                for k in range(i + 1):
                    h[i][k] = h[i][k] + w * a[i] * a[k]
                b[i] = b[i] + c * a[i]
        full = [[h[max(i, k)][min(i, k)] for k in range(r + p)] for i in range(r + p)]
        for i in range(r + p):
            full[i][i] = full[i][i] * (1 + 1e-12) + 1e-14
        step = solve_spd(full, b)
        dz, dt = step[:r], step[r:]
        da = [dot(g, dz) - dt[k] - e for g, e, k in zip(slopes, ra, part_of, strict=True)]
        du = [-dot(a, dz) - e for (a, _, _), e in zip(two_sided, ru, strict=True)]
        do = [dot(a, dz) - e for (a, _, _), e in zip(two_sided, ro, strict=True)]
        dy = [target / s - m - w * d for s, m, w, d in zip(above, y, wa, da, strict=True)]
        du_ = [target / s - m - w * d for s, m, w, d in zip(under, u, wu, du, strict=True)]
        dn = [target / s - m - w * d for s, m, w, d in zip(over, n, wo, do, strict=True)]
        primal = _step_length([*above, *under, *over], [*da, *du, *do])
        dual = _step_length([*y, *u, *n], [*dy, *du_, *dn])
        z = [x + primal * d for x, d in zip(z, dz, strict=True)]
        t = [x + primal * d for x, d in zip(t, dt, strict=True)]
        above = [s + primal * d for s, d in zip(above, da, strict=True)]
        under = [s + primal * d for s, d in zip(under, du, strict=True)]
        over = [s + primal * d for s, d in zip(over, do, strict=True)]
        y = [m + dual * d for m, d in zip(y, dy, strict=True)]
        u = [m + dual * d for m, d in zip(u, du_, strict=True)]
        n = [m + dual * d for m, d in zip(n, dn, strict=True)]
    return z


def _scaled(parts: Sequence[Part]) -> tuple[list[SX], list[SX], list[Vector], list[int]]:
    """Weights that sum to 1, functions, slopes, and which part each function belongs to.

    The iteration starts from slacks of the size of the radius, so each part is divided by the size of its slopes, which
    may be anything: without it, one configuration in five of a Panda missed the best manipulability by more than 1e-3.
    """
    values, slopes, part_of = [], [], []
    weights: list[SX] = []
    for number, part in enumerate(parts):
        steepness = ca.sqrt(sum((x * x for row in part.slopes for x in row), ca.SX(1e-200)))
        values += [v / steepness for v in part.values]
        slopes += [[x / steepness for x in row] for row in part.slopes]
        part_of += [number] * len(part.values)
        weights.append(part.weight * steepness)
    total = sum(weights[1:], weights[0])
    return [w / total for w in weights], values, slopes, part_of


def _at_least(x: SX, floor: SX) -> SX:
    return ca.if_else(x < floor, floor, x)


def _step_length(values: Sequence[SX], changes: Sequence[SX]) -> SX:
    """Largest step up to 1 that keeps every value positive."""
    worst = ca.SX(_KEEP_OFF)
    for v, d in zip(values, changes, strict=True):
        ratio = -d / v
        worst = ca.if_else(ratio > worst, ratio, worst)
    return _KEEP_OFF / worst
