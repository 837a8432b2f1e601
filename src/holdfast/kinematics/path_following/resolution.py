"""Redundancy resolution: the end effector follows its task, and the self-motion serves an objective.

Every law is one straight-line program with joint rates ``d + J_A^+ (v - J d) + s (z - J_A^+ J z)``. The columns of J of joints
at a limit are removed (A) and these joints move at their bound (d), z is the desired self-motion, and s keeps the norm of the
rates under a cap. The two parts are orthogonal, so s slows the self-motion and leaves the end effector on its path.

A distance that must not shrink too fast is one more limit, a row ``g' qd >= b``. If the motion would violate it, the
self-motion is changed along ``(I - J_A^+ J) g`` by the least amount. Two rows are both respected if the self-motion can respect
both.

If the limits do not allow this, the motion with s = 0 is computed in the same way, and the result is the point between it and
the first motion that the limits allow. Only if the motion with s = 0 violates a bound as well, the end effector is slowed.
(Removing joints is greedy: rarely, in less than one of 100 crowded configurations, a linear program still finds rates with full
speed.)

Sources: Liegeois 1977 for gradient projection; Baillieul 1985 for the extended Jacobian; English and Maciejewski 1998,
sections II and VI-B, for their use before a free-swinging failure and for the cap (Fig. 8). Joints at limits are removed one at
a time, the most violated first, as by Flacco, De Luca and Khatib 2012.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, TaskError
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.control_step import Steppable
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import Cholesky, damped_gram, factor_householder, select_at_smallest
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.path_following.rate_constraints import Row, limit_self_motion
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task

SINGULAR_REGULARIZATION = 1e-12  # keeps a factorisation of a singular matrix finite
_DAMPED_FRACTION = 0.02  # fraction of the arm's typical manipulability below which rates are damped
_VOLUME_SAMPLES = 512
_NO_LIMIT_RATE = 1e9  # rad/s, means no limit


@dataclass(frozen=True, kw_only=True)
class Rates:
    """Joint rates at N configurations, or at one (without the leading N).

    Attributes:
        rates: (N, n) joint rates, rad/s and m/s.
        self_motion: (N,) fraction of the desired self-motion that the cap allows, 0 to 1.
        task: (N,) fraction of the commanded velocity that is executed, 0 to 1; below 1 only if limits enforce it.
        damping: (N,) 0 away from singularities; if above 0, the end effector leaves its path slightly.
        status: (N,) ``OK``, ``SLOWED`` if the end effector is slowed, ``SINGULAR`` if rates are damped, or ``BAD_INPUT``.
    """

    rates: FloatArray
    self_motion: FloatArray
    task: FloatArray
    damping: FloatArray
    status: NDArray[np.uint8]


@check_constructor
class Resolution(Steppable):
    """Law that converts a velocity of the end effector into joint rates.

    Args:
        arm: Arm model.
        objective: Objective of the self-motion.
        task: Prescribed rows of the end effector's velocity. Default: the objective's task, or ``pose``.
        rate_cap: Largest norm of the joint rates, rad/s (and m/s); it slows the self-motion only. None: no cap.
        period: Control period, s; a joint may not pass its limit within one period. None: position limits are ignored.
        damping: Damping of the least-squares solution at a singularity; 0 from 2 % of the arm's typical manipulability upwards.

    Raises:
        InputError: An option is out of range, or the objective belongs to another arm.
        TaskError: The task leaves no redundancy, or differs from the objective's task.
    """

    name = ""
    source = ""

    def __init__(
        self,
        arm: Arm,
        objective: Objective,
        task: str | Task | Sequence[str] | None = None,
        *,
        rate_cap: float | None = None,
        period: float | None = 0.01,
        damping: float = 0.05,
    ) -> None:
        for argument_name, value in (("rate_cap", rate_cap), ("period", period)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"{argument_name} is {value:g}; it must be above 0, or None")
        if not (np.isfinite(damping) and damping >= 0):
            raise InputError(f"damping is {damping:g}; it must be 0 or more")
        chosen = choose_task(arm, objective, task, "pose")
        self.arm, self.objective, self.task = arm, objective, chosen
        self.rate_cap, self.period, self.damping = rate_cap, period, damping

    @property
    def redundancy(self) -> int:
        """Number of joints minus the number of task components."""
        return self.arm.n - self.task.m

    @abstractmethod
    def _desired_self_motion(self, q: SX, jacobian: SX, particular: SX) -> SX:
        """Return the desired self-motion (n,) before projection; ``particular`` is the least-norm motion of the task."""

    # ---- symbols -----------------------------------------------------------------------------------------------

    def expression(self, q: SX, twist: SX, rows: Sequence[Row] = ()) -> SX:
        """Return joint rates (n,), the fractions of self-motion and task, and the damping, at ``q`` (n,) for a ``twist`` (6,).

        The twist is that of the tool, linear (m/s) and angular (rad/s) in the world frame; rows that the task leaves free are
        ignored. ``rows`` are up to two limits ``(g, b)``, (n,) and a number, which require ``g' rates >= b``.
        """
        arm, n = self.arm, self.arm.n
        chain = kinematics.kinematic_chain(arm, q)
        full_jacobian = kinematics.chain_jacobian(arm, chain, chain.position)
        scale = ca.SX(ca.DM(np.r_[[1 / self.task.length] * 3, [1.0] * 3]))
        jacobian = ca.horzcat(*[self.task.error(full_jacobian[:, k] * scale, chain.rotation) for k in range(n)])
        velocity = self.task.error(twist * scale, chain.rotation)
        low, high = self._rate_bounds(q)
        task_rates, _, task_only_fraction, task_damping = self._rates_within_bounds(
            q, jacobian, velocity, low, high, rows, with_self_motion=False
        )
        rates, motion_fraction, served_fraction, served_damping = self._rates_within_bounds(
            q, jacobian, velocity, low, high, rows, with_self_motion=True
        )
        bounded = self._bounded_joints(low, high)
        if not bounded and not rows:
            return ca.vertcat(rates, motion_fraction, served_fraction, served_damping)
        # If the limits do not allow the whole desired self-motion, take the fraction that they allow. Both motions meet the
        # task, and so does every motion between them.
        blend = ca.SX(1)
        limited = [(low[k], task_rates[k], rates[k], high[k]) for k in bounded]
        limited += [(bound_rate, ca.dot(gradient, task_rates), ca.dot(gradient, rates), None) for gradient, bound_rate in rows]
        for smallest, task_rate, served_rate, largest in limited:
            change = served_rate - task_rate
            for bound, is_towards in ((largest, change > 1e-12), (smallest, change < -1e-12)):
                if bound is not None:
                    fraction = (bound - task_rate) / ca.if_else(is_towards, change, 1)
                    blend = ca.if_else(is_towards, ca.if_else(fraction < blend, fraction, blend), blend)
        blend = ca.if_else(blend > 0, blend, 0)
        blended = task_rates + blend * (rates - task_rates)
        task_yields = served_fraction < task_only_fraction
        return ca.vertcat(
            ca.if_else(task_yields, blended * task_only_fraction, rates * served_fraction),
            ca.if_else(task_yields, blend * motion_fraction, motion_fraction),
            ca.if_else(task_yields, task_only_fraction, served_fraction),
            ca.if_else(task_yields, task_damping + blend * served_damping, served_damping),
        )

    @staticmethod
    def _bounded_joints(low: list[SX | None], high: list[SX | None]) -> list[int]:
        return [k for k in range(len(low)) if low[k] is not None or high[k] is not None]

    def _rates_within_bounds(
        self,
        q: SX,
        jacobian: SX,
        velocity: SX,
        lower: list[SX | None],
        upper: list[SX | None],
        rows: Sequence[Row],
        with_self_motion: bool,
    ) -> tuple[SX, SX, SX, SX]:
        """Return rates (n,) for the task, with or without the desired self-motion; joints at their bounds are held there.

        Further results: the fraction of the self-motion that the cap allows, the fraction that the bounds allow, and the
        damping.
        """
        n = self.arm.n
        fixed_rates, free = ca.SX(n, 1), ca.SX.ones(n, 1)
        desired: SX = None
        bounded = self._bounded_joints(lower, upper)
        passes = min(self.redundancy, len(bounded)) + 1
        for pass_index in range(passes):
            masked = ca.horzcat(*[jacobian[:, k] * free[k] for k in range(n)]) if pass_index else jacobian
            undamped = Cholesky(damped_gram(masked, SINGULAR_REGULARIZATION))
            volume = undamped.determinant() / self._damping_threshold
            damping = ca.if_else(volume < 1, self.damping**2 * (1 - volume) + SINGULAR_REGULARIZATION, SINGULAR_REGULARIZATION)
            factor = Cholesky(damped_gram(masked, damping))

            def apply_pseudoinverse(vector: SX, masked: SX = masked, factor: Cholesky = factor) -> SX:
                return masked.T @ ca.vertcat(*factor.solve(ca.vertsplit(ca.densify(vector))))

            particular = fixed_rates + apply_pseudoinverse(velocity - jacobian @ fixed_rates)
            rates, fraction = particular, ca.SX(1)
            if with_self_motion:
                if pass_index == 0:
                    desired = self._desired_self_motion(q, jacobian, particular)
                desired_free = desired * free
                self_motion = desired_free - apply_pseudoinverse(jacobian @ desired_free)
                fraction = self._capped_fraction(particular, self_motion)
                rates = particular + fraction * self_motion
            if rows:
                projected = [gradient * free - apply_pseudoinverse(jacobian @ (gradient * free)) for gradient, _ in rows]
                correction, capped_fraction, changed = limit_self_motion(
                    rows, particular, rates - particular, projected, self.rate_cap
                )
                rates, fraction = particular + correction, ca.if_else(changed, capped_fraction, fraction)
            if pass_index < passes - 1:
                worst_ratio, worst_joint, worst_bound = ca.SX(1 + 1e-9), ca.SX(-1), ca.SX(0)
                for k in bounded:
                    ratio, limit = self._bound_ratio(rates[k], lower[k], upper[k])
                    ratio = ratio * free[k]
                    is_worse = ratio > worst_ratio
                    worst_ratio = ca.if_else(is_worse, ratio, worst_ratio)
                    worst_joint = ca.if_else(is_worse, k, worst_joint)
                    worst_bound = ca.if_else(is_worse, limit, worst_bound)
                newly_fixed = [ca.if_else(worst_joint == k, 1.0, 0.0) if k in bounded else ca.SX(0) for k in range(n)]
                fixed_rates = ca.vertcat(*[fixed_rates[k] + newly_fixed[k] * worst_bound for k in range(n)])
                free = ca.vertcat(*[free[k] * (1 - newly_fixed[k]) for k in range(n)])
        # A bound that is still violated cannot be respected in this way, so all rates are scaled down together.
        task_fraction = ca.SX(1)
        for k in bounded:
            ratio, _ = self._bound_ratio(rates[k], lower[k], upper[k])
            slower = ca.if_else(ratio > 1 + 1e-9, 1 / ratio, 1.0)
            task_fraction = ca.if_else(slower < task_fraction, slower, task_fraction)
        for gradient, lower_rate in rows:
            ratio, _ = self._bound_ratio(ca.dot(gradient, rates), lower_rate, None)
            slower = ca.if_else(ratio > 1 + 1e-6, 1 / ratio, 1.0)
            task_fraction = ca.if_else(slower < task_fraction, slower, task_fraction)
        return rates, fraction, task_fraction, damping - SINGULAR_REGULARIZATION

    def _rate_bounds(self, q: SX) -> tuple[list[SX | None], list[SX | None]]:
        """Return the smallest and largest rate of every joint; None means no bound."""
        lower: list[SX | None] = []
        upper: list[SX | None] = []
        for k, joint in enumerate(self.arm.joints):
            velocity_limit = ca.SX(joint.velocity) if np.isfinite(joint.velocity) else None
            min_rate, max_rate = (None if velocity_limit is None else -velocity_limit), velocity_limit
            if self.period is not None and np.isfinite(joint.upper):
                rate_to_limit = (joint.upper - q[k]) / self.period
                max_rate = rate_to_limit if max_rate is None else ca.if_else(rate_to_limit < max_rate, rate_to_limit, max_rate)
            if self.period is not None and np.isfinite(joint.lower):
                rate_to_limit = (joint.lower - q[k]) / self.period
                min_rate = rate_to_limit if min_rate is None else ca.if_else(rate_to_limit > min_rate, rate_to_limit, min_rate)
            lower.append(min_rate)
            upper.append(max_rate)
        return lower, upper

    @staticmethod
    def _bound_ratio(rate: SX, low: SX | None, high: SX | None) -> tuple[SX, SX]:
        """Return the ratio of a rate to its bound (up to 1: within the bound), and that bound."""
        smallest = 1e-9
        upper_ratio = ca.SX(-_NO_LIMIT_RATE) if high is None else rate / ca.if_else(high > smallest, high, smallest)
        lower_ratio = ca.SX(-_NO_LIMIT_RATE) if low is None else rate / ca.if_else(low < -smallest, low, -smallest)
        upwards = upper_ratio > lower_ratio
        bound = ca.if_else(upwards, 0 if high is None else high, 0 if low is None else low)
        return ca.if_else(upwards, upper_ratio, lower_ratio), bound

    def _capped_fraction(self, particular: SX, self_motion: SX) -> SX:
        """Return the fraction of the self-motion that keeps the norm of the rates under the cap; both parts are orthogonal."""
        if self.rate_cap is None:
            return ca.SX(1)
        task_square, motion_square = ca.sumsqr(particular), ca.sumsqr(self_motion)
        remainder = self.rate_cap**2 - task_square
        fraction = ca.sqrt(ca.if_else(remainder > 0, remainder, 0) / ca.if_else(motion_square > 1e-30, motion_square, 1e-30))
        return ca.if_else(task_square + motion_square <= self.rate_cap**2, 1.0, ca.if_else(fraction < 1, fraction, 1.0))

    @cached_property
    def _damping_threshold(self) -> float:
        """Squared manipulability below which the joint rates are damped."""
        lower = np.where(np.isfinite(self.arm.lower), self.arm.lower, -np.pi)
        upper = np.where(np.isfinite(self.arm.upper), self.arm.upper, np.pi)
        q = kinematics.joint_symbols(self.arm)
        jacobian = self.task.jacobian(self.arm, q)
        volume = Kernel("volume", [q], [Cholesky(damped_gram(jacobian, SINGULAR_REGULARIZATION)).determinant()])
        samples = np.random.default_rng(0).uniform(lower, upper, (_VOLUME_SAMPLES, self.arm.n))
        return float(np.median(volume.rows(samples))) * _DAMPED_FRACTION**2

    # ---- calls -------------------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        q, twist = kinematics.joint_symbols(self.arm), ca.SX.sym("twist", 6)
        return Kernel(self.name, [q, twist], [self.expression(q, twist)])

    def rates(self, q: ArrayLike, twist: ArrayLike) -> Rates:
        """Return joint rates for a twist of the end effector.

        Args:
            q: (n,) or (N, n) configurations, rad and m.
            twist: (6,) or (N, 6) twists, linear (m/s) and angular (rad/s), in the world frame.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = as_configurations(self.arm, q)
        joints = rows[0] if single else rows
        twists = np.asarray(twist, dtype=np.float64)
        if (
            twists.shape[-1:] != (6,)
            or twists.ndim > 2
            or (twists.ndim == 2 and joints.ndim == 2 and len(twists) != len(joints))
        ):
            raise InputError(f"twist has shape {twists.shape}; it must be (6,) or (N, 6), one for each configuration")
        n = self.arm.n
        outputs = self._kernel.rows(joints, twists)
        status = np.where(outputs[:, n + 2] > 0, Status.SINGULAR, Status.OK).astype(np.uint8)
        status[outputs[:, n + 1] < 1] = Status.SLOWED
        status[np.isnan(outputs).any(axis=1)] = Status.BAD_INPUT
        selection = 0 if joints.ndim == 1 and twists.ndim == 1 else slice(None)
        return Rates(
            rates=outputs[selection, :n],
            self_motion=outputs[selection, n],
            task=outputs[selection, n + 1],
            damping=outputs[selection, n + 2],
            status=status[selection],
        )

    def _step_kernel(self) -> tuple[Kernel, int]:
        return self._kernel, self.arm.n

    def __repr__(self) -> str:
        return f"<{self.name}, {self.objective.name}, arm {self.arm.name!r}, task {self.task.name!r}>"


