r"""How the index of a design at a pose changes with the design, at the best configuration: exactly, by its multipliers.

With scores s of the failures, the pose error c and the limits, the best configuration solves ``max t`` subject to
``s_k(q, x) >= t``, ``c(q, x) = 0`` and ``lower(x) <= q <= upper(x)``. At a strict optimum the value changes with the design as
the Lagrangian does with q and the multipliers held still (envelope theorem):

.. math:: \mathrm{d}t/\mathrm{d}x = \partial_x(\lambda^\top s - \mu^\top c) + \sigma^\top \partial_x(\text{active limits}).

So no derivative of the best configuration is needed, but the multipliers must be exact. They come from a quadratic program at
the configuration that the search ended with, and then from Newton's method on the conditions of the optimum, which at the same
time brings the configuration from the 1e-4 rad or so of the search to rounding error.

Source: Fiacco 1983, section 3.4, for the derivative; Lawson and Hanson 1974, chapter 23, for the quadratic program.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.designs.evaluation import Evaluated, Evaluator

Array = NDArray[np.float64]
Index = NDArray[np.intp]

_NEWTON = 10
_APART = 1e-5  # rad or m: for second derivatives, which only say how fast Newton's method converges, not where to
_TRUST = 0.1  # rad or m: largest change of a joint in one step
_CURVED = 1e-2  # of the quadratic program: steps of this size are worth a change of the score by their slope
_SMALL = 1e-8  # what counts as 0 of the conditions


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """R designs and poses.

    Attributes:
        q: (R, n) the configuration, more exactly the best than the one given.
        value: (R,) the index there; where the pose is not reached minus the miss.
        gradient: (R, k) by the design.
        exact: (R,) the conditions of an optimum hold to 1e-8, so that the gradient is that of the value; if not it comes from
            the configuration as it was given.
    """

    q: Array
    value: Array
    gradient: Array
    exact: NDArray[np.bool_]


def sensitivity(evaluator: Evaluator, found: Evaluated, chosen: Index) -> Sensitivity:
    """Values and gradients of some rows of what was evaluated.

    Args:
        evaluator: That evaluated.
        found: D designs at P poses.
        chosen: (R,) rows: design times P plus pose.
    """
    count, k = len(chosen), len(evaluator.family.space.parameters)
    q = found.q.reshape(-1, evaluator.family.arm.n)[chosen].copy()
    reached = found.reached.reshape(-1)[chosen]
    value, gradient, exact = np.zeros(count), np.zeros((count, k)), np.zeros(count, dtype=bool)
    for rows, solve in ((np.flatnonzero(reached), _of_reached), (np.flatnonzero(~reached), _of_missed)):
        if rows.size:
            q[rows], value[rows], gradient[rows], exact[rows] = solve(evaluator, found.values, chosen[rows], q[rows])
    return Sensitivity(q=q, value=value, gradient=gradient, exact=exact)


def _by_limits(evaluator: Evaluator, force: Array) -> Array:
    """What the limits that are parameters add to a gradient: ``force`` (R, n) of joints at their limits."""
    added = np.zeros((len(force), len(evaluator.family.space.parameters)))
    for i, p in enumerate(evaluator.family.space.parameters):
        if p.row is not None and p.kind in ("lower", "upper"):
            pushed = force[:, p.row]
            added[:, i] = np.where(pushed > 0, pushed, 0.0) if p.kind == "upper" else np.where(pushed < 0, pushed, 0.0)
    return added


def _of_missed(evaluator: Evaluator, values: Array, owner: Index, q: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Minus the miss and its gradient, at the configuration that comes nearest: Newton's method within the limits."""
    family = evaluator.family
    p, r, x = evaluator.rows(owner, values)
    low, high = (limit[owner // len(evaluator.poses)] for limit in family.limits(values))
    m, n = family.task.m, family.arm.n

    def pulled(q: Array) -> tuple[Array, Array, Array]:
        """Error (R, m), with what force it pulls at the joints (R, n), and derivative of half its square by the design."""
        out = np.nan_to_num(family.misses.rows(q, p, r, x))
        return out[:, :m], out[:, m : m + n], out[:, m + n :]

    e, pull, by_design = pulled(q)
    trust = np.full(len(q), _TRUST)
    for _ in range(_NEWTON):
        held = ((q <= low) & (pull < 0)) | ((q >= high) & (pull > 0))
        curvature = np.stack([(pulled(q + h)[1] - pulled(q - h)[1]) / (2 * _APART) for h in _APART * np.eye(n)], axis=2)
        curvature = (curvature + curvature.swapaxes(1, 2)) / 2
        curvature = np.where(held[:, :, None] | held[:, None, :], -np.eye(n), curvature)
        size, axes = np.linalg.eigh(curvature)
        # Away from the optimum the error may be curved the wrong way: then along the slope.
        along = np.einsum("rij,ri->rj", axes, np.where(held, 0.0, pull)) / np.maximum(np.abs(size), 1e-4)
        move = np.einsum("rij,rj->ri", axes, along)
        move *= np.minimum(1.0, trust / np.maximum(np.abs(move).max(axis=1), 1e-300))[:, None]
        ahead = np.clip(q + move, low, high)
        e_ahead, pull_ahead, by_ahead = pulled(ahead)
        better = (np.linalg.norm(e_ahead, axis=1) <= np.linalg.norm(e, axis=1) + 1e-12)[:, None]
        q, e, pull = np.where(better, ahead, q), np.where(better, e_ahead, e), np.where(better, pull_ahead, pull)
        by_design = np.where(better, by_ahead, by_design)
        trust = np.where(better[:, 0], trust, trust / 4)
    miss = np.linalg.norm(e, axis=1)
    # Moved by dq the error falls by J dq: a joint that is pulled against its limit would follow that limit.
    held = ((q <= low) & (pull < 0)) | ((q >= high) & (pull > 0))
    gradient = (_by_limits(evaluator, np.where(held, pull, 0.0)) - by_design) / np.maximum(miss, 1e-12)[:, None]
    return q, -miss, gradient, np.abs(np.where(held, 0.0, pull)).max(axis=1) <= _SMALL * np.maximum(miss, _SMALL)


def _of_reached(evaluator: Evaluator, values: Array, owner: Index, q: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    family = evaluator.family
    p, r, x = evaluator.rows(owner, values)
    low, high = (limit[owner // len(evaluator.poses)] for limit in family.limits(values))
    problem = _Problem(evaluator, p, r, x, low, high)
    first = problem.guess(q)
    last, exact = problem.solved(first)
    before = problem.value(first)
    after = problem.value(last)
    exact &= (after >= before - 1e-6) & ((last.q >= low) & (last.q <= high)).all(axis=1)
    exact &= evaluator.on_pose(values, owner, last.q)
    chosen = first.where(exact, last)
    out = problem.by_design(chosen)
    rate = out[:, 1:2]
    gradient = rate * (out[:, 2:] + _by_limits(evaluator, chosen.force))
    gradient = np.where(np.isfinite(gradient), gradient, 0.0)
    return chosen.q, np.nan_to_num(out[:, 0]), gradient, exact


@dataclass(frozen=True)
class _Point:
    """Configurations and multipliers: of the failures, of the pose, of the limits (above 0 at an upper one)."""

    q: Array
    failures: Array
    pose: Array
    force: Array

    def where(self, chosen: NDArray[np.bool_], other: _Point) -> _Point:
        """The other's rows where chosen."""
        c = chosen[:, None]
        return _Point(
            np.where(c, other.q, self.q),
            np.where(c, other.failures, self.failures),
            np.where(c, other.pose, self.pose),
            np.where(c, other.force, self.force),
        )


class _Problem:
    """The conditions of optima, R of them side by side."""

    def __init__(self, evaluator: Evaluator, p: Array, r: Array, x: Array, low: Array, high: Array) -> None:
        self._family, self._p, self._r, self._x, self._low, self._high = evaluator.family, p, r, x, low, high
        self._n, self._m = evaluator.family.arm.n, evaluator.family.task.m

    def _conditions(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Scores (R, F), slopes (R, F, n), pose error (R, m) and its Jacobian (R, m, n)."""
        scores, slopes, error, jacobian = self._family.conditions(q, self._p, self._r, self._x)
        return scores, slopes.reshape(len(q), -1, self._n), error.reshape(len(q), -1), jacobian.reshape(len(q), -1, self._n)

    def value(self, point: _Point) -> Array:
        """(R,) the index."""
        return np.asarray(self.by_design(point)[:, 0])

    def by_design(self, point: _Point) -> Array:
        """(R, 2 + k) index, its slope by the score, derivative of the Lagrangian by the design without the limits."""
        family = self._family
        return np.asarray(family.by_design.rows(point.q, self._p, self._r, self._x, point.failures, point.pose))

    def guess(self, q: Array) -> _Point:
        """Multipliers at configurations that are nearly the best, by a small quadratic program for each."""
        scores, slopes, _, jacobian = self._conditions(q)
        null = null_spaces(jacobian)
        failures, force = np.zeros_like(scores), np.zeros_like(q)
        for i in range(len(q)):
            if np.isfinite(slopes[i]).all() and np.isfinite(null[i]).all():
                failures[i], force[i] = nearby(
                    scores[i] - scores[i].min(), slopes[i] @ null[i], null[i], self._high[i] - q[i], q[i] - self._low[i]
                )
        return _Point(q, failures, self._pose_multipliers(slopes, jacobian, failures, force), force)

    @staticmethod
    def _pose_multipliers(slopes: Array, jacobian: Array, failures: Array, force: Array) -> Array:
        """Of the balance ``slopes' failures - J' mu - force = 0``, by least squares."""
        pull = np.einsum("rfi,rf->ri", slopes, failures) - force
        inverse = np.linalg.pinv(np.nan_to_num(jacobian))
        return np.asarray(np.einsum("rim,ri->rm", inverse, np.nan_to_num(pull)))

    def solved(self, start: _Point) -> tuple[_Point, NDArray[np.bool_]]:
        """Newton's method from nearby, with the active constraints sought on the way; and where it ended."""
        q, n = start.q.copy(), self._n
        failures, force = start.failures, start.force
        active = failures > 1e-3
        side = np.where(force > 0, 1, np.where(force < 0, -1, 0))
        f = failures.shape[1]
        exact = np.zeros(len(q), dtype=bool)
        pose = start.pose
        for _ in range(_NEWTON):
            scores, slopes, error, jacobian = (np.nan_to_num(a) for a in self._conditions(q))
            null = null_spaces(jacobian)
            r = null.shape[2]
            pull = np.einsum("rfi,rf->ri", slopes, failures)
            balance = np.einsum("ri,ric->rc", pull - force, null)
            target = np.where(side > 0, self._high, np.where(side < 0, self._low, q))
            off = np.where(side != 0, target - q, 0.0)
            level = np.where(active, scores, np.inf).min(axis=1)
            uneven = np.where(active, scores - level[:, None], 0.0)
            scale = 1.0 + np.abs(pull).max(axis=1)
            exact = (
                (np.abs(balance).max(axis=1) <= _SMALL * scale)
                & (np.abs(error).max(axis=1) <= _SMALL)
                & (np.abs(off).max(axis=1) <= _SMALL)
                & (uneven.max(axis=1) <= _SMALL)
                & (scores.min(axis=1) >= level - _SMALL)
                & (failures >= -_SMALL).all(axis=1)
                & ((force * side >= -_SMALL) | (side == 0)).all(axis=1)
                & ((q >= self._low - _SMALL) & (q <= self._high + _SMALL)).all(axis=1)
            )
            if exact.all():
                break
            curvature = self._curvature(q, null, failures, pose)
            back = -np.einsum("rim,rm->ri", np.linalg.pinv(jacobian), error)
            # Unknown: step along the null space, level, multipliers of failures and limits.
            a = np.zeros((len(q), r + 1 + f + n, r + 1 + f + n))
            b = np.zeros((len(q), r + 1 + f + n))
            a[:, :r, :r] = curvature - 1e-9 * np.eye(r)
            along = slopes @ null  # (R, F, r)
            a[:, :r, r + 1 : r + 1 + f] = along.swapaxes(1, 2)
            a[:, :r, r + 1 + f :] = -null.swapaxes(1, 2)
            on, still = active[:, :, None], (side != 0)[:, :, None]
            k = np.arange(f)
            a[:, r + 1 : r + 1 + f, :r] = np.where(on, along, 0.0)
            a[:, r + 1 : r + 1 + f, r] = np.where(active, -1.0, 0.0)
            a[:, r + 1 + k, r + 1 + k] = np.where(active, 1e-13, 1.0)
            b[:, r + 1 : r + 1 + f] = np.where(active, -scores - np.einsum("rfi,ri->rf", slopes, back), 0.0)
            k = np.arange(n)
            a[:, r + 1 + f :, :r] = np.where(still, null, 0.0)
            a[:, r + 1 + f + k, r + 1 + f + k] = np.where(side != 0, 1e-13, 1.0)
            b[:, r + 1 + f :] = np.where(side != 0, off - back, 0.0)
            a[:, r, r + 1 : r + 1 + f] = 1.0
            b[:, r] = 1.0
            step = np.linalg.solve(a, b[:, :, None])[:, :, 0]
            step = np.where(np.isfinite(step), step, 0.0)
            move = back + np.einsum("ric,rc->ri", null, step[:, :r])
            shrink = np.minimum(1.0, _TRUST / np.maximum(np.abs(move).max(axis=1), 1e-300))[:, None]
            move = move * shrink
            go = ~exact[:, None]
            failures = np.where(go, step[:, r + 1 : r + 1 + f], failures)
            force = np.where(go, step[:, r + 1 + f :], force)
            ahead = scores + np.einsum("rfi,ri->rf", slopes, move)
            level = np.where(active, ahead, np.inf).min(axis=1)
            # What is no longer active leaves the set, what would be crossed joins it.
            active = np.where(go, np.where(active, failures >= -1e-9, ahead < level[:, None] - 1e-9), active)
            failures = np.where(active, failures, 0.0)
            reach = q + move
            crossed = np.where(reach > self._high + 1e-12, 1, np.where(reach < self._low - 1e-12, -1, 0))
            side = np.where(go, np.where(side != 0, np.where(force * side >= -1e-9, side, 0), crossed), side)
            force = np.where(side != 0, force, 0.0)
            q = np.where(go, np.clip(reach, self._low, self._high), q)
            fresh = self._pose_multipliers(slopes, jacobian, failures, force)
            pose = np.where(go, fresh, pose)
        # The multipliers of the pose where the iteration ended.
        _, slopes, _, jacobian = (np.nan_to_num(a) for a in self._conditions(q))
        return _Point(q, failures, self._pose_multipliers(slopes, jacobian, failures, force), force), exact

    def _curvature(self, q: Array, null: Array, failures: Array, pose: Array) -> Array:
        """Second derivative (R, r, r) of the Lagrangian along the null space, by differences of its exact gradient."""
        columns = []
        for c in range(null.shape[2]):
            sides = []
            for h in (_APART, -_APART):
                _, slopes, _, jacobian = self._conditions(q + h * null[:, :, c])
                pull = np.einsum("rfi,rf->ri", slopes, failures)
                sides.append(pull - np.einsum("rmi,rm->ri", jacobian, pose))
            change = np.nan_to_num((sides[0] - sides[1]) / (2 * _APART))
            columns.append(np.einsum("ric,ri->rc", null, change))
        curvature = np.stack(columns, axis=2)
        return np.asarray((curvature + curvature.swapaxes(1, 2)) / 2)


def null_spaces(jacobian: Array) -> Array:
    """Orthonormal null-space bases (R, n, n - m) of Jacobians (R, m, n) of full rank."""
    m = jacobian.shape[1]
    return np.asarray(np.linalg.svd(np.nan_to_num(jacobian))[2][:, m:].swapaxes(1, 2))


def nearby(gap: Array, along: Array, null: Array, above: Array, below: Array) -> tuple[Array, Array]:
    """Multipliers of ``max t - |z|^2 / (2 c)`` subject to ``gap_k + along_k z >= t`` and ``-below <= null z <= above``.

    A least-distance program, solved as non-negative least squares.

    Args:
        gap: (F,) scores less the lowest one.
        along: (F, r) their slopes.
        null: (n, r) how the joints move.
        above: (n,) room to the upper limits.
        below: (n,) room to the lower limits.

    Returns:
        Multipliers of the scores (F,), which sum to 1, and of the limits (n,), above 0 at an upper one.

    Source: Lawson and Hanson 1974, chapter 23, problem LDP.
    """
    from scipy.optimize import nnls

    f, r = along.shape
    up, down = np.flatnonzero(above < 0.1), np.flatnonzero(below < 0.1)
    root, flat = np.sqrt(_CURVED), 0.1
    # In y = (z / root, flat (t - 1 / flat^2)) the objective is the length of y.
    g = np.concatenate(
        [
            np.concatenate([root * along, np.full((f, 1), -1 / flat)], axis=1),
            np.concatenate([-root * null[up], np.zeros((up.size, 1))], axis=1),
            np.concatenate([root * null[down], np.zeros((down.size, 1))], axis=1),
        ]
    )
    h = np.concatenate([1 / flat**2 - gap, -above[up], -below[down]])
    e = np.concatenate([g.T, h[None]])
    u, _ = nnls(e, np.r_[np.zeros(r + 1), 1.0])
    u = u / max(u[:f].sum(), 1e-300)
    force = np.zeros(len(null))
    force[up] += u[f : f + up.size]
    force[down] -= u[f + up.size :]
    return u[:f], force
