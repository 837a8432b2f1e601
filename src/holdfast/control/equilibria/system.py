"""Equations of rest for one law, target, and set of locked joints."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.equations import RestEquations
from holdfast.control.equilibria.stability import REACHED_ERROR, linearisation
from holdfast.control.laws.law import Law
from holdfast.control.simulation.residual import solution_search
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.model.arm.model import Arm

MAX_HEALTHY_FRACTION = 1e-7  # fraction of all rates up to which healthy joints count as still
VANISHED_COSINE = 1e-5  # value of c below which b counts as vanished, per unit of error
IDLE_COLUMN_FRACTION = 1e-12  # fraction of the Jacobian; a joint with a smaller column does not move the task


class RestSystem:
    """Equations of rest and linearisation of a failed arm.

    Attributes:
        law: The control law.
        pose: (4, 4) tool pose of the target.
        locked_joints: Indices from 0 of the locked joints.
        idle: Indices from 0 of the joints that do not move the task; they are fixed at 0 and excluded.
        mask: (n,) 0 for locked joints, else 1.
        healthy: (n,) True for joints that are neither locked nor idle.
        active: Indices of the unknowns without idle joints; one more than there are equations if one joint is locked.
    """

    def __init__(self, law: Law, pose: FloatArray, joints: tuple[int, ...]) -> None:
        self.law, self.pose, self.locked_joints = law, pose, joints
        self.idle = tuple(joint for joint in idle_joints(law) if joint not in joints)
        self.mask = np.ones(law.arm.n)
        self.mask[list(joints)] = 0.0
        self.healthy: BoolArray = self.mask > 0
        self.healthy[list(self.idle)] = False
        self.equations = _compiled_equations(law, len(joints) == 1)
        self.linear = linearisation(law)
        self._free = np.ones(self.equations.size)
        self._free[list(self.idle)] = 0.0
        self.active = np.flatnonzero(self._free)
        unlocked = np.flatnonzero(self.mask)
        self._equation_rows = np.flatnonzero(~np.isin(np.r_[unlocked, np.full(law.task.m + 2, -1)], self.idle))

    def __reduce__(self) -> tuple[type[RestSystem], tuple[Law, FloatArray, tuple[int, ...]]]:  # to another process
        return RestSystem, (self.law, self.pose, self.locked_joints)

    def sample_starts(self, count: int, generator: np.random.Generator) -> FloatArray:
        """Sample random unknowns (count, size), with idle joints at 0."""
        z = self.equations.sample_starts(count, generator)
        z[:, list(self.idle)] = 0.0
        return z

    def find_resting_unknowns(self, count: int, generator: np.random.Generator) -> FloatArray:
        """Find unknowns (N, size) of erroneous rest for any value of the locked joints."""
        z, is_solved = self.equations.search(self.sample_starts(count, generator), self.pose, self.mask, self._free)
        z = z[is_solved]
        return z[self.is_stationary(z[:, : self.law.arm.n])]

    def find_stuck_configurations(self, z: FloatArray) -> FloatArray:
        """Find configurations (N, n) of erroneous rest from starts z, with the locked joints at their values."""
        free_unknowns = self._free.copy()
        free_unknowns[list(self.locked_joints)] = 0.0
        unknowns, is_solved = self.equations.search(z, self.pose, self.mask, free_unknowns)
        # Where b vanishes the equations hold with c = 0, but J has lost rank, so the law has no answer.
        parts = self.equations.columns.view_parts(unknowns[is_solved])
        q = parts["q"][np.abs(parts["c"][:, 0]) > VANISHED_COSINE]
        _, _, scaled_error = self.linear.rates(q, self.pose)
        return q[self.is_stationary(q) & (scaled_error > REACHED_ERROR)]

    def find_target_configurations(self, z: FloatArray) -> FloatArray:
        """Find configurations (N, n) that reach the target from starts z, with the locked joints at their values."""
        q, converged = solution_search(self.law).search(z[:, : self.law.arm.n], self.pose, self.mask)
        return q[converged]

    def can_reach(self, values: FloatArray, generator: np.random.Generator) -> BoolArray:
        """Return a mask of the values (N,) of the locked joint at which one random start reaches the target."""
        q = self.sample_starts(len(values), generator)[:, : self.law.arm.n]
        q[:, self.locked_joints[0]] = values
        return solution_search(self.law).search(q, self.pose, self.mask)[1]

    def is_stationary(self, q: FloatArray) -> BoolArray:
        """Return a mask of the configurations q (N, n) at which only locked joints are commanded."""
        rates, _, _ = self.linear.rates(q, self.pose)
        return np.asarray(np.linalg.norm(rates[:, self.healthy], axis=1) < MAX_HEALTHY_FRACTION * np.linalg.norm(rates, axis=1))

    def is_law_at_rest(self, z: FloatArray) -> bool:
        """Return True if the law itself is at rest at all z (N, size) at which it is defined."""
        q = z[:, : self.law.arm.n]
        _, _, scaled_error = self.linear.rates(q, self.pose)
        return bool(self.is_stationary(q)[scaled_error > 1e-3].mean() > 0.5)

    def evaluate_equations(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Evaluate the equations (N, e) at unknowns (N, size), and their Jacobian (N, e, a) for the active unknowns."""
        values, jacobian = self.equations.evaluate_equations(z, self.pose, self.mask)
        return values[:, self._equation_rows], jacobian[:, self._equation_rows][:, :, self.active]

    def locked_rates_residual(self, z: FloatArray) -> FloatArray:
        """Return the residual (N,) of :meth:`RestEquations.locked_rates_residual`."""
        return self.equations.locked_rates_residual(z, self.pose, self.mask)

    def eigenvalues(self, q: FloatArray) -> NDArray[np.complex128]:
        """Return the eigenvalues (N, h) of :meth:`Linearisation.eigenvalues`."""
        return self.linear.eigenvalues(q, self.pose, self.healthy)

    def refine_points(self, q: FloatArray) -> FloatArray:
        """Return the erroneous stationary points (N, n) near q (N, n) for the values of the locked joints; NaN for none."""
        n = self.law.arm.n
        free_unknowns = self._free.copy()
        free_unknowns[list(self.locked_joints)] = 0.0
        unknowns, is_solved = self.equations.search(
            self.equations.estimate_unknowns(q, self.pose, self.mask), self.pose, self.mask, free_unknowns
        )
        return np.where(is_solved[:, None], unknowns[:, :n], np.nan)

    def is_isolated(self, q: FloatArray) -> BoolArray:
        """Return a mask (N,) of the points q (N, n) at which no eigenvalue is 0."""
        if not len(q):
            return np.zeros(0, dtype=bool)
        magnitudes = np.abs(self.eigenvalues(q))
        return np.asarray(magnitudes.min(axis=1) > 1e-6 * np.maximum(1.0, magnitudes.max(axis=1)))


