"""Where a failed arm rests away from its target, as equations that stay smooth where the Jacobian loses rank.

A law of the form ``rates = A J' y``, ``y = (J A J' + d I)^-1 v`` (pseudoinverse, weighted, damped) leaves the healthy joints
at rest where some unit vector u has ``(A J')_H u = 0`` and the error is along ``b = (J A J' + d I) u``; for one locked joint
and d = 0 that is along the column of the joint. Any other law is asked for a unit direction u with no healthy rate, and the
error must be along ``b = u``. In both, the unknowns are q, u and a pair (c, s) of length 1 with ``c error = s b``, as many
equations as unknowns but for the locked joints. That the target is reached (s = 0) does not satisfy them by itself, so that
solutions are elsewhere, and stationary points run smoothly through the target, and through places where b vanishes (c = 0).
Lengths are in units of :attr:`holdfast.Arm.length_unit`.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (11), (12), (18) to (21); the form with u, c and s is ours.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm
from holdfast.simulation.system import System

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

TOLERANCE = 1e-11  # norm of the equations
_STEPS, _NEAR = 40, 0.02  # after as many, only what is as near as that goes on for as many again
_FIRST, _EASIER, _HARDER, _HOPELESS = 1e-2, 0.2, 5.0, 1e6


class RestEquations:
    """The equations of erroneous rest of one law, for one locked joint or for several.

    Attributes:
        size: Unknowns: n joints, the unit vector u (m,), c and s.
    """

    def __init__(self, law: Law, single: bool) -> None:
        self.law, self.system, self._locks_one = law, System(law), single
        self.size = law.arm.n + law.task.m + 2
        self._z = ca.SX.sym("z", self.size)
        self.made_of = law, single

    @cached_property
    def _expressions(self) -> tuple[SX, SX, SX]:
        """The equations, what is left of ``A J' u`` on the locked joints, and the Jacobian of the equations."""
        law, n, m = self.law, self.law.arm.n, self.law.task.m
        q, u, c, s = self._z[:n], self._z[n : n + m], self._z[n + m], self._z[n + m + 1]
        mask, form = self.system.mask, law.quadratic()
        error, _ = self.system.scaled_error(q)
        unit = law.arm.length_unit
        rates = ca.SX.sym("rates", n)
        if form is None:
            still, along = rates / ca.sqrt(ca.sumsqr(rates)), u
        else:
            a, damping = ca.SX(ca.DM(form[0])), form[1]
            scale = ca.sparsify(ca.SX(ca.DM(law.task.scale(unit / law.task.length))))  # from the law's own unit of length
            j = scale @ law.jacobian(q)
            still = a @ j.T @ u
            # The column itself does not vanish where J loses rank, as J A J' u does.
            along = j @ (1 - mask) if self._locks_one and not damping else j @ still + damping * (scale @ scale @ u)
        # As many equations as unknowns, but for the locked joints.
        equations = ca.vertcat(mask * still, ca.sumsqr(u) - 1, c * c + s * s - 1, c * error - s * along)
        out = [equations, ca.sum1((1 - mask) * still), ca.jacobian(equations, self._z)]
        if form is None:
            # A law knows the derivatives of its rates better than those of its code would tell.
            commanded, slopes = law.with_slopes(q, ca.SX(ca.DM(np.linalg.inv(law.task.scale(unit)))) @ u, self._z)
            out[2] += ca.jacobian(equations, rates) @ slopes
            out = ca.substitute(out, [rates], [commanded])
        return out[0], out[1], out[2]

    @cached_property
    @recalled
    def _kernel(self) -> Kernel:
        inputs, outputs = [self._z, *self.system.parameters], [self._expressions[0], self._expressions[2]]
        return Kernel("rest", inputs, outputs)

    @cached_property
    @recalled
    def _pulls(self) -> Kernel:
        return Kernel("pull of rest", [self._z, *self.system.parameters], [self._expressions[1]])

    @cached_property
    @recalled
    def _search(self) -> Loop:
        """Levenberg and Marquardt: a step is kept if it lowers the norm."""
        free, damping = ca.SX.sym("free", self.size), ca.SX.sym("damping")
        state = ca.vertcat(self._z, damping)
        slopes, equations = self._expressions[2] @ ca.diag(free), self._expressions[0]
        trial = self._z + free * damped_least_norm(slopes, -equations, damping)
        size = ca.sumsqr(equations)
        better = ca.sumsqr(ca.substitute(equations, self._z, trial)) < size
        after = ca.if_else(better, ca.vertcat(trial, damping * _EASIER + 1e-16), ca.vertcat(self._z, damping * _HARDER))
        residual = ca.if_else(damping > _HOPELESS, 0.0, ca.sqrt(size))
        parameters = [*self.system.parameters, free]
        return Loop("rest points", state, parameters, next_state=after, residual=residual)

    def values(self, z: Array, pose: Array, mask: Array) -> tuple[Array, Array]:
        """The equations that are not trivial (N, e) at unknowns (N, size), and their Jacobian (N, e, size)."""
        used = np.flatnonzero(np.concatenate([mask, np.ones(2 + self.law.task.m)]))
        values, slopes = self._kernel(z, pose[:3, 3], pose[:3, :3], mask)
        return values[:, used], slopes[:, used]

    def pulls(self, z: Array, pose: Array, mask: Array) -> Array:
        """(N,) what is left of ``A J' u`` on the locked joints: 0 where J loses rank."""
        return np.asarray(self._pulls(z, pose[:3, 3], pose[:3, :3], mask))

    def starts(self, count: int, generator: np.random.Generator) -> Array:
        """Random unknowns (count, size)."""
        n, m = self.law.arm.n, self.law.task.m
        low, high = finite_limits(self.law.arm)
        turning = ~self.law.arm.prismatic
        q = generator.uniform(np.where(turning, -np.pi, low), np.where(turning, np.pi, high), (count, n))
        u = generator.normal(size=(count, m))
        turn = generator.uniform(-np.pi / 2, np.pi / 2, count)
        return np.column_stack([q, u / np.linalg.norm(u, axis=1, keepdims=True), np.cos(turn), np.sin(turn)])

    def completed(self, q: Array, pose: Array, mask: Array) -> Array:
        """Unknowns (N, size) near configurations (N, n) that are nearly at rest: u and s that fit best."""
        n, m = self.law.arm.n, self.law.task.m
        z = np.column_stack([q, np.eye(m)[np.zeros(len(q), dtype=int)], np.ones(len(q)), np.zeros(len(q))])
        # The rates are linear in u, or, of a law that is asked for directions, nearly so.
        _, slopes = self._kernel(z, pose[:3, 3], pose[:3, :3], mask)
        z[:, n : n + m] = np.linalg.svd(slopes[:, np.flatnonzero(mask), n : n + m])[2][:, -1]
        values, slopes = self._kernel(z, pose[:3, 3], pose[:3, :3], mask)
        error, along = values[:, n + 2 :], -slopes[:, n + 2 :, -1]
        turn = np.arctan2(np.einsum("ij,ij->i", error, along), np.einsum("ij,ij->i", along, along))
        z[:, -2], z[:, -1] = np.cos(turn), np.sin(turn)
        return z

    def search(self, z: Array, pose: Array, mask: Array, free: Array) -> tuple[Array, Flags]:
        """Unknowns (N, size) where the equations hold, from starts; only those that are ``free`` (size,) change."""
        rows = len(z)
        row = np.concatenate([pose[:3, 3], pose[:3, :3].ravel(), mask, free])
        parameters = np.broadcast_to(row, (rows, row.size))
        found = self._search.run(np.column_stack([z, np.full(rows, _FIRST)]), parameters, TOLERANCE, _STEPS)
        # Of the starts that reach the target nine in ten need 25 steps; most of those that need more than 40 never do.
        out, near = found.state, np.flatnonzero(~found.done & (found.residual < _NEAR))
        out[near] = self._search.run(out[near], parameters[near], TOLERANCE, _STEPS).state
        out = out[:, : self.size]
        values, _ = self.values(out, pose, mask)
        return out, np.linalg.norm(values, axis=1) <= 10 * TOLERANCE
