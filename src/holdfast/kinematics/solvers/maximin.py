"""Step that most increases the smallest of several functions, by a small linear program as straight-line code.

``max sum_p w_p t_p`` over z (r,) and t, subject to ``s_k + g_k z >= t_p`` for every function k of part p, ``|z_i| <= radius``
and limits ``low_j <= a_j z <= high_j``. It takes a fixed number of primal-dual interior-point iterations, so that a batch of
such programs runs in SIMD. The next step corrects the imprecision of this one.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.kernels.linalg import Vector, dot_product, select_smallest, solve_spd
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import ObjectivePart

INTERIOR_POINT_ITERATIONS = 7
_CENTERING_FACTOR = 0.1
_BOUNDARY_FRACTION = 0.9  # fraction of the distance to the boundary that a step may take


def maximin_step(
    parts: Sequence[ObjectivePart], rows: Sequence[Vector], low: Sequence[SX], high: Sequence[SX], radius: SX
) -> Vector:
    """Return the best z (r,).

    Args:
        parts: Terms to increase: a weighted sum of minima of functions, with their slopes along z.
        rows: Directions a_j of the limits, lists of r.
        low: Lower limits of ``a_j z``, finite; +-1e3 means no limit.
        high: Upper limits of ``a_j z``.
        radius: Largest entry of z.
    """
    weights, values, gradients, part_of = _flatten_scaled_parts(parts)
    r, p = len(gradients[0]), len(weights)
    unit_vectors = [[ca.SX(float(i == k)) for i in range(r)] for k in range(r)]
    two_sided = [*zip(rows, low, high, strict=True), *[(e, -radius, radius) for e in unit_vectors]]
    min_slack = 1e-3 * radius  # a limit that is already met; the iteration stalls closer to 0
    count = len(values) + 2 * len(two_sided)

    z: Vector = [ca.SX(0)] * r
    t = [select_smallest([v for v, owner in zip(values, part_of, strict=True) if owner == k]) - 0.5 * radius for k in range(p)]
    value_slack = [v - t[k] for v, k in zip(values, part_of, strict=True)]  # slacks of s_k + g_k z - t_p >= 0
    upper_slack = [_at_least(h, min_slack) for _, _, h in two_sided]
    lower_slack = [_at_least(-lower, min_slack) for _, lower, _ in two_sided]
    mu = 0.1 * radius / count
    y, u, n = [mu / s for s in value_slack], [mu / s for s in upper_slack], [mu / s for s in lower_slack]

    for _ in range(INTERIOR_POINT_ITERATIONS):
        slack_products = dot_product(value_slack, y) + dot_product(upper_slack, u) + dot_product(lower_slack, n)
        target = _CENTERING_FACTOR * slack_products / count
        # residuals of the constraints, and of the multipliers' balance
        ra = [s - (v + dot_product(g, z) - t[k]) for s, v, g, k in zip(value_slack, values, gradients, part_of, strict=True)]
        ru = [s - (h - dot_product(a, z)) for s, (a, _, h) in zip(upper_slack, two_sided, strict=True)]
        ro = [s - (dot_product(a, z) - lower) for s, (a, lower, _) in zip(lower_slack, two_sided, strict=True)]
        wa = [m / s for m, s in zip(y, value_slack, strict=True)]
        wu = [m / s for m, s in zip(u, upper_slack, strict=True)]
        wo = [m / s for m, s in zip(n, lower_slack, strict=True)]
        ca_ = [target / s + w * e for s, w, e in zip(value_slack, wa, ra, strict=True)]
        cu = [target / s + w * e for s, w, e in zip(upper_slack, wu, ru, strict=True)]
        co = [target / s + w * e for s, w, e in zip(lower_slack, wo, ro, strict=True)]
        h: list[list[SX]] = [[ca.SX(0)] * (r + p) for _ in range(r + p)]
        b: Vector = [ca.SX(0)] * r + weights
        for g, w, c, owner in zip(gradients, wa, ca_, part_of, strict=True):
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
        matrix = [[h[max(i, k)][min(i, k)] for k in range(r + p)] for i in range(r + p)]
        for i in range(r + p):
            matrix[i][i] = matrix[i][i] * (1 + 1e-12) + 1e-14
        step = solve_spd(matrix, b)
        dz, dt = step[:r], step[r:]
        da = [dot_product(g, dz) - dt[k] - e for g, e, k in zip(gradients, ra, part_of, strict=True)]
        du = [-dot_product(a, dz) - e for (a, _, _), e in zip(two_sided, ru, strict=True)]
        do = [dot_product(a, dz) - e for (a, _, _), e in zip(two_sided, ro, strict=True)]
        dy = [target / s - m - w * d for s, m, w, d in zip(value_slack, y, wa, da, strict=True)]
        du_ = [target / s - m - w * d for s, m, w, d in zip(upper_slack, u, wu, du, strict=True)]
        dn = [target / s - m - w * d for s, m, w, d in zip(lower_slack, n, wo, do, strict=True)]
        primal_step = _step_length([*value_slack, *upper_slack, *lower_slack], [*da, *du, *do])
        dual_step = _step_length([*y, *u, *n], [*dy, *du_, *dn])
        z = [x + primal_step * d for x, d in zip(z, dz, strict=True)]
        t = [x + primal_step * d for x, d in zip(t, dt, strict=True)]
        value_slack = [s + primal_step * d for s, d in zip(value_slack, da, strict=True)]
        upper_slack = [s + primal_step * d for s, d in zip(upper_slack, du, strict=True)]
        lower_slack = [s + primal_step * d for s, d in zip(lower_slack, do, strict=True)]
        y = [m + dual_step * d for m, d in zip(y, dy, strict=True)]
        u = [m + dual_step * d for m, d in zip(u, du_, strict=True)]
        n = [m + dual_step * d for m, d in zip(n, dn, strict=True)]
    return z


def _flatten_scaled_parts(parts: Sequence[ObjectivePart]) -> tuple[list[SX], list[SX], list[Vector], list[int]]:
    """Return weights that sum to 1, functions, gradients, and the part that each function belongs to.

    The iteration starts from slacks of the size of the radius, so each part is divided by the size of its slopes, which can be
    arbitrary. Without this, one configuration in five of a Panda missed the best manipulability by more than 1e-3.
    """
    values, gradients, part_of = [], [], []
    weights: list[SX] = []
    for index, part in enumerate(parts):
        steepness = ca.sqrt(sum((entry * entry for row in part.slopes for entry in row), ca.SX(1e-200)))
        values += [value / steepness for value in part.values]
        gradients += [[entry / steepness for entry in row] for row in part.slopes]
        part_of += [index] * len(part.values)
        weights.append(part.weight * steepness)
    total = sum(weights[1:], weights[0])
    return [weight / total for weight in weights], values, gradients, part_of


def _at_least(x: SX, minimum: SX) -> SX:
    return ca.if_else(x < minimum, minimum, x)


def _step_length(values: Sequence[SX], changes: Sequence[SX]) -> SX:
    """Return the largest step up to 1 that keeps every value positive."""
    largest_ratio = ca.SX(_BOUNDARY_FRACTION)
    for value, change in zip(values, changes, strict=True):
        ratio = -change / value
        largest_ratio = ca.if_else(ratio > largest_ratio, ratio, largest_ratio)
    return _BOUNDARY_FRACTION / largest_ratio
