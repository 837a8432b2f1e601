"""Curves of configurations of a pose: a predictor along the null vector of the Jacobian, a corrector back to the pose.

Source: Goel, Maciejewski, Balakrishnan 2005, section on self-motion manifolds; samples of larger manifolds are ours.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm, householder
from holdfast.notice import Count
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import scaled_error, solver

Array = NDArray[np.float64]

TOLERANCE = 1e-10  # rad, and lengths in units of the arm's own: how far from the pose a point may be
_NEWTON = 5  # corrector steps before a step counts as too long
_SHORTEST = 2.0**-10  # of the spacing: shorter steps are not tried, the curve ends there
_STRAIGHT = 0.9  # least cosine between the null vectors at the two ends of a step
_ON_CURVE = 0.15  # of the spacing: a configuration nearer than this to a traced curve lies on it
_FARTHEST = 400.0  # rad: longer curves are cut
_MOST_POINTS = 4000  # of a sample
_WAVE = 16  # curves traced side by side; no result depends on it


@dataclass(frozen=True, eq=False, kw_only=True)
class Component:
    """One connected curve of configurations of a pose.

    Attributes:
        q: (K, n) points in order, rad and m, continuous: joints without limits may run beyond pi.
        closed: The curve comes back to its first point (modulo 2 pi on joints that turn without limits).
        bounded_by: Index from 0 of the joint whose limit ends the curve at its first and at its last point; None where none
            does: on a closed curve, and where the curve runs into a singular configuration.
        length: rad (and m, of prismatic joints), of the polygon through the points.
        barred_by: The pair of a clearance, ``panda_joint4 & table``, that ends the curve at its first and at its last point;
            empty where none does.
    """

    q: Array
    closed: bool
    bounded_by: tuple[int | None, int | None]
    length: float
    barred_by: tuple[str, str] = ("", "")

    @property
    def winding(self) -> NDArray[np.int64]:
        """(n,) whole turns of each joint on the way round a closed curve; 0 on others.

        Not 0: the joint takes every angle, which no spacing of the points blurs.
        """
        turns = np.rint((self.q[-1] - self.q[0]) / (2 * np.pi)) if self.closed else np.zeros(self.q.shape[1])
        return turns.astype(np.int64)

    @property
    def ranges(self) -> Array:
        """(n,) length of the interval of values that each joint takes on the curve, rad or m; 2 pi of a joint that winds.

        Of a revolute joint 2 pi or more is every angle. The ends lie on parabolas through three points.
        """
        wide = np.array([_peak(x, self.closed) + _peak(-x, self.closed) for x in self.q.T])
        return np.where(self.winding != 0, 2 * np.pi, wide)


def _peak(x: Array, closed: bool) -> float:
    """The largest value of a smooth curve with points x (K,), by the parabola through the largest and its neighbours."""
    k, count = int(x.argmax()), len(x)
    if count < 3 or (not closed and k in (0, count - 1)):
        return float(x[k])
    before, after = x[k - 1] - x[k], x[(k + 1) % count] - x[k]
    bent = before + after
    # Where the curve winds or its ends are no neighbours the parabola means nothing: its rise is at most the gap.
    rise = (before - after) ** 2 / (-8 * bent) if bent < 0 else 0.0
    return float(x[k] + min(rise, abs(before), abs(after)))


@dataclass
class _Run:
    """Curves under way, one a row: where they are, and why they ended."""

    q: Array
    tangent: Array
    points: list[Array]
    closed: NDArray[np.bool_]
    limit: NDArray[np.int64]  # joint, or -1


class Tracer:
    """The compiled predictor and corrector of one arm and task.

    Attributes:
        arm, task: What moves, and what it keeps.
        free: Degrees of redundancy that are left.
        held: Joints that stay, by index from 0, and the values, rad or m, at which curves are looked for.
    """

    def __init__(self, arm: Arm, task: Task, holds: int = 0) -> None:
        """For so many joints that are held, whichever; see :meth:`holding`."""
        self.arm = arm
        self.engine = solver(arm, task)
        self.task, self.free = task, arm.n - task.m - holds
        self.held: Mapping[int, float] = {}

    def holding(self, held: Mapping[int, float]) -> Tracer:
        """The same, of other joints that are held: as many as it was made for."""
        other = copy(self)
        other.held = held
        other.__dict__["_step"] = self._step  # one kernel for all
        return other

    @property
    def _inputs(self) -> list[Array]:
        """Beside configurations and poses: which joints are held, one in each row."""
        return [np.eye(self.arm.n)[list(self.held)]] if self.held else []

    @cached_property
    @recalled
    def _step(self) -> Kernel:
        arm, task = self.engine.arm, self.task
        q = kinematics.joint_symbols(arm)
        p, r = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        e, j = scaled_error(arm, task, q, p, r)
        holds = arm.n - task.m - self.free
        held = [ca.SX.sym("held", holds, arm.n)] if holds else []
        e, j = ca.vertcat(e, ca.SX.zeros(holds, 1)), ca.vertcat(j, *held)
        moves = 1 - ca.sum1(held[0]) if held else ca.SX.ones(1, arm.n)
        basis = householder(j).null_rows()
        null = [basis[k][c] * moves[k] for c in range(self.free) for k in range(arm.n)]  # not even by rounding
        back = damped_least_norm(j, e, 1e-14) * moves.T
        # The basis is that of q, the residual too: a point that needs no correction brings its own.
        return Kernel("self-motion", [q, p, r, *held], [ca.vertcat(q + back, ca.norm_2(e), *null)])

    def seeds(self, poses: Array, rows: NDArray[np.intp], seed: int, starts: int) -> tuple[NDArray[np.intp], Array]:
        """Configurations (S, n) of poses, and the pose that each belongs to, in order of starts."""
        generator = np.random.default_rng(np.random.SeedSequence(seed))
        draws = self.engine.starts(len(poses) * starts, generator).reshape(len(poses), starts, self.arm.n)
        draws[..., list(self.held)] = list(self.held.values())
        owner = np.repeat(rows, starts)
        q, ok = self._attempt(draws[rows].reshape(-1, self.arm.n), poses[owner])
        return owner[ok], q[ok]

    def _attempt(self, q: Array, poses: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Inverse kinematics from starts q (N, n): where they led, and whether that is on the pose and within the limits."""
        return self.engine.attempt(q, poses, TOLERANCE, held=list(self.held))

    def corrected(self, q: Array, poses: Array) -> tuple[Array, NDArray[np.bool_], Array]:
        """Configurations (N, n) brought back to their poses, whether that worked, and null vectors (N, free, n) there."""
        n = self.arm.n
        p, r = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for left in reversed(range(_NEWTON)):
            out = self._step.rows(q, p, r, *self._inputs)
            on = out[:, n] <= TOLERANCE
            if on.all() or not left:
                break
            q = np.where(on[:, None], q, out[:, :n])
        return q, on & np.isfinite(out).all(axis=1), out[:, n + 1 :].reshape(-1, self.free, n)

    def newton(self, q: Array, p: Array, r: Array) -> tuple[Array, Array, Array]:
        """One least-norm step (N, n) from q (N, n) towards positions p (N, 3) and rotations r (N, 3, 3), the error (N,) that q
        has, in units of the arm's own, and the first null vector (N, n) at q.
        """
        n = self.arm.n
        out = self._step.rows(q, p, r, *self._inputs)
        return out[:, :n] - q, out[:, n], out[:, n + 1 :].reshape(-1, self.free, n)[:, 0]

    # ---- curves ----------------------------------------------------------------------------------------------------

    def curves(
        self, poses: Array, owner: NDArray[np.intp], q: Array, spacing: float, found: list[list[Component]]
    ) -> list[list[Component]]:
        """Adds to what is ``found`` of each pose every other curve that a seed q (S, n) of pose ``owner`` (S,) lies on."""
        left = np.ones(owner.size, dtype=bool)
        for i in np.unique(owner):
            for component in found[i]:
                self._drop(left, component, i, owner, q, spacing)
        with Count("starts", owner.size) as tell:
            while left.any():
                tell(int(np.count_nonzero(~left)))
                owner, q = owner[left], q[left]
                left = np.ones(owner.size, dtype=bool)
                # Of few poses several seeds run side by side, though some of them turn out to lie on the same curve.
                each = max(1, _WAVE // np.unique(owner).size)
                first = np.flatnonzero(_rank(owner) < each)
                for k, component in zip(first, self._both_ways(q[first], poses[owner[first]], spacing), strict=True):
                    if component is not None and left[k]:
                        found[owner[k]].append(component)
                        self._drop(left, component, owner[k], owner, q, spacing)
                    left[k] = False
        return found

    def _drop(
        self, left: NDArray[np.bool_], component: Component, pose: np.intp, owner: NDArray[np.intp], q: Array, spacing: float
    ) -> None:
        """Takes the seeds of a pose that lie on a component out of those that are left."""
        mine = np.flatnonzero((owner == pose) & left)
        if mine.size:
            left[mine] = distance_to_curve(self.arm, component, q[mine]) > _ON_CURVE * spacing

    def passed_on(self, poses: Array, spacing: float, found: list[list[Component]]) -> list[list[Component]]:
        """Adds the curves at which inverse kinematics converges from the middle of a curve of the pose before or behind."""
        fresh = [(i, c) for i, curves in enumerate(found) for c in curves]
        while fresh:
            starts = [(i + to, c.q[len(c.q) // 2]) for i, c in fresh for to in (-1, 1) if 0 <= i + to < len(poses)]
            if not starts:
                break
            owner = np.array([i for i, _ in starts])
            q, ok = self._attempt(np.array([x for _, x in starts]), poses[owner])
            known = [len(curves) for curves in found]
            self.curves(poses, owner[ok], q[ok], spacing, found)
            fresh = [(i, c) for i, curves in enumerate(found) for c in curves[known[i] :]]
        return found

    def _both_ways(self, q: Array, poses: Array, spacing: float) -> list[Component | None]:
        q, sound, null = self.corrected(q, poses)
        tangent = null[:, 0]
        rows = np.flatnonzero(sound)
        ahead = self._trace(q[rows], tangent[rows], poses[rows], spacing)
        open_ = np.flatnonzero(~ahead.closed)
        behind = self._trace(q[rows[open_]], -tangent[rows[open_]], poses[rows[open_]], spacing)
        other = {int(k): m for m, k in enumerate(open_)}
        out: list[Component | None] = [None] * len(q)
        ends = [*range(self.arm.n), None]  # by the joint of a limit; -1: none
        for k, row in enumerate(rows):
            points = ahead.points[k]
            bounds: tuple[int | None, int | None] = (None, None)
            if k in other:
                m = other[k]
                points = np.concatenate([behind.points[m][:0:-1], points])
                bounds = ends[behind.limit[m]], ends[ahead.limit[k]]
            closed = bool(ahead.closed[k])
            length = np.linalg.norm(_segments(self.arm, points, closed), axis=1).sum()
            out[row] = Component(q=points, closed=closed, bounded_by=bounds, length=float(length))
        return out

    def _trace(self, q: Array, tangent: Array, poses: Array, spacing: float) -> _Run:
        """Follow the curve of each row one way. Every pass tries one step of every row that is under way."""
        run = _Run(q.copy(), tangent.copy(), [], np.zeros(len(q), dtype=bool), np.full(len(q), -1))
        taken_rows, taken_points = [np.arange(len(q))], [q]
        step = np.full(len(q), spacing)
        way = np.zeros(len(q))
        left = np.arange(len(q))
        while left.size:
            here, along = run.q[left], run.tangent[left]
            new, on, null = self.corrected(here + step[left, None] * along, poses[left])
            ahead = null[:, 0] * np.where(np.einsum("ij,ij->i", null[:, 0], along) < 0, -1.0, 1.0)[:, None]
            moved = np.linalg.norm(new - here, axis=1)
            good = on & (np.einsum("ij,ij->i", ahead, along) >= _STRAIGHT) & (moved <= 1.5 * step[left])
            # A limit: the step is cut in proportion until it ends on it.
            part, joint = self._within(here, new)
            beyond = good & (part < 1)
            at_limit = beyond & (part * moved <= 1e-12)
            run.limit[left[at_limit]] = joint[at_limit]
            short = good & beyond & ~at_limit
            step[left[short]] *= part[short]
            taken = good & ~beyond
            rows = left[taken]
            home = self._home(run.q[rows], new[taken], q[rows], tangent[rows])
            run.closed[rows[home]] = True
            taken_rows.append(rows[~home])
            taken_points.append(new[taken][~home])
            run.q[rows], run.tangent[rows] = new[taken], ahead[taken]
            way[rows] += moved[taken]
            step[rows] = np.minimum(2 * step[rows], spacing)
            step[left[~good]] *= 0.5
            over = at_limit | (~good & (step[left] < _SHORTEST * spacing)) | (way[left] > _FARTHEST)
            over |= np.isin(left, rows[home])
            left = left[~over]
        every = np.concatenate(taken_rows)
        order = np.argsort(every, kind="stable")
        run.points = np.split(np.concatenate(taken_points)[order], np.searchsorted(every[order], np.arange(1, len(q))))
        return run

    def _within(self, q: Array, new: Array) -> tuple[Array, NDArray[np.int64]]:
        """Share (N,) of the step from q to new that stays within the limits, and the joint that ends it."""
        moved = new - q
        room = np.where(moved > 0, self.arm.upper - q, self.arm.lower - q)
        outside = (new > self.arm.upper) | (new < self.arm.lower)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(outside, np.maximum(room / moved, 0.0), 1.0)
        return share.min(axis=1), share.argmin(axis=1)

    def _home(self, q: Array, new: Array, first: Array, along: Array) -> NDArray[np.bool_]:
        """True where the step from q to new (N, n) passes the first point of the curve, in the direction it left in."""
        before, after = (joint_space.difference(self.arm, x, first) for x in (q, new))
        crosses = (np.einsum("ij,ij->i", before, along) < 0) & (np.einsum("ij,ij->i", after, along) >= 0)
        size = np.linalg.norm(new - q, axis=1)
        near = _distance_to_segment(-before, new - q) <= _ON_CURVE * size
        return np.asarray(crosses & near & (np.linalg.norm(before, axis=1) <= 2 * size))

    # ---- samples ---------------------------------------------------------------------------------------------------

    def sample(self, pose: Array, q: Array, spacing: float) -> Array:
        """Points (N, n) of a manifold of dimension 2 or more, from seeds q (S, n): a front of neighbours that grows."""
        points = front = self._thinned(np.empty((0, self.arm.n)), q, spacing)
        turns = np.linspace(0, 2 * np.pi, 6, endpoint=False)
        planes = [(a, b) for a in range(self.free) for b in range(a + 1, self.free)]
        directions = np.zeros((len(planes) * turns.size, self.free))
        for k, (a, b) in enumerate(planes):
            directions[k * turns.size : (k + 1) * turns.size, [a, b]] = np.stack([np.cos(turns), np.sin(turns)], axis=1)
        while len(front) and len(points) < _MOST_POINTS:
            _, _, null = self.corrected(front, np.broadcast_to(pose, (len(front), 4, 4)))
            ahead = front[:, None] + spacing * np.einsum("df,nfj->ndj", directions, null)
            ahead = ahead.reshape(-1, self.arm.n)
            new, on, _ = self.corrected(ahead, np.broadcast_to(pose, (len(ahead), 4, 4)))
            inside = ((new >= self.arm.lower) & (new <= self.arm.upper)).all(axis=1)
            near = np.linalg.norm(new - ahead, axis=1) <= spacing
            front = self._thinned(points, new[on & inside & near], 0.9 * spacing)
            points = np.concatenate([points, front])
        return points[:_MOST_POINTS]

    def _thinned(self, points: Array, q: Array, spacing: float) -> Array:
        """Those of q (N, n), in order, that are ``spacing`` away from the points and from those of q kept before."""
        if len(points) and len(q):
            q = q[joint_space.nearest(self.arm, points, q)[0] >= spacing]
        if not len(q):
            return q
        keep = np.ones(len(q), dtype=bool)
        for k, m in joint_space.pairs(self.arm, q, spacing * (1 - 1e-12)):
            if keep[k]:
                keep[m] = False
        return q[keep]


def distance_to_curve(arm: Arm, component: Component, q: Array) -> Array:
    """Distance (N,) of configurations (N, n) from the polygon of a component, near it; rad (and m)."""
    points, segments = component.q, _segments(arm, component.q, component.closed)
    _, nearest = joint_space.nearest(arm, points, q)
    away = joint_space.difference(arm, q, points[nearest])
    behind = segments[nearest - 1] if component.closed else np.where(nearest[:, None] > 0, segments[nearest - 1], 0.0)
    return np.minimum(_distance_to_segment(away, segments[nearest]), _distance_to_segment(away, -behind))


def _distance_to_segment(away: Array, segment: Array) -> Array:
    """Distance (N,) of points ``away`` (N, n) from segments (N, n) that begin at the origin."""
    size = np.maximum(np.einsum("ij,ij->i", segment, segment), 1e-300)
    share = np.clip(np.einsum("ij,ij->i", away, segment) / size, 0.0, 1.0)
    return np.asarray(np.linalg.norm(away - share[:, None] * segment, axis=1))


def _segments(arm: Arm, q: Array, closed: bool) -> Array:
    """(K, n) from each point to the next; from the last to the first if closed, else 0."""
    segments = np.diff(q, axis=0, append=q[-1:])
    if closed:
        segments[-1] = joint_space.difference(arm, q[0], q[-1])
    return segments


def _rank(owner: NDArray[np.intp]) -> NDArray[np.intp]:
    """(S,) how many entries before each one have the same owner."""
    order = np.argsort(owner, kind="stable")
    first = np.searchsorted(owner[order], owner[order])
    rank = np.empty(owner.size, dtype=np.intp)
    rank[order] = np.arange(owner.size) - first
    return rank
