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
_FIRST, _STRIDE, _SLOWEST = SEGMENT >> 8, SEGMENT >> 1, SEGMENT >> 14  # instants, of the look ahead
_NEAR, _JUMP = 1e-6, 0.3  # m and rad
_NEVER = 10.0  # m and rad: no section box is so wide


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of slabs, N of them: instants, in parts of a segment.

    Attributes:
        begin, stop: (N,) the slab of lock instants, in one segment.
        start, end: (N,) the cell of the path, in one segment; of one that is turned its middle, twice.
        width: (N,) half widths of those along the tangent of the motion, in units of the file; 0: not turned.
    """

    begin: Ints
    stop: Ints
    start: Ints
    end: Ints
    width: Ints

    @property
    def half(self) -> Array:
        """(N, 2) half widths of both, in segments."""
        half = np.stack([self.stop - self.begin, self.end - self.start], axis=1) / (2 * SEGMENT)
        half[:, 1] += self.width * UNIT
        return half


@dataclass(frozen=True, eq=False)
class Forms:
    """What is found in cells, N of them, each with as many columns as coordinates: lock, path, tube, section.

    Attributes:
        q: (N, n) centres, rad.
        place: (N,) middles on the path, in segments.
        turned: (N,) whether the path is that along the tangent of the motion.
        own: (N, m + 1, columns) how free joints, then the place on the path, follow the coordinates.
        half: (N, columns) half widths of these, the section's as small as it may be.
        only: (N, m) of the section box in which there is one solution.
        good: (N,) whether that is shown, and within the limits.
    """

    q: Array
    place: Array
    turned: Flags
    own: Array
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
        target = self.moved(goal)
        for _ in range(_NEWTON):
            at = self.moved(q)
            error, slope = self.missed(at, target)
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
        at, target = self.moved(q), self.moved(goal)
        error, ours = self.missed(at, target)
        slopes = np.concatenate([ours, self._theirs(at, target)], axis=2)
        turned, own = cells.width > 0, self._section(slopes, rate, along, cells.width > 0)
        d = np.zeros((len(q), 2 * n, 2 + tube + m))
        moved = along[:, :, None] * own[:, -1:]
        d[:, self.still[0], 0] = rate[:, self.still[0]]
        d[:, self.still[1:]], d[:, n:], d[:, self.free] = moved[:, self.still[1:]], moved, own[:, :-1]
        second = self._bent(at, target, d)
        left = np.abs(slopes @ d - np.concatenate([np.zeros((m, 2)), *[np.eye(m)] * (2 if tube else 1)], axis=1))
        half = np.concatenate([cells.half, np.tile(self.tube, (len(q), 1)), np.zeros((len(q), m))], axis=1)
        given, bend = (np.abs(d), left, second), 1 - np.eye(half.shape[1])
        s = half[:, -m:]
        for k in range(_ROUNDS + _TIGHTER):
            e, far, angle = self._excess(error, *given, half, bend)
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
            good &= (angle < _TURN) & (np.einsum("nij,nij->n", at[1], target[1]) > _STRAIGHT)
        place = (cells.start + cells.end) / (2 * SEGMENT)
        if turned.any():
            some = [x[turned] for x in given]
            good[turned] &= self._forward(
                some[0], some[1], some[2], half[turned], own[turned], (place - (cells.end - 1) // SEGMENT - 1)[turned]
            )
        return Forms(q, place, turned, own, half, only, good)

    def _section(self, slopes: Array, rate: Array, along: Array, turned: Flags) -> Array:
        """How free joints, then the place on the path, follow coordinates (N, m + 1, columns), by slopes (N, m, 2n)."""
        m, n, tube = self.m, self.n, len(self.tube)
        jacobian, drift = slopes[:, :, self.free], slopes[:, :, self.still[0]] * rate[:, self.still[:1]]
        ahead = np.einsum("nmk,nk->nm", slopes[:, :, n:], along)
        ahead += np.einsum("nmk,nk->nm", slopes[:, :, self.still[1:]], along[:, self.still[1:]])
        inverse = _solved(jacobian, np.broadcast_to(np.eye(m), jacobian.shape))
        own = np.zeros((len(slopes), m + 1, 2 + tube + m))
        own[:, -1, 1] = 1
        own[:, :-1, :2] = -inverse @ np.stack([drift, ahead], axis=2)
        own[:, :-1, 2:] = np.concatenate([inverse] * (2 if tube else 1), axis=2)
        if turned.any():
            tangent, across = _tangent(np.concatenate([jacobian, ahead[:, :, None]], axis=2)[turned])
            # On the diagonal motions begin as the healthy arm goes: so much of its rates is along the tangent.
            beside = (tangent[:, :-1] * rate[turned][:, self.free]).sum(axis=1) + tangent[:, -1]
            own[turned, :, 0] = tangent * beside[:, None] - np.einsum("nkm,nm->nk", across, drift[turned])
            own[turned, :, 1], own[turned, :, 2:] = tangent, across
        return own

    def begins(self, forms: Forms, cells: Cells) -> Flags:
        """Whether configurations at all lock instants of slabs are the solutions of cells."""
        q, rate = (x[:, self.free] for x in self.healthy(cells.begin + cells.stop, cells.stop))
        start = np.column_stack([q, (cells.begin + cells.stop) / (2 * SEGMENT)])
        leaves = np.column_stack([rate, np.ones(len(q))])
        away = (leaves - forms.own[:, :, 0]) * forms.half[:, :1]
        return self._entered(start, away[:, :, None], forms, np.zeros(len(q), dtype=bool))

    def goes_on(self, before: Forms, forms: Forms) -> Flags:
        """Whether what is found in a cell is what was found in the one before it, where that ends."""
        end, place = self.end(before)
        kept = [k for k in range(before.half.shape[1] - self.m) if k != 1]
        moved = (before.own - forms.own)[:, :, kept] * before.half[:, None, kept]
        found = before.own[:, :, -self.m :] * before.half[:, None, -self.m :]
        point = np.column_stack([end[:, self.free], place])
        return self._entered(point, np.concatenate([moved, found], axis=2), forms, before.turned)

    def end(self, forms: Forms) -> tuple[Array, Array]:
        """Configurations (N, n) and places on the path (N,) where cells end, for the middles of their slabs."""
        q = forms.q.copy()
        q[:, self.free] += forms.own[:, :-1, 1] * forms.half[:, 1:2]
        return q, forms.place + forms.own[:, -1, 1] * forms.half[:, 1]

    def _entered(self, point: Array, away: Array, forms: Forms, turned: Flags) -> Flags:
        """Whether all that is so far from points (N, m + 1) is where cells have one solution; ``turned``: those before."""
        matrix = forms.own[:, :, [1, *range(-self.m, 0)]]
        here = np.column_stack([forms.q[:, self.free], forms.place])
        found = _solved(matrix, np.concatenate([(point - here)[:, :, None], away], axis=2))
        most = _MARGIN * np.abs(found).sum(axis=2) + _LEAST
        inside = (most[:, 0] < forms.half[:, 1]) | ~(turned | forms.turned)
        return np.asarray((most[:, 1:] < forms.only).all(axis=1) & inside)

    def guessed(self, before: Forms, cells: Cells, middle: Array) -> Array:
        """(N, n) where to begin in cells, ``middle`` (N,) segments behind the middles of those before."""
        q = before.q.copy()
        q[:, self.free] += before.own[:, :-1, 1] * middle[:, None]
        return self.placed(q, cells)

    def ahead(self, q: Array, place: float, base: int, by: Array) -> tuple[Array, Ints]:
        """From a configuration (n,) of the motion at a place of a segment: along its tangent by (N,), and back onto it."""
        held, end = q[self.still[0]], np.array([base + SEGMENT])
        z = np.tile(np.append(q, place), (len(by), 1))
        for k in range(_NEWTON):
            goal, along = self.healthy(np.rint(2 * SEGMENT * z[:, -1]), end)
            z[:, self.still[1:]] = goal[:, self.still[1:]]
            at, target = self.moved(z[:, :-1]), self.moved(goal)
            error, own = self.missed(at, target)
            slopes = np.concatenate([own, self._theirs(at, target)], axis=2)
            ahead = np.einsum("nmk,nk->nm", slopes[:, :, self.n :], np.broadcast_to(along, goal.shape))
            ahead += np.einsum("nmk,nk->nm", own[:, :, self.still[1:]], np.broadcast_to(along, goal.shape)[:, self.still[1:]])
            tangent, across = _tangent(np.concatenate([own[:, :, self.free], ahead[:, :, None]], axis=2))
            step = tangent * by[:, None] if k == 0 else -np.einsum("nkm,nm->nk", across, error)
            z[:, [*self.free, -1]] += step
            z[:, -1] = np.rint(z[:, -1] * SEGMENT) / SEGMENT
        z[:, self.free] = np.round(z[:, self.free] / UNIT) * UNIT
        z[:, self.still[0]] = held
        return z[:, :-1], np.rint(z[:, -1] * SEGMENT).astype(np.int64)

    def finishes(self, locks: Ints) -> Flags:
        """Whether Newton's method follows the path from lock instants (N,) to its end, within the limits; a look ahead."""
        end = (len(self.knots) - 1) * SEGMENT
        q, (low, high) = self.healthy(2 * locks, np.maximum(locks, 1))[0], self.limits.T
        at, step, good = locks.copy(), np.full(len(locks), _FIRST), np.ones(len(locks), dtype=bool)
        while (some := np.flatnonzero(good & (at < end))).size:
            to = np.minimum(at[some] + step[some], end)
            goal, now = self.healthy(2 * to, to)[0], q[some]
            target = self.moved(goal)
            now[:, self.still[1:]] = goal[:, self.still[1:]]
            for _ in range(_NEWTON):
                error, slope = self.missed(self.moved(now), target)
                if np.abs(error).max(initial=0.0) < _NEAR:
                    break
                now[:, self.free] -= np.clip(_solved(slope[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)
            met = (np.abs(error) < _NEAR).all(axis=1) & ((now >= low) & (now <= high)).all(axis=1)
            met &= (np.abs(now - q[some]) < _JUMP).all(axis=1)
            q[some[met]], at[some[met]] = now[met], to[met]
            step[some] = np.where(met, np.minimum(2 * step[some], _STRIDE), step[some] // 4)
            good[some] = step[some] >= _SLOWEST
        return good

    # ---- kinematics --------------------------------------------------------------------------------------------

    def moved(self, q: Array) -> tuple[Array, Array, Array, Array]:
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

    def missed(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> tuple[Array, Array]:
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

    def _slopes(self, reach: Array, left: Array, second: Array, half: Array) -> Array:
        """(N, m, 1 + m) above the slopes of the error less the section by the path and by the section."""
        last = [1, *range(half.shape[1] - self.m, half.shape[1])]
        far = (reach @ half[:, :, None])[:, :, 0]
        slope = left[:, :, last] + np.einsum("nabc,nc->nab", np.abs(second[:, :, last]), half)
        turn = np.zeros((len(half), 1 + self.m))
        for chain in (slice(0, self.n), slice(self.n, None)):
            sums, own = np.cumsum(far[:, chain], axis=1), np.cumsum(reach[:, chain][:, :, last], axis=1)
            slope[:, : self._linear] += (np.einsum("k,nkb,nk->nb", self.chain.lengths, own, sums**2) / 2)[:, None]
            turn += own[:, -1]
        slope[:, self._linear :] += (turn * far.sum(axis=1)[:, None] ** 2 / 2)[:, None]
        return np.asarray(slope)

    def _contracts(self, reach: Array, left: Array, second: Array, half: Array, wide: Array) -> Flags:
        """Whether there is at most one solution in section boxes (N, m)."""
        slope = self._slopes(reach, left, second, np.concatenate([half[:, : -self.m], wide], axis=1))[:, :, 1:]
        return np.asarray((_MARGIN * (slope @ wide[:, :, None])[:, :, 0] < 0.998 * wide).all(axis=1))

    def _forward(self, reach: Array, left: Array, second: Array, half: Array, own: Array, place: Array) -> Flags:
        """Whether turned cells only go forward on the path, and end within the segment, ``place`` (N,) from the end of that."""
        slope = self._slopes(reach, left, second, half)
        moves = _solved(np.eye(self.m) - slope[:, :, 1:], slope[:, :, :1])[:, :, 0]
        slower = (np.abs(own[:, -1, -self.m :]) * moves).sum(axis=1)
        off = (np.abs(own[:, -1]) * half).sum(axis=1)
        fine = (moves >= 0).all(axis=1) & (_MARGIN * slower < own[:, -1, 1])
        return np.asarray(fine & (place + _MARGIN * off < 0))


def _tangent(wide: Array) -> tuple[Array, Array]:
    """Unit vectors (N, m + 1) that matrices (N, m, m + 1) take to 0, the last number positive, and pseudo-inverses."""
    tangent = np.linalg.svd(wide)[2][:, -1]
    return np.asarray(tangent * np.where(tangent[:, -1:] < 0, -1.0, 1.0)), np.asarray(np.linalg.pinv(wide))


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
