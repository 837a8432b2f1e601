"""The Taylor form of a reach: which boxes of targets and locked angles one configuration proves.

Around a configuration the free joints follow the target and the locked joint along ``q = q_c + D (delta, s)``, and
``s -> s - g`` maps a box of corrections into itself where the bound ``e(S)`` of what is left of the error is at most S: by
Brouwer's theorem it then stays where it is somewhere, and there g = 0. Everything here is doubles and may be wrong: the
verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import Cholesky, damped_least_norm

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

UNIT = 2.0**-24  # rad: centres are written in multiples of it
_ROUNDS = 30  # of the section box, each a little wider than what the one before needs
_TOO_FAR = 0.5  # m of error: no section box will do
_HALVINGS = 4
_STRIDE = 0.5  # rad in one step of Newton's method
_NEVER = 1e6  # rad, for a limit that is not there


@dataclass(frozen=True, eq=False)
class Chain:
    """Revolute joints about the z axes of their frames, as a certificate writes them.

    Attributes:
        rotations: (n + 1, 3, 3) of each joint's frame in the one before, the tool's last.
        origins: (n + 1, 3) likewise, m.
        lengths: (n,) m, of what joint k and those before it turn and joint k + 1 does not.
    """

    rotations: Array
    origins: Array
    lengths: Array

    @classmethod
    def of(cls, arm: Arm) -> Chain:
        """An arm's, its frames turned so that every axis is z, its base in the first of them."""
        frames, back = [], np.eye(4)
        for joint in arm.joints:
            to_axis = np.eye(4)
            across = np.linalg.svd(joint.axis[None])[2][1]
            to_axis[:3, :3] = np.column_stack([across, np.cross(joint.axis, across), joint.axis])
            frames.append(back @ joint.origin @ to_axis)
            back = to_axis.T
        frames[0] = arm.base @ frames[0]
        frames.append(back @ arm.tool)
        rotations, origins = np.array([f[:3, :3] for f in frames]), np.array([f[:3, 3] for f in frames])
        links = []
        for k in range(arm.n):
            link = origins[k + 1] * [1, 1, 0]
            if k + 1 < arm.n:
                link = link + rotations[k + 1] @ [0, 0, origins[k + 2][2]]
            links.append(float(np.linalg.norm(link)))
        return cls(rotations, origins, np.array(links))


