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
from holdfast.certificates.expansions import PARTS, Expansion

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

UNIT = 2.0**-24  # rad: centres are written in multiples of it
_STEPS = 40  # of tests, each of several rounds
_LOST = 1e6  # m: the error where the arm is singular
_NEVER = 1e6  # rad or m, for a limit that is not there
_FAR = 5.0  # m: a slide without limits is not tried beyond


@dataclass(frozen=True, eq=False)
class Chain:
    """Joints about or along the z axes of their frames, as a certificate writes them.

    Attributes:
        rotations: (n + 1, 3, 3) of each joint's frame in the one before, the tool's last.
        origins: (n + 1, 3) likewise, m.
        lengths: (n,) m, of what joint k and those before it turn and joint k + 1 does not; of a slide without its value.
        slides: (n,) which joints slide.
    """

    rotations: Array
    origins: Array
    lengths: Array
    slides: Flags

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
        links, slides = [], [*arm.prismatic, True]
        for k in range(arm.n):
            link = origins[k + 1] * [1, 1, slides[k]]
            if not slides[k + 1]:
                link = link + rotations[k + 1] @ [0, 0, origins[k + 2][2]]
            links.append(float(np.linalg.norm(link)))
        return cls(rotations, origins, np.array(links), arm.prismatic)

    def nearest(self, k: int) -> tuple[float, float] | None:
        """Where the axes of joint k and the next are nearest to each other: heights on them, m; None if they are parallel."""
        turn, place = self.rotations[k + 1][:, 2], self.origins[k + 1]
        across = turn[:2] @ turn[:2]
        if across < 1e-12:
            return None
        along = -(place[:2] @ turn[:2]) / across
        return float(place[2] + along * turn[2]), float(along)


class Reach:
    """Configurations that put the tool somewhere, one joint locked or none.

    Args:
        arm: The arm.
        task: ``planar``, ``planar-pose``, ``position``, ``pointing`` or ``pose``.
        locked: Index of the locked joint; -1: none.
        limits: (n, 2) rad.
        rotation: (3, 3) of the tool, where it counts; None: the last numbers of a target are roll, pitch and yaw, in the plane
            yaw alone.
        angle: (2,) where the joint may be locked, rad or m; of a joint that turns it does not matter.

    Attributes:
        axes: Numbers of a target: 2 or 3 coordinates, m, then roll, pitch and yaw, rad, if targets turn.
        linear: So many of them are coordinates.
        slides: (n,) which joints slide.
    """

    def __init__(
        self, arm: Arm, task: str, locked: int, limits: Array, rotation: Array | None = None, angle: Array | None = None
    ) -> None:
        self.arm, self.locked, self.limits = arm, locked, limits
        self.n = arm.n
        at = np.arange(self.n) == locked
        self.still = ~at & (limits[:, 0] == limits[:, 1])
        self.free = ~at & ~self.still
        self.slides = arm.prismatic
        turning = {"pose": 3, "planar-pose": 1}.get(task, 0) if rotation is None else 0
        self.expansion = Expansion(arm, task, turning, _lengths(arm, task), self.slides)
        self.m, self.rotated = self.expansion.m, self.expansion.rotated
        self.axes, self.linear = self.expansion.axes, self.expansion.linear
        self._rotation = np.empty(0) if rotation is None else np.asarray(rotation).ravel()
        self._free, self._at = self.free.astype(float), at.astype(float)
        held = 0.0 if angle is None else float(np.abs(angle).max())
        self._held = self.slides * at * held
        self._limits = np.clip(limits.T, -_NEVER, _NEVER)

    @property
    def swing(self) -> float:
        """By how many m the locked joint moves the tool at most, for each rad or m."""
        if self.slides[self.locked]:
            return 1.0
        return float(self.expansion.lengths.sum() + np.abs(self.spans[self.slides]).max(axis=1).sum())

    @property
    def spans(self) -> Array:
        """(n, 2) rad and m, limits where there are any, and all that is worth a try where there are none."""
        most = np.where(self.slides, _FAR, np.pi)[:, None]
        return np.clip(self.limits, -most, most)

    @property
    def redundant(self) -> bool:
        """Whether joints may move while the tool does not."""
        return bool(self.free.sum() > self.m)

    def placed(self, q: Array, at: Array) -> Array:
        """Configurations (N, n) with the locked joint where targets and locked angles (N, A) say, others being still."""
        q = np.where(self.still, self.limits[:, 0], q)
        if self.locked >= 0:
            q[:, self.locked] = at[:, -1]
        return q

    def given(self, targets: Array) -> Array:
        """Targets (N, axes) as the kernels take them."""
        return np.concatenate([targets, np.tile(self._rotation, (len(targets), 1))], axis=1)

    def missed(self, q: Array, targets: Array) -> Array:
        """(N, 2) m from the tool at q (N, n) to targets (N, axes), and by how much it is turned away, rad."""
        return self.expansion.missed.rows(q, self.given(targets))

    def solved(self, q: Array, targets: Array, rounds: int = 8, error: Array | None = None) -> Array:
        """Newton from q (N, n) towards targets (N, axes), or an error (N, m), on the free joints, kept within the limits."""
        missed = np.zeros((len(q), self.m)) if error is None else error
        fixed = np.tile(np.concatenate([self._free, *self._limits]), (len(q), 1))
        given = np.concatenate([self.given(targets), missed, fixed], axis=1)
        return self.expansion.newton.run(q, given, 1e-26, rounds).state

    def along(self, q: Array, moves: Array) -> Array:
        """Of moves (N, n) at q (N, n), what keeps the tool where it is, to first order."""
        return self.expansion.along.rows(q, moves, self._free)


