r"""Exact gradient of the index of a design at a pose, at the best configuration, from its Lagrange multipliers.

With scores s of the failures, the pose error c and the limits, the best configuration solves ``max t`` subject to
``s_k(q, x) >= t``, ``c(q, x) = 0`` and ``lower(x) <= q <= upper(x)``. At a strict optimum the derivative of the value by the
design is that of the Lagrangian with constant q and multipliers (envelope theorem):

.. math:: \mathrm{d}t/\mathrm{d}x = \partial_x(\lambda^\top s - \mu^\top c) + \sigma^\top \partial_x(\text{active limits}).

So no derivative of the best configuration is needed, but the multipliers must be exact. They come from a quadratic program at
the final configuration of the search, and then from Newton's method on the optimality conditions. This also improves the
configuration from the accuracy of the search, about 1e-4 rad, to rounding error.

Source: Fiacco 1983, section 3.4, for the derivative; Lawson and Hanson 1974, chapter 23, for the quadratic program.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.studies.designs.evaluation import Evaluated, Evaluator

_DESIGN_NEWTON_STEPS = 10
_DIFFERENCE_STEP = 1e-5  # rad or m: for second derivatives, which affect only the speed of Newton's method, not its result
_MAX_DESIGN_JOINT_STEP = 0.1  # rad or m: largest change of a joint in one step
_PROGRAM_CURVATURE = 1e-2  # step size at which the curvature of the quadratic program equals the slope of the score
_CONDITION_TOLERANCE = 1e-8  # smaller residuals of the conditions count as 0


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """Values and gradients of R pairs of a design and a pose.

    Attributes:
        q: (R, n) best configuration, more accurate than the given one, rad and m.
        value: (R,) index at this configuration; minus the pose error for a pose that is not reached.
        gradient: (R, k) gradient of the value by the design, per rad or m.
        exact: (R,) True if the optimality conditions hold to 1e-8, so that the gradient is that of the value; otherwise it is
            computed at the given configuration.
    """

    q: FloatArray
    value: FloatArray
    gradient: FloatArray
    exact: BoolArray


def sensitivity(evaluator: Evaluator, found: Evaluated, chosen: IndexArray) -> Sensitivity:
    """Return values and gradients of some rows of an evaluation.

    Args:
        evaluator: Evaluator of the designs.
        found: Evaluation of D designs at P poses.
        chosen: (R,) rows, each of which is design times P plus pose.
    """
    row_count, parameter_count = len(chosen), len(evaluator.family.space.parameters)
    q = found.q.reshape(-1, evaluator.family.arm.n)[chosen].copy()
    reached = found.reached.reshape(-1)[chosen]
    value, gradient, exact = np.zeros(row_count), np.zeros((row_count, parameter_count)), np.zeros(row_count, dtype=bool)
    for rows, solve in (
        (np.flatnonzero(reached), _differentiate_reached_poses),
        (np.flatnonzero(~reached), _differentiate_missed_poses),
    ):
        if rows.size:
            q[rows], value[rows], gradient[rows], exact[rows] = solve(evaluator, found.values, chosen[rows], q[rows])
    return Sensitivity(q=q, value=value, gradient=gradient, exact=exact)


def _compute_limit_gradient(evaluator: Evaluator, force: FloatArray) -> FloatArray:
    """Return the contribution of varied limits to a gradient, from the ``force`` (R, n) of joints at their limits."""
    contribution = np.zeros((len(force), len(evaluator.family.space.parameters)))
    for index, parameter in enumerate(evaluator.family.space.parameters):
        if parameter.row is not None and parameter.kind in ("lower", "upper"):
            joint_force = force[:, parameter.row]
            contribution[:, index] = (
                np.where(joint_force > 0, joint_force, 0.0)
                if parameter.kind == "upper"
                else np.where(joint_force < 0, joint_force, 0.0)
            )
    return contribution


def _differentiate_missed_poses(
    evaluator: Evaluator, values: FloatArray, owner: IndexArray, q: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray]:
    """Return minus the pose error and its gradient, at the nearest configuration, by Newton's method within the limits."""
    family = evaluator.family
    position, rotation, design_values = evaluator.rows(owner, values)
    lower, upper = (limit[owner // len(evaluator.poses)] for limit in family.limits(values))
    m, n = family.task.m, family.arm.n

    def evaluate_pull(q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the error (R, m), its force on the joints (R, n), and the derivative of half its square by the design."""
        outputs = np.nan_to_num(family.misses.rows(q, position, rotation, design_values))
        return outputs[:, :m], outputs[:, m : m + n], outputs[:, m + n :]

    error, pull, by_design = evaluate_pull(q)
    trust = np.full(len(q), _MAX_DESIGN_JOINT_STEP)
    for _ in range(_DESIGN_NEWTON_STEPS):
        is_blocked = ((q <= lower) & (pull < 0)) | ((q >= upper) & (pull > 0))
        curvature = np.stack(
            [
                (evaluate_pull(q + offset)[1] - evaluate_pull(q - offset)[1]) / (2 * _DIFFERENCE_STEP)
                for offset in _DIFFERENCE_STEP * np.eye(n)
            ],
            axis=2,
        )
        curvature = (curvature + curvature.swapaxes(1, 2)) / 2
        curvature = np.where(is_blocked[:, :, None] | is_blocked[:, None, :], -np.eye(n), curvature)
        curvatures, axes = np.linalg.eigh(curvature)
        # Away from the optimum the error may have negative curvature; the step then follows the slope.
        axis_steps = np.einsum("rij,ri->rj", axes, np.where(is_blocked, 0.0, pull)) / np.maximum(np.abs(curvatures), 1e-4)
        move = np.einsum("rij,rj->ri", axes, axis_steps)
        move *= np.minimum(1.0, trust / np.maximum(np.abs(move).max(axis=1), 1e-300))[:, None]
        trial_q = np.clip(q + move, lower, upper)
        trial_error, trial_pull, trial_by_design = evaluate_pull(trial_q)
        better = (np.linalg.norm(trial_error, axis=1) <= np.linalg.norm(error, axis=1) + 1e-12)[:, None]
        q, error, pull = np.where(better, trial_q, q), np.where(better, trial_error, error), np.where(better, trial_pull, pull)
        by_design = np.where(better, trial_by_design, by_design)
        trust = np.where(better[:, 0], trust, trust / 4)
    error_size = np.linalg.norm(error, axis=1)
    # A motion dq reduces the error by J dq, so a joint that is pulled against its limit follows the limit.
    is_blocked = ((q <= lower) & (pull < 0)) | ((q >= upper) & (pull > 0))
    gradient = (_compute_limit_gradient(evaluator, np.where(is_blocked, pull, 0.0)) - by_design) / np.maximum(
        error_size, 1e-12
    )[:, None]
    return (
        q,
        -error_size,
        gradient,
        np.abs(np.where(is_blocked, 0.0, pull)).max(axis=1)
        <= _CONDITION_TOLERANCE * np.maximum(error_size, _CONDITION_TOLERANCE),
    )


def _differentiate_reached_poses(
    evaluator: Evaluator, values: FloatArray, owner: IndexArray, q: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray]:
    family = evaluator.family
    position, rotation, design_values = evaluator.rows(owner, values)
    lower, upper = (limit[owner // len(evaluator.poses)] for limit in family.limits(values))
    problem = _OptimumConditions(evaluator, position, rotation, design_values, lower, upper)
    initial = problem.guess_multipliers(q)
    optimum, exact = problem.solve_newton(initial)
    initial_value = problem.evaluate_index(initial)
    optimum_value = problem.evaluate_index(optimum)
    exact &= (optimum_value >= initial_value - 1e-6) & ((optimum.q >= lower) & (optimum.q <= upper)).all(axis=1)
    exact &= evaluator.on_pose(values, owner, optimum.q)
    point = initial.replace_rows(exact, optimum)
    outputs = problem.evaluate_derivatives(point)
    value_rate = outputs[:, 1:2]
    gradient = value_rate * (outputs[:, 2:] + _compute_limit_gradient(evaluator, point.force))
    gradient = np.where(np.isfinite(gradient), gradient, 0.0)
    return point.q, np.nan_to_num(outputs[:, 0]), gradient, exact


@dataclass(frozen=True)
class _OptimumPoint:
    """Configurations with multipliers of the failures, of the pose, and of the limits (above 0 at an upper limit)."""

    q: FloatArray
    failures: FloatArray
    pose: FloatArray
    force: FloatArray

    def replace_rows(self, is_chosen: BoolArray, other: _OptimumPoint) -> _OptimumPoint:
        """Return the point with the rows of another point where ``is_chosen`` is true."""
        columns = is_chosen[:, None]
        return _OptimumPoint(
            np.where(columns, other.q, self.q),
            np.where(columns, other.failures, self.failures),
            np.where(columns, other.pose, self.pose),
            np.where(columns, other.force, self.force),
        )


class _OptimumConditions:
    """Optimality conditions of R rows, which are solved together."""

    def __init__(
        self,
        evaluator: Evaluator,
        position: FloatArray,
        rotation: FloatArray,
        design_values: FloatArray,
        lower: FloatArray,
        upper: FloatArray,
    ) -> None:
        self._family = evaluator.family
        self._position = position
        self._rotation = rotation
        self._design_values = design_values
        self._lower = lower
        self._upper = upper
        self._n, self._m = evaluator.family.arm.n, evaluator.family.task.m

    def _evaluate_conditions(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return scores (R, F), their gradients (R, F, n), the pose error (R, m), and its Jacobian (R, m, n)."""
        scores, gradients, error, jacobian = self._family.conditions(q, self._position, self._rotation, self._design_values)
        return scores, gradients.reshape(len(q), -1, self._n), error.reshape(len(q), -1), jacobian.reshape(len(q), -1, self._n)

    def evaluate_index(self, point: _OptimumPoint) -> FloatArray:
        """Return the index (R,)."""
        return np.asarray(self.evaluate_derivatives(point)[:, 0])

    def evaluate_derivatives(self, point: _OptimumPoint) -> FloatArray:
        """Return (R, 2 + k) index, its derivative by the score, and that of the Lagrangian by the design without limits."""
        family = self._family
        return np.asarray(
            family.by_design.rows(point.q, self._position, self._rotation, self._design_values, point.failures, point.pose)
        )

    def guess_multipliers(self, q: FloatArray) -> _OptimumPoint:
        """Return multipliers at nearly optimal configurations, by a small quadratic program for each."""
        scores, gradients, _, jacobian = self._evaluate_conditions(q)
        null_space = compute_null_spaces(jacobian)
        failures, force = np.zeros_like(scores), np.zeros_like(q)
        for row in range(len(q)):
            if np.isfinite(gradients[row]).all() and np.isfinite(null_space[row]).all():
                failures[row], force[row] = solve_multiplier_program(
                    scores[row] - scores[row].min(),
                    gradients[row] @ null_space[row],
                    null_space[row],
                    self._upper[row] - q[row],
                    q[row] - self._lower[row],
                )
        return _OptimumPoint(q, failures, self._solve_pose_multipliers(gradients, jacobian, failures, force), force)

    @staticmethod
    def _solve_pose_multipliers(
        gradients: FloatArray, jacobian: FloatArray, failures: FloatArray, force: FloatArray
    ) -> FloatArray:
        """Return the pose multipliers of the balance ``slopes' failures - J' mu - force = 0``, by least squares."""
        pull = np.einsum("rfi,rf->ri", gradients, failures) - force
        inverse = np.linalg.pinv(np.nan_to_num(jacobian))
        return np.asarray(np.einsum("rim,ri->rm", inverse, np.nan_to_num(pull)))

    def solve_newton(self, start: _OptimumPoint) -> tuple[_OptimumPoint, BoolArray]:
        """Solve the conditions by Newton's method with an active set, and return the end point and whether it is exact (R,)."""
        q, n = start.q.copy(), self._n
        failures, force = start.failures, start.force
        active = failures > 1e-3
        limit_side = np.where(force > 0, 1, np.where(force < 0, -1, 0))
        f = failures.shape[1]
        exact = np.zeros(len(q), dtype=bool)
        pose = start.pose
        for _ in range(_DESIGN_NEWTON_STEPS):
            scores, gradients, error, jacobian = (np.nan_to_num(a) for a in self._evaluate_conditions(q))
            null_space = compute_null_spaces(jacobian)
            r = null_space.shape[2]
            pull = np.einsum("rfi,rf->ri", gradients, failures)
            balance = np.einsum("ri,ric->rc", pull - force, null_space)
            target = np.where(limit_side > 0, self._upper, np.where(limit_side < 0, self._lower, q))
            limit_error = np.where(limit_side != 0, target - q, 0.0)
            least_score = np.where(active, scores, np.inf).min(axis=1)
            score_excess = np.where(active, scores - least_score[:, None], 0.0)
            scale = 1.0 + np.abs(pull).max(axis=1)
            exact = (
                (np.abs(balance).max(axis=1) <= _CONDITION_TOLERANCE * scale)
                & (np.abs(error).max(axis=1) <= _CONDITION_TOLERANCE)
                & (np.abs(limit_error).max(axis=1) <= _CONDITION_TOLERANCE)
                & (score_excess.max(axis=1) <= _CONDITION_TOLERANCE)
                & (scores.min(axis=1) >= least_score - _CONDITION_TOLERANCE)
                & (failures >= -_CONDITION_TOLERANCE).all(axis=1)
                & ((force * limit_side >= -_CONDITION_TOLERANCE) | (limit_side == 0)).all(axis=1)
                & ((q >= self._lower - _CONDITION_TOLERANCE) & (q <= self._upper + _CONDITION_TOLERANCE)).all(axis=1)
            )
            if exact.all():
                break
            curvature = self._compute_curvature(q, null_space, failures, pose)
            correction = -np.einsum("rim,rm->ri", np.linalg.pinv(jacobian), error)
            # The unknowns are the step along the null space, the level, and the multipliers of failures and limits.
            a = np.zeros((len(q), r + 1 + f + n, r + 1 + f + n))
            b = np.zeros((len(q), r + 1 + f + n))
            a[:, :r, :r] = curvature - 1e-9 * np.eye(r)
            reduced_gradients = gradients @ null_space  # (R, F, r)
            a[:, :r, r + 1 : r + 1 + f] = reduced_gradients.swapaxes(1, 2)
            a[:, :r, r + 1 + f :] = -null_space.swapaxes(1, 2)
            is_active, is_limited = active[:, :, None], (limit_side != 0)[:, :, None]
            indices = np.arange(f)
            a[:, r + 1 : r + 1 + f, :r] = np.where(is_active, reduced_gradients, 0.0)
            a[:, r + 1 : r + 1 + f, r] = np.where(active, -1.0, 0.0)
            a[:, r + 1 + indices, r + 1 + indices] = np.where(active, 1e-13, 1.0)
            b[:, r + 1 : r + 1 + f] = np.where(active, -scores - np.einsum("rfi,ri->rf", gradients, correction), 0.0)
            indices = np.arange(n)
            a[:, r + 1 + f :, :r] = np.where(is_limited, null_space, 0.0)
            a[:, r + 1 + f + indices, r + 1 + f + indices] = np.where(limit_side != 0, 1e-13, 1.0)
            b[:, r + 1 + f :] = np.where(limit_side != 0, limit_error - correction, 0.0)
            a[:, r, r + 1 : r + 1 + f] = 1.0
            b[:, r] = 1.0
            step = np.linalg.solve(a, b[:, :, None])[:, :, 0]
            step = np.where(np.isfinite(step), step, 0.0)
            move = correction + np.einsum("ric,rc->ri", null_space, step[:, :r])
            shrink = np.minimum(1.0, _MAX_DESIGN_JOINT_STEP / np.maximum(np.abs(move).max(axis=1), 1e-300))[:, None]
            move = move * shrink
            is_open = ~exact[:, None]
            failures = np.where(is_open, step[:, r + 1 : r + 1 + f], failures)
            force = np.where(is_open, step[:, r + 1 + f :], force)
            next_scores = scores + np.einsum("rfi,ri->rf", gradients, move)
            least_score = np.where(active, next_scores, np.inf).min(axis=1)
            # Inactive constraints leave the set, and constraints that would be violated join it.
            active = np.where(is_open, np.where(active, failures >= -1e-9, next_scores < least_score[:, None] - 1e-9), active)
            failures = np.where(active, failures, 0.0)
            next_q = q + move
            crossed_side = np.where(next_q > self._upper + 1e-12, 1, np.where(next_q < self._lower - 1e-12, -1, 0))
            limit_side = np.where(
                is_open,
                np.where(limit_side != 0, np.where(force * limit_side >= -1e-9, limit_side, 0), crossed_side),
                limit_side,
            )
            force = np.where(limit_side != 0, force, 0.0)
            q = np.where(is_open, np.clip(next_q, self._lower, self._upper), q)
            pose_multipliers = self._solve_pose_multipliers(gradients, jacobian, failures, force)
            pose = np.where(is_open, pose_multipliers, pose)
        # The multipliers of the pose where the iteration ended.
        _, gradients, _, jacobian = (np.nan_to_num(a) for a in self._evaluate_conditions(q))
        return _OptimumPoint(q, failures, self._solve_pose_multipliers(gradients, jacobian, failures, force), force), exact

    def _compute_curvature(self, q: FloatArray, null_space: FloatArray, failures: FloatArray, pose: FloatArray) -> FloatArray:
        """Return second derivatives (R, r, r) of the Lagrangian along the null space, by differences of its exact gradient."""
        columns = []
        for column in range(null_space.shape[2]):
            side_gradients = []
            for offset in (_DIFFERENCE_STEP, -_DIFFERENCE_STEP):
                _, gradients, _, jacobian = self._evaluate_conditions(q + offset * null_space[:, :, column])
                pull = np.einsum("rfi,rf->ri", gradients, failures)
                side_gradients.append(pull - np.einsum("rmi,rm->ri", jacobian, pose))
            change = np.nan_to_num((side_gradients[0] - side_gradients[1]) / (2 * _DIFFERENCE_STEP))
            columns.append(np.einsum("ric,ri->rc", null_space, change))
        curvature = np.stack(columns, axis=2)
        return np.asarray((curvature + curvature.swapaxes(1, 2)) / 2)


def compute_null_spaces(jacobian: FloatArray) -> FloatArray:
    """Return orthonormal null-space bases (R, n, n - m) of Jacobians (R, m, n) of full rank."""
    m = jacobian.shape[1]
    return np.asarray(np.linalg.svd(np.nan_to_num(jacobian))[2][:, m:].swapaxes(1, 2))


def solve_multiplier_program(
    gap: FloatArray, along: FloatArray, null_space: FloatArray, above: FloatArray, below: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the multipliers of ``max t - |z|^2 / (2 c)`` subject to ``gap_k + along_k z >= t`` and ``-below <= null_space z <=
    above``.

    This least-distance program is solved as non-negative least squares.

    Args:
        gap: (F,) scores minus the lowest score.
        along: (F, r) slopes of the scores.
        null_space: (n, r) motions of the joints.
        above: (n,) distance of the joints to the upper limits.
        below: (n,) distance of the joints to the lower limits.

    Returns:
        Multipliers of the scores (F,), which sum to 1, and of the limits (n,), above 0 at an upper limit.

    Source: Lawson and Hanson 1974, chapter 23, problem LDP.
    """
    from scipy.optimize import nnls

    f, r = along.shape
    near_upper, near_lower = np.flatnonzero(above < 0.1), np.flatnonzero(below < 0.1)
    step_scale, level_scale = np.sqrt(_PROGRAM_CURVATURE), 0.1
    # In y = (z / root, flat (t - 1 / flat^2)) the objective is the norm of y.
    g = np.concatenate(
        [
            np.concatenate([step_scale * along, np.full((f, 1), -1 / level_scale)], axis=1),
            np.concatenate([-step_scale * null_space[near_upper], np.zeros((near_upper.size, 1))], axis=1),
            np.concatenate([step_scale * null_space[near_lower], np.zeros((near_lower.size, 1))], axis=1),
        ]
    )
    h = np.concatenate([1 / level_scale**2 - gap, -above[near_upper], -below[near_lower]])
    e = np.concatenate([g.T, h[None]])
    u, _ = nnls(e, np.r_[np.zeros(r + 1), 1.0])
    u = u / max(u[:f].sum(), 1e-300)
    force = np.zeros(len(null_space))
    force[near_upper] += u[f : f + near_upper.size]
    force[near_lower] -= u[f + near_upper.size :]
    return u[:f], force