class Kernels:
    """What is computed of an arm's first m coordinates of the tool point, whichever joint is locked: one kernel for each.

    Free joints are given as ones, (n,), and the locked joint as a one among zeros, (n,), all 0 for a healthy arm. A form is
    what of the Taylor form counts: the error (m,); ``|B|`` (n, m), by how much joints follow the target, and ``|L|`` (n,), the
    locked joint; second derivatives by pairs of these m + 1 coordinates (m, pairs).
    """

    def __init__(self, arm: Arm, m: int) -> None:
        self.arm, self.m = arm, m
        self.pairs = [(a, b) for a in range(m + 1) for b in range(a, m + 1)]
        self.lengths = Chain.of(arm).lengths

    @property
    def _q(self) -> tuple[SX, SX, SX, SX]:
        """Joints, tool coordinates, Jacobian and axes."""
        q = kinematics.joint_symbols(self.arm)
        chain = kinematics.chain(self.arm, q)
        jacobian = kinematics.jacobian_of(self.arm, chain, chain.position)
        return q, chain.position[: self.m], jacobian[:3, :], jacobian[3:, :]

    def _inverse(self, jacobian: SX, free: SX) -> SX:
        """(n, m) pseudo-inverse on the free joints."""
        some = jacobian[: self.m, :] @ ca.diag(free)
        gram = some @ some.T
        factor = Cholesky([[gram[i, k] for k in range(self.m)] for i in range(self.m)])
        return some.T @ ca.horzcat(*[ca.vertcat(*factor.solve(ca.vertsplit(ca.SX.eye(self.m)[:, k]))) for k in range(self.m)])

    @cached_property
    @recalled
    def form(self) -> Kernel:
        """Joints, target (m,), free and locked joints -> the form."""
        q, tip, jacobian, axes = self._q
        target, free, locked = ca.SX.sym("x", self.m), ca.SX.sym("free", self.arm.n), ca.SX.sym("locked", self.arm.n)
        inverse = self._inverse(jacobian, free)
        follow = locked - inverse @ (jacobian[: self.m, :] @ locked)
        d = ca.horzcat(inverse, follow)
        n, hessians = range(self.arm.n), [ca.SX(self.arm.n, self.arm.n) for _ in range(self.m)]
        for j in n:
            for k in n[j:]:  # the second derivative by joint j and a later k is z_j x J_k
                second = ca.cross(axes[:, j], jacobian[:, k])
                for row, hessian in enumerate(hessians):
                    hessian[j, k] = hessian[k, j] = second[row]
        forms = [d.T @ hessian @ d for hessian in hessians]
        by_pair = ca.vertcat(*[ca.horzcat(*[form[a, b] for a, b in self.pairs]) for form in forms])
        out = [tip - target, ca.fabs(inverse), ca.fabs(follow), by_pair]
        return Kernel("Taylor form of a reach", [q, target, free, locked], [ca.densify(x) for x in out])

    @property
    def _form(self) -> SX:
        return ca.SX.sym("form", self.m * (1 + len(self.pairs)) + self.arm.n * (self.m + 1))

    def _sides(self, form: SX, cell: SX, section: SX) -> tuple[SX, SX, SX]:
        m, n = self.m, self.arm.n
        error, inverse, follow, second = ca.vertsplit(form, np.cumsum([0, m, m * n, n, m * len(self.pairs)]).tolist())
        wide = ca.vertcat(cell[:m] + section, cell[m])
        far = ca.reshape(inverse, m, n).T @ wide[:m] + follow * wide[m]
        second = ca.reshape(second, len(self.pairs), m).T
        rest, c = ca.SX(0), ca.SX(0)
        for k in range(self.arm.n):
            c += far[k]
            rest += float(self.lengths[k]) / 6 * c * c * c
        above, below = [], []
        for row in range(m):
            both, up, down = rest, ca.SX(0), ca.SX(0)
            for column, (a, b) in enumerate(self.pairs):
                value = second[row, column]
                if a < b:
                    both += ca.fabs(value) * wide[a] * wide[b]
                    continue
                square = cell[a] * cell[a]
                if a < m:  # it is followed by the target's coordinate and by the section's
                    both += ca.fabs(value) * cell[a] * section[a]
                    square += section[a] * section[a]
                up, down = up + ca.fmax(value, 0) * square / 2, down + ca.fmax(-value, 0) * square / 2
            above.append(error[row] + both + up)
            below.append(-error[row] + both + down)
        return ca.vertcat(*above), ca.vertcat(*below), far

    @cached_property
    @recalled
    def sides(self) -> Kernel:
        """Form, half widths of cell (m + 1,) and section (m,) -> the error less s above and below 0, how far joints go."""
        form, cell, section = self._form, ca.SX.sym("w", self.m + 1), ca.SX.sym("s", self.m)
        return Kernel("bounds of a Taylor form", [form, cell, section], list(self._sides(form, cell, section)))

    @cached_property
    @recalled
    def rounds(self) -> Loop:
        """The section box, and 1 where it is found or -1 where none is: each a little wider than what the one before needs."""
        form, cell, section, verdict = self._form, ca.SX.sym("w", self.m + 1), ca.SX.sym("s", self.m), ca.SX.sym("v")
        q, free, low, high = (ca.SX.sym(name, self.arm.n) for name in ("q", "free", "low", "high"))
        above, below, far = self._sides(form, cell, section)
        e, room = ca.fmax(above, below), 1.001 * far + 1e-6
        beyond = ca.fmax(low - (q - room), q + room - high) * free
        inside = ca.mmax(beyond) <= 0
        closed = ca.mmax(1.002 * e + 2e-7 - section) <= 0
        lost = ca.logic_or(ca.logic_not(inside), ca.mmax(e) >= _TOO_FAR)
        now = ca.if_else(closed, ca.if_else(inside, 1.0, -1.0), ca.if_else(lost, -1.0, 0.0))
        after = ca.if_else(closed, section, ca.fmin(1.05 * e + 1e-9, 1.0))
        return Loop(
            "section box of a cell",
            ca.vertcat(section, verdict),
            [form, cell, q, free, low, high],
            next_state=ca.vertcat(after, now),
            residual=1 - ca.fabs(now),
            ahead=True,
        )

    @cached_property
    @recalled
    def newton(self) -> Loop:
        """Joints to a target (m,), on the free joints, within limits."""
        q, tip, jacobian, _ = self._q
        target, free = ca.SX.sym("x", self.m), ca.SX.sym("free", self.arm.n)
        low, high = ca.SX.sym("low", self.arm.n), ca.SX.sym("high", self.arm.n)
        missed = target - tip
        step = damped_least_norm(jacobian[: self.m, :] @ ca.diag(free), missed, 1e-8)
        step *= ca.fmin(1, _STRIDE / ca.fmax(ca.mmax(ca.fabs(step)), 1e-12))
        after = ca.fmin(ca.fmax(q + step, low), high) * free + q * (1 - free)
        return Loop("configuration of a target", q, [target, free, low, high], next_state=after, residual=ca.sumsqr(missed))

    @cached_property
    @recalled
    def along(self) -> Kernel:
        """Joints, a move of them and which are free -> what of the move keeps the tool where it is, to first order."""
        q, _, jacobian, _ = self._q
        move, free = ca.SX.sym("d", self.arm.n), ca.SX.sym("free", self.arm.n)
        move_free = move * free
        kept = move_free - self._inverse(jacobian, free) @ (jacobian[: self.m, :] @ move_free)
        return Kernel("self-motion of a reach", [q, move, free], [kept])


