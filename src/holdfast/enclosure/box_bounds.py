"""What a box of joints can be told to hold: one kernel for all boxes, poses and failures of an arm and a task.

Over a box with centre c and half widths h the rows of a task are ``e(q) = e(c) + J (q - c) + r`` with ``|r_i| <= b_i``: J is
exact, and b bounds what the second derivatives and more do over the box: the lesser of a bound of these everywhere, and of
what they are at c, row by row, and a bound of the third derivatives.

- ``rho_k``, a bound of the distance of the tool from axis k in the box, from the tool inwards, as only the joints beyond k
  change it: ``min(rho_k of the arm, |J_k(c)| + sum_{l>k} rho_l h_l)``. Of a slide it is 1, the length of its column.
- position: ``d2p / dq_k dq_l = z_k x (z_l x r_l)`` for ``k <= l``, and with every joint further in one more product with its
  axis. So of all derivatives of order j with l outermost none is above rho_l, and with ``A_l = sum_{k<=l} h_k`` their part is
  ``sum_l rho_l (A_l^j - A_{l-1}^j) / j!``; joints that slide count only as the outermost, once.
- orientation: with the tool's axes ``a_i`` and those wanted ``d_i`` the rows are ``1/2 sum d_i x a_i``, or of the tool's z
  axis alone its products with the wanted x and y axes. Both are linear in the axes, each derivative is at most 1 in any
  direction, so that those of order j make ``S^j / j!`` with S the sum of the half widths of joints that turn. The second are
  ``1/2 (D A' z_k) x z_l - (z_k . z_l) e`` with the columns of A and D the axes. The rows also vanish half a turn away, which
  no box with ``S`` below the angle that is missed can hold: such boxes are empty.

A box is empty if in some direction v of the rows ``|v e(c)| > sum_k |v J_k| h_k + sum_i |v_i| b_i``; tried are the error's own
direction and ``v = (J h^2 J' + b^2)^-1 e(c)``, the direction in which it is farthest in units of what the box can make of it.

For every matrix Y the solutions in a box obey ``q - c = -Y e(c) + (I - Y J)(q - c) - Y r`` (Krawczyk 1969 in this form): the
right side is a box again, with ``Y = h^2 J' (J h^2 J' + b^2)^-1``. What lies outside it is cut away. If as many joints move as
there are rows and it lies strictly inside, the box holds a solution (Brouwer).

Source: interval Newton methods (Krawczyk 1969; Neumaier 1990); the bounds and the choice of Y and v are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, plane_normal
from holdfast.errors import TaskError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import Cholesky

Array = NDArray[np.float64]

ROUNDING = 1e-9  # m and rad by which every bound is widened; the kernel's own errors are 1e-13
_TINY = 1e-30  # keeps the inverse finite where a box and its remainder are nothing
_LEAN = 0.35  # m: what 1 rad of a joint counts beside the way of the tool when the joint to halve is chosen
TURNS = {"none": 0, "axis": 2, "all": 3, "plane": 1}


@dataclass(frozen=True)
class Parts:
    """Which rows of a pose a task has, as far as bounds are known for them.

    Attributes:
        linear: (k, 3) rows of the position, world frame.
        turn: Of the orientation: ``none``, the tool's z ``axis``, ``all`` of it, or the turn in the ``plane`` of the arm.
        normal: (3,) of that plane.
    """

    linear: tuple[tuple[float, ...], ...]
    turn: str
    normal: tuple[float, ...] = ()

    @property
    def m(self) -> int:
        """Number of rows."""
        return len(self.linear) + TURNS[self.turn]

    @classmethod
    def of(cls, arm: Arm, task: Task) -> Parts:
        """Those of a task.

        Raises:
            TaskError: Rows for which no bound is known.
        """
        rows = task.rows
        turning = np.abs(rows[:, 3:]).max(axis=1) > 0
        linear, angular = rows[~turning], rows[turning]
        mixed = bool(np.abs(angular[:, :3]).max(initial=0.0) > 0)
        if not mixed and (task.frame == "base" or len(linear) in (0, 3)):
            places = np.eye(3) if task.frame == "tool" and len(linear) else linear[:, :3]
            made = tuple(map(tuple, places.tolist()))
            normal = plane_normal(arm)
            if not len(angular):
                return cls(made, "none")
            if len(angular) == 3:
                return cls(made, "all")
            if task.frame == "tool" and len(angular) == 2 and np.abs(angular[:, 5]).max() == 0:
                return cls(made, "axis")
            if normal is not None and task.frame == "base" and abs(abs(angular[0, 3:] @ normal) - 1) < 1e-9:
                return cls(made, "plane", tuple(normal.tolist()))
        raise TaskError(
            f"nothing can be proved about task '{task.name}'; known are position rows in the world frame, alone, with the "
            "whole orientation, with the direction of the tool's z axis (pointing), or with the turn of a planar arm"
        )


@recalled
def box_kernel(arm: Arm, parts: Parts, along: bool = False) -> Kernel:
    """The kernel of an arm and a task's rows, of a pose or ``along`` a straight leg of a path.

    Inputs: centre (n,) and half widths (n,), rad and m; position (3,) and orientation (3, 3) wanted; by how much each row may
    be missed (m,). Outputs: ``margin``, above 0 for a box that is empty; centre (n,) and half widths (n,) of what it can still
    hold; ``inside``, below 0 where that is strictly inside of the joints that move; how much of the volume it is; which joint
    to halve; from the centre to the middle of what it can hold (n,); the rows' error at the centre (m,).

    Along a leg the way of the end effector (3,), m, is one more input, and where on it the pose is, 0 to 1, one more joint: the
    last of all that is (n,).
    """
    n, size = arm.n, arm.n + along
    c, h = ca.SX.sym("c", size), ca.SX.sym("h", size)
    p, r, tolerance = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("t", parts.m)
    way = ca.SX.sym("w", 3)
    chain = kinematics.chain(arm, c[:n])
    foot = _foot(arm) if parts.turn == "all" and parts.linear else None
    beside = np.zeros(3) if foot is None else arm.tool[:3, :3].T @ (foot - arm.tool[:3, 3])
    point = chain.position + chain.rotation @ beside
    full = kinematics.jacobian_of(arm, chain, point)
    turns = [not joint.prismatic for joint in arm.joints]
    rho = _distances(arm, full, (c[:n], h[:n]), turns, arm.tool[:3, 3] if foot is None else foot)
    leaning = turning(arm, parts)
    error, slopes, remainder = [], [], []
    if parts.linear:
        matrix = kinematics.constant(np.array(parts.linear))
        error.append(matrix @ (point - p - r @ beside - (c[n] * way if along else 0)))
        slopes.append(matrix @ ca.horzcat(full[:3, :], *([-way] * along)))
        bends = _bends(lambda k, i: matrix @ ca.cross(full[3:, k], full[:3, i]), h, turns, [True] * n)
        remainder.append(_least(bends, *_higher(rho, h, turns)))
    missed, spread = None, sum((h[k] for k in range(n) if leaning[k]), ca.SX(0))
    if parts.turn != "none":
        value, slope, second, missed = _turn(parts, chain.rotation, full[3:, :], r)
        error.append(value)
        slopes.append(ca.horzcat(slope, ca.SX(TURNS[parts.turn], int(along))))
        remainder.append(_least(_bends(second, h, leaning, leaning), spread**2 / 2, spread**3 / 6))
    e, j = ca.densify(ca.vertcat(*error)), ca.vertcat(*slopes)
    rho += [ca.sqrt(ca.sumsqr(way))] * along
    leaning += [False] * along
    lean = ca.sqrt(ca.sumsqr(tolerance[len(parts.linear) :])) if parts.turn != "none" else ca.SX(0)
    lean = ca.if_else(lean < 0.9, lean + lean**3, np.pi)  # the angle whose sine it is at most
    allowed = tolerance[: len(parts.linear)] + float(np.linalg.norm(beside)) * lean  # a point beside the tool is missed by both
    b = ca.vertcat(*remainder) + ca.vertcat(allowed, tolerance[len(parts.linear) :])
    weighted = j @ ca.diag(h * h)
    gram = weighted @ j.T + ca.diag(b * b + _TINY)
    factor = Cholesky([[gram[i, k] for k in range(parts.m)] for i in range(parts.m)])
    farthest = ca.vertcat(*factor.solve(ca.vertsplit(e)))
    tests = [_apart(farthest / ca.sqrt(ca.sumsqr(farthest) + _TINY), e, j, h, b)]
    if parts.linear:
        k = len(parts.linear)
        length = ca.sqrt(ca.sumsqr(e[:k]) + _TINY)
        own = ca.vertcat(e[:k] / length, ca.SX(parts.m - k, 1))
        tests.append(_apart(own, e, j, h, b))
        first = sum((rho[i] * h[i] for i in range(size)), ca.SX(0))
        tests.append(length - first - ca.sqrt(ca.sumsqr(allowed)))
    if missed is not None:
        tests.append(ca.cos(ca.fmin(spread + lean, np.pi)) - missed)
    inverse = ca.horzcat(*[ca.vertcat(*factor.solve([ca.SX(float(i == k)) for i in range(parts.m)])) for k in range(parts.m)])
    y = weighted.T @ inverse
    middle = -(y @ e)
    radius = ca.fabs(ca.SX.eye(size) - y @ j) @ h + ca.fabs(y) @ b + ROUNDING
    low, high = ca.fmax(middle - radius, -h), ca.fmin(middle + radius, h)
    margin = _largest([*tests, *ca.vertsplit(low - high)]) - ROUNDING
    half = ca.fmax((high - low) / 2, 0)
    told = _told(h, half, ca.fabs(middle) + radius, [(rho[k] + _LEAN * leaning[k]) * half[k] for k in range(size)])
    inputs = [c, h, p, r, tolerance, *([way] * along)]
    return Kernel("box of joints", inputs, [margin, c + (low + high) / 2, half, *told, middle, e])


def _told(h: SX, half: SX, reach: SX, widths: list[SX]) -> tuple[SX, SX, SX]:
    """Whether what is left is inside, how much of the volume it is, and where it is widest."""
    inside, volume, which, widest = ca.SX(-1), ca.SX(1), ca.SX(0), widths[0]
    for k, width in enumerate(widths):
        moves = h[k] > 0
        inside = ca.fmax(inside, ca.if_else(moves, reach[k] - h[k], -1))
        volume *= ca.if_else(moves, half[k] / h[k], 1)
        which, widest = ca.if_else(width > widest, k, which), ca.fmax(width, widest)
    return inside, volume, which


def turning(arm: Arm, parts: Parts) -> list[bool]:
    """(n,) True for joints that change the rows of the orientation: of a tool's axis not one that it lies along."""
    if parts.turn == "none":
        return [False] * arm.n
    found = [not joint.prismatic for joint in arm.joints]
    along = arm.tool[:3, 2] @ arm.joints[-1].axis
    if parts.turn == "axis" and abs(abs(along) - 1) < 1e-12:
        found[-1] = False
    return found


