"""Kernels of the Taylor form: error, derivatives and bounds around a configuration, whichever joint is locked."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.grammar import TASKS
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import Cholesky, damped_least_norm

Array = NDArray[np.float64]

PARTS = 16  # of a cell's width: how much of it is proved is told in these
AT_ONCE = 5  # rounds
_ROUNDS = 30  # of the section box in a test, each a little wider than what the one before needs
_TOO_FAR = 0.5  # m or rad of error: no section box will do
_STRIDE = 0.5  # rad in one step of Newton's method
_STRAIGHT = 0.951  # the error of a rotation is 0 for half a turn as well: its cosine must be above this, and its angles
_MOST = 1.45  # rad, all of them together, below this


@dataclass(frozen=True)
class Turns:
    """What is left to turn: rows that are products of the entries of fixed matrices with those of a rotation.

    Attributes:
        off: (3, 3) from the target to the tool.
        weights: (3, 3) of each row.
        kept: (3, 3) the same of the cosine, up to a constant.
        cosine: Of the angle.
        axes: About which the target's angles turn it.
    """

    off: SX
    weights: list[SX]
    kept: SX
    cosine: SX
    axes: list[SX]

    @property
    def values(self) -> SX:
        """(k,) 0 where nothing is left to turn."""
        return ca.vertcat(*[ca.sum1(ca.sum2(weight * self.off)) for weight in self.weights])

    def slopes(self, off: SX) -> SX:
        """(k, 3) by turns about the axes of the base, applied to a matrix."""
        return ca.vertcat(*[_axial(weight @ off.T).T for weight in self.weights])


class Expansion:
    """What is computed of an arm's tool: its point, and where the task asks for it its rotation.

    Free joints are given as ones, (n,), and the locked joint as a one among zeros, (n,), all 0 for a healthy arm. A target is
    the coordinates of its point; where rotations count the angles by which targets turn, or nine numbers of a rotation. A form
    is what of the Taylor form counts: the error (m,); ``|B|`` (n, m), by how much joints follow the section, and the point of
    the target with it; ``|L|`` (n, t + 1), how they follow the t angles and the locked joint; second derivatives by pairs of
    these m + t + 1 coordinates (m, pairs); and how far slides are out, (n,) m.

    Args:
        arm: The arm.
        task: ``planar``, ``planar-pose``, ``position``, ``pointing`` or ``pose``.
        turning: t: 3 where the targets of a pose turn, 1 in the plane, else 0.
        lengths: (n,) m, of what each joint and those before it turn, see :class:`holdfast.certificates.taylor.Chain`.
        slides: (n,) which joints slide.

    Attributes:
        m: Rows.
        linear: So many of them are of the point.
        axes: Numbers of a target.
    """

    def __init__(self, arm: Arm, task: str, turning: int, lengths: Array, slides: NDArray[np.bool_]) -> None:
        self.arm, self.task, self.turning, self.lengths, self.slides = arm, task, turning, lengths, slides
        self.m, self.linear = TASKS[task], 2 if task.startswith("planar") else 3
        self.axes, self.coordinates = self.linear + turning, self.m + turning + 1
        self.pairs = [(a, b) for a in range(self.coordinates) for b in range(a, self.coordinates)]

    @property
    def rotated(self) -> bool:
        """Whether the rotation of the tool counts."""
        return self.m > self.linear

    @property
    def given(self) -> int:
        """Numbers in a target as the kernels take it."""
        return self.linear + (self.turning or 9 if self.rotated else 0)

    # ---- error and derivatives ---------------------------------------------------------------------------------

    def _wanted(self, target: SX) -> tuple[SX, list[SX]]:
        """Rotation of a target, and the axes about which its angles turn it."""
        if not self.turning:
            return ca.reshape(target[3:], 3, 3).T, []
        if self.turning == 1:
            return _turn(2, target[2]), [ca.SX([0, 0, 1])]
        roll, pitch, yaw = (_turn(axis, target[3 + axis]) for axis in range(3))
        return yaw @ pitch @ roll, [(yaw @ pitch)[:, 0], yaw[:, 1], ca.SX([0, 0, 1])]

    def _jacobian(self, q: SX) -> tuple[kinematics.Chain, SX]:
        """(6, n) of the tool's point and rotation."""
        chain = kinematics.chain(self.arm, q)
        return chain, kinematics.jacobian_of(self.arm, chain, chain.position)

    def _rows(self, chain: kinematics.Chain, jacobian: SX) -> SX:
        """(m, n) of a Jacobian: what of it counts, where the tool is turned as it should be."""
        angular = {
            "planar-pose": jacobian[5, :],
            "pointing": (chain.rotation.T @ jacobian[3:, :])[:2, :],
            "pose": jacobian[3:, :],
        }
        return ca.vertcat(jacobian[: self.linear, :], *([angular[self.task]] if self.rotated else []))

    def _turns(self, chain: kinematics.Chain, target: SX) -> Turns:
        """What is left to turn."""
        wanted, axes = self._wanted(target)
        off = chain.rotation @ wanted.T
        if self.task == "pointing":
            toward = wanted[:, 2]
            across = [wanted[:, k] @ toward.T for k in range(2)]
            return Turns(off, across, toward @ toward.T, ca.dot(off @ toward, toward), axes)
        skew = [ca.skew(ca.SX.eye(3)[:, k]) / 2 for k in range(3)]
        return Turns(off, skew[2:] if self.task == "planar-pose" else skew, ca.SX.eye(3) / 2, (ca.trace(off) - 1) / 2, axes)

    def _off(self, chain: kinematics.Chain, target: SX) -> tuple[SX, SX]:
        """Of the point (2 or 3,) m; of the rotation 2 sin(angle / 2) about the axes that count."""
        point = chain.position[: self.linear] - target[: self.linear]
        if not self.rotated:
            return point, ca.SX(0, 1)
        turns = self._turns(chain, target)
        return point, turns.values / ca.sqrt(ca.fmax((1 + turns.cosine) / 2, 1e-12))

    def expanded(self, q: SX, target: SX, whole: bool = False) -> tuple[SX, SX, list[SX]]:
        """Error (m,), slopes (m, n + t) and Hessians of its rows, by joints and angles of the target.

        ``whole``: with one more row where rotations count, the cosine of the angle less 1.
        """
        n, t, linear = self.arm.n, self.turning, self.linear
        chain, jacobian = self._jacobian(q)
        columns, axes = jacobian[:3, :], jacobian[3:, :]
        error = chain.position[:linear] - target[:linear]
        slopes = ca.horzcat(columns[:linear, :], ca.SX(linear, t))
        hessians = [ca.SX(n + t, n + t) for _ in range(self.m + (whole and self.rotated))]
        for j in range(n):
            for k in range(j, n):  # the second derivative by joint j and a later k is z_j x J_k
                second = ca.cross(axes[:, j], columns[:, k])
                for row in range(linear):
                    hessians[row][j, k] = hessians[row][k, j] = second[row]
        if self.rotated:
            # Turning the target turns what is left from the right; all axes of R(q) R', from left to right.
            left = self._turns(chain, target)
            far = 10 * (left.cosine < _STRAIGHT)
            if whole:
                less = ca.vertcat(ca.SX(self.m - linear, 1), 1 if self.task == "pointing" else 1.5)
                left, far = replace(left, weights=[*left.weights, left.kept]), -less
            turns = ca.horzcat(axes, *[-(left.off @ axis) for axis in left.axes])
            error = ca.vertcat(error, left.values + far)
            slopes = ca.vertcat(slopes, left.slopes(left.off) @ turns)
            for k in range(n + t):
                by_k = left.slopes(ca.skew(turns[:, k]) @ left.off)
                for j in range(k + 1):
                    second = by_k @ turns[:, j]
                    for row in range(len(left.weights)):
                        hessians[linear + row][j, k] = hessians[linear + row][k, j] = second[row]
        return error, slopes, hessians

    @property
    def _inputs(self) -> tuple[SX, SX, SX]:
        """Joints, target, which joints are free."""
        return kinematics.joint_symbols(self.arm), ca.SX.sym("x", self.given), ca.SX.sym("free", self.arm.n)

    def _inverse(self, jacobian: SX, free: SX) -> SX:
        """(n, m) pseudo-inverse on the free joints."""
        some = jacobian @ ca.diag(free)
        gram = some @ some.T
        factor = Cholesky([[gram[i, k] for k in range(self.m)] for i in range(self.m)])
        return some.T @ ca.horzcat(*[ca.vertcat(*factor.solve(ca.vertsplit(ca.SX.eye(self.m)[:, k]))) for k in range(self.m)])

    @cached_property
    @recalled
    def form(self) -> Kernel:
        """Joints, target, free and locked joints, how far a locked slide is out at most -> the form."""
        (q, target, free), n, t = self._inputs, self.arm.n, self.turning
        locked, held = ca.SX.sym("locked", n), ca.SX.sym("held", n)
        error, slopes, hessians = self.expanded(q, target)
        inverse = self._inverse(slopes[:, :n], free)
        follow = ca.horzcat(-inverse @ slopes[:, n:], locked - inverse @ (slopes[:, :n] @ locked))
        d = ca.vertcat(ca.horzcat(inverse, follow), ca.horzcat(ca.SX(t, self.m), ca.SX.eye(t), ca.SX(t, 1)))
        forms = [d.T @ hessian @ d for hessian in hessians]
        by_pair = ca.vertcat(*[ca.horzcat(*[form[a, b] for a, b in self.pairs]) for form in forms])
        out = [error, ca.fabs(inverse), ca.fabs(follow), by_pair, ca.fmax(ca.fabs(q), held) * self.slides.astype(float)]
        return Kernel("Taylor form of a reach", [q, target, free, locked, held], [ca.densify(x) for x in out])

    @cached_property
    @recalled
    def whole(self) -> Kernel:
        """Joints and target -> rows with that of the angle, their slopes and their Hessians, one after the other."""
        q, target, _ = self._inputs
        error, slopes, hessians = self.expanded(q, target, whole=True)
        return Kernel("rows of a task", [q, target], [ca.densify(x) for x in (error, slopes, *hessians)])

    # ---- bounds ------------------------------------------------------------------------------------------------

    @property
    def _form(self) -> SX:
        return ca.SX.sym("form", self.m * (1 + len(self.pairs)) + self.arm.n * (self.coordinates + 1))

    def _sides(self, form: SX, cell: SX, section: SX) -> tuple[SX, SX, SX, SX]:
        m, n, t, linear = self.m, self.arm.n, self.turning, self.linear
        sizes = [0, m, m * n, (t + 1) * n, m * len(self.pairs), n]
        error, inverse, follow, second, out = ca.vertsplit(form, np.cumsum(sizes).tolist())
        targets = ca.vertcat(cell[:linear], ca.SX(m - linear, 1))  # what follows the target as it does the section
        wide = ca.vertcat(targets + section, cell[linear:])
        far = ca.reshape(inverse, m, n).T @ wide[:m] + ca.reshape(follow, t + 1, n).T @ wide[m:]
        second = ca.reshape(second, len(self.pairs), m).T
        rest, c = ca.SX(0), ca.SX(0)
        for k in range(n):
            length = float(self.lengths[k])
            if self.slides[k]:
                rest += (c * c * c * (length + out[k] + far[k]) + 3 * c * c * far[k]) / 6
            else:
                c += far[k]
                rest += length / 6 * c * c * c
        for k in range(t):
            c += cell[linear + k]
        above, below = [], []
        for row in range(m):
            both, up, down = rest if row < linear else c * c * c / 6, ca.SX(0), ca.SX(0)
            for column, (a, b) in enumerate(self.pairs):
                value = second[row, column]
                if a < b:
                    both += ca.fabs(value) * wide[a] * wide[b]
                    continue
                square = wide[a] * wide[a]
                if a < linear:
                    both += ca.fabs(value) * cell[a] * section[a]
                    square = cell[a] * cell[a] + section[a] * section[a]
                up, down = up + ca.fmax(value, 0) * square / 2, down + ca.fmax(-value, 0) * square / 2
            above.append(error[row] + both + up)
            below.append(-error[row] + both + down)
        return ca.vertcat(*above), ca.vertcat(*below), far, c

    @cached_property
    @recalled
    def sides(self) -> Kernel:
        """Form, half widths of cell (axes + 1,) and section (m,) -> the error less s above and below 0, how far joints go."""
        form, cell, section = self._form, ca.SX.sym("w", self.axes + 1), ca.SX.sym("s", self.m)
        return Kernel("bounds of a Taylor form", [form, cell, section], list(self._sides(form, cell, section)[:3]))

    @cached_property
    @recalled
    def tests(self) -> Loop:
        """Form, cell and how far joints may go -> how much of the cell is proved, in sixteenths of its width.

        One test comes after the other, until there is nothing between what passed and what failed. The state is a section box
        (m,), which grows from 0 in each; the greatest sixteenths that passed; those that are
        tested now; how many more the next test may have; and the rounds of this one. A test that is the last leaves the box
        where it ended.
        """
        form, cell, section = self._form, ca.SX.sym("w", self.axes + 1), ca.SX.sym("s", self.m)
        room = ca.SX.sym("room", self.arm.n)
        start = state = ca.vertcat(section, *[ca.SX.sym(name) for name in ("passed", "now", "more", "rounds")])
        for _ in range(AT_ONCE):  # a step costs more than what it computes: several rounds in each
            state = self._round(state, form, cell, room)
        return Loop(
            "section box of a cell", start, [form, cell, room], next_state=state, residual=state[self.m + 2], ahead=True
        )

    def _round(self, state: SX, form: SX, cell: SX, room: SX) -> SX:
        """The state after one round: the section box a little wider than what it needs, or the next test."""
        section, (passed, now, more, rounds) = state[: self.m], ca.vertsplit(state[self.m :])
        above, below, far, turned = self._sides(form, cell * (now / PARTS), section)
        e, inside = ca.fmax(above, below), ca.mmax(1.001 * far + 1e-6 - room) <= 0
        if self.rotated:
            inside = ca.logic_and(inside, turned < _MOST)
        closed, over = ca.mmax(1.002 * e + 2e-7 - section) <= 0, more < 1
        good = ca.logic_and(closed, inside)
        lost = ca.logic_or(ca.mmax(e) >= _TOO_FAR, rounds >= _ROUNDS - 1)
        ended = ca.logic_and(ca.logic_not(over), ca.logic_or(closed, ca.logic_or(ca.logic_not(inside), lost)))
        after = ca.if_else(ca.logic_or(over, closed), section, ca.fmin(1.05 * e + 2.5e-7, 1.0))
        last = ca.if_else(good, now >= PARTS - 1, now - passed <= 1)  # nothing is between what passed and what failed
        left = ca.if_else(last, 0, more / 2)
        another = ca.logic_and(ended, left >= 1)
        passed = ca.if_else(ca.logic_and(ended, good), now, passed)
        return ca.vertcat(
            ca.if_else(another, 0, after),
            passed,
            ca.if_else(another, ca.fmin(passed + left, PARTS - 1), now),
            ca.if_else(ended, left, more),
            ca.if_else(ended, 0, rounds + 1),
        )

    # ---- configurations ----------------------------------------------------------------------------------------

    @cached_property
    @recalled
    def newton(self) -> Loop:
        """Joints to a target with an error of one's choice (m,), on the free joints, within limits."""
        q, target, free = self._inputs
        error, low, high = ca.SX.sym("e", self.m), ca.SX.sym("low", self.arm.n), ca.SX.sym("high", self.arm.n)
        chain, jacobian = self._jacobian(q)
        missed = error - ca.vertcat(*self._off(chain, target))  # not the axial part: it is 0 for half a turn as well
        rows = self._rows(chain, jacobian)
        if self.task == "pointing":  # across the axis that is wanted, not the tool's own
            turns = self._turns(chain, target)
            rows = ca.vertcat(rows[:3, :], turns.slopes(turns.off) @ jacobian[3:, :])
        step = damped_least_norm(rows @ ca.diag(free), missed, 1e-8)
        step *= ca.fmin(1, _STRIDE / ca.fmax(ca.mmax(ca.fabs(step)), 1e-12))
        after = ca.fmin(ca.fmax(q + step, low), high) * free + q * (1 - free)
        return Loop(
            "configuration of a target", q, [target, error, free, low, high], next_state=after, residual=ca.sumsqr(missed)
        )

    @cached_property
    @recalled
    def missed(self) -> Kernel:
        """Joints and target -> how far the tool is from it, m, and by how much it is turned away, rad."""
        q, target, _ = self._inputs
        far = [ca.sqrt(ca.sumsqr(x)) if x.numel() else ca.SX(0) for x in self._off(self._jacobian(q)[0], target)]
        return Kernel("distance from a target", [q, target], far)

    @cached_property
    @recalled
    def along(self) -> Kernel:
        """Joints, a move of them and which are free -> what of it keeps the tool where it is, to first order."""
        (q, _, free), move = self._inputs, ca.SX.sym("d", self.arm.n)
        jacobian, some = self._rows(*self._jacobian(q)), move * free
        kept = some - self._inverse(jacobian, free) @ (jacobian @ some)
        return Kernel("self-motion of a reach", [q, move, free], [kept])


def _turn(axis: int, angle: SX) -> SX:
    """The rotation about a coordinate axis."""
    i, j, made = (axis + 1) % 3, (axis + 2) % 3, ca.SX.eye(3)
    made[i, i], made[j, j], made[i, j], made[j, i] = ca.cos(angle), ca.cos(angle), -ca.sin(angle), ca.sin(angle)
    return made


def _axial(a: SX) -> SX:
    """(3,) the vector whose product with z is that of the matrix [z] with a."""
    return ca.vertcat(a[2, 1] - a[1, 2], a[0, 2] - a[2, 0], a[1, 0] - a[0, 1])
