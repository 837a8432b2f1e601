"""Manipulability and relative manipulability after a failure, from the null space of J.

Both are invariant to ``J -> A J``: rho for every invertible A, the manipulability for det A = 1. A task of all six rows
therefore uses the Jacobian with the most zeros. The null-space form needs no determinant of a reduced Jacobian, so one
factorisation serves every failure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.registry import constructor
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.frameworks import RowFunction
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import (
    HouseholderQR,
    directional_derivatives,
    dot_product,
    factor_householder,
    gram_determinant,
    select_smallest,
)
from holdfast.kernels.program import SX
from holdfast.kinematics.index_bounds.manipulability_bounds import bound_of_index
from holdfast.kinematics.indices.index import Index, WorstCase
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, TaskSpec
from holdfast.model.failure_modes import FailureSpec

_ZERO_SCORE = 1e-12  # below this square a root is replaced by a straight line, whose slope is finite
_ZERO_RHO = 1e-12  # below this rho is 0 up to rounding, and its gradient is 0 by convention


class RelativeManipulability(Index):
    r"""Fraction of the manipulability that remains when joints S lock.

    :math:`\rho_S = \sqrt{\det({}^SJ\,{}^SJ^\top)/\det(JJ^\top)} = \sqrt{\det(N_S N_S^\top)}`, where :math:`{}^SJ` is the
    task Jacobian without the columns S and :math:`N_S` the rows S of an orthonormal null-space basis of J.

    The bound is the least proved one (:mod:`holdfast.kinematics.index_bounds`). For one failure at a time some Jacobian of any
    size attains it. For several failures ``best_known`` is attained by some Jacobian, and ``is_attained`` is true if it equals
    the bound. The arguments ``arm``, ``task``, ``failures`` and ``length``, m, are those of
    :class:`Index`.

    Source: Abdi, Maciejewski, Nahavandi 2012, eq. (3) and (4); null-space form by the matrix determinant lemma.
    """

    source = "Abdi et al. 2012, eq. (3), (4)"
    _formula_name = "relative manipulability"

    def __init__(
        self,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        failures: FailureSpec = "single",
        *,
        length: float | None = None,
    ) -> None:
        super().__init__(self._formula_name, arm, task, failures=failures, length=length)
        self._set_scale_and_bound()

    def _set_scale_and_bound(self) -> None:
        self.ceiling = bound_of_index(self)
        if self.ceiling is not None:
            self.bound, self.bound_note = self.ceiling.bound, self.ceiling.gap_phrase

    # ---- symbols -----------------------------------------------------------------------------------------------

    @cached_property
    def _symbols(self) -> tuple[SX, SX, HouseholderQR]:
        q = kinematics.joint_symbols(self.arm)
        j = kinematics.invariant_jacobian(self.arm, q) if self.task.invariant else self.task.jacobian(self.arm, q)
        return q, j, factor_householder(j)

    def _scale_of_ratio(self, qr: HouseholderQR) -> SX:
        """Return the factor that converts relative manipulability rho to this index."""
        return ca.SX(1)

    def _squared_ratios(self, qr: HouseholderQR) -> list[SX]:
        """Return rho^2 of every failure."""
        rows = qr.null_space_basis()
        return [gram_determinant([rows[joint] for joint in locked]) for locked in self.failures]

    def _is_regular(self, qr: HouseholderQR) -> SX:
        """Return True only if J is certainly not singular, and False also if the factorisation divided by zero.

        The product of the singular values bounds the smallest one from below, by the inequality of means:
        ``sigma_m >= |det| ((m - 1) / |J|^2)^((m - 1) / 2)``. The factor accounts for the change of frame and point.
        """
        length = max(self.task.length, 1 / self.task.length)
        reach = sum(float(np.linalg.norm(x.origin[:3, 3])) for x in self.arm.joints) + float(
            np.linalg.norm(self.arm.tool[:3, 3])
        )
        threshold = min(1e-11 * (1 + reach) ** 2 * length, 1e-6)
        return qr.gram_determinant() > threshold**2 * qr.squared_norm() ** self.task.m

    def _mark_singular(self, qr: HouseholderQR, outputs: list[SX], marked: bool) -> SX:
        """Return NaN in every output of a row that may be singular; such a row is evaluated again with singular values."""
        regular = self._is_regular(qr)
        return ca.vertcat(*[ca.if_else(regular, output, np.nan) if marked else output for output in outputs])

    def _build_values(self, marked: bool, worst_only: bool) -> Kernel:
        q, _, qr = self._symbols
        squares = self._squared_ratios(qr)
        if worst_only:
            squares = [select_smallest(squares)]
        scale = self._scale_of_ratio(qr)
        values = [scale * ca.sqrt(s) for s in squares]
        return Kernel(self.name, [q], [self._mark_singular(qr, values, marked)])

    def _build_gradient(self, marked: bool) -> Kernel:
        q, j, qr = self._symbols
        if all(len(s) == 1 for s in self.failures):
            cotangent = self._jacobian_derivative(qr)
            # Reverse differentiation of the kinematics by J alone, which is exact and needs fewer operations.
            seed = ca.SX.sym("seed", self.task.m, self.arm.n)
            pull_back = ca.Function("pull", [q, seed], [ca.jtimes(ca.vec(ca.densify(j)), q, ca.vec(seed), True)])
            g = pull_back(q, cotangent)
        else:
            smallest_square, scale = select_smallest(self._squared_ratios(qr)), self._scale_of_ratio(qr)
            rho = ca.sqrt(smallest_square)
            derivative = ca.if_else(rho > _ZERO_RHO, 0.5 / rho, 0.0)
            # Held apart, so that no root is differentiated at 0.
            s, b = ca.SX.sym("scale"), ca.SX.sym("best")
            outer = ca.jtimes(ca.vertcat(scale, smallest_square), q, ca.vertcat(b, s), True)
            g = ca.substitute(ca.vertcat(outer), ca.vertcat(s, b), ca.vertcat(scale * derivative, rho))
        return Kernel(f"{self.name} gradient", [q], [self._mark_singular(qr, ca.vertsplit(ca.densify(g)), marked)])

    def _jacobian_derivative(self, qr: HouseholderQR) -> SX:
        r"""Return the derivative of the worst case by J, (m, n).

        With ``P = N N'``, ``dP = -J^+ dJ P - (J^+ dJ P)'``, so ``d rho_k / dJ = -a_k (P e_k)' / rho_k`` with
        ``a_k = (J J')^-1 j_k = R^-1 (Q' e_k)_{1..m}``. The worst k enters as a unit vector.
        """
        rows = qr.null_space_basis()
        squares = [dot_product(r, r) for r in rows]
        smallest_square, unit = ca.SX(np.inf), [ca.SX(0)] * self.arm.n
        for locked in self.failures:
            k = locked[0]
            is_smaller = squares[k] < smallest_square
            smallest_square = ca.if_else(is_smaller, squares[k], smallest_square)
            unit = [ca.if_else(is_smaller, float(i == k), u) for i, u in enumerate(unit)]
        rotated = qr.apply_q_transposed(unit)
        a = qr.apply_pinv_transposed(rotated)
        p = [dot_product(r, rotated[self.task.m :]) for r in rows]
        rho = ca.sqrt(smallest_square)
        return self._combine_derivative(qr, rho, a, p)

    def _combine_derivative(self, qr: HouseholderQR, rho: SX, a: list[SX], p: list[SX]) -> SX:
        derivative = ca.if_else(rho > _ZERO_RHO, 1 / rho, 0.0)
        return -ca.vertcat(*a) @ (ca.horzcat(*p) * derivative)

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return ``rho^2`` per failure and its derivatives; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Index.scores`."""
        if any(len(s) != 1 for s in self.failures):
            values = self._squared_ratios(qr)
            return values, directional_derivatives(values, q, directions)
        values, slopes_by_joint, _ = self._squares_and_derivatives(q, j, qr, directions)
        return values, slopes_by_joint

    def value_of_score(self, score: SX) -> SX:
        """Return the root of ``score``, a square, with a finite slope at 0; see :meth:`Index.value_of_score`."""
        smallest = _ZERO_SCORE
        return ca.if_else(score > smallest, ca.sqrt(ca.if_else(score > smallest, score, 1.0)), score / smallest**0.5)

    def _squares_and_derivatives(
        self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]
    ) -> tuple[list[SX], list[list[SX]], list[SX]]:
        """Return ``rho_k^2``, ``d rho_k^2 = -2 a_k' dJ P e_k`` and ``tr(J^+ dJ)`` along each direction."""
        n, m = self.arm.n, self.task.m
        rows = qr.null_space_basis()
        projector = [[dot_product(rows[max(i, k)], rows[min(i, k)]) for k in range(n)] for i in range(n)]
        a = [qr.apply_pinv_transposed(qr.apply_q_transposed([ca.SX(float(i == k)) for i in range(n)])) for k in range(n)]
        failed = [locked[0] for locked in self.failures]
        derivatives: list[list[SX]] = [[] for _ in failed]
        traces = []
        dense = ca.vec(ca.densify(j))
        for v in directions:
            change = ca.reshape(ca.jtimes(dense, q, v), m, n)
            for slot, k in enumerate(failed):
                column = [dot_product([change[i, c] for c in range(n)], projector[k]) for i in range(m)]
                derivatives[slot].append(-2 * dot_product(a[k], column))
            traces.append(ca.trace(ca.horzcat(*[ca.vertcat(*x) for x in a]).T @ change))
        return [projector[k][k] for k in failed], derivatives, traces

    # ---- kernels -----------------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _worst_kernel(self) -> Kernel:
        return self._build_values(marked=True, worst_only=True)

    @cached_property
    @cached_kernel
    def _worst_failure_kernel(self) -> Kernel:
        """Kernel of the worst value and its failure, the first one with exactly this value."""
        q, _, qr = self._symbols
        scale = self._scale_of_ratio(qr)
        smallest_square, worst = ca.SX(np.inf), ca.SX(0)
        for k, square in enumerate(self._squared_ratios(qr)):
            value = scale * ca.sqrt(square)
            is_smaller = value < smallest_square
            smallest_square, worst = ca.if_else(is_smaller, value, smallest_square), ca.if_else(is_smaller, float(k), worst)
        return Kernel(f"worst {self.name}", [q], [self._mark_singular(qr, [smallest_square, worst], marked=True)])

    @cached_property
    @cached_kernel
    def _values_kernel(self) -> Kernel:
        return self._build_values(marked=True, worst_only=False)

    @cached_property
    @cached_kernel
    def _unmarked_values_kernel(self) -> Kernel:
        return self._build_values(marked=False, worst_only=False)

    @cached_property
    @cached_kernel
    def _gradient_kernel(self) -> Kernel:
        return self._build_gradient(marked=True)

    @cached_property
    @cached_kernel
    def _unmarked_gradient_kernel(self) -> Kernel:
        return self._build_gradient(marked=False)

    def row_function(self) -> RowFunction:
        """Return the batch function; see :meth:`holdfast.kernels.frameworks.Differentiable.row_function`."""
        return replace(super().row_function(), kernels=(self._worst_kernel, self._gradient_kernel), marked=True)

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the worst case, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m; 0 at a singular configuration."""
        rows, single = self._read_configurations(q)
        values, marked = self._worst_kernel.marked_rows(rows)
        value = values[:, 0]
        if marked:
            marked_rows = np.flatnonzero(np.isnan(value))
            value[marked_rows] = super().evaluate(rows[marked_rows]).value
        return value[0] if single else value

    def worst_case(self, q: ArrayLike) -> WorstCase:
        """Return value, worst failure and status at ``q`` (N, n) or (n,), as :meth:`Index.worst_case` does, from one kernel."""
        rows, single = self._read_configurations(q)
        outputs, marked = self._worst_failure_kernel.marked_rows(rows)
        value, status = np.ascontiguousarray(outputs[:, 0]), np.full(len(rows), Status.OK, dtype=np.uint8)
        if marked:
            marked_rows = np.flatnonzero(np.isnan(value))
            closely = self.evaluate(rows[marked_rows])
            value[marked_rows], status[marked_rows], outputs[marked_rows, 1] = closely.value, closely.status, closely.worst
        worst = outputs[:, 1].astype(np.int64)
        return WorstCase(value[0], worst[0], status[0]) if single else WorstCase(value, worst, status)

    def _evaluate_by_failure(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        values, marked = self._values_kernel.marked_rows(q)
        marked_rows, singular = self._find_singular_rows(q, values, marked)
        if marked_rows.size:
            values[marked_rows] = self._unmarked_values_kernel.rows(q[marked_rows])
            values[singular] = 0.0
        return values, singular

    def _evaluate_gradient(self, q: FloatArray) -> FloatArray:
        gradient, marked = self._gradient_kernel.marked_rows(q)
        marked_rows, singular = self._find_singular_rows(q, gradient, marked)
        if marked_rows.size:
            gradient[marked_rows] = self._unmarked_gradient_kernel.rows(q[marked_rows])
            gradient[singular] = 0.0
        return gradient

    def _find_singular_rows(self, q: FloatArray, outputs: FloatArray, marked: bool) -> tuple[IndexArray, BoolArray]:
        """Return the rows that a kernel marked with NaN although q is finite, and which rows are singular."""
        singular = np.zeros(len(q), dtype=bool)
        marked_rows = np.zeros(0, dtype=np.int64)
        if marked:
            marked_rows = np.flatnonzero(np.isnan(outputs[:, 0]) & np.isfinite(q).all(axis=1))
            singular[marked_rows] = self._is_singular(q[marked_rows])
        return marked_rows, singular


class Manipulability(RelativeManipulability):
    r"""Manipulability :math:`{}^Sr = \sqrt{\det({}^SJ\,{}^SJ^\top)}` after joints S lock; its unit is that of det of the rows.

    Source: Abdi, Maciejewski, Nahavandi 2012, eq. (1) and (2).
    """

    source = "Abdi et al. 2012, eq. (1), (2)"
    _formula_name = "manipulability"

    def _set_scale_and_bound(self) -> None:
        # The invariant Jacobian is not divided by the characteristic length, so the factor is applied here.
        self._rows_scale = self.task.length**-3 if self.task.invariant else 1.0
        linear = int(np.linalg.matrix_rank(self.task.rows[:, :3]))
        # For an arm of revolute joints each linear row contributes one length.
        self.unit = "1" if linear == 0 or self.task.length != 1.0 else ("m" if linear == 1 else f"m^{linear}")

    def _scale_of_ratio(self, qr: HouseholderQR) -> SX:
        return qr.singular_value_product() * self._rows_scale

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return ``kr^2`` per failure and its derivatives; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Index.scores`."""
        if any(len(locked) != 1 for locked in self.failures):
            volume = self._scale_of_ratio(qr) ** 2
            values = [volume * x for x in self._squared_ratios(qr)]
            return values, directional_derivatives(values, q, directions)
        squares, derivatives, traces = self._squares_and_derivatives(q, j, qr, directions)
        volume = qr.gram_determinant() * self._rows_scale**2  # D^2, with d(D^2) = 2 D^2 tr(J^+ dJ)
        values = [volume * x for x in squares]
        return values, [
            [volume * (locked + 2 * x * t) for locked, t in zip(row, traces, strict=True)]
            for x, row in zip(squares, derivatives, strict=True)
        ]

    def _combine_derivative(self, qr: HouseholderQR, rho: SX, a: list[SX], p: list[SX]) -> SX:
        # kr = rho D with dD/dJ = D (J^+)'
        units = [[ca.SX(float(i == k)) for i in range(self.arm.n)] for k in range(self.arm.n)]
        columns = [qr.apply_pinv_transposed(qr.apply_q_transposed(e)) for e in units]
        pinv_transposed = ca.horzcat(*[ca.vertcat(*c) for c in columns])
        return self._scale_of_ratio(qr) * (super()._combine_derivative(qr, rho, a, p) + rho * pinv_transposed)


@constructor(
    formula="ρ<sub>S</sub> = √( det(<sup>S</sup>J <sup>S</sup>Jᵀ) / det(J Jᵀ) )", properties=("Abdi 2012", "base-free")
)
def relative_manipulability(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> RelativeManipulability:
    """Worst-case relative manipulability, 0 to 1; Abdi et al. 2012, eq. (3), (4).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return RelativeManipulability(arm, task, failures, length=length)


@constructor(formula="<sup>S</sup>r = √det(<sup>S</sup>J <sup>S</sup>Jᵀ)", properties=("Abdi 2012", "base-free"))
def manipulability(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", *, length: float | None = None
) -> Manipulability:
    """Worst-case manipulability of the reduced Jacobian; Abdi et al. 2012, eq. (1), (2).

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`holdfast.kinematics.indices.Index`.
    """
    return Manipulability(arm, task, failures, length=length)