@lru_cache(maxsize=64)
def idle_joints(law: Law) -> tuple[int, ...]:
    """Return the indices from 0 of the joints that move the task of ``law`` at no configuration.

    Stationary points have these joints at 0.
    """
    quadratic_form = law.quadratic()
    if quadratic_form is not None and not np.array_equal(quadratic_form[0], np.diag(np.diag(quadratic_form[0]))):
        return ()
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (8, law.arm.n))
    task_rows = law.task.rows
    twists = law.arm.jacobian(q)
    column_maxima = np.abs(task_rows @ twists if law.task.frame == "base" else twists).max(axis=(0, 1))
    return tuple(int(joint) for joint in np.flatnonzero(column_maxima < IDLE_COLUMN_FRACTION * column_maxima.max()))


def wrap_angles(arm: Arm, q: FloatArray) -> FloatArray:
    """Return configurations (N, n) with revolute joints wrapped to -pi to pi, regardless of their limits."""
    return joint_space.wrap_joints(arm.without_limits, q)


def select_distinct(arm: Arm, q: FloatArray, known_points: FloatArray, min_distance: float) -> FloatArray:
    """Select in order the configurations of q (N, n) that are ``min_distance`` from known points (P, n) and each other."""
    unlimited_arm = arm.without_limits
    if len(known_points) and len(q):
        q = q[joint_space.find_nearest(unlimited_arm, known_points, q)[0] > min_distance]
    is_kept = np.ones(len(q), dtype=bool)
    if len(q) > 1:
        for first, second in joint_space.find_close_pairs(unlimited_arm, q, min_distance):
            if is_kept[first]:
                is_kept[second] = False
    return q[is_kept]


@lru_cache(maxsize=16)
def _compiled_equations(law: Law, locks_one: bool) -> RestEquations:
    """Return the compiled equations of a law."""
    return RestEquations(law, locks_one)
