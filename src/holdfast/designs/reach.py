"""How far designs reach: the largest distance of the tool point from the arm's base, within the joint limits, and its slope."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.caching import cached_property
from holdfast.designs.family import Family
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import dot

Array = NDArray[np.float64]

_STARTS = 16
_SWEEPS = 400
_STILL = 1e-22  # squared change of the joints, rad or m, at which a row is done


class Reaches:
    """Reaches of all designs of a family, compiled once.

    Joint by joint the squared distance is a cosine of a revolute joint and a parabola of a sliding one, so the best value of a
    joint with the others held still has a closed form, within limits too. Sweeps over the joints only ever raise the distance.

    Args:
        family: The designs.
        seed: Of the random starts.
    """

    def __init__(self, family: Family, seed: int = 0) -> None:
        self._family = family
        self._pool = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(5,))).random((_STARTS, family.arm.n))

    def __call__(self, values: Array, limits: tuple[Array, Array]) -> tuple[Array, Array]:
        """Reach (D,), m, and its gradient (D, k) by the designs.

        Args:
            values: (D, k).
            limits: Finite limits (D, n) to begin between, :meth:`holdfast.designs.Evaluator.finite_limits`.
        """
        d, n = len(values), self._family.arm.n
        low, high = limits
        q = (low[:, None] + self._pool * (high - low)[:, None]).reshape(-1, n)
        x = np.repeat(values, _STARTS, axis=0)
        q = self._sweep.run(q, x, _STILL, _SWEEPS).state
        found = self._distance.rows(q, x)
        best = found[:, 0].reshape(d, _STARTS).argmax(axis=1) + np.arange(d) * _STARTS
        return found[best, 0], found[best, 1 : 1 + len(self._family.space.parameters)] + self._by_limits(
            values, q[best], found[best, 1 + len(self._family.space.parameters) :]
        )

    def _by_limits(self, values: Array, q: Array, slope: Array) -> Array:
        """What limits that are parameters add: a joint that is pushed against its limit follows it."""
        low, high = self._family.limits(values)
        added = np.zeros_like(values)
        for i, p in enumerate(self._family.space.parameters):
            if p.row is not None and p.kind == "lower":
                added[:, i] = np.where((q[:, p.row] <= low[:, p.row]) & (slope[:, p.row] < 0), slope[:, p.row], 0.0)
            elif p.row is not None and p.kind == "upper":
                added[:, i] = np.where((q[:, p.row] >= high[:, p.row]) & (slope[:, p.row] > 0), slope[:, p.row], 0.0)
        return added

    @cached_property
    @recalled
    def _distance(self) -> Kernel:
        """(q, x) to the distance, its gradient by the design, and by the joints."""
        q = kinematics.joint_symbols(self._family.arm)
        distance = ca.norm_2(self._from_base(q)[0])
        slopes = [ca.gradient(distance, self._family.x), ca.gradient(distance, q)]
        return Kernel("reach of designs", [q, self._family.x], [ca.vertcat(distance, *slopes)])

    def _from_base(self, q: SX) -> tuple[SX, list[SX], list[SX]]:
        """Tool point, axes and points on them, seen from the base."""
        c = kinematics.chain(self._family.arm, q)
        base = kinematics.constant(self._family.arm.base[:3, 3])
        return c.position - base, c.axes, [x - base for x in c.points]

    @cached_property
    @recalled
    def _sweep(self) -> Loop:
        arm = self._family.arm
        start = kinematics.joint_symbols(arm)
        q = ca.vertsplit(start)
        for k, joint in enumerate(arm.joints):
            tool, axes, points = self._from_base(ca.vertcat(*q))
            low, high = arm.lower[k], arm.upper[k]
            z, p = axes[k], points[k]
            if joint.prismatic:
                # A parabola that opens upwards: the farther end is best; without limits there is no farthest point.
                ends = [(x - q[k]) for x in (low, high)]
                far = [2 * step * ca.dot(z, tool) + step * step for step in ends]
                q[k] = ca.if_else(far[0] > far[1], low, high)
                continue
            arm_from_axis = tool - p
            across = arm_from_axis - z * ca.dot(z, arm_from_axis)
            c, s = ca.dot(p, across), ca.dot(p, ca.cross(z, across))  # |tool|^2 = const + 2 (c cos + s sin)(turn)
            flat = c * c + s * s > 1e-24
            turn = ca.if_else(flat, ca.atan2(ca.if_else(flat, s, 0.0), ca.if_else(flat, c, 1.0)), 0.0)
            q[k] = self._within(q[k], turn, c, s, low, high)
        step = [x - y for x, y in zip(q, ca.vertsplit(start), strict=True)]
        return Loop("sweep of reach", start, [self._family.x], next_state=ca.vertcat(*q), residual=dot(step, step))

    @staticmethod
    def _within(now: SX, turn: SX, c: SX, s: SX, low: SX, high: SX) -> SX:
        """The best angle of a joint within its limits, if the best turn from here without limits is ``turn``."""
        if not kinematics.limited(low) and not kinematics.limited(high):
            return now + turn

        def worth(angle: SX) -> SX:
            return c * ca.cos(angle - now) + s * ca.sin(angle - now)

        best, most = now, worth(now)
        whole = 2 * np.pi
        for angle in (low, high, now + turn, now + turn + whole, now + turn - whole):
            if not kinematics.limited(angle):
                continue
            inside = ca.SX(1)
            if kinematics.limited(low):
                inside = ca.logic_and(inside, angle >= low)
            if kinematics.limited(high):
                inside = ca.logic_and(inside, angle <= high)
            better = ca.logic_and(inside, worth(angle) > most)
            best, most = ca.if_else(better, angle, best), ca.if_else(better, worth(angle), most)
        return best