def idle(arm: Arm, parts: Parts) -> bool:
    """Whether the last joint moves no row: the tool point lies on its axis, and its turn does not count."""
    last = arm.joints[-1]
    on = np.linalg.norm(np.cross(last.axis, arm.tool[:3, 3])) < 1e-12 * arm.length_unit
    return bool(not last.prismatic and on and not turning(arm, parts)[-1])


def _foot(arm: Arm) -> Array | None:
    """The point of the last axis nearest to the one before it, in the last link's frame; None if that does not turn.

    Of a full pose any point of the tool is known; this one is moved by fewer joints than the tool point, and less.
    """
    last = arm.joints[-1]
    if last.prismatic or arm.n < 2:
        return None
    one, other = arm.joints[-2].axis, last.origin[:3, :3] @ last.axis
    across = 1 - (one @ other) ** 2
    if across < 1e-9:
        return np.zeros(3)
    away = -last.origin[:3, 3]
    along = (away @ other - (away @ one) * (one @ other)) / across
    return np.asarray(along * last.axis)


def _distances(arm: Arm, full: SX, box: tuple[SX, SX], turns: list[bool], point: Array) -> list[SX]:
    """``rho`` of every joint, for a point given in the last link's frame."""
    most, h = _greatest(arm, point, *box), box[1]
    rho: list[SX] = [ca.SX(1)] * arm.n
    beyond = ca.SX(0)
    for k in reversed(range(arm.n)):
        if turns[k]:
            rho[k] = ca.fmin(most[k], ca.sqrt(ca.sumsqr(full[:3, k])) + beyond)
        beyond += rho[k] * h[k]
    return rho


