"""How the rates of the failure-tolerant inverse change with their inputs, without differentiating the search of the damping.

Where the search has ended one of three equations holds, and by the implicit function theorem tells how ``s = lambda^2``
changes: the healthy error is the allowed one, the errors of two joints are the same (a kink), or the slope of the worst error
is 0. Where no damping is best, or none is allowed, s stays.
"""

from __future__ import annotations

import casadi as ca

from holdfast.kernels import SX
from holdfast.linalg import gram, solve_spd

_END = 1e-9  # relative: a damping as near to the largest is that
_KINK = 1e-6  # relative: as near is the second error to the first at a kink
_FLAT = 1e-9  # of error / s: two slopes smaller than this are both 0, of joints that always share their error


def slopes(j: SX, v: SX, allowed: float, found: dict[str, SX], by: SX) -> SX:
    """Derivatives (n, k) of ``J' (J J' + s I)^-1 v``.

    Args:
        j: (m, n) task Jacobian, an expression of ``by``.
        v: (m,) task velocity, an expression of ``by``.
        allowed: Error of the healthy arm for the unit velocity.
        found: ``damping``, ``largest_damping`` and ``feasible`` there, as the search has them.
        by: (k,) symbols.
    """
    n, k = j.shape[1], by.numel()
    s, top, other, kink = ca.SX.sym("s"), ca.SX.sym("top", n), ca.SX.sym("other", n), ca.SX.sym("kink")
    y = ca.vertcat(*solve_spd(gram(j, s), ca.vertsplit(ca.densify(v))))
    rates = j.T @ y
    healthy = s * s * ca.sumsqr(y)
    errors = healthy + rates * rates * (2 * s + ca.sum1(j * j).T)
    steep = ca.jacobian(errors, s)
    end = found["damping"] >= found["largest_damping"] * (1 - _END)
    ends = ca.SX.sym("ends")
    turning = ca.if_else(kink, ca.dot(top - other, errors), ca.dot(top, steep))
    condition = ca.if_else(ends, healthy - allowed**2 * ca.sumsqr(v), turning)
    change = ca.jacobian(condition, ca.vertcat(by, s))
    moves = ca.logic_and(found["feasible"], found["damping"] > 0)
    follows = ca.SX.sym("follows")
    through = ca.if_else(ca.logic_and(follows, change[k] != 0), -change[:k] / change[k], 0.0)
    out = ca.jacobian(rates, by) + ca.jacobian(rates, s) @ through

    first, most, slope = _largest(errors, errors, steep)
    crossing = [ca.if_else(x * slope < 0, e, 0.0) for x, e in zip(ca.vertsplit(steep), ca.vertsplit(errors), strict=True)]
    second, next_most, opposite = _largest(ca.vertcat(*crossing), errors, steep)
    near = ca.logic_and(next_most > most * (1 - _KINK), -slope * opposite * s * s > (_FLAT * most) ** 2)
    out = ca.substitute(out, ca.vertcat(top, other, kink), ca.vertcat(first, second, near))
    return ca.substitute(out, ca.vertcat(s, ends, follows), ca.vertcat(found["damping"] ** 2, end, moves))


def _largest(sizes: SX, errors: SX, steep: SX) -> tuple[SX, SX, SX]:
    """Which of the sizes (n,) is the largest, as 0 and 1 (n,); its error and slope."""
    best, at = sizes[0], ca.SX(0)
    for k in range(1, sizes.numel()):
        more = sizes[k] > best
        best, at = ca.if_else(more, sizes[k], best), ca.if_else(more, k, at)
    chosen = ca.vertcat(*[at == k for k in range(sizes.numel())])
    return chosen, ca.dot(chosen, errors), ca.dot(chosen, steep)
