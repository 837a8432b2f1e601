"""Which cells of lock instants and path one configuration proves, and where one motion goes on from cell to cell.

The error of the locked arm is that of its tool from the tool of the healthy arm, so that both chains are expanded. Everything
here is doubles and may be wrong: the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.taylor import Chain

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

SEGMENT = 1 << 20  # instants to a segment
UNIT = 2.0**-28  # rad: centres are written in multiples of it, so that near singularities little is lost
_ROUNDS, _TIGHTER = 30, 6  # of the section box: wider until it does, then narrower
_MARGIN, _LEAST = 1.003, 1e-9  # of what the verifier must be able to show
_STRAIGHT, _TURN = 2.91, 1.19  # of rotations: the trace in the middle, and what is turned from there
_SIZES = 0.25 * 0.5 ** np.arange(27)  # of boxes with one solution, tried one after the other
_NEWTON, _MET = 6, 1e-10
_ROOM = 0.4  # of a box with one solution: so narrow must that be in which it is found, for the next cell to take it over
_STRIDE, _NEAR = SEGMENT // 2, 1e-6  # of the look ahead: instants, m and rad
_NEVER = 10.0  # m and rad: no section box is so wide


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of slabs, N of them: instants, in parts of a segment.

    Attributes:
        begin, stop: (N,) the slab of lock instants, in one segment.
        start, end: (N,) the cell of the path, in one segment.
    """

    begin: Ints
    stop: Ints
    start: Ints
    end: Ints

    @property
    def half(self) -> Array:
        """(N, 2) half widths of both, in segments."""
        return np.stack([self.stop - self.begin, self.end - self.start], axis=1) / (2 * SEGMENT)


@dataclass(frozen=True, eq=False)
class Forms:
    """What is found in cells, N of them, each with as many columns as coordinates: lock, path, tube, section.

    Attributes:
        q: (N, n) centres, rad.
        follow: (N, m, columns) how free joints follow the coordinates.
        half: (N, columns) half widths of these, the section's as small as it may be.
        only: (N, m) of the section box in which there is one solution.
        good: (N,) whether that is shown, and within the limits.
    """

    q: Array
    follow: Array
    half: Array
    only: Array
    good: Flags

    def take(self, which: Ints) -> Forms:
        """Of some of them."""
        return Forms(*(getattr(self, field.name)[which] for field in fields(self)))

    def joined(self, others: Forms) -> Forms:
        """With others behind them."""
        return Forms(*(np.concatenate([getattr(one, field.name) for one in (self, others)]) for field in fields(self)))

    def replaced(self, others: Forms, where: Flags) -> Forms:
        """With some of others instead."""
        both = self.joined(others)
        return both.take(np.arange(len(where)) + len(where) * where)