def _lengths(arm: Arm, task: str) -> Array:
    """(n,) m, of what joints turn; in the plane heights count nothing."""
    chain = Chain.of(arm)
    if task != "planar-pose":
        return chain.lengths
    return np.asarray(np.linalg.norm(chain.origins[1:, :2], axis=1))


@dataclass(frozen=True, eq=False)
class Form:
    """The Taylor forms at configurations, N of them.

    Attributes:
        reach: Whose.
        q: (N, n) centres, rad.
        parts: (N, p), see :class:`holdfast.certificates.expansions.Expansion`; NaN where the arm is singular.
    """

    reach: Reach
    q: Array
    parts: Array

    @classmethod
    def at(cls, reach: Reach, q: Array, targets: Array) -> Form:
        """Around q (N, n) for targets (N, axes) in the middle."""
        return cls(reach, q, reach.expansion.form.rows(q, reach.given(targets), reach._free, reach._at, reach._held))

    @property
    def error(self) -> Array:
        """(N, m) m, and of rotations the axial part, of the tool at the centres."""
        return self.parts[:, : self.reach.m]

    def take(self, which: NDArray[np.intp] | Flags) -> Form:
        """Of some rows."""
        return Form(self.reach, self.q[which], self.parts[which])

    def sides(self, cells: Array, sections: Array) -> tuple[Array, Array, Array]:
        """How far the error less s may be above and below 0 (N, m), and how far joints go (N, n), for half widths of both."""
        above, below, far = self.reach.expansion.sides(self.parts, self._whole(cells), sections)
        return above, below, far

    def _whole(self, cells: Array) -> Array:
        """With 0 for the angle of the lock of a healthy arm."""
        return cells if cells.shape[1] > self.reach.axes else np.concatenate([cells, np.zeros((len(cells), 1))], axis=1)

    def proved(self, cells: Array) -> Flags:
        """Which of cells of half widths (N, c) are proved."""
        return np.asarray(self._tested(cells, np.array([PARTS - 1.0, PARTS, 1])) == PARTS)

    def scale(self, cells: Array, least: Array | None = None) -> Array:
        """(N,) the largest factor below 1 by which cells of half widths (N, c) are proved, to 1/16.

        ``least`` (N,): where it is no more than that, it is told to be that, after a test instead of several.
        """
        if least is None:
            return self._tested(cells, np.array([0, PARTS / 2, PARTS / 2])) / PARTS
        passed = PARTS * least
        more = np.where(passed + 1 < PARTS, 2 ** np.ceil(np.log2(np.maximum(PARTS - 1 - passed, 1))), 0)
        first = np.column_stack([passed, passed + 1, more])
        first[passed == 0] = 0, PARTS / 2, PARTS / 2  # no test passes of cells too small for its margins
        return self._tested(cells, first) / PARTS

    def _tested(self, cells: Array, begin: Array) -> Array:
        """(N,) how many sixteenths of cells pass.

        ``begin``: How many are known to, how many are tested first, and a power of 2, twice that by which others are more.
        """
        r, (low, high) = self.reach, self.reach._limits
        room = np.where(r.free, np.minimum(self.q - low, high - self.q), _NEVER)
        parameters = np.concatenate([self.parts, self._whole(cells), room], axis=1)
        state = np.zeros((len(self.q), r.m + 4))
        state[:, r.m : r.m + 3] = begin
        found = r.expansion.tests.run(state, parameters, 0.5, _STEPS).state
        return np.nan_to_num(found[:, r.m])

    def worst_axis(self, cells: Array, may: Flags) -> Index:
        """(N,) the axis among those that may (N, c) whose halving leaves least error and least beyond the limits."""
        reach, (low, high) = self.reach, self.reach.limits.T
        price = np.full(cells.shape, np.inf)
        for axis in np.flatnonzero(may.any(axis=0)):
            narrow = cells.copy()
            narrow[:, axis] /= 2
            above, below, _ = self.sides(narrow, np.zeros((len(cells), reach.m)))
            e = np.nan_to_num(np.maximum(above, below), nan=_LOST)
            _, _, far = self.sides(narrow, np.maximum(e, 0))
            beyond = np.maximum(np.maximum(low - (self.q - far), self.q + far - high), 0) * reach.free
            price[:, axis] = np.where(may[:, axis], e.sum(axis=1) + beyond.sum(axis=1), np.inf)
        return np.asarray(np.where(np.isfinite(price).any(axis=1), price.argmin(axis=1), 0), dtype=np.int64)