def _greatest(arm: Arm, point: Array, c: SX, h: SX) -> list[SX]:
    """How far from each joint's axis the point can be in the box: the lengths of what lies beyond it.

    Slides count as far as the box goes, not the arm's limits: a lock may be outside them.
    """
    length, found = ca.SX(float(np.linalg.norm(point))), []
    for k, joint in reversed(list(enumerate(arm.joints))):
        if joint.prismatic:
            length += ca.fabs(c[k]) + h[k]
        found.append(length)
        length += float(np.linalg.norm(joint.origin[:3, 3]))
    return found[::-1]


def _higher(rho: list[SX], h: SX, turns: list[bool]) -> tuple[SX, SX]:
    """What derivatives of the position of order 2 and more, and those of order 3 and more, make of it, in any direction."""
    second, third, inner = ca.SX(0), ca.SX(0), ca.SX(0)
    for k, turns_too in enumerate(turns):
        if turns_too:
            outer = inner + h[k]
            second += rho[k] * (outer**2 - inner**2) / 2
            third += rho[k] * (outer**3 - inner**3) / 6
            inner = outer
        else:
            second += rho[k] * h[k] * inner
            third += rho[k] * h[k] * inner**2 / 2
    return second, third


def _bends(second: Callable[[int, int], SX], h: SX, inner: list[bool], outer: list[bool]) -> SX:
    """What the second derivatives at the centre make of each row: ``second`` of a joint and one as near the base or farther."""
    found = ca.SX(0)
    for i in range(len(outer)):
        for k in range(i + 1):
            if inner[k] and outer[i]:
                found += ca.fabs(second(k, i)) * (h[k] * h[i] if k < i else h[i] ** 2 / 2)
    return found


