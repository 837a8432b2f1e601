"""Indices of the singular values of the reduced Jacobian: means, smallest value, and condition number.

Singular values come from one-sided Jacobi sweeps on the rows (with relative accuracy also for the small ones); one sweep is
one kernel, and converged rows leave the batch.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.registry import constructor
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import HouseholderQR, dot_product, jacobi_sweep
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kinematics.indices import secular_equation as secular
from holdfast.kinematics.indices.determinants import Manipulability
from holdfast.kinematics.indices.index import SINGULAR_RATIO, Index
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, TaskSpec
from holdfast.model.failure_modes import FailureSpec

Formula = Literal["mean", "geometric mean", "minimum", "condition number"]

_MAX_SWEEPS = 30
_CONVERGENCE_TOLERANCE = 1e-14
_SCORE_SWEEPS = 5  # sweeps in one straight-line program, for the scores
_ROOT_OFFSET = 1e-100  # added to a squared manipulability, so that its root has a finite slope
_ZERO_SCORE = 1e-12
_BLOCK_ROWS = 1024  # with every failure a few thousand small matrices, which stay in the cache

_SOURCE_EQUATIONS = {
    "mean": ("mean singular value", "Abdi et al. 2012, eq. (7)"),
    "geometric mean": ("geometric mean singular value", "Abdi et al. 2012, eq. (8)"),
    "minimum": ("minimum singular value", "Abdi et al. 2012, eq. (9)"),
    "condition number": ("condition number", "Abdi et al. 2012, eq. (10)"),
}

_SCORE_FUNCTIONS = {
    "mean": secular.mean_singular_value,
    "minimum": secular.smallest_singular_value,
    "condition number": secular.inverse_condition,
}


class JacobiRotator:
    """Singular values of batches of small wide matrices (N, m, c) by Jacobi rotations."""

    def __init__(self, m: int, c: int) -> None:
        self.m, self.c = m, c

    @cached_property
    @cached_kernel
    def _sweep_loop(self) -> Loop:
        a = ca.SX.sym("a", self.m * self.c)
        rows, off_diagonal = jacobi_sweep([[a[i * self.c + k] for k in range(self.c)] for i in range(self.m)])
        return Loop("Jacobi sweep", a, [], next_state=ca.vertcat(*[x for row in rows for x in row]), residual=off_diagonal)

    def orthogonalise_rows(self, a: FloatArray) -> FloatArray:
        """Orthogonalise rows by rotations; their lengths are the singular values, their directions the right vectors."""
        flat = np.ascontiguousarray(a).reshape(len(a), self.m * self.c)
        turned = self._sweep_loop.run(flat, np.empty((len(a), 0)), _CONVERGENCE_TOLERANCE, _MAX_SWEEPS).state
        return turned.reshape(-1, self.m, self.c)


class SpectralIndex(Index):
    r"""Index of the singular values :math:`{}^S\sigma_1 \ge \dots \ge {}^S\sigma_m` of the reduced Jacobian.

    Linear rows are divided by the characteristic length of the task, on which all these indices depend. ``formula`` is one of
    the names below; ``arm``, ``task``, ``failures`` and ``length``, m, are the arguments of :class:`Index`.

    Source: Abdi, Maciejewski, Nahavandi 2012, eq. (7) to (10).
    """

    def __init__(
        self,
        formula: Formula,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        *,
        failures: FailureSpec = "single",
        length: float | None = None,
    ) -> None:
        name, source = _SOURCE_EQUATIONS[formula]
        super().__init__(name, arm, task, failures=failures, length=length)
        self.formula, self.source = formula, source
        self.better = "smaller" if formula == "condition number" else "larger"
        if formula != "condition number":
            linear = bool(np.abs(self.task.rows[:, :3]).max() > 0)
            if linear and self.task.length == 1.0:
                self.unit = "m/rad, rad/rad mixed" if self.task.angular else "m/rad"
        self._kept = np.array([[float(k not in s) for k in range(arm.n)] for s in self.failures])  # (F, n)

    @cached_property
    def _rotator(self) -> JacobiRotator:
        # A locked column set to zero leaves the singular values of the reduced Jacobian, so one width serves all failures.
        return JacobiRotator(self.task.m, self.arm.n)

    @cached_property
    @cached_kernel
    def _jacobian_pullback_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        j = self.task.jacobian(self.arm, q)
        seed = ca.SX.sym("seed", self.task.m, self.arm.n)
        return Kernel("pull back", [q, seed], [ca.jtimes(ca.vec(ca.densify(j)), q, ca.vec(seed), True)])

    # ---- formulas: value, and derivative by each singular value ------------------------------------------------------

    def _combine_singular_values(self, sigma: FloatArray) -> FloatArray:
        low, high = sigma.min(axis=-1), sigma.max(axis=-1)
        if self.formula == "mean":
            return np.asarray(sigma.mean(axis=-1))
        if self.formula == "geometric mean":
            return np.asarray(np.prod(sigma, axis=-1) ** (1 / self.task.m))
        if self.formula == "minimum":
            return np.asarray(low)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(low > SINGULAR_RATIO * high, high / low, np.inf)
        return np.where(np.isnan(low), np.nan, ratio)

    def _derivative_by_singular_value(self, sigma: FloatArray) -> FloatArray:
        if self.formula == "mean":
            return np.full_like(sigma, 1 / self.task.m)
        low, high = sigma.argmin(axis=-1), sigma.argmax(axis=-1)
        rows = np.arange(len(sigma))
        derivative = np.zeros_like(sigma)
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.formula == "geometric mean":
                derivative = self._combine_singular_values(sigma)[:, None] / (self.task.m * sigma)
            elif self.formula == "minimum":
                derivative[rows, low] = 1.0
            else:
                derivative[rows, high] = 1 / sigma[rows, low]
                derivative[rows, low] -= sigma[rows, high] / sigma[rows, low] ** 2
        return derivative

    # ---- symbols -----------------------------------------------------------------------------------------------------

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return a monotone function of the index per failure and its derivatives; ``q``, ``j`` as in :meth:`Index.scores`.

        The geometric mean comes from the manipulability, and the condition number is scored by its inverse. The other indices
        are not invariant to the frame, so they use the task Jacobian for any ``j``: one singular value decomposition of the
        healthy arm serves all failures. ``qr`` and ``directions`` are as in :meth:`Index.scores`.

        For joints that fail together the program would take too long to compile (44,000 operations for 7 single failures by
        plain Jacobi sweeps took 39 s), so values and gradients are computed outside and passed in.
        """
        if self.formula == "geometric mean":
            squares, derivatives = Manipulability(self.arm, self.task, self.failures).scores(q, j, qr, directions)
            # Not the squares, because they are about 1e-6 for a pose, which the ascent resolves poorly.
            geometric_means = [(square + _ROOT_OFFSET) ** (0.5 / self.task.m) for square in squares]
            factors = [
                g / (2 * self.task.m * (square + _ROOT_OFFSET)) for g, square in zip(geometric_means, squares, strict=True)
            ]
            return geometric_means, [[f * x for x in row] for f, row in zip(factors, derivatives, strict=True)]
        measured = self.measured
        if measured is not None:
            count, n = len(self.failures), self.arm.n
            gradients = [measured[count + n * i : count + n * (i + 1)] for i in range(count)]
            return [measured[i] for i in range(count)], [[ca.dot(g, v) for v in directions] for g in gradients]
        m, n = self.task.m, self.arm.n
        j = self.task.jacobian(self.arm, q)
        turned = [[j[i, k] for k in range(n)] for i in range(m)]
        for _ in range(_SCORE_SWEEPS):
            turned, _off = jacobi_sweep(turned)
        d = [dot_product(x, x) for x in turned]  # turned = U' J, with orthogonal rows
        vectors = (
            ca.vertcat(*[ca.horzcat(*x) / (square + np.finfo(float).tiny) for x, square in zip(turned, d, strict=True)]) @ j.T
        )
        changes = []  # derivatives of U' J, and of the Gram matrix U' J J' U
        for v in directions:
            change = vectors @ ca.reshape(ca.jtimes(ca.vec(ca.densify(j)), q, v), m, n)
            half_change = change @ ca.vertcat(*[ca.horzcat(*x) for x in turned]).T
            changes.append((change, half_change + half_change.T))
        values, derivatives = [], []
        for (k,) in self.failures:
            w = [x[k] for x in turned]
            value, by_gram = _SCORE_FUNCTIONS[self.formula](d, w)
            moved = [dot_product(row, w) for row in by_gram]
            values.append(value)
            derivatives.append(
                [
                    sum(dot_product(row, [gram[i, c] for c in range(m)]) for i, row in enumerate(by_gram))
                    - 2 * dot_product(moved, [change[i, k] for i in range(m)])
                    for change, gram in changes
                ]
            )
        return values, derivatives

    @cached_property
    def _measured_symbols(self) -> SX:
        return ca.SX.sym("measured", len(self.failures) * (1 + self.arm.n))

    @property
    def measured(self) -> SX | None:
        """Symbols of scores and gradients if joints fail together; see :attr:`Objective.measured`."""
        together = any(len(s) != 1 for s in self.failures) and self.formula != "geometric mean"
        return self._measured_symbols if together else None

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the scores of all failures, then their gradients, at ``q`` (N, n); see :meth:`Objective.measure`."""
        if self.measured is None:
            return super().measure(q)
        outputs = np.empty((len(q), len(self.failures) * (1 + self.arm.n)))
        for start in range(0, len(q), _BLOCK_ROWS):
            block = slice(start, start + _BLOCK_ROWS)
            outputs[block] = self._scores_and_gradients(q[block])
        return outputs

    def _scores_and_gradients(self, q: FloatArray) -> FloatArray:
        count, n = len(self.failures), self.arm.n
        reduced = (self.task_jacobian(q)[:, None] * self._kept[:, None, :]).reshape(-1, self.task.m, n)
        u, sigma, v = np.linalg.svd(reduced, full_matrices=False)
        score, derivative = self._combine_singular_values(sigma), self._derivative_by_singular_value(sigma)
        if self.formula == "condition number":
            with np.errstate(divide="ignore", invalid="ignore"):
                score, derivative = 1 / score, -derivative / score[:, None] ** 2
        seed = np.einsum("rmi,ri,ric->rmc", u, np.nan_to_num(derivative), v).reshape(len(q), count, self.task.m, n)
        gradients = self._jacobian_pullback_kernel.rows(
            np.repeat(q, count, axis=0), (seed * self._kept[:, None, :]).reshape(-1, self.task.m, n)
        )
        return np.concatenate([score.reshape(len(q), count), gradients.reshape(len(q), count * n)], axis=1)

    def value_of_score(self, score: SX) -> SX:
        """Return the ``score``, or its negative inverse for the condition number; see :meth:`Index.value_of_score`."""
        if self.formula != "condition number":
            return score
        positive = score > _ZERO_SCORE  # below, the inverse is replaced by a straight line, whose slope is finite
        positive_score = ca.if_else(positive, score, _ZERO_SCORE)
        return -1 / positive_score + ca.if_else(positive, 0, score - _ZERO_SCORE) / _ZERO_SCORE**2

    # ---- batches -----------------------------------------------------------------------------------------------------

    def _evaluate_by_failure(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        values = np.empty((len(q), len(self.failures)))
        singular = np.zeros(len(q), dtype=bool)
        for start in range(0, len(q), _BLOCK_ROWS):
            block = slice(start, start + _BLOCK_ROWS)
            j = self.task_jacobian(q[block])
            healthy_sigma = np.linalg.norm(self._rotator.orthogonalise_rows(j), axis=-1)
            singular[block] = healthy_sigma.min(axis=-1) <= SINGULAR_RATIO * healthy_sigma.max(axis=-1)
            reduced = (j[:, None] * self._kept[:, None, :]).reshape(-1, self.task.m, self.arm.n)
            sigma = np.linalg.norm(self._rotator.orthogonalise_rows(reduced), axis=-1)
            values[block] = self._combine_singular_values(sigma).reshape(len(j), -1)
        values[singular] = self.singular_value_by_convention
        return values, singular

    def _evaluate_gradient(self, q: FloatArray) -> FloatArray:
        gradient = np.empty_like(q)
        for start in range(0, len(q), _BLOCK_ROWS):
            block = slice(start, start + _BLOCK_ROWS)
            gradient[block] = self._worst_case_gradients(q[block])
        return gradient

    def _worst_case_gradients(self, q: FloatArray) -> FloatArray:
        values, singular = self._evaluate_by_failure(q)
        worst = values.argmin(axis=1) if self.better == "larger" else values.argmax(axis=1)
        free_columns = self._kept[worst][:, None, :]
        reduced = self.task_jacobian(q) * free_columns
        turned = self._rotator.orthogonalise_rows(reduced)  # rows sigma_i v_i'
        sigma = np.linalg.norm(turned, axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            v = turned / sigma[:, :, None]
            u = np.einsum("rmc,ric->rmi", reduced, v) / sigma[:, None, :]
            # d sigma_i = u_i' dJ v_i.
            seed = np.einsum("rmi,ri,ric->rmc", u, self._derivative_by_singular_value(sigma), v) * free_columns
        has_no_gradient = singular | (sigma.min(axis=1) <= SINGULAR_RATIO * sigma.max(axis=1))
        seed[has_no_gradient & np.isfinite(q).all(axis=1)] = 0.0
        return self._jacobian_pullback_kernel.rows(q, seed)


@constructor(formula="(<sup>S</sup>σ<sub>1</sub> + … + <sup>S</sup>σ<sub>m</sub>) / m", properties=("Abdi 2012", "base-free"))
def mean_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> SpectralIndex:
    """Worst-case arithmetic mean of the singular values; Abdi et al. 2012, eq. (7).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return SpectralIndex("mean", arm, task, failures=failures, length=length)


@constructor(
    formula="(<sup>S</sup>σ<sub>1</sub> · … · <sup>S</sup>σ<sub>m</sub>)<sup>1/m</sup>", properties=("Abdi 2012", "base-free")
)
def geometric_mean_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> SpectralIndex:
    """Worst-case geometric mean of the singular values; Abdi et al. 2012, eq. (8).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return SpectralIndex("geometric mean", arm, task, failures=failures, length=length)


@constructor(formula="<sup>S</sup>σ<sub>m</sub>", properties=("Abdi 2012", "base-free"))
def minimum_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> SpectralIndex:
    """Worst-case smallest singular value; Abdi et al. 2012, eq. (9).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return SpectralIndex("minimum", arm, task, failures=failures, length=length)


@constructor(formula="<sup>S</sup>σ<sub>1</sub> / <sup>S</sup>σ<sub>m</sub>", properties=("Abdi 2012", "base-free"))
def condition_number(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> SpectralIndex:
    """Worst-case condition number, smaller is better; Abdi et al. 2012, eq. (10).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return SpectralIndex("condition number", arm, task, failures=failures, length=length)