class Following:
    """A locked arm that follows the tool of the healthy one.

    Args:
        chain: The arm.
        knots: (K + 1, n) of the healthy motion, rad.
        m: Rows: 2, 3 or 6.
        still: The locked joint, then those that go on with the healthy motion.
        tube: (m,) half widths, m and rad; or none, (0,).
        limits: (n, 2) rad.
    """

    def __init__(self, chain: Chain, knots: Array, m: int, still: list[int], tube: Array, limits: Array) -> None:
        self.chain, self.knots, self.m, self.still, self.tube, self.limits = chain, knots, m, still, tube, limits
        self.n = knots.shape[1]
        self.free = [k for k in range(self.n) if k not in still]
        self._linear = min(3, m)

    def healthy(self, twice: Ints, end: Ints) -> tuple[Array, Array]:
        """Joints of the healthy motion at half of ``twice``, and rates over the segments that end there."""
        k = (end - 1) // SEGMENT
        rates = self.knots[k + 1] - self.knots[k]
        return self.knots[k] + rates * (twice / (2 * SEGMENT) - k)[:, None], rates

    def placed(self, q: Array, cells: Cells) -> Array:
        """Configurations (N, n) with the joints that are not free where they are in the middles of cells."""
        q = q.copy()
        q[:, self.still[0]] = self.healthy(cells.begin + cells.stop, cells.stop)[0][:, self.still[0]]
        q[:, self.still[1:]] = self.healthy(cells.start + cells.end, cells.end)[0][:, self.still[1:]]
        return q

    def solved(self, q: Array, cells: Cells) -> Array:
        """Newton from q (N, n) to the middles of cells, written in units of the file."""
        q, (goal, _) = self.placed(q, cells), self.healthy(cells.start + cells.end, cells.end)
        target = self._moved(goal)
        for _ in range(_NEWTON):
            at = self._moved(q)
            error, slope = self._missed(at, target)
            if np.abs(error).max(initial=0.0) < _MET:
                break
            q[:, self.free] -= np.clip(_solved(slope[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)
        q[:, self.free] = np.round(q[:, self.free] / UNIT) * UNIT
        return q

    def forms(self, q: Array, cells: Cells) -> Forms:
        """Around centres q (N, n) of cells."""
        m, n, tube = self.m, self.n, len(self.tube)
        goal, along = self.healthy(cells.start + cells.end, cells.end)
        rate = self.healthy(cells.begin + cells.stop, cells.stop)[1]
        at, target = self._moved(q), self._moved(goal)
        error, own = self._missed(at, target)
        slopes = np.concatenate([own, self._theirs(at, target)], axis=2)
        d = np.zeros((len(q), 2 * n, 2 + tube + m))
        d[:, self.still[0], 0] = rate[:, self.still[0]]
        d[:, self.still[1:], 1] = along[:, self.still[1:]]
        d[:, n:, 1] = along
        jacobian = slopes[:, :, self.free]
        inverse = _solved(jacobian, np.broadcast_to(np.eye(m), jacobian.shape))
        d[:, self.free, :2] = -inverse @ (slopes @ d[:, :, :2])
        d[:, self.free, 2:] = np.concatenate([inverse] * (2 if tube else 1), axis=2)
        second = self._bent(at, target, d)
        left = np.abs(slopes @ d - np.concatenate([np.zeros((m, 2)), *[np.eye(m)] * (2 if tube else 1)], axis=1))
        half = np.concatenate([cells.half, np.tile(self.tube, (len(q), 1)), np.zeros((len(q), m))], axis=1)
        given, bend = (np.abs(d), left, second), 1 - np.eye(half.shape[1])
        s = half[:, -m:]
        for k in range(_ROUNDS + _TIGHTER):
            e, far, turned = self._excess(error, *given, half, bend)
            closed = np.asarray(((_MARGIN * e + _LEAST <= s) & (s < 1)).all(axis=1))
            s[:] = np.where(closed[:, None], s if k < _ROUNDS else _MARGIN * e + 1.01 * _LEAST, 1.05 * e + 2 * _LEAST)
            np.clip(np.nan_to_num(s, nan=_NEVER), 0, _NEVER, out=s)
        only, one = np.zeros_like(s), np.zeros(len(q), dtype=bool)
        for size in _SIZES:
            wide = np.where(one[:, None], only, s + size)
            one |= self._contracts(*given, half, wide)
            only = np.where(one[:, None], wide, only)
        low, high = self.limits[self.free].T
        reach = 1.001 * far[:, self.free] + 1e-7
        closed &= (s < _ROOM * only).all(axis=1)
        good = closed & one & ((q[:, self.free] - reach >= low) & (q[:, self.free] + reach <= high)).all(axis=1)
        if m > 3:
            good &= (turned < _TURN) & (np.einsum("nij,nij->n", at[1], target[1]) > _STRAIGHT)
        return Forms(q, d[:, self.free], half, only, good)

    def begins(self, forms: Forms, cells: Cells) -> Flags:
        """Whether configurations at all lock instants of slabs are the solutions of cells."""
        q, rate = (x[:, self.free] for x in self.healthy(cells.begin + cells.stop, cells.stop))
        ahead = (cells.begin + cells.stop - cells.start - cells.end) / (2 * SEGMENT)
        lock, path = forms.follow[:, :, 0], forms.follow[:, :, 1]
        away = np.stack([q - forms.q[:, self.free] - path * ahead[:, None], (rate - lock - path) * forms.half[:, :1]], axis=2)
        corrections = _solved(forms.follow[:, :, -self.m :], away)
        return np.asarray((_MARGIN * np.abs(corrections).sum(axis=2) + _LEAST < forms.only).all(axis=1))

    def goes_on(self, before: Forms, forms: Forms) -> Flags:
        """Whether what is found in a cell is what was found in the one before it, on the face between them."""
        face = before.q[:, self.free] - forms.q[:, self.free]
        face = face + before.follow[:, :, 1] * before.half[:, 1:2] + forms.follow[:, :, 1] * forms.half[:, 1:2]
        kept = [k for k in range(before.half.shape[1] - self.m) if k != 1]
        moved = (before.follow - forms.follow)[:, :, kept] * before.half[:, None, kept]
        found = before.follow[:, :, -self.m :] * before.half[:, None, -self.m :]
        corrections = _solved(forms.follow[:, :, -self.m :], np.concatenate([face[:, :, None], moved, found], axis=2))
        return np.asarray((_MARGIN * np.abs(corrections).sum(axis=2) + _LEAST < forms.only).all(axis=1))

    def guessed(self, before: Forms, cells: Cells, middle: Array) -> Array:
        """(N, n) where to begin in cells, ``middle`` (N,) segments behind the middles of those before."""
        q = before.q.copy()
        q[:, self.free] += before.follow[:, :, 1] * middle[:, None]
        return self.placed(q, cells)

    def finishes(self, locks: Ints) -> Flags:
        """Whether Newton's method follows the path from lock instants (N,) to its end, within the limits; a look ahead."""
        end = (len(self.knots) - 1) * SEGMENT
        held = self.healthy(2 * locks, np.maximum(locks, 1))[0]
        q, good, (low, high) = held.copy(), np.ones(len(locks), dtype=bool), self.limits.T
        for at in range(int(locks.min()) // _STRIDE * _STRIDE + _STRIDE, end + 1, _STRIDE):
            some = np.flatnonzero(good & (locks < at))
            goal = self.healthy(np.array([2 * at]), np.array([at]))[0]
            target, now = self._moved(goal), q[some]
            now[:, self.still[1:]] = goal[:, self.still[1:]]
            for _ in range(_NEWTON):
                error, slope = self._missed(self._moved(now), target)
                if np.abs(error).max(initial=0.0) < _NEAR:
                    break
                now[:, self.free] -= np.clip(_solved(slope[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)
            q[some] = now
            good[some] = (np.abs(error) < _NEAR).all(axis=1) & ((now >= low) & (now <= high)).all(axis=1)
        return good

    # ---- kinematics --------------------------------------------------------------------------------------------

    def _moved(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Place and rotation of the tool, axes (N, n, 3), and how the place follows the joints (N, n, 3)."""
        place, turn = np.zeros((len(q), 3)), np.tile(np.eye(3), (len(q), 1, 1))
        axes, points = np.empty((2, len(q), self.n, 3))
        sine, cosine = np.sin(q), np.cos(q)
        for k in range(self.n):
            place, turn = place + turn @ self.chain.origins[k], turn @ self.chain.rotations[k]
            axes[:, k], points[:, k] = turn[:, :, 2], place
            x, y = turn[:, :, 0] * cosine[:, [k]], turn[:, :, 1] * cosine[:, [k]]
            turn = np.stack([x + turn[:, :, 1] * sine[:, [k]], y - turn[:, :, 0] * sine[:, [k]], turn[:, :, 2]], axis=2)
        place = place + turn @ self.chain.origins[self.n]
        return place, turn @ self.chain.rotations[self.n], axes, np.cross(axes, place[:, None] - points)

    def _missed(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> tuple[Array, Array]:
        """Error (N, m) and its slopes by the arm's joints (N, m, n)."""
        error, slope = at[0] - target[0], at[3].transpose(0, 2, 1)
        if self.m > 3:
            off = at[1] @ target[1].transpose(0, 2, 1)
            error = np.concatenate([error, _axial(off)], axis=1)
            slope = np.concatenate([slope, _onto(off) @ at[2].transpose(0, 2, 1)], axis=1)
        return error[:, : self.m], slope[:, : self.m]

    def _theirs(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> Array:
        """Slopes (N, m, n) by the healthy arm's joints."""
        slope = -target[3].transpose(0, 2, 1)
        if self.m > 3:
            off = at[1] @ target[1].transpose(0, 2, 1)
            slope = np.concatenate([slope, -_onto(off) @ off @ target[2].transpose(0, 2, 1)], axis=1)
        return slope[:, : self.m]

    def _bent(self, at: tuple[Array, ...], target: tuple[Array, ...], d: Array) -> Array:
        """Second derivatives (N, m, c, c) along the columns of d."""
        n, ours, theirs = self.n, d[:, : self.n], d[:, self.n :]
        # Along a column, what joints before k turn moves the column of joint k; a sum over all pairs, each once.
        both = _twice(at[2], at[3], ours) - _twice(target[2], target[3], theirs)
        if self.m > 3:
            off = at[1] @ target[1].transpose(0, 2, 1)
            axes = np.concatenate([at[2], -(off[:, None] @ target[2][..., None])[..., 0][:, ::-1]], axis=1)
            moves = np.concatenate([ours, theirs[:, ::-1]], axis=1)
            before = np.cumsum(axes[:, :, None] * moves[..., None], axis=1)  # (N, 2n, c, 3)
            last = before - axes[:, :, None] * moves[..., None] / 2  # a joint with itself counts half
            turned = np.cross(axes[:, :, None, :], off.transpose(0, 2, 1)[:, None])  # rows: z x each column of off
            later = _onto(turned.transpose(0, 1, 3, 2).reshape(-1, 3, 3)).reshape(len(off), 2 * n, 3, 3)
            half = np.einsum("nkri,nkai,nkb->nrab", later, last, moves, optimize=True)
            both = np.concatenate([both, half + half.transpose(0, 1, 3, 2)], axis=1)
        return both[:, : self.m]

    # ---- bounds ------------------------------------------------------------------------------------------------

    def _third(self, far: Array) -> Array:
        """(N, m) what is left behind the second order."""
        ours, theirs = np.cumsum(far[:, : self.n], axis=1), np.cumsum(far[:, self.n :], axis=1)
        place = ((ours**3 + theirs**3) * self.chain.lengths).sum(axis=1) / 6
        turn = far.sum(axis=1) ** 3 / 6
        return np.stack([place] * self._linear + [turn] * (self.m - self._linear), axis=1)

    def _excess(self, error: Array, reach: Array, left: Array, second: Array, half: Array, bend: Array) -> tuple[Array, ...]:
        """How far the error may be from the section, how far joints go, and by how much they turn the tool."""
        far = (reach @ half[:, :, None])[:, :, 0]
        rest = self._third(far) + (left @ half[:, :, None])[:, :, 0]
        rest += np.einsum("nacd,nc,nd->na", np.abs(second) * bend, half, half, optimize=True) / 2
        own = np.einsum("nacc->nac", second)
        high, low = (rest + (np.maximum(x, 0) @ (half**2)[:, :, None])[:, :, 0] / 2 for x in (own, -own))
        return np.maximum(error + high, low - error), far[:, : self.n], far.sum(axis=1)

    def _contracts(self, reach: Array, left: Array, second: Array, half: Array, wide: Array) -> Flags:
        """Whether there is at most one solution in section boxes (N, m)."""
        m = self.m
        whole = np.concatenate([half[:, :-m], wide], axis=1)
        far = (reach @ whole[:, :, None])[:, :, 0]
        ours, own = np.cumsum(far[:, : self.n], axis=1), np.cumsum(reach[:, : self.n, -m:], axis=1)
        slope = left[:, :, -m:] + np.einsum("nabc,nc->nab", np.abs(second[:, :, -m:]), whole)
        place = np.einsum("k,nkb,nk->nb", self.chain.lengths, own, ours**2) / 2
        turn = own[:, -1] * far.sum(axis=1)[:, None] ** 2 / 2
        slope += np.stack([place] * self._linear + [turn] * (m - self._linear), axis=1)
        return np.asarray((_MARGIN * (slope @ wide[:, :, None])[:, :, 0] < 0.998 * wide).all(axis=1))


def _twice(axes: Array, columns: Array, moves: Array) -> Array:
    """(N, 3, c, c) second derivatives of a place along the columns of moves (N, n, c)."""
    steps = axes[:, :, None] * moves[..., None]
    last = np.cumsum(steps, axis=1) - steps / 2
    half = np.cross(last[:, :, :, None], (columns[:, :, None] * moves[..., None])[:, :, None]).sum(axis=1)
    return np.asarray((half + half.transpose(0, 2, 1, 3)).transpose(0, 3, 1, 2))


def _axial(turn: Array) -> Array:
    """(N, 3) the axial vectors of rotations."""
    twice = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1)
    return np.asarray(twice / 2)


def _onto(turn: Array) -> Array:
    """(N, 3, 3) what takes a to the axial vector of [a] R."""
    return np.asarray((np.trace(turn, axis1=1, axis2=2)[:, None, None] * np.eye(3) - turn) / 2)


def _solved(matrix: Array, right: Array) -> Array:
    """With a matrix that is nearly singular, something large."""
    return np.asarray(np.linalg.solve(matrix + 1e-14 * np.eye(matrix.shape[-1]), right))