def choose_task(arm: Arm, objective: Objective, task: str | Task | Sequence[str] | None, default: str) -> Task:
    """Choose the task that leaves the self-motion to an objective: the given task, the objective's own, or the default.

    Raises:
        InputError: The objective belongs to another arm.
        TaskError: The objective is defined for another task, or the task leaves no redundancy.
    """
    if objective.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the objective belongs to '{objective.arm.name}', not to '{arm.name}'; make it with the same arm")
    if objective.measured is not None:
        raise TaskError(
            f"{objective.name} is not one symbolic program for joints that fail together, so no law can serve it; use single "
            "failures, relative manipulability or the geometric mean singular value"
        )
    own_task = objective.own_task
    chosen = own_task if task is None and own_task is not None else as_task(arm, default if task is None else task)
    if own_task is not None and not own_task.same_rows(chosen):
        raise TaskError(f"{objective.name} is defined for the task '{own_task.name}', not for '{chosen.name}'; use one task")
    if arm.n <= chosen.m:
        raise TaskError(
            f"task '{chosen.name}' prescribes {chosen.m} rows and '{arm.name}' has {arm.n} joints, so there is no "
            "self-motion to use; prescribe fewer rows, for example position or pointing"
        )
    return chosen


# ---- the objective as symbols ------------------------------------------------------------------------------------------