class Reach:
    """Configurations that put the first m coordinates of the tool point somewhere, one joint locked or none.

    Args:
        arm: The arm.
        m: 3 (position) or 2 (planar).
        locked: Index of the locked joint; -1: none.
        limits: (n, 2) rad.
    """

    def __init__(self, arm: Arm, m: int, locked: int, limits: Array) -> None:
        self.arm, self.m, self.locked, self.limits = arm, m, locked, limits
        self.n = arm.n
        self.free = np.arange(self.n) != locked
        self.kernels = Kernels(arm, m)
        self._free, self._at = self.free.astype(float), (~self.free).astype(float)
        self._limits = np.clip(limits.T, -_NEVER, _NEVER)

    @property
    def lengths(self) -> Array:
        """(n,) m, by which a joint moves the tool at most where it alone turns, and more."""
        return self.kernels.lengths

    @property
    def redundant(self) -> bool:
        """Whether joints may move while the tool does not."""
        return bool(self.free.sum() > self.m)

    def placed(self, q: Array, at: Array) -> Array:
        """Configurations (N, n) with the locked joint where targets and locked angles (N, A) say."""
        if self.locked < 0:
            return q
        q = q.copy()
        q[:, self.locked] = at[:, -1]
        return q

    def missed(self, q: Array, targets: Array) -> Array:
        """(N,) m from the tool at q (N, n) to targets (N, m)."""
        return np.asarray(np.linalg.norm(self.arm.forward_kinematics(q)[:, : self.m, 3] - targets, axis=1))

    def solved(self, q: Array, targets: Array, rounds: int = 8) -> Array:
        """Newton from q (N, n) towards targets (N, m), on the free joints, kept within the limits."""
        fixed = np.tile(np.concatenate([self._free, *self._limits]), (len(q), 1))
        return self.kernels.newton.run(q, np.concatenate([targets, fixed], axis=1), 1e-26, rounds).state

    def along(self, q: Array, moves: Array) -> Array:
        """Of moves (N, n) at q (N, n), what keeps the tool where it is, to first order."""
        return self.kernels.along.rows(q, moves, self._free)


@dataclass(frozen=True, eq=False)
class Form:
    """The Taylor forms at configurations, N of them.

    Attributes:
        reach: Whose.
        q: (N, n) centres, rad.
        parts: (N, p), see :class:`Kernels`; NaN where the arm is singular.
    """

    reach: Reach
    q: Array
    parts: Array

    @classmethod
    def at(cls, reach: Reach, q: Array, targets: Array) -> Form:
        """Around q (N, n) for targets (N, m) in the middle."""
        return cls(reach, q, reach.kernels.form.rows(q, targets, reach._free, reach._at))

    @property
    def error(self) -> Array:
        """(N, m) m, of the tool at the centres."""
        return self.parts[:, : self.reach.m]

    def take(self, which: NDArray[np.intp] | Flags) -> Form:
        """Of some rows."""
        return Form(self.reach, self.q[which], self.parts[which])

    def sides(self, cells: Array, sections: Array) -> tuple[Array, Array, Array]:
        """How far the error less s may be above and below 0 (N, m), and how far joints go (N, n), for half widths of both."""
        above, below, far = self.reach.kernels.sides(self.parts, self._whole(cells), sections)
        return above, below, far

    def _whole(self, cells: Array) -> Array:
        """With 0 for the angle of the lock of a healthy arm."""
        return cells if cells.shape[1] > self.reach.m else np.concatenate([cells, np.zeros((len(cells), 1))], axis=1)

    def proved(self, cells: Array) -> tuple[Flags, Array]:
        """Which of cells of half widths (N, c) are proved, and section boxes (N, m) of these; of others, where that ended."""
        r, count = self.reach, len(self.q)
        fixed = np.tile(np.concatenate([r._free, *r._limits]), (count, 1))
        parameters = np.concatenate([self.parts, self._whole(cells), self.q, fixed], axis=1)
        found = r.kernels.rounds.run(np.zeros((count, r.m + 1)), parameters, 0.5, _ROUNDS).state
        return found[:, -1] == 1, np.nan_to_num(found[:, :-1])

    def scale(self, cells: Array) -> Array:
        """(N,) the largest factor up to 1 by which cells of half widths (N, c) are proved, to 1/16."""
        low, high = np.zeros(len(cells)), np.ones(len(cells))
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            good, _ = self.proved(cells * middle[:, None])
            low, high = np.where(good, middle, low), np.where(good, high, middle)
        return low
