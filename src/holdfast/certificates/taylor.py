"""The Taylor form of a reach: which boxes of targets and locked angles one configuration proves.

Around a configuration the free joints follow the target and the locked joint along ``q = q_c + D (delta, s)``, and
``s -> s - g`` maps a box of corrections into itself where the bound ``e(S)`` of what is left of the error is at most S: by
Brouwer's theorem it then stays where it is somewhere, and there g = 0. Everything here is doubles and may be wrong: the
verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

UNIT = 2.0**-24  # rad: centres are written in multiples of it
_ROUNDS = 30  # of the section box, each a little wider than what the one before needs
_TOO_FAR = 0.5  # m of error: no section box will do
_HALVINGS = 4


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

    def followed(self, q: Array) -> tuple[Array, Array, Array]:
        """Tool points (N, 3), axes (N, n, 3) and how the tool point moves about each of them (N, n, 3), m, at q (N, n)."""
        tip, turn, axes, points = np.zeros((len(q), 3)), np.broadcast_to(np.eye(3), (len(q), 3, 3)), [], []
        for k in range(q.shape[1]):
            tip, turn = tip + turn @ self.origins[k], turn @ self.rotations[k]
            axes.append(turn[:, :, 2])
            points.append(tip)
            sine, cosine = np.sin(q[:, k])[:, None], np.cos(q[:, k])[:, None]
            x, y = turn[:, :, 0], turn[:, :, 1]
            turn = np.stack([cosine * x + sine * y, cosine * y - sine * x, turn[:, :, 2]], axis=2)
        tip, turned = tip + turn @ self.origins[-1], np.stack(axes, axis=1)
        return tip, turned, np.cross(turned, tip[:, None] - np.stack(points, axis=1))


class Reach:
    """Configurations that put the first m coordinates of the tool point somewhere, one joint locked or none.

    Args:
        chain: The arm.
        m: 3 (position) or 2 (planar).
        locked: Index of the locked joint; -1: none.
        limits: (n, 2) rad.
    """

    def __init__(self, chain: Chain, m: int, locked: int, limits: Array) -> None:
        self.chain, self.m, self.locked, self.limits = chain, m, locked, limits
        self.n = len(limits)
        self.free = np.arange(self.n) != locked

    def first(self, q: Array) -> tuple[Array, Array]:
        """Tool coordinates (N, m) and Jacobians (N, m, n)."""
        tip, _, columns = self.chain.followed(q)
        return tip[:, : self.m], columns.transpose(0, 2, 1)[:, : self.m]

    def inverse(self, jacobians: Array, damping: float = 0.0) -> Array:
        """(N, n, m) pseudo-inverses on the free joints."""
        some = jacobians * self.free
        gram = some @ some.transpose(0, 2, 1) + damping * np.eye(self.m)
        with np.errstate(all="ignore"):
            try:
                return np.asarray(some.transpose(0, 2, 1) @ np.linalg.inv(gram))
            except np.linalg.LinAlgError:
                return np.asarray(np.linalg.pinv(some))

    def solved(self, q: Array, targets: Array, rounds: int = 8) -> Array:
        """Newton from q (N, n) towards targets (N, m), on the free joints, kept within the limits."""
        q = q.copy()
        for _ in range(rounds):
            at, jacobians = self.first(q)
            step = (self.inverse(jacobians, 1e-8) @ (targets - at)[:, :, None])[:, :, 0]
            size = np.abs(step).max(axis=1, keepdims=True)
            q = np.where(self.free, np.clip(q + step * np.minimum(1.0, 0.5 / np.maximum(size, 1e-12)), *self.limits.T), q)
        return q


@dataclass(frozen=True, eq=False)
class Form:
    """The Taylor forms at configurations, N of them; ``l`` is the coordinates of cell and section together.

    Attributes:
        reach: Whose.
        q: (N, n) centres, rad.
        error: (N, m) at the centres.
        section: (N, n, l) the matrices D, absolute.
        slope: (N, m, l) what is left of the slopes, absolute.
        mixed: (N, m, l, l) second derivatives by two coordinates, absolute, each pair once.
        up, down: (N, m, l) pure ones, their positive and negative parts.
    """

    reach: Reach
    q: Array
    error: Array
    section: Array
    slope: Array
    mixed: Array
    up: Array
    down: Array

    @classmethod
    def at(cls, reach: Reach, q: Array, targets: Array) -> Form:
        """Around q (N, n) for targets (N, m) in the middle."""
        m, fixed = reach.m, reach.locked >= 0
        tip, axes, columns = reach.chain.followed(q)
        jacobians = columns.transpose(0, 2, 1)[:, :m]
        inverse = np.nan_to_num(reach.inverse(jacobians))
        section = np.zeros((len(q), reach.n, 2 * m + fixed))
        section[:, :, :m] = section[:, :, m + fixed :] = inverse
        if fixed:
            section[:, :, m] = -(inverse @ jacobians[:, :, reach.locked, None])[:, :, 0]
            section[:, reach.locked, m] = 1.0
        slope = jacobians @ section
        slope[:, np.arange(m), np.arange(m)] -= 1.0
        slope[:, np.arange(m), m + fixed + np.arange(m)] -= 1.0
        # The second derivative by joint j and a later k is z_j x J_k.
        outer = np.cross(axes[:, :, None], columns[:, None])[..., :m]
        upper = np.triu(np.ones((reach.n, reach.n)))[..., None]
        second = outer * upper + (outer * (1 - upper.transpose(1, 0, 2))).transpose(0, 2, 1, 3)
        forms = section.transpose(0, 2, 1)[:, None] @ second.transpose(0, 3, 1, 2) @ section[:, None]
        pure = np.diagonal(forms, axis1=2, axis2=3)
        mixed = np.abs(np.triu(forms, 1))
        return cls(
            reach, q, tip[:, :m] - targets, np.abs(section), np.abs(slope), mixed, np.maximum(pure, 0), np.maximum(-pure, 0)
        )

    def take(self, which: NDArray[np.intp] | Flags) -> Form:
        """Of some rows."""
        parts = (self.q, self.error, self.section, self.slope, self.mixed, self.up, self.down)
        return Form(self.reach, *(part[which] for part in parts))

    def sides(self, widths: Array) -> tuple[Array, Array, Array]:
        """How far the error less s may be above and below 0 (N, m), and how far joints go (N, n), for half widths (N, l)."""
        far = (self.section @ widths[:, :, None])[:, :, 0]
        third = (np.cumsum(far, axis=1) ** 3 @ self.reach.chain.lengths) / 6
        rest = third[:, None] + (self.slope @ widths[:, :, None])[:, :, 0]
        rest += ((self.mixed @ widths[:, None, :, None])[..., 0] * widths[:, None]).sum(axis=2)
        square = widths[:, :, None] ** 2
        return self.error + rest + (self.up @ square)[:, :, 0] / 2, -self.error + rest + (self.down @ square)[:, :, 0] / 2, far

    def proved(self, cells: Array) -> tuple[Flags, Array]:
        """Which of cells of half widths (N, c) are proved, and section boxes (N, m) of these; of others, where that ended."""
        count, low, high = len(self.q), self.reach.limits[:, 0], self.reach.limits[:, 1]
        good, sections = np.zeros(count, dtype=bool), np.zeros((count, self.reach.m))
        going = np.flatnonzero(np.isfinite(self.error).all(axis=1))
        form, cells = self.take(going), cells[going]
        for _ in range(_ROUNDS):
            s = sections[going]
            above, below, far = form.sides(np.concatenate([cells, s], axis=1))
            e = np.maximum(above, below)
            room = 1.001 * far + 1e-6
            inside = (((form.q - room >= low) & (form.q + room <= high)) | ~self.reach.free).all(axis=1)
            closed = (1.002 * e + 2e-7 <= s).all(axis=1)
            good[going[closed & inside]] = True
            on = ~closed & inside & (e < _TOO_FAR).all(axis=1)
            sections[going[~closed]] = np.minimum(1.05 * e[~closed] + 1e-9, 1.0)
            if not on.any():
                break
            form, cells, going = form.take(on), cells[on], going[on]
        return good, sections

    def scale(self, cells: Array) -> Array:
        """(N,) the largest factor up to 1 by which cells of half widths (N, c) are proved, to 1/16."""
        low, high = np.zeros(len(cells)), np.ones(len(cells))
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            good, _ = self.proved(cells * middle[:, None])
            low, high = np.where(good, middle, low), np.where(good, high, middle)
        return low