def value_to_maximise(objective: Objective, q: SX, jacobian: SX) -> SX:
    """Return the objective, negated if smaller is better."""
    return sum(
        part.weight * select_at_smallest(part.values, part.values)[0]
        for part in objective.exact_parts(q, jacobian, factor_householder(jacobian), _unit_vectors(q))
    )


def gradient_to_maximise(objective: Objective, q: SX, jacobian: SX) -> SX:
    """Return the gradient (n,) of :func:`value_to_maximise`; for the worst of several failures, the first one's."""
    total = ca.SX(int(q.numel()), 1)
    for part in objective.exact_parts(q, jacobian, factor_householder(jacobian), _unit_vectors(q)):
        rows = [ca.vertcat(*row) for row in part.slopes]
        total = total + part.weight * select_at_smallest(part.values, rows)[0]
    return total


def null_basis_and_gradient(objective: Objective, task: Task, q: SX) -> tuple[SX, SX]:
    """Return the null-space basis N (n, r), and the gradient ``N' grad`` (r,) of :func:`value_to_maximise` along it.

    The objective is best, or worst, along the self-motion where the slope is 0.
    """
    jacobian = task.jacobian(objective.arm, q)
    null_space = ca.vertcat(*[ca.horzcat(*row) for row in factor_householder(jacobian).null_space_basis()])
    return null_space, ca.densify(null_space.T @ gradient_to_maximise(objective, q, jacobian))


def _unit_vectors(q: SX) -> list[SX]:
    n = int(q.numel())
    return [ca.SX(ca.DM(np.eye(n)[:, k])) for k in range(n)]
