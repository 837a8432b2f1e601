"""Redundancy resolution: the end effector does its task, and the self-motion serves an objective.

Every law is one straight-line program: joint rates ``d + J_A^+ (v - J d) + s (z - J_A^+ J z)``, where the columns of J that
belong to joints at a limit are taken out (A) and these joints move at their bound (d), z is what the law wants of the
self-motion, and s keeps the norm of the rates under a cap. The two parts are orthogonal, so s slows the self-motion and
leaves the end effector on its path.

A distance that must not shrink too fast is one more limit, a row ``g' qd >= b``: where the motion would pass it, its
self-motion is changed along ``(I - J_A^+ J) g``, by as little as that takes. Of two rows both are kept where the
self-motion can.

Where limits leave no room for that, the motion with s = 0 is computed in the same way, and as much of the way from it to
the first is gone as the limits allow. Only if it too passes a bound the end effector is slowed. (Taking out joints is
greedy: now and
then, less than once in 100 crowded configurations, a linear program still finds rates that keep the end effector's speed.)

Sources: Liegeois 1977 for gradient projection; Baillieul 1985 for the extended Jacobian; English and Maciejewski 1998,
sections II and VI-B, for their use before a free-swinging failure and for the cap (Fig. 8). Joints at limits are taken out
one at a time, the most violated first, as by Flacco, De Luca and Khatib 2012.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked_class
from holdfast.arm import kinematics
from holdfast.arm.configurations import as_configurations
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.caching import cached_property
from holdfast.errors import InputError, TaskError
from holdfast.indices.objective import Objective
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.kernels.step import Steps
from holdfast.linalg import Cholesky, gram, householder, lowest
from holdfast.motion.rows import Row, turned_away
from holdfast.status import Status

Array = NDArray[np.float64]

BLUNT = 1e-12  # keeps a factorisation of a singular matrix finite
_CLOSE_TO_SINGULAR = 0.02  # share of the arm's typical manipulability below which rates are damped
_SAMPLES = 512
_FAR = 1e9  # stands for no limit, rad/s


@dataclass(frozen=True, kw_only=True)
class Rates:
    """Joint rates at N configurations, or at one (then without the leading N).

    Attributes:
        rates: (N, n) rad/s and m/s.
        self_motion: (N,) share of the wanted self-motion that the cap lets pass, 0 to 1.
        task: (N,) share of the commanded velocity that is carried out, 0 to 1: below 1 where limits leave no other way.
        damping: (N,) 0 away from singularities; above, the end effector leaves its path a little.
        status: (N,) ``OK``, ``SLOWED`` where the end effector is, ``SINGULAR`` where rates are damped, or ``BAD_INPUT``.
    """

    rates: Array
    self_motion: Array
    task: Array
    damping: Array
    status: NDArray[np.uint8]


@checked_class
class Resolution(Steps):
    """A law that turns a velocity of the end effector into joint rates.

    Args:
        arm: The arm.
        objective: What the self-motion serves.
        task: Rows of the end effector's velocity that are prescribed. Default: the objective's, or ``pose``.
        rate_cap: Largest norm of the joint rates, rad/s (and m/s); slows the self-motion only. None: no cap.
        period: Of control, s: a joint may not pass its limit within one. None: position limits are not looked at.
        damping: Of the least-squares solution at a singularity; 0 at 2 % of the arm's typical manipulability and above.

    Raises:
        InputError: Options out of range, or an objective of another arm.
        TaskError: The task leaves no freedom, or is not the objective's.
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
        for what, value in (("rate_cap", rate_cap), ("period", period)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"{what} is {value:g}; it must be above 0, or None")
        if not (np.isfinite(damping) and damping >= 0):
            raise InputError(f"damping is {damping:g}; it must be 0 or more")
        chosen = chosen_task(arm, objective, task, "pose")
        self.arm, self.objective, self.task = arm, objective, chosen
        self.rate_cap, self.period, self.damping = rate_cap, period, damping

    @property
    def redundancy(self) -> int:
        """Joints minus rows of the task."""
        return self.arm.n - self.task.m

    @abstractmethod
    def _wanted(self, q: SX, j: SX, particular: SX) -> SX:
        """The self-motion wanted, (n,), before it is projected; ``particular`` is the least-norm motion of the task."""

    # ---- symbols -----------------------------------------------------------------------------------------------

    def expression(self, q: SX, twist: SX, rows: Sequence[Row] = ()) -> SX:
        """Joint rates (n,), then the shares of self-motion and of the task and the damping, of q (n,) and a twist (6,).

        The twist is the tool's, linear (m/s) and angular (rad/s) in the world frame; rows the task leaves free are ignored.
        A row ``(g, b)``, (n,) and a number, asks for ``g' rates >= b`` as well; there may be two.
        """
        arm, n = self.arm, self.arm.n
        c = kinematics.chain(arm, q)
        full = kinematics.jacobian_of(arm, c, c.position)
        scale = ca.SX(ca.DM(np.r_[[1 / self.task.length] * 3, [1.0] * 3]))
        j = ca.horzcat(*[self.task.error(full[:, k] * scale, c.rotation) for k in range(n)])
        v = self.task.error(twist * scale, c.rotation)
        low, high = self._bounds(q)
        alone, _, task, damp = self._kept(q, j, v, low, high, rows, serve=False)
        rates, share, served, served_damp = self._kept(q, j, v, low, high, rows, serve=True)
        bounded = self._bounded(low, high)
        if not bounded and not rows:
            return ca.vertcat(rates, share, served, served_damp)
        # Where the limits leave no room for all of the self-motion that is wanted, as much of it as they do leave: both
        # motions keep the task, so does every motion between them.
        between = ca.SX(1)
        limited = [(low[k], alone[k], rates[k], high[k]) for k in bounded]
        limited += [(b, ca.dot(g, alone), ca.dot(g, rates), None) for g, b in rows]
        for least, first, last, most in limited:
            way = last - first
            for bound, towards in ((most, way > 1e-12), (least, way < -1e-12)):
                if bound is not None:
                    reach = (bound - first) / ca.if_else(towards, way, 1)
                    between = ca.if_else(towards, ca.if_else(reach < between, reach, between), between)
        between = ca.if_else(between > 0, between, 0)
        mixed = alone + between * (rates - alone)
        yields = served < task
        return ca.vertcat(
            ca.if_else(yields, mixed * task, rates * served),
            ca.if_else(yields, between * share, share),
            ca.if_else(yields, task, served),
            ca.if_else(yields, damp + between * served_damp, served_damp),
        )

    @staticmethod
    def _bounded(low: list[SX | None], high: list[SX | None]) -> list[int]:
        return [k for k in range(len(low)) if low[k] is not None or high[k] is not None]

    def _kept(
        self, q: SX, j: SX, v: SX, low: list[SX | None], high: list[SX | None], rows: Sequence[Row], serve: bool
    ) -> tuple[SX, SX, SX, SX]:
        """Rates (n,) for the task, with the self-motion that is wanted or without, and joints taken out at their bounds.

        Also the share of the self-motion that the cap lets pass, the share of all of it that no bound forbids, and the damping.
        """
        n = self.arm.n
        fixed, free = ca.SX(n, 1), ca.SX.ones(n, 1)
        wanted: SX = None
        bounded = self._bounded(low, high)
        passes = min(self.redundancy, len(bounded)) + 1
        for number in range(passes):
            masked = ca.horzcat(*[j[:, k] * free[k] for k in range(n)]) if number else j
            regular = Cholesky(gram(masked, BLUNT))
            volume = regular.determinant() / self._typical_volume
            damp = ca.if_else(volume < 1, self.damping**2 * (1 - volume) + BLUNT, BLUNT)
            factor = Cholesky(gram(masked, damp))

            def pinv(e: SX, masked: SX = masked, factor: Cholesky = factor) -> SX:
                return masked.T @ ca.vertcat(*factor.solve(ca.vertsplit(ca.densify(e))))

            particular = fixed + pinv(v - j @ fixed)
            rates, share = particular, ca.SX(1)
            if serve:
                if number == 0:
                    wanted = self._wanted(q, j, particular)
                own = wanted * free
                self_motion = own - pinv(j @ own)
                share = self._share(particular, self_motion)
                rates = particular + share * self_motion
            if rows:
                across = [g * free - pinv(j @ (g * free)) for g, _ in rows]
                turned, capped, changed = turned_away(rows, particular, rates - particular, across, self.rate_cap)
                rates, share = particular + turned, ca.if_else(changed, capped, share)
            if number < passes - 1:
                worst, which, bound = ca.SX(1 + 1e-9), ca.SX(-1), ca.SX(0)
                for k in bounded:
                    ratio, limit = self._excess(rates[k], low[k], high[k])
                    ratio = ratio * free[k]
                    more = ratio > worst
                    worst, which, bound = (
                        ca.if_else(more, ratio, worst),
                        ca.if_else(more, k, which),
                        ca.if_else(more, limit, bound),
                    )
                taken = [ca.if_else(which == k, 1.0, 0.0) if k in bounded else ca.SX(0) for k in range(n)]
                fixed = ca.vertcat(*[fixed[k] + taken[k] * bound for k in range(n)])
                free = ca.vertcat(*[free[k] * (1 - taken[k]) for k in range(n)])
        # What is beyond a bound now cannot be avoided like this: everything slows down together.
        task = ca.SX(1)
        for k in bounded:
            ratio, _ = self._excess(rates[k], low[k], high[k])
            slower = ca.if_else(ratio > 1 + 1e-9, 1 / ratio, 1.0)
            task = ca.if_else(slower < task, slower, task)
        for g, b in rows:
            ratio, _ = self._excess(ca.dot(g, rates), b, None)
            slower = ca.if_else(ratio > 1 + 1e-6, 1 / ratio, 1.0)
            task = ca.if_else(slower < task, slower, task)
        return rates, share, task, damp - BLUNT

    def _bounds(self, q: SX) -> tuple[list[SX | None], list[SX | None]]:
        """Smallest and largest rate of every joint; None where there is none."""
        low: list[SX | None] = []
        high: list[SX | None] = []
        for k, joint in enumerate(self.arm.joints):
            fastest = ca.SX(joint.velocity) if np.isfinite(joint.velocity) else None
            below, above = (None if fastest is None else -fastest), fastest
            if self.period is not None and np.isfinite(joint.upper):
                room = (joint.upper - q[k]) / self.period
                above = room if above is None else ca.if_else(room < above, room, above)
            if self.period is not None and np.isfinite(joint.lower):
                room = (joint.lower - q[k]) / self.period
                below = room if below is None else ca.if_else(room > below, room, below)
            low.append(below)
            high.append(above)
        return low, high

    @staticmethod
    def _excess(rate: SX, low: SX | None, high: SX | None) -> tuple[SX, SX]:
        """By which factor a rate passes its bound (up to 1: it does not), and the bound it passes."""
        tiny = 1e-9
        up = ca.SX(-_FAR) if high is None else rate / ca.if_else(high > tiny, high, tiny)
        down = ca.SX(-_FAR) if low is None else rate / ca.if_else(low < -tiny, low, -tiny)
        upwards = up > down
        bound = ca.if_else(upwards, 0 if high is None else high, 0 if low is None else low)
        return ca.if_else(upwards, up, down), bound

    def _share(self, particular: SX, self_motion: SX) -> SX:
        """Share of the self-motion that keeps the norm of the rates under the cap; the two are orthogonal."""
        if self.rate_cap is None:
            return ca.SX(1)
        p, s = ca.sumsqr(particular), ca.sumsqr(self_motion)
        room = self.rate_cap**2 - p
        slowed = ca.sqrt(ca.if_else(room > 0, room, 0) / ca.if_else(s > 1e-30, s, 1e-30))
        return ca.if_else(p + s <= self.rate_cap**2, 1.0, ca.if_else(slowed < 1, slowed, 1.0))

    @cached_property
    def _typical_volume(self) -> float:
        """Square of the manipulability below which rates are damped."""
        low = np.where(np.isfinite(self.arm.lower), self.arm.lower, -np.pi)
        high = np.where(np.isfinite(self.arm.upper), self.arm.upper, np.pi)
        q = kinematics.joint_symbols(self.arm)
        j = self.task.jacobian(self.arm, q)
        volume = Kernel("volume", [q], [Cholesky(gram(j, BLUNT)).determinant()])
        samples = np.random.default_rng(0).uniform(low, high, (_SAMPLES, self.arm.n))
        return float(np.median(volume.rows(samples))) * _CLOSE_TO_SINGULAR**2

    # ---- calls -------------------------------------------------------------------------------------------------

    @cached_property
    @recalled
    def _kernel(self) -> Kernel:
        q, twist = kinematics.joint_symbols(self.arm), ca.SX.sym("twist", 6)
        return Kernel(self.name, [q, twist], [self.expression(q, twist)])

    def rates(self, q: ArrayLike, twist: ArrayLike) -> Rates:
        """Joint rates for a twist of the end effector.

        Args:
            q: (n,) or (N, n), rad and m.
            twist: (6,) or (N, 6), linear (m/s) and angular (rad/s), in the world frame.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = as_configurations(self.arm, q)
        a = rows[0] if single else rows
        t = np.asarray(twist, dtype=np.float64)
        if t.shape[-1:] != (6,) or t.ndim > 2 or (t.ndim == 2 and a.ndim == 2 and len(t) != len(a)):
            raise InputError(f"twist has shape {t.shape}; it must be (6,) or (N, 6), one for each configuration")
        n = self.arm.n
        out = self._kernel.rows(a, t)
        status = np.where(out[:, n + 2] > 0, Status.SINGULAR, Status.OK).astype(np.uint8)
        status[out[:, n + 1] < 1] = Status.SLOWED
        status[np.isnan(out).any(axis=1)] = Status.BAD_INPUT
        one = 0 if a.ndim == 1 and t.ndim == 1 else slice(None)
        return Rates(
            rates=out[one, :n], self_motion=out[one, n], task=out[one, n + 1], damping=out[one, n + 2], status=status[one]
        )

    def _step_kernel(self) -> tuple[Kernel, int]:
        return self._kernel, self.arm.n

    def __repr__(self) -> str:
        return f"<{self.name}, {self.objective.name}, arm {self.arm.name!r}, task {self.task.name!r}>"


def chosen_task(arm: Arm, objective: Objective, task: str | Task | Sequence[str] | None, default: str) -> Task:
    """The task that leaves the self-motion to an objective: the one given, the objective's own, or the default.

    Raises:
        InputError: The objective belongs to another arm.
        TaskError: It is defined for another task, or the task leaves no freedom.
    """
    if objective.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the objective belongs to '{objective.arm.name}', not to '{arm.name}'; make it with the same arm")
    if objective.measured is not None:
        raise TaskError(
            f"{objective.name} is not one symbolic program for joints that fail together, so no law can serve it; use single "
            "failures, relative manipulability or the geometric mean singular value"
        )
    own = objective.own_task
    chosen = own if task is None and own is not None else as_task(arm, default if task is None else task)
    if own is not None and not own.same_rows(chosen):
        raise TaskError(f"{objective.name} is defined for the task '{own.name}', not for '{chosen.name}'; use one task")
    if arm.n <= chosen.m:
        raise TaskError(
            f"task '{chosen.name}' prescribes {chosen.m} rows and '{arm.name}' has {arm.n} joints, so there is no "
            "self-motion to use; prescribe fewer rows, for example position or pointing"
        )
    return chosen


# ---- the objective as symbols ------------------------------------------------------------------------------------------


def oriented_value(objective: Objective, q: SX, j: SX) -> SX:
    """The objective, negated where smaller is better."""
    return sum(p.weight * lowest(p.values, p.values)[0] for p in objective.exact_parts(q, j, householder(j), _axes(q)))


def oriented_gradient(objective: Objective, q: SX, j: SX) -> SX:
    """Gradient (n,) of :func:`oriented_value`; of the worst of several failures that of the first."""
    total = ca.SX(int(q.numel()), 1)
    for part in objective.exact_parts(q, j, householder(j), _axes(q)):
        rows = [ca.vertcat(*row) for row in part.slopes]
        total = total + part.weight * lowest(part.values, rows)[0]
    return total


def slope_along(objective: Objective, task: Task, q: SX) -> tuple[SX, SX]:
    """Null-space basis N (n, r), and the slope ``N' grad`` (r,) of :func:`oriented_value` along it.

    The objective is best, or worst, along the self-motion where the slope is 0.
    """
    j = task.jacobian(objective.arm, q)
    null = ca.vertcat(*[ca.horzcat(*row) for row in householder(j).null_rows()])
    return null, ca.densify(null.T @ oriented_gradient(objective, q, j))


def _axes(q: SX) -> list[SX]:
    n = int(q.numel())
    return [ca.SX(ca.DM(np.eye(n)[:, k])) for k in range(n)]
