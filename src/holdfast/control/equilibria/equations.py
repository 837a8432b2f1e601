"""Equations of a failed arm at rest away from its target, which stay smooth where the Jacobian loses rank.

A law of the form ``rates = A J' y``, ``y = (J A J' + d I)^-1 v`` (pseudoinverse, weighted, damped) leaves the healthy joints
at rest if some unit vector u satisfies ``(A J')_H u = 0`` and the error is along ``b = (J A J' + d I) u``. For one locked joint
and d = 0, this is the direction of the column of the joint. For any other law, u is a unit command without any healthy rate,
and the error must be along ``b = u``. In both cases the unknowns are q, u and a pair (c, s) of norm 1 with ``c error = s b``.
There are as many equations as unknowns, not counting the locked joints. Reaching the target (s = 0) alone does not satisfy the
equations, so solutions are found separately, and curves of stationary points pass smoothly through the target and through
points where b vanishes (c = 0). Lengths are in units of :attr:`holdfast.Arm.length_unit`.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (11), (12), (18) to (21); the form with u, c and s is ours.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import ColumnLayout, FailedArmSystem
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm.configurations import sampling_limits

EQUATION_TOLERANCE = 1e-11  # norm of the equations
_MAX_NEWTON_ROUNDS = 40  # rounds, and the same number again for starts whose residual is below _NEAR_RESIDUAL
_NEAR_RESIDUAL = 0.02
_INITIAL_DAMPING = 1e-2
_DAMPING_DECREASE = 0.2
_DAMPING_INCREASE = 5.0
_MAX_DAMPING = 1e6


class RestEquations:
    """Equations of erroneous rest of one law, for one locked joint or for several.

    Attributes:
        columns: Layout of the unknowns: joints ``q`` (n,), the unit vector ``u`` (m,), ``c`` and ``s``.
        size: Number of unknowns.
    """

    def __init__(self, law: Law, single: bool) -> None:
        self.law, self.system, self._locks_one = law, FailedArmSystem(law), single
        self.columns = ColumnLayout(q=law.arm.n, u=law.task.m, c=1, s=1)
        self._rows = ColumnLayout(rates=law.arm.n, norms=2, error=law.task.m)
        self.size = self.columns.size
        self._unknowns = ca.SX.sym("z", self.size)
        self.made_of = law, single

    @cached_property
    def _expressions(self) -> tuple[SX, SX, SX]:
        """Equations, remainder of ``A J' u`` on the locked joints, and Jacobian of the equations, as expressions."""
        law = self.law
        q, u, c, s = self.columns.split_symbol(self._unknowns).values()
        mask, quadratic_form = self.system.mask, law.quadratic()
        error, _ = self.system.scaled_error_and_jacobian(q)
        length_unit = law.arm.length_unit
        rates = ca.SX.sym("rates", law.arm.n)
        if quadratic_form is None:
            rest_rates, direction = rates / ca.sqrt(ca.sumsqr(rates)), u
        else:
            a, damping = ca.SX(ca.DM(quadratic_form[0])), quadratic_form[1]
            # The law has its own unit of length.
            scale = ca.sparsify(ca.SX(ca.DM(law.task.scale(length_unit / law.task.length))))
            jacobian = scale @ law.jacobian(q)
            rest_rates = a @ jacobian.T @ u
            # Where J loses rank, J A J' u vanishes, but the column of the joint does not.
            damped = jacobian @ rest_rates + damping * (scale @ scale @ u)
            direction = jacobian @ (1 - mask) if self._locks_one and not damping else damped
        # There are as many equations as unknowns, not counting the locked joints.
        equations = ca.vertcat(mask * rest_rates, ca.sumsqr(u) - 1, c * c + s * s - 1, c * error - s * direction)
        expressions = [equations, ca.sum1((1 - mask) * rest_rates), ca.jacobian(equations, self._unknowns)]
        if quadratic_form is None:
            # The law's own derivatives are more accurate than those of its code.
            commanded, rate_jacobian = law.with_slopes(
                q, ca.SX(ca.DM(np.linalg.inv(law.task.scale(length_unit)))) @ u, self._unknowns
            )
            expressions[2] += ca.jacobian(equations, rates) @ rate_jacobian
            expressions = ca.substitute(expressions, [rates], [commanded])
        return expressions[0], expressions[1], expressions[2]

    @cached_property
    @cached_kernel
    def _equation_kernel(self) -> Kernel:
        inputs, outputs = [self._unknowns, *self.system.parameters], [self._expressions[0], self._expressions[2]]
        return Kernel("rest", inputs, outputs)

    @cached_property
    @cached_kernel
    def _locked_rates_kernel(self) -> Kernel:
        return Kernel("pull of rest", [self._unknowns, *self.system.parameters], [self._expressions[1]])

    @cached_property
    @cached_kernel
    def _search_loop(self) -> Loop:
        """Levenberg-Marquardt loop, which accepts a step if it reduces the norm."""
        free, damping = ca.SX.sym("free", self.size), ca.SX.sym("damping")
        state = ca.vertcat(self._unknowns, damping)
        jacobian, equations = self._expressions[2] @ ca.diag(free), self._expressions[0]
        trial_point = self._unknowns + free * damped_least_norm(jacobian, -equations, damping)
        squared_norm = ca.sumsqr(equations)
        is_better = ca.sumsqr(ca.substitute(equations, self._unknowns, trial_point)) < squared_norm
        next_state = ca.if_else(
            is_better,
            ca.vertcat(trial_point, damping * _DAMPING_DECREASE + 1e-16),
            ca.vertcat(self._unknowns, damping * _DAMPING_INCREASE),
        )
        residual = ca.if_else(damping > _MAX_DAMPING, 0.0, ca.sqrt(squared_norm))
        parameters = [*self.system.parameters, free]
        return Loop("rest points", state, parameters, next_state=next_state, residual=residual)

    def evaluate_equations(self, z: FloatArray, pose: FloatArray, mask: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Evaluate the nontrivial equations (N, e) at unknowns (N, size), and their Jacobian (N, e, size)."""
        used_rows = np.flatnonzero(np.concatenate([mask, np.ones(2 + self.law.task.m)]))
        values, jacobian = self._equation_kernel(z, pose[:3, 3], pose[:3, :3], mask)
        return values[:, used_rows], jacobian[:, used_rows]

    def locked_rates_residual(self, z: FloatArray, pose: FloatArray, mask: FloatArray) -> FloatArray:
        """Return the remainder (N,) of ``A J' u`` on the locked joints, which is 0 where J loses rank."""
        return np.asarray(self._locked_rates_kernel(z, pose[:3, 3], pose[:3, :3], mask))

    def sample_starts(self, count: int, generator: np.random.Generator) -> FloatArray:
        """Sample random unknowns (count, size)."""
        n, m = self.law.arm.n, self.law.task.m
        lower, upper = sampling_limits(self.law.arm)
        is_revolute = ~self.law.arm.prismatic
        q = generator.uniform(np.where(is_revolute, -np.pi, lower), np.where(is_revolute, np.pi, upper), (count, n))
        u = generator.normal(size=(count, m))
        angle = generator.uniform(-np.pi / 2, np.pi / 2, count)
        return np.column_stack([q, u / np.linalg.norm(u, axis=1, keepdims=True), np.cos(angle), np.sin(angle)])

    def estimate_unknowns(self, q: FloatArray, pose: FloatArray, mask: FloatArray) -> FloatArray:
        """Return unknowns (N, size) near configurations (N, n) that are nearly at rest, with the u and s that fit best."""
        z = np.column_stack([q, np.eye(self.law.task.m)[np.zeros(len(q), dtype=int)], np.ones(len(q)), np.zeros(len(q))])
        parts, slices = self.columns.view_parts(z), self.columns.slices
        # The rates are linear in u, or nearly linear for a law of another form.
        _, jacobian = self._equation_kernel(z, pose[:3, 3], pose[:3, :3], mask)
        parts["u"][:] = np.linalg.svd(jacobian[:, np.flatnonzero(mask), slices["u"]])[2][:, -1]
        values, jacobian = self._equation_kernel(z, pose[:3, 3], pose[:3, :3], mask)
        rows = self._rows.slices["error"]
        error, direction = values[:, rows], -jacobian[:, rows, slices["s"]][:, :, 0]
        angle = np.arctan2(np.einsum("ij,ij->i", error, direction), np.einsum("ij,ij->i", direction, direction))
        parts["c"][:, 0], parts["s"][:, 0] = np.cos(angle), np.sin(angle)
        return z

    def search(self, z: FloatArray, pose: FloatArray, mask: FloatArray, free: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Search from starts (N, size) for unknowns that satisfy the equations; only the ``free`` ones (size,) change."""
        start_count = len(z)
        inputs = np.concatenate([pose[:3, 3], pose[:3, :3].ravel(), mask, free])
        parameters = np.broadcast_to(inputs, (start_count, inputs.size))
        result = self._search_loop.run(
            np.column_stack([z, np.full(start_count, _INITIAL_DAMPING)]), parameters, EQUATION_TOLERANCE, _MAX_NEWTON_ROUNDS
        )
        # Nine in ten starts that converge need at most 25 steps; most of those that need more than 40 never converge.
        solutions, unfinished = result.state, np.flatnonzero(~result.done & (result.residual < _NEAR_RESIDUAL))
        solutions[unfinished] = self._search_loop.run(
            solutions[unfinished], parameters[unfinished], EQUATION_TOLERANCE, _MAX_NEWTON_ROUNDS
        ).state
        solutions = solutions[:, : self.size]
        values, _ = self.evaluate_equations(solutions, pose, mask)
        return solutions, np.linalg.norm(values, axis=1) <= 10 * EQUATION_TOLERANCE