def _least(bends: SX, second: SX, third: SX) -> SX:
    """The lesser bound of each row's remainder."""
    return ca.vertcat(*[ca.fmin(second, bend + third) for bend in ca.vertsplit(ca.densify(bends))])


def _turn(parts: Parts, rotation: SX, spin: SX, r: SX) -> tuple[SX, SX, Callable[[int, int], SX], SX]:
    """Rows of the orientation, their slopes, their second derivatives, and the cosine of the angle that is missed."""
    n = spin.shape[1]
    if parts.turn == "axis":
        axis, wanted = rotation[:, 2], r[:, :2].T
        moved = ca.horzcat(*[ca.cross(spin[:, k], axis) for k in range(n)])
        return wanted @ axis, wanted @ moved, lambda k, i: wanted @ ca.cross(spin[:, k], moved[:, i]), ca.dot(axis, r[:, 2])
    value = sum((ca.cross(r[:, i], rotation[:, i]) / 2 for i in range(3)), ca.SX(3, 1))
    across = r @ rotation.T
    turned = across @ spin
    slope = ca.horzcat(*[(ca.trace(across) * spin[:, k] - across.T @ spin[:, k]) / 2 for k in range(n)])
    row = ca.DM(parts.normal).T if parts.turn == "plane" else ca.DM.eye(3)

    def second(k: int, i: int) -> SX:
        return row @ (ca.cross(turned[:, k], spin[:, i]) / 2 - ca.dot(spin[:, k], spin[:, i]) * value)

    return row @ value, row @ slope, second, (ca.trace(across) - 1) / 2


def _largest(values: list[SX]) -> SX:
    found = values[0]
    for value in values[1:]:
        found = ca.fmax(found, value)
    return found


def _apart(v: SX, e: SX, j: SX, h: SX, b: SX) -> SX:
    """By how much the error in a direction exceeds what the box can make of it."""
    return ca.fabs(ca.dot(v, e)) - ca.dot(ca.fabs(j.T @ v), h) - ca.dot(ca.fabs(v), b)
