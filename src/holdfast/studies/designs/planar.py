"""Sinks of planar arms of three joints with one joint locked, for all targets and any link lengths at once.

This reverses :func:`holdfast.stationary_points`: it finds the targets of every stationary point instead of the stationary
points of one target. With joint i locked the arm can rest only where the columns of the two healthy joints are parallel,
``rank(iJ) = 1``. These shapes (two of the three angles) form a curve that does not depend on the target. On it the error must
be along one direction b, so the targets of a shape lie on a line ``x + lambda b``, and the linearised motion is ``M0 + lambda
M1``. Whether it is a sink depends on a quadratic (the determinant) and a linear (the trace) function of lambda. Rotating the
arm about its first joint rotates everything, so only the distance r of a target from the first joint matters.

With joint 1 locked the Jacobian loses rank where all links are aligned, and the rates of a law without damping are unbounded
there. Such a point can attract the arm in a finite time, which is a *singular trap*. With the end effector at X along link 1,
joints 2 and 3 at small angles d, and the direction u of the links, the motion near it is ``d' = (u e) M d / (d' Q d)``. This is
a linear motion except for its time scale, so M decides.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (11), (12), (18) to (22). The reversal and the singular traps are ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import casadi as ca
import numpy as np

from holdfast.control.equilibria.stability import ZERO_BAND
from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.workspace.closed_form import ThreeLinks
from holdfast.model.arm import kinematics
from holdfast.model.arm.dh import DH
from holdfast.model.arm.model import Arm
from holdfast.studies.designs.joints import DesignJoints
from holdfast.studies.designs.space import design_space

FULL_TURN_RAD = 2 * np.pi
_MIN_INTERVAL_FRACTION = 1e-7  # fraction of the reach: shorter intervals of radii are due to rounding
ANGLE_COUNT = 120  # values of the swept angle in half a turn
_CHUNK_DESIGNS = 16  # designs analysed together
# For each locked joint, the swept angle and the angle that is solved for, as joint indices from 0.
_SWEPT_JOINTS = (1, 1, 2)
_SOLVED_JOINTS = (2, 2, 1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Radial:
    """Effect of locks on targets at K distances, for D designs.

    Attributes:
        radii: (K + 1,) borders of the rings of targets, m.
        in_reach: (D, 3, K) fraction of the locked angles of a joint that leave a target in the middle of the ring within reach.
        stuck: (D, 3, K) fraction of the locked angles at which the target is within reach but the arm can stop away from it, at
            a sink or a singular trap. Angles with a whole line of stationary points have no width and do not count.
        clear: (D, 3, K) True if no target of the ring has such an angle.
        reached: (D, K) True if the healthy arm reaches the ring.
    """

    radii: FloatArray
    in_reach: FloatArray
    stuck: FloatArray
    clear: BoolArray
    reached: BoolArray

    @property
    def guaranteed(self) -> BoolArray:
        """(D, K) True if the healthy arm reaches the ring, and after any lock nothing holds it away from a reachable target."""
        return np.asarray(self.reached & self.clear.all(axis=1))

    @property
    def area(self) -> FloatArray:
        """(K,) fraction of each ring in the total area."""
        squares = self.radii**2
        return np.asarray(np.diff(squares) / (squares[-1] - squares[0]))


class PlanarStationarySets:
    """Stationary sets of one law on planar arms of three links.

    Args:
        law: A pseudoinverse, a weighted inverse with one weight for each joint, or a damped inverse, for the position in the
            plane of an arm with three unlimited revolute joints.

    Raises:
        InputError: The law or the arm is another one.
    """

    def __init__(self, law: Law) -> None:
        quadratic = law.quadratic()
        if quadratic is None or not np.array_equal(quadratic[0], np.diag(np.diag(quadratic[0]))):
            raise InputError(
                f"the stationary sets of the {law.name} are not known in closed form; use the pseudoinverse, the damped "
                "inverse, or the weighted inverse with a weight for each joint, or sample with exact=False"
            )
        arm_links = ThreeLinks.from_task(law.arm, law.task)
        if arm_links is None:
            raise InputError(
                f"'{law.arm.name}' is not a planar arm of three unlimited revolute joints with its position as the task; "
                "sample with exact=False"
            )
        self.law, self.lengths = law, arm_links.lengths
        self._joint_weights, self._damping = np.diag(quadratic[0]), quadratic[1]
        rows = [DH(a=1.0, alpha=0.0) for _ in range(3)]
        self._design_joints = DesignJoints.from_space(
            design_space(Arm.from_dh(rows), {f"a{number}": (0.0, 2.0) for number in (1, 2, 3)})
        )

    @cached_property
    def _shape_and_slope_kernels(self) -> tuple[Kernel, Kernel]:
        """Kernels of Jacobian and tool for (q, lengths), and of the linearisation by q and by an error along a direction."""
        arm, moving = self._design_joints.whole, self._design_joints.moving.tolist()
        q, v = kinematics.joint_symbols(arm), ca.SX.sym("v", 2)
        # The law uses the unit of the task's characteristic length.
        jacobian = kinematics.world_jacobian(arm, q)[:2, moving] / self.law.task.length
        rates = self.law.inverse(jacobian, v / self.law.task.length)
        tool = kinematics.tool_pose(arm, q)[:2, 3]
        tool_rates = -ca.jacobian(rates, v) @ kinematics.world_jacobian(arm, q)[:2, moving]
        return (
            Kernel("rest shapes", [q], [jacobian, tool]),
            Kernel("rest slopes", [q, v], [ca.jacobian(rates, q)[:, moving], tool_rates]),
        )

    def radial(self, lengths: FloatArray, radii: FloatArray, angles: int = ANGLE_COUNT) -> Radial:
        """Compute the effect of locks on targets in rings.

        Args:
            lengths: (D, 3) link lengths above 0, m.
            radii: (K + 1,) ascending borders of the rings, m.
            angles: Number of values of the swept angle in half a turn.
        """
        chunks = [
            self._analyse_chunk(lengths[start : start + _CHUNK_DESIGNS], radii, angles)
            for start in range(0, len(lengths), _CHUNK_DESIGNS)
        ]
        in_reach, stuck, clear = (np.concatenate([chunk[start] for chunk in chunks]) for start in range(3))
        longest, total = lengths.max(axis=1)[:, None], lengths.sum(axis=1)[:, None]
        reached = (radii[:-1] >= 2 * longest - total - 1e-9) & (radii[1:] <= total + 1e-9)
        return Radial(radii=radii, in_reach=in_reach, stuck=stuck, clear=clear > 0, reached=reached)

    def _analyse_chunk(self, lengths: FloatArray, radii: FloatArray, angles: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        parts = [self._analyse_lock(_RestShapes.build(self, lengths, joint, angles), radii, angles) for joint in range(3)]
        in_reach, stuck, clear = (np.stack([part[k] for part in parts], axis=1) for k in range(3))
        return in_reach, stuck, clear

    def _analyse_lock(self, shapes: _RestShapes, radii: FloatArray, angles: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return in-reach and stuck fractions and the clear flags (D, K) of one locked joint."""
        clear = ~shapes.have_ring_sinks(radii)
        in_reach, stuck = np.zeros((2, len(shapes.lengths), radii.size - 1))
        for index, (inner, outer) in enumerate(pairwise(radii.tolist())):
            _, in_reach_at, stuck_at = self._classify_lock_angles(shapes, (inner + outer) / 2, angles)
            in_reach[:, index], stuck[:, index] = in_reach_at.mean(axis=1), stuck_at.mean(axis=1)
            if shapes.joint == 0 and not self._damping:
                for radius in (inner, outer):
                    locked = _make_lock_angles(angles)
                    trapped = self._has_singular_trap(shapes.lengths, radius, locked) & shapes.are_reachable_joint1_locked(
                        radius, locked
                    )
                    clear[:, index] &= ~trapped.any(axis=1)
            clear[:, index] &= ~stuck_at.any(axis=1)
        return in_reach, stuck, clear.astype(float)

    def _classify_lock_angles(self, shapes: _RestShapes, r: float, angles: int) -> tuple[FloatArray, BoolArray, BoolArray]:
        """Return locked angles (A,), and flags (D, A) of those with targets at distance r in reach, and with a stuck arm."""
        if shapes.joint:
            in_reach = shapes.are_in_reach(r)
            return shapes.angle, in_reach, shapes.have_sinks(r).any(axis=(1, 2)) & in_reach
        locked = _make_lock_angles(angles)
        in_reach, is_stuck = shapes.are_reachable_joint1_locked(r, locked), shapes.have_sinks_joint1_locked(r, locked.size)
        if not self._damping:
            is_stuck |= self._has_singular_trap(shapes.lengths, r, locked)
        return locked, in_reach, is_stuck & in_reach

    def analyse_distance(
        self, lengths: FloatArray, r: float, angles: int = ANGLE_COUNT
    ) -> list[tuple[FloatArray, BoolArray, BoolArray]]:
        """Return the effect of locks at every angle on the targets at one distance, for one design.

        Args:
            lengths: (3,) link lengths above 0, m.
            r: Distance of the targets from the first joint, m.
            angles: Number of values of the swept angle in half a turn.

        Returns:
            For each joint, its locked angles (A,), rad (for joint 1 from the direction to the target, for joints 2 and 3 in
            half a turn, because the other half is the mirror image); (A,) True if the target is in reach; (A,) True if it is
            in reach and the arm can get stuck.
        """
        results = [
            self._classify_lock_angles(_RestShapes.build(self, lengths[None], joint, angles), r, angles) for joint in range(3)
        ]
        return [(angle, in_reach[0], is_stuck[0]) for angle, in_reach, is_stuck in results]

    def _has_singular_trap(self, lengths: FloatArray, r: float, locked: FloatArray) -> BoolArray:
        """Return a mask (D, A) of the angles (A,) of joint 1 from the target's direction with an attracting singular trap."""
        first, second, third = lengths.T
        a1, a2, a3 = self._joint_weights
        trapped = np.zeros((len(lengths), locked.size), dtype=bool)
        for sign2 in (1, -1):
            for sign3 in (1, -1):
                c2, c3 = sign2 * second + sign3 * third, sign3 * third
                c1 = first + c2  # the end effector, along link 1
                norm = np.maximum(a1 * c1**2 + a2 * c2**2 + a3 * c3**2, 1e-300)
                # Sideways the joints move the end effector by c; along the links by -B d, minus the part that goes with c.
                b = -np.array([[c2, c3], [c3, c3]])
                projection = np.array([[1 - c2 * (a1 * c1 + a2 * c2) / norm, -c2 * a3 * c3 / norm]])
                projection = np.concatenate([projection, [[-c3 * (a1 * c1 + a2 * c2) / norm, 1 - c3 * a3 * c3 / norm]]])
                m = np.einsum("i,ijd,jkd->ikd", np.array([a2, a3]), projection, b)
                trace, det = m[0, 0] + m[1, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
                pull = r * np.cos(locked) - c1[:, None]
                # With the end effector on the first joint the determinant is 0; simulations show that such points trap, too.
                trapped |= (det > -ZERO_BAND * trace**2)[:, None] & (pull * trace[:, None] < 0)
        return trapped


@dataclass(frozen=True, eq=False)
class _RestShapes:
    """Rest shapes of D designs with one joint locked, at S values of the swept angle, on 2 branches.

    Attributes:
        lengths: (D, 3) link lengths, m.
        joint: Index from 0 of the locked joint.
        angle: (S,) swept angle, rad; for joints 2 and 3 it is the locked angle.
        tool, direction: (D, 2, S, 2) tool point and direction b, with link 1 along x.
        trace: Traces (D, 2, S) of M0 and of M1.
        det: Coefficients (D, 2, S) of the determinant for 1, lambda and lambda^2.
        reach_terms: (D, 2, S) product with b, and square, of the vector from the end effector to the centre about which the two
            remaining links rotate.
        lower, upper: (D, 2, S) least and greatest distance from this centre that they reach, m.
    """

    lengths: FloatArray
    joint: int
    angle: FloatArray
    tool: FloatArray
    direction: FloatArray
    trace: tuple[FloatArray, FloatArray]
    det: tuple[FloatArray, FloatArray, FloatArray]
    reach_terms: tuple[FloatArray, FloatArray]
    lower: FloatArray
    upper: FloatArray

    @classmethod
    def build(cls, planar_rest: PlanarStationarySets, lengths: FloatArray, joint: int, angles: int) -> _RestShapes:
        shape_kernel, linear_kernel = planar_rest._shape_and_slope_kernels
        joints, count = planar_rest._design_joints, len(lengths)
        # The other half turn is the mirror image.
        angle = (np.arange(angles) + 0.5) / angles * np.pi
        healthy = [index for index in range(3) if index != joint]

        def make_configurations(solved: FloatArray | float) -> FloatArray:
            q = np.zeros((count, angles, joints.whole.n))
            q[..., joints.varied] = lengths[:, None]
            q[..., joints.moving[_SWEPT_JOINTS[joint]]] = angle
            q[..., joints.moving[_SOLVED_JOINTS[joint]]] = solved
            return q.reshape(-1, joints.whole.n)

        def healthy_determinant(solved: float) -> FloatArray:
            j, _ = shape_kernel(make_configurations(solved))
            return np.asarray(np.linalg.det(j[:, :, healthy]).reshape(count, angles))

        # The determinant of the healthy columns is a sine of the angle that is solved for, so two values determine its zeros.
        root_angle = np.arctan2(-healthy_determinant(0.0), healthy_determinant(np.pi / 2))
        branches = []
        for half_turn in (0.0, np.pi):
            q = make_configurations(root_angle + half_turn)
            jacobian, tool = shape_kernel(q)
            columns = jacobian[:, :, healthy]
            longer = columns[np.arange(len(q)), :, np.argmax(np.linalg.norm(columns, axis=1), axis=1)]
            normal = np.stack([-longer[:, 1], longer[:, 0]], axis=1)
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            b = (
                np.einsum("nij,j,nkj,nk->ni", jacobian, planar_rest._joint_weights, jacobian, normal)
                + planar_rest._damping * normal
            )
            b /= np.linalg.norm(b, axis=1, keepdims=True)
            by_q, by_error = linear_kernel(q, b)
            m0, m1 = (m[:, healthy][:, :, healthy] for m in (by_error, by_q))
            d0, d2 = np.linalg.det(m0), np.linalg.det(m1)
            branch = (tool, b, np.trace(m0, 0, 1, 2), np.trace(m1, 0, 1, 2), d0, np.linalg.det(m0 + m1) - d0 - d2, d2)
            branches.append([values.reshape(count, angles, *values.shape[1:]) for values in branch])
        tool, direction, t0, t1, d0, d1, d2 = (np.stack([b[index] for b in branches], axis=1) for index in range(7))
        first, second, third = (lengths[:, index, None, None] for index in range(3))
        center = np.zeros_like(tool)
        if joint == 0:
            center[..., 0] = first
            one_link, other_link = second, third
        elif joint == 1:
            one_link, other_link = np.abs(first + second * np.exp(1j * angle)), third
        else:
            one_link, other_link = first, np.abs(second + third * np.exp(1j * angle))
        lower, upper = (
            np.broadcast_to(values, tool.shape[:3]) for values in (np.abs(one_link - other_link), one_link + other_link)
        )
        offset = tool - center
        reach_terms = (offset * direction).sum(-1), (offset**2).sum(-1)
        return cls(lengths, joint, angle, tool, direction, (t0, t1), (d0, d1, d2), reach_terms, lower, upper)

    def are_sinks(self, offsets: FloatArray) -> BoolArray:
        """Return a mask (D, 2, S) of sinks with their target in reach, at ``offsets`` (D, 2, S) along b."""
        with np.errstate(invalid="ignore"):
            trace = self.trace[0] + offsets * self.trace[1]
            det = self.det[0] + offsets * (self.det[1] + offsets * self.det[2])
            slowest = (trace + np.sqrt(np.maximum(trace**2 - 4 * det, 0.0))) / 2
            distance = self.reach_terms[1] + offsets * (2 * self.reach_terms[0] + offsets)
            is_sink = (trace < 0) & (slowest < -ZERO_BAND * np.maximum(1.0, np.abs(trace)))
            return np.asarray(is_sink & (distance >= self.lower**2) & (distance <= self.upper**2))

    @cached_property
    def _line_terms(self) -> tuple[FloatArray, FloatArray]:
        projection = (self.tool * self.direction).sum(-1)
        return projection, projection**2 - (self.tool**2).sum(-1)

    def _find_target_offsets(self, r: float) -> FloatArray:
        """Return both distances (D, 2, 2, S) along b to a target at distance r; NaN if there is none."""
        projection, root_offset = self._line_terms
        with np.errstate(invalid="ignore"):
            half_chord = np.sqrt(root_offset + r * r)
        return np.stack([-projection - half_chord, -projection + half_chord], axis=2)

    def have_sinks(self, r: float) -> BoolArray:
        """Return a mask (D, 2, 2, S) of sinks for targets at distance r, on each branch and in both directions."""
        offsets = self._find_target_offsets(r)
        return np.stack([self.are_sinks(offsets[:, :, side]) for side in range(2)], axis=2)

    def are_in_reach(self, r: float) -> BoolArray:
        """Return a mask (D, S) of swept angles of locked joint 2 or 3 at which targets at distance r are in reach."""
        return np.asarray((self.lower[:, 0] <= r) & (r <= self.upper[:, 0]))

    def are_reachable_joint1_locked(self, r: float, locked: FloatArray) -> BoolArray:
        """Return a mask (D, A) of angles (A,) of joint 1 from the target's direction with targets at distance r in reach."""
        distance = np.abs(r * np.exp(1j * locked) - self.lengths[:, :1])
        return np.asarray((self.lower[:, 0, :1] <= distance) & (distance <= self.upper[:, 0, :1]))

    def have_sinks_joint1_locked(self, r: float, cells: int) -> BoolArray:
        """Return a mask (D, cells) of sinks by the angle of joint 1 from the direction to a target at distance r."""
        offsets, has_sink = self._find_target_offsets(r), self.have_sinks(r)
        position = self.tool[:, :, None] + offsets[..., None] * self.direction[:, :, None]
        # Position of the curve along the circle, in cells; it covers the cells between successive points.
        cell_position = (np.arctan2(-position[..., 1], position[..., 0]) % FULL_TURN_RAD) / FULL_TURN_RAD * cells
        step = (np.diff(cell_position, axis=-1) + cells / 2) % cells - cells / 2
        both = has_sink[..., :-1] & has_sink[..., 1:] & (np.abs(step) < cells / 8)
        start = np.where(step < 0, cell_position[..., :-1] + step, cell_position[..., :-1]) + 2 * cells
        first = np.floor(np.where(both, start, 0)).astype(int)
        last = np.floor(np.where(both, start + np.abs(step), 0)).astype(int)
        edges = np.zeros((len(offsets), 5 * cells))
        design = np.broadcast_to(np.arange(len(offsets))[:, None, None, None], both.shape)
        np.add.at(edges, (design[both], first[both]), 1)
        np.add.at(edges, (design[both], last[both] + 1), -1)
        covered: BoolArray = np.asarray((np.cumsum(edges, axis=1) > 0.5).reshape(len(offsets), 5, cells).any(axis=1))
        return np.asarray(covered | covered[:, ::-1])  # with the mirror image

    def have_ring_sinks(self, radii: FloatArray) -> BoolArray:
        """Return a mask (D, K) of rings with a sink for a target in reach, by intervals of lambda, exact at each shape."""
        xb, xx = (self.tool * self.direction).sum(-1), (self.tool**2).sum(-1)
        yb, yy = self.reach_terms
        ones = np.ones_like(xb)
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = [*_solve_quadratic(self.det[2], self.det[1], self.det[0]), -self.trace[0] / self.trace[1], -xb, 0 * xb]
            for border in (self.lower, self.upper):
                ends += _solve_quadratic(ones, 2 * yb, yy - border**2)
        cuts = np.sort(np.stack(ends, axis=-1), axis=-1)  # NaN last
        middle = (cuts[..., 1:] + cuts[..., :-1]) / 2
        has_sink = np.stack([self.are_sinks(middle[..., index]) for index in range(middle.shape[-1])], axis=-1)
        distance = np.sqrt(np.maximum(xx[..., None] + cuts * (2 * xb[..., None] + cuts), 0.0))
        nearest, farthest = np.minimum(distance[..., 1:], distance[..., :-1]), np.maximum(distance[..., 1:], distance[..., :-1])
        has_sink &= farthest - nearest > _MIN_INTERVAL_FRACTION * self.lengths.sum(axis=1)[:, None, None, None]
        # Between two neighbouring shapes the interval moves, so sinks at both shapes cover the radii between them.
        both_sinks = has_sink[:, :, 1:] & has_sink[:, :, :-1]
        pairs = [
            (nearest, farthest, has_sink),
            (
                np.minimum(nearest[:, :, 1:], nearest[:, :, :-1]),
                np.maximum(farthest[:, :, 1:], farthest[:, :, :-1]),
                both_sinks,
            ),
        ]
        changes = np.zeros((len(xb), radii.size + 1))
        for lower, upper, selected in pairs:
            design = np.broadcast_to(np.arange(len(xb))[:, None, None, None], selected.shape)[selected]
            np.add.at(changes, (design, np.searchsorted(radii, lower[selected], side="right")), 1)
            np.add.at(changes, (design, np.minimum(np.searchsorted(radii, upper[selected], side="left") + 1, radii.size)), -1)
        return np.asarray(np.cumsum(changes, axis=1)[:, 1:-1] > 0.5)


def _make_lock_angles(angles: int) -> FloatArray:
    """Return the locked angles of joint 1 over a full turn, on a fine grid, because the target angle can change quickly."""
    return np.asarray((np.arange(6 * angles) + 0.5) / (6 * angles) * FULL_TURN_RAD)


def _solve_quadratic(a: FloatArray, b: FloatArray, c: FloatArray) -> list[FloatArray]:
    """Return the two roots of ``a x^2 + b x + c``; NaN if there are none."""
    q = -0.5 * (b + np.where(b >= 0, 1.0, -1.0) * np.sqrt(b * b - 4 * a * c))
    return [q / a, c / q]
