"""Where sinks hold planar arms of three joints, for all targets and any link lengths at once.

The reverse of :func:`holdfast.stationary_points`: not the stationary points of one target, but the targets of every stationary
point. With joint i locked the arm can only rest where the columns of the two healthy joints line up, ``rank(iJ) = 1``: a curve
of shapes (two of the three angles) that no target enters. On it the error must be along one direction b, so that the targets
of a shape lie on a line ``x + lambda b``, and the linearised motion is ``M0 + lambda M1`` there: where it is a sink is a
question of a quadratic (the determinant) and a linear (the trace) function of lambda. Turning the arm turns everything,
so that a target is its distance r from the first joint.

With joint 1 locked the Jacobian loses rank where all links line up, and without damping the law has no bounds there. Such a
point can draw the arm in, in a finite time: a *singular trap*. With the end effector at X along link 1, the other joints 2 and
3 at small angles d, and u the direction of the links, the motion near it is ``d' = (u e) M d / (d' Q d)``: a linear one but for
its clock, and M decides.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (11), (12), (18) to (22). Turned round and for singular traps, ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.dh import DH
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.designs.joints import DesignJoints
from holdfast.designs.space import design_space
from holdfast.equilibria.stability import ZERO_BAND
from holdfast.errors import InputError
from holdfast.kernels.kernel import Kernel
from holdfast.reach.closed_form import ThreeLinks

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

TURN = 2 * np.pi
_TINY = 1e-7  # of the reach: intervals of radii shorter than this are rounding
ANGLES = 120  # values of the angle that is run through, in half a turn
_CHUNK = 16  # designs analysed together
# Of each locked joint: the angle that is run through and the one that is solved for, as joints from 0.
_RUN, _SOLVED = (1, 1, 2), (2, 2, 1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Radial:
    """What locks leave of targets at K distances, for D designs.

    Attributes:
        radii: (K + 1,) borders of the rings of targets, m.
        in_reach: (D, 3, K) share of the angles at which a joint may lock that leave the target within reach, in the middle of
            the ring.
        stuck: (D, 3, K) share of them at which it is within reach and the arm can stop away from it: there is a sink or a
            singular trap. Angles at which a whole line of stationary points lies have no width and are not in it.
        clear: (D, 3, K) no target of the ring has such an angle.
        reached: (D, K) the healthy arm reaches the ring.
    """

    radii: Array
    in_reach: Array
    stuck: Array
    clear: Flags
    reached: Flags

    @property
    def guaranteed(self) -> Flags:
        """(D, K) the healthy arm reaches the ring, and whichever joint locks, nothing holds it while the target is in reach."""
        return np.asarray(self.reached & self.clear.all(axis=1))

    @property
    def area(self) -> Array:
        """(K,) share of each ring in the area of all."""
        squares = self.radii**2
        return np.asarray(np.diff(squares) / (squares[-1] - squares[0]))


class PlanarRest:
    """The stuck sets of one law on planar arms of three links.

    Args:
        law: A pseudoinverse, a weighted inverse with weights for each joint, or a damped inverse, of an arm with three revolute
            joints that turn all the way, for the position in its plane.

    Raises:
        InputError: Another law or arm.
    """

    def __init__(self, law: Law) -> None:
        form = law.quadratic()
        if form is None or not np.array_equal(form[0], np.diag(np.diag(form[0]))):
            raise InputError(
                f"where the {law.name} rests is not known in closed form; use the pseudoinverse, the damped inverse, or the "
                "weighted inverse with a weight for each joint, or sample: exact=False"
            )
        found = ThreeLinks.of(law.arm, law.task)
        if found is None:
            raise InputError(
                f"'{law.arm.name}' is not a planar arm of three revolute joints that turn all the way, with its position as "
                "the task; sample: exact=False"
            )
        self.law, self.lengths = law, found.lengths
        self._a, self._damping = np.diag(form[0]), form[1]
        rows = [DH(a=1.0, alpha=0.0) for _ in range(3)]
        self._joints = DesignJoints.of(design_space(Arm.from_dh(rows), {f"a{k}": (0.0, 2.0) for k in (1, 2, 3)}))

    @cached_property
    def _kernels(self) -> tuple[Kernel, Kernel]:
        """Jacobian and tool of (q, lengths); the linearisation by q and by the error, for an error along a direction."""
        arm, moving = self._joints.whole, self._joints.moving.tolist()
        q, v = kinematics.joint_symbols(arm), ca.SX.sym("v", 2)
        # As the law sees it: in units of the task's characteristic length.
        j = kinematics.jacobian(arm, q)[:2, moving] / self.law.task.length
        rates = self.law.inverse(j, v / self.law.task.length)
        tool = kinematics.tool_pose(arm, q)[:2, 3]
        moved = -ca.jacobian(rates, v) @ kinematics.jacobian(arm, q)[:2, moving]
        return (
            Kernel("rest shapes", [q], [j, tool]),
            Kernel("rest slopes", [q, v], [ca.jacobian(rates, q)[:, moving], moved]),
        )

    def radial(self, lengths: Array, radii: Array, angles: int = ANGLES) -> Radial:
        """What locks leave of targets in rings.

        Args:
            lengths: (D, 3) of the links, above 0, m.
            radii: (K + 1,) ascending borders of the rings, m.
            angles: At how many values in half a turn the angle that is run through is looked at.
        """
        chunks = [self._radial(lengths[k : k + _CHUNK], radii, angles) for k in range(0, len(lengths), _CHUNK)]
        in_reach, stuck, clear = (np.concatenate([c[k] for c in chunks]) for k in range(3))
        longest, every = lengths.max(axis=1)[:, None], lengths.sum(axis=1)[:, None]
        reached = (radii[:-1] >= 2 * longest - every - 1e-9) & (radii[1:] <= every + 1e-9)
        return Radial(radii=radii, in_reach=in_reach, stuck=stuck, clear=clear > 0, reached=reached)

    def _radial(self, lengths: Array, radii: Array, angles: int) -> tuple[Array, Array, Array]:
        parts = [self._joint(_Shapes.of(self, lengths, i, angles), radii, angles) for i in range(3)]
        in_reach, stuck, clear = (np.stack([p[k] for p in parts], axis=1) for k in range(3))
        return in_reach, stuck, clear

    def _joint(self, shapes: _Shapes, radii: Array, angles: int) -> tuple[Array, Array, Array]:
        """In reach, stuck and clear (D, K) of one locked joint."""
        clear = ~shapes.touched(radii)
        in_reach, stuck = np.zeros((2, len(shapes.lengths), radii.size - 1))
        for k, (low, high) in enumerate(pairwise(radii.tolist())):
            _, reach, held = self._held(shapes, (low + high) / 2, angles)
            in_reach[:, k], stuck[:, k] = reach.mean(axis=1), held.mean(axis=1)
            if shapes.joint == 0 and not self._damping:
                for r in (low, high):
                    locked = _cells(angles)
                    trapped = self._trapped(shapes.lengths, r, locked) & shapes.within_first(r, locked)
                    clear[:, k] &= ~trapped.any(axis=1)
            clear[:, k] &= ~held.any(axis=1)
        return in_reach, stuck, clear.astype(float)

    def _held(self, shapes: _Shapes, r: float, angles: int) -> tuple[Array, Flags, Flags]:
        """Locked angles (A,); (D, A) where targets at distance r are in reach, and where the arm can get stuck besides."""
        if shapes.joint:
            reach = shapes.within(r)
            return shapes.angle, reach, shapes.held(r).any(axis=(1, 2)) & reach
        locked = _cells(angles)
        reach, held = shapes.within_first(r, locked), shapes.held_first(r, locked.size)
        if not self._damping:
            held |= self._trapped(shapes.lengths, r, locked)
        return locked, reach, held & reach

    def locked(self, lengths: Array, r: float, angles: int = ANGLES) -> list[tuple[Array, Flags, Flags]]:
        """What locks at every angle leave of the targets at one distance, for one design.

        Args:
            lengths: (3,) of the links, above 0, m.
            r: Distance of the targets from the first joint, m.
            angles: As for :meth:`radial`.

        Returns:
            For each joint the angles (A,) at which it locks, rad (of joint 1 from the direction to the target, of joints 2 and
            3 in half a turn, as the other half is the mirror image); (A,) where the target is in reach; (A,) where it is, and
            the arm can get stuck.
        """
        found = [self._held(_Shapes.of(self, lengths[None], i, angles), r, angles) for i in range(3)]
        return [(at, reach[0], held[0]) for at, reach, held in found]

    def _trapped(self, lengths: Array, r: float, locked: Array) -> Flags:
        """(D, A) whether a singular trap draws the arm in, with joint 1 at angles (A,) from the direction to the target."""
        first, second, third = lengths.T
        a1, a2, a3 = self._a
        out = np.zeros((len(lengths), locked.size), dtype=bool)
        for s2 in (1, -1):
            for s3 in (1, -1):
                c2, c3 = s2 * second + s3 * third, s3 * third
                c1 = first + c2  # the end effector, along link 1
                norm = np.maximum(a1 * c1**2 + a2 * c2**2 + a3 * c3**2, 1e-300)
                # Sideways the joints move the end effector by c; along the links by -B d, less what goes with c.
                b = -np.array([[c2, c3], [c3, c3]])
                off = np.array([[1 - c2 * (a1 * c1 + a2 * c2) / norm, -c2 * a3 * c3 / norm]])
                off = np.concatenate([off, [[-c3 * (a1 * c1 + a2 * c2) / norm, 1 - c3 * a3 * c3 / norm]]])
                m = np.einsum("i,ijd,jkd->ikd", np.array([a2, a3]), off, b)
                trace, det = m[0, 0] + m[1, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
                pull = r * np.cos(locked) - c1[:, None]
                # With the end effector on the first joint the determinant is 0, and such points were seen to trap too.
                out |= (det > -ZERO_BAND * trace**2)[:, None] & (pull * trace[:, None] < 0)
        return out


@dataclass(frozen=True, eq=False)
class _Shapes:
    """Shapes of rest of D designs with one joint locked, at S values of the angle run through, on 2 branches.

    Attributes:
        lengths: (D, 3).
        joint: The locked one, from 0.
        angle: (S,) the angle run through; for joints 2 and 3 it is the locked one.
        tool, along: (D, 2, S, 2) the tool point and the direction b, link 1 along x.
        trace: Two (D, 2, S): of M0 and of M1.
        det: Three (D, 2, S): of 1, lambda and lambda^2.
        reach: Two (D, 2, S): from the end effector to the middle about which the two links turn that are left, its product with
            b and its square.
        low, high: (D, 2, S) between which distances from the middle they reach.
    """

    lengths: Array
    joint: int
    angle: Array
    tool: Array
    along: Array
    trace: tuple[Array, Array]
    det: tuple[Array, Array, Array]
    reach: tuple[Array, Array]
    low: Array
    high: Array

    @classmethod
    def of(cls, rest: PlanarRest, lengths: Array, joint: int, angles: int) -> _Shapes:
        jacobian, slopes = rest._kernels
        joints, count = rest._joints, len(lengths)
        # The other half turn is the mirror image.
        angle = (np.arange(angles) + 0.5) / angles * np.pi
        healthy = [k for k in range(3) if k != joint]

        def at(solved: Array | float) -> Array:
            q = np.zeros((count, angles, joints.whole.n))
            q[..., joints.varied] = lengths[:, None]
            q[..., joints.moving[_RUN[joint]]] = angle
            q[..., joints.moving[_SOLVED[joint]]] = solved
            return q.reshape(-1, joints.whole.n)

        def across(solved: float) -> Array:
            j, _ = jacobian(at(solved))
            return np.asarray(np.linalg.det(j[:, :, healthy]).reshape(count, angles))

        # The determinant of the healthy columns is a sine of the angle that is solved for: two values tell its zeros.
        zero = np.arctan2(-across(0.0), across(np.pi / 2))
        branches = []
        for turn in (0.0, np.pi):
            q = at(zero + turn)
            j, tool = jacobian(q)
            columns = j[:, :, healthy]
            longer = columns[np.arange(len(q)), :, np.argmax(np.linalg.norm(columns, axis=1), axis=1)]
            u = np.stack([-longer[:, 1], longer[:, 0]], axis=1)
            u /= np.linalg.norm(u, axis=1, keepdims=True)
            b = np.einsum("nij,j,nkj,nk->ni", j, rest._a, j, u) + rest._damping * u
            b /= np.linalg.norm(b, axis=1, keepdims=True)
            by_q, by_hand = slopes(q, b)
            m0, m1 = (m[:, healthy][:, :, healthy] for m in (by_hand, by_q))
            d0, d2 = np.linalg.det(m0), np.linalg.det(m1)
            one = (tool, b, np.trace(m0, 0, 1, 2), np.trace(m1, 0, 1, 2), d0, np.linalg.det(m0 + m1) - d0 - d2, d2)
            branches.append([x.reshape(count, angles, *x.shape[1:]) for x in one])
        tool, along, t0, t1, d0, d1, d2 = (np.stack([b[k] for b in branches], axis=1) for k in range(7))
        first, second, third = (lengths[:, k, None, None] for k in range(3))
        centre = np.zeros_like(tool)
        if joint == 0:
            centre[..., 0] = first
            one_link, other = second, third
        elif joint == 1:
            one_link, other = np.abs(first + second * np.exp(1j * angle)), third
        else:
            one_link, other = first, np.abs(second + third * np.exp(1j * angle))
        low, high = (np.broadcast_to(x, tool.shape[:3]) for x in (np.abs(one_link - other), one_link + other))
        away = tool - centre
        reach = (away * along).sum(-1), (away**2).sum(-1)
        return cls(lengths, joint, angle, tool, along, (t0, t1), (d0, d1, d2), reach, low, high)

    def sinks(self, far: Array) -> Flags:
        """(D, 2, S) whether the stationary point is a sink whose target is ``far`` (D, 2, S) along b, and is in reach."""
        with np.errstate(invalid="ignore"):
            trace = self.trace[0] + far * self.trace[1]
            det = self.det[0] + far * (self.det[1] + far * self.det[2])
            slowest = (trace + np.sqrt(np.maximum(trace**2 - 4 * det, 0.0))) / 2
            distance = self.reach[1] + far * (2 * self.reach[0] + far)
            sink = (trace < 0) & (slowest < -ZERO_BAND * np.maximum(1.0, np.abs(trace)))
            return np.asarray(sink & (distance >= self.low**2) & (distance <= self.high**2))

    @cached_property
    def _line(self) -> tuple[Array, Array]:
        middle = (self.tool * self.along).sum(-1)
        return middle, middle**2 - (self.tool**2).sum(-1)

    def _far(self, r: float) -> Array:
        """(D, 2, 2, S) the two ways along b to a target at distance r; NaN where there is none."""
        middle, least = self._line
        with np.errstate(invalid="ignore"):
            root = np.sqrt(least + r * r)
        return np.stack([-middle - root, -middle + root], axis=2)

    def held(self, r: float) -> Flags:
        """(D, 2, 2, S) whether there is a sink for targets at distance r, on each branch and either way."""
        far = self._far(r)
        return np.stack([self.sinks(far[:, :, k]) for k in range(2)], axis=2)

    def within(self, r: float) -> Flags:
        """(D, S) whether targets at distance r are in reach with joint 2 or 3 locked at the angles run through."""
        return np.asarray((self.low[:, 0] <= r) & (r <= self.high[:, 0]))

    def within_first(self, r: float, locked: Array) -> Flags:
        """(D, A) likewise with joint 1 locked at angles (A,) from the direction to the target."""
        away = np.abs(r * np.exp(1j * locked) - self.lengths[:, :1])
        return np.asarray((self.low[:, 0, :1] <= away) & (away <= self.high[:, 0, :1]))

    def held_first(self, r: float, cells: int) -> Flags:
        """(D, cells) at which angles of joint 1 from the direction to a target at distance r there is a sink."""
        far, held = self._far(r), self.held(r)
        place = self.tool[:, :, None] + far[..., None] * self.along[:, :, None]
        # Where along the circle the curve is, in cells; from one point to the next it covers what lies between.
        at = (np.arctan2(-place[..., 1], place[..., 0]) % TURN) / TURN * cells
        step = (np.diff(at, axis=-1) + cells / 2) % cells - cells / 2
        both = held[..., :-1] & held[..., 1:] & (np.abs(step) < cells / 8)
        start = np.where(step < 0, at[..., :-1] + step, at[..., :-1]) + 2 * cells
        first, last = (
            np.floor(np.where(both, start, 0)).astype(int),
            np.floor(np.where(both, start + np.abs(step), 0)).astype(int),
        )
        edges = np.zeros((len(far), 5 * cells))
        design = np.broadcast_to(np.arange(len(far))[:, None, None, None], both.shape)
        np.add.at(edges, (design[both], first[both]), 1)
        np.add.at(edges, (design[both], last[both] + 1), -1)
        covered: Flags = np.asarray((np.cumsum(edges, axis=1) > 0.5).reshape(len(far), 5, cells).any(axis=1))
        return np.asarray(covered | covered[:, ::-1])  # with the mirror image

    def touched(self, radii: Array) -> Flags:
        """(D, K) whether any target in a ring has a sink within its reach: by intervals of lambda, exact at each shape."""
        xb, xx = (self.tool * self.along).sum(-1), (self.tool**2).sum(-1)
        yb, yy = self.reach
        one = np.ones_like(xb)
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = [*_roots(self.det[2], self.det[1], self.det[0]), -self.trace[0] / self.trace[1], -xb, 0 * xb]
            for border in (self.low, self.high):
                ends += _roots(one, 2 * yb, yy - border**2)
        cuts = np.sort(np.stack(ends, axis=-1), axis=-1)  # NaN last
        middle = (cuts[..., 1:] + cuts[..., :-1]) / 2
        held = np.stack([self.sinks(middle[..., k]) for k in range(middle.shape[-1])], axis=-1)
        distance = np.sqrt(np.maximum(xx[..., None] + cuts * (2 * xb[..., None] + cuts), 0.0))
        near, far = np.minimum(distance[..., 1:], distance[..., :-1]), np.maximum(distance[..., 1:], distance[..., :-1])
        held &= far - near > _TINY * self.lengths.sum(axis=1)[:, None, None, None]
        # Between two neighbouring shapes the interval moves: what both have covers what lies between.
        both = held[:, :, 1:] & held[:, :, :-1]
        pairs = [
            (near, far, held),
            (np.minimum(near[:, :, 1:], near[:, :, :-1]), np.maximum(far[:, :, 1:], far[:, :, :-1]), both),
        ]
        out = np.zeros((len(xb), radii.size + 1))
        for low, high, wanted in pairs:
            design = np.broadcast_to(np.arange(len(xb))[:, None, None, None], wanted.shape)[wanted]
            np.add.at(out, (design, np.searchsorted(radii, low[wanted], side="right")), 1)
            np.add.at(out, (design, np.minimum(np.searchsorted(radii, high[wanted], side="left") + 1, radii.size)), -1)
        return np.asarray(np.cumsum(out, axis=1)[:, 1:-1] > 0.5)


def _cells(angles: int) -> Array:
    """Angles at which joint 1 locks, over a whole turn: that of the target can change quickly along a curve."""
    return np.asarray((np.arange(6 * angles) + 0.5) / (6 * angles) * TURN)


def _roots(a: Array, b: Array, c: Array) -> list[Array]:
    """The two roots of ``a x^2 + b x + c``; NaN where there are none."""
    q = -0.5 * (b + np.where(b >= 0, 1.0, -1.0) * np.sqrt(b * b - 4 * a * c))
    return [q / a, c / q]
